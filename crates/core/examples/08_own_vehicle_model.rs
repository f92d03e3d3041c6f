//! Writes a vehicle model of one's own and runs the filters of the library on it: a boat that keeps its speed
//! through the water, in a current that has to be found.
//!
//! `cargo run -p pilotage-core --example 08_own_vehicle_model`

use std::error::Error;

use nalgebra::{Matrix2, Matrix5, SMatrix, SVector, Vector2, Vector5};
use pilotage_core::filter::{Consistency, Gate, Gaussian, Ukf, UnscentedSettings};
use pilotage_core::frames::{Attitude, GroundPoint};
use pilotage_core::vehicle::{ControlInput, StateComponent, VehicleModel};

/// Random walk of current and speed, m/s/√s.
const WALK: f64 = 0.01;

/// State: north, east (m), current north, current east (m/s), speed through the water (m/s).
struct Boat;

impl VehicleModel<5> for Boat {
    fn propagate(&self, state: &SVector<f64, 5>, input: &ControlInput, dt: f64) -> Vector5<f64> {
        let (sin, cos) = input.heading().sin_cos();
        let mut next = *state;
        next[0] += (state[4] * cos + state[2]) * dt;
        next[1] += (state[4] * sin + state[3]) * dt;
        next
    }

    fn process_noise(&self, _: &SVector<f64, 5>, _: &ControlInput, dt: f64) -> SMatrix<f64, 5, 5> {
        let q = WALK * WALK;
        Matrix5::from_diagonal(&(Vector5::new(1e-4, 1e-4, q, q, q) * dt))
    }

    fn layout(&self) -> [StateComponent; 5] {
        let own = |key| StateComponent::Own { key, unit: "m/s" };
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            own("current north"),
            own("current east"),
            own("speed"),
        ]
    }

    fn prior(&self, at: GroundPoint, deviation: f64) -> Gaussian<5> {
        let deviations = Vector5::new(deviation, deviation, 1.0, 1.0, 1.0);
        let mean = Vector5::new(at.north, at.east, 0.0, 0.0, 4.0);
        Gaussian::from_standard_deviations(mean, &deviations)
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut truth = Vector5::new(0.0, 0.0, 0.6, -0.4, 5.0);
    let prior = Boat.prior(GroundPoint::new(0.0, 0.0), 3.0);
    let mut filter = Ukf::new(prior, UnscentedSettings::default())?;
    let (gate, mut nis) = (Gate::default(), Consistency::default());
    for second in (1..=300).map(f64::from) {
        // Circles of two minutes; buoys give the position to 3 m, with errors that are sines, not random.
        let input = ControlInput::without_airspeed(Attitude::level(0.05 * second));
        truth = Boat.propagate(&truth, &input, 1.0);
        let noise = Boat.process_noise(filter.mean(), &input, 1.0);
        filter.predict(|x| Boat.propagate(x, &input, 1.0), &noise)?;
        let error = Vector2::new((2.1 * second).sin(), (1.3 * second).sin()) * 4.2;
        let seen = truth.fixed_rows::<2>(0) + error;
        let model = |x: &Vector5<f64>| Some(Vector2::new(x[0], x[1]));
        let predicted = filter.predict_measurement(model, &(Matrix2::identity() * 9.0))?;
        let verdict = gate.judge(&predicted, &seen);
        nis.push(verdict.nis, verdict.dof);
        if verdict.accepted {
            filter.correct(&predicted, &seen)?;
        }
    }
    let (told, sigma) = (filter.mean(), filter.state().standard_deviations());
    for (i, component) in Boat.layout().into_iter().enumerate() {
        let (name, unit) = (component.key(), component.unit());
        let [told, sigma, truth] = [told[i], sigma[i], truth[i]];
        println!("{name}: {told:.2} {unit} (sigma {sigma:.2}), truly {truth:.2}");
    }
    let mean = nis.summary().ok_or("nothing was measured")?.mean;
    println!("normalised innovations squared: {mean:.2} on average, 2 for an honest filter");
    if filter.state().nees(&truth)? > 15.1 || !(1.0..4.0).contains(&mean) {
        return Err("99 % of the squared errors of 5 components stay below 15.1".into());
    }
    Ok(())
}
