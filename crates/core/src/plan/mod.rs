//! Planning: what can be known before take-off of how well a route will be navigated.

mod corridor;
mod detection;
mod prediction;
mod propagate;
mod view;

pub use corridor::{Corridor, corridor};
pub use detection::{DetectionStatistics, ExpectedDetection};
pub use prediction::{
    PlannedLandmark, Prediction, PredictionError, PredictionRequest, PredictionSample, Stretch,
};
