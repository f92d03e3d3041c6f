//! `ArduPilot`'s vehicles and the names of their modes.

/// A kind of vehicle that `ArduPilot` flies, drives or dives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vehicle {
    /// Aeroplane.
    Plane,
    /// Multicopter or helicopter.
    Copter,
    /// Ground vehicle or boat.
    Rover,
    /// Antenna tracker.
    Tracker,
    /// Submarine.
    Sub,
    /// Airship.
    Blimp,
}

impl Vehicle {
    /// The vehicle that words of the autopilot name, as in `ArduPlane V3.8.2 (…)`.
    pub fn named(text: &str) -> Option<Self> {
        let words = [
            ("Rover", Self::Rover),
            ("Plane", Self::Plane),
            ("Copter", Self::Copter),
            ("Tracker", Self::Tracker),
            ("ArduSub", Self::Sub),
            ("Blimp", Self::Blimp),
        ];
        let found = words.into_iter().find(|(word, _)| text.contains(word));
        found.map(|(_, vehicle)| vehicle)
    }

    /// The vehicle of a build number, as VER messages have it.
    pub fn built(number: u8) -> Option<Self> {
        Some(match number {
            1 => Self::Rover,
            2 | 13 => Self::Copter,
            3 => Self::Plane,
            4 => Self::Tracker,
            7 => Self::Sub,
            12 => Self::Blimp,
            _ => return None,
        })
    }

    /// Name of a mode, or `None` if the vehicle has none of that number.
    pub fn mode(self, number: u32) -> Option<&'static str> {
        let names = match self {
            Self::Plane => PLANE,
            Self::Copter => COPTER,
            Self::Rover => ROVER,
            Self::Tracker => TRACKER,
            Self::Sub => SUB,
            Self::Blimp => BLIMP,
        };
        let found = names.iter().find(|(known, _)| *known == number);
        found.map(|(_, name)| *name)
    }
}

type Names = &'static [(u32, &'static str)];

const PLANE: Names = &[
    (0, "MANUAL"),
    (1, "CIRCLE"),
    (2, "STABILIZE"),
    (3, "TRAINING"),
    (4, "ACRO"),
    (5, "FBWA"),
    (6, "FBWB"),
    (7, "CRUISE"),
    (8, "AUTOTUNE"),
    (10, "AUTO"),
    (11, "RTL"),
    (12, "LOITER"),
    (13, "TAKEOFF"),
    (14, "AVOID_ADSB"),
    (15, "GUIDED"),
    (16, "INITIALISING"),
    (17, "QSTABILIZE"),
    (18, "QHOVER"),
    (19, "QLOITER"),
    (20, "QLAND"),
    (21, "QRTL"),
    (22, "QAUTOTUNE"),
    (23, "QACRO"),
    (24, "THERMAL"),
    (25, "LOITERALTQLAND"),
    (26, "AUTOLAND"),
];

const COPTER: Names = &[
    (0, "STABILIZE"),
    (1, "ACRO"),
    (2, "ALT_HOLD"),
    (3, "AUTO"),
    (4, "GUIDED"),
    (5, "LOITER"),
    (6, "RTL"),
    (7, "CIRCLE"),
    (8, "POSITION"),
    (9, "LAND"),
    (10, "OF_LOITER"),
    (11, "DRIFT"),
    (13, "SPORT"),
    (14, "FLIP"),
    (15, "AUTOTUNE"),
    (16, "POSHOLD"),
    (17, "BRAKE"),
    (18, "THROW"),
    (19, "AVOID_ADSB"),
    (20, "GUIDED_NOGPS"),
    (21, "SMART_RTL"),
    (22, "FLOWHOLD"),
    (23, "FOLLOW"),
    (24, "ZIGZAG"),
    (25, "SYSTEMID"),
    (26, "AUTOROTATE"),
    (27, "AUTO_RTL"),
    (28, "TURTLE"),
    (29, "RATE_ACRO"),
];

const ROVER: Names = &[
    (0, "MANUAL"),
    (1, "ACRO"),
    (2, "LEARNING"),
    (3, "STEERING"),
    (4, "HOLD"),
    (5, "LOITER"),
    (6, "FOLLOW"),
    (7, "SIMPLE"),
    (8, "DOCK"),
    (9, "CIRCLE"),
    (10, "AUTO"),
    (11, "RTL"),
    (12, "SMART_RTL"),
    (15, "GUIDED"),
    (16, "INITIALISING"),
];

const TRACKER: Names = &[
    (0, "MANUAL"),
    (1, "STOP"),
    (2, "SCAN"),
    (4, "GUIDED"),
    (10, "AUTO"),
    (16, "INITIALISING"),
];

const SUB: Names = &[
    (0, "STABILIZE"),
    (1, "ACRO"),
    (2, "ALT_HOLD"),
    (3, "AUTO"),
    (4, "GUIDED"),
    (7, "CIRCLE"),
    (9, "SURFACE"),
    (16, "POSHOLD"),
    (19, "MANUAL"),
];

const BLIMP: Names = &[
    (0, "LAND"),
    (1, "MANUAL"),
    (2, "VELOCITY"),
    (3, "LOITER"),
    (4, "RTL"),
    (5, "AUTO"),
    (6, "HOLD"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vehicles_are_known_by_the_words_of_their_firmware() {
        let named = Vehicle::named;
        assert_eq!(named("ArduPlane V3.8.2 (2dd1a23b)"), Some(Vehicle::Plane));
        assert_eq!(named("APM:Copter V3.3 (7a39afee)"), Some(Vehicle::Copter));
        assert_eq!(named("ArduRover V2.50"), Some(Vehicle::Rover));
        assert_eq!(named("AntennaTracker V4.2"), Some(Vehicle::Tracker));
        assert_eq!(named("ArduSub V4.1.0"), Some(Vehicle::Sub));
        assert_eq!(named("EKF2 IMU0 is using GPS"), None);
    }

    #[test]
    fn one_number_is_another_mode_in_another_vehicle() {
        assert_eq!(Vehicle::Plane.mode(5), Some("FBWA"));
        assert_eq!(Vehicle::Copter.mode(5), Some("LOITER"));
        assert_eq!(Vehicle::Plane.mode(9), None);
        assert_eq!(Vehicle::built(7).and_then(|v| v.mode(19)), Some("MANUAL"));
        assert_eq!(Vehicle::built(5), None);
    }
}
