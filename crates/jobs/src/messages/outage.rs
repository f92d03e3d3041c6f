//! Satellite navigation to be cut out of a flight, and what came of it.

use pilotage_core::instruments::{Growth, OutageStudy, PositionFix};
use pilotage_core::navigator::{Run, position_fixes};
use serde::{Deserialize, Serialize};

use super::FlightSource;

/// GPS outage to be simulated: stretches of the flight without satellite navigation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outage {
    /// Single stretch from begin to end, seconds in the flight's time base.
    Stretch(f64, f64),
    /// Stretches of so many seconds, all along the time in the air.
    AllAlong(f64),
}

/// An outage to be made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutageOrder {
    /// The flight.
    pub flight: FlightSource,
    /// GPS outage to be simulated.
    pub outage: Outage,
    /// Positions that the run found in the pictures, and what to call them.
    pub seen: Option<(String, Vec<PositionFix>)>,
}

impl OutageOrder {
    /// Positions that a run to the end of a flight found in its pictures, and what to call the way that uses them; `None`
    /// without any.
    pub fn seen_by(run: &Run) -> Option<(String, Vec<PositionFix>)> {
        let fixes = position_fixes(run);
        let by = if run.settings.whole_frames.is_some() {
            "pictures"
        } else {
            "landmarks"
        };
        (!fixes.is_empty()).then(|| (format!("Airspeed, wind, {by}"), fixes))
    }
}

/// Result of one way to navigate through the outage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AidedResult {
    /// Name of the way to navigate.
    pub label: String,
    /// Error and doubt against the time since the outage.
    pub growth: Vec<Growth>,
    /// Estimated places: seconds in the flight's time base, metres north and east.
    pub places: Vec<[f64; 3]>,
}

/// Result of an outage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutageReport {
    /// The stretch, seconds in the flight's time base.
    pub span: (f64, f64),
    /// Each way to navigate.
    pub results: Vec<AidedResult>,
    /// Remarks of the program, in sentences.
    pub remarks: Vec<String>,
    /// The wind, if it can be told.
    pub winds: Option<WindReport>,
}

/// Winds of a flight beside each other: seconds in the flight's time base, velocity of the air north and east, m/s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindReport {
    /// By the unscented filter from satellite navigation.
    pub by_gps: Vec<[f64; 3]>,
    /// By least squares over the whole flight.
    pub by_least_squares: Option<[f64; 2]>,
    /// As the autopilot estimated it; empty where the log has none.
    pub by_autopilot: Vec<[f64; 3]>,
    /// Root mean square by which the filter differs from least squares, m/s.
    pub from_least_squares: Option<f64>,
    /// The same from the autopilot.
    pub from_autopilot: Option<f64>,
}

/// Results of outages all along a flight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyReport {
    /// Length of each outage, seconds.
    pub length: f64,
    /// Each way to navigate.
    pub studies: Vec<OutageStudy>,
}
