//! Bounds of the navigator's numbers.

use pilotage_estimation::filter::FilterError;

use super::NavigatorSettings;

/// Numbers that a setting may have.
enum Bound {
    /// Any but what is no number.
    Finite,
    /// Zero or more.
    NotNegative,
    /// More than zero.
    Positive,
    /// A share of the cases, more than none.
    Share,
}

impl Bound {
    fn holds(&self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::NotNegative => value >= 0.0,
                Self::Positive => value > 0.0,
                Self::Share => value > 0.0 && value <= 1.0,
            }
    }

    fn words(&self) -> &'static str {
        match self {
            Self::Finite => "a finite number",
            Self::NotNegative => "zero or more",
            Self::Positive => "a number above zero",
            Self::Share => "a share above 0, 1 at most",
        }
    }
}

impl NavigatorSettings {
    /// Refuses numbers with which nothing would be navigated as it says: those of the sigma points and of particles are
    /// the filter's own to refuse.
    ///
    /// ```
    /// use pilotage_mission::settings::NavigatorSettings;
    ///
    /// let mut settings = NavigatorSettings::default();
    /// assert!(settings.check().is_ok());
    /// settings.gate_confidence = 99.0; // percent
    /// assert!(settings.check().is_err_and(|why| why.to_string().contains("gate = 99")));
    /// ```
    ///
    /// # Errors
    /// The first setting that lies outside of its bounds.
    pub fn check(&self) -> Result<(), FilterError> {
        use Bound::{Finite, NotNegative, Positive, Share};
        let (process, sensors, detector) = (&self.process, &self.sensors, &self.detector);
        let [north, east] = self.start.offset;
        for (name, value, bound) in [
            ("beta", self.beta, Finite),
            ("gate", self.gate_confidence, Share),
            ("scale", self.measurement_scale, Positive),
            ("shortest-step", self.shortest_step, NotNegative),
            ("start", self.start.position, NotNegative),
            ("start-wind", self.start.wind, NotNegative),
            ("start's offset north", north, Finite),
            ("start's offset east", east, Finite),
            ("wind", process.wind, NotNegative),
            ("gust", process.gust, NotNegative),
            ("gust-per-wind", process.gust_per_wind, NotNegative),
            ("gust-time", process.gust_time, Positive),
            ("airspeed", process.airspeed, NotNegative),
            ("heading", process.heading, NotNegative),
            ("position", process.position, NotNegative),
            ("acceleration", process.acceleration, NotNegative),
            ("drag", process.drag, NotNegative),
            ("velocity", process.velocity, NotNegative),
            ("airspeed's bias", process.airspeed_bias, NotNegative),
            ("heading's bias", process.heading_bias, NotNegative),
            ("cruise", process.cruise.airspeed, Finite),
            ("cruise's deviation", process.cruise.deviation, NotNegative),
            ("roll", sensors.roll, NotNegative),
            ("pitch", sensors.pitch, NotNegative),
            ("yaw", sensors.yaw, NotNegative),
            ("height", sensors.height, NotNegative),
            ("tilt-bias", sensors.tilt_bias, NotNegative),
            ("yaw-bias", sensors.yaw_bias, NotNegative),
            ("height-bias", sensors.height_bias, NotNegative),
            ("pixel", sensors.pixel, NotNegative),
            ("ground", sensors.ground, NotNegative),
            ("map-deviation", detector.map_deviation, NotNegative),
            ("score", detector.least_score, Finite),
            ("ambiguity", detector.greatest_ambiguity, Finite),
        ] {
            if !bound.holds(value) {
                return Err(FilterError::Setting {
                    name,
                    value,
                    allowed: bound.words(),
                });
            }
        }
        Ok(())
    }
}
