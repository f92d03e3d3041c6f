//! Planning: routes over the map, what they will be navigated with, and how well that will go.

mod assessments;
mod chart;
mod command;
mod find_tool;
pub mod finder;
mod forecast;
mod ground_tab;
pub mod heat;
mod heat_paint;
mod landmark_table;
mod landmarks_tab;
mod lanes;
mod legs;
mod paint;
mod panel;
pub mod planner;
mod readouts;
mod route_tab;
pub mod routes;
mod tool;
mod way_points;
mod words;

pub use assessments::{Assessments, Measured};
pub use command::PlanCommand;
pub(crate) use find_tool::paint_hint;
pub use finder::{FindCommand, FindPick};
pub use forecast::Forecast;
pub use heat::HeatCommand;
pub use planner::{PlanPreferences, PlanTab, Planner};
pub use readouts::plan_readouts;
pub use tool::PlanTool;
pub use words::Outlook;
