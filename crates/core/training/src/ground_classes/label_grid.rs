//! Labels of the generated country on a grid of cells.

use crate::polygon::for_spans_inside;
use pilotage_raster::imagery::Window;
use pilotage_simulate::simulate::scenery::{SceneKind, SceneLabel};
use pilotage_vision::ground_class::GroundCover;

/// Layer of a kind, the higher over the lower, and its class; `None` of the class where the kind may be several.
fn layer(kind: SceneKind) -> (u8, Option<GroundCover>) {
    match kind {
        SceneKind::Field => (0, Some(GroundCover::Open)),
        SceneKind::Wood => (1, Some(GroundCover::Tree)),
        // Playing fields, cemeteries and quarries are several things at once, and a track is soil or gravel.
        SceneKind::Place => (2, None),
        SceneKind::Track => (3, None),
        SceneKind::Pond | SceneKind::Pool | SceneKind::Stream => (4, Some(GroundCover::Water)),
        SceneKind::Yard
        | SceneKind::Road
        | SceneKind::Crossing
        | SceneKind::CarPark
        | SceneKind::Car => (5, Some(GroundCover::Paved)),
        SceneKind::Building | SceneKind::House | SceneKind::Tank => {
            (6, Some(GroundCover::Building))
        }
        SceneKind::Tree => (7, Some(GroundCover::Tree)),
    }
}

/// Classes of the cells of `grid`, row by row, by the labels that touch it; what has none is open ground.
///
/// Labels with a name are outlines of whole places, in which each building has a label of its own; roads alone have
/// names and are what they say.
pub fn label_grid(labels: &[SceneLabel], grid: &Window) -> Vec<Option<GroundCover>> {
    let mut cells = vec![Some(GroundCover::Open); grid.width * grid.height];
    let is_thing = |label: &&SceneLabel| label.name.is_none() || label.kind == SceneKind::Road;
    let mut ordered: Vec<&SceneLabel> = labels.iter().filter(is_thing).collect();
    ordered.sort_by_key(|label| layer(label.kind).0);
    for label in ordered {
        let cover = layer(label.kind).1;
        for_spans_inside(&label.polygon, grid, &mut |row, columns| {
            cells[row * grid.width..][columns].fill(cover);
        });
    }
    cells
}
