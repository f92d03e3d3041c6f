use std::sync::Arc;

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_mission::mission::NoFlyZone;
use proptest::prelude::*;

use super::*;
use crate::field::Localizability;
use crate::question::{BudgetOf, Forbidden};
use crate::turns::{Turns, flown};

fn point(north: f64, east: f64) -> GroundPoint {
    GroundPoint::new(north, east)
}

/// A field with a probability of `p` within 60 m of each place.
fn field(places: &[GroundPoint], p: f32) -> Arc<Localizability> {
    let region = GroundRect {
        south: -600.0,
        north: 3600.0,
        west: -1600.0,
        east: 1600.0,
    };
    let mut field = Localizability::unknown(&region, 25.0);
    for row in 0..field.rows {
        for column in 0..field.columns {
            let at = field.place(column, row);
            let lit = places.iter().any(|place| place.distance(&at) < 60.0);
            field.values[row * field.columns + column] = if lit { p } else { 0.0 };
        }
    }
    Arc::new(field)
}

fn question(fixes: &[GroundPoint]) -> RouteQuestion {
    RouteQuestion {
        from: point(0.0, 0.0),
        to: point(3000.0, 0.0),
        field: field(fixes, 0.95),
        pass: 100.0,
        no_fly: Vec::new(),
        clearance: 20.0,
        forbidden: None,
        airspeed: 20.0,
        before_first_fix: 1.0,
        wind: Vector2::zeros(),
        turns: Turns {
            radius: 65.0,
            roll_in: 10.0,
        },
        budget: 1.3,
        budget_of: BudgetOf::Length,
        aim: Aim::Worst,
    }
}

#[test]
fn a_line_against_a_wind_that_is_too_strong_is_worth_nothing() {
    let line = [point(0.0, 0.0), point(3000.0, 0.0)];
    let judged = |wind: f64| {
        let windy = RouteQuestion {
            wind: Vector2::new(wind, 0.0),
            ..question(&[])
        };
        windy.judge(&line).map(|route| route.time)
    };
    assert_eq!(judged(0.0), Some(150.0));
    assert_eq!(judged(-10.0), Some(300.0));
    assert_eq!(judged(-21.0), None);
}

#[test]
fn a_detour_over_fixes_is_taken_while_the_budget_allows_it() {
    let fixes = [point(900.0, 600.0), point(2100.0, 600.0)];
    let found = question(&fixes).find().unwrap();
    assert!((found.shortest.worst_blind - 3000.0).abs() < 1e-6);
    assert!(found.surest.way_points.len() <= 5, "{found:?}");
    assert!(found.surest.worst_blind < 1700.0, "{found:?}");
    assert!(found.surest.length <= 1.3 * 3000.0);
    let poor = RouteQuestion {
        budget: 1.02,
        ..question(&fixes)
    };
    assert_eq!(poor.find().unwrap().surest.way_points.len(), 2);
}

#[test]
fn fixes_that_are_often_missed_are_worth_less_of_a_detour() {
    let fixes = [point(1500.0, 500.0)];
    let sure = question(&fixes).find().unwrap().surest;
    let doubtful = RouteQuestion {
        field: field(&fixes, 0.3),
        ..question(&fixes)
    };
    let doubtful = doubtful.find().unwrap().surest;
    assert!(sure.worst_blind < 0.75 * doubtful.worst_blind);
}

#[test]
fn a_no_fly_area_is_flown_around_with_its_clearance() {
    let area = [
        (1400.0, -900.0),
        (1600.0, -900.0),
        (1600.0, 300.0),
        (1400.0, 300.0),
    ];
    let area = NoFlyZone {
        corners: area.map(|(n, e)| point(n, e)).to_vec(),
        ..NoFlyZone::default()
    };
    let asked = RouteQuestion {
        no_fly: vec![area],
        ..question(&[])
    };
    let found = asked.clone().find().unwrap();
    let route = &found.shortest;
    assert!(
        route.way_points.iter().any(|p| p.east >= 320.0),
        "{route:?}"
    );
    assert!(route.length > 3000.0 && route.length < 3150.0, "{route:?}");
    assert!(asked.judge(&route.way_points).is_some());
    let walled = RouteQuestion {
        to: point(1500.0, 0.0),
        ..asked
    };
    assert_eq!(walled.find(), Err(FindError::EndForbidden("B")));
}

/// Least distance between the flown path of a route and a square area at the origin that reaches north and east, metres;
/// negative over it.
fn clearance_of_the_corner(route: &FoundRoute, turns: &Turns) -> f64 {
    let path = flown(&route.way_points, turns);
    let off = |p: GroundPoint| {
        let (north, east) = (-p.north, -p.east);
        if north > 0.0 && east > 0.0 {
            north.hypot(east)
        } else {
            north.max(east)
        }
    };
    let pieces = path.windows(2).flat_map(|piece| {
        let way = piece[1].to_vector() - piece[0].to_vector();
        let from = piece[0].to_vector();
        (0..=100).map(move |i| GroundPoint::from(from + way * (f64::from(i) / 100.0)))
    });
    pieces.map(off).fold(f64::INFINITY, f64::min)
}

/// From one side of a square of two kilometres around its corner at the origin to the other, with a wind behind of so many
/// m/s.
fn around_the_corner(wind: f64) -> RouteQuestion {
    let area = [(0.0, 0.0), (0.0, 2000.0), (2000.0, 2000.0), (2000.0, 0.0)];
    RouteQuestion {
        from: point(1500.0, -60.0),
        to: point(-60.0, 1500.0),
        no_fly: vec![NoFlyZone {
            corners: area.map(|(n, e)| point(n, e)).to_vec(),
            ..NoFlyZone::default()
        }],
        turns: Turns::of_flight(crate::cruise() + wind, crate::planned_aircraft().bank_limit),
        ..question(&[])
    }
}

#[test]
fn turns_around_the_corner_of_an_area_keep_the_clearance_that_was_asked_for() {
    // Turns of 65 m, of 105 m and of 153 m: at 29 m off the corner, as near as legs of 20 m clearance may lead, a right angle
    // of the last would be flown 35 m into the area.
    for wind in [0.0, 5.0, 10.0] {
        let asked = around_the_corner(wind);
        let turns = asked.turns;
        let found = asked.find().unwrap();
        for route in [&found.shortest, &found.surest] {
            let kept = clearance_of_the_corner(route, &turns);
            assert!(kept > 20.0 - 1e-3, "{wind} m/s: {kept} m of {route:?}");
            assert!(route.length < 3300.0, "{route:?}");
        }
    }
}

#[test]
fn turns_do_not_cut_into_high_ground() {
    let asked = around_the_corner(10.0);
    let asked = RouteQuestion {
        no_fly: Vec::new(),
        forbidden: Some(Arc::new(|p| p.north.min(p.east) > 0.0)),
        ..asked
    };
    let turns = asked.turns;
    let line = [asked.from, point(-20.0, -20.0), asked.to];
    assert!(line.windows(2).all(|leg| asked.allows(&leg[0], &leg[1])));
    assert!(asked.judge(&line).is_none(), "the turn there is over it");
    let found = asked.find().unwrap();
    let kept = clearance_of_the_corner(&found.shortest, &turns);
    // Places are looked at by the step of the field.
    assert!(kept > -5.0, "{kept} m");
}

#[test]
fn high_ground_is_flown_around_too() {
    // A ridge across the way with a gap in the east.
    let ridge: Forbidden =
        Arc::new(|p: &GroundPoint| (1400.0..1600.0).contains(&p.north) && p.east < 500.0);
    let asked = RouteQuestion {
        forbidden: Some(Arc::clone(&ridge)),
        ..question(&[])
    };
    let found = asked.find().unwrap();
    for leg in found.shortest.way_points.windows(2) {
        for i in 0..=200 {
            let way = leg[1].to_vector() - leg[0].to_vector();
            let at = GroundPoint::from(leg[0].to_vector() + way * (f64::from(i) / 200.0));
            let cut = (1410.0..1590.0).contains(&at.north) && at.east < 490.0;
            assert!(!cut, "{at:?}");
        }
    }
    let wall: Forbidden = Arc::new(|p: &GroundPoint| (1400.0..1600.0).contains(&p.north));
    let walled = RouteQuestion {
        forbidden: Some(wall),
        ..question(&[])
    };
    assert_eq!(walled.find(), Err(FindError::NoWay));
}

#[test]
fn the_least_mean_is_not_greater_than_the_mean_of_the_least_worst() {
    let fixes = [
        point(300.0, 250.0),
        point(600.0, 300.0),
        point(900.0, 250.0),
        point(1700.0, -500.0),
    ];
    let worst = question(&fixes).find().unwrap().surest;
    let mean = RouteQuestion {
        aim: Aim::Mean,
        ..question(&fixes)
    };
    let mean = mean.find().unwrap().surest;
    assert!(
        mean.mean_blind <= worst.mean_blind * 1.08,
        "{mean:?} {worst:?}"
    );
    assert!(
        worst.worst_blind <= mean.worst_blind * 1.08,
        "{mean:?} {worst:?}"
    );
}

#[test]
fn against_the_wind_the_budget_counts_time() {
    let fixes = [point(1500.0, 700.0)];
    let asked = RouteQuestion {
        wind: Vector2::new(-10.0, 0.0),
        budget_of: BudgetOf::Time,
        budget: 1.25,
        ..question(&fixes)
    };
    let found = asked.find().unwrap();
    assert!((found.shortest.time - 300.0).abs() < 1e-6);
    assert!(found.surest.time <= 1.25 * found.shortest.time + 1e-6);
    assert!(found.surest.worst_blind < found.shortest.worst_blind);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn the_surest_route_keeps_to_its_budget_and_can_be_flown(
        fixes in prop::collection::vec((0.0_f64..3000.0, -900.0_f64..900.0), 0..18),
        budget in 1.0_f64..1.6,
    ) {
        let fixes: Vec<GroundPoint> = fixes.into_iter().map(|(n, e)| point(n, e)).collect();
        let asked = RouteQuestion { budget, ..question(&fixes) };
        let turns = asked.turns;
        let found = asked.find().unwrap();
        prop_assert!(found.surest.length <= budget * found.shortest.length + 1e-6);
        prop_assert!(found.surest.worst_blind <= found.shortest.worst_blind + 1e-9);
        prop_assert_eq!(fits(&found.surest.way_points, &turns), None);
        let walked: f64 = found.surest.way_points.windows(2).map(|p| p[0].distance(&p[1])).sum();
        prop_assert!((walked - found.surest.length).abs() < 1e-6);
    }
}
