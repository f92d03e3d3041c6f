//! Stretches of the route on which a landmark is likely to be found, packed into few lanes.

use pilotage_core::plan::PredictionSample;
use pilotage_core::sorting::sort;

/// Below this probability a landmark counts as out of view.
const SEEN: f64 = 0.02;
/// A landmark may be out of view for as many samples without a blip of its own.
const GAP: usize = 6;

/// Stretch with a landmark in view.
#[derive(Clone, Debug, PartialEq)]
pub struct Blip {
    /// Index of the landmark in the prediction.
    pub landmark: usize,
    /// First and last sample in view.
    pub samples: [usize; 2],
    /// Largest probability.
    pub best: f64,
    /// The lane it lies in, from the top.
    pub lane: usize,
}

/// Every time that a landmark is in view, in lanes where none lies over another. `extent` says from where to where a
/// blip reaches with the words beside it.
pub fn blips(
    samples: &[PredictionSample],
    extent: impl Fn(&Blip) -> (f32, f32),
) -> (Vec<Blip>, usize) {
    let count = samples.first().map_or(0, |s| s.detection.len());
    let mut all = Vec::new();
    for landmark in 0..count {
        let mut open: Option<Blip> = None;
        for (index, sample) in samples.iter().enumerate() {
            let probability = sample.detection[landmark];
            if probability < SEEN {
                continue;
            }
            match &mut open {
                Some(blip) if index <= blip.samples[1] + GAP => {
                    blip.samples[1] = index;
                    blip.best = blip.best.max(probability);
                }
                _ => {
                    all.extend(open.take());
                    open = Some(Blip {
                        landmark,
                        samples: [index, index],
                        best: probability,
                        lane: 0,
                    });
                }
            }
        }
        all.extend(open);
    }
    sort(&mut all, &|a, b| a.samples[0].cmp(&b.samples[0]));
    let mut free_from: Vec<f32> = Vec::new();
    for blip in &mut all {
        let (begin, end) = extent(blip);
        let lane = free_from.iter().position(|free| *free <= begin);
        blip.lane = lane.unwrap_or(free_from.len());
        if blip.lane == free_from.len() {
            free_from.push(end);
        }
        free_from[blip.lane] = end;
    }
    (all, free_from.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::plan::{WorldError, corridor};

    fn samples(detections: &[[f64; 2]]) -> Vec<PredictionSample> {
        let world = WorldError {
            weight: 1.0,
            mean: nalgebra::Vector2::zeros(),
            covariance: nalgebra::Matrix2::identity(),
        };
        let corridor = corridor(&[world], 0.0, 0.95).unwrap();
        let of = |(i, d): (usize, &[f64; 2])| PredictionSample {
            time: i as f64,
            distance: 10.0 * i as f64,
            position: GroundPoint::default(),
            course: 0.0,
            corridor,
            detection: d.to_vec(),
            dead_reckoning: 0.0,
        };
        detections.iter().enumerate().map(of).collect()
    }

    #[test]
    fn landmarks_in_view_together_lie_in_two_lanes_and_later_ones_in_the_first_again() {
        let mut views = vec![[0.0, 0.0]; 30];
        views[2] = [0.5, 0.9];
        views[3] = [0.7, 0.0];
        views[20] = [0.0, 0.4];
        let samples = samples(&views);
        let at = |index: usize| samples[index].distance as f32;
        let (blips, lanes) = blips(&samples, |b| (at(b.samples[0]), at(b.samples[1]) + 15.0));
        assert_eq!(lanes, 2);
        let told: Vec<_> = blips
            .iter()
            .map(|b| (b.landmark, b.samples, b.lane))
            .collect();
        assert_eq!(told, [(0, [2, 3], 0), (1, [2, 2], 1), (1, [20, 20], 0)]);
        assert_eq!(blips[0].best, 0.7);
    }
    #[test]
    fn words_before_a_bar_lie_over_nothing_that_ends_there() {
        let mut views = vec![[0.0, 0.0]; 30];
        views[22] = [0.5, 0.0];
        views[29] = [0.0, 0.9];
        let samples = samples(&views);
        let at = |index: usize| samples[index].distance as f32;
        // The second has its words before it, where those of the first stand.
        let (blips, lanes) = blips(&samples, |b| match b.landmark {
            0 => (at(b.samples[0]), at(b.samples[1]) + 50.0),
            _ => (at(b.samples[0]) - 50.0, at(b.samples[1])),
        });
        assert_eq!(lanes, 2);
        assert_ne!(blips[0].lane, blips[1].lane);
    }
}
