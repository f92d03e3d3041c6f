//! Lost: the place of a picture among all roads of a map, by what it shows of roads.
//!
//! Crossings that a view shows are laid, in pairs, on pairs of crossings of the map that are as far apart and whose
//! arms leave in the same directions (after Li and others 2019, arXiv:1906.12174, with the height known, so that a pair
//! gives the whole pose). Each pose is verified by all points of roads, from the view to the map and from the map to
//! the view, moved to where these fit best, and weighed against all others and against "elsewhere". A map of more than
//! 100 km² is searched in parts, whose places are then weighed together.

mod evidence;
mod field;
mod hypotheses;
mod index;
mod junctions;
mod locate;
mod pairs;
mod parts;
mod prepared;
mod reach;
mod refine;
mod sequence;
mod settings;
mod tiles;
mod view;
mod weights;

pub use evidence::{CLASSES, DISTANCES, RoadEvidence};
pub use index::{RoadIndex, RoadIndexError};
pub use locate::{LostBelief, LostPlace, LostShare};
pub use parts::{PartSettings, RoadParts};
pub use reach::{RoadViewError, reach_of_views};
pub use settings::LostSettings;
pub use view::{RoadView, ViewCrossing, ViewMotion, ViewPoint, ViewPose};
