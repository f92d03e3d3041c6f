//! Tests of what flights rely on.

use super::*;
use pilotage_base::frames::GroundPoint;

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

fn around(north: f64, east: f64, gsd: f64, side: usize) -> Window {
    let extent = gsd * side as f64;
    Window::covering(
        &GroundRect::centered(GroundPoint::new(north, east), extent, extent),
        gsd,
    )
}

#[test]
fn the_same_seed_and_day_give_the_same_picture_and_another_seed_another() {
    let window = around(100.0, -50.0, 0.5, 120);
    let one = scenery().window(&window);
    // The land that was laid out last is kept: the next is laid out anew after another's.
    let other = Scenery::new(DEMO_SEED + 1, Day::map_day()).window(&window);
    assert_eq!(one, scenery().window(&window));
    assert_ne!(one, other);
}

#[test]
fn another_day_over_laid_out_ground_is_the_same_as_laid_out_anew() {
    let day = Day::other_day();
    let window = around(-395.0, 421.0, 0.3, 96);
    let anew = Scenery::new(DEMO_SEED, day).window(&window);
    assert_eq!(scenery().on_day(day).window(&window), anew);
}

#[test]
fn neighbouring_windows_join_without_a_seam() {
    let scenery = scenery();
    let whole = scenery.window(&Window {
        north_edge: -60.0,
        west_edge: 64.0,
        gsd: 0.25,
        width: 96,
        height: 64,
    });
    let part = scenery.window(&Window {
        north_edge: -68.0,
        west_edge: 74.0,
        gsd: 0.25,
        width: 56,
        height: 32,
    });
    assert_eq!(whole.crop(40, 32, 56, 32), Some(part));
}

#[test]
fn a_coarse_window_shows_the_average_of_the_fine_one() {
    let scenery = scenery();
    let linear = |v: u8| (f64::from(v) / 255.0).powf(2.2);
    for (north, east) in [
        (80.0, -60.0),
        (300.0, 250.0),
        (-400.0, 300.0),
        (-260.0, -700.0),
    ] {
        for factor in [4_usize, 10, 40] {
            let coarse = scenery.window(&around(north, east, 0.2 * factor as f64, 160 / factor));
            let fine = scenery.window(&around(north, east, 0.2, 160));
            let (mut bias, mut spread) = (0.0, 0.0);
            for row in 0..coarse.height() {
                for column in 0..coarse.width() {
                    let mut mean = 0.0;
                    for y in 0..factor {
                        for x in 0..factor {
                            mean += linear(fine.get(column * factor + x, row * factor + y)[1]);
                        }
                    }
                    mean /= (factor * factor) as f64;
                    let shown = linear(coarse.get(column, row)[1]);
                    bias += shown - mean;
                    spread += (shown - mean).powi(2);
                }
            }
            let count = (coarse.width() * coarse.height()) as f64;
            let (bias, spread) = (bias / count, (spread / count).sqrt());
            assert!(
                bias.abs() < 0.02,
                "{north} {east} x{factor}: bias {bias:.4}"
            );
            assert!(
                spread < 0.05,
                "{north} {east} x{factor}: spread {spread:.4}"
            );
        }
    }
}

#[test]
fn another_day_moves_light_and_cars_but_no_building() {
    let (map, other) = (scenery(), Scenery::new(DEMO_SEED, Day::other_day()));
    let everywhere = map.bounds();
    let of_kind = |s: &Scenery, kinds: &[SceneKind]| -> Vec<SceneLabel> {
        let labels = s.labels(&everywhere);
        labels
            .into_iter()
            .filter(|l| kinds.contains(&l.kind))
            .collect()
    };
    let fixed = [
        SceneKind::Building,
        SceneKind::House,
        SceneKind::Road,
        SceneKind::Pool,
        SceneKind::Tree,
    ];
    assert_eq!(of_kind(&map, &fixed), of_kind(&other, &fixed));
    assert_ne!(
        of_kind(&map, &[SceneKind::Car]),
        of_kind(&other, &[SceneKind::Car])
    );
    let window = around(0.0, 0.0, 0.5, 200);
    assert_ne!(map.window(&window), other.window(&window));
}

#[test]
fn labelled_roads_are_gray_and_the_labelled_pond_is_dark() {
    let scenery = scenery();
    let pixel = |p: GroundPoint| scenery.window(&around(p.north, p.east, 0.8, 1)).get(0, 0);
    let labels = scenery.labels(&scenery.bounds());
    let (mut gray, mut roads) = (0, 0);
    for label in labels
        .iter()
        .filter(|l| l.name.as_deref() == Some("South Road"))
    {
        let side = label.polygon[0];
        let across = label.polygon[2];
        // A quarter of the way across: beside the painted lines.
        let p = GroundPoint::new(
            0.65 * side.north + 0.35 * across.north,
            0.65 * side.east + 0.35 * across.east,
        );
        if scenery.bounds().contains(&p) {
            let [r, g, b, _] = pixel(p);
            let (most, least) = (r.max(g).max(b), r.min(g).min(b));
            roads += 1;
            gray += i32::from(most - least < 40);
        }
    }
    assert!(roads > 30 && gray * 10 > roads * 7, "{gray} of {roads}");
    let features = scenery.distinct_features();
    let pond = features.iter().find(|f| f.name == "pond").unwrap();
    let [r, g, b, _] = pixel(pond.landmark_box.center());
    assert!(r.max(g).max(b) < 110, "{r} {g} {b}");
}

#[test]
fn outside_the_square_there_is_no_data() {
    let picture = scenery().window(&around(1300.0, 0.0, 1.0, 4));
    assert!(picture.pixels().iter().all(|p| p[3] == 0));
}

#[test]
fn the_road_map_of_the_scenery_has_its_main_road_straight_and_its_roundabout_met_by_four() {
    let map = Scenery::new(DEMO_SEED, Day::map_day()).road_map();
    // South Road under the second leg, 7.2 m wide, straight for a kilometre: north-east and through there.
    let middle = GroundPoint::new(400.0, 130.0);
    let near = map.nearest(middle, 5.0).unwrap();
    assert_eq!(map.line_of(near.edge).name, "South Road");
    assert!((map.line_of(near.edge).width - 7.2).abs() < 1e-6);
    let slope = (near.heading.rem_euclid(std::f64::consts::PI)).to_degrees();
    assert!((slope - 45.0).abs() < 0.01, "{slope}");
    assert!(near.distance < 0.01, "{near:?}");
    let center = GroundPoint::new(-428.0, -617.0);
    let around = map.crossings();
    let met = around
        .iter()
        .filter(|c| c.place.distance(&center) < 20.0)
        .count();
    assert_eq!(met, 4);
    // Church Street goes over High Street.
    assert!(around.len() > 25, "{}", around.len());
}
