//! The pitch of a camera's gimbal, which most count from the horizon.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use pilotage_flight::ChannelName;

use super::angles::tidy;
use super::board::FlightColumns;
use super::grid::quantile;
use super::questions;
use crate::columns::ColumnRole;
use crate::columns::bodies::is_of_camera;

/// Angle from straight down within which most cameras look, radians.
const NEAR: f64 = 15.0 * PI / 180.0;

/// Counts the pitch of a camera from straight down, as the flight has it, where its middle value lies below -45°, and says
/// so: it is counted from the horizon then. A pitch near 0 is one from straight down already; of what lies between, people
/// are asked.
pub(super) fn from_below(board: &mut FlightColumns) {
    let role = ColumnRole::Channel(ChannelName::Pitch);
    for table in 0..board.maps.len() {
        let Some(id) = board.find_in(table, role) else {
            continue;
        };
        let column = board.column(id).clone();
        if column.offset != 0.0 || !is_of_camera(&column) {
            continue;
        }
        let factor = role.factor(&column.unit).unwrap_or(1.0);
        let middle = quantile(&board.raw(id).values, 0.5) * factor;
        // Climbs tell nothing of the sign of a pitch that is held.
        let scales = [column.scale, column.scale.abs()];
        let is_down = |scale: &f64| scale * middle < -FRAC_PI_4;
        let Some(scale) = scales.into_iter().find(is_down) else {
            if middle.abs() > NEAR {
                let question = format!(
                    "Is {}, {:.0}° in the middle, counted from the horizon, or from straight down? Nothing tells; taken: from \
                     straight down",
                    column.name,
                    middle.to_degrees()
                );
                questions::add(board, table, question);
            }
            continue;
        };
        board.assign(id, role, scale, tidy(FRAC_PI_2 / factor));
        board.tell(
            table,
            format!(
                "{}: counted from the horizon, {:.0}° in the middle; 90° are added, so that 0 looks straight down, and a roll \
                 beside it is about the view",
                column.name,
                (scale * middle).to_degrees()
            ),
        );
    }
}
