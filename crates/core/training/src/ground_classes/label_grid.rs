//! Labels of the generated country on a grid of cells.

use pilotage_base::frames::GroundPoint;
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
        fill(&mut cells, grid, &label.polygon, layer(label.kind).1);
    }
    cells
}

/// Sets the cells whose middle lies in a polygon, by the crossings of its edges with each row.
fn fill(
    cells: &mut [Option<GroundCover>],
    grid: &Window,
    polygon: &[GroundPoint],
    cover: Option<GroundCover>,
) {
    let corners: Vec<(f64, f64)> = polygon.iter().map(|corner| grid.pixel_at(corner)).collect();
    let rows = corners.iter().map(|corner| corner.1);
    let (top, bottom) = rows.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
        (low.min(y), high.max(y))
    });
    let first = top.floor().max(0.0) as usize;
    let last = (bottom.ceil().max(0.0) as usize).min(grid.height);
    let mut crossings = Vec::new();
    for row in first..last {
        let y = row as f64 + 0.5;
        crossings.clear();
        for (k, a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            if (a.1 <= y) != (b.1 <= y) {
                crossings.push(a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0));
            }
        }
        crossings.sort_by(f64::total_cmp);
        for inside in crossings.chunks_exact(2) {
            let cut = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(grid.width);
            let (left, right) = (cut(inside[0]), cut(inside[1]));
            if left < right {
                cells[row * grid.width..][left..right].fill(cover);
            }
        }
    }
}
