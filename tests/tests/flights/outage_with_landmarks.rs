//! Satellite navigation cut out of a flight whose camera saw landmarks meanwhile.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

use std::sync::Arc;

use pilotage_core::instruments::{
    Instruments, OutagePlan, OutageStudy, PositionFix, ReckonSettings, ReckoningWay, quantile,
    reckon, study_outages,
};
use pilotage_core::navigator::{KnownGround, Navigator, Run, position_fixes};
use pilotage_core::simulate::{Overrides, Scenario};

/// Seconds since a landmark that was seen just now.
const FRESH: f64 = 3.0;

/// A built-in flight, flown by its landmarks, and what it was flown from.
fn flown() -> (Arc<pilotage_core::flight::Flight>, Run) {
    let scenario = Scenario::named("distinct-400ft-wind").unwrap();
    let mut made = scenario.simulate(3, &Overrides::default());
    let (mission, map) = (scenario.mission(), Arc::new(Scenario::map()));
    let flight = Arc::new(made.flight);
    let settings = &mission.navigator;
    let navigator = Navigator::new(
        Arc::clone(&flight),
        &KnownGround::of(&mission, map),
        settings,
    );
    let navigator = navigator.unwrap().sparing();
    let run = navigator.fly(&mut made.frames, &|| 0.0);
    (flight, run.unwrap())
}

/// Mean of the normalised squared errors; 2 if the covariances are honest.
fn nees(flight: &pilotage_core::flight::Flight, fixes: &[PositionFix]) -> f64 {
    let truth = flight.truth.as_ref().unwrap();
    let squared = fixes.iter().map(|fix| {
        let off = fix.position.to_vector() - truth.position(fix.time).unwrap().xy().coords;
        (fix.covariance.try_inverse().unwrap() * off).dot(&off)
    });
    squared.sum::<f64>() / fixes.len() as f64
}

#[test]
fn landmarks_hold_the_position_through_cuts_in_which_airspeed_alone_drifts() {
    let (flight, run) = flown();
    let fixes = position_fixes(&run);
    let corrected = run.steps.iter().filter(|s| s.corrected()).count();
    let squared = nees(&flight, &fixes);
    println!(
        "{} positions of {corrected} corrected frames, NEES {squared:.2}",
        fixes.len()
    );
    assert!(2 * fixes.len() > corrected && corrected > 20);
    assert!((0.5..4.0).contains(&squared), "{squared}");

    let instruments = Instruments::of(&flight, None).unwrap();
    let settings = ReckonSettings::default();
    let plan = OutagePlan {
        length: 30.0,
        warm_up: 15.0,
        every: 2.0,
    };
    let study = |way: &ReckoningWay| {
        study_outages(&instruments, way, &plan, &settings, &mut |_| true).unwrap()
    };
    let alone = study(&ReckoningWay::air_and_wind());
    let seen = study(&ReckoningWay::with_fixes("with landmarks", fixes.clone()));
    assert_eq!(alone.outages.len(), seen.outages.len());
    // The outages at whose end a landmark was seen shortly before.
    let is_fresh = |time: f64| (fixes.iter()).any(|f| (time - FRESH..=time).contains(&f.time));
    let tell = |s: &OutageStudy| {
        let fresh = s.outages.iter().filter(|outage| is_fresh(outage.to));
        let errors: Vec<f64> = fresh.map(|outage| outage.error.norm()).collect();
        let median = quantile(errors.clone(), 0.5);
        println!(
            "{}: {} outages, {:.0} % inside, median {:.1} m; {} with a landmark at the end: median {median:.1} m",
            s.label,
            s.outages.len(),
            100.0 * s.covered(),
            s.error_quantile(0.5),
            errors.len()
        );
        median
    };
    let (drifted, held) = (tell(&alone), tell(&seen));
    assert!(held < 0.7 * drifted && held < 6.0, "{held} m, {drifted} m");
    assert!(seen.covered() >= 0.85, "{}", seen.covered());

    // One outage says the same as the study's.
    let outage = seen.outages[seen.outages.len() / 2];
    let way = ReckoningWay::with_fixes("with landmarks", fixes);
    let one = reckon(
        &instruments,
        (outage.from, outage.to),
        &[way],
        &settings,
        |_| true,
    )
    .unwrap();
    let growth = one.tracks[0].growth(one.outage);
    let last = growth.last().unwrap();
    let told = last.error.unwrap();
    assert!(
        (told - outage.error.norm()).abs() < 0.3 * outage.error.norm() + 1.0,
        "{told} {outage:?}"
    );
}
