//! Names of PX4's flight modes.

/// Name of the mode with that `nav_state`, as PX4 shows it (`nav_state_names` in its
/// `src/lib/modes/ui.hpp`), or `None` where the number is unused or meant different modes in different
/// versions.
pub(super) fn of_navigation_state(number: u8) -> Option<&'static str> {
    Some(match number {
        0 => "Manual",
        1 => "Altitude",
        2 => "Position",
        3 => "Mission",
        4 => "Hold",
        5 => "Return",
        10 => "Acro",
        12 => "Descend",
        13 => "Termination",
        14 => "Offboard",
        15 => "Stabilized",
        17 => "Takeoff",
        18 => "Land",
        19 => "Follow Target",
        20 => "Precision Landing",
        21 => "Orbit",
        22 => "VTOL Takeoff",
        23 => "External 1",
        24 => "External 2",
        25 => "External 3",
        26 => "External 4",
        27 => "External 5",
        28 => "External 6",
        29 => "External 7",
        30 => "External 8",
        _ => return None,
    })
}
