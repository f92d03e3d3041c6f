//! A flight as its camera sees it, which may be late.

use super::Control;
use super::expected::AppearanceModel;
use super::inputs::Inputs;
use pilotage_base::frames::wrap_pi;
use pilotage_estimation::vehicle::ControlInput;
use pilotage_flight::Flight;
use pilotage_raster::camera::CameraModel;

/// Readings that are taken together are so far apart, seconds …
const APART: f64 = 0.05;
/// … and so many on either side of the middle …
const READINGS: i32 = 2;
/// … together:
const COUNT: usize = 2 * READINGS as usize + 1;
/// Longest input that is assumed to be even when the way is followed back, seconds.
const PIECE: f64 = 0.1;

/// The flight as a camera sees it.
#[derive(Clone, Copy)]
pub struct Onlooker<'a> {
    pub flight: &'a Flight,
    pub inputs: &'a Inputs,
    pub camera: &'a CameraModel,
    /// When the picture came, seconds.
    pub time: f64,
}

impl<'a> Onlooker<'a> {
    /// Appearance model of a picture that comes `lag` seconds late.
    pub fn model(&self, lag: f64) -> AppearanceModel<'a> {
        let control = evened(self.flight, self.time - lag);
        AppearanceModel::of(self.flight, self.camera, &control)
    }

    /// The same by the readings as they are.
    pub fn model_as_read(&self, lag: f64) -> AppearanceModel<'a> {
        let control = Control::of(self.flight, self.time - lag);
        AppearanceModel::of(self.flight, self.camera, &control)
    }

    /// Inputs that drove the aircraft in the last `lag` seconds, with their lengths in seconds, the latest
    /// first.
    pub fn past(&self, lag: f64) -> Vec<(ControlInput, f64)> {
        let pieces = (lag / PIECE - 1e-9).ceil().max(0.0) as u32;
        let dt = lag / f64::from(pieces.max(1));
        let end = |piece| self.time - f64::from(piece) * dt;
        (0..pieces)
            .map(|piece| {
                let input = self.inputs.between(self.flight, end(piece + 1), end(piece));
                (input, dt)
            })
            .collect()
    }
}

/// Readings of the instruments of `flight` about `time`, seconds: their median from a little before to a little after.
///
/// A camera shakes as much for every lag that is assumed, but each reads its attitude at a time of its own, with a
/// noise of its own, which tells nothing of either.
/// An aircraft does not roll as fast as a reading errs. Where it begins to roll, a mean would be off by what it has rolled
/// a moment later; the median of readings that rise or fall is the one in their middle.
fn evened(flight: &Flight, time: f64) -> Control {
    let about = Control::of(flight, time);
    let mut off = [[0.0; COUNT]; 4];
    for (index, reading) in (-READINGS..=READINGS).enumerate() {
        let near = Control::of(flight, time + f64::from(reading) * APART);
        let differences = [
            near.roll - about.roll,
            near.pitch - about.pitch,
            wrap_pi(near.heading - about.heading),
            near.height - about.height,
        ];
        for (off, difference) in off.iter_mut().zip(differences) {
            off[index] = difference;
        }
    }
    let [roll, pitch, heading, height] = off.map(median);
    Control {
        roll: about.roll + roll,
        pitch: about.pitch + pitch,
        heading: wrap_pi(about.heading + heading),
        height: about.height + height,
        ..about
    }
}

fn median(mut values: [f64; COUNT]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[COUNT / 2]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::flight_for_tests::flight_of;
    use super::*;
    use pilotage_flight::{Channel, ChannelName};

    #[test]
    fn readings_that_err_are_evened_and_steady_turns_are_left() {
        let times: Vec<f64> = (0..=40).map(|i| 0.05 * f64::from(i)).collect();
        let channel = |name, value: &dyn Fn(f64) -> f64| Channel {
            name,
            values: times.iter().map(|time| value(*time)).collect(),
            times: times.clone(),
        };
        // A heading that turns through south, a roll that errs by a fifth of a radian in one reading, a pitch that begins to
        // rise.
        let flight = flight_of(vec![
            channel(ChannelName::Heading, &|time| {
                wrap_pi(PI + 0.5 * (time - 1.0))
            }),
            channel(ChannelName::Pitch, &|time| (time - 1.0).max(0.0)),
            channel(ChannelName::Roll, &|time| {
                if (time - 1.0).abs() < 1e-9 { 0.2 } else { 0.0 }
            }),
        ]);
        let now = evened(&flight, 1.0);
        assert!(wrap_pi(now.heading - PI).abs() < 1e-9, "{}", now.heading);
        assert!(now.roll.abs() < 1e-9, "{}", now.roll);
        assert!(now.pitch.abs() < 1e-9, "{}", now.pitch);
        let later = evened(&flight, 1.3);
        assert!(wrap_pi(later.heading - PI - 0.15).abs() < 1e-9 && later.roll.abs() < 1e-9);
    }
}
