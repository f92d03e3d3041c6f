//! The ground around a place on other days, and the part of a picture that shows it.

use std::sync::Arc;

use nalgebra::Point2;

use pilotage_base::frames::GroundRect;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::{CachedImagery, Imagery, InsetImagery};

/// Memory for the ground around a place on a day, megabytes.
const CACHE_MEGABYTES: usize = 24;

/// The ground on several days, of which only what is asked for is drawn; further out the map does. Clones
/// share what is drawn by then.
#[derive(Clone)]
pub struct DayGround {
    map: Arc<dyn Imagery>,
    days: Vec<Arc<dyn Imagery>>,
    /// Rectangle of each day that is drawn, and that part.
    parts: Vec<Option<(GroundRect, Arc<dyn Imagery>)>>,
}

impl DayGround {
    /// Of `map` on `days`, which need not be kept where they were looked at.
    pub fn new(map: Arc<dyn Imagery>, days: &[Arc<dyn Imagery>]) -> Self {
        Self {
            map,
            parts: vec![None; days.len()],
            days: days.to_vec(),
        }
    }

    /// Number of days.
    pub fn days(&self) -> usize {
        self.days.len()
    }

    /// The ground on a day, of that day at least within `needed`.
    pub fn part(&mut self, day: usize, needed: &GroundRect) -> Arc<dyn Imagery> {
        match &self.parts[day] {
            Some((rect, part)) if rect.contains_rect(needed) => Arc::clone(part),
            _ => {
                let (shown, map) = (Arc::clone(&self.days[day]), Arc::clone(&self.map));
                let inset = Arc::new(InsetImagery::new(shown, *needed, map));
                let part = Arc::new(CachedImagery::new(inset, CACHE_MEGABYTES));
                self.parts[day] = Some((*needed, part.clone()));
                part
            }
        }
    }
}

/// The part of the picture within `half` pixels of `middle`, as a camera of its own.
pub fn crop(camera: &CameraModel, middle: &Point2<f64>, half: f64) -> CameraModel {
    let span = |middle: f64, size: usize| {
        let low = (middle - half).floor().max(0.0);
        let high = (middle + half).ceil().min(size as f64);
        (low, high - low)
    };
    let (left, width) = span(middle.x, camera.width);
    let (top, height) = span(middle.y, camera.height);
    CameraModel {
        width: width as usize,
        height: height as usize,
        principal: Point2::new(camera.principal.x - left, camera.principal.y - top),
        ..camera.clone()
    }
}
