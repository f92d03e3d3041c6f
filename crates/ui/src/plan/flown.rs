//! With what a plan is flown, and how high its routes lead.

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Altitude, GroundPoint, LocalFrame};
use pilotage_core::mission::{Route, WayPoint};
use pilotage_core::plan::{FlownWay, home_way_point};
use pilotage_core::simulate::{Scenario, Wind};

use crate::documents::Documents;
use pilotage_jobs::{PlanCircumstances, PlannedPath};

/// The mean wind of the open flight, if it is known.
pub fn flight_wind(documents: &Documents) -> Option<Wind> {
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

/// Pictures a second that the camera of the open flight takes, if it took any.
fn frame_rate(documents: &Documents) -> Option<f64> {
    let flown = documents.flight.measured.as_ref();
    flown.and_then(PlannedPath::frame_rate_of)
}

/// Pictures a second with which is planned, where that is fewer than usual.
pub fn planned_frame_rate(documents: &Documents) -> Option<f64> {
    PlannedPath::sparse(frame_rate(documents))
}

/// Sentence on how often a picture is assumed to be taken.
pub fn pictures_words(documents: &Documents) -> String {
    let own = frame_rate(documents);
    let usual = PlannedPath::usual_frame_rate();
    match (own, PlannedPath::sparse(own)) {
        (_, Some(rate)) => format!("A picture every {:.1} s, as on the flight.", 1.0 / rate),
        (Some(own), None) if own > 1.01 * usual => {
            format!("{usual} pictures a second, of the {own:.0} that the flight's camera takes.")
        }
        (Some(_), None) => format!("{usual} pictures a second, as on the flight."),
        (None, None) => format!("{usual} pictures a second."),
    }
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

#[cfg(test)]
mod tests {
    use pilotage_core::flight::{Flight, Frame, StartFix};

    use super::super::planner::Planner;
    use super::super::route_tab::assumptions;
    use super::*;
    use crate::documents::Session;
    use crate::units::Units;

    /// A flight with three pictures so many seconds apart.
    fn photographed(apart: f64) -> Flight {
        let frames = (0..3).map(|number| Frame {
            time: apart * f64::from(number),
            name: String::new(),
            stored_turn: 0.0,
        });
        Flight {
            name: String::new(),
            frame_on_globe: None,
            camera: Scenario::camera(),
            ground_down: 0.0,
            channels: Vec::new(),
            frames: frames.collect(),
            start: StartFix {
                time: 0.0,
                position: GroundPoint::default(),
                standard_deviation: 1.0,
            },
            truth: None,
        }
    }

    #[test]
    fn a_route_is_planned_with_as_few_pictures_as_the_open_flight_has_and_says_so() {
        let mut documents = Documents::new(&Session::demo());
        let places = [0.0, 900.0].map(|east| GroundPoint::new(0.0, east));
        let route = line(&places, usual_altitude(&documents));
        documents.mission.route = Some(documents.add_made(route, "Route"));
        let planner = Planner::default();
        for (apart, rate, words) in [
            (None, None, "2 pictures a second."),
            (
                Some(4.0),
                Some(0.25),
                "A picture every 4.0 s, as on the flight.",
            ),
            (Some(0.5), None, "2 pictures a second, as on the flight."),
            (
                Some(0.04),
                None,
                "2 pictures a second, of the 25 that the flight's camera takes.",
            ),
        ] {
            documents.flight.measured = apart.map(photographed);
            let planned = planner.order(&documents).unwrap().path.frame_rate;
            assert_eq!(planned, rate, "{words}");
            let route = documents.mission.selected_route().unwrap();
            let said = assumptions(&planner, &documents, route, Units::Metric);
            assert!(said.iter().any(|it| it == words), "{said:?}");
        }
    }
}
