//! Map patches of landmarks as orientation fields, in the turns and sizes that are looked for.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Point2;

use super::variants::{PatchVariant, PatchVariants};
use crate::landmark::Landmark;
use crate::landmark::look_alike::LookAlike;
use crate::landmark::patch::deviation;
use crate::landmark::window::window_around;
use crate::texture::Texture;
use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{ChannelTemplate, Gray, warp_similar};

/// Pixels across the longer side of a landmark.
pub(super) const ACROSS: f64 = 38.0;
/// Pixels around the patch that decide what is a strong edge in it.
const MARGIN: f64 = 16.0;
/// Turned and enlarged, a patch needs so much more of the map.
const LARGEST: f64 = 1.5;

/// A landmark's patch of the map at one scale.
pub(super) struct OrientedPatch {
    /// The landmark's box.
    pub bounds: GroundRect,
    /// Metres per pixel.
    pub gsd: f64,
    /// Pixels.
    pub size: (usize, usize),
    /// Standard deviation of the patch's grey values.
    pub contrast: f64,
    surroundings: Gray,
    covered: Gray,
    templates: HashMap<(u64, PatchVariant), Option<Arc<ChannelTemplate>>>,
    /// Ground that looks like it, and how far that was looked for, metres.
    pub(super) twins: (f64, Vec<LookAlike>),
}

impl OrientedPatch {
    /// Cuts the patch out of `map`.
    pub fn new(map: &dyn Imagery, bounds: &GroundRect, gsd: f64) -> Self {
        let pixels = |metres: f64| ((metres / gsd).round() as usize).max(8);
        let size = (pixels(bounds.width()), pixels(bounds.height()));
        let half = 0.5 * (size.0 as f64).hypot(size.1 as f64) + 1.5 * MARGIN;
        let half = (LARGEST * half).ceil();
        let center = bounds.center();
        let side = 2 * half as usize;
        let window = window_around(center, gsd, (side, side), (0, 0));
        let picture = map.window(&window);
        let surroundings = picture.to_gray();
        let (left, top) = (half as usize - size.0 / 2, half as usize - size.1 / 2);
        let own = surroundings.crop(left, top, size.0, size.1);
        Self {
            bounds: *bounds,
            gsd,
            size,
            contrast: own.map_or(0.0, |own| deviation(&own)),
            covered: picture.map(|p| if p[3] == 255 { 1.0 } else { 0.0 }),
            surroundings,
            templates: HashMap::new(),
            twins: (0.0, Vec::new()),
        }
    }

    /// Turns and sizes to be tried for these deviations (radians, and of the logarithm of the size).
    pub fn variants(&self, turn_deviation: f64, log_scale_deviation: f64) -> PatchVariants {
        let half = 0.25 * (self.size.0 + self.size.1) as f64;
        PatchVariants::new(half, turn_deviation, log_scale_deviation)
    }

    /// Luminance in a variant with `margin` pixels around it, and what of it the map covers.
    fn warped(&self, angle: f64, scale: f64, margin: usize) -> Option<(Gray, Gray)> {
        let middle = Point2::new(
            0.5 * self.surroundings.width() as f64,
            0.5 * self.surroundings.height() as f64,
        );
        let (width, height) = (self.size.0 + 2 * margin, self.size.1 + 2 * margin);
        let warp = |of: &Gray| warp_similar(of, &middle, -angle, scale, width, height);
        let covered = warp(&self.covered)?.map(|c| if c > 0.99 { 1.0 } else { 0.0 });
        Some((warp(&self.surroundings)?, covered))
    }

    /// Luminance of the patch as the map has it.
    pub fn luminance(&self) -> Gray {
        let own = self.warped(0.0, 1.0, 0);
        own.map_or_else(|| Gray::filled(0, 0, 0.0), |(own, _)| own)
    }

    /// The patch in a variant; `None` if nothing stands out, or it is too large for what is known around it.
    pub fn template(
        &mut self,
        variants: &PatchVariants,
        variant: PatchVariant,
    ) -> Option<Arc<ChannelTemplate>> {
        let key = (variants.step.to_bits(), variant);
        if let Some(known) = self.templates.get(&key) {
            return known.clone();
        }
        let made = self.make(variants.turn(variant), variants.log_scale(variant).exp());
        self.templates.insert(key, made.clone());
        made
    }

    fn make(&self, angle: f64, scale: f64) -> Option<Arc<ChannelTemplate>> {
        let margin = MARGIN as usize;
        let (luminance, covered) = self.warped(angle, scale, margin)?;
        let (channels, covered) = Texture::EdgesAndContrast.channels(&luminance, covered, 0);
        let own = |of: &Gray| of.crop(margin, margin, self.size.0, self.size.1);
        let channels: Option<Vec<Gray>> = channels.iter().map(own).collect();
        ChannelTemplate::new(&channels?, &own(&covered)?).map(Arc::new)
    }
}

/// The patches of all landmarks, made on first use.
pub(super) struct OrientedBank {
    map: Arc<dyn Imagery>,
    patches: HashMap<(u32, u64), OrientedPatch>,
}

impl OrientedBank {
    /// Patches from `map`.
    pub fn new(map: Arc<dyn Imagery>) -> Self {
        Self {
            map,
            patches: HashMap::new(),
        }
    }

    /// Finest ground sample distance that the map carries, metres per pixel.
    pub fn native_gsd(&self) -> f64 {
        self.map.native_gsd()
    }

    /// Ground that looks like the landmark at `gsd`, within `reach` metres to each side.
    pub fn twins(&mut self, landmark: &Landmark, gsd: f64, reach: f64) -> &[LookAlike] {
        let map = Arc::clone(&self.map);
        self.patch(landmark, gsd).twins(map.as_ref(), reach)
    }

    /// The landmark at `gsd`; a box that has changed since is cut anew.
    pub fn patch(&mut self, landmark: &Landmark, gsd: f64) -> &mut OrientedPatch {
        let map = self.map.as_ref();
        let fresh = || OrientedPatch::new(map, &landmark.bounds, gsd);
        let key = (landmark.id, gsd.to_bits());
        let patch = self.patches.entry(key).or_insert_with(fresh);
        if patch.bounds != landmark.bounds {
            *patch = fresh();
        }
        patch
    }
}
