//! Settings of flights of which no mission says how they are navigated.

use pilotage_flight::{ChannelName, Flight};
use pilotage_vision::registration::{FollowSettings, USUAL_MAP_DEVIATION};

use super::{NavigatorSettings, VehicleChoice};

/// Steps between two pictures that people may still want to look at one by one: more are taken together.
const MOST_STEPS: usize = 50_000;
/// Farthest to each side that a picture is searched for, metres: where pictures are minutes apart the aircraft may be
/// anywhere, and all of a large map would be compared with each.
const FARTHEST: f64 = 1_000.0;
impl NavigatorSettings {
    /// Settings for a flight without a mission: by what it measured, and by whole frames laid on the map where
    /// there is one and they are wanted; there are no landmarks to be seen.
    ///
    /// Where airspeed and heading were measured they carry the estimate from picture to picture, as in a flight
    /// with a mission. Where they were not, whole frames tell the velocity well enough to be kept; without them
    /// nothing does, and the position can be anywhere that a random walk leads to. Nobody says how well the map lies:
    /// it is taken for one that somebody already had.
    pub fn without_mission(flight: &Flight, by_whole_frames: bool) -> Self {
        let has = |name| flight.channel(name).is_some_and(|c| !c.times.is_empty());
        let vehicle = if has(ChannelName::Airspeed) && has(ChannelName::Heading) {
            VehicleChoice::AirplaneWind
        } else if by_whole_frames {
            VehicleChoice::ConstantVelocity
        } else {
            VehicleChoice::RandomWalk
        };
        let settings = Self {
            vehicle,
            shortest_step: shortest_step(flight),
            whole_frames: by_whole_frames.then(|| FollowSettings {
                farthest: Some(FARTHEST),
                map_deviation: USUAL_MAP_DEVIATION,
                ..FollowSettings::default()
            }),
            ..Self::default()
        };
        settings.for_camera_of(flight)
    }

    /// These settings, with whole pictures laid on the map, as without a mission where they do not say how. Where airspeed
    /// and heading were not measured, the pictures carry the velocity, too.
    #[must_use]
    pub fn laying_pictures_of(mut self, flight: &Flight) -> Self {
        let by_pictures = Self::without_mission(flight, true);
        self.whole_frames = self.whole_frames.or(by_pictures.whole_frames);
        if by_pictures.vehicle == VehicleChoice::ConstantVelocity {
            self.vehicle = by_pictures.vehicle;
        }
        self
    }
}

/// Shortest step by which a flight makes no more than [`MOST_STEPS`], seconds; zero if it makes fewer anyway.
fn shortest_step(flight: &Flight) -> f64 {
    let times = |name| flight.channel(name).map_or(&[][..], |c| &c.times);
    let names = [ChannelName::Airspeed, ChannelName::Heading];
    let samples: usize = names.into_iter().map(|name| times(name).len()).sum();
    let (first, last) = flight.span();
    if samples > MOST_STEPS {
        (last - first) / MOST_STEPS as f64
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use pilotage_base::frames::GroundPoint;
    use pilotage_flight::{Channel, Frame, StartFix};
    use pilotage_raster::camera::CameraModel;

    use super::*;

    fn flight(channels: &[(ChannelName, u32)]) -> Flight {
        let channel = |(name, samples): &(ChannelName, u32)| Channel {
            name: *name,
            times: (0..*samples).map(|i| 0.01 * f64::from(i)).collect(),
            values: vec![0.0; *samples as usize],
        };
        Flight {
            name: "bare".into(),
            frame_on_globe: None,
            camera: CameraModel::pinhole(320, 240, 1.0),
            ground_down: 0.0,
            channels: channels.iter().map(channel).collect(),
            frames: Vec::new(),
            start: StartFix {
                time: 0.0,
                position: GroundPoint::new(0.0, 0.0),
                standard_deviation: 1.0,
            },
            truth: None,
        }
    }

    #[test]
    fn what_was_measured_chooses_the_vehicle_with_and_without_a_map() {
        use ChannelName::{Airspeed, Heading};
        use VehicleChoice::{AirplaneWind, ConstantVelocity, RandomWalk};
        for (channels, by_frames, by_nothing) in [
            (
                &[(Airspeed, 9), (Heading, 9)][..],
                AirplaneWind,
                AirplaneWind,
            ),
            (&[(Airspeed, 9)], ConstantVelocity, RandomWalk),
            (&[(Airspeed, 0), (Heading, 9)], ConstantVelocity, RandomWalk),
            (&[], ConstantVelocity, RandomWalk),
        ] {
            let flight = flight(channels);
            let seeing = NavigatorSettings::without_mission(&flight, true);
            assert_eq!(seeing.vehicle, by_frames, "{channels:?}");
            let frames = seeing.whole_frames.unwrap();
            assert_eq!(frames.map_deviation, USUAL_MAP_DEVIATION);
            let blind = NavigatorSettings::without_mission(&flight, false);
            assert_eq!(blind.vehicle, by_nothing, "{channels:?}");
            assert!(blind.whole_frames.is_none());
        }
    }

    #[test]
    fn a_mount_that_nobody_states_is_a_tilt_that_stays_and_one_that_comes_with_the_aircraft() {
        use ChannelName::{Pitch, Roll};
        let mut flown = flight(&[(Roll, 100), (Pitch, 100)]);
        flown.channels[0].values = (0..100)
            .map(|i| 0.06 * f64::from(1 - 2 * (i % 2)))
            .collect();
        flown.frames = (0..100)
            .map(|i| Frame {
                time: 0.01 * f64::from(i),
                name: String::new(),
                stored_turn: 0.0,
            })
            .collect();
        let stated = NavigatorSettings::without_mission(&flown, true);
        assert_eq!(stated.sensors, NavigatorSettings::default().sensors);
        let usual = FollowSettings::default().tilt_deviation;
        assert_eq!(stated.whole_frames.unwrap().tilt_deviation, usual);
        flown.camera.mount_deviation = 0.17;
        let unstated = NavigatorSettings::without_mission(&flown, true);
        assert_eq!(unstated.sensors.tilt_bias, 0.17);
        assert!((unstated.sensors.roll - 0.17_f64.hypot(stated.sensors.roll)).abs() < 1e-12);
        let tilt = unstated.whole_frames.unwrap().tilt_deviation;
        let expected = usual.hypot(0.06 / 2_f64.sqrt());
        assert!((tilt - expected).abs() < 1e-9, "{tilt} {expected}");
    }

    #[test]
    fn a_long_flight_of_fast_sensors_is_flown_in_steps_that_can_be_looked_at() {
        let of = |samples| {
            let flight = flight(&[(ChannelName::Heading, samples)]);
            NavigatorSettings::without_mission(&flight, true).shortest_step
        };
        assert_eq!(of(4000), 0.0);
        let step = of(200_000);
        assert!((0.035..0.045).contains(&step), "{step}");
    }
}
