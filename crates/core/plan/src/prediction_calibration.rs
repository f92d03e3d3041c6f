//! Calibration of a prediction: flights beside what was predicted for them.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::RoutePrediction;
use super::prediction::nearest_ahead;
use pilotage_base::frames::GroundPoint;
use pilotage_flight::Flight;
use pilotage_navigator::navigator::Run;

/// Frame of a flight beside the plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanComparison {
    /// Distance along the planned path of the place with which it is compared, metres.
    pub distance: f64,
    /// Whether the error lies inside the predicted ellipse.
    pub inside_ellipse: bool,
    /// Whether it lies inside the predicted strip across the course.
    pub inside_corridor: bool,
    /// Error across the course, to the right, metres.
    pub across: f64,
    /// Square of the error, m².
    pub squared: f64,
    /// Mean square of the error that was predicted, m².
    pub predicted: f64,
    /// Mean square of the error that the filter believed, m².
    pub believed: f64,
    /// Error of the position over the filter's own covariance, squared; 2 on average if it is honest.
    pub nees: f64,
}

impl PlanComparison {
    /// Error, metres.
    pub fn error(&self) -> f64 {
        self.squared.sqrt()
    }

    /// The frame with the largest error.
    pub fn worst(frames: &[Self]) -> Option<&Self> {
        frames.iter().max_by(|a, b| a.squared.total_cmp(&b.squared))
    }
}

/// Compares every frame of `flight` with the place of the prediction that it is over.
///
/// Empty for a flight without truth.
pub fn compare(flight: &Flight, run: &Run, prediction: &RoutePrediction) -> Vec<PlanComparison> {
    let places = |i: usize| prediction.samples.get(i).map(|s| s.position);
    let mut last = 0;
    let with_frames = run.steps.iter().filter(|s| s.frame.is_some());
    with_frames
        .filter_map(|step| {
            let truth = flight.truth.as_ref()?.position(step.time)?;
            let truth = GroundPoint::new(truth.x, truth.y);
            last = nearest_ahead(places, last, &truth);
            let planned = prediction.samples.get(last)?;
            let error = step.after.position().to_vector() - truth.to_vector();
            let c = &planned.corridor;
            let (sin, cos) = c.heading_of_major.sin_cos();
            let major = Vector2::new(cos, sin).dot(&error);
            let minor = Vector2::new(-sin, cos).dot(&error);
            let distance = (major / c.sigma_major).hypot(minor / c.sigma_minor);
            let across = Vector2::new(-planned.course.sin(), planned.course.cos()).dot(&error);
            let covariance = step.after.position_covariance();
            let weighted = covariance.cholesky()?.solve(&error);
            Some(PlanComparison {
                distance: planned.distance,
                across,
                inside_ellipse: distance <= c.scale,
                inside_corridor: across.abs() <= c.across,
                squared: error.norm_squared(),
                predicted: c.covariance.trace(),
                believed: covariance.trace(),
                nees: weighted.dot(&error),
            })
        })
        .collect()
}

/// Comparison of flights with the predicted corridor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Verification {
    /// Flights flown.
    pub flights: usize,
    /// Frames compared.
    pub frames: usize,
    /// Share of them inside the 95 % ellipse.
    pub inside_ellipse: f64,
    /// Share of them inside the 95 % strip across the course.
    pub inside_corridor: f64,
    /// Standard deviation of that share from flight to flight over the root of their number: frames
    /// of one flight err together.
    pub corridor_uncertainty: f64,
    /// Root mean square error, metres.
    pub rms_m: f64,
    /// Root mean square error that was predicted, metres.
    pub predicted_rms_m: f64,
    /// Root mean square error that the filter believed, metres.
    pub believed_rms_m: f64,
    /// Mean squared error over the filter's own covariance, of two axes; 2 for an honest filter.
    pub mean_nees: f64,
    /// Largest error, metres.
    pub largest_m: f64,
}

impl Verification {
    /// Sums flights up.
    pub fn of<F: AsRef<[PlanComparison]>>(flights: &[F]) -> Self {
        let all: Vec<&PlanComparison> = flights.iter().flat_map(AsRef::as_ref).collect();
        let n = all.len().max(1) as f64;
        let mean = |f: &dyn Fn(&PlanComparison) -> f64| all.iter().map(|c| f(c)).sum::<f64>() / n;
        let share = |f: fn(&PlanComparison) -> bool| mean(&|c| f64::from(u8::from(f(c))));
        let inside_corridor = share(|c| c.inside_corridor);
        // Each flight's part of the whole share.
        let flown = flights.len().max(1) as f64;
        let parts = flights.iter().map(|flight| {
            let outside =
                |c: &&PlanComparison| f64::from(u8::from(c.inside_corridor)) - inside_corridor;
            let flight = flight.as_ref().iter();
            flight.map(|c| outside(&c)).sum::<f64>().powi(2)
        });
        Self {
            flights: flights.len(),
            frames: all.len(),
            inside_ellipse: share(|c| c.inside_ellipse),
            inside_corridor,
            corridor_uncertainty: (parts.sum::<f64>() * flown / (flown - 1.0).max(1.0)).sqrt() / n,
            rms_m: mean(&|c| c.squared).sqrt(),
            predicted_rms_m: mean(&|c| c.predicted).sqrt(),
            believed_rms_m: mean(&|c| c.believed).sqrt(),
            mean_nees: mean(&|c| c.nees),
            largest_m: all.iter().map(|c| c.squared).fold(0.0, f64::max).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::{Matrix4, Point2, Vector4};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::{
        DetectionStatistics, ExpectedDetection, PlannedLandmark, PredictionRequest, as_stated,
        random_route,
    };
    use pilotage_base::frames::GroundRect;
    use pilotage_base::statistics::chi_square_quantile;
    use pilotage_flight::Flight;
    use pilotage_mission::settings::NavigatorSettings;
    use pilotage_navigator::navigator::{Navigator, Run};
    use pilotage_simulate::simulate::{FlightPlan, Overrides, Scenario, SensorSpec};
    use pilotage_vision::landmark::Landmark;

    const SPREAD: [f64; 4] = [0.1, 0.1, 0.004, 0.004];

    /// A landmark that can be recognised and is found in a frame with these probabilities.
    fn expected(recognised: f64, per_frame: f64) -> ExpectedDetection {
        ExpectedDetection {
            recognised,
            per_frame,
            covariance: Matrix4::from_diagonal(&Vector4::from(SPREAD).map(|sd: f64| sd * sd)),
        }
    }

    /// A route of `seed` with landmarks of 34 m beside it here and there.
    fn route(seed: u64) -> (FlightPlan, Vec<Landmark>) {
        let mut plan = Scenario::all()[1].plan(&Overrides::default());
        plan.wind = Vector2::zeros();
        plan.way_points = random_route(seed);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let legs: Vec<_> = plan.way_points.windows(2).collect();
        let landmarks = (0..7).map(|id| {
            let leg = legs[random.random_range(0..legs.len())];
            let share: f64 = random.random();
            let place = leg[0].to_vector() * (1.0 - share) + leg[1].to_vector() * share;
            let aside = Vector2::from_fn(|_, _| 50.0 * (random.random::<f64>() - 0.5));
            let bounds = GroundRect::centered((place + aside).into(), 34.0, 34.0);
            Landmark::new(id, "place", bounds)
        });
        let landmarks = landmarks.collect();
        (plan, landmarks)
    }

    fn verified(route_seed: u64, flights: u64) -> Verification {
        let scenario = &Scenario::all()[1];
        let settings = scenario.navigator(&SensorSpec::default());
        flown(
            route(route_seed),
            &settings,
            expected(0.8, 0.6),
            (route_seed, flights),
        )
    }

    /// The frames of a flight navigated by landmarks that are seen as `seen_from` has it.
    fn navigated(
        flight: &Arc<Flight>,
        seen_from: &Flight,
        planned: &[PlannedLandmark],
        settings: &NavigatorSettings,
        seed: u64,
    ) -> Run {
        let landmarks = planned.iter().map(|planned| planned.landmark.clone());
        let landmarks: Vec<Landmark> = landmarks.collect();
        let (detector, mut frames) = as_stated(seen_from, planned, seed).unwrap();
        let detector = Box::new(detector);
        let mut navigator =
            Navigator::with_detector(Arc::clone(flight), &landmarks, detector, settings)
                .unwrap()
                .sparing();
        let mut run = navigator.run_head();
        while let Some(step) = navigator.advance(&mut frames, &|| 0.0) {
            let mut step = step.unwrap();
            if step.frame.is_some() {
                step.sigma.before_correct = None;
                run.steps.push(step);
            }
        }
        assert!(frames.asked() < flight.frames.len());
        run
    }

    /// The flight as a camera sees it over a map that is off by `deviation` per axis, otherwise every 2 km.
    fn over_wrong_map(flight: &Flight, deviation: f64, seed: u64) -> Flight {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut error = || -> Vector2<f64> {
            Vector2::from_fn(|_, _| {
                let unit: f64 = StandardNormal.sample(&mut random);
                deviation * unit
            })
        };
        let mut off = error();
        let mut seen = flight.clone();
        let mut last: Option<Point2<f64>> = None;
        for frame in &mut seen.truth.as_mut().unwrap().frames {
            let at = frame.position.xy();
            let way = last.map_or(0.0_f64, |last| (at - last).norm());
            let left = (-way / 2000.0).exp();
            off = off * left + error() * (1.0 - left * left).sqrt();
            last = Some(at);
            frame.position.x += off.x;
            frame.position.y += off.y;
        }
        seen
    }

    #[test]
    fn landmarks_of_a_map_that_is_off_make_nobody_surer_than_the_map() {
        const FLIGHTS: u64 = 60;
        let scenario = Scenario::named("distinct-1000ft-extended").unwrap();
        let mut settings = scenario.navigator(&SensorSpec::default());
        settings.detector.map_deviation = 3.0;
        let plan = scenario.plan(&Overrides::default());
        let landmarks = scenario.mission().landmarks.into_iter();
        let planned: Vec<PlannedLandmark> = landmarks
            .map(|landmark| PlannedLandmark {
                landmark,
                detection: DetectionStatistics::everywhere(expected(1.0, 0.9)),
            })
            .collect();
        let (mut nees, mut held) = (0.0, 0);
        for seed in 0..FLIGHTS {
            let flight = plan.in_wind_of(seed, settings.start.wind);
            let flight = Arc::new(flight.simulate(seed).unwrap());
            let seen_from = over_wrong_map(&flight, 3.0, seed);
            let run = navigated(&flight, &seen_from, &planned, &settings, seed);
            let mut of_flight = 0.0;
            let mut count = 0.0;
            for step in run.steps.iter().skip(run.steps.len() / 4) {
                let truth = flight.truth.as_ref().unwrap().position(step.time).unwrap();
                let off = step.after.position().to_vector() - truth.xy().coords;
                let root = step.after.position_covariance().cholesky().unwrap();
                of_flight += root.solve(&off).dot(&off);
                count += 1.0;
            }
            nees += of_flight / count;
            held += usize::from(of_flight / count < 5.99);
        }
        let mean = nees / FLIGHTS as f64;
        println!("NEES {mean:.2} of 2, {held} of {FLIGHTS} flights below 5.99");
        // 95 % of the means of as many honest flights, each of which is one sample at least.
        let end = |probability: f64| {
            chi_square_quantile(probability, 2.0 * FLIGHTS as f64) / FLIGHTS as f64
        };
        let honest = end(0.025)..end(0.975);
        assert!(honest.contains(&mean), "{mean}, not within {honest:?}");
    }

    /// Flights, whose seeds begin with a thousand times `seed`, beside what is predicted for them.
    fn flown(
        (plan, landmarks): (FlightPlan, Vec<Landmark>),
        settings: &NavigatorSettings,
        expected: ExpectedDetection,
        (seed, flights): (u64, u64),
    ) -> Verification {
        let planned: Vec<PlannedLandmark> = landmarks
            .iter()
            .map(|landmark| PlannedLandmark {
                landmark: landmark.clone(),
                detection: DetectionStatistics::everywhere(expected),
            })
            .collect();
        let prediction = PredictionRequest {
            plan: &plan,
            settings,
            landmarks: &planned,
            wind_deviation: settings.start.wind,
            worlds: 100,
            seed: 3,
            limit: 10.0,
        }
        .predict()
        .unwrap();
        let fly = |seed: u64| {
            let flight = plan.in_wind_of(seed, settings.start.wind);
            let flight = Arc::new(flight.simulate(seed).unwrap());
            let run = navigated(&flight, &flight, &planned, settings, seed);
            compare(&flight, &run, &prediction)
        };
        let flights: Vec<_> = (0..flights).map(|i| fly(1000 * seed + i)).collect();
        Verification::of(&flights)
    }

    /// Routes, winds, days, gusts, sensors and misses are all drawn; `PILOTAGE_FLIGHTS` says how many
    /// flights per route.
    #[test]
    fn errors_lie_inside_the_predicted_corridor_as_often_as_it_says() {
        let asked = std::env::var("PILOTAGE_FLIGHTS").ok();
        let flights = asked.and_then(|n| n.parse().ok()).unwrap_or(24);
        let routes = [1, 2, 3, 4, 5].map(|seed| verified(seed, flights));
        for v in &routes {
            println!("{v:.3?}");
        }
        let mean = routes.iter().map(|v| v.inside_corridor).sum::<f64>() / 5.0;
        assert!((0.925..0.975).contains(&mean), "{mean}");
    }

    /// Flights of the same route are predicted for filters that are told other things of it, as each will believe.
    #[test]
    fn filters_with_other_states_and_noise_are_predicted_as_they_will_believe() {
        let scenario = Scenario::named("distinct-1000ft-extended").unwrap();
        let usual = scenario.navigator(&SensorSpec::default());
        let mut of_height = usual.clone();
        of_height.estimates_height = true;
        let mut of_map = usual.clone();
        of_map.detector.map_deviation = 3.0;
        let mut of_frames = usual.clone();
        of_frames.measurement_scale = 4.0;
        for (what, settings) in [("height", of_height), ("map", of_map), ("scale", of_frames)] {
            let route = (
                scenario.plan(&Overrides::default()),
                scenario.mission().landmarks,
            );
            let flown = flown(route, &settings, expected(1.0, 0.9), (7, 6));
            println!("{what}: {flown:.3?}");
            // A filter that takes noise for more than it is believes too little of itself: its errors are predicted.
            let is_scaled = settings.measurement_scale > 1.0;
            let flown_rms = if is_scaled {
                assert!(
                    flown.believed_rms_m > 1.2 * flown.predicted_rms_m,
                    "{flown:?}"
                );
                flown.rms_m
            } else {
                flown.believed_rms_m
            };
            let share = flown.predicted_rms_m / flown_rms;
            let near = if is_scaled { 0.8..1.3 } else { 0.93..1.07 };
            assert!(near.contains(&share), "{what}: {flown:?}");
        }
    }

    /// From 300 m, over landmarks that are seen again and again, what stays of tilt and height over a flight is most of the
    /// error.
    #[test]
    fn many_looks_from_a_camera_that_stays_tilted_are_predicted_as_the_filter_takes_them() {
        let scenario = Scenario::named("distinct-1000ft-extended").unwrap();
        let settings = scenario.navigator(&SensorSpec::default());
        assert!(settings.sensors.tilt_bias > 0.0);
        let asked = std::env::var("PILOTAGE_FLIGHTS").ok();
        let flights = asked.and_then(|n| n.parse().ok()).unwrap_or(24);
        let plan = scenario.plan(&Overrides::default());
        let route = (plan, scenario.mission().landmarks);
        let flown = flown(route, &settings, expected(1.0, 0.9), (6, flights));
        println!("{flown:.3?}");
        let believed = flown.predicted_rms_m / flown.believed_rms_m;
        assert!((0.97..1.03).contains(&believed), "{flown:?}");
        assert!((0.94..0.985).contains(&flown.inside_ellipse), "{flown:?}");
    }
}
