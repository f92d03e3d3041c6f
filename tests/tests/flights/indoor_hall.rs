//! A quadcopter in a hall, after the indoor flight of DeAngelo 2016, chapter 6: 625 square feet of floor,
//! 10 ft above it. The thesis states errors within 2 ft with pictures and quick divergence without.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

use std::sync::Arc;

use nalgebra::{Matrix2, Vector2};
use pilotage_core::flight::{Flight, FrameError, FrameSource};
use pilotage_core::frames::units::feet;
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::{
    KnownGround, Navigator, NavigatorSettings, Run, StepReport, VehicleChoice,
};
use pilotage_core::raster::Picture;
use pilotage_core::simulate::IndoorHall;
use pilotage_tests::studies::either;
use pilotage_tests::threads::on_all_processors;

/// Flights of a study, and of the everyday run.
const SEEDS: [u64; 5] = [1, 2, 3, 4, 5];
const EVERYDAY: usize = 2;
const MODELS: [VehicleChoice; 2] = [VehicleChoice::Multirotor, VehicleChoice::VelocityDriven];
/// Seconds after which the first fixes have been taken.
const SETTLED: f64 = 3.0;
/// Twice this squared is the chi-square of two degrees of freedom that holds 95 %.
const INSIDE_95: f64 = 5.991;

/// Pictures taken once for both models.
struct Taken(Vec<Picture>);

impl FrameSource for Taken {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let picture = self.0.get(index).cloned();
        picture.ok_or(FrameError::OutOfRange(index))
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        Err(FrameError::OutOfRange(index))
    }
}

struct Flown {
    flight: Arc<Flight>,
    frames: Taken,
}

fn fly(hall: &IndoorHall, seed: u64) -> Flown {
    let mut flown = hall.simulate(seed);
    let frames = 0..flown.flight.frames.len();
    let pictures = frames.map(|i| flown.frames.picture(i).unwrap());
    Flown {
        frames: Taken(pictures.collect()),
        flight: Arc::new(flown.flight),
    }
}

fn map() -> Arc<dyn Imagery> {
    Arc::new(CachedImagery::new(Arc::new(IndoorHall::map()), 32))
}

fn navigate(
    flown: &mut Flown,
    landmarks: &[Landmark],
    map: &Arc<dyn Imagery>,
    settings: &NavigatorSettings,
) -> Run {
    let flight = Arc::clone(&flown.flight);
    let ground = KnownGround::new(map.clone()).with_landmarks(landmarks);
    let navigator = Navigator::new(flight, &ground, settings).unwrap();
    navigator.fly(&mut flown.frames, &|| 0.0).unwrap()
}

/// Error of the position after a step, metres north and east.
fn error(flight: &Flight, step: &StepReport) -> Vector2<f64> {
    let truth = flight.truth.as_ref().unwrap().position(step.time).unwrap();
    step.after.position().to_vector() - truth.xy().coords
}

#[derive(Debug)]
struct Figures {
    rms: f64,
    largest: f64,
    /// Share of the steps whose truth lies in their own 95 % ellipse.
    inside: f64,
    /// Mean of the normalized estimation error squared; 2 if honest.
    nees: f64,
    corrected: usize,
}

fn figures(flight: &Flight, run: &Run) -> Figures {
    let settled = || run.steps.iter().filter(|s| s.time >= SETTLED);
    let (mut squares, mut nees) = (Vec::new(), Vec::new());
    for step in settled() {
        let off = error(flight, step);
        let covariance: Matrix2<f64> = step.after.position_covariance();
        squares.push(off.norm_squared());
        nees.push(off.dot(&(covariance.try_inverse().unwrap() * off)));
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let inside = nees.iter().filter(|n| **n <= INSIDE_95).count() as f64;
    Figures {
        rms: mean(&squares).sqrt(),
        largest: squares.iter().copied().fold(0.0, f64::max).sqrt(),
        inside: inside / nees.len() as f64,
        nees: mean(&nees),
        corrected: run.steps.iter().filter(|s| s.corrected()).count(),
    }
}

/// Result of navigating one flight on one model.
struct Outcome {
    seed: u64,
    model: VehicleChoice,
    flight: Arc<Flight>,
    run: Run,
    figures: Figures,
}

/// Every seed on both models, the seeds side by side.
fn study(hall: &IndoorHall) -> Vec<Outcome> {
    let map = map();
    let of_seed = |seed| {
        let mut flown = fly(hall, seed);
        MODELS.map(|model| {
            let mission = hall.mission(model);
            let run = navigate(&mut flown, &mission.landmarks, &map, &mission.navigator);
            let figures = figures(&flown.flight, &run);
            println!("seed {seed}, {}: {figures:.3?}", model.label());
            Outcome {
                seed,
                model,
                flight: Arc::clone(&flown.flight),
                run,
                figures,
            }
        })
    };
    let seeds = &SEEDS[..either(EVERYDAY, SEEDS.len())];
    let outcomes = on_all_processors(seeds, |seed| of_seed(*seed));
    outcomes.into_iter().flatten().collect()
}

/// Distance of the wind of a step from the draught, m/s, and the same in standard deviations.
fn wind_error(hall: &IndoorHall, step: &StepReport) -> (f64, f64) {
    let estimate = Vector2::new(step.after.mean[2], step.after.mean[3]);
    let covariance: Matrix2<f64> = step.after.covariance.fixed_view::<2, 2>(2, 2).into_owned();
    let off = estimate - hall.draught;
    let normalized = off.dot(&(covariance.try_inverse().unwrap() * off));
    (off.norm(), normalized.sqrt())
}

#[test]
fn both_models_stay_within_the_bars_and_the_draught_is_found() {
    let hall = IndoorHall::default();
    let outcomes = study(&hall);
    for o in &outcomes {
        let f = &o.figures;
        let last = o.run.steps.last().unwrap();
        assert!(last.time > 60.0 && f.corrected > 100, "{}", o.seed);
        assert!(f.rms <= 0.15, "seed {}: {f:?}", o.seed);
        assert!(f.largest <= feet(2.0), "seed {}: {f:?}", o.seed);
        // Without pictures both drift away, as in the thesis; that by roll and pitch quickly.
        let truth = o.flight.truth.as_ref().unwrap();
        let unaided =
            last.dead_reckoned.to_vector() - truth.position(last.time).unwrap().xy().coords;
        println!(
            "seed {}, {}: unaided {:.1} m",
            o.seed,
            o.model.label(),
            unaided.norm()
        );
        assert!(unaided.norm() > feet(2.0), "{unaided}");
        if o.model == VehicleChoice::Multirotor {
            let (before, _) = wind_error(&hall, &o.run.steps[0]);
            let (after, deviations) = wind_error(&hall, last);
            println!(
                "    wind off by {before:.2}, then {after:.3} m/s, {deviations:.1} deviations"
            );
            assert!((before - 0.5).abs() < 1e-6);
            assert!(
                after <= 0.15 && deviations <= 3.0,
                "{after} m/s, {deviations}"
            );
        }
    }
    for model in MODELS {
        let of_model = || {
            outcomes
                .iter()
                .filter(|o| o.model == model)
                .map(|o| &o.figures)
        };
        let mean =
            |of: fn(&Figures) -> f64| of_model().map(of).sum::<f64>() / of_model().count() as f64;
        let (inside, nees) = (mean(|f| f.inside), mean(|f| f.nees));
        println!("{}: {inside:.3} inside, NEES {nees:.2}", model.label());
        assert!((0.85..=1.0).contains(&inside), "{inside}");
    }
}
