//! The request for a prediction, and its errors.

use super::DetectionStatistics;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_simulate::simulate::FlightPlan;
use pilotage_vision::landmark::Landmark;

/// A landmark and what is expected of its detection.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedLandmark {
    /// The landmark.
    pub landmark: Landmark,
    /// Expected detection of the landmark, by height.
    pub detection: DetectionStatistics,
}

/// Request for a prediction.
#[derive(Clone, Copy, Debug)]
pub struct PredictionRequest<'a> {
    /// The route, the wind, the aircraft, its sensors and its camera.
    pub plan: &'a FlightPlan,
    /// Settings of the navigation.
    pub settings: &'a NavigatorSettings,
    /// The landmarks over which it leads.
    pub landmarks: &'a [PlannedLandmark],
    /// Standard deviation of the wind about the plan's, per axis, m/s; zero where it is known.
    pub wind_deviation: f64,
    /// Worlds to try: ways in which wind and detections may turn out. 8 are coarse, 100 are fine.
    pub worlds: usize,
    /// Seed of the worlds.
    pub seed: u64,
    /// Uncertainty that the user accepts: standard deviation of the longer axis, metres.
    pub limit: f64,
}

/// Why nothing can be predicted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PredictionError {
    /// The route has no two different way-points.
    #[error("the route needs two way-points at different places")]
    NoRoute,
    /// The covariance became infinite.
    #[error("the covariance is not finite at {time:.1} s; check the settings of the filter")]
    NotFinite {
        /// Seconds after the start.
        time: f64,
    },
    /// Nobody wanted it to go on.
    #[error("the prediction was given up")]
    GivenUp,
}
