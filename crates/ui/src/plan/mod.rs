//! Planning: routes over the map, what they will be navigated with, and how well that will go.

mod aircraft;
mod assessments;
mod brief;
mod chart;
mod command;
mod corridor_paint;
mod find_tool;
pub mod finder;
mod forecast;
mod ground_tab;
pub mod heat;
mod heat_paint;
mod kept;
mod landmark_editor;
mod landmark_table;
mod landmarks_tab;
mod lanes;
pub(crate) mod legs;
mod marking;
mod paint;
mod panel;
mod patterns;
pub mod planner;
mod profile;
mod readouts;
mod relief;
mod remedy;
pub(crate) mod route_tab;
pub mod routes;
mod suggestions;
mod tallies;
mod tool;
mod training_card;
mod trainings;
mod way_points;
mod words;

pub use aircraft::energy_left;
pub use assessments::{Assessments, Measured};
pub use brief::{
    BriefLandmark, BriefScene, MOST_LANDMARKS, STYLE as BRIEF_STYLE, brief, brief_area,
};
pub use command::PlanCommand;
pub(crate) use find_tool::paint_hint;
pub use finder::{FindCommand, FindPick};
pub use forecast::Forecast;
pub use heat::HeatCommand;
pub use kept::{KeptMeasurement, MEASURED_KEY};
pub use marking::{Marking, Purpose};
pub use patterns::{Circumstances, Cover, Pattern};
pub use planner::{PlanPreferences, PlanTab, Planner};
pub use readouts::plan_readouts;
pub use suggestions::{SuggestCommand, Suggestions};
pub use tool::PlanTool;
pub use trainings::{TRAININGS_KEY, TrainCommand, Training, TrainingState, Trainings};
pub use words::Outlook;
