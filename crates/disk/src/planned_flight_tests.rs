//! Plans of mission files: flown over the ground, around their way-points and home, as on the page.

use pilotage_core::mission::{WayPointAction, write_mission};

use super::*;

/// A tile of heights of 3 seconds north and east of the world's origin: 400 m, and a ridge of 80 m across the way east
/// 1000 m from there, 800 m wide.
fn tile() -> Vec<u8> {
    let metres_per_post = 111_412.0 * 45_f64.to_radians().cos() / 1200.0;
    let height = |column: u32| {
        let east = metres_per_post * f64::from(column);
        let up = 1.0 - ((east - 1000.0) / 400.0).abs();
        (400.0 + 80.0 * up.max(0.0)).round() as i16
    };
    let row: Vec<u8> = (0..1201).flat_map(|c| height(c).to_be_bytes()).collect();
    row.repeat(1201)
}

/// A route 100 m north of the origin, at 520 m above the sea, around its second way-point and back.
fn route() -> Route {
    let altitude = Altitude::new(520.0, AltitudeFrame::Amsl);
    let at = |east| WayPoint::new(GroundPoint::new(100.0, east), altitude);
    let mut way_points = vec![at(100.0), at(2000.0), at(2900.0)];
    way_points[1].action = WayPointAction::Loiter {
        radius: 120.0,
        turns: 1.0,
    };
    Route {
        name: "There".to_owned(),
        way_points,
        returns: true,
        ..Route::default()
    }
}

/// Plan of a mission with that route, by arguments that are changed.
fn planned(change: impl FnOnce(&mut PlanSource, &Path)) -> PlannedFlight {
    let name = format!("pilotage-planned-{:?}", std::thread::current().id());
    let folder = std::env::temp_dir().join(format!("{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mut mission = Scenario::named("distinct-400ft-calm").unwrap().mission();
    mission.routes = vec![route()];
    let file = folder.join("mission.geojson");
    std::fs::write(&file, write_mission(&mission)).unwrap();
    let mut source = PlanSource {
        mission: Some(file),
        ..PlanSource::default()
    };
    change(&mut source, &folder);
    let found = PlannedFlight::at(&source).map_err(|e| e.to_string());
    std::fs::remove_dir_all(&folder).unwrap();
    found.unwrap()
}

fn path(planned: &PlannedFlight) -> &PlannedPath {
    &planned.plan.as_ref().unwrap().path
}

#[test]
fn a_route_is_flown_around_its_way_points_and_home() {
    let level = planned(|_, _| ());
    let flown = path(&level);
    let home = flown.way_points.last().unwrap();
    assert!(home.distance(&GroundPoint::new(100.0, 100.0)) < 0.1);
    let around = GroundPoint::new(100.0, 2000.0);
    let circle = flown
        .way_points
        .iter()
        .filter(|p| p.distance(&around) < 140.0);
    assert!(circle.count() >= 8, "{:?}", flown.way_points);
    assert_eq!(flown.targets.len(), flown.way_points.len());
    assert!(
        flown
            .targets
            .iter()
            .all(|t| (t.height - 520.0).abs() < 1e-6)
    );
}

#[test]
fn above_the_sea_it_is_lower_over_the_ridge_of_an_elevation_model() {
    let planned = planned(|source, folder| {
        let dem = folder.join("N45W030.hgt");
        std::fs::write(&dem, tile()).unwrap();
        source.dem = Some(dem);
    });
    let flown = path(&planned);
    let over = |east: f64| {
        let away = |p: &GroundPoint| (p.east - east).abs();
        let pairs = flown.way_points.iter().zip(&flown.targets);
        pairs
            .min_by(|a, b| away(a.0).total_cmp(&away(b.0)))
            .unwrap()
            .1
            .height
    };
    assert!((over(100.0) - 120.0).abs() < 1.0, "{}", over(100.0));
    // The legs are looked at every 50 m: within 25 m of the ridge's top, which is 5 m lower there.
    assert!((39.0..46.0).contains(&over(1000.0)), "{}", over(1000.0));
    // The ridge takes half of 80 m on 800 of the 2800 m over the way-points.
    assert!((flown.height - (120.0 - 40.0 * 800.0 / 2800.0)).abs() < 1.5);
    assert_eq!(planned.height, flown.height);
}

#[test]
fn a_stated_height_is_flown_above_the_ground_everywhere() {
    let planned = planned(|source, _| source.height = Some(90.0));
    assert!((planned.height - 90.0).abs() < 1e-9);
    assert_eq!(planned.height, path(&planned).height);
    assert!(path(&planned).targets.iter().all(|t| t.height == 90.0));
    assert_eq!(planned.altitude.frame, AltitudeFrame::AboveGround);
}
