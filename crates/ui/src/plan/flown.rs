//! With what a plan is flown, and how high and over which places its routes lead.

use std::f64::consts::TAU;

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Altitude, AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_core::mission::turn::turn_radius;
use pilotage_core::mission::{Route, WayPoint, WayPointAction, circles};
use pilotage_core::simulate::{
    Airframe, GuidanceSettings, Scenario, SimulationChoice, Target, Wind,
};

use super::profile::{ProfileSample, on_leg, profile};
use crate::documents::Documents;
use pilotage_jobs::{FlightSource, scenario_wind};

/// Height of a first way-point where no flight says another, metres above ground.
const USUAL_HEIGHT: f64 = 120.0;

/// Limits of the pieces in which a leg is predicted where the ground lets the height change otherwise than
/// evenly: from so many metres off on, and none shorter than that many, so that turns have room before they
/// begin.
const UNEVEN: f64 = 4.0;
const SHORTEST_PIECE: f64 = 200.0;
/// Places at which a piece is looked at.
const BENDS: u32 = 20;

/// Most circles that are predicted at a way-point.
pub const MOST_CIRCLES: f64 = 20.0;

/// Airspeed in cruise of the aircraft that is planned for, m/s.
pub fn cruise() -> f64 {
    Airframe::sig_kadet_senior().cruise
}

/// The mean wind of the open flight.
pub fn flight_wind(documents: &Documents) -> Wind {
    match &documents.flight.source {
        FlightSource::Simulated(options) => scenario_wind(options),
        FlightSource::Rehearsed(flight) => flight.path.wind,
        FlightSource::Studied(studied) => studied.flight.wind(),
        FlightSource::Files(_) | FlightSource::Nothing => Wind::default(),
    }
}

/// The camera that is planned with.
pub fn camera(documents: &Documents) -> CameraModel {
    let flown = documents.flight.measured.as_ref().map(|f| f.camera.clone());
    documents
        .mission
        .camera
        .clone()
        .or(flown)
        .unwrap_or_else(Scenario::camera)
}

/// Down coordinate of the ground plane, metres.
pub fn ground_down(documents: &Documents) -> f64 {
    documents
        .flight
        .measured
        .as_ref()
        .map_or(0.0, |f| f.ground_down)
}

/// A route over places, all at one altitude.
pub fn line(places: &[GroundPoint], altitude: Altitude) -> Route {
    let way_points = places.iter().map(|p| WayPoint::new(*p, altitude));
    Route {
        way_points: way_points.collect(),
        ..Route::default()
    }
}

/// Mean height of a route above the ground below it, metres.
pub fn height(route: &Route, documents: &Documents) -> f64 {
    let relief = documents.relief();
    let samples = profile(route, &|p| relief.at(p), relief.take_off(route));
    let (mut sum, mut length) = (0.0, 0.0);
    for pair in samples.windows(2) {
        let step = pair[1].distance - pair[0].distance;
        sum += step * 0.5 * (pair[0].above() + pair[1].above());
        length += step;
    }
    let first = || route.way_points.first().map(|w| relief.above(route, w));
    let mean = (length > 0.0).then(|| sum / length).or_else(first);
    mean.unwrap_or(USUAL_HEIGHT).max(1.0)
}

/// Height above ground of the selected route, or the usual one, metres.
pub fn flown_height(documents: &Documents) -> f64 {
    documents.mission.selected_route().map_or_else(
        || usual_altitude(documents).metres,
        |route| height(route, documents),
    )
}

/// Leg from the last way-point of a route to home, if it returns.
pub fn way_back(route: &Route, documents: &Documents) -> Option<[GroundPoint; 2]> {
    route.way_back(&LocalFrame::new(documents.mission.origin))
}

/// Home as a way-point at the altitude of the last one, if a route returns there.
pub fn home_way_point(route: &Route, documents: &Documents) -> Option<WayPoint> {
    let [_, home] = way_back(route, documents)?;
    Some(WayPoint::new(home, route.way_points.last()?.altitude))
}

/// Radius in metres, negative to the left, and number of the circles at a way-point, as an aircraft flies them that
/// banks up to `bank`, radians; `None` where it flies by. Waiting without an end is flown by as well.
pub fn circles_at(way_point: &WayPoint, bank: f64) -> Option<(f64, f64)> {
    let speed = way_point.speed.unwrap_or_else(cruise);
    let tightest = turn_radius(speed, GuidanceSettings::within(bank).planned_bank);
    let flown = |radius: f64| {
        let side = if radius < 0.0 { -1.0 } else { 1.0 };
        side * radius.abs().max(tightest)
    };
    match way_point.action {
        WayPointAction::Loiter { radius, turns } => Some((flown(radius), turns)),
        WayPointAction::Wait {
            radius,
            seconds: Some(seconds),
        } => {
            let radius = flown(radius);
            Some((radius, seconds * speed / (TAU * radius.abs())))
        }
        _ => None,
    }
}

/// Flown places of a route: its way-points with their heights above ground, metres, and airspeeds, and
/// between them places from which on the ground lets the height change otherwise; around way-points the circles
/// that an aircraft flies which banks up to `bank`, radians; and home, if it returns.
pub fn flown_over(
    route: &Route,
    documents: &Documents,
    bank: f64,
) -> (Vec<GroundPoint>, Vec<Target>) {
    let relief = documents.relief();
    let ground = |p: &GroundPoint| relief.at(p);
    let take_off = relief.take_off(route);
    let (mut places, mut targets) = (Vec::new(), Vec::new());
    let mut add = |sample: &ProfileSample, airspeed| {
        places.push(sample.place);
        targets.push(Target {
            height: sample.above().max(1.0),
            airspeed,
        });
    };
    let back = home_way_point(route, documents);
    let all: Vec<&WayPoint> = route.way_points.iter().chain(&back).collect();
    for (index, way_point) in all.iter().copied().enumerate() {
        let before = index.checked_sub(1).map(|i| all[i]);
        let leg = on_leg((before.unwrap_or(way_point), way_point), &ground, take_off);
        if let Some(before) = before.filter(|_| !relief.is_level()) {
            let length = before.position.distance(&way_point.position);
            let mut bends = Vec::new();
            let above = |share: f64| leg(share).above();
            bend(&above, (0.0, 1.0), SHORTEST_PIECE / length, &mut bends);
            for share in bends {
                add(&leg(share), way_point.speed);
            }
        }
        let around = before.and_then(|before| {
            let (radius, turns) = circles_at(way_point, bank)?;
            let after = all.get(index + 1).map(|next| &next.position);
            let turns = turns.min(MOST_CIRCLES);
            circles(&before.position, &way_point.position, after, radius, turns)
        });
        match around {
            Some(around) => {
                for place in around {
                    let there = WayPoint {
                        position: place,
                        ..way_point.clone()
                    };
                    add(
                        &on_leg((&there, &there), &ground, take_off)(1.0),
                        way_point.speed,
                    );
                }
            }
            None => add(&leg(1.0), way_point.speed),
        }
    }
    (places, targets)
}

/// Shares of a leg between `a` and `b` at which its height above ground stops to change evenly, no two
/// closer than `least`.
fn bend(above: &dyn Fn(f64) -> f64, (a, b): (f64, f64), least: f64, bends: &mut Vec<f64>) {
    let (from, to) = (above(a), above(b));
    let off = |s: f64| (above(s) - from - (s - a) / (b - a) * (to - from)).abs();
    let inner = (1..BENDS).map(|i| a + (b - a) * f64::from(i) / f64::from(BENDS));
    let worst = inner
        .filter(|s| s - a >= least && b - s >= least)
        .map(|s| (s, off(s)))
        .max_by(|x, y| x.1.total_cmp(&y.1));
    if let Some((at, _)) = worst.filter(|(_, off)| *off > UNEVEN) {
        bend(above, (a, at), least, bends);
        bends.push(at);
        bend(above, (at, b), least, bends);
    }
}

/// The altitude of a first way-point.
pub fn usual_altitude(documents: &Documents) -> Altitude {
    let flown = match &documents.flight.source {
        FlightSource::Simulated(options) => options
            .height
            .or_else(|| Some(SimulationChoice::named(&options.scenario)?.height)),
        FlightSource::Rehearsed(flight) => Some(flight.path.height),
        FlightSource::Studied(studied) => studied.flight.height(),
        FlightSource::Files(_) | FlightSource::Nothing => None,
    };
    Altitude::new(flown.unwrap_or(USUAL_HEIGHT), AltitudeFrame::AboveGround)
}
