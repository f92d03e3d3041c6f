//! With what a plan is flown, and how high its routes lead.

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Altitude, GroundPoint, LocalFrame};
use pilotage_core::mission::{Route, WayPoint};
use pilotage_core::plan::{FlownWay, home_way_point};
use pilotage_core::simulate::{Scenario, Wind};

use crate::documents::Documents;
use pilotage_jobs::PlanCircumstances;

/// The mean wind of the open flight.
pub fn flight_wind(documents: &Documents) -> Wind {
    documents.flight.source.wind()
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

/// Circumstances with which orders of the plan are made, where the position is known to `position` metres per axis.
pub fn planned_with(documents: &Documents, position: f64) -> PlanCircumstances {
    PlanCircumstances {
        map: documents.map.source.clone(),
        camera: camera(documents),
        height: flown_height(documents),
        ground_down: ground_down(documents),
        navigator: documents.mission.navigator.clone(),
        position,
    }
}

/// A route over places, all at one altitude.
pub fn line(places: &[GroundPoint], altitude: Altitude) -> Route {
    let way_points = places.iter().map(|p| WayPoint::new(*p, altitude));
    Route {
        way_points: way_points.collect(),
        ..Route::default()
    }
}

/// Mean height of a route above the ground below it, metres; the usual one while it has no way-point.
pub fn height(route: &Route, documents: &Documents) -> f64 {
    let relief = documents.relief();
    let at = |p: &GroundPoint| relief.at(p);
    let mean = relief.under(route, &at).mean_above(route);
    mean.unwrap_or_else(|| usual_altitude(documents).metres)
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

/// Home as a way-point at the altitude of the last one, if a route of the mission returns there.
pub fn home_of(route: &Route, documents: &Documents) -> Option<WayPoint> {
    home_way_point(route, &LocalFrame::new(documents.mission.origin))
}

/// Way that an aircraft flies along a route which banks up to `bank`, radians.
pub fn flown_way(route: &Route, documents: &Documents, bank: f64) -> FlownWay {
    let relief = documents.relief();
    let at = |p: &GroundPoint| relief.at(p);
    let frame = LocalFrame::new(documents.mission.origin);
    FlownWay::along(route, &frame, &relief.under(route, &at), bank)
}

/// The altitude of a first way-point.
pub fn usual_altitude(documents: &Documents) -> Altitude {
    documents.flight.source.usual_altitude()
}
