//! Planning: what can be known before take-off of how well a route will be navigated.

mod assess;
mod blind_way;
mod breakdown;
mod calibration;
mod corridor;
mod day_factor;
mod detection;
mod envelope;
mod field;
mod find;
mod graph;
mod honesty;
mod no_fly;
mod offered;
mod poses;
mod prediction;
mod propagate;
mod proposal;
mod random_route;
mod request;
mod smooth;
mod stated;
mod suggest;
mod view;
mod winds;

pub use assess::{Assessor, Circumstances, Rehearsal, View};
pub use breakdown::Breakdown;
pub use calibration::{Pass, Reliability, ReliabilityBin};
pub use corridor::{Belief, Corridor, corridor};
pub use detection::{DetectionStatistics, ExpectedDetection};
pub use envelope::{Envelope, EnvelopeSurvey, Tally, tally_by};
pub use field::{FieldBuilder, FieldView, FixSource, Localizability};
pub use find::{
    Aim, BudgetOf, FindError, Forbidden, FoundRoute, FoundRoutes, RouteQuestion, RouteSearch,
    growth_before_first_fix,
};
pub use honesty::{Comparison, Verification, compare};
pub use no_fly::{NoFlyArea, inside};
pub use offered::OfferedField;
pub use poses::{poses_all_over, poses_over};
pub use prediction::{Prediction, PredictionSample, Stretch};
pub use proposal::{Proposal, ProposalQuestion};
pub use random_route::{random_places, random_route};
pub use request::{PlannedLandmark, PredictionError, PredictionRequest};
pub use smooth::{Turns, fits};
pub use stated::{StatedDetector, StatedFrames, as_stated};
pub use suggest::{Candidate, Ranking, Suggestion, choose, choose_lasting, fading};
