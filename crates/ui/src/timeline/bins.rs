//! A run summed up per pixel of the timeline, growing with the run.

use pilotage_core::navigator::{Outcome, Run, UpdateReport};

/// Events within one pixel of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventBin {
    /// Landmarks and readings of aids that corrected the estimate.
    pub accepted: u32,
    /// Landmarks and readings of aids that were refused.
    pub refused: u32,
    /// Largest standard deviation of the position, metres; zero without a step.
    pub deviation: f32,
}

/// The bins of a run over a span of time.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    key: (u64, usize, u64, u64),
    used: usize,
    columns: Vec<EventBin>,
    largest: f32,
}

impl Bins {
    /// Brings the bins up to date; only new steps are looked at, unless the run, the span or the
    /// width changed.
    pub fn follow(&mut self, run: &Run, generation: u64, span: (f64, f64), width: usize) {
        let key = (generation, width, span.0.to_bits(), span.1.to_bits());
        if self.key != key || self.used > run.steps.len() {
            *self = Self {
                key,
                columns: vec![EventBin::default(); width.max(1)],
                ..Self::default()
            };
        }
        let scale = width as f64 / (span.1 - span.0).max(1e-9);
        for step in &run.steps[self.used..] {
            let index = ((step.time - span.0) * scale).max(0.0) as usize;
            let last = self.columns.len() - 1;
            let bin = &mut self.columns[index.min(last)];
            let deviation = step.after.position_covariance().trace().max(0.0).sqrt() as f32;
            bin.deviation = bin.deviation.max(deviation);
            self.largest = self.largest.max(deviation);
            let landmarks = step.frame.iter().flat_map(|f| &f.candidates);
            let landmarks = landmarks.map(|candidate| candidate.outcome == Outcome::Accepted);
            let readings = step.updates.iter().map(UpdateReport::is_accepted);
            for is_accepted in landmarks.chain(readings) {
                if is_accepted {
                    bin.accepted += 1;
                } else {
                    bin.refused += 1;
                }
            }
        }
        self.used = run.steps.len();
    }

    /// Bins, each of a pixel.
    pub fn bins(&self) -> &[EventBin] {
        &self.columns
    }

    /// The largest standard deviation, metres.
    pub fn largest(&self) -> f32 {
        self.largest
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, dvector};
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::navigator::{
        Control, Estimate, NavigatorSettings, SigmaSets, StepReport, StepTiming,
    };

    use super::*;

    fn step(time: f64, gain: Option<DMatrix<f64>>) -> StepReport {
        let estimate = Estimate {
            mean: dvector![0.0, 0.0],
            covariance: DMatrix::identity(2, 2),
        };
        StepReport {
            time,
            dt: 1.0,
            control: Control {
                airspeed: None,
                heading: 0.0,
                roll: 0.0,
                pitch: 0.0,
                height: 0.0,
            },
            before: estimate.clone(),
            predicted: estimate.clone(),
            after: estimate,
            sigma: SigmaSets {
                before_predict: DMatrix::zeros(2, 5),
                after_predict: DMatrix::zeros(2, 5),
                before_correct: None,
                after_correct: None,
            },
            dead_reckoned: GroundPoint::default(),
            doubts: Vec::new(),
            frame: None,
            timing: StepTiming::default(),
            updates: vec![UpdateReport {
                aid: "ground-range".to_owned(),
                measured: dvector![120.0],
                innovation: dvector![0.5],
                innovation_covariance: DMatrix::identity(1, 1),
                nis: 0.25,
                degrees_of_freedom: 1,
                threshold: 8.8,
                gain,
            }],
            sightings: Vec::new(),
        }
    }

    #[test]
    fn readings_of_aids_count_as_accepted_or_refused() {
        let gain = || Some(DMatrix::zeros(2, 1));
        let run = Run {
            name: "test".to_owned(),
            settings: NavigatorSettings::default(),
            landmarks: Vec::new(),
            state_names: Vec::new(),
            steps: vec![step(1.0, gain()), step(2.0, None), step(9.0, gain())],
        };
        let mut bins = Bins::default();
        bins.follow(&run, 1, (0.0, 10.0), 2);
        let counted: Vec<_> = bins
            .bins()
            .iter()
            .map(|bin| (bin.accepted, bin.refused))
            .collect();
        assert_eq!(counted, [(1, 1), (1, 0)]);
    }
}
