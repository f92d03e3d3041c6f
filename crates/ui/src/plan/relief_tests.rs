//! Altitudes and predictions over a hill, and over level ground.

use pilotage_core::frames::{Altitude, Geodetic, GroundRect};
use pilotage_core::imagery::terrain::HeightGrid;

use super::super::flown::{height, line};
use super::super::planner::Planner;
use super::*;
use crate::context::route_of;
use crate::documents::Session;

const AREA: f64 = 4000.0;

/// Ground at 400 m with a ridge of 80 m across the way east, 800 m wide; nothing is known far west.
struct Ridge(HeightDatum);

impl pilotage_core::imagery::terrain::Terrain for Ridge {
    fn name(&self) -> &'static str {
        "ridge.tif"
    }
    fn datum(&self) -> &HeightDatum {
        &self.0
    }
    fn height_at(&self, place: &GroundPoint) -> Option<f64> {
        let up = 1.0 - ((place.east - 1000.0) / 400.0).abs();
        (place.east > -500.0).then_some(400.0 + 80.0 * up.max(0.0))
    }
}

fn documents(datum: HeightDatum) -> Documents {
    let mut documents = Documents::new(&Session::demo());
    let origin = Geodetic::from_degrees(46.0, -92.0, 0.0);
    documents.mission.origin = origin;
    let area = GroundRect::centered(GroundPoint::default(), AREA, AREA);
    documents.map.terrain = OpenedTerrain::of_files("opened-1");
    assert!(documents.map.terrain.wants(origin, &area));
    let ridge = Ridge(datum.clone());
    let mut grid = HeightGrid::over("ridge.tif", datum, area, 10.0, 1000);
    while !grid.take_rows(&ridge, 50) {}
    documents.map.terrain.take(grid);
    documents
}

fn geoid() -> HeightDatum {
    HeightDatum::MeanSeaLevel("EGM96".to_owned())
}

fn route(metres: f64, frame: AltitudeFrame, east: &[f64]) -> Route {
    let places: Vec<GroundPoint> = east.iter().map(|e| GroundPoint::new(0.0, *e)).collect();
    line(&places, Altitude::new(metres, frame))
}

/// The order of a prediction along a route of the mission.
fn order(documents: &mut Documents, route: Route) -> pilotage_jobs::PlannedPath {
    documents.mission.route = Some(documents.add_made(route, "Route"));
    Planner::default().order(documents).unwrap().path
}

#[test]
fn over_the_ridge_an_altitude_counts_from_what_it_names() {
    let documents = documents(geoid());
    let relief = documents.relief();
    let above = |frame| {
        let route = route(500.0, frame, &[0.0, 1000.0]);
        relief.above(&route, &route.way_points[1])
    };
    assert!((above(AltitudeFrame::Amsl) - 20.0).abs() < 0.1);
    assert!((above(AltitudeFrame::AboveTakeOff) - 420.0).abs() < 0.1);
    assert!((above(AltitudeFrame::AboveGround) - 500.0).abs() < 1e-9);
}

#[test]
fn altitudes_above_take_off_count_from_the_home_that_a_file_states() {
    let documents = documents(geoid());
    let relief = documents.relief();
    // Home on the ground at 400 m, the first way-point over the ridge at 480 m: 110 m above the one, 30 m above the other.
    let mut route = route(110.0, AltitudeFrame::AboveTakeOff, &[1000.0, 1900.0]);
    let above = |route: &Route| relief.above(route, &route.way_points[0]);
    let told = |route: &Route| relief.assumptions(route, Units::Metric).join(" ");
    assert!((above(&route) - 110.0).abs() < 0.1);
    assert!(told(&route).contains("Take-off is at the first way-point, 480 m AMSL."));
    let state_home = |route: &mut Route, place: GroundPoint| {
        let frame = pilotage_core::frames::LocalFrame::new(documents.mission.origin);
        let at = frame.geodetic_from_ground(&place);
        let home = format!(
            "[{}, {}, 0.0]",
            at.latitude.to_degrees(),
            at.longitude.to_degrees()
        );
        route.properties.insert("home".to_owned(), home);
    };
    state_home(&mut route, GroundPoint::new(0.0, 0.0));
    assert!((above(&route) - 30.0).abs() < 0.1, "{}", above(&route));
    assert!(told(&route).contains("Take-off is at home, 400 m AMSL."));
    // Of ground that the model does not know, nothing is counted.
    state_home(&mut route, GroundPoint::new(0.0, -900.0));
    assert!((above(&route) - 110.0).abs() < 0.1);
}

#[test]
fn a_level_flight_over_the_ridge_is_predicted_lower_there_and_one_above_ground_is_not() {
    let mut documents = documents(geoid());
    let level = order(
        &mut documents,
        route(520.0, AltitudeFrame::Amsl, &[0.0, 2000.0]),
    );
    assert!(level.way_points.len() > 3, "{:?}", level.way_points);
    assert_eq!(level.way_points.len(), level.targets.len());
    let over = |order: &pilotage_jobs::PlannedPath, east: f64| {
        let pairs = order.way_points.iter().zip(&order.targets);
        let near = pairs.min_by(|a, b| {
            let away = |p: &GroundPoint| (p.east - east).abs();
            away(a.0).total_cmp(&away(b.0))
        });
        near.unwrap().1.height
    };
    assert!((over(&level, 0.0) - 120.0).abs() < 0.1);
    assert!((over(&level, 1000.0) - 40.0).abs() < 6.0);
    // The ridge takes 80 m / 2 on 800 of 2000 m.
    assert!((level.height - 104.0).abs() < 1.0, "{}", level.height);
    for pair in level.way_points.windows(2) {
        assert!(pair[0].distance(&pair[1]) >= 199.0);
    }
    let follows = route(120.0, AltitudeFrame::AboveGround, &[0.0, 2000.0]);
    let follows = order(&mut documents, follows);
    assert_eq!(follows.way_points.len(), 2);
    assert!((follows.height - 120.0).abs() < 1e-6);
}

#[test]
fn without_an_elevation_model_the_stated_height_counts_and_undo_takes_it_back() {
    let mut documents = Documents::new(&Session::demo());
    let above = |documents: &Documents| {
        height(&route(520.0, AltitudeFrame::Amsl, &[0.0, 900.0]), documents)
    };
    assert!((above(&documents) - 520.0).abs() < 1e-9);
    for metres in [100.0, 250.0, 400.0] {
        documents.state_ground(metres, EditStep::Drag);
    }
    documents.state_ground(400.0, EditStep::Whole);
    assert!((above(&documents) - 120.0).abs() < 1e-9);
    let words = |documents: &Documents, units| {
        let route = route(1.0, AltitudeFrame::Amsl, &[0.0, 900.0]);
        documents.relief().words(&route, units)
    };
    assert_eq!(
        words(&documents, Units::Aviation),
        "level at 1312 ft AMSL, no elevation model is open"
    );
    assert_eq!(documents.mission.level_ground().take_off, 400.0);
    assert_eq!(
        documents.undo(),
        Some(false),
        "one step, and nothing is flown again"
    );
    assert!((above(&documents) - 520.0).abs() < 1e-9);
}

#[test]
fn what_the_elevation_model_does_not_know_is_said() {
    let of = |datum, east: &[f64]| {
        let documents = documents(datum);
        let route = route(500.0, AltitudeFrame::Amsl, east);
        (
            documents.relief().words(&route, Units::Metric),
            documents
                .relief()
                .assumptions(&route, Units::Metric)
                .join(" "),
        )
    };
    let (words, said) = of(geoid(), &[0.0, 900.0]);
    assert_eq!(words, "ridge.tif, heights above EGM96");
    assert!(
        said.contains("ridge.tif") && !said.contains("tens of metres"),
        "{said}"
    );
    let (words, _) = of(geoid(), &[-1000.0, 0.0]);
    let known = "ridge.tif, heights above EGM96; level at 0 m AMSL on the 5";
    assert!(words.starts_with(known), "{words}");
    let (words, _) = of(geoid(), &[-1500.0, -900.0]);
    assert!(words.ends_with("ridge.tif does not reach here"), "{words}");
    let (_, said) = of(HeightDatum::Ellipsoid, &[0.0, 900.0]);
    assert!(
        said.contains("above the ellipsoid") && said.contains("tens of metres"),
        "{said}"
    );
}

#[test]
fn ground_nearer_than_the_clearance_is_too_high_unless_the_route_follows_it() {
    let mut documents = documents(geoid());
    let highest = |documents: &mut Documents, metres, frame| {
        let route = route(metres, frame, &[0.0, 900.0]);
        documents.mission.route = Some(documents.add_made(route, "Route"));
        let mut planner = Planner::default();
        planner.preferences.find.ground_clearance = 60.0;
        planner.finder.from = Some(GroundPoint::default());
        planner.highest_ground(documents)
    };
    assert_eq!(
        highest(&mut documents, 520.0, AltitudeFrame::Amsl),
        Some(460.0)
    );
    let from_take_off = highest(&mut documents, 100.0, AltitudeFrame::AboveTakeOff);
    assert!((from_take_off.unwrap() - 440.0).abs() < 0.1);
    assert_eq!(
        highest(&mut documents, 120.0, AltitudeFrame::AboveGround),
        None
    );
    let low = highest(&mut documents, 40.0, AltitudeFrame::AboveGround);
    assert_eq!(low, Some(f64::NEG_INFINITY));
}

#[test]
fn a_route_that_begins_elsewhere_leads_as_high_as_before() {
    let mut documents = documents(geoid());
    // Take-off at 400 m; way-points over 400, 480 and 440 m.
    let id = documents.add_made(
        route(120.0, AltitudeFrame::AboveTakeOff, &[0.0, 1000.0, 1200.0]),
        "Route",
    );
    let of = |documents: &Documents, id| route_of(&documents.mission, id).unwrap().clone();
    let metres = |route: &Route| {
        let metres = route.way_points.iter().map(|w| w.altitude.metres.round());
        metres.collect::<Vec<_>>()
    };
    let whole = of(&documents, id);
    let relief = documents.relief();
    let mut back = whole.reversed();
    relief.keep_heights(&whole, &mut back);
    assert_eq!(metres(&back), [80.0; 3], "take-off at 440 m");
    for (now, then) in back.way_points.iter().zip(whole.way_points.iter().rev()) {
        let heights = [(&back, now), (&whole, then)];
        let heights = heights.map(|(route, it)| relief.above(route, it));
        assert!((heights[0] - heights[1]).abs() < 1e-9, "{heights:?}");
    }
    let mut again = back.reversed();
    relief.keep_heights(&back, &mut again);
    assert_eq!(again, whole);
    assert_eq!(
        relief.first_altitude(&whole),
        Some(Altitude::new(520.0, AltitudeFrame::Amsl))
    );
    let second = documents.split_route(id, 1).unwrap();
    assert_eq!(metres(&of(&documents, id)), [120.0; 2]);
    assert_eq!(metres(&of(&documents, second)), [40.0; 2], "from 480 m");
    // Other altitudes are as they were.
    let level = documents.add_made(
        route(520.0, AltitudeFrame::Amsl, &[0.0, 1000.0, 1200.0]),
        "Route",
    );
    let second = documents.split_route(level, 1).unwrap();
    assert_eq!(metres(&of(&documents, second)), [520.0; 2]);
}
