//! Heights of the receiver in tables that were made of blackbox logs.

use super::board::{FlightColumns, Id, UnitBasis};

/// Columns of INAV's, which counts the same name in metres.
const OF_INAV: [&str; 4] = ["nav", "GPS_fixType", "GPS_hdop", "GPS_eph"];

/// Whether a column is the receiver's height of a blackbox log, whose table states no unit of it.
pub(super) fn is_height(board: &FlightColumns, id: Id) -> bool {
    let columns = &board.maps[id.0].columns;
    board.name(id) == "GPS_altitude"
        && board.basis(id) == UnitBasis::Assumed
        && columns.iter().any(|column| column.name == "GPS_coord[0]")
}

/// Reads that height in decimetres, as Betaflight from 4.0 on writes it; other heights of the table may
/// tell otherwise, and older ones count centimetres.
pub(super) fn in_decimetres(board: &mut FlightColumns, id: Id) {
    let mut columns = board.maps[id.0].columns.iter();
    if columns.any(|column| OF_INAV.iter().any(|of| column.name.starts_with(of))) {
        return;
    }
    let role = board.column(id).role;
    let why = "Betaflight writes it in decimetres";
    board.take(id, role, "dm", why);
}
