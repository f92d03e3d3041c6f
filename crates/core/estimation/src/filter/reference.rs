//! A fixed piece of work, to be timed and to be compared with other programs.

use nalgebra::{Matrix2, Matrix3, Matrix4, Rotation3, SVector, Vector2, Vector3, Vector4};

use super::{FilterError, Gaussian, Ukf, UnscentedSettings};

/// Length of the reference loop's steps, seconds.
const STEP: f64 = 0.5;
/// Height above the ground, metres.
const HEIGHT: f64 = 121.92;
/// Focal length, pixels.
const FOCAL_LENGTH: f64 = 554.0;
/// Principal point, pixels.
const PRINCIPAL_POINT: [f64; 2] = [320.0, 240.0];

/// Step of the reference flight: all that goes into the filter at a time.
#[derive(Clone, Copy, Debug)]
pub struct ReferenceStep {
    /// Velocity through the air, m/s north and east.
    pub air_velocity: Vector2<f64>,
    /// Rotation that takes world vectors (NED) to camera vectors (x right, y down, z out).
    pub camera_from_world: Matrix3<f64>,
    /// The landmark, metres north, east, down.
    pub landmark: Vector3<f64>,
    /// Pixel at which the camera saw it.
    pub pixel: Vector2<f64>,
}

/// The reference flight: an airplane circles in a wind of (3, 4) m/s at 400 ft and sees one
/// landmark near the nadir at every step; errors are sums of sines, not random.
pub fn reference_flight(steps: usize) -> Vec<ReferenceStep> {
    let wind = Vector2::new(3.0, 4.0);
    let mut position = Vector2::new(100.0, -50.0);
    (0..steps)
        .map(|k| {
            let t = k as f64 * STEP;
            let heading = 0.05 * t;
            let airspeed = 19.0 + 0.4 * (0.13 * t).sin();
            let air_velocity = Vector2::new(heading.cos(), heading.sin()) * airspeed;
            position += (air_velocity + wind) * STEP;
            let roll = 0.1 + 0.05 * (0.7 * t).sin();
            let pitch = 0.03 * (0.9 * t).cos();
            let body_from_world = Rotation3::from_euler_angles(roll, pitch, heading)
                .inverse()
                .into_inner();
            let camera_from_body = Matrix3::new(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
            let camera_from_world = camera_from_body * body_from_world;
            let offset = Vector2::new(40.0 * (1.7 * t).sin(), 30.0 * (2.3 * t).cos());
            let landmark = Vector3::new(position.x + offset.x, position.y + offset.y, -5.0);
            let error = Vector2::new((12.9 * t).sin() + (4.1 * t).cos(), (7.7 * t).cos()) * 4.0;
            let unseen = Vector2::zeros();
            let pixel = pinhole(&position, &landmark, &camera_from_world).unwrap_or(unseen) + error;
            ReferenceStep {
                air_velocity,
                camera_from_world,
                landmark,
                pixel,
            }
        })
        .collect()
}

/// Belief at the start of the reference flight: position roughly known, wind unknown.
pub fn reference_prior() -> Gaussian<4> {
    Gaussian::from_standard_deviations(
        Vector4::new(103.0, -54.0, 0.0, 0.0),
        &Vector4::new(5.0, 5.0, 4.0, 4.0),
    )
}

/// Process noise of a step of the reference flight.
pub fn reference_process_noise() -> Matrix4<f64> {
    Matrix4::from_diagonal(&Vector4::new(0.836, 0.836, 0.0186, 0.0186))
}

/// Measurement noise of the reference flight, pixels².
pub fn reference_measurement_noise() -> Matrix2<f64> {
    Matrix2::from_diagonal_element(36.0)
}

/// Airplane in wind over one step of the reference flight.
#[inline]
pub fn reference_process(state: &Vector4<f64>, step: &ReferenceStep) -> Vector4<f64> {
    Vector4::new(
        state[0] + (step.air_velocity.x + state[2]) * STEP,
        state[1] + (step.air_velocity.y + state[3]) * STEP,
        state[2],
        state[3],
    )
}

/// Pixel of the landmark for a state of the reference flight.
#[inline]
pub fn reference_measurement(
    state: &SVector<f64, 4>,
    step: &ReferenceStep,
) -> Option<Vector2<f64>> {
    pinhole(
        &Vector2::new(state[0], state[1]),
        &step.landmark,
        &step.camera_from_world,
    )
}

#[inline]
fn pinhole(
    position: &Vector2<f64>,
    landmark: &Vector3<f64>,
    camera_from_world: &Matrix3<f64>,
) -> Option<Vector2<f64>> {
    let in_camera = camera_from_world * (landmark - Vector3::new(position.x, position.y, -HEIGHT));
    (in_camera.z > 0.0).then(|| {
        let scale = FOCAL_LENGTH / in_camera.z;
        Vector2::new(
            PRINCIPAL_POINT[0] + scale * in_camera.x,
            PRINCIPAL_POINT[1] + scale * in_camera.y,
        )
    })
}

/// Runs the filter over the reference flight again and again for `steps` steps of one prediction
/// and one correction, and gives the last belief. Time it to get the cost of a step.
pub fn reference_loop(
    flight: &[ReferenceStep],
    steps: usize,
    settings: UnscentedSettings,
) -> Result<Gaussian<4>, FilterError> {
    let process_noise = reference_process_noise();
    let measurement_noise = reference_measurement_noise();
    let mut filter = Ukf::new(reference_prior(), settings)?;
    for k in 0..steps {
        let Some(step) = flight.get(k % flight.len().max(1)) else {
            break;
        };
        if k % flight.len() == 0 {
            filter.reset(&reference_prior())?;
        }
        filter.predict(|x| reference_process(x, step), &process_noise)?;
        let predicted =
            filter.predict_measurement(|x| reference_measurement(x, step), &measurement_noise)?;
        filter.correct(&predicted, &step.pixel)?;
    }
    Ok(filter.state())
}
