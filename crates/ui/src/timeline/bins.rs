//! A run summed up per pixel of the timeline, growing with the run.

use std::ops::Add;

use pilotage_core::navigator::{FrameReport, Run, StepReport, UpdateReport};

/// Age from which pictures and readings are none of the moment any more, seconds.
const RECENT: f64 = 3.0;

/// Number of corrections: by landmarks, by whole pictures and by readings of aids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CorrectionCounts {
    /// Those that corrected the estimate.
    pub accepted: usize,
    /// Those that were refused.
    pub refused: usize,
}

impl Add for CorrectionCounts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            accepted: self.accepted + other.accepted,
            refused: self.refused + other.refused,
        }
    }
}

impl CorrectionCounts {
    /// Landmarks of a picture, and the picture itself where its place as a whole was asked.
    fn of_picture(frame: &FrameReport) -> Self {
        let landmarks = frame.accepted().count();
        let is_whole = frame.joint.is_some() && landmarks == 0;
        let laid = frame.laid.as_ref();
        let is_refused = laid.is_some_and(|laid| !laid.is_believed());
        Self {
            accepted: landmarks + usize::from(is_whole),
            refused: frame.candidates.len() - landmarks + usize::from(is_refused),
        }
    }

    fn of_readings(step: &StepReport) -> Self {
        let all = step.updates.len();
        let accepted = step
            .updates
            .iter()
            .filter(|it| UpdateReport::is_accepted(it));
        let accepted = accepted.count();
        Self {
            accepted,
            refused: all - accepted,
        }
    }

    /// Everything in a step.
    fn of(step: &StepReport) -> Self {
        let pictures = step.frame.iter().map(Self::of_picture);
        pictures.fold(Self::of_readings(step), Self::add)
    }

    /// The latest picture and the latest readings at `time`, seconds, of those that are not long past; `None` without
    /// either.
    pub fn at(run: &Run, time: f64) -> Option<Self> {
        let steps = &run.steps[..=run.index_at(time)?];
        let recent = || {
            let steps = steps.iter().rev();
            steps.take_while(|step| time - step.time < RECENT)
        };
        let picture = recent().find_map(|step| step.frame.as_ref());
        let readings = recent().find(|step| !step.updates.is_empty());
        let of_picture = picture.map(Self::of_picture);
        let of_readings = readings.map(Self::of_readings);
        of_picture.into_iter().chain(of_readings).reduce(Self::add)
    }
}

/// Events within one pixel of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventBin {
    /// Corrections, used and refused.
    pub corrections: CorrectionCounts,
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
            bin.corrections = bin.corrections + CorrectionCounts::of(step);
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
    use nalgebra::{DMatrix, Point3, dvector};
    use pilotage_core::frames::{Attitude, GroundPoint, Pose};
    use pilotage_core::navigator::{
        Control, Estimate, JointReport, NavigatorSettings, RegistrationReport, SigmaSets,
        StepTiming,
    };
    use pilotage_core::registration::RegistrationMethod;

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

    fn run_of(steps: Vec<StepReport>) -> Run {
        Run {
            name: "test".to_owned(),
            settings: NavigatorSettings::default(),
            landmarks: Vec::new(),
            state_names: Vec::new(),
            steps,
        }
    }

    #[test]
    fn readings_of_aids_count_as_accepted_or_refused() {
        let gain = || Some(DMatrix::zeros(2, 1));
        let run = run_of(vec![step(1.0, gain()), step(2.0, None), step(9.0, gain())]);
        let mut bins = Bins::default();
        bins.follow(&run, 1, (0.0, 10.0), 2);
        let counted: Vec<_> = bins
            .bins()
            .iter()
            .map(|bin| (bin.corrections.accepted, bin.corrections.refused))
            .collect();
        assert_eq!(counted, [(1, 1), (1, 0)]);
    }

    fn accepted(accepted: usize) -> CorrectionCounts {
        CorrectionCounts {
            accepted,
            refused: 0,
        }
    }

    /// A picture whose place as a whole corrected the estimate.
    fn whole_picture() -> FrameReport {
        FrameReport {
            index: 0,
            assumed_pose: Pose {
                position_in_world: Point3::origin(),
                attitude: Attitude::level(0.0),
            },
            footprint: Vec::new(),
            candidates: Vec::new(),
            joint: Some(JointReport {
                nis: 1.0,
                degrees_of_freedom: 2,
                threshold: 11.6,
                gain: DMatrix::zeros(2, 2),
                innovation: dvector![0.5, 0.5],
                innovation_covariance: DMatrix::identity(2, 2),
                recovered: None,
            }),
            laid: None,
            trouble: None,
        }
    }

    #[test]
    fn a_picture_laid_as_a_whole_counts_as_one_correction() {
        let mut frame = whole_picture();
        assert_eq!(CorrectionCounts::of_picture(&frame), accepted(1));
        frame.joint = None;
        assert_eq!(CorrectionCounts::of_picture(&frame), accepted(0));
        frame.laid = Some(RegistrationReport {
            place: None,
            refusal: Some("too few patches agree".to_owned()),
            refused_as: None,
            laid_by: RegistrationMethod::default(),
            tried: 12,
            log_false_alarms: -1.0,
            probability: None,
        });
        assert_eq!(CorrectionCounts::of_picture(&frame).refused, 1);
    }

    #[test]
    fn a_moment_is_told_of_the_latest_picture_and_readings_until_they_are_long_past() {
        let seconds = (0..20).map(|i| StepReport {
            updates: Vec::new(),
            ..step(f64::from(i), None)
        });
        let mut run = run_of(seconds.collect());
        let told = 4.0;
        run.steps[4].frame = Some(whole_picture());
        let of_picture = accepted(1);
        assert_eq!(CorrectionCounts::at(&run, told + 2.9), Some(of_picture));
        assert_eq!(CorrectionCounts::at(&run, told + 3.1), None);
        run.steps[5].updates = step(0.0, Some(DMatrix::zeros(2, 1))).updates;
        let both = CorrectionCounts::at(&run, told + 2.0);
        assert_eq!(both, Some(of_picture + accepted(1)));
        let reading = CorrectionCounts::at(&run, told + 3.5);
        assert_eq!(reading, Some(accepted(1)));
        assert_eq!(CorrectionCounts::at(&run, -1.0), None);
    }
}
