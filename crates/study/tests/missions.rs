//! Missions as a plan flies them: what the plan says holds, and what it does not say is the mission's.

use pilotage_core::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint};
use pilotage_core::mission::{Mission, Route, WayPoint};
use pilotage_core::navigator::{ChosenAid, EstimatorChoice, NavigatorSettings, VehicleChoice};
use pilotage_study::{PreparedFlight, StudyDesign, StudyError, StudyPlan};

/// A mission along a route of that length, metres, by a navigator of its own.
fn mission(length: f64) -> Mission {
    let mut mission = Mission::new("River", Geodetic::from_degrees(46.8, -92.0, 183.0));
    let altitude = Altitude::new(120.0, AltitudeFrame::AboveGround);
    let ends = [0.0, length].map(|north| WayPoint::new(GroundPoint::new(north, 0.0), altitude));
    mission.routes.push(Route {
        name: "Out".to_owned(),
        way_points: ends.into(),
        ..Route::default()
    });
    let navigator = &mut mission.navigator;
    navigator.vehicle = VehicleChoice::AirplaneWind;
    navigator.estimator.choice = EstimatorChoice::Extended;
    navigator.alpha = 0.3;
    navigator.gate_confidence = 0.98;
    navigator.measurement_scale = 2.5;
    navigator.shortest_step = 0.5;
    navigator.aids = vec![
        ChosenAid::usual("map-edges"),
        ChosenAid::usual("gps-position")
            .with("noise", 30.0)
            .with("apart", 4.0),
    ];
    mission
}

fn plan_of(mission: &Mission, more: &str) -> Result<StudyPlan, StudyError> {
    let text = format!(
        r#"
        name = "routes"
        question = "?"
        draws = 1
        {more}
        measure = [{{ of = "error-rms" }}]
        "#
    );
    StudyPlan::read_with(&text, &mut |_| Ok(mission.clone()))
}

/// The first flight of a plan, as it is prepared.
fn prepared(mission: &Mission, more: &str) -> PreparedFlight {
    let plan = plan_of(mission, more).expect("the plan reads");
    let run = StudyDesign::new(plan).run(0).expect("a run of it");
    run.flight().prepare().expect("it is flown")
}

fn flown(prepared: &PreparedFlight) -> f64 {
    let truth = prepared.flight.truth.as_ref().expect("it has a truth");
    truth.states.last().expect("it has states").time
}

#[test]
fn what_a_plan_states_holds_wherever_it_names_the_mission() {
    let mission = mission(4000.0);
    for named in [
        "fixed.mission = \"river.geojson\"",
        "cross.mission = [\"river.geojson\"]",
        "draw.mission = { choice = [\"river.geojson\"] }",
    ] {
        let stated = "fixed.seconds = 20\nfixed.told = \"yes\"\nfixed.noise-heading = 3";
        let told = prepared(&mission, &format!("{stated}\n{named}"));
        assert!(
            (flown(&told) - 20.0).abs() < 0.1,
            "{named}: {}",
            flown(&told)
        );
        assert!(told.settings.sensors.yaw > 3_f64.to_radians(), "{named}");
        let (own, all) = (prepared(&mission, named), 4000.0 / 20.0);
        assert!(flown(&own) > all, "{named}: {}", flown(&own));
        assert_eq!(own.settings.process, mission.navigator.process, "{named}");
    }
}

#[test]
fn a_mission_is_navigated_by_its_own_settings_but_for_what_the_plan_says() {
    let mission = mission(1000.0);
    let stated = &mission.navigator;
    let of = |settings: &NavigatorSettings| {
        let estimator = settings.estimator.choice;
        let scales = [settings.measurement_scale, settings.shortest_step];
        (
            estimator,
            scales,
            [settings.alpha, settings.gate_confidence],
        )
    };
    let named = "fixed.mission = \"river.geojson\"\nfixed.seconds = 30\n";
    let own = prepared(&mission, named);
    assert_eq!(of(&own.settings), of(stated));
    // Without the aid that looks at pictures, and with readings as the other says.
    assert_eq!(own.settings.aids, stated.aids[1..]);
    let channels = own.flight.channels.iter();
    let north = channels
        .clone()
        .find(|channel| channel.name.key() == "gps_north")
        .expect("its readings");
    assert!((north.times[1] - north.times[0] - 4.0).abs() < 1e-6);
    let truth = own.flight.truth.as_ref().expect("it has a truth");
    let errors = north.times.iter().zip(&north.values).map(|(time, value)| {
        let position = truth.position(*time).expect("it is flown then");
        (value - position.x).powi(2)
    });
    let rms = (errors.sum::<f64>() / north.times.len() as f64).sqrt();
    assert!((10.0..60.0).contains(&rms), "{rms}");

    let more = "estimator = \"ukf\"\nmeasurement-scale = 1\nstep = 0\naids = \"none\"\n";
    let more = more.lines().map(|line| format!("fixed.{line}\n"));
    let other = prepared(&mission, &(named.to_owned() + &more.collect::<String>()));
    assert_eq!(
        of(&other.settings),
        (EstimatorChoice::Unscented, [1.0, 0.0], [0.3, 0.98])
    );
    assert!(other.settings.aids.is_empty());

    // Told of the errors, it still is the mission's in all else.
    let told = prepared(&mission, &format!("{named}fixed.told = \"yes\""));
    assert_eq!(of(&told.settings), of(stated));
    assert_ne!(told.settings.process, stated.process);

    let notes = plan_of(&mission, named).expect("the plan reads").notes();
    let is_told = |note: &String| note.contains("aids");
    let told: Vec<&String> = notes.iter().filter(|note| is_told(note)).collect();
    assert!(
        told.len() == 2
            && told[0].ends_with("aids = \"none\": gps-position")
            && told[1].ends_with("left out: map-edges"),
        "{notes:?}"
    );
    let none = plan_of(&mission, &format!("{named}fixed.aids = \"none\""));
    assert!(!none.expect("the plan reads").notes().iter().any(is_told));
}

#[test]
fn a_name_that_two_routes_have_is_refused() {
    let mut mission = mission(1000.0);
    mission.routes.push(mission.routes[0].clone());
    let route = "cross.route = [\"Out\"]\nfixed.mission = \"river.geojson\"";
    let why = plan_of(&mission, route).expect_err("which of the two is not said");
    let why = why.to_string();
    assert!(
        why.contains("river.geojson: 2 of its routes are called \"Out\""),
        "{why}"
    );
    // The first one needs no name.
    let first = "fixed.mission = \"river.geojson\"\nfixed.seconds = 5";
    let plan = plan_of(&mission, first).expect("the first is meant");
    let run = StudyDesign::new(plan).run(0).expect("a run of it");
    assert!((run.flight().lasts() - 5.0).abs() < 1e-9);
}

#[test]
fn a_route_that_is_cut_at_an_hour_is_told() {
    let long = mission(100_000.0);
    let named = "fixed.mission = \"river.geojson\"";
    let notes = |mission: &Mission, more: &str| {
        let plan = plan_of(mission, &format!("{named}\n{more}"));
        let notes = plan.expect("the plan reads").notes().into_iter();
        let of_time = notes.filter(|note| note.contains("min are flown"));
        of_time.collect::<Vec<_>>()
    };
    let told = notes(&long, "cross.route = [\"Out\"]");
    assert!(
        told.len() == 1 && told[0].starts_with("the route \"Out\" of river.geojson takes"),
        "{told:?}"
    );
    assert!(notes(&long, "")[0].starts_with("the first route of river.geojson takes"));
    // Who says a time knows it.
    assert!(notes(&long, "fixed.seconds = 600").is_empty());
    assert!(notes(&mission(1000.0), "").is_empty());
}
