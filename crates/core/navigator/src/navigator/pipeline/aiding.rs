//! Aids beside pictures: what they observed in a step, shown to all filters.

use super::super::aids::{Aid, AidMoment, Taken, take};
use super::super::observation::Observation;
use super::super::{StepReport, UpdateReport};
use super::Navigator;
use pilotage_estimation::filter::{FilterError, Gate};

impl Navigator {
    /// Takes in what the aids observed since `from`, seconds, after whatever a frame did in this step.
    ///
    /// Filters that assume something else of the pictures, or follow another place, are shown the same, and gain or
    /// lose by it.
    pub(super) fn take_aids(
        &mut self,
        from: f64,
        report: &mut StepReport,
    ) -> Result<(), FilterError> {
        let moment = AidMoment {
            flight: &self.flight,
            from,
            until: self.time,
        };
        let observed = |aid: &mut Box<dyn Aid>| {
            let observations = aid.observe(&moment);
            observations
                .into_iter()
                .map(|observation| (aid.info().key, observation))
                .collect()
        };
        let observed: Vec<Vec<(&str, Observation<'static>)>> =
            self.aids.iter_mut().map(observed).collect();
        let input = self.inputs.between(&self.flight, self.time, self.time);
        let gate = Gate {
            confidence: self.settings.gate_confidence,
        };
        for (aid, observation) in observed.into_iter().flatten() {
            self.engine.look_now(&input);
            let Some(taken) = take(self.engine.as_mut(), &observation, gate)? else {
                continue;
            };
            let own = taken.log_likelihood;
            if let Some(lag) = &mut self.lag {
                lag.take(&observation, (&input, gate, own))?;
            }
            if let Some(second) = &mut self.second {
                second.take(&observation, (&input, gate))?;
            }
            self.possible.take(&observation, (&input, gate, own))?;
            report
                .updates
                .push(UpdateReport::of(aid, &observation, &taken));
            if let Some(step) = taken.step {
                report.aided_by(step);
            }
        }
        if let Some(likeliest) = self.possible.are_open().then(|| self.engine.state()) {
            report.after = self.possible.likeliest(&likeliest).unwrap_or(likeliest);
        }
        Ok(())
    }
}

impl UpdateReport {
    /// Report of what a filter did with an observation of `aid`.
    fn of(aid: &str, observation: &Observation<'_>, taken: &Taken) -> Self {
        Self {
            aid: aid.to_owned(),
            measured: observation.measured.clone(),
            innovation: taken.innovation.innovation.clone(),
            innovation_covariance: taken.innovation.covariance.clone(),
            nis: taken.verdict.nis,
            degrees_of_freedom: taken.verdict.dof,
            threshold: taken.verdict.threshold,
            gain: taken.step.as_ref().map(|step| step.gain.clone()),
        }
    }
}
