//! Faults in the channels of a flight.

use pilotage_core::flight::{Channel, ChannelName, Flight};

fn channels<'a>(
    flight: &'a mut Flight,
    names: &'a [ChannelName],
) -> impl Iterator<Item = &'a mut Channel> {
    flight
        .channels
        .iter_mut()
        .filter(|channel| names.contains(&channel.name))
}

/// Takes the samples out of a stretch of time.
pub fn drop_samples(flight: &mut Flight, names: &[ChannelName], span: (f64, f64)) {
    for channel in channels(flight, names) {
        let samples = channel
            .times
            .iter()
            .copied()
            .zip(channel.values.iter().copied());
        let kept = samples.filter(|(time, _)| !(span.0..=span.1).contains(time));
        (channel.times, channel.values) = kept.unzip();
    }
}

/// Changes the samples of a stretch of time.
pub fn change(
    flight: &mut Flight,
    names: &[ChannelName],
    span: (f64, f64),
    to: impl Fn(ChannelName, f64) -> f64,
) {
    for channel in channels(flight, names) {
        let name = channel.name;
        for (time, value) in channel.times.iter().zip(&mut channel.values) {
            if (span.0..=span.1).contains(time) {
                *value = to(name, *value);
            }
        }
    }
}
