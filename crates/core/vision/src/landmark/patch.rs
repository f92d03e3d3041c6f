//! Map patches of landmarks, cut once and kept ready at the scales and turns that are used.

use std::collections::HashMap;
use std::sync::Arc;

use super::Landmark;
use super::features::{FeatureTemplate, Features};
use super::look_alike::{LookAlike, LookAlikes};
use super::peak::{best_peaks, separation};
use super::window::window_around;
use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{Gray, bilinear};

/// Standard deviation of grey values (0 to 255) below which a patch counts as flat.
pub const FLAT_CONTRAST: f64 = 4.0;

/// Steps of scale levels per octave.
const LEVELS_PER_OCTAVE: f64 = 2.0;

/// The quantised ground sample distance at or above `gsd`, as a level number.
pub fn level_of(gsd: f64) -> i32 {
    (gsd.log2() * LEVELS_PER_OCTAVE - 1e-9).ceil() as i32
}

/// Ground sample distance of a level, metres per pixel.
pub fn gsd_of(level: i32) -> f64 {
    (f64::from(level) / LEVELS_PER_OCTAVE).exp2()
}

/// A landmark's surroundings on the map at one scale.
pub struct PatchLevel {
    /// Metres per pixel.
    pub gsd: f64,
    /// Patch size, pixels.
    pub size: (usize, usize),
    /// Standard deviation of the patch's grey values.
    pub contrast: f64,
    /// Score of the strongest look-alike on the map within one patch size around: a place that scores
    /// no better in a picture may as well be the look-alike.
    pub look_alike: Option<f64>,
    look_alikes: LookAlikes,
    surroundings: Gray,
    templates: HashMap<(i32, i32), Option<Arc<FeatureTemplate>>>,
    patches: HashMap<(i32, i32), Arc<Gray>>,
}

/// Standard deviation of a picture's values.
pub(super) fn deviation(picture: &Gray) -> f64 {
    let n = picture.pixels().len().max(1) as f64;
    let mean = picture.pixels().iter().map(|v| f64::from(*v)).sum::<f64>() / n;
    let squares = picture
        .pixels()
        .iter()
        .map(|v| (f64::from(*v) - mean).powi(2));
    (squares.sum::<f64>() / n).sqrt()
}

impl PatchLevel {
    fn new(map: &dyn Imagery, bounds: &GroundRect, gsd: f64) -> Self {
        let pixels = |metres: f64| ((metres / gsd).round() as usize).max(8);
        let size = (pixels(bounds.width()), pixels(bounds.height()));
        let half = (0.5 * (size.0 as f64).hypot(size.1 as f64) * 1.06).ceil() + 2.0;
        let center = bounds.center();
        let side = 2 * half as usize;
        let window = window_around(center, gsd, (side, side), (0, 0));
        let surroundings = map.window(&window).to_gray();
        let mut level = Self {
            gsd,
            size,
            contrast: 0.0,
            look_alike: None,
            look_alikes: LookAlikes::default(),
            surroundings,
            templates: HashMap::new(),
            patches: HashMap::new(),
        };
        level.contrast = deviation(&level.patch(0.0, 1.0));
        level
    }

    /// Finds the strongest look-alike on the map around `bounds`, once.
    pub fn find_look_alike(&mut self, map: &dyn Imagery, bounds: &GroundRect) -> f64 {
        if let Some(known) = self.look_alike {
            return known;
        }
        let window = window_around(bounds.center(), self.gsd, self.size, self.size);
        let around = Features::new(map.window(&window).to_gray());
        let score = self.template(0.0, 1.0).map_or(0.0, |template| {
            let surface = template.correlate(&around);
            best_peaks(&surface, separation(self.size), 2)
                .get(1)
                .map_or(0.0, |p| f64::from(p.score))
        });
        self.look_alike = Some(score);
        score
    }

    /// Finds the look-alikes on the map out to `reach` metres around `bounds`.
    fn find_look_alikes(
        &mut self,
        map: &dyn Imagery,
        bounds: &GroundRect,
        reach: f64,
    ) -> &[LookAlike] {
        let Some(template) = self.template(0.0, 1.0) else {
            return &[];
        };
        self.look_alikes
            .find(map, bounds, (&template, self.size), self.gsd, reach)
    }

    /// Luminance of the patch turned by `rotation` (radians clockwise) and enlarged by `scale`.
    pub fn patch(&mut self, rotation: f64, scale: f64) -> Arc<Gray> {
        let (surroundings, size) = (&self.surroundings, self.size);
        let make = || {
            let middle = 0.5 * surroundings.width() as f64;
            let (sin, cos) = rotation.sin_cos();
            Arc::new(Gray::from_fn(size.0, size.1, |column, row| {
                let x = (column as f64 + 0.5 - 0.5 * size.0 as f64) / scale;
                let y = (row as f64 + 0.5 - 0.5 * size.1 as f64) / scale;
                let (u, v) = (middle + cos * x + sin * y, middle - sin * x + cos * y);
                bilinear(surroundings, u as f32, v as f32).unwrap_or(0.0)
            }))
        };
        Arc::clone(
            self.patches
                .entry(key(rotation, scale))
                .or_insert_with(make),
        )
    }

    /// The same as a template, `None` if it is flat.
    pub fn template(&mut self, rotation: f64, scale: f64) -> Option<Arc<FeatureTemplate>> {
        let key = key(rotation, scale);
        if let Some(known) = self.templates.get(&key) {
            return known.clone();
        }
        let features = Features::new(self.patch(rotation, scale).as_ref().clone());
        let template = FeatureTemplate::new(&features).map(Arc::new);
        self.templates.insert(key, template.clone());
        template
    }
}

/// Turns to a tenth of a milliradian and scales to a ten-thousandth are the same patch.
fn key(rotation: f64, scale: f64) -> (i32, i32) {
    (
        (rotation * 1e4).round() as i32,
        (scale * 1e4).round() as i32,
    )
}

/// The patches of all landmarks, made on first use.
pub struct PatchBank {
    map: Arc<dyn Imagery>,
    levels: HashMap<(u32, i32), (GroundRect, PatchLevel)>,
}

impl PatchBank {
    /// Patches from `map`.
    pub fn new(map: Arc<dyn Imagery>) -> Self {
        Self {
            map,
            levels: HashMap::new(),
        }
    }

    /// Finest ground sample distance that the map carries, metres per pixel.
    pub fn native_gsd(&self) -> f64 {
        self.map.native_gsd()
    }

    /// Score of the landmark's strongest look-alike around it on the map, at a scale level.
    pub fn look_alike(&mut self, landmark: &Landmark, level: i32) -> f64 {
        let map = Arc::clone(&self.map);
        self.level(landmark, level)
            .find_look_alike(map.as_ref(), &landmark.bounds)
    }

    /// Places of the map within `reach` metres that look like the landmark, at a scale level.
    pub(super) fn look_alikes(
        &mut self,
        landmark: &Landmark,
        level: i32,
        reach: f64,
    ) -> &[LookAlike] {
        let map = Arc::clone(&self.map);
        self.level(landmark, level)
            .find_look_alikes(map.as_ref(), &landmark.bounds, reach)
    }

    /// The landmark at a scale level; a box that has changed since is cut anew.
    pub fn level(&mut self, landmark: &Landmark, level: i32) -> &mut PatchLevel {
        let map = self.map.as_ref();
        let fresh = || {
            (
                landmark.bounds,
                PatchLevel::new(map, &landmark.bounds, gsd_of(level)),
            )
        };
        let entry = self
            .levels
            .entry((landmark.id, level))
            .or_insert_with(fresh);
        if entry.0 != landmark.bounds {
            *entry = fresh();
        }
        &mut entry.1
    }
}
