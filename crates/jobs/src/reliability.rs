//! A place rehearsed and then passed over again and again: whether it is found as often as was said.

use pilotage_core::plan::{Assessor, ExpectedDetection, LookTally, Pass, Rehearsal};
use pilotage_core::simulate::SensorSpec;

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::{Advance, AssessmentOrder, JobEvent, RunningJob, WorkerState};

/// Passes over each place, each on a day of its own.
const PASSES: usize = 10;
/// Seed of the first held-out day, far from any that is rehearsed.
const FIRST_DAY: u64 = 550_000;

/// Place to be rehearsed on some days and passed over on others: event `Figures` with its [`Pass`]es, of which
/// there are none if it does not fit into the picture.
///
/// What a place looks like is settled by the day, so each pass over it is on another, and places do not share
/// theirs: passes count as independent only if nothing ties them together.
pub struct ReliabilityOrder {
    /// The place, and how it is looked for; its seed is that of all places.
    pub about: AssessmentOrder,
    /// Speed of the passes over ground, m/s.
    pub speed: f64,
}

impl ReliabilityOrder {
    /// Passes over a place.
    pub const PASSES: usize = PASSES;

    /// The same place, looked at with another seed.
    fn with_seed(&self, seed: u64) -> AssessmentOrder {
        AssessmentOrder {
            seed,
            ..self.about.clone()
        }
    }

    /// Detection that is expected of the place.
    ///
    /// Each is rehearsed on days of its own: with the same ones for all, their luck would be that of every bin.
    fn said(&self, worker: &mut WorkerState) -> Result<Option<ExpectedDetection>, String> {
        let about = &self.about;
        let seed = about.seed.wrapping_mul(1_000_003) + u64::from(about.landmark.id);
        let days = Rehearsal::days(worker.others(&about.map)?.as_ref(), seed);
        let mut assessor = self.with_seed(seed).assessor(worker, &days)?;
        assessor.rehearse();
        Ok(assessor.expected())
    }

    /// Pass over the place on a day.
    fn pass(
        &self,
        worker: &mut WorkerState,
        said: &ExpectedDetection,
        number: usize,
    ) -> Result<Pass, String> {
        let about = &self.about;
        let of_place = about.seed * 1000 + u64::from(about.landmark.id);
        let seed = FIRST_DAY + of_place * 100 + number as u64;
        let day = [worker.others(&about.map)?.drawn(seed)];
        let mut assessor: Assessor = self.with_seed(!seed).assessor(worker, &day)?;
        let tally =
            LookTally::of(&assessor.pass(self.speed, 1.0 / SensorSpec::default().frame_rate));
        Ok(Pass {
            predicted: said.probability(),
            frames: tally.looks,
            found: tally.found,
            wrong: tally.wrong,
        })
    }
}

/// A place being passed over; a pass is a slice.
struct PassOver {
    order: ReliabilityOrder,
    said: Option<ExpectedDetection>,
    passes: Vec<Pass>,
}

impl RunningJob for PassOver {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let done = match self.said {
            None => {
                self.said = self.order.said(worker)?;
                self.said.is_none()
            }
            Some(said) => {
                let pass = self.order.pass(worker, &said, self.passes.len())?;
                self.passes.push(pass);
                self.passes.len() == PASSES
            }
        };
        if !done {
            return Ok(Advance::More);
        }
        emit(JobEvent::of_figures(&self.passes)?);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for ReliabilityOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.about.map))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(PassOver {
            order: self,
            said: None,
            passes: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::simulate::Scenario;

    use super::*;
    use crate::MapSource;
    use crate::running::figures;

    fn passes(height: f64) -> Vec<Pass> {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mission = scenario.mission();
        figures(ReliabilityOrder {
            about: AssessmentOrder {
                map: MapSource::world("countryside"),
                landmark: mission.landmarks[0].clone(),
                camera: Scenario::camera(),
                height,
                navigator: mission.navigator,
                ground_down: 0.0,
                seed: 1,
            },
            speed: 19.0,
        })
    }

    #[test]
    fn a_landmark_is_found_about_as_often_as_was_said_and_one_that_does_not_fit_is_not_passed_over()
    {
        let all = passes(Scenario::named("distinct-400ft-calm").unwrap().height);
        assert_eq!(all.len(), ReliabilityOrder::PASSES);
        assert!(all.iter().all(|pass| pass.predicted == all[0].predicted));
        let frames: usize = all.iter().map(|pass| pass.frames).sum();
        let found: usize = all.iter().map(|pass| pass.found).sum();
        let share = found as f64 / frames as f64;
        assert!(
            frames > 20 && (share - all[0].predicted).abs() < 0.35,
            "{all:?}"
        );
        assert_eq!(passes(20.0), []);
    }
}
