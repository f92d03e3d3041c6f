//! The times at which the navigator takes a step.

use pilotage_flight::{ChannelName, Flight};

/// Times closer than this are one step, seconds.
pub const SAME_TIME: f64 = 1e-6;

/// Step of the plan: when, and which frame if any.
#[derive(Clone, Copy, Debug)]
pub struct Tick {
    /// When, seconds.
    pub time: f64,
    /// Number of the frame that arrives then.
    pub frame: Option<usize>,
    /// Whether an aid has a reading then.
    is_aided: bool,
}

/// Every time at which a frame arrives after the start or one of the channels `aids` has a reading, or another
/// measurement no sooner than `shortest` seconds after what came before.
pub fn ticks(flight: &Flight, shortest: f64, aids: &[ChannelName]) -> Vec<Tick> {
    let start = flight.start.time;
    let mut ticks: Vec<Tick> = flight
        .frames
        .iter()
        .enumerate()
        .map(|(index, frame)| Tick {
            time: frame.time,
            frame: Some(index),
            is_aided: false,
        })
        .collect();
    let drives = [ChannelName::Airspeed, ChannelName::Heading].map(|name| (name, false));
    let aids = aids.iter().map(|name| (*name, true));
    for (name, is_aided) in drives.into_iter().chain(aids) {
        let times = flight.channel(name).map_or(&[][..], |c| &c.times);
        ticks.extend(times.iter().map(|time| Tick {
            time: *time,
            frame: None,
            is_aided,
        }));
    }
    ticks.retain(|tick| tick.time >= start - SAME_TIME);
    // Frames first among equals, so that the merge keeps them.
    ticks.sort_by(|a, b| {
        a.time
            .total_cmp(&b.time)
            .then(b.frame.is_some().cmp(&a.frame.is_some()))
    });
    let apart = shortest.max(SAME_TIME);
    ticks.dedup_by(|later, kept| {
        let apart = if later.is_aided { SAME_TIME } else { apart };
        later.frame.is_none() && later.time - kept.time < apart
    });
    ticks
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::GroundPoint;
    use pilotage_flight::{Channel, Frame, StartFix};
    use pilotage_raster::camera::CameraModel;

    /// Two sensors, of 100 and of 20 samples a second, for ten seconds, and a frame every second.
    fn flight() -> Flight {
        let series = |name, rate: f64| Channel {
            name,
            times: (0..(10.0 * rate) as usize)
                .map(|i| i as f64 / rate)
                .collect(),
            values: vec![1.0; (10.0 * rate) as usize],
        };
        let frame = |i: u32| Frame {
            time: f64::from(i) + 0.003,
            name: String::new(),
            stored_turn: 0.0,
        };
        Flight {
            name: "test".to_owned(),
            frame_on_globe: None,
            camera: CameraModel::pinhole(64, 48, 1.0),
            ground_down: 0.0,
            channels: vec![
                series(ChannelName::Heading, 100.0),
                series(ChannelName::Airspeed, 20.0),
            ],
            frames: (0..10).map(frame).collect(),
            start: StartFix {
                time: 0.0,
                position: GroundPoint::default(),
                standard_deviation: 1.0,
            },
            truth: None,
        }
    }

    #[test]
    fn every_measurement_is_a_step_unless_steps_have_a_shortest_length() {
        let flight = flight();
        let all = ticks(&flight, 0.0, &[]);
        assert_eq!(
            all.len(),
            1010,
            "those of airspeed are also those of heading"
        );
        let apart = ticks(&flight, 0.05, &[]);
        let frames: Vec<_> = apart.iter().filter_map(|tick| tick.frame).collect();
        assert_eq!(frames, (0..10).collect::<Vec<_>>(), "no frame is left out");
        let is_apart = |pair: &[Tick]| {
            pair[1].frame.is_some() || pair[1].time - pair[0].time > 0.05 - SAME_TIME
        };
        assert!(apart.windows(2).all(is_apart));
        assert!((180..=220).contains(&apart.len()), "{}", apart.len());
        assert!(apart.last().unwrap().time > 9.9);
        let aided = ticks(&flight, 0.25, &[ChannelName::Airspeed]);
        let readings = (0..200).map(|i| f64::from(i) / 20.0);
        let is_step = |time: f64| {
            aided
                .iter()
                .any(|tick| (tick.time - time).abs() < SAME_TIME)
        };
        assert!(
            readings.into_iter().all(is_step),
            "no reading of an aid is left out"
        );
    }
}
