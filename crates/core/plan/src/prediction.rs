//! The position uncertainty that a filter will have along a route, before the flight.

use serde::{Deserialize, Serialize};

use super::corridor::{Corridor, WorldError, corridor};
use super::propagate::{Propagation, UnknownWind, WorldsMoment};
use super::request::{PredictionError, PredictionRequest};
use super::{day_factor, winds};
use pilotage_base::frames::GroundPoint;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_navigator::navigator::visit_model;
use pilotage_simulate::simulate::{FlightPlan, TrueFlight};

/// Probability with which the true error lies inside the corridor.
const PROBABILITY: f64 = 0.95;
/// A frame in which a landmark is found with this probability counts as a fix.
const LIKELY: f64 = 0.5;
/// Winds that are tried at least where the wind is uncertain.
const WINDS_AT_LEAST: usize = 4;
/// Beyond those, worlds per wind.
const WORLDS_PER_WIND: usize = 6;
/// Metres per frame of the slowest flight that counts by its time: slower ones count no more.
const SLOWEST: f64 = 0.5;
/// Moments of the plan that a flight may be ahead of the one compared last: a tail wind, a cut corner.
const AHEAD: usize = 20;

/// The predicted uncertainty at one frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictionSample {
    /// Seconds after the start.
    pub time: f64,
    /// Distance along the flown path, metres.
    pub distance: f64,
    /// Planned position of the aircraft.
    pub position: GroundPoint,
    /// Course over the ground, radians clockwise from north.
    pub course: f64,
    /// Corridor that holds the error with 95 %.
    pub corridor: Corridor,
    /// Probability that each landmark is found in this frame, in the order of the request.
    pub detection: Vec<f64>,
    /// Seconds since a frame in which finding any landmark was more likely than not.
    pub dead_reckoning: f64,
}

/// A stretch of the route over the user's limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stretch {
    /// Distance along the path at which it begins, metres.
    pub begin: f64,
    /// Distance at which it ends, metres.
    pub end: f64,
    /// Largest standard deviation of the longer axis on it, metres.
    pub sigma: f64,
    /// Place of that deviation.
    pub worst: GroundPoint,
    /// Longest dead reckoning on it, seconds.
    pub dead_reckoning: f64,
}

/// The predicted uncertainty along a route.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoutePrediction {
    /// Samples, one for each frame of the camera.
    pub samples: Vec<PredictionSample>,
    /// Stretches over the limit, in the order in which they are flown.
    pub over_limit: Vec<Stretch>,
}

impl RoutePrediction {
    /// The stretch about the largest standard deviation: the worst of those over the limit, or, where
    /// none is, from the least one before it to the least one after it.
    pub fn worst_stretch(&self) -> Option<Stretch> {
        let worst = self
            .over_limit
            .iter()
            .max_by(|a, b| a.sigma.total_cmp(&b.sigma));
        if let Some(worst) = worst {
            return Some(*worst);
        }
        let sigma = |i: usize| self.samples[i].corridor.sigma_major;
        let peak = (0..self.samples.len()).max_by(|a, b| sigma(*a).total_cmp(&sigma(*b)))?;
        let (mut first, mut last) = (peak, peak);
        while first > 0 && sigma(first - 1) <= sigma(first) {
            first -= 1;
        }
        while last + 1 < self.samples.len() && sigma(last + 1) <= sigma(last) {
            last += 1;
        }
        stretch(&self.samples[first..=last])
    }
}

impl RoutePrediction {
    /// Marks the stretches over another limit, metres.
    pub fn mark(&mut self, limit: f64) {
        self.over_limit = stretches(&self.samples, limit);
    }
}

impl PredictionRequest<'_> {
    /// Predicts the uncertainty of the position along the route.
    ///
    /// The route is flown in several winds, each with a ground speed, a crab angle and gusts of its own
    /// (where the wind is uncertain), and in each the covariance of the filter is propagated with the
    /// process noise of the settings and corrected by the landmarks that lie in each frame, in worlds
    /// that differ in what is recognised, in the shake of the camera and in what is missed. Beside it
    /// goes the error that this filter then truly has; see [`corridor`]. Flights are brought together
    /// where they are, not when: against the wind a place is reached later.
    ///
    /// ```
    /// # use pilotage_base::frames::GroundPoint;
    /// # use pilotage_simulate::simulate::{FlightPlan, Overrides, Scenario, SensorSpec};
    /// use pilotage_plan::PredictionRequest;
    /// # let scenario = Scenario::named("distinct-400ft-wind").ok_or("no such scenario")?;
    /// # let way_points = vec![GroundPoint::new(0.0, 0.0), GroundPoint::new(0.0, 300.0)];
    /// # let plan = FlightPlan { way_points, ..scenario.plan(&Overrides::default()) };
    /// # let settings = scenario.navigator(&SensorSpec::default());
    ///
    /// // Without a landmark, in a wind of which 4 m/s on each axis are unknown to the filter.
    /// let (plan, settings) = (&plan, &settings);
    /// let (landmarks, wind_deviation) = (&[], 4.0);
    /// let (worlds, seed, limit) = (8, 1, 20.0);
    /// let request =
    ///     PredictionRequest { plan, settings, landmarks, wind_deviation, worlds, seed, limit };
    /// let prediction = request.predict()?;
    /// let (first, last) = prediction.samples.first().zip(prediction.samples.last()).ok_or("no frame")?;
    /// assert!((first.corridor.sigma_major - 3.0).abs() < 0.5); // the first position
    /// assert!(last.corridor.sigma_major > 20.0 && !prediction.over_limit.is_empty());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A route without two different way-points, or a covariance that became infinite.
    pub fn predict(&self) -> Result<RoutePrediction, PredictionError> {
        self.predict_while(&mut || true)
    }

    /// As [`Self::predict`], as long as `goes_on`, which is asked before each wind.
    ///
    /// # Errors
    /// As of that, or that nobody wants it to go on.
    pub fn predict_while(
        &self,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<RoutePrediction, PredictionError> {
        let flight = self.plan.nominal().ok_or(PredictionError::NoRoute)?;
        let uncertain = self.wind_deviation > 0.0;
        let worlds = self.worlds.max(1);
        let winds = if uncertain {
            worlds.min(WINDS_AT_LEAST + worlds / WORLDS_PER_WIND)
        } else {
            1
        };
        let parts = winds::parts(winds);
        let per_wind = worlds.div_ceil(parts.len());
        let weights: Vec<f64> = parts
            .iter()
            .flat_map(|part| std::iter::repeat_n(part.weight, per_wind))
            .collect();
        let recognised = self.recognised(&weights);
        // A height that the filter estimates is predicted as read.
        let settings = NavigatorSettings {
            sensors: self.settings.sensors.with_biases_within(),
            estimates_height: false,
            ..self.settings.clone()
        };
        let request = PredictionRequest {
            settings: &settings,
            ..*self
        };
        let mut ways = Vec::with_capacity(parts.len());
        for ((number, part), worlds) in parts.iter().enumerate().zip(recognised.chunks(per_wind)) {
            if !goes_on() {
                return Err(PredictionError::GivenUp);
            }
            let wind = self.plan.wind + self.wind_deviation * part.mean;
            let other = uncertain
                .then(|| {
                    FlightPlan {
                        wind,
                        ..self.plan.clone()
                    }
                    .nominal()
                })
                .flatten();
            let propagation = Propagation {
                request: &request,
                flight: other.as_ref().unwrap_or(&flight),
                worlds,
                seed: self.seed.wrapping_mul(1000) + number as u64,
                unknown_wind: uncertain.then_some(UnknownWind {
                    mean: wind,
                    covariance: part.covariance * self.wind_deviation.powi(2),
                }),
            };
            ways.push((part.weight, visit_model(&settings, propagation)?));
        }
        let samples = samples(&flight, brought_together(&self.track(&flight), &ways))?;
        Ok(RoutePrediction {
            over_limit: stretches(&samples, self.limit),
            samples,
        })
    }

    /// For each world of these weights and each landmark a number from 0 to 1: it is recognised where
    /// that is more probable. How far landmarks go together follows from their rehearsals.
    fn recognised(&self, worlds: &[f64]) -> Vec<Vec<f64>> {
        let height = self.plan.height;
        let rehearsed: Vec<_> = self
            .landmarks
            .iter()
            .filter_map(|l| Some((l.detection.at(height)?, l.detection.by_day.as_slice())))
            .collect();
        let ids: Vec<u32> = self.landmarks.iter().map(|l| l.landmark.id).collect();
        day_factor::worlds(worlds, &ids, day_factor::shared(&rehearsed), self.seed)
    }

    /// States of `flight` at which the camera takes a picture, and where that is.
    fn track(&self, flight: &TrueFlight) -> Vec<(usize, GroundPoint)> {
        let period = 1.0 / self.plan.sensors.frame_rate;
        let mut next = flight.states.first().map_or(0.0, |s| s.time);
        let mut track = Vec::new();
        for (index, state) in flight.states.iter().enumerate() {
            if state.time >= next - 1e-6 {
                next += period;
                let place = GroundPoint::new(state.position.x, state.position.y);
                track.push((index, place));
            }
        }
        track
    }
}

/// Index of the place that lies nearest to `place`, from `last` on and no further ahead than a flight
/// may be: a route comes back to where it was.
pub(super) fn nearest_ahead(
    places: impl Fn(usize) -> Option<GroundPoint>,
    last: usize,
    place: &GroundPoint,
) -> usize {
    let ahead = (last..last + AHEAD).map_while(|i| places(i).map(|p| (i, p.distance(place))));
    ahead
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(last, |(i, _)| i)
}

/// Time that a flight spends near its moment `index`, frames per metre: a corridor holds the error for its
/// share of the time, and against the wind there is more of that.
fn lasting(way: &[WorldsMoment], index: usize) -> f64 {
    let (from, to) = (index.saturating_sub(1), (index + 1).min(way.len() - 1));
    let length = way[from].place.distance(&way[to].place);
    let frames = (to - from).max(1) as f64;
    frames / length.max(SLOWEST * frames)
}

/// Moments of all ways, each with its weight, brought together at the places of `track`.
fn brought_together(
    track: &[(usize, GroundPoint)],
    ways: &[(f64, Vec<WorldsMoment>)],
) -> Vec<WorldsMoment> {
    let mut reached = vec![0; ways.len()];
    track
        .iter()
        .map(|(state, place)| {
            let mut all = WorldsMoment {
                state: *state,
                place: *place,
                beliefs: Vec::new(),
                found: Vec::new(),
                any: 0.0,
            };
            for ((share, way), last) in ways.iter().zip(&mut reached) {
                *last = nearest_ahead(|i| way.get(i).map(|m| m.place), *last, place);
                let Some(moment) = way.get(*last) else {
                    continue;
                };
                let weight = share * lasting(way, *last);
                let weighed = moment.beliefs.iter().map(|b| WorldError { weight, ..*b });
                all.beliefs.extend(weighed);
                all.found.resize(moment.found.len(), 0.0);
                for (sum, found) in all.found.iter_mut().zip(&moment.found) {
                    *sum += share * found;
                }
                all.any += share * moment.any;
            }
            all
        })
        .collect()
}

fn samples(
    flight: &TrueFlight,
    moments: Vec<WorldsMoment>,
) -> Result<Vec<PredictionSample>, PredictionError> {
    let states = &flight.states;
    let mut distance = 0.0;
    let mut passed = 0;
    let mut fix = states.first().map_or(0.0, |s| s.time);
    let mut samples = Vec::with_capacity(moments.len());
    for moment in moments {
        while passed < moment.state {
            let step = states[passed + 1].position - states[passed].position;
            distance += step.xy().norm();
            passed += 1;
        }
        let state = &states[moment.state];
        // Course by the neighbours: the state before, or after at the start.
        let (from, to) = if moment.state > 0 {
            (&states[moment.state - 1], state)
        } else {
            (state, states.get(1).unwrap_or(state))
        };
        let way = to.position - from.position;
        let course = way.y.atan2(way.x);
        if moment.any > LIKELY {
            fix = state.time;
        }
        let corridor = corridor(&moment.beliefs, course, PROBABILITY)
            .ok_or(PredictionError::NotFinite { time: state.time })?;
        samples.push(PredictionSample {
            time: state.time,
            distance,
            position: GroundPoint::new(state.position.x, state.position.y),
            course,
            corridor,
            detection: moment.found,
            dead_reckoning: state.time - fix,
        });
    }
    Ok(samples)
}

fn stretches(samples: &[PredictionSample], limit: f64) -> Vec<Stretch> {
    samples
        .chunk_by(|a, b| over(a, limit) == over(b, limit))
        .filter(|stretch| over(&stretch[0], limit))
        .filter_map(stretch)
        .collect()
}

/// Stretch over all of the samples; `None` without any.
fn stretch(samples: &[PredictionSample]) -> Option<Stretch> {
    let by_sigma = |a: &&PredictionSample, b: &&PredictionSample| {
        a.corridor.sigma_major.total_cmp(&b.corridor.sigma_major)
    };
    let worst = samples.iter().max_by(by_sigma)?;
    let times = samples.iter().map(|s| s.dead_reckoning);
    Some(Stretch {
        begin: samples.first()?.distance,
        end: samples.last()?.distance,
        sigma: worst.corridor.sigma_major,
        worst: worst.position,
        dead_reckoning: times.fold(0.0, f64::max),
    })
}

fn over(sample: &PredictionSample, limit: f64) -> bool {
    sample.corridor.sigma_major > limit
}

#[cfg(test)]
mod tests {
    use super::super::{DetectionStatistics, PlannedLandmark};
    use super::*;
    use crate::ExpectedDetection;
    use nalgebra::{Matrix4, Vector4};
    use pilotage_simulate::simulate::{Overrides, Scenario, SensorSpec};

    fn landmarks(scenario: &Scenario, probability: f64) -> Vec<PlannedLandmark> {
        let spread = Vector4::new(0.1, 0.1, 0.005, 0.005).map(|sd: f64| sd * sd);
        let expected = ExpectedDetection {
            recognised: 1.0,
            per_frame: probability,
            covariance: Matrix4::from_diagonal(&spread),
        };
        let mission = scenario.mission();
        mission
            .landmarks
            .into_iter()
            .map(|landmark| PlannedLandmark {
                landmark,
                detection: DetectionStatistics::everywhere(expected),
            })
            .collect()
    }

    fn predict(landmarks: &[PlannedLandmark], worlds: usize) -> RoutePrediction {
        let scenario = Scenario::named("distinct-400ft-wind").unwrap();
        let request = PredictionRequest {
            plan: &scenario.plan(&Overrides::default()),
            settings: &scenario.navigator(&SensorSpec::default()),
            landmarks,
            wind_deviation: 0.0,
            worlds,
            seed: 7,
            limit: 10.0,
        };
        request.predict().unwrap()
    }

    fn largest(prediction: &RoutePrediction) -> f64 {
        let sigmas = prediction.samples.iter().map(|s| s.corridor.sigma_major);
        sigmas.fold(0.0, f64::max)
    }

    #[test]
    fn without_landmarks_the_uncertainty_only_grows_and_with_them_it_shrinks() {
        let scenario = Scenario::named("distinct-400ft-wind").unwrap();
        let blind = predict(&[], 4);
        let grows = |pair: &[PredictionSample]| {
            pair[1].corridor.sigma_major >= pair[0].corridor.sigma_major - 1e-9
        };
        assert!(blind.samples.windows(2).all(grows));
        let aided = predict(&landmarks(&scenario, 0.9), 16);
        assert!(largest(&aided) < 0.3 * largest(&blind));
        assert!(!blind.over_limit.is_empty());
        assert!(blind.over_limit[0].dead_reckoning > 60.0);
    }

    #[test]
    fn there_is_a_worst_stretch_within_the_limit_too_about_the_largest_uncertainty() {
        let scenario = Scenario::named("distinct-400ft-wind").unwrap();
        let mut aided = predict(&landmarks(&scenario, 0.9), 16);
        aided.mark(1e3);
        assert!(aided.over_limit.is_empty());
        let worst = aided.worst_stretch().unwrap();
        assert!((worst.sigma - largest(&aided)).abs() < 1e-12);
        let length = aided.samples.last().unwrap().distance;
        assert!(worst.end - worst.begin < 0.6 * length, "{worst:?}");
        let mut it = aided.samples.iter();
        let at = it.find(|s| s.position == worst.worst).unwrap();
        assert!((worst.begin..=worst.end).contains(&at.distance));
        assert_eq!(RoutePrediction::default().worst_stretch(), None);
    }

    #[test]
    fn landmarks_that_are_seldom_found_leave_more_uncertainty() {
        let scenario = Scenario::named("distinct-400ft-wind").unwrap();
        let mean = |prediction: &RoutePrediction| {
            let n = prediction.samples.len() as f64;
            let areas = prediction.samples.iter();
            areas.map(|s| s.corridor.covariance.trace()).sum::<f64>() / n
        };
        let often = mean(&predict(&landmarks(&scenario, 0.95), 32));
        let seldom = mean(&predict(&landmarks(&scenario, 0.1), 32));
        assert!(seldom > 1.2 * often, "{seldom} against {often}");
    }

    #[test]
    fn what_is_predicted_at_a_place_stays_to_the_last_digit_whatever_is_added_ahead_of_it() {
        let scenario = Scenario::named("distinct-400ft-wind").unwrap();
        let all = landmarks(&scenario, 0.6);
        let ahead =
            |l: &PlannedLandmark| l.landmark.bounds.center().distance(&GroundPoint::default());
        let last = all
            .iter()
            .max_by(|a, b| ahead(a).total_cmp(&ahead(b)))
            .unwrap()
            .landmark
            .id;
        let fewer: Vec<_> = all
            .iter()
            .filter(|l| l.landmark.id != last)
            .cloned()
            .collect();
        let (with, without) = (predict(&all, 16), predict(&fewer, 16));
        let place = all.iter().position(|l| l.landmark.id == last).unwrap();
        let same = with
            .samples
            .iter()
            .take_while(|s| s.detection[place] == 0.0)
            .count();
        assert!(same > 20, "{same} of {}", with.samples.len());
        for (a, b) in with.samples.iter().zip(&without.samples).take(same) {
            assert_eq!(a.corridor, b.corridor, "at {} m", a.distance);
        }
        let mut turned = all.clone();
        turned.reverse();
        let turned = predict(&turned, 16);
        for (a, b) in with.samples.iter().zip(&turned.samples) {
            let off = (a.corridor.sigma_major - b.corridor.sigma_major).abs();
            assert!(
                off < 1e-9 * a.corridor.sigma_major,
                "{off} m at {} m",
                a.distance
            );
        }
    }
}
