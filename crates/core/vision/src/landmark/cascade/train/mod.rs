//! Cascades made from examples: `GentleBoost` stage by stage on what the stages before let pass.

mod boost;
mod pool;
mod stage;
mod stump;
mod table;
mod training;

pub use pool::FeatureKind;
pub use stage::{StageGoal, StageRow};
pub use training::{CascadeTraining, TrainingSettings};
