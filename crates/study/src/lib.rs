//! Studies over very many flights without pictures: what varies and how, what is measured, and what came of it with its
//! intervals.
//!
//! Run number `n` of a plan depends on the plan and on `n` alone: random numbers come by counter. Whoever flies the runs,
//! in whatever order and pieces, finds the same rows to the bit; the summary is made of the rows in the order of their
//! numbers. Reaches no screen, clock, file or thread.

mod by_name;
mod design;
mod digits;
mod fault;
mod fault_kind;
mod fly;
mod measure;
mod measured;
mod observed;
mod philox;
mod plan;
mod plan_missions;
mod plan_parts;
mod record;
mod resampled;
mod run_settings;
mod seeds;
mod settings;
mod shipped;
mod sobol;
mod stated_navigation;
mod study_flight;
mod study_mission;
mod summary;
mod table;
mod value;

pub use by_name::ByName;
pub use design::{StudyDesign, StudyRun};
pub use fault_kind::FaultKind;
pub use fly::{Study, StudyRow};
pub use measure::MeasureKind;
pub use measured::{IntervalBy, MeanSummary, QuantileSummary};
pub use observed::numbers_of;
pub use philox::Philox;
pub use plan::{DrawBy, StopRule, StudyError, StudyMeasure, StudyPlan};
pub use plan_parts::StudyPlanParts;
pub use record::StudyRecord;
pub use run_settings::RunSettings;
pub use settings::StudySetting;
pub use shipped::{SHIPPED_PLANS, question_of};
pub use sobol::SobolPoints;
pub use stated_navigation::StatedNavigation;
pub use study_flight::{PreparedFlight, StudyFlight};
pub use study_mission::{FlownMission, PlanMission, StudyMission};
pub use summary::{CellSummary, MeasureSummary, StudySummary, StudyTally};
pub use value::{SettingDistribution, SettingValue};
