//! A cascade shown every window of a picture at every scale.

use super::model::Cascade;
use super::rows::{BATCH, RowsOfWindows, Scratch};
use super::scale::resized;
use pilotage_raster::raster::Raster;

/// Choice of the windows to look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanSettings {
    /// Ratio of one scale to the one before it, over 1.
    pub scale_step: f64,
    /// Smallest window, width and height, pixels; zero is no limit.
    pub least: (usize, usize),
    /// Largest window, width and height, pixels; zero is no limit.
    pub greatest: (usize, usize),
    /// Part of the picture to search, as if there were no more of it.
    pub region: Option<Rectangle>,
    /// Pixels, of the copy of each scale, from one window to the next; zero for OpenCV's ways: two
    /// below scale two and one from there on, and none behind one that the first stage refuses.
    pub stride: usize,
    /// Number of the last stages that may refuse a window that is still told of.
    pub spare: usize,
}

impl Default for ScanSettings {
    fn default() -> Self {
        Self {
            scale_step: 1.1,
            least: (0, 0),
            greatest: (0, 0),
            region: None,
            stride: 0,
            spare: 0,
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
    /// Part of the rectangle that lies in a picture of that size; by rounding, a window can leave it by some
    /// pixels.
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

/// A window that passed every stage, or nearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scanned {
    /// The window in the picture.
    pub rectangle: Rectangle,
    /// Sum of the votes of the last stage that it met.
    pub score: f64,
    /// Stages that it passed.
    pub stages: usize,
    /// Sum over the stages that it met of votes less threshold: how well it did, among windows that
    /// met as many.
    pub margin: f64,
}

/// Every window of `picture` that passes, scale by scale, row by row: with the default settings those
/// that OpenCV's `detectMultiScale` finds before it groups them.
pub fn scan(cascade: &Cascade, picture: &Raster<u8>, settings: &ScanSettings) -> Vec<Scanned> {
    let mut found = Vec::new();
    if let Some(region) = settings.region {
        let region = region.within(picture.width(), picture.height());
        let size = [region.width, region.height].map(|side| side.max(0) as usize);
        if size[0] == 0 || size[1] == 0 {
            return found;
        }
        let part = picture.crop(region.x as usize, region.y as usize, size[0], size[1]);
        let settings = ScanSettings {
            region: None,
            ..*settings
        };
        found = part.map_or_else(Vec::new, |part| scan(cascade, &part, &settings));
        for window in &mut found {
            window.rectangle.x += region.x;
            window.rectangle.y += region.y;
        }
        return found;
    }
    let mut scratch = Scratch::default();
    for scale in scales(cascade, picture, settings) {
        let stride = settings.stride;
        let level = ScanLevel {
            cascade,
            scale,
            stride,
            spare: settings.spare,
        };
        level.scan(picture, &mut scratch, &mut found);
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

/// A scale, and which windows of it are looked at.
struct ScanLevel<'a> {
    cascade: &'a Cascade,
    scale: f32,
    stride: usize,
    spare: usize,
}

impl ScanLevel<'_> {
    /// Shows every window of a smaller copy of `picture`.
    fn scan(&self, picture: &Raster<u8>, scratch: &mut Scratch, found: &mut Vec<Scanned>) {
        let (cascade, scale) = (self.cascade, self.scale);
        let side = |s: usize| f64::from(s as f32 / scale).round_ties_even() as usize;
        let copy = resized(picture, side(picture.width()), side(picture.height()));
        // Large windows are shown at every pixel of their small copy.
        let stride = match self.stride {
            0 if scale >= 2.0 => 1,
            0 => 2,
            stride => stride,
        };
        let step = if stride % 2 == 0 { 2 } else { 1 };
        let every = (self.stride > 0).then_some(stride / step);
        let rows = RowsOfWindows::new(cascade, &copy, step, scratch);
        let round = |v: f32| v.round_ties_even() as i32;
        let enough = cascade.stages.len().saturating_sub(self.spare);
        let mut ends = Vec::new();
        for y in (0..rows.height).step_by(stride * BATCH) {
            let ys = (y..rows.height).step_by(stride).take(BATCH);
            ends.clear();
            rows.show(ys, every, scratch, |seen| {
                let stages = seen.stage + usize::from(seen.passed);
                if stages >= enough && (!seen.passed || stages == cascade.stages.len()) {
                    ends.push((seen, stages));
                }
            });
            ends.sort_by_key(|(seen, _)| seen.place);
            for (seen, stages) in &ends {
                let (number, y) = rows.position(seen.place);
                found.push(Scanned {
                    rectangle: Rectangle {
                        x: round((number * step) as f32 * scale),
                        y: round(y as f32 * scale),
                        width: round(cascade.width as f32 * scale),
                        height: round(cascade.height as f32 * scale),
                    },
                    score: seen.votes,
                    stages: *stages,
                    margin: seen.margin,
                });
            }
        }
        rows.end(scratch);
    }
}
