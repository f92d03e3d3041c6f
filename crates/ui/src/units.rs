//! Numbers with the user's units, and times.

use serde::{Deserialize, Serialize};

/// Units that people read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// Metres, metres per second.
    #[default]
    Metric,
    /// Feet, knots.
    Aviation,
}

impl Units {
    /// Factor from metres, and the unit's name.
    pub fn length(self) -> (f64, &'static str) {
        match self {
            Self::Metric => (1.0, "m"),
            Self::Aviation => (1.0 / 0.3048, "ft"),
        }
    }

    /// Factor from metres per second, and the unit's name.
    pub fn speed(self) -> (f64, &'static str) {
        match self {
            Self::Metric => (1.0, "m/s"),
            Self::Aviation => (3600.0 / 1852.0, "kt"),
        }
    }

    /// A distance of metres that may be short, and its unit: centimetres below a metre, tenths of a foot.
    pub fn short_distance(self, metres: f64) -> (String, &'static str) {
        let (factor, unit) = self.length();
        if self == Self::Metric && metres < 0.995 {
            return (format!("{:.0}", 100.0 * metres), "cm");
        }
        (format!("{:.1}", metres * factor), unit)
    }
}

/// Minutes and seconds since `first`: `4:07.3`.
pub fn clock(time: f64, first: f64) -> String {
    let since = (time - first).max(0.0);
    let minutes = (since / 60.0).floor();
    format!("{minutes:.0}:{:04.1}", since - 60.0 * minutes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_distances_are_told_in_centimetres_where_people_have_them() {
        let of = |metres| Units::Metric.short_distance(metres);
        assert_eq!(of(0.043), ("4".to_owned(), "cm"));
        assert_eq!(of(0.996), ("1.0".to_owned(), "m"));
        assert_eq!(of(3.44), ("3.4".to_owned(), "m"));
        assert_eq!(
            Units::Aviation.short_distance(0.043),
            ("0.1".to_owned(), "ft")
        );
    }

    #[test]
    fn times_read_as_minutes_and_seconds() {
        assert_eq!(clock(130.25, 3.0), "2:07.2");
    }
}
