//! The views: each queries the run at the time cursor, draws, and sends commands.

mod camera;
#[cfg(test)]
#[path = "tests/canvas.rs"]
pub(crate) mod canvas;
pub(crate) mod chart;
pub(crate) mod color_map;
pub(crate) mod ellipse;
mod explained_step;
#[cfg(test)]
pub(crate) mod fixture;
mod heat_image;
pub(crate) mod inspector;
mod landmark_list;
mod landmark_row;
mod matching;
pub(crate) mod parts;
pub(crate) mod picking;
#[cfg(test)]
pub(crate) mod pictures;
mod plots;
mod rows_in_view;
#[cfg(test)]
mod shown;
pub(crate) mod sighted;
pub(crate) mod sights;
pub(crate) mod table;
mod time_axis;

pub use camera::CameraView;
pub use explained_step::ExplainedStep;
pub use inspector::InspectorView;
pub use landmark_list::{Examined, LandmarkList};
pub use landmark_row::landmark_row;
pub use matching::{MATCH, MatchCommand, MatchView};
pub use plots::PlotsView;
pub(crate) use plots::draw::{TimeCurve, line as curve_line, polylines as curve_points};
pub(crate) use plots::pyramid::ExtentPyramid;
pub(crate) use plots::{DEAD_RECKONING_AFTER, placed_lately};
pub use rows_in_view::rows_in_view;
pub(crate) use time_axis::TimeAxis;
