//! A cascade shown every window of a picture at every scale.

use super::model::Cascade;
use super::rows::{BATCH, Rows, Scratch};
use super::scale::resized;
use crate::raster::Raster;

/// Which windows are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanSettings {
    /// Ratio of one scale to the one before it, over 1.
    pub scale_step: f64,
    /// Smallest window, width and height, pixels; zero is no limit.
    pub least: (usize, usize),
    /// Largest window, width and height, pixels; zero is no limit.
    pub greatest: (usize, usize),
}

impl Default for ScanSettings {
    fn default() -> Self {
        Self {
            scale_step: 1.1,
            least: (0, 0),
            greatest: (0, 0),
        }
    }
}

/// A rectangle of a picture, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rectangle {
    /// Left edge.
    pub x: i32,
    /// Upper edge.
    pub y: i32,
    /// Width.
    pub width: i32,
    /// Height.
    pub height: i32,
}

impl Rectangle {
    /// What of it lies in a picture of that size; by rounding, a window can leave it by some pixels.
    #[must_use]
    pub fn within(&self, width: usize, height: usize) -> Self {
        let (x, y) = (self.x.max(0), self.y.max(0));
        Self {
            x,
            y,
            width: (self.x + self.width).min(width as i32) - x,
            height: (self.y + self.height).min(height as i32) - y,
        }
    }
}

/// A window that passed every stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scanned {
    /// The window in the picture.
    pub rectangle: Rectangle,
    /// Sum of the votes of the last stage.
    pub score: f64,
}

/// Every window of `picture` that passes, scale by scale, row by row: those that OpenCV's
/// `detectMultiScale` finds before it groups them.
pub fn scan(cascade: &Cascade, picture: &Raster<u8>, settings: &ScanSettings) -> Vec<Scanned> {
    let mut found = Vec::new();
    let mut scratch = Scratch::default();
    for scale in scales(cascade, picture, settings) {
        scan_level(cascade, picture, scale, &mut scratch, &mut found);
    }
    found
}

/// Scales at which the window fits into the picture and the settings.
fn scales(cascade: &Cascade, picture: &Raster<u8>, settings: &ScanSettings) -> Vec<f32> {
    let limit = |(w, h): (usize, usize)| match (w, h) {
        (0, _) | (_, 0) => (picture.width(), picture.height()),
        limit => limit,
    };
    let greatest = limit(settings.greatest);
    let window = |factor: f64| {
        let side = |s: usize| (s as f64 * factor).round_ties_even() as usize;
        (side(cascade.width), side(cascade.height))
    };
    let mut scales = Vec::new();
    // A step that goes nowhere is taken for one scale alone.
    let step = if settings.scale_step > 1.0 {
        settings.scale_step
    } else {
        f64::INFINITY
    };
    let mut factor = 1.0;
    loop {
        let (w, h) = window(factor);
        if w > picture.width() || h > picture.height() {
            break;
        }
        let scale = factor as f32;
        let (w, h) = window(f64::from(scale));
        if w > greatest.0 || h > greatest.1 {
            break;
        }
        if w >= settings.least.0 && h >= settings.least.1 {
            scales.push(scale);
        }
        factor *= step;
    }
    scales
}

/// Shows every window of a smaller copy of `picture`.
fn scan_level(
    cascade: &Cascade,
    picture: &Raster<u8>,
    scale: f32,
    scratch: &mut Scratch,
    found: &mut Vec<Scanned>,
) {
    let side = |s: usize| f64::from(s as f32 / scale).round_ties_even() as usize;
    let copy = resized(picture, side(picture.width()), side(picture.height()));
    // Large windows are shown at every pixel of their small copy.
    let step = if scale >= 2.0 { 1 } else { 2 };
    let rows = Rows::new(cascade, &copy, step, scratch);
    let round = |v: f32| v.round_ties_even() as i32;
    let Some((end, before)) = cascade.stages.split_last() else {
        return;
    };
    let (last, least) = (before.len(), f64::from(end.threshold));
    for y in (0..rows.height).step_by(step * BATCH) {
        let ys = (y..rows.height).step_by(step).take(BATCH);
        rows.show(ys, true, scratch, |stage, place, votes| {
            if stage == last && votes >= least {
                let (number, y) = rows.position(place);
                found.push(Scanned {
                    rectangle: Rectangle {
                        x: round((number * step) as f32 * scale),
                        y: round(y as f32 * scale),
                        width: round(cascade.width as f32 * scale),
                        height: round(cascade.height as f32 * scale),
                    },
                    score: votes,
                });
            }
        });
    }
    rows.end(scratch);
}
