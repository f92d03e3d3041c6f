//! Moments of a flight that the boxes of a map serve.

use super::candidate::LandmarkCandidate;
use super::footprints::Footprints;
use pilotage_base::frames::Pose;
use pilotage_raster::camera::CameraModel;

/// Moments that each candidate serves.
pub(super) struct MomentCover {
    /// Seconds for which each frame stands.
    lasting: Vec<f64>,
    /// For each candidate the frames in which it counts, and the certainty of a fix by it alone.
    worth: Vec<Vec<(usize, f64)>>,
    /// Seconds in which each candidate is in the picture.
    pub in_view: Vec<f64>,
}

impl MomentCover {
    /// Of `candidates` in the pictures that are taken when and where `frames` say; a fix fades over `fading` seconds.
    pub fn new(
        candidates: &[LandmarkCandidate],
        camera: &CameraModel,
        frames: &[(f64, Pose)],
        ground_down: f64,
        fading: f64,
    ) -> Self {
        let mut lasting: Vec<f64> = frames.windows(2).map(|f| f[1].0 - f[0].0).collect();
        // The last frame is worth as much as the one before it.
        lasting.extend(
            lasting
                .last()
                .copied()
                .or((!frames.is_empty()).then_some(1.0)),
        );
        let footprints = Footprints::new(camera, frames, ground_down);
        let mut cover = Self {
            lasting,
            worth: Vec::new(),
            in_view: Vec::new(),
        };
        for candidate in candidates {
            let mut last: Option<f64> = None;
            let (mut worth, mut in_view) = (Vec::new(), 0.0);
            for (f, (time, _)) in frames.iter().enumerate() {
                if footprints.hold(f, &candidate.bounds) {
                    last = Some(*time);
                    in_view += cover.lasting[f];
                }
                let age = last.map_or(f64::INFINITY, |seen| time - seen);
                let left = if age <= 0.0 {
                    1.0
                } else {
                    (-age / fading).exp()
                };
                if left > 1e-3 {
                    worth.push((f, left * candidate.probability()));
                }
            }
            cover.worth.push(worth);
            cover.in_view.push(in_view);
        }
        cover
    }

    /// For each frame the probability that none of `chosen` gives a fix.
    pub fn missed(&self, chosen: &[usize]) -> Vec<f64> {
        let mut missed = vec![1.0; self.lasting.len()];
        for i in chosen {
            self.take(*i, &mut missed);
        }
        missed
    }

    /// Counts a candidate in.
    pub fn take(&self, i: usize, missed: &mut [f64]) {
        for (f, w) in &self.worth[i] {
            missed[*f] *= 1.0 - w;
        }
    }

    /// Sum over the moments that taking a candidate adds to a measure of each.
    pub fn gain(&self, i: usize, missed: &[f64], measure: &dyn Fn(f64) -> f64) -> f64 {
        let gains = self.worth[i].iter().map(|(f, w)| {
            let before = missed[*f];
            (measure(before * (1.0 - w)) - measure(before)) * self.lasting[*f]
        });
        gains.sum()
    }
}
