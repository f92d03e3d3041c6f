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

    /// Factor from an SI unit, and the unit on screen of what has it.
    pub fn of_si(self, unit: &str) -> (f64, String) {
        let (factor, name) = match unit {
            "m" => self.length(),
            "m/s" => self.speed(),
            "rad" => (1.0_f64.to_degrees(), "°"),
            other => return (1.0, other.to_owned()),
        };
        (factor, name.to_owned())
    }

    /// A distance of metres that is known to two figures, and its unit.
    ///
    /// ```
    /// use pilotage_ui::units::Units;
    ///
    /// assert_eq!(Units::Metric.short_distance(0.42), ("42".to_owned(), "cm"));
    /// assert_eq!(Units::Aviation.short_distance(30.48), ("100".to_owned(), "ft"));
    /// ```
    ///
    /// Centimetres below a metre, tenths below ten of
    /// the unit, whole ones from there on.
    pub fn short_distance(self, metres: f64) -> (String, &'static str) {
        let (factor, unit) = self.length();
        if self == Self::Metric && metres < 0.995 {
            return (format!("{:.0}", 100.0 * metres), "cm");
        }
        let value = metres * factor;
        let decimals = usize::from(value < 9.95);
        (format!("{value:.decimals$}"), unit)
    }

    /// The same with its unit: `2.3 m`.
    pub fn short(self, metres: f64) -> String {
        let (value, unit) = self.short_distance(metres);
        format!("{value} {unit}")
    }

    /// A distance of metres over the ground with its unit.
    ///
    /// ```
    /// use pilotage_ui::units::Units;
    ///
    /// assert_eq!(Units::Metric.way(1234.0), "1.234 km");
    /// assert_eq!(Units::Aviation.way(1852.0), "1.000 NM");
    /// ```
    ///
    /// Metres or kilometres, feet or nautical miles.
    pub fn way(self, metres: f64) -> String {
        match self {
            Self::Metric if metres < 999.95 => format!("{metres:.1} m"),
            Self::Metric => format!("{:.3} km", 1e-3 * metres),
            Self::Aviation if metres < 1851.9 => format!("{:.0} ft", metres / 0.3048),
            Self::Aviation => format!("{:.3} NM", metres / 1852.0),
        }
    }

    /// A distance of metres to a place far away with its unit: whole kilometres, nautical miles.
    pub fn far(self, metres: f64) -> String {
        match self {
            Self::Metric => format!("{:.0} km", 1e-3 * metres),
            Self::Aviation => format!("{:.0} NM", metres / 1852.0),
        }
    }

    /// An area of square metres with its unit: square metres, hectares or square kilometres, square feet, acres or
    /// square nautical miles.
    ///
    /// ```
    /// use pilotage_ui::units::Units;
    ///
    /// assert_eq!(Units::Metric.area(25_000.0), "2.500 ha");
    /// assert_eq!(Units::Aviation.area(8_093.712_844_8), "2.00 acres");
    /// ```
    pub fn area(self, square_metres: f64) -> String {
        /// An international acre, square metres.
        const ACRE: f64 = 4_046.856_422_4;
        match self {
            Self::Metric if square_metres < 9_999.5 => format!("{square_metres:.0} m²"),
            Self::Metric if square_metres < 999_995.0 => format!("{:.3} ha", 1e-4 * square_metres),
            Self::Metric => format!("{:.3} km²", 1e-6 * square_metres),
            Self::Aviation if square_metres < 0.9999 * ACRE => {
                format!("{:.0} ft²", square_metres / (0.3048 * 0.3048))
            }
            Self::Aviation if square_metres < 1852.0 * 1852.0 => {
                format!("{:.2} acres", square_metres / ACRE)
            }
            Self::Aviation => format!("{:.3} NM²", square_metres / (1852.0 * 1852.0)),
        }
    }
}

/// A direction of radians in degrees from 0 on, with so many decimals: below 360 once it is rounded, too.
///
/// ```
/// use pilotage_ui::units::direction;
///
/// assert_eq!(direction((-0.3_f64).to_radians(), 0), "0");
/// assert_eq!(direction((359.96_f64).to_radians(), 1), "0.0");
/// assert_eq!(direction((-90.0_f64).to_radians(), 0), "270");
/// ```
pub fn direction(radians: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", radians.to_degrees().rem_euclid(360.0));
    match text.strip_prefix("360") {
        Some(rest) => format!("0{rest}"),
        None => text,
    }
}

/// Unit of a log as people read it.
///
/// ```
/// assert_eq!(pilotage_ui::units::shown_unit("deg/s"), "°/s");
/// assert_eq!(pilotage_ui::units::shown_unit("m/s2"), "m/s²");
/// ```
pub fn shown_unit(unit: &str) -> String {
    let unit = unit.replace("deg", "°");
    unit.replace("/s2", "/s²")
}

/// A number as text with the sign for minus that is as wide as a figure, in the place of a hyphen.
pub fn with_minus(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

/// Minutes and seconds since `first`: `4:07.3`, and `\u{2212}0:05.0` before it.
///
/// ```
/// use pilotage_ui::units::clock;
///
/// assert_eq!(clock(1247.34, 1000.0), "4:07.3");
/// assert_eq!(clock(59.97, 0.0), "1:00.0");
/// assert_eq!(clock(995.0, 1000.0), "\u{2212}0:05.0");
/// ```
pub fn clock(time: f64, first: f64) -> String {
    let tenths = ((time - first) * 10.0).round();
    let sign = if tenths < 0.0 { "\u{2212}" } else { "" };
    let tenths = tenths.abs() as u64;
    format!(
        "{sign}{}:{:02}.{}",
        tenths / 600,
        tenths / 10 % 60,
        tenths % 10
    )
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
        assert_eq!(of(464.8), ("465".to_owned(), "m"));
        assert_eq!(Units::Metric.short(9.94), "9.9 m");
        assert_eq!(Units::Metric.short(9.96), "10 m");
        assert_eq!(
            Units::Aviation.short_distance(0.043),
            ("0.1".to_owned(), "ft")
        );
    }

    #[test]
    fn ways_and_areas_have_the_unit_that_suits_their_size() {
        let [metric, aviation] = [Units::Metric, Units::Aviation];
        let ways = [999.94, 999.96, 12_345.6].map(|metres| metric.way(metres));
        assert_eq!(ways, ["999.9 m", "1.000 km", "12.346 km"]);
        let ways = [30.48, 1851.0, 18_520.0].map(|metres| aviation.way(metres));
        assert_eq!(ways, ["100 ft", "6073 ft", "10.000 NM"]);
        let areas = [250.0, 9_999.6, 999_996.0].map(|area| metric.area(area));
        assert_eq!(areas, ["250 m²", "1.000 ha", "1.000 km²"]);
        // A square of 100 ft; ten acres are a furlong (201.168 m) each way; a square of two nautical miles.
        let areas = [929.0304, 40_468.564_224, 13_719_616.0].map(|area| aviation.area(area));
        assert_eq!(areas, ["10000 ft²", "10.00 acres", "4.000 NM²"]);
    }

    #[test]
    fn times_read_as_minutes_and_seconds() {
        assert_eq!(clock(130.25, 3.0), "2:07.3");
        assert_eq!(clock(61.26, 0.0), "1:01.3");
        assert_eq!(clock(119.96, 0.0), "2:00.0");
        assert_eq!(clock(2.0, 7.0), "\u{2212}0:05.0");
        assert_eq!(clock(2.0, 2.04), "0:00.0");
    }
}
