//! Direction of the nose: by the logged heading, or by the gyros.

use nalgebra::{Rotation2, Rotation3, Unit, Vector2, Vector3};

use super::readings::Readings;
use super::series::{LONGEST_GAP, Series};
use pilotage_base::frames::Attitude;

/// Time in which the integrated attitude follows the logged roll and pitch, seconds.
const LEVELLING_TIME: f64 = 2.0;

/// Horizontal part of the unit vector along the nose, north and east, by the logged attitude:
/// cos θ (cos ψ, sin ψ). Where roll and pitch are missing the airplane counts as level.
pub fn logged_nose(readings: &Readings) -> Series<Vector2<f64>> {
    let mut nose = Series::new();
    for (time, heading) in readings.heading.iter() {
        let level = readings.pitch.at(time).unwrap_or(0.0).cos();
        nose.push(time, Vector2::new(heading.cos(), heading.sin()) * level);
    }
    nose
}

/// The same by the gyros alone from `from` (seconds) on, beginning with the logged heading of that time; empty
/// without gyros.
///
/// The turn rates are integrated as a rotation, so that loops and rolls pass without a singularity. Its tilt
/// follows the logged roll and pitch, by the smallest rotation that does, which has no part about the vertical:
/// the heading remains the gyros' own.
pub fn gyro_nose(readings: &Readings, from: f64) -> Series<Vector2<f64>> {
    let mut nose = Series::new();
    let [roll_rate, pitch_rate, yaw_rate] = &readings.rates;
    let mut state: Option<(f64, Vector3<f64>, Rotation3<f64>)> = None;
    for (time, roll_rate) in roll_rate.iter().filter(|(time, _)| *time >= from) {
        let Some((pitch_rate, yaw_rate)) = pitch_rate.at(time).zip(yaw_rate.at(time)) else {
            continue;
        };
        let rates = Vector3::new(roll_rate, pitch_rate, yaw_rate);
        let tilt = logged_tilt(readings, time);
        let world_from_body = match state {
            None => logged_attitude(readings, time).world_from_body(),
            Some((before, earlier_rates, world_from_body)) => {
                let dt = time - before;
                let turn = Rotation3::new(0.5 * (earlier_rates + rates) * dt);
                let turned = world_from_body * turn;
                let share = -(-dt / LEVELLING_TIME).exp_m1();
                tilt.map_or(turned, |down_in_body| {
                    levelled(&turned, &down_in_body, share)
                })
            }
        };
        state = Some((time, rates, world_from_body));
        let forward = world_from_body * Vector3::x();
        nose.push(time, forward.xy());
    }
    nose
}

/// Attitude as logged; what is missing counts as level and as north.
fn logged_attitude(readings: &Readings, time: f64) -> Attitude {
    Attitude {
        roll: readings.roll.at(time).unwrap_or(0.0),
        pitch: readings.pitch.at(time).unwrap_or(0.0),
        yaw: readings.heading.at(time).unwrap_or(0.0),
    }
}

/// Unit vector down, in the axes of the body, by the logged roll and pitch.
fn logged_tilt(readings: &Readings, time: f64) -> Option<Vector3<f64>> {
    let attitude = Attitude {
        roll: readings.roll.at(time)?,
        pitch: readings.pitch.at(time)?,
        yaw: 0.0,
    };
    Some(attitude.world_from_body().inverse() * Vector3::z())
}

/// The attitude turned by `share` of the smallest rotation that makes its down the measured one.
fn levelled(
    world_from_body: &Rotation3<f64>,
    down_in_body: &Vector3<f64>,
    share: f64,
) -> Rotation3<f64> {
    let down = world_from_body.inverse() * Vector3::z();
    let axis = down_in_body.cross(&down);
    let angle = axis.norm().atan2(down.dot(down_in_body));
    Unit::try_new(axis, 1e-12).map_or(*world_from_body, |axis| {
        // Turns the measured down onto the believed one, so that the product has the measured down.
        world_from_body * Rotation3::from_axis_angle(&axis, share * angle)
    })
}

/// The logged nose with its pauses filled by the gyros, turned so that they go on where it ends.
pub fn bridged(
    logged: &Series<Vector2<f64>>,
    gyros: &Series<Vector2<f64>>,
) -> Series<Vector2<f64>> {
    let angle = |v: Vector2<f64>| v.y.atan2(v.x);
    let mut nose = Series::new();
    let mut last: Option<(f64, Vector2<f64>)> = None;
    let end = gyros.times().last().copied().unwrap_or(f64::NEG_INFINITY);
    for (time, value) in logged
        .iter()
        .map(|(t, v)| (t, Some(v)))
        .chain([(end, None)])
    {
        if let Some((before, there)) = last
            && time - before > LONGEST_GAP
            && let Some(gyros_there) = gyros.at(before)
        {
            let turn = Rotation2::new(angle(there) - angle(gyros_there));
            for (between, gyros_nose) in gyros.between(before, time) {
                if between < time {
                    nose.push(between, turn * gyros_nose);
                }
            }
        }
        if let Some(value) = value {
            nose.push(time, value);
            last = Some((time, value));
        }
    }
    nose
}
