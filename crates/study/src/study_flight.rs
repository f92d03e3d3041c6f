//! A flight of a study by itself, without the plan: whoever flies it need not read plans.

use std::sync::Arc;

use nalgebra::{Matrix4, Vector4};
use pilotage_core::flight::{Channel, ChannelName, Flight};
use pilotage_core::frames::wrap_pi;
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::{AidInfo, ChosenAid, NavigatorSettings};
use pilotage_core::plan::{ExpectedDetection, with_walk};
use pilotage_core::simulate::{Overrides, Scenario, Wind};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use super::fault::{as_seen, damage};
use super::observed::Observed;
use super::philox::Stream;
use super::run_settings::RunSettings;
use super::seeds::Seeds;
use super::stated_navigation::StatedNavigation;
use super::study_mission::{FlownMission, StudyMission};

/// Time between two readings of an aid, seconds, where the aid does not say another.
const READING_APART: f64 = 1.0;

/// Flight of a study by itself: its settings, and the counter of its random numbers. It is the same to the bit whoever
/// flies it and when.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyFlight {
    /// Settings.
    pub settings: RunSettings,
    pub(crate) seeds: Seeds,
    /// Mission that is flown in place of a scenario.
    pub mission: Option<FlownMission>,
}

/// Flight of a study that was flown, ready to be navigated.
pub struct PreparedFlight {
    /// The flight, as its instruments measured it.
    pub flight: Arc<Flight>,
    /// Settings of the navigator.
    pub settings: NavigatorSettings,
    /// Statement of how landmarks are found.
    pub stated: StatedNavigation,
    /// Mission that is flown in place of a scenario.
    pub mission: Option<StudyMission>,
}

impl StudyFlight {
    /// The scenario whose landmarks it is navigated by; `None` where it has a mission with landmarks of its own.
    pub fn of_scenario(&self) -> Option<&str> {
        let is_own = self.mission.is_some();
        (!is_own).then_some(self.settings.scenario.as_str())
    }

    /// Time that it takes at most in calm air, seconds.
    pub fn lasts(&self) -> f64 {
        let longest = self.longest();
        let mission = self.mission.as_ref();
        mission.map_or(longest, |mission| mission.lasts.min(longest))
    }

    /// Longest time flown, seconds.
    fn longest(&self) -> f64 {
        self.settings.longest(self.mission.is_some())
    }

    /// Its scenario, with the height and the mean wind that it has; `None` where there is no such scenario.
    fn scenario(&self) -> Option<Scenario> {
        let settings = &self.settings;
        let mut scenario = Scenario::named(&settings.scenario)?;
        if self.mission.is_some() {
            scenario.wind = Wind::default();
        }
        scenario.height = settings.height.unwrap_or(scenario.height);
        scenario.wind = Wind {
            speed: settings.wind_speed.unwrap_or(scenario.wind.speed),
            from: settings.wind_from.unwrap_or(scenario.wind.from),
        };
        Some(scenario)
    }

    /// The mean wind in which it flies, without what is added by chance.
    pub fn wind(&self) -> Wind {
        self.scenario().map_or_else(Wind::default, |own| own.wind)
    }

    /// Height above ground at which it flies, metres; `None` where there is no such scenario, or its mission says it.
    pub fn height(&self) -> Option<f64> {
        match self.mission {
            Some(_) => self.settings.height,
            None => Some(self.scenario()?.height),
        }
    }

    /// Settings of its navigator; `None` where there is no such scenario, or its mission says them.
    pub fn navigator(&self) -> Option<NavigatorSettings> {
        self.of_scenario()?;
        Some(self.navigator_in(self.scenario()?, None))
    }

    /// Settings of its navigator in its scenario or mission.
    fn navigator_in(
        &self,
        mut scenario: Scenario,
        mission: Option<&StudyMission>,
    ) -> NavigatorSettings {
        if self.settings.wind_scatter > 0.0 {
            // Any wind: where none is expected, the filter of a scenario takes calm air for granted.
            scenario.wind.speed = scenario.wind.speed.max(self.settings.wind_scatter);
        }
        self.navigation(&scenario, mission)
    }

    /// Settings of the navigator: as in the scenario or mission, where the run says no other.
    fn navigation(&self, scenario: &Scenario, mission: Option<&StudyMission>) -> NavigatorSettings {
        let of_run = &self.settings;
        let tells = of_run.tells(mission.is_some());
        let told = if tells {
            of_run.sensors
        } else {
            RunSettings::default().sensors
        };
        let usual = scenario.navigator(&told);
        let mut settings = match mission {
            None => usual,
            // Who is told of the errors is told of the aircraft that has them.
            Some(mission) if tells => NavigatorSettings {
                vehicle: usual.vehicle,
                start: usual.start,
                process: usual.process,
                sensors: usual.sensors,
                ..mission.navigator().clone()
            },
            Some(mission) => mission.navigator().clone(),
        };
        settings.vehicle = of_run.vehicle.unwrap_or(settings.vehicle);
        settings.estimator.choice = of_run.estimator.unwrap_or(settings.estimator.choice);
        settings.estimator.particles.seed = self.seeds.of(Stream::Estimator);
        settings.start.wind = of_run.start_wind.unwrap_or(settings.start.wind);
        settings.alpha = of_run.alpha.unwrap_or(settings.alpha);
        settings.gate_confidence = of_run.gate.unwrap_or(settings.gate_confidence);
        // Landmarks are found with the stated errors, and with no other.
        settings.sensors.pixel = 0.0;
        settings.sensors.ground = 0.0;
        settings.measurement_scale = of_run
            .measurement_scale
            .unwrap_or(settings.measurement_scale);
        settings.shortest_step = of_run.step.unwrap_or(settings.shortest_step);
        settings.aids = match (&of_run.aids, mission) {
            (Some(keys), _) => keys.iter().map(|key| ChosenAid::usual(key)).collect(),
            (None, Some(mission)) => mission.read_aids(),
            // Those of the scenario look at pictures.
            (None, None) => Vec::new(),
        };
        settings
    }

    /// Flies it, as far as to be navigated; `None` where it cannot begin.
    pub fn prepare(&self) -> Option<PreparedFlight> {
        let mut scenario = self.scenario()?;
        let settings = &self.settings;
        let mission = match &self.mission {
            Some(mission) => Some(mission.read(settings.height).ok()?),
            None => None,
        };
        if let Some(mission) = &mission {
            scenario.height = mission.height();
        }
        let overrides = Overrides {
            sensors: Some(settings.sensors),
            ..Overrides::default()
        };
        let mut plan = scenario.plan(&overrides);
        plan.longest = self.longest();
        if let Some(mission) = &mission {
            plan = mission.flown(plan, self.longest());
        }
        if settings.wind_scatter > 0.0 {
            plan = plan.in_wind_of(self.seeds.of(Stream::Wind), settings.wind_scatter);
        }
        let mut flight = plan.simulate(self.seeds.of(Stream::Flight))?;
        for (instrument, deviation) in &settings.walks {
            // The errors of two instruments walk each by itself.
            let seed = self.seeds.of(Stream::Walk) ^ *instrument as u64;
            flight = with_walk(flight, *instrument, *deviation, seed);
        }
        let navigator = self.navigator_in(scenario, mission.as_ref());
        self.read_aids(&mut flight, &navigator.aids);
        damage(&mut flight, settings);
        let deviations = Vector4::new(settings.place, settings.place, settings.turn, settings.turn);
        Some(PreparedFlight {
            settings: navigator,
            stated: StatedNavigation {
                seen: as_seen(&flight, settings).map(Arc::new),
                expected: ExpectedDetection {
                    recognised: settings.recognised,
                    per_frame: settings.per_frame,
                    covariance: Matrix4::from_diagonal(
                        &deviations.map(|deviation| deviation * deviation),
                    ),
                },
                seed: self.seeds.of(Stream::Detection),
                is_trusting: !settings.doubts,
            },
            flight: Arc::new(flight),
            mission,
        })
    }

    /// Gives the flight the channels of the chosen aids: the truth with the error that each takes for granted.
    fn read_aids(&self, flight: &mut Flight, chosen: &[ChosenAid]) {
        let Some(truth) = flight.truth.clone() else {
            return;
        };
        for info in AidInfo::ALL {
            let Some(aid) = chosen.iter().find(|aid| aid.key == info.key) else {
                continue;
            };
            // What the aid refuses keeps the flight from being navigated.
            let values = info.values(aid).unwrap_or_default();
            let of = |key: &str| {
                let place = info.numbers.iter().position(|number| number.key == key);
                values.get(place?).copied()
            };
            let noise = of("noise").unwrap_or(0.0);
            let apart = of("apart").unwrap_or(READING_APART);
            let per_reading = (apart / 0.05).round().max(1.0) as usize;
            for name in info.channels {
                let seed = self.seeds.of(Stream::Aid) ^ *name as u64;
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

    /// Flies and navigates it, and observes it; nothing is observed of a flight that the filter gives up. `landmarks` are
    /// those of its scenario.
    pub(crate) fn observe(&self, landmarks: &[Landmark]) -> Observed {
        let Some(prepared) = self.prepare() else {
            return Observed::default();
        };
        let own = prepared.mission.as_ref();
        let landmarks = own.map_or(landmarks, |mission| mission.landmarks.as_slice());
        let (flight, settings) = (&prepared.flight, &prepared.settings);
        let Ok((mut navigator, mut frames)) = prepared.stated.begin(flight, landmarks, settings)
        else {
            return Observed::default();
        };
        let mut observed = Observed::of(navigator.run_head());
        while let Some(step) = navigator.advance(&mut frames, &|| 0.0) {
            let Ok(step) = step else {
                return Observed::default();
            };
            observed.take(flight, &step);
        }
        observed
    }

    /// Flies and navigates it, by the landmarks of its scenario where it has no mission; its numbers of all kinds, in the
    /// order of [`MeasureKind::ALL`](super::MeasureKind::ALL), `None` where there is no such number.
    pub fn numbers(&self, landmarks: &[Landmark]) -> Vec<Option<f64>> {
        self.observe(landmarks).numbers()
    }
}
