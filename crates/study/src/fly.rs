//! Flights of a study, without pictures: landmarks are found as often and as well as the settings say.

use std::collections::BTreeMap;

use pilotage_core::landmark::Landmark;
use pilotage_core::simulate::Scenario;
use serde::{Deserialize, Serialize};

use super::design::StudyDesign;
use super::plan::{StudyError, StudyPlan, refusal};
use super::run_settings::RunSettings;

/// Outcome of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyRow {
    /// Number of the run.
    pub run: u64,
    /// Numbers that were measured, in the order of the plan; `None` where there is no such number.
    pub measured: Vec<Option<f64>>,
}

/// Study ready to be flown: its runs, and the scenarios that they need.
pub struct Study {
    design: StudyDesign,
    /// Landmarks by scenario.
    landmarks: BTreeMap<String, Vec<Landmark>>,
}

impl Study {
    /// The study of a plan.
    ///
    /// # Errors
    /// Where it names a scenario that there is not.
    pub fn new(plan: StudyPlan) -> Result<Self, StudyError> {
        let (mut landmarks, mut map) = (BTreeMap::new(), None);
        for name in scenarios(&plan) {
            let scenario = Scenario::named(&name)
                .ok_or_else(|| refusal("scenario", format!("there is no \"{name}\"")))?;
            let map = map.get_or_insert_with(Scenario::map);
            landmarks.insert(name, scenario.mission_over(map).landmarks);
        }
        let design = StudyDesign::new(plan);
        Ok(Self { design, landmarks })
    }

    /// The design.
    pub fn design(&self) -> &StudyDesign {
        &self.design
    }

    /// Flies run number `number`. The same number gives the same row to the bit, whoever flies it and when.
    ///
    /// ```
    /// use pilotage_study::{Study, StudyPlan};
    ///
    /// let study = Study::new(StudyPlan::read(r#"
    ///     name = "offset"
    ///     question = "What becomes of a wrong start without landmarks?"
    ///     draws = 1
    ///     fixed = { seconds = 5, wind-speed = 0, found = 0, offset-north = 300, offset-east = 400 }
    ///     measure = [{ of = "error-rms" }, { of = "places-used" }]
    /// "#)?)?;
    /// // √(300² + 400²), but for what the sensors add in five seconds.
    /// let row = study.fly(0)?;
    /// assert!((row.measured[0].unwrap_or_default() - 500.0).abs() < 20.0);
    /// assert_eq!(row.measured[1], Some(0.0));
    /// # Ok::<(), pilotage_study::StudyError>(())
    /// ```
    ///
    /// # Errors
    /// Where its settings make no sense.
    pub fn fly(&self, number: u64) -> Result<StudyRow, StudyError> {
        let run = self.design.run(number)?;
        let flight = run.flight();
        let landmarks = match flight.of_scenario() {
            Some(scenario) => self
                .landmarks
                .get(scenario)
                .ok_or_else(|| refusal("scenario", format!("\"{scenario}\" is not laid out")))?,
            None => &[][..],
        };
        let observed = flight.observe(landmarks);
        let measured = self.design.plan().measure.iter();
        let measured = measured.map(|measure| observed.measure(measure));
        Ok(StudyRow {
            run: number,
            measured: measured.collect(),
        })
    }
}

/// Names of all scenarios that a plan may fly; none where it flies missions.
fn scenarios(plan: &StudyPlan) -> Vec<String> {
    let names = plan.values_of("scenario");
    if names.is_empty() && plan.values_of("mission").is_empty() {
        return vec![RunSettings::default().scenario];
    }
    names
}

#[cfg(test)]
mod tests {
    use pilotage_core::navigator::summarize;

    use super::*;
    use crate::measure::MeasureKind;
    use crate::observed::numbers_of;
    use crate::plan::StudyMeasure;

    fn study(more: &str) -> Study {
        let plan = format!(
            r#"
            name = "test"
            question = "?"
            seed = 9
            draws = 4
            {more}
            draw.wind-speed = {{ uniform = [0, 8] }}
            measure = [{{ of = "error-rms" }}, {{ of = "error-max" }}, {{ of = "nees" }}]
            "#
        );
        Study::new(StudyPlan::read(&plan).unwrap()).unwrap()
    }

    #[test]
    fn what_is_observed_step_by_step_is_what_the_navigator_sums_up_of_the_whole_run() {
        let study = study("fixed = { seconds = 40, mount-shake = 1 }");
        let run = study.design.run(2).unwrap();
        let landmarks = &study.landmarks["distinct-400ft-wind"];
        let prepared = run.flight().prepare().unwrap();
        let flight = &prepared.flight;
        let begun = prepared.stated.begin(flight, landmarks, &prepared.settings);
        let (navigator, mut frames) = begun.unwrap();
        let flown = navigator.fly(&mut frames, &|| 0.0).unwrap();
        let summary = summarize(flight, &flown, None);
        let observed = run.flight().observe(landmarks);
        assert_eq!(observed.numbers(), numbers_of(flight, &flown));
        let number = |of| {
            let (name, at_most) = (None, None);
            observed
                .measure(&StudyMeasure { of, name, at_most })
                .unwrap()
        };
        let (error, wind) = (
            summary.position_error_m.unwrap(),
            summary.wind_error_mps.unwrap(),
        );
        let nis = summary.nis.unwrap();
        for (of, expected) in [
            (MeasureKind::ErrorRms, error.rms),
            (MeasureKind::ErrorMax, error.max),
            (MeasureKind::WindErrorRms, wind.rms),
            (
                MeasureKind::ReckonedMax,
                summary.dead_reckoning_error_m.unwrap().max,
            ),
            (MeasureKind::Nees, summary.nees.unwrap().mean),
            (MeasureKind::Nis, nis.mean / nis.dof),
            (MeasureKind::Frames, summary.frames_with_update as f64),
            (MeasureKind::Accepted, summary.updates_accepted as f64),
            (MeasureKind::Wrong, summary.updates_wrong.unwrap() as f64),
        ] {
            let is_equal = (number(of) - expected).abs() <= 1e-9 * expected.abs();
            assert!(is_equal, "{of:?}: {} and {expected}", number(of));
        }
        assert!(number(MeasureKind::Frames) > 20.0);
    }

    #[test]
    fn a_run_is_the_same_whoever_flies_it_and_others_are_others() {
        let plan = "fixed = { seconds = 10, wind-scatter = 1, walk-roll = 0.2, step = 0.2 }";
        let (one, other) = (study(plan), study(plan));
        // Backwards, and by another.
        let rows: Vec<StudyRow> = (0..4).rev().map(|run| one.fly(run).unwrap()).collect();
        for row in &rows {
            assert_eq!(&other.fly(row.run).unwrap(), row);
        }
        assert_ne!(rows[0].measured, rows[1].measured);
    }

    #[test]
    fn an_aid_that_measures_the_velocity_finds_the_wind_where_no_landmark_can_be_recognised() {
        let error = |aids: &str| {
            let fixed = format!(
                "fixed = {{ seconds = 40, recognised = 0, wind-from = 90, step = 0.2, aids = \"{aids}\" }}"
            );
            let study = study(&fixed);
            (0..3)
                .filter_map(|run| study.fly(run).unwrap().measured[1])
                .sum::<f64>()
                / 3.0
        };
        let (alone, aided, located) = (error("none"), error("gps-velocity"), error("gps-position"));
        assert!(aided < 0.5 * alone, "{aided} {alone}");
        assert!(located < 15.0 && located < aided.max(15.0), "{located}");
    }

    #[test]
    fn a_filter_that_is_not_told_of_a_larger_noise_believes_more_than_is_so() {
        let nees = |told: &str| {
            let fixed = format!(
                "fixed = {{ seconds = 40, bias-heading = 4, noise-attitude = 2, told = \"{told}\" }}"
            );
            let study = study(&fixed);
            (0..4)
                .filter_map(|run| study.fly(run).unwrap().measured[2])
                .sum::<f64>()
                / 4.0
        };
        let (told, untold) = (nees("yes"), nees("no"));
        assert!(untold > 2.0 * told, "{untold} {told}");
    }
}
