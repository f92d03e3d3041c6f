//! Roads of the mission, drawn and edited on the map, whatever workspace shows it.

mod card;
mod command;
mod drawing;
mod edit;
mod feature;
mod geometry;
mod keyboard;
mod on_map;

use pilotage_core::roads::RoadClass;

use drawing::{LegKind, RoadDrawing};

/// Work on the roads of the mission.
#[derive(Debug, Default)]
pub struct Roads {
    /// Whether clicks on the map are for it.
    is_on: bool,
    /// The road that is being drawn, if one is.
    drawing: Option<RoadDrawing>,
    /// Way in which the next leg leads to its click.
    legs: LegKind,
    /// Index of the selected road.
    selected: Option<usize>,
    /// Index of its selected point.
    point: Option<usize>,
    /// Whether the next click says with which road the selected one is joined.
    is_joining: bool,
    /// Points that are dragged, each a road and its index there: one of the selected road, then those of other roads at
    /// the same place.
    dragged: Vec<(usize, usize)>,
    /// Class of the road that was drawn or chosen last, and of the next one.
    class: RoadClass,
    /// Number of roads, and of points of the selected one, as they were left.
    counts: (usize, usize),
    /// Whether its selected point went by other hands.
    has_lost_point: bool,
}
