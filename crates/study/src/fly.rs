//! Flights of a study, without pictures: landmarks are found as often and as well as the settings say.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::{Matrix4, Vector4};
use pilotage_core::flight::{Channel, ChannelName, Flight};
use pilotage_core::frames::wrap_pi;
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::{ChosenAid, Navigator, NavigatorSettings};
use pilotage_core::plan::{
    DetectionStatistics, ExpectedDetection, PlannedLandmark, StatedFrames, as_stated, with_walk,
};
use pilotage_core::simulate::{Overrides, Scenario, Wind};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use super::design::{StudyDesign, StudyRun};
use super::fault::{as_seen, damage};
use super::observed::Observed;
use super::philox::Stream;
use super::plan::{StudyError, StudyPlan, refusal};
use super::run_settings::RunSettings;
use super::value::{SettingDistribution, SettingValue};

/// Time between two readings of an aid, seconds, where the aid does not say another.
const READING_APART: f64 = 1.0;

/// Outcome of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyRow {
    /// Number of the run.
    pub run: u64,
    /// Numbers that were measured, in the order of the plan; `None` where there is no such number.
    pub measured: Vec<Option<f64>>,
}

/// A scenario laid out.
struct LaidScenario {
    scenario: Scenario,
    landmarks: Vec<Landmark>,
}

/// Study ready to be flown: its runs, and the scenarios that they need.
pub struct Study {
    design: StudyDesign,
    laid: BTreeMap<String, LaidScenario>,
}

impl Study {
    /// The study of a plan.
    ///
    /// # Errors
    /// Where it names a scenario that there is not.
    pub fn new(plan: StudyPlan) -> Result<Self, StudyError> {
        let map = Scenario::map();
        let mut laid = BTreeMap::new();
        for name in scenarios(&plan) {
            let scenario = Scenario::named(&name)
                .ok_or_else(|| refusal("scenario", format!("there is no \"{name}\"")))?;
            let landmarks = scenario.mission_over(&map).landmarks;
            laid.insert(
                name,
                LaidScenario {
                    scenario,
                    landmarks,
                },
            );
        }
        let design = StudyDesign::new(plan);
        Ok(Self { design, laid })
    }

    /// The design.
    pub fn design(&self) -> &StudyDesign {
        &self.design
    }

    /// Flies run number `number`. The same number gives the same row to the bit, whoever flies it and when.
    ///
    /// # Errors
    /// Where its settings make no sense.
    pub fn fly(&self, number: u64) -> Result<StudyRow, StudyError> {
        let run = self.design.run(number)?;
        let laid = self.laid.get(&run.settings.scenario).ok_or_else(|| {
            refusal(
                "scenario",
                format!("\"{}\" is not laid out", run.settings.scenario),
            )
        })?;
        let observed = observe(&run, laid);
        let measured = self.design.plan().measure.iter();
        let measured = measured.map(|measure| observed.measure(measure));
        Ok(StudyRow {
            run: number,
            measured: measured.collect(),
        })
    }
}

/// Names of all scenarios that a plan may fly.
fn scenarios(plan: &StudyPlan) -> Vec<String> {
    const KEY: &str = "scenario";
    let drawn = match plan.draw.get(KEY) {
        Some(SettingDistribution::Choice(values)) => &values[..],
        _ => &[],
    };
    let crossed = plan.cross.get(KEY).map_or(&[][..], Vec::as_slice);
    let values = plan.fixed.get(KEY).into_iter().chain(crossed).chain(drawn);
    let mut names: Vec<String> = values.map(SettingValue::to_string).collect();
    if names.is_empty() {
        names.push(RunSettings::default().scenario);
    }
    names
}

/// Flies the run, and observes it; nothing is observed of a flight that the filter gives up.
fn observe(run: &StudyRun, laid: &LaidScenario) -> Observed {
    let Some((flight, mut navigator, mut frames)) = prepare(run, laid) else {
        return Observed::default();
    };
    let mut observed = Observed::of(navigator.run_head());
    while let Some(step) = navigator.advance(&mut frames, &|| 0.0) {
        let Ok(step) = step else {
            return Observed::default();
        };
        observed.take(&flight, &step);
    }
    observed
}

/// The flight of a run, its navigator at the start, and its frames; `None` where it cannot begin.
fn prepare(run: &StudyRun, laid: &LaidScenario) -> Option<(Arc<Flight>, Navigator, StatedFrames)> {
    let settings = &run.settings;
    let mut scenario = laid.scenario.clone();
    scenario.height = settings.height.unwrap_or(scenario.height);
    scenario.wind = Wind {
        speed: settings.wind_speed.unwrap_or(scenario.wind.speed),
        from: settings.wind_from.unwrap_or(scenario.wind.from),
    };
    let overrides = Overrides {
        sensors: Some(settings.sensors),
        ..Overrides::default()
    };
    let mut plan = scenario.plan(&overrides);
    plan.longest = settings.seconds;
    if settings.wind_scatter > 0.0 {
        plan = plan.in_wind_of(run.seeds.of(Stream::Wind), settings.wind_scatter);
        scenario.wind = Wind::of_velocity(&plan.wind);
    }
    let mut flight = plan.simulate(run.seeds.of(Stream::Flight))?;
    for (instrument, deviation) in &settings.walks {
        // The errors of two instruments walk each by itself.
        let seed = run.seeds.of(Stream::Walk) ^ *instrument as u64;
        flight = with_walk(flight, *instrument, *deviation, seed);
    }
    read_aids(&mut flight, run);
    damage(&mut flight, settings);

    let planned = planned(&laid.landmarks, settings);
    let seen = as_seen(&flight, settings);
    let seen = seen.as_ref().unwrap_or(&flight);
    let (detector, frames) = as_stated(seen, &planned, run.seeds.of(Stream::Detection))?;
    let flight = Arc::new(flight);
    let navigator = Navigator::with_detector(
        Arc::clone(&flight),
        &laid.landmarks,
        Box::new(detector),
        &navigation(&scenario, run),
    );
    let mut navigator = navigator.ok()?;
    if !settings.doubts {
        navigator = navigator.trusting();
    }
    Some((flight, navigator, frames))
}

/// Landmarks with what is stated of them.
fn planned(landmarks: &[Landmark], settings: &RunSettings) -> Vec<PlannedLandmark> {
    let deviations = Vector4::new(settings.place, settings.place, settings.turn, settings.turn);
    let expected = ExpectedDetection {
        recognised: settings.recognised,
        per_frame: settings.per_frame,
        covariance: Matrix4::from_diagonal(&deviations.map(|deviation| deviation * deviation)),
    };
    let planned = landmarks.iter().map(|landmark| PlannedLandmark {
        landmark: landmark.clone(),
        detection: DetectionStatistics::everywhere(expected),
    });
    planned.collect()
}

/// Settings of the navigator: as in the scenario, where the run says no other.
fn navigation(scenario: &Scenario, run: &StudyRun) -> NavigatorSettings {
    let of_run = &run.settings;
    let told = if of_run.is_told {
        of_run.sensors
    } else {
        RunSettings::default().sensors
    };
    let mut settings = scenario.navigator(&told);
    settings.vehicle = of_run.vehicle.unwrap_or(settings.vehicle);
    settings.estimator.choice = of_run.estimator;
    settings.estimator.particles.seed = run.seeds.of(Stream::Estimator);
    settings.start.wind = of_run.start_wind.unwrap_or(settings.start.wind);
    settings.alpha = of_run.alpha.unwrap_or(settings.alpha);
    settings.gate_confidence = of_run.gate.unwrap_or(settings.gate_confidence);
    settings.measurement_scale = of_run.measurement_scale;
    settings.shortest_step = of_run.step;
    // Aids of the scenario look at pictures.
    settings.aids = of_run
        .aids
        .iter()
        .map(|key| ChosenAid::usual(key))
        .collect();
    settings
}

/// Gives the flight the channels of the chosen aids: the truth with the error that the aid takes for granted.
fn read_aids(flight: &mut Flight, run: &StudyRun) {
    let Some(truth) = flight.truth.clone() else {
        return;
    };
    for info in run.settings.chosen_aids() {
        let of = |key: &str| info.numbers.iter().find(|number| number.key == key);
        let noise = of("noise").map_or(0.0, |number| number.usual);
        let apart = of("apart").map_or(READING_APART, |number| number.usual);
        let per_reading = (apart / 0.05).round().max(1.0) as usize;
        for name in info.channels {
            let seed = run.seeds.of(Stream::Aid) ^ *name as u64;
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let readings = (0..truth.states.len()).step_by(per_reading);
            let (times, values) = readings
                .filter_map(|index| {
                    let state = &truth.states[index];
                    let next = truth.states.get(index + 1)?;
                    let moved = (next.position - state.position) / (next.time - state.time);
                    let error: f64 = StandardNormal.sample(&mut random);
                    let value = match name {
                        ChannelName::GpsNorth => state.position.x,
                        ChannelName::GpsEast => state.position.y,
                        ChannelName::GpsVelocityNorth => moved.x,
                        ChannelName::GpsVelocityEast => moved.y,
                        ChannelName::MagneticHeading => state.attitude?.yaw,
                        _ => return None,
                    };
                    let value = value + noise * error;
                    let value = if name.is_angle() {
                        wrap_pi(value)
                    } else {
                        value
                    };
                    Some((state.time, value))
                })
                .unzip();
            flight.channels.push(Channel {
                name: *name,
                times,
                values,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::navigator::summarize;

    use super::*;
    use crate::measure::MeasureKind;
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
        let laid = &study.laid["distinct-400ft-wind"];
        let (flight, navigator, mut frames) = prepare(&run, laid).unwrap();
        let flown = navigator.fly(&mut frames, &|| 0.0).unwrap();
        let summary = summarize(&flight, &flown, None);
        let observed = observe(&run, laid);
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
