//! Distinctness of a box of the map: its correlation with the map around it.

use super::features::{FeatureTemplate, Features};
use super::patch::FLAT_CONTRAST;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Gray, refine_peak, rival_peak};

/// Longer side of the patch, pixels: the scale at which the detector searches first.
const COARSE_PIXELS: f64 = 32.0;
/// Longest side of the searched window, pixels.
const LONGEST_SIDE: f64 = 512.0;

/// Distinctness of a box before it ever was seen from the air.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchDistinctness {
    /// Score of the patch with its centre at every place around the box, -1 to 1.
    pub surface: Gray,
    /// Ground that the surface covers.
    pub surface_rect: GroundRect,
    /// Centre of the strongest look-alike, and its score.
    pub look_alike: Option<(GroundPoint, f64)>,
    /// Standard deviation of the patch's grey values, 0 to 255.
    pub contrast: f64,
    /// Whether the detector refuses the patch as flat.
    pub flat: bool,
}

/// Compares the box `bounds` of `map` with everything within `radius` metres of it.
///
/// Places closer than half the box's longer side to its centre are the box itself.
///
/// ```
/// use pilotage_base::frames::{GroundPoint, GroundRect};
/// use pilotage_vision::landmark::distinctness;
/// # use pilotage_base::georeference::GroundFromPixel;
/// # use pilotage_raster::{imagery::GeoreferencedPicture, raster::Raster};
/// # let is_wide = |x: usize| [140, 220].iter().any(|c| (*c..c + 12).contains(&x));
/// # let is_house = |x: usize, y: usize| (140..152).contains(&y) && is_wide(x);
/// # let grey = |x, y| if is_house(x, y) { 200 } else { 90 };
/// # let ground = Raster::from_fn(400, 300, |x, y| [grey(x, y), grey(x, y), grey(x, y), 255]);
/// # let place = GroundFromPixel::north_up(GroundPoint::new(146.0, -146.0), 1.0);
/// # let map = GeoreferencedPicture::new("two houses", ground, place).ok_or("no area")?;
///
/// // Two houses that look the same, 80 m from each other.
/// let house = GroundRect::centered(GroundPoint::new(0.0, 0.0), 32.0, 32.0);
/// let (other, score) = distinctness(&map, &house, 100.0).look_alike.ok_or("alone")?;
/// assert!(other.distance(&GroundPoint::new(0.0, 80.0)) < 0.5);
/// assert!(score > 0.999);
/// # Ok::<(), &str>(())
/// ```
pub fn distinctness(map: &dyn Imagery, bounds: &GroundRect, radius: f64) -> PatchDistinctness {
    let longer = bounds.width().max(bounds.height());
    let gsd = (longer / COARSE_PIXELS)
        .max(map.native_gsd())
        .max((longer + 2.0 * radius) / LONGEST_SIDE);
    let pixels = |metres: f64| ((metres / gsd).round() as usize).max(8);
    let (width, height) = (pixels(bounds.width()), pixels(bounds.height()));
    let reach = (radius / gsd).ceil() as usize;
    let center = bounds.center();
    let window = Window {
        north_edge: center.north + (0.5 * height as f64 + reach as f64) * gsd,
        west_edge: center.east - (0.5 * width as f64 + reach as f64) * gsd,
        gsd,
        width: width + 2 * reach,
        height: height + 2 * reach,
    };
    let around = map.window(&window).to_gray();
    // The patch lies `reach` pixels inside its window.
    let patch = around
        .crop(reach, reach, width, height)
        .unwrap_or_else(|| Gray::filled(width, height, 0.0));
    let contrast = standard_deviation(&patch);
    // Centres of the pixels of the surface are centres of the patch.
    let corner = window.ground_at(0.5 * width as f64 - 0.5, 0.5 * height as f64 - 0.5);
    let side = (2 * reach + 1) as f64 * gsd;
    let surface_rect = GroundRect {
        north: corner.north,
        south: corner.north - side,
        west: corner.east,
        east: corner.east + side,
    };
    let flat = contrast < FLAT_CONTRAST;
    let template = if flat {
        None
    } else {
        FeatureTemplate::new(&Features::new(patch))
    };
    let Some(template) = template else {
        return PatchDistinctness {
            surface: Gray::filled(2 * reach + 1, 2 * reach + 1, 0.0),
            surface_rect,
            look_alike: None,
            contrast,
            flat: true,
        };
    };
    let surface = template.correlate(&Features::new(around));
    let own = 0.5 * width.max(height) as f64;
    // The box itself lies in the middle; a look-alike may score as high to the last digit.
    let itself = refine_peak(&surface, reach, reach);
    let look_alike = rival_peak(&surface, &itself, own).map(|rival| {
        let (column, row) = rival.sample;
        let at = window.ground_at(
            column as f64 + 0.5 * width as f64,
            row as f64 + 0.5 * height as f64,
        );
        (at, f64::from(surface.get(column, row)))
    });
    PatchDistinctness {
        surface,
        surface_rect,
        look_alike,
        contrast,
        flat: false,
    }
}

pub(super) fn standard_deviation(patch: &Gray) -> f64 {
    let count = patch.pixels().len().max(1) as f64;
    let values = || patch.pixels().iter().map(|v| f64::from(*v));
    let mean = values().sum::<f64>() / count;
    (values().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_raster::raster::{Raster, Rgba};

    /// Grey ground with bright crosses at some places, one metre per pixel at the finest.
    struct Crosses(Vec<GroundPoint>);

    impl Imagery for Crosses {
        fn name(&self) -> &'static str {
            "crosses"
        }

        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::new(0.0, 0.0), 2000.0, 2000.0)
        }

        fn native_gsd(&self) -> f64 {
            0.25
        }

        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |c, r| {
                let p = window.ground_at(c as f64 + 0.5, r as f64 + 0.5);
                let arm = |a: f64, b: f64| a.abs() < 8.0 && b.abs() < 2.0;
                let bright = self.0.iter().any(|q| {
                    let (n, e) = (p.north - q.north, p.east - q.east);
                    arm(n, e) || arm(e, n)
                });
                let v = if bright { 220 } else { 90 };
                [v, v, v, 255]
            })
        }
    }

    fn box_at(north: f64, east: f64) -> GroundRect {
        GroundRect::centered(GroundPoint::new(north, east), 24.0, 24.0)
    }

    #[test]
    fn a_second_cross_is_found_as_the_look_alike_of_the_first() {
        let twin = GroundPoint::new(40.0, -55.0);
        let map = Crosses(vec![GroundPoint::new(10.0, 20.0), twin]);
        let found = distinctness(&map, &box_at(10.0, 20.0), 100.0);
        let (place, score) = found.look_alike.unwrap();
        assert!(place.distance(&twin) < 1.5, "{place:?}");
        assert!(score > 0.9, "{score}");
        assert!(!found.flat);
    }

    #[test]
    fn a_lone_cross_has_no_look_alike_worth_the_name() {
        let map = Crosses(vec![GroundPoint::new(0.0, 0.0)]);
        let found = distinctness(&map, &box_at(0.0, 0.0), 80.0);
        assert!(found.look_alike.is_none_or(|(_, score)| score < 0.6));
    }

    #[test]
    fn bare_ground_is_flat() {
        let found = distinctness(&Crosses(Vec::new()), &box_at(0.0, 0.0), 80.0);
        assert!(found.flat && found.look_alike.is_none());
    }

    #[test]
    fn the_surface_has_its_summit_where_the_box_lies() {
        let map = Crosses(vec![GroundPoint::new(0.0, 0.0)]);
        let found = distinctness(&map, &box_at(0.0, 0.0), 60.0);
        let middle = found.surface_rect.center();
        assert!(middle.distance(&GroundPoint::new(0.0, 0.0)) < 1e-6);
        let (width, height) = (found.surface.width(), found.surface.height());
        let top = found.surface.get(width / 2, height / 2);
        assert!(top > 0.999, "{top}");
        assert!(found.surface.pixels().iter().all(|v| *v <= top + 1e-5));
    }
}
