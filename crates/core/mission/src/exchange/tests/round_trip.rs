//! Routes of any kind through every format, and broken files.

use proptest::prelude::*;

use super::super::{Format, read_any, write_route};
use super::{assert_same_way_points, frame, route};
use crate::mission::{Route, WayPoint, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

fn any_way_point() -> impl Strategy<Value = WayPoint> {
    let action = prop_oneof![
        Just(WayPointAction::FlyBy),
        (10.0_f64..500.0, any::<bool>(), 0.5_f64..9.0).prop_map(|(radius, is_left, turns)| {
            WayPointAction::Loiter {
                radius: if is_left { -radius } else { radius },
                turns,
            }
        }),
        Just(WayPointAction::TakeOff),
        Just(WayPointAction::Land),
        (-500.0_f64..500.0, proptest::option::of(0.5_f64..4000.0))
            .prop_map(|(radius, seconds)| WayPointAction::Wait { radius, seconds }),
    ];
    let frame = proptest::sample::select(AltitudeFrame::ALL.to_vec());
    (
        (-5000.0_f64..5000.0, -5000.0_f64..5000.0),
        (-400.0_f64..9000.0, frame),
        proptest::option::of(1.0_f64..90.0),
        action,
    )
        .prop_map(|((north, east), (metres, frame), speed, action)| WayPoint {
            speed,
            action,
            ..WayPoint::new(GroundPoint::new(north, east), Altitude::new(metres, frame))
        })
}

fn any_route() -> impl Strategy<Value = Route> {
    (
        "[a-zA-Zä<&\"' ]{1,12}",
        proptest::collection::vec(any_way_point(), 1..8),
        any::<bool>(),
    )
        .prop_map(|(name, way_points, returns)| Route {
            returns,
            id: 1,
            name: format!("r{name}s"),
            way_points,
            ..Route::default()
        })
}

proptest! {
    #[test]
    fn any_route_survives_every_format(route in any_route()) {
        for format in Format::told_by_extension() {
            let written = write_route(format, &route, &frame()).unwrap();
            let back = read_any("x", &written.bytes, Some(frame())).unwrap();
            prop_assert_eq!(back.format, format);
            assert_same_way_points(&back.routes[0], &route);
            if format.holds_several_routes() {
                prop_assert_eq!(&back.routes[0].name, &route.name);
            }
            // Rows of a table are way-points.
            prop_assert_eq!(back.routes[0].returns, route.returns && format != Format::Csv);
        }
    }

    #[test]
    fn broken_files_are_refused_or_read_but_never_panic(
        cut in 0.0_f64..1.0,
        flips in proptest::collection::vec((0.0_f64..1.0, any::<u8>()), 0..6),
        truncate in any::<bool>(),
    ) {
        for format in Format::told_by_extension() {
            let mut bytes = write_route(format, &route(), &frame()).unwrap().bytes;
            for (place, value) in &flips {
                let at = (place * bytes.len() as f64) as usize;
                bytes[at] = *value;
            }
            if truncate {
                bytes.truncate((cut * bytes.len() as f64) as usize);
            }
            let name = format!("x.{}", format.extensions()[0]);
            if let Ok(imported) = read_any(&name, &bytes, None) {
                for route in &imported.routes {
                    let _ = write_route(format, route, &imported.frame);
                }
            }
        }
    }
}
