//! Fits to control points against `SciPy`.

use nalgebra::Point2;
use pilotage_core::imagery::georeferencer::{ControlPoint, TransformKind, fit};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    cases: Vec<Case>,
}

#[derive(Serialize)]
struct Case {
    kind: &'static str,
    pixels: Vec<[f64; 2]>,
    places: Vec<[f64; 2]>,
    probe: [f64; 2],
}

#[derive(Deserialize)]
struct Answer {
    rms: f64,
    left_out: f64,
    place: [f64; 2],
}

#[test]
fn fits_errors_and_places_are_those_of_scipy() {
    let mut state = 20_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut cases, mut ours) = (Vec::new(), Vec::new());
    for round in 0..60 {
        let kind = TransformKind::ALL[round % 3];
        let tilt = [2e-4 * (random() - 0.5), 2e-4 * (random() - 0.5)];
        let corner = [1e6 * random(), 5e6 * random()];
        let turn = 6.3 * random();
        let points: Vec<ControlPoint> = (0..6 + round % 7)
            .map(|_| {
                let (x, y) = (2000.0 * random(), 1500.0 * random());
                let w = 1.0 + tilt[0] * x + tilt[1] * y;
                let east = 0.2 * (turn.cos() * x + turn.sin() * y) / w;
                let north = 0.2 * (turn.sin() * x - turn.cos() * y) / w;
                let noise = [3.0 * (random() - 0.5), 3.0 * (random() - 0.5)];
                ControlPoint {
                    pixel: Point2::new(x, y),
                    place: Point2::new(corner[0] + east + noise[0], corner[1] + north + noise[1]),
                    enabled: true,
                }
            })
            .collect();
        let probe = Point2::new(700.0, 900.0);
        let fitted = fit(&points, kind).unwrap();
        cases.push(Case {
            kind: kind.name(),
            pixels: points.iter().map(|p| p.pixel.into()).collect(),
            places: points.iter().map(|p| p.place.into()).collect(),
            probe: probe.into(),
        });
        ours.push((
            fitted.rms_in_plane,
            fitted.rms_left_out.unwrap(),
            fitted.place_at(&probe).unwrap(),
        ));
    }
    let Some(answers) = ask::<_, Vec<Answer>>("scipy_control_points.py", &Question { cases })
    else {
        return;
    };
    let (mut errors, mut left_out, mut places): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for ((rms, left, place), theirs) in ours.iter().zip(&answers) {
        errors = errors.max((rms - theirs.rms).abs());
        left_out = left_out.max((left - theirs.left_out).abs());
        places = places.max((place - Point2::from(theirs.place)).norm());
    }
    println!(
        "{} fits: RMS off {errors:.1e} m, left out {left_out:.1e} m, places {places:.1e} m",
        answers.len()
    );
    assert!(errors < 1e-5, "{errors}");
    assert!(left_out < 1e-3, "{left_out}");
    assert!(places < 1e-3, "{places}");
}
