//! Kinds of numbers that can be measured of a flight.

use serde::{Deserialize, Serialize};

/// Declares the kinds of numbers, with their names and units.
macro_rules! measures {
    ($($(#[$doc:meta])* $name:ident = $key:literal, $unit:literal;)*) => {
        /// Kind of number that is measured of a flight.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum MeasureKind {
            $($(#[$doc])* #[serde(rename = $key)] $name,)*
        }

        impl MeasureKind {
            /// All of them, in the order in which people read them.
            pub const ALL: [Self; [$($key),*].len()] = [$(Self::$name),*];

            /// Name in files.
            pub fn key(self) -> &'static str {
                match self {
                    $(Self::$name => $key,)*
                }
            }

            /// Unit; empty of a ratio or a count.
            pub fn unit(self) -> &'static str {
                match self {
                    $(Self::$name => $unit,)*
                }
            }
        }
    };
}

measures! {
    /// Coming of the filter to the end of the flight: yes or no.
    Finished = "finished", "";
    /// Root mean square distance from the true position over all steps, metres.
    ErrorRms = "error-rms", "m";
    /// Largest such distance, metres.
    ErrorMax = "error-max", "m";
    /// Distance from the true position at the end, metres.
    ErrorEnd = "error-end", "m";
    /// Root mean square of the wind's error over all steps, m/s; none without a wind in the state.
    WindErrorRms = "wind-error-rms", "m/s";
    /// Error of the wind at the end, m/s.
    WindErrorEnd = "wind-error-end", "m/s";
    /// Largest distance from the true position by dead reckoning alone, metres.
    ReckonedMax = "reckoned-max", "m";
    /// Mean normalized estimation error squared of the position: 2 of an honest filter.
    Nees = "nees", "";
    /// Share of the steps whose truth lies in the 95 % ellipse of the position.
    Inside = "inside-95", "";
    /// Truth in that ellipse at the end of the flight: yes or no.
    InsideAtEnd = "inside-95-end", "";
    /// Mean normalized innovation squared over its degrees of freedom: 1 of an honest filter.
    Nis = "nis", "";
    /// Frames that corrected the estimate.
    Frames = "frames-used", "";
    /// Found landmarks that corrected the estimate.
    Accepted = "places-used", "";
    /// Found landmarks that did not.
    Refused = "places-refused", "";
    /// Found landmarks that corrected the estimate though wrong by over 5 px and 2 m.
    Wrong = "places-wrong", "";
    /// Doubt of an instrument at any time: yes or no.
    Doubted = "doubted", "";
}

impl MeasureKind {
    /// The number of its kind among those of all kinds, in the order of [`MeasureKind::ALL`].
    pub fn among(self, numbers: &[Option<f64>]) -> Option<f64> {
        numbers.get(self as usize).copied().flatten()
    }

    /// Whether it is yes or no.
    pub fn is_share(self) -> bool {
        matches!(self, Self::Finished | Self::InsideAtEnd | Self::Doubted)
    }
}
