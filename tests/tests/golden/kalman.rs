//! Stored answers of FilterPy 2.0.0 (a vehicle with range and bearing to landmarks, 200 steps) and of
//! adskalman (a smoother, 50 steps).

use nalgebra::{Matrix2, Matrix3, Matrix4, Vector2, Vector3, Vector4};
use pilotage_core::{
    filter::{Gaussian, Redraw, SmootherLink, Ukf, UnscentedSettings, smooth},
    frames::wrap_pi,
};
use pilotage_tests::data::shared;
use serde::Deserialize;

#[derive(Deserialize)]
struct Vectors {
    landmarks: Vec<[f64; 2]>,
    rb_x0: [f64; 3],
    #[serde(rename = "rb_P0")]
    rb_p0: [f64; 3],
    #[serde(rename = "rb_Q")]
    rb_q: [f64; 3],
    #[serde(rename = "rb_R")]
    rb_r: [f64; 2],
    rb_steps: Vec<Step>,
}

#[derive(Deserialize)]
struct Step {
    lm: Option<usize>,
    z: Option<[f64; 2]>,
    nis: Option<f64>,
    x: [f64; 3],
    #[serde(rename = "P")]
    p: [[f64; 3]; 3],
}

#[test]
fn the_stored_steps_of_filterpy_are_reproduced() {
    let Some(place) = shared("kalman_golden/filterpy_ukf_vectors.json") else {
        return;
    };
    let text = std::fs::read_to_string(place).unwrap();
    let vectors: Vectors = serde_json::from_str(&text).unwrap();
    let prior = Gaussian::new(
        Vector3::from(vectors.rb_x0),
        Matrix3::from_diagonal(&Vector3::from(vectors.rb_p0)),
    );
    let settings = UnscentedSettings {
        alpha: 0.5,
        beta: 2.0,
        redraw: Redraw::AfterProcessNoise,
    };
    let mut filter = Ukf::with_kappa(prior, settings, 0.0).unwrap();
    let process_noise = Matrix3::from_diagonal(&Vector3::from(vectors.rb_q));
    let measurement_noise = Matrix2::from_diagonal(&Vector2::from(vectors.rb_r));
    let (speed, turn_rate, dt) = (15.0, 0.12, 0.1);
    let mut measured = 0;
    for (k, step) in vectors.rb_steps.iter().enumerate() {
        filter
            .predict(
                |x| {
                    x + Vector3::new(
                        speed * x[2].cos() * dt,
                        speed * x[2].sin() * dt,
                        turn_rate * dt,
                    )
                },
                &process_noise,
            )
            .unwrap();
        if let (Some(landmark), Some(z)) = (step.lm, step.z) {
            let landmark = Vector2::from(vectors.landmarks[landmark]);
            let model = |x: &Vector3<f64>| {
                let line = landmark - x.xy();
                Some(Vector2::new(
                    line.norm(),
                    wrap_pi(line.y.atan2(line.x) - x[2]),
                ))
            };
            let difference =
                |a: &Vector2<f64>, b: &Vector2<f64>| Vector2::new(a.x - b.x, wrap_pi(a.y - b.y));
            let predicted = filter
                .predict_measurement_with(model, &measurement_noise, difference)
                .unwrap();
            let innovation = difference(&Vector2::from(z), &predicted.mean);
            let correction = filter.correct_by(&predicted, innovation).unwrap();
            let nis = step.nis.unwrap();
            assert!(
                (correction.nis / nis - 1.0).abs() < 1e-9,
                "step {k}: {} {nis}",
                correction.nis
            );
            measured += 1;
        }
        let state = filter.state();
        for i in 0..3 {
            let (ours, theirs) = (state.mean[i], step.x[i]);
            assert!(
                (ours - theirs).abs() <= 1e-9 * theirs.abs().max(step.p[i][i].sqrt()),
                "step {k} ({i}): {ours} {theirs}"
            );
            for j in 0..3 {
                let (ours, theirs) = (state.covariance[(i, j)], step.p[i][j]);
                assert!(
                    (ours - theirs).abs() <= 1e-9 * (step.p[i][i] * step.p[j][j]).sqrt(),
                    "step {k} ({i}, {j}): {ours} {theirs}"
                );
            }
        }
    }
    assert!(
        measured >= 40,
        "only {measured} of the steps have a measurement"
    );
}

/// The model is that of adskalman's example: nearly constant velocity with white acceleration of density
/// 100 m²/s³, positions with a variance of 0.01 m², steps of 10 ms, of which one comes before the first
/// measurement.
#[test]
fn the_stored_smoothing_of_adskalman_is_reproduced() {
    let Some(place) = shared("kalman_golden/adskalman_offline_smoothing.csv") else {
        return;
    };
    let text = std::fs::read_to_string(place).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|v| v.parse().unwrap()).collect())
        .collect();
    let (dt, density) = (0.01_f64, 100.0);
    let (cube, square) = (density * dt.powi(3) / 3.0, density * dt * dt / 2.0);
    let mut process_noise = Matrix4::zeros();
    for axis in 0..2 {
        process_noise[(axis, axis)] = cube;
        process_noise[(axis, axis + 2)] = square;
        process_noise[(axis + 2, axis)] = square;
        process_noise[(axis + 2, axis + 2)] = density * dt;
    }
    let prior = Gaussian::new(
        Vector4::new(0.0, 0.0, 10.0, -5.0),
        Matrix4::identity() * 0.1,
    );
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
    let mut links = Vec::new();
    for row in &rows {
        let step = filter
            .predict(
                |x| Vector4::new(x[0] + dt * x[2], x[1] + dt * x[3], x[2], x[3]),
                &process_noise,
            )
            .unwrap();
        links.push(SmootherLink::of(&step, filter.weights()));
        let predicted = filter
            .predict_measurement(|x| Some(x.xy()), &(Matrix2::identity() * 0.01))
            .unwrap();
        filter
            .correct(&predicted, &Vector2::new(row[5], row[6]))
            .unwrap();
    }
    let smoothed = smooth(&links, &filter.state()).unwrap();
    assert_eq!(smoothed.len(), 51);
    for (row, belief) in rows.iter().zip(&smoothed[1..]) {
        for (theirs, ours) in row[7..].iter().zip(belief.mean.iter()) {
            assert!((ours - theirs).abs() < 1e-9, "{ours} {theirs}");
        }
    }
}
