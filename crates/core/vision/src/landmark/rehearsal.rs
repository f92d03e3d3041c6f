//! A landmark on another day: how well its map patch fits where it is, and where else it fits.

use super::TemplateFeatures;
use super::distinctness::standard_deviation;
use super::features::{FeatureTemplate, Features};
use super::oriented;
use super::patch::FLAT_CONTRAST;
use super::peak::{best_peaks, refine};
use super::rehearsed::{MOST_BLANK, OFF_PIXELS, RehearsalFit, blank};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};

/// Longer side of the patch, pixels, to within half an octave.
const PIXELS: f64 = 32.0;
/// Pixels between a place and its nearest rival.
const RIVAL_PIXELS: usize = 3;
/// Grey levels by which two pictures of the same ground differ beyond what the rehearsal knows: sensor,
/// compression, exposure over the picture, another camera. Measured on recorded flights: patches of
/// less contrast than this were hardly ever found.
const OTHER_PICTURE: f64 = 8.0;
/// Looks for the patch `bounds` of `map` on `day` within `radius` metres, by these features.
///
/// `None` if the patch is flat, lies partly beyond the map or has a hole in it.
pub fn rehearse(
    map: &dyn Imagery,
    day: &dyn Imagery,
    bounds: &GroundRect,
    radius: f64,
    features: TemplateFeatures,
) -> Option<RehearsalFit> {
    if features == TemplateFeatures::Orientation {
        return oriented::rehearse(map, day, bounds, radius);
    }
    // On the grid of tiles of the map: neighbouring places then share the ground that was drawn for one.
    let native = map.native_gsd();
    let octaves = (bounds.width().max(bounds.height()) / PIXELS / native).log2();
    let gsd = native * octaves.round().max(0.0).exp2();
    let pixels = |metres: f64| ((metres / gsd).round() as usize).max(8);
    let (width, height) = (pixels(bounds.width()), pixels(bounds.height()));
    let reach = (radius / gsd).ceil() as usize;
    let corner = (
        (bounds.north / gsd).round() * gsd,
        (bounds.west / gsd).round() * gsd,
    );
    let center = GroundPoint::new(
        corner.0 - 0.5 * height as f64 * gsd,
        corner.1 + 0.5 * width as f64 * gsd,
    );
    let window = |reach: usize| Window {
        north_edge: corner.0 + reach as f64 * gsd,
        west_edge: corner.1 - reach as f64 * gsd,
        gsd,
        width: width + 2 * reach,
        height: height + 2 * reach,
    };
    let patch = map.window(&window(0));
    if patch.pixels().iter().any(|p| p[3] < 255) || blank(&patch) > MOST_BLANK {
        return None;
    }
    let patch = patch.to_gray();
    let contrast = standard_deviation(&patch);
    if contrast < FLAT_CONTRAST {
        return None;
    }
    // Noise of another picture takes its share of every correlation.
    let kept = contrast / contrast.hypot(OTHER_PICTURE);
    let template = FeatureTemplate::new(&Features::new(patch))?;
    let surface = template.correlate(&Features::new(day.window(&window(reach)).to_gray()));
    let peaks = best_peaks(&surface, RIVAL_PIXELS, 2);
    let place = |column: f64, row: f64| {
        GroundPoint::new(
            center.north - (row - reach as f64) * gsd,
            center.east + (column - reach as f64) * gsd,
        )
    };
    let best = peaks.first()?;
    let (offset, score) = refine(&surface, best.column, best.row);
    let found = place(best.column as f64 + offset.x, best.row as f64 + offset.y);
    let drift = found.distance(&center);
    let rival = peaks.get(1);
    if drift > OFF_PIXELS * gsd {
        return Some(RehearsalFit {
            score: 0.0,
            rival: kept * score,
            rival_place: found,
            drift,
        });
    }
    Some(RehearsalFit {
        score: kept * score,
        rival: kept * rival.map_or(0.0, |p| f64::from(p.score)),
        rival_place: rival.map_or(center, |p| place(p.column as f64, p.row as f64)),
        drift,
    })
}

#[cfg(test)]
mod tests {
    use pilotage_raster::raster::{Raster, Rgba};

    use super::*;

    /// A ground with a fence of posts every 4 m along a straight edge, and one house.
    struct Fence;

    impl Imagery for Fence {
        fn name(&self) -> &'static str {
            "fence"
        }
        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::default(), 400.0, 400.0)
        }
        fn native_gsd(&self) -> f64 {
            0.25
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |column, row| {
                let p = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let post = p.north.abs() < 1.5 && p.east.rem_euclid(4.0) < 1.0;
                let house = (p.north + 60.0).abs() < 9.0 && (p.east - 10.0).abs() < 6.0;
                let chimney = (p.north + 57.0).abs() < 2.0 && (p.east - 13.0).abs() < 1.5;
                let grey = match (chimney, house, post, p.north > 0.0) {
                    (true, ..) => 30,
                    (_, true, ..) => 210,
                    (_, _, true, _) => 60,
                    (.., true) => 150,
                    _ => 110,
                };
                [grey, grey, grey, 255]
            })
        }
    }

    #[test]
    fn a_fence_has_a_rival_one_post_further_on_and_a_house_has_none() {
        let at =
            |north: f64, east: f64| GroundRect::centered(GroundPoint::new(north, east), 30.0, 30.0);
        let fence = rehearse(
            &Fence,
            &Fence,
            &at(0.0, 0.0),
            20.0,
            TemplateFeatures::Brightness,
        )
        .unwrap();
        assert!(fence.margin(0.85) < 0.0, "{fence:?}");
        let step = fence.rival_place.distance(&GroundPoint::default());
        assert!(
            (step.rem_euclid(4.0)).min(4.0 - step.rem_euclid(4.0)) < 1.0,
            "{step}"
        );
        let house = rehearse(
            &Fence,
            &Fence,
            &at(-60.0, 10.0),
            20.0,
            TemplateFeatures::Brightness,
        )
        .unwrap();
        assert!(house.margin(0.85) > 0.3, "{house:?}");
        assert!(house.drift < 0.3, "{house:?}");
    }

    #[test]
    fn by_orientation_a_fence_has_a_stronger_rival_than_a_house() {
        let by = TemplateFeatures::Orientation;
        let at = |north: f64, east: f64| {
            let bounds = GroundRect::centered(GroundPoint::new(north, east), 30.0, 30.0);
            rehearse(&Fence, &Fence, &bounds, 20.0, by).unwrap()
        };
        let (fence, house) = (at(0.0, 0.0), at(-60.0, 10.0));
        assert!(fence.rival > house.rival + 0.2, "{fence:?} {house:?}");
        assert!(house.score > 0.9 && house.drift < 0.3, "{house:?}");
    }
}
