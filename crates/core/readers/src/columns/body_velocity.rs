//! Velocities over ground in the body's axes, turned to north, east and down by the attitude.

use nalgebra::Vector3;

use super::{BodyAxis, ColumnMap, ColumnRole};
use pilotage_base::text::by_count;
use pilotage_flight::{Channel, ChannelName, Flight};

/// Whether the velocity of a map is one in the body's axes.
pub(super) fn has_body_velocity(map: &ColumnMap) -> bool {
    map.column(ColumnRole::BodyVelocity(BodyAxis::Forward))
        .is_some()
}

/// Turns the velocity of a flight, which its channels hold along the body's axes so far, to north, east and down.
///
/// Where the attitude is not known there is none. Returns what was left out of it, in words.
pub(super) fn turn(flight: &mut Flight) -> Option<String> {
    let names = BodyAxis::ALL.map(BodyAxis::channel);
    let body = names.map(|name| flight.channel(name).cloned());
    flight
        .channels
        .retain(|channel| !names.contains(&channel.name));
    let [Some(forward), Some(right), down] = body else {
        return None;
    };
    if flight.channel(ChannelName::Heading).is_none() {
        return Some(
            "a velocity is told in the body's axes, but no column tells the heading that would turn it to north and \
             east; it is not used"
                .to_owned(),
        );
    }
    let mut times = Vec::with_capacity(forward.times.len());
    let mut turned: [Vec<f64>; 3] = Default::default();
    for (time, along) in forward.times.iter().zip(&forward.values) {
        let across = right.interpolated(*time);
        let below = down.as_ref().map_or(Some(0.0), |d| d.interpolated(*time));
        let (Some(across), Some(below), Some(attitude)) = (across, below, flight.attitude(*time))
        else {
            continue;
        };
        let velocity = attitude.world_from_body() * Vector3::new(*along, across, below);
        times.push(*time);
        for (values, value) in turned.iter_mut().zip(velocity.iter()) {
            values.push(*value);
        }
    }
    let left_out = forward.times.len() - times.len();
    let count = forward.times.len();
    for (name, values) in names.into_iter().zip(turned) {
        // Without the third the vertical part is not known.
        if name == ChannelName::GpsVelocityDown && down.is_none() {
            continue;
        }
        flight.channels.push(Channel {
            name,
            times: times.clone(),
            values,
        });
    }
    (left_out > 0).then(|| {
        format!(
            "{left_out} of {count} velocities in the body's axes {} left out, as the attitude is not known then",
            by_count(left_out, "was", "were")
        )
    })
}
