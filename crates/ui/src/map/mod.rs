//! The map: any imagery drawn as textured meshes under a typed screen-from-world transform, with
//! the flight and the landmarks on it.

mod button;
mod card;
mod controls;
mod correction;
mod dashes;
mod furniture;
mod interact;
mod labels;
mod landmarks;
mod layer;
mod layers;
mod look_alike;
mod other_world;
mod picking;
mod readouts;
mod roads;
mod sightings;
mod symbols;
mod thin_track;
mod tiles;
mod tool;
mod tracks;
mod transform;
mod view;

pub use button::MapButton;
pub(crate) use card::MapCard;
pub(crate) use dashes::paint_dashed;
pub(crate) use furniture::{length_text, round_length};
pub use labels::LandmarkLabel;
pub use layer::MapLayer;
pub(crate) use layers::track_colour;
pub use layers::{Layer, Layers};
pub use look_alike::LookAlikeOnMap;
pub(crate) use other_world::{carry, distance_over_ground, is_in_reach, world_reach};
pub(crate) use symbols::{
    ellipse, paint_halo_text, paint_lifted_line, paint_middle, paint_tried_footprint,
};
pub use tiles::{TILES_AT_A_TIME, TileCache, TileKey};
pub use tool::{MapCanvas, MapStage, MapTool};
pub(crate) use tool::{arrow_way, drag_origin, tool_keys};
pub use transform::{MapCamera, ScreenFromWorld};
pub use view::{MapExtra, MapView};
