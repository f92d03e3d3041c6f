//! Mission that people author: landmarks, routes, camera, aircraft, filter settings. A value; edits make a
//! new one.
//!
//! The file of a mission is GeoJSON; docs/formats.md defines it.

mod circles;
mod error;
pub(crate) mod found;
pub(crate) mod globe;
mod labelling;
mod labels;
mod no_fly;
pub mod package;
pub mod pattern;
mod place_file;
mod planned_ground;
mod rally;
mod read;
mod read_feature;
mod record;
mod road;
mod route;
#[cfg(test)]
mod tests;
pub(crate) mod text;
pub mod turn;
pub(crate) mod way_point_file;
mod write;

pub use circles::circles;
pub use error::MissionError;
pub use labels::{FrameLabels, LabelBox, LabelledPicture};
pub use no_fly::NoFlyZone;
pub use place_file::{belongs_to, place_files};
pub use rally::RallyPoint;
pub(crate) use read::read_features;
pub use read::read_mission;
pub(crate) use read_feature::add_geometry_members;
pub use record::{MapReference, Mission};
pub(crate) use route::HOME;
pub use route::{Route, WayPoint, WayPointAction};
pub use way_point_file::USUAL_ALTITUDE;
pub use write::write_mission;
pub(crate) use write::{degrees, no_fly_feature, rally_feature, rings, write_features};

/// Version of the file that is read and written.
const VERSION: &str = "1";

/// Key in [`Mission::properties`] under which features that are no landmarks are kept, as the text
/// of a JSON array; no unknown member can have this name.
pub const OTHER_FEATURES: &str = "features";

/// Member of the file with the labels. Programs that do not know it keep it as it stands.
const LABELS: &str = "labels";

/// Member of the file with what is changed of the camera so that it goes with the log.
const CAMERA_TO_LOG: &str = "camera_to_log";

/// Prefix of keys in a landmark's properties that stand for unknown members of the feature itself,
/// beside its properties.
pub const FEATURE_MEMBER: &str = "feature:";

/// Property and its value, as JSON text, by which a feature says that it is a route.
const ROUTE_MARK: (&str, &str) = ("pilotage", "\"route\"");

/// Property of a route: whether the aircraft returns to its home at the end.
const RETURNS: &str = "returns_home";

/// Property and its value by which a polygon says that it is an area that must not be flown over.
pub(crate) const NO_FLY_MARK: (&str, &str) = ("pilotage", "\"no-fly\"");

/// Property and its value by which a point says that the aircraft may land there when it cannot go on.
pub(crate) const RALLY_MARK: (&str, &str) = ("pilotage", "\"rally\"");

/// Property and its value by which a line says that it is the centre line of a road.
const ROAD_MARK: (&str, &str) = ("pilotage", "\"road\"");
