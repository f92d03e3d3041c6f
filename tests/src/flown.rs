//! Built-in flights that are flown after something went wrong with them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{Matrix4, Vector4};
use pilotage_core::flight::{Flight, FrameError, FrameSource};
use pilotage_core::imagery::CachedImagery;
use pilotage_core::navigator::{Doubt, KnownGround, Navigator, Run};
use pilotage_core::plan::{DetectionStatistics, ExpectedDetection, PlannedLandmark, as_stated};
use pilotage_core::raster::{Picture, decode_picture};
use pilotage_core::simulate::scenery::{DEMO_SEED, Scenery};
use pilotage_core::simulate::{FlightDay, Overrides, Scenario, SimulatedFlight, SimulatedFrames};

/// Memory for the ground below a whole flight on a day, megabytes.
const GROUND_MEGABYTES: usize = 256;

/// The first built-in flight by its landmarks, with its real pictures, after `damage`.
pub struct FlownScenario {
    /// The navigator's run over it.
    pub run: Run,
    flight: Flight,
}

///
/// # Panics
/// If the scenario is none or the navigator cannot begin or go on.
pub fn fly(damage: impl Fn(&mut Flight)) -> FlownScenario {
    fly_as("distinct-400ft-wind", 3, FlightDay::Other, damage)
}

/// The same of another scenario, seed and day.
///
/// # Panics
/// If the scenario is none or the navigator cannot begin or go on.
pub fn fly_as(
    name: &str,
    seed: u64,
    day: FlightDay,
    damage: impl Fn(&mut Flight),
) -> FlownScenario {
    let scenario = Scenario::named(name).expect("a scenario");
    let overrides = Overrides {
        day: Some(day),
        ..Overrides::default()
    };
    let SimulatedFlight {
        mut flight, frames, ..
    } = scenario.simulate(seed, &overrides);
    let mut frames = TakenOnce {
        flight: (scenario.name, seed, day.key()),
        frames: frames.over(ground(&scenario, day)),
    };
    damage(&mut flight);
    let mission = scenario.mission();
    let map = Arc::new(Scenario::map());
    let given = Arc::new(flight.clone());
    let navigator = Navigator::new(given, &KnownGround::of(&mission, map), &mission.navigator)
        .expect("the flight has what it takes");
    FlownScenario::by(navigator, &mut frames, flight)
}

/// A scenario with its seed and day, and the number of a picture of it.
type PictureOf = (&'static str, u64, &'static str, usize);

/// Pictures of a flight, each taken once for all that fly it in this program: whatever goes wrong afterwards, its
/// camera saw the same.
struct TakenOnce {
    flight: (&'static str, u64, &'static str),
    frames: SimulatedFrames,
}

impl FrameSource for TakenOnce {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let encoded = self.encoded(index)?;
        decode_picture(&encoded).map_err(|cause| FrameError::Unreadable {
            name: index.to_string(),
            cause: cause.to_string(),
        })
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        static TAKEN: Mutex<BTreeMap<PictureOf, Vec<u8>>> = Mutex::new(BTreeMap::new());
        let (name, seed, day) = self.flight;
        let of = (name, seed, day, index);
        let taken = || TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(encoded) = taken().get(&of) {
            return Ok(encoded.clone());
        }
        let encoded = self.frames.encoded(index)?;
        taken().insert(of, encoded.clone());
        Ok(encoded)
    }
}

/// Ground on the day of a flight, drawn once for all flights of this program over it.
fn ground(scenario: &Scenario, day: FlightDay) -> Arc<CachedImagery> {
    static DRAWN: Mutex<Vec<(FlightDay, Arc<CachedImagery>)>> = Mutex::new(Vec::new());
    let day = scenario.seen_on(day);
    let mut drawn = DRAWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, imagery)) = drawn.iter().find(|(of, _)| *of == day) {
        return Arc::clone(imagery);
    }
    let scenery = Arc::new(Scenery::new(DEMO_SEED, day.day()));
    let imagery = Arc::new(CachedImagery::new(scenery, GROUND_MEGABYTES));
    drawn.push((day, Arc::clone(&imagery)));
    imagery
}

/// The same without pictures: four landmarks of five can be recognised, in seven frames of ten.
///
/// # Panics
/// If the scenario is none or the navigator cannot begin or go on.
pub fn fly_as_stated(name: &str, seed: u64, damage: impl Fn(&mut Flight)) -> FlownScenario {
    let scenario = Scenario::named(name).expect("a scenario");
    let mut flight = scenario.fly(seed, &Overrides::default());
    damage(&mut flight);
    let mission = scenario.mission();
    let spread = Vector4::new(0.5, 0.5, 0.02, 0.02);
    let expected = ExpectedDetection {
        recognised: 0.8,
        per_frame: 0.7,
        covariance: Matrix4::from_diagonal(&spread.map(|sd: f64| sd * sd)),
    };
    let planned = mission.landmarks.iter().map(|landmark| PlannedLandmark {
        landmark: landmark.clone(),
        detection: DetectionStatistics::everywhere(expected),
    });
    let planned: Vec<PlannedLandmark> = planned.collect();
    let (detector, mut frames) = as_stated(&flight, &planned, seed).expect("a truth");
    let given = Arc::new(flight.clone());
    let (landmarks, settings) = (&mission.landmarks, &mission.navigator);
    let navigator = Navigator::with_detector(given, landmarks, Box::new(detector), settings)
        .expect("the flight has what it takes");
    FlownScenario::by(navigator, &mut frames, flight)
}

impl FlownScenario {
    fn by(navigator: Navigator, frames: &mut dyn FrameSource, flight: Flight) -> Self {
        let run = navigator.sparing().fly(frames, &|| 0.0);
        let run = run.expect("the filter goes on");
        Self { run, flight }
    }

    /// Share of the steps whose true position lies in the 95 % ellipse, and the largest error, metres.
    ///
    /// # Panics
    /// If the flight has no truth.
    pub fn consistency(&self) -> (f64, f64) {
        let truth = self.flight.truth.as_ref().expect("a truth");
        let (mut inside, mut steps, mut largest) = (0, 0, 0.0_f64);
        for step in &self.run.steps {
            let Some(place) = truth.position(step.time) else {
                continue;
            };
            let off = step.after.position().to_vector() - place.xy().coords;
            let inverse = step.after.position_covariance().try_inverse();
            let squared = (inverse.expect("it can be inverted") * off).dot(&off);
            inside += usize::from(squared < CHI_SQUARE_95);
            steps += 1;
            largest = largest.max(off.norm());
        }
        (f64::from(inside as u32) / f64::from(steps), largest)
    }

    /// Everything that was doubted, in words.
    pub fn doubts(&self) -> BTreeSet<String> {
        let doubts = self.run.steps.iter().flat_map(|step| &step.doubts);
        doubts.map(Doubt::words).collect()
    }

    /// Reasons why frames could not be used, in words.
    pub fn troubles(&self) -> BTreeSet<String> {
        let frames = self.run.steps.iter().filter_map(|s| s.frame.as_ref());
        frames.filter_map(|f| f.trouble.clone()).collect()
    }
}

/// Bound below which 95 % of the squared errors of two dimensions stay.
const CHI_SQUARE_95: f64 = 5.991;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_that_are_taken_once_are_those_of_the_flight() {
        let scenario = Scenario::named("distinct-400ft-wind").expect("a scenario");
        let mut frames = [2, 3].map(|seed| {
            let made = scenario.simulate(seed, &Overrides::default());
            let own = made.frames.over(ground(&scenario, made.day));
            let taken = TakenOnce {
                flight: (scenario.name, seed, made.day.key()),
                frames: own.clone(),
            };
            (taken, own)
        });
        for _ in 0..2 {
            for (taken, own) in &mut frames {
                for index in [0, 40] {
                    assert_eq!(taken.picture(index), own.picture(index), "{index}");
                }
            }
        }
        let (taken, _) = &mut frames[0];
        assert!(taken.picture(usize::MAX).is_err());
    }
}
