//! Planning: what can be known before take-off of how well a route will be navigated.

mod assess;
mod corridor;
mod days;
mod detection;
mod find;
mod prediction;
mod propagate;
mod suggest;
mod view;

pub use assess::{Assessor, Circumstances, View};
pub use corridor::{Corridor, corridor};
pub use days::{OtherDays, PictureDays, SceneryDays, any_day};
pub use detection::{DetectionStatistics, ExpectedDetection};
pub use find::{FoundRoute, FoundRoutes, NoFlyArea, RouteQuestion};
pub use prediction::{
    PlannedLandmark, Prediction, PredictionError, PredictionRequest, PredictionSample, Stretch,
};
pub use suggest::{Candidate, Ranking, Suggestion, choose, poses_all_over, poses_over};
