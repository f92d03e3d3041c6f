//! Faults of instruments, done to the channels of a flight.

use pilotage_core::flight::{Channel, ChannelName, Flight, Frame};
use pilotage_core::frames::wrap_pi;

use super::fault_kind::FaultKind;
use super::run_settings::RunSettings;

fn channel(flight: &mut Flight, name: ChannelName) -> Option<&mut Channel> {
    flight
        .channels
        .iter_mut()
        .find(|channel| channel.name == name)
}

/// Adds `error` to all readings of a channel.
fn add(flight: &mut Flight, name: ChannelName, error: f64) {
    if error == 0.0 {
        return;
    }
    for value in channel(flight, name)
        .into_iter()
        .flat_map(|c| &mut c.values)
    {
        *value = match name {
            ChannelName::Airspeed => (*value + error).max(0.0),
            name if name.is_angle() => wrap_pi(*value + error),
            _ => *value + error,
        };
    }
}

fn silence(flight: &mut Flight, name: ChannelName, from: f64) {
    if let Some(channel) = channel(flight, name) {
        let kept = channel.times.partition_point(|time| *time < from);
        channel.times.truncate(kept);
        channel.values.truncate(kept);
    }
}

/// Does to the channels what the settings say; the truth stays.
pub fn damage(flight: &mut Flight, run: &RunSettings) {
    let [airspeed, heading, roll, pitch, height] = run.offsets;
    add(flight, ChannelName::Airspeed, airspeed);
    add(flight, ChannelName::Heading, heading);
    add(flight, ChannelName::Roll, roll);
    add(flight, ChannelName::Pitch, pitch);
    add(flight, ChannelName::HeightAboveGround, height);
    let [north, east] = run.start_offset;
    flight.start.position.north += north;
    flight.start.position.east += east;
    let from = flight.start.time + run.fault_from;
    match run.fault {
        FaultKind::None | FaultKind::CameraLate => {}
        FaultKind::AirspeedStuck => {
            if let Some(channel) = channel(flight, ChannelName::Airspeed) {
                let first = channel.times.partition_point(|time| *time < from);
                if let Some(stuck) = channel.values.get(first).copied() {
                    channel.values[first..].fill(stuck);
                }
            }
        }
        FaultKind::AirspeedSilent => silence(flight, ChannelName::Airspeed, from),
        FaultKind::HeadingSilent => silence(flight, ChannelName::Heading, from),
        FaultKind::HeightSilent => silence(flight, ChannelName::HeightAboveGround, from),
        FaultKind::HeadingTurned => {
            let by = run.fault_turn;
            if let Some(channel) = channel(flight, ChannelName::Heading) {
                let readings = channel.times.iter().zip(&mut channel.values);
                for (_, value) in readings.filter(|(time, _)| **time >= from) {
                    *value = wrap_pi(*value + by);
                }
            }
        }
    }
}

/// The flight as its camera sees it: where that is late, frames were taken where the aircraft was before.
pub fn as_seen(flight: &Flight, run: &RunSettings) -> Option<Flight> {
    if run.fault != FaultKind::CameraLate {
        return None;
    }
    let mut seen = flight.clone();
    let from = flight.start.time + run.fault_from;
    let truth = (flight.truth.as_ref(), seen.truth.as_mut());
    if let (Some(truth), Some(seen)) = truth {
        for (index, frame) in flight.frames.iter().enumerate() {
            if frame.time >= from {
                let shown = nearest(&flight.frames[..=index], frame.time - run.fault_delay);
                seen.frames[index] = truth.frames[shown];
            }
        }
    }
    Some(seen)
}

/// Number of the frame that was taken nearest to `time`, seconds, of two as near the earlier; 0 of none.
fn nearest(frames: &[Frame], time: f64) -> usize {
    let after = frames.partition_point(|frame| frame.time < time);
    let Some(before) = after.checked_sub(1) else {
        return 0;
    };
    match frames.get(after) {
        Some(frame) if frame.time - time < time - frames[before].time - 1e-9 => after,
        _ => before,
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::simulate::{Overrides, Scenario};

    use super::*;

    fn flight() -> Flight {
        let scenario = Scenario::named("distinct-400ft-wind").unwrap();
        let mut plan = scenario.plan(&Overrides::default());
        plan.longest = 20.0;
        plan.simulate(1).unwrap()
    }

    fn damaged(fault: FaultKind) -> (Flight, Flight) {
        let sound = flight();
        let mut flight = sound.clone();
        let run = RunSettings {
            fault,
            fault_from: 5.0,
            offsets: [0.5, 0.0, 0.0, 0.0, -2.0],
            start_offset: [3.0, -4.0],
            ..RunSettings::default()
        };
        damage(&mut flight, &run);
        (sound, as_seen(&flight, &run).unwrap_or(flight))
    }

    #[test]
    fn a_fault_changes_its_own_instrument_from_its_time_on_and_offsets_all_of_it() {
        let last = |flight: &Flight, name| {
            let channel = flight.channel(name).unwrap();
            (
                channel.times.last().copied().unwrap(),
                channel.values.last().copied().unwrap(),
            )
        };
        let (sound, stuck) = damaged(FaultKind::AirspeedStuck);
        let airspeeds = &stuck.channel(ChannelName::Airspeed).unwrap().values;
        assert!(
            airspeeds[100..]
                .iter()
                .all(|value| *value == airspeeds[100])
        );
        assert_eq!(
            airspeeds[99],
            sound.channel(ChannelName::Airspeed).unwrap().values[99] + 0.5
        );
        let height = ChannelName::HeightAboveGround;
        assert_eq!(last(&stuck, height).1, last(&sound, height).1 - 2.0);
        assert_eq!(stuck.start.position.north, sound.start.position.north + 3.0);

        let (_, silent) = damaged(FaultKind::HeightSilent);
        assert!(last(&silent, height).0 < 5.0 && last(&silent, ChannelName::Heading).0 > 19.0);

        let (sound, turned) = damaged(FaultKind::HeadingTurned);
        let by = last(&turned, ChannelName::Heading).1 - last(&sound, ChannelName::Heading).1;
        assert!((wrap_pi(by).to_degrees() - 20.0).abs() < 1e-9, "{by}");
    }

    #[test]
    fn a_late_camera_shows_what_was_a_second_before() {
        let (sound, late) = damaged(FaultKind::CameraLate);
        let frames = |flight: &Flight| flight.truth.clone().unwrap().frames;
        // Two frames a second; the fault begins with the tenth.
        assert_eq!(frames(&late)[9], frames(&sound)[9]);
        assert_eq!(frames(&late)[10], frames(&sound)[8]);
        assert_eq!(frames(&late)[30], frames(&sound)[28]);
    }

    #[test]
    fn a_camera_is_late_by_a_time_at_any_frame_rate() {
        let scenario = Scenario::named("distinct-400ft-wind").unwrap();
        for (rate, delay) in [(15.0, 1.0), (8.0, 1.0), (2.0, 0.5), (20.0, 0.25)] {
            let mut plan = scenario.plan(&Overrides::default());
            plan.longest = 10.0;
            plan.sensors.frame_rate = rate;
            let flight = plan.simulate(1).unwrap();
            let mut run = RunSettings {
                fault: FaultKind::CameraLate,
                fault_from: 5.0,
                fault_delay: delay,
                ..RunSettings::default()
            };
            run.sensors.frame_rate = rate;
            let seen = as_seen(&flight, &run).unwrap().truth.unwrap().frames;
            let taken = flight.truth.unwrap().frames;
            let last = flight.frames.len() - 1;
            let shown = taken.iter().position(|frame| *frame == seen[last]).unwrap();
            let late = flight.frames[last].time - flight.frames[shown].time;
            assert!((late - delay).abs() < 0.026, "{rate} a second: {late} s");
        }
    }
}
