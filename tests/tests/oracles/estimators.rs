//! The extended filter and the smoother against FilterPy's.

use nalgebra::{Matrix2x4, Matrix3, Matrix4, SMatrix, SVector, Vector3, Vector4};
use pilotage_core::filter::{
    Ekf, Gaussian, ReferenceStep, SmootherLink, Ukf, UnscentedSettings, partial_jacobian,
    reference_flight, reference_measurement, reference_measurement_noise, reference_prior,
    reference_process, reference_process_noise, smooth,
};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

const STEPS: usize = 400;

#[derive(Serialize)]
struct Question {
    extended: Value,
    smoothing: Vec<Value>,
}

#[derive(Deserialize)]
struct Answer {
    extended: Vec<Estimate>,
    smoothing: Vec<Vec<Estimate>>,
}

#[derive(Deserialize)]
struct Estimate {
    mean: Vec<f64>,
    covariance: Vec<Vec<f64>>,
    #[serde(default)]
    nis: f64,
}

impl Estimate {
    /// Largest difference: means against their size or deviation, covariances against the product of
    /// the deviations, NIS against itself or 1.
    fn difference<const N: usize>(&self, ours: &Gaussian<N>, nis: f64) -> f64 {
        let deviation = |i: usize| self.covariance[i][i].sqrt();
        let mut worst = (self.nis - nis).abs() / self.nis.max(1.0);
        for i in 0..N {
            let scale = self.mean[i].abs().max(deviation(i));
            worst = worst.max((self.mean[i] - ours.mean[i]).abs() / scale);
            for j in 0..N {
                let off = (self.covariance[i][j] - ours.covariance[(i, j)]).abs();
                worst = worst.max(off / (deviation(i) * deviation(j)));
            }
        }
        worst
    }
}

fn rows<const R: usize, const C: usize>(matrix: &SMatrix<f64, R, C>) -> Vec<Vec<f64>> {
    let row = |i: usize| (0..C).map(|j| matrix[(i, j)]).collect();
    (0..R).map(row).collect()
}

fn flight_question(flight: &[ReferenceStep]) -> Value {
    let prior = reference_prior();
    let step = |step: &ReferenceStep| {
        json!({
            "air_velocity": step.air_velocity.as_slice(),
            "camera_from_world": rows(&step.camera_from_world),
            "landmark": step.landmark.as_slice(),
            "pixel": step.pixel.as_slice(),
        })
    };
    json!({
        "step": 0.5,
        "height": 121.92,
        "focal_length": 554.0,
        "principal_point": [320.0, 240.0],
        "mean": prior.mean.as_slice(),
        "covariance": rows(&prior.covariance),
        "process_noise": rows(&reference_process_noise()),
        "measurement_noise": rows(&reference_measurement_noise()),
        "steps": flight.iter().map(step).collect::<Vec<_>>(),
    })
}

/// Our extended filter over the reference flight.
fn extended(flight: &[ReferenceStep]) -> Vec<(Gaussian<4>, f64)> {
    let mut filter =
        Ekf::new(reference_prior(), UnscentedSettings::default()).expect("sound numbers");
    let mut transition = Matrix4::identity();
    transition[(0, 2)] = 0.5;
    transition[(1, 3)] = 0.5;
    let step = |step: &ReferenceStep| {
        let moved = reference_process(filter.mean(), step);
        filter
            .predict(moved, &transition, &reference_process_noise())
            .expect("sound numbers");
        let model = |x: &Vector4<f64>| {
            let pixel = reference_measurement(x, step)?;
            Some(nalgebra::DVector::from_column_slice(pixel.as_slice()))
        };
        let slope = partial_jacobian(model, filter.mean(), &[0, 1]).expect("sound numbers");
        let slope = Matrix2x4::from_fn(|i, j| slope[(i, j)]);
        let seen = reference_measurement(filter.mean(), step).expect("sound numbers");
        let predicted = filter
            .predict_measurement(seen, &slope, &reference_measurement_noise())
            .expect("sound numbers");
        let correction = filter
            .correct(&predicted, &step.pixel)
            .expect("sound numbers");
        (correction.after, correction.nis)
    };
    flight.iter().map(step).collect()
}

/// Filtered beliefs, from the prior on, and the links between them.
struct Filtered<const N: usize> {
    beliefs: Vec<Gaussian<N>>,
    links: Vec<SmootherLink<N>>,
}

impl<const N: usize> Filtered<N> {
    fn new(prior: Gaussian<N>) -> Self {
        Self {
            beliefs: vec![prior],
            links: Vec::new(),
        }
    }

    fn question(&self, more: Value) -> Value {
        let mut question = more;
        let means = self.beliefs.iter().map(|b| b.mean.as_slice().to_vec());
        question["means"] = json!(means.collect::<Vec<_>>());
        let covariances = self.beliefs.iter().map(|b| rows(&b.covariance));
        question["covariances"] = json!(covariances.collect::<Vec<_>>());
        question
    }

    fn worst_against(&self, theirs: &[Estimate]) -> f64 {
        let ours = smooth(&self.links, self.beliefs.last().expect("sound numbers"))
            .expect("sound numbers");
        assert_eq!(ours.len(), theirs.len());
        let pairs = theirs.iter().zip(&ours);
        pairs.map(|(t, o)| t.difference(o, 0.0)).fold(0.0, f64::max)
    }
}

/// The reference flight, a linear process with inputs and pixels of landmarks.
fn airplane(flight: &[ReferenceStep], settings: UnscentedSettings) -> Filtered<4> {
    let mut filter = Ukf::new(reference_prior(), settings).expect("sound numbers");
    let mut filtered = Filtered::new(filter.state());
    for step in flight {
        let moved = filter
            .predict(|x| reference_process(x, step), &reference_process_noise())
            .expect("sound numbers");
        filtered
            .links
            .push(SmootherLink::of(&moved, filter.weights()));
        let predicted = filter
            .predict_measurement(
                |x| reference_measurement(x, step),
                &reference_measurement_noise(),
            )
            .expect("sound numbers");
        filter
            .correct(&predicted, &step.pixel)
            .expect("sound numbers");
        filtered.beliefs.push(filter.state());
    }
    filtered
}

fn turning_noise() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(0.05, 0.05, 0.004))
}

/// A vehicle whose heading bends its way, seen by its position every third step.
fn turning(settings: UnscentedSettings) -> (Filtered<3>, Vec<Value>) {
    let prior = Gaussian::from_standard_deviations(
        Vector3::new(4.0, -2.0, 0.3),
        &Vector3::new(2.0, 2.0, 0.3),
    );
    let mut filter = Ukf::new(prior, settings).expect("sound numbers");
    let mut filtered = Filtered::new(filter.state());
    let mut steps = Vec::new();
    for k in 0..STEPS {
        let t = k as f64;
        let (dt, speed, rate) = (0.2, 6.0 + (0.1 * t).sin(), 0.3 * (0.05 * t).cos());
        steps.push(json!({ "step": dt, "speed": speed, "turn_rate": rate }));
        let process = |x: &SVector<f64, 3>| {
            let velocity = speed * dt;
            Vector3::new(
                x[0] + velocity * x[2].cos(),
                x[1] + velocity * x[2].sin(),
                x[2] + rate * dt,
            )
        };
        let moved = filter
            .predict(process, &turning_noise())
            .expect("sound numbers");
        filtered
            .links
            .push(SmootherLink::of(&moved, filter.weights()));
        if k % 3 == 0 {
            let noise = nalgebra::Matrix2::identity() * 2.0;
            let predicted = filter
                .predict_measurement(|x| Some(x.xy()), &noise)
                .expect("sound numbers");
            let off = nalgebra::Vector2::new((1.3 * t).sin(), (1.7 * t).cos()) * 2.0;
            let seen = filter.mean().xy() + off;
            filter.correct(&predicted, &seen).expect("sound numbers");
        }
        filtered.beliefs.push(filter.state());
    }
    (filtered, steps)
}

#[test]
fn extended_filter_and_smoother_equal_filterpy_to_1e_9() {
    let flight = reference_flight(STEPS);
    let settings = |alpha: f64| UnscentedSettings {
        alpha,
        ..UnscentedSettings::default()
    };
    let (wide, narrow) = (settings(1.0), settings(0.1));
    let by_pixels = airplane(&flight, wide);
    let (bent, steps) = turning(wide);
    let (bent_narrow, _) = turning(narrow);
    let steps_of_flight: Vec<Value> = flight
        .iter()
        .map(|s| json!({ "air_velocity": s.air_velocity.as_slice() }))
        .collect();
    let unscented = |process: &str, alpha: f64, steps: &[Value], noise: Vec<Vec<f64>>| json!({ "process": process, "alpha": alpha, "beta": 2.0, "steps": steps, "process_noise": noise });
    // Without an input the airplane is linear, for the smoother of Rauch, Tung and Striebel.
    let still: Vec<ReferenceStep> = flight
        .iter()
        .map(|step| ReferenceStep {
            air_velocity: nalgebra::Vector2::zeros(),
            ..*step
        })
        .collect();
    let linear = airplane(&still, narrow);
    let mut transition = Matrix4::identity();
    transition[(0, 2)] = 0.5;
    transition[(1, 3)] = 0.5;
    let noise = rows(&reference_process_noise());
    let question = Question {
        extended: flight_question(&flight),
        smoothing: vec![
            by_pixels.question(unscented("airplane", 1.0, &steps_of_flight, noise.clone())),
            bent.question(unscented("turning", 1.0, &steps, rows(&turning_noise()))),
            bent_narrow.question(unscented("turning", 0.1, &steps, rows(&turning_noise()))),
            linear.question(json!({
                "process": "linear", "transition": rows(&transition), "process_noise": noise,
            })),
        ],
    };
    let Some(answer) = ask::<_, Answer>("filterpy_estimators.py", &question) else {
        return;
    };
    let ours = extended(&flight);
    assert_eq!(ours.len(), answer.extended.len());
    let pairs = answer.extended.iter().zip(&ours);
    let worst = pairs.map(|(t, (o, nis))| t.difference(o, *nis));
    let worst = worst.fold(0.0, f64::max);
    println!("extended filter: differs by {worst:.1e}");
    assert!(worst < 1e-9, "{worst:e}");
    for (name, worst) in [
        ("airplane", by_pixels.worst_against(&answer.smoothing[0])),
        ("turning", bent.worst_against(&answer.smoothing[1])),
        (
            "turning, alpha 0.1",
            bent_narrow.worst_against(&answer.smoothing[2]),
        ),
        ("linear", linear.worst_against(&answer.smoothing[3])),
    ] {
        println!("smoother, {name}: differs by {worst:.1e}");
        assert!(worst < 1e-9, "{name}: {worst:e}");
    }
}
