//! What flights rely on.

use super::*;
use crate::frames::GroundPoint;

fn scenery() -> Scenery {
    Scenery::new(DEMO_SEED, Day::map_day())
}

#[test]
fn nine_buildings_line_the_first_leg_and_the_pool_lies_near_the_end_of_the_second() {
    let features = scenery().distinct_features();
    let k = std::f64::consts::FRAC_1_SQRT_2;
    let mut last = 0.0;
    for feature in &features[..9] {
        let c = feature.landmark_box.center();
        let (dn, de) = (c.north + 400.0, c.east - 420.0);
        let (along, right) = (k * (dn - de), k * (dn + de));
        assert!(
            (60.0..=85.0).contains(&(along - last)),
            "{}: {along}",
            feature.name
        );
        assert!(
            right.abs() <= 28.0,
            "{}: {right} m off the line",
            feature.name
        );
        last = along;
    }
    let pool = &features[9];
    assert_eq!(pool.name, "swimming pool");
    let c = pool.landmark_box.center();
    assert!(k * (c.east - c.north + 270.0).abs() < 29.0);
    assert!(c.distance(&GroundPoint::new(510.0, 240.0)) < 30.0);
}

#[test]
fn the_swimming_pool_is_where_its_outline_says() {
    let scenery = scenery();
    let pool = &scenery.distinct_features()[9];
    let middle = GroundRect::around(pool.outline.iter().copied())
        .unwrap()
        .center();
    let seen = scenery.window(&Window::covering(
        &GroundRect::centered(middle, 3.0, 3.0),
        1.0,
    ));
    let [red, _, blue, _] = seen.get(1, 1);
    assert!(blue > red + 30, "{:?}", seen.get(1, 1));
}
