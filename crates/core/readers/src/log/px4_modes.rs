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

/// Name of the mode with that `custom_mode` of `MAVLink`, or `None` where it is not known: PX4 keeps a main
/// mode in its third byte, and which automatic mode (or mode of position control) in the fourth
/// (`px4_custom_mode.h`).
pub(super) fn of_custom_mode(number: u32) -> Option<&'static str> {
    let [_, _, main, sub] = number.to_le_bytes();
    let state = match (main, sub) {
        (1, _) => 0,
        (2, _) => 1,
        (3, 1) => 21,
        (3, 2) => return Some("Position Slow"),
        (3, _) => 2,
        (4, 2) => 17,
        (4, 3) => 4,
        (4, 4) => 3,
        (4, 5) => 5,
        (4, 6) => 18,
        (4, 8) => 19,
        (4, 9) => 20,
        (4, 10) => 22,
        (4, 11..=18) => 23 + (sub - 11),
        (5, _) => 10,
        (6, _) => 14,
        (7, _) => 15,
        (10, _) => 13,
        _ => return None,
    };
    of_navigation_state(state)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn automatic_modes_are_told_by_the_fourth_byte() {
        assert_eq!(of_custom_mode(0x0404_0000), Some("Mission"));
        assert_eq!(of_custom_mode(0x0504_0000), Some("Return"));
        assert_eq!(of_custom_mode(0x0003_0000), Some("Position"));
        assert_eq!(of_custom_mode(0x0103_0000), Some("Orbit"));
        assert_eq!(of_custom_mode(0x1204_0000), Some("External 8"));
        assert_eq!(of_custom_mode(0x6304_0000), None);
        assert_eq!(of_custom_mode(7), None);
    }

    #[test]
    fn numbers_that_changed_their_meaning_have_no_name() {
        for number in [6, 7, 8, 9, 11, 16, 31, 255] {
            assert_eq!(of_navigation_state(number), None);
        }
    }
}
