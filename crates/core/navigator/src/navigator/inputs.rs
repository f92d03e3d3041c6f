//! Inputs that drive the predictions of a flight, and readings of it that are not believed.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::instruments::{Series, quantile, quantile_of_others, stuck_stretches};
use pilotage_base::frames::wrap_pi;
use pilotage_estimation::vehicle::ControlInput;
use pilotage_flight::stretches::STANDING;
use pilotage_flight::{Channel, ChannelName, Flight};

/// Shortest pause of a channel that counts as silence, seconds …
const SHORTEST_SILENCE: f64 = 1.5;
/// … and how many of its usual intervals at least.
const INTERVALS: f64 = 5.0;
/// Fewest samples of a channel that can fall silent: what is told once or twice holds for all of the flight.
const FEWEST: usize = 5;

/// Channels that drive a vehicle or aim its camera.
const NEEDED: [ChannelName; 7] = [
    ChannelName::Airspeed,
    ChannelName::Heading,
    ChannelName::HeightAboveGround,
    ChannelName::Roll,
    ChannelName::Pitch,
    ChannelName::VelocityNorth,
    ChannelName::VelocityEast,
];
/// Those of them that never stand still in the air, by instruments: what tells a vector sticks as a whole. One of its parts may
/// stand still: a gimbal holds its pitch, and due north there is no velocity east …
const NEVER_STILL: [&[ChannelName]; 4] = [
    &[ChannelName::Airspeed],
    &[ChannelName::Heading],
    &[ChannelName::Roll, ChannelName::Pitch],
    &[ChannelName::VelocityNorth, ChannelName::VelocityEast],
];
/// … and those whose loss leaves an airspeed to be assumed.
const OF_THE_AIR: [ChannelName; 2] = [ChannelName::Airspeed, ChannelName::Heading];

/// Time over which turns are looked at, seconds: as long as turns take.
const WANDER: f64 = 5.0;

/// Instrument that can be doubted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Instrument {
    /// Channel of the flight.
    Channel(ChannelName),
    /// The camera.
    Camera,
}

impl Instrument {
    /// Name for people.
    fn label(self) -> String {
        match self {
            Self::Channel(name) => name.key().replace('_', " "),
            Self::Camera => "camera".to_owned(),
        }
    }
}

/// Why an instrument is not believed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SensorFault {
    /// It shows one and the same number for longer than it ever did.
    Stuck,
    /// There is none for longer than usual.
    Silent,
    /// Observations speak for a lag that is not known yet.
    MayBeLate,
    /// It is late, and taken for so.
    Late {
        /// By how much, seconds.
        by: f64,
    },
    /// Contradiction by what is seen: what must be seen by the instrument is not, or is seen otherwise.
    Contradicted,
    /// It is turned, and turned back.
    Turned {
        /// Angle by which the instrument reads too far clockwise, radians.
        by: f64,
    },
}

/// An instrument that is not believed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Doubt {
    /// Instrument that is not believed.
    pub instrument: Instrument,
    /// Why.
    pub why: SensorFault,
    /// Since when, seconds in the flight's time base: when it could be noticed.
    pub since: f64,
}

impl Doubt {
    /// In words: "airspeed is stuck since 12.3 s".
    pub fn words(&self) -> String {
        let (name, since) = (
            self.instrument.label(),
            format!("since {:.1} s", self.since),
        );
        match self.why {
            SensorFault::Stuck => format!("{name} is stuck {since}"),
            SensorFault::Silent => format!("{name} is silent {since}"),
            SensorFault::Contradicted => {
                format!("{name} is contradicted by the pictures {since}")
            }
            SensorFault::MayBeLate => format!("{name} may be late {since}"),
            SensorFault::Late { by } => format!("{name} is {by:.1} s late, allowed for {since}"),
            SensorFault::Turned { by } => {
                let side = if by > 0.0 { "right" } else { "left" };
                let by = by.abs().to_degrees();
                format!("{name} reads {by:.0}° too far {side}, corrected {since}")
            }
        }
    }

    /// Whether it is one of `channel`.
    pub fn is_of(&self, channel: ChannelName) -> bool {
        self.instrument == Instrument::Channel(channel)
    }
}

/// A stretch in which a channel is not believed, seconds.
#[derive(Clone, Copy, Debug)]
struct DoubtedStretch {
    /// When it was right last.
    right: f64,
    /// When the fault could be noticed.
    since: f64,
    /// When it ends.
    until: f64,
}

/// Why a channel is not believed, and when not: the stretches follow each other and do not overlap.
#[derive(Debug)]
struct Doubted {
    channel: ChannelName,
    why: SensorFault,
    stretches: Vec<DoubtedStretch>,
}

impl Doubted {
    fn stretch(&self, time: f64) -> Option<DoubtedStretch> {
        let begun = self.stretches.partition_point(|s| s.since <= time);
        let stretch = *self.stretches.get(begun.checked_sub(1)?)?;
        // The sample that ends a silence is one to believe; the last that shows a stuck number is not.
        let ends = if self.why == SensorFault::Silent {
            time >= stretch.until
        } else {
            time > stretch.until
        };
        (!ends).then_some(stretch)
    }

    fn at(&self, time: f64) -> Option<Doubt> {
        self.stretch(time).map(|stretch| Doubt {
            instrument: Instrument::Channel(self.channel),
            why: self.why,
            since: stretch.since,
        })
    }
}

/// Credibility of the instruments of a flight at any time.
///
/// A stretch is noticed by what was read before it ends; only what is usual is learnt from the whole flight.
pub(super) struct Inputs {
    doubted: Vec<Doubted>,
    /// Airspeed that is flown usually, and its standard deviation, m/s.
    cruise: Option<(f64, f64)>,
    /// Growth rate of the mean square of the angle by which the heading turns, rad²/s.
    wander: f64,
    /// Roll and pitch that are flown usually, where one is doubted, and their standard deviations, radians.
    tilts: [Option<(f64, f64)>; 2],
}

impl Inputs {
    /// Looks a flight over.
    pub(super) fn of(flight: &Flight) -> Self {
        let span = (flight.start.time, flight.span().1);
        let stuck = NEVER_STILL.map(|parts| (parts, stuck_together(flight, parts, span)));
        let mut doubted = Vec::new();
        for name in NEEDED {
            let Some(channel) = flight.channel(name) else {
                continue;
            };
            let mut say = |why, stretches: Vec<DoubtedStretch>| {
                doubted.push(Doubted {
                    channel: name,
                    why,
                    stretches,
                });
            };
            if let Some((_, stretches)) = stuck.iter().find(|(parts, _)| parts.contains(&name)) {
                say(SensorFault::Stuck, stretches.clone());
            }
            say(SensorFault::Silent, silences(channel, span));
        }
        doubted.retain(|doubted| !doubted.stretches.is_empty());
        let flown = |name, least: f64| {
            let channel = flight.channel(name)?;
            let is_believed = |time| doubt(&doubted, name, time).is_none();
            let samples = channel.times.iter().zip(&channel.values);
            let flown = samples.filter(|(t, v)| **v > least && is_believed(**t));
            let flown: Vec<f64> = flown.map(|(_, v)| *v).collect();
            usual(&flown)
        };
        let cruise = flown(ChannelName::Airspeed, STANDING);
        let tilts = [ChannelName::Roll, ChannelName::Pitch].map(|name| {
            let is_doubted = doubted.iter().any(|doubted| doubted.channel == name);
            is_doubted.then(|| flown(name, f64::NEG_INFINITY)).flatten()
        });
        let heading = flight.channel(ChannelName::Heading);
        Self {
            cruise,
            tilts,
            doubted,
            wander: heading.map_or(0.0, wander),
        }
    }

    /// Why the channel is not believed at `time`, if so.
    pub(super) fn doubt(&self, channel: ChannelName, time: f64) -> Option<Doubt> {
        doubt(&self.doubted, channel, time)
    }

    /// Everything that is not believed at `time`.
    pub(super) fn doubts(&self, time: f64) -> Vec<Doubt> {
        self.doubted.iter().filter_map(|d| d.at(time)).collect()
    }

    /// Airspeed to assume while none can be believed, and its standard deviation, m/s: `None` where nothing
    /// is ever doubted, or no flight was seen.
    pub(super) fn cruise(&self) -> Option<(f64, f64)> {
        let matters = |doubted: &Doubted| OF_THE_AIR.contains(&doubted.channel);
        self.cruise.filter(|_| self.doubted.iter().any(matters))
    }

    /// Input that drives a prediction of `flight` from `begin` to `end`, seconds: everything as it is in the
    /// middle.
    pub(super) fn between(&self, flight: &Flight, begin: f64, end: f64) -> ControlInput {
        let (middle, dt) = (begin + 0.5 * (end - begin), end - begin);
        let value = |name| flight.value(name, middle);
        let is_believed = |name| self.doubt(name, middle).is_none();
        let mut attitude = flight.attitude(middle).unwrap_or_default();
        let (mut heading_deviation, mut heading_held) = (0.0, 0.0);
        if let Some(stretch) = stretch(&self.doubted, ChannelName::Heading, middle) {
            // What comes after the stretch is not known in it.
            let channel = flight.channel(ChannelName::Heading);
            let last = channel.and_then(|c| c.latest(stretch.since));
            attitude.yaw = last.unwrap_or(attitude.yaw);
            heading_held = middle - stretch.right;
            heading_deviation = (self.wander * heading_held).sqrt();
        }
        let mut tilt_deviation = 0.0_f64;
        let [usual_roll, usual_pitch] = self.tilts;
        for (name, angle, usual) in [
            (ChannelName::Roll, &mut attitude.roll, usual_roll),
            (ChannelName::Pitch, &mut attitude.pitch, usual_pitch),
        ] {
            if let Some((usual, deviation)) = usual.filter(|_| !is_believed(name)) {
                *angle = usual;
                tilt_deviation = tilt_deviation.max(deviation);
            }
        }
        let heading = |time| flight.attitude(time).unwrap_or_default().yaw;
        let turned = wrap_pi(heading(end) - heading(begin));
        let believed = |name| value(name).filter(|_| is_believed(name));
        ControlInput {
            airspeed: believed(ChannelName::Airspeed),
            attitude,
            turn_rate: if dt > 0.0 && heading_deviation == 0.0 {
                turned / dt
            } else {
                0.0
            },
            ground_velocity: believed(ChannelName::VelocityNorth)
                .zip(believed(ChannelName::VelocityEast))
                .map(|(north, east)| Vector2::new(north, east)),
            heading_deviation,
            heading_held,
            tilt_deviation,
        }
    }
}

fn doubt(doubted: &[Doubted], channel: ChannelName, time: f64) -> Option<Doubt> {
    let mut of_channel = doubted.iter().filter(|doubted| doubted.channel == channel);
    of_channel.find_map(|doubted| doubted.at(time))
}

fn stretch(doubted: &[Doubted], channel: ChannelName, time: f64) -> Option<DoubtedStretch> {
    let mut of_channel = doubted.iter().filter(|doubted| doubted.channel == channel);
    of_channel.find_map(|doubted| doubted.stretch(time))
}

/// Stretches in which all of these channels are stuck.
fn stuck_together(flight: &Flight, parts: &[ChannelName], span: (f64, f64)) -> Vec<DoubtedStretch> {
    let mut each = parts.iter().map(|name| {
        let channel = flight.channel(*name);
        channel.map_or_else(Vec::new, |channel| stretches_stuck(flight, channel, span))
    });
    let first = each.next().unwrap_or_default();
    each.fold(first, |known, other| {
        let both = |one: &DoubtedStretch| {
            let one = *one;
            let met = other.iter().map(move |two| DoubtedStretch {
                right: one.right.max(two.right),
                since: one.since.max(two.since),
                until: one.until.min(two.until),
            });
            met.filter(|both| both.since <= both.until)
        };
        known.iter().flat_map(both).collect()
    })
}

/// Stretches in which a channel shows one and the same number while the vehicle moves.
fn stretches_stuck(flight: &Flight, channel: &Channel, span: (f64, f64)) -> Vec<DoubtedStretch> {
    let is_airspeed = channel.name == ChannelName::Airspeed;
    let mut series = Series::new();
    let mut moving: Vec<(f64, f64)> = Vec::new();
    let mut moved = false;
    for (time, value) in channel.times.iter().zip(&channel.values) {
        series.push(*time, *value);
        let moves = if is_airspeed {
            *value > STANDING
        } else {
            moves(flight, *time)
        };
        let counts = moves && (span.0..=span.1).contains(time);
        match moving.last_mut().filter(|_| moved) {
            Some(stretch) if counts => stretch.1 = *time,
            _ if counts => moving.push((*time, *time)),
            _ => {}
        }
        moved = counts;
    }
    let stuck = stuck_stretches(&series, &moving).into_iter();
    stuck
        .map(|stretch| DoubtedStretch {
            right: stretch.begin,
            since: stretch.noticed,
            until: stretch.end,
        })
        .collect()
}

/// Whether a vehicle does not stand, nor hover so still that its instruments may: by the speeds that it has, and where none
/// is measured, it moves.
fn moves(flight: &Flight, time: f64) -> bool {
    let value = |name| flight.value(name, time);
    let over_ground = value(ChannelName::VelocityNorth).zip(value(ChannelName::VelocityEast));
    let over_ground = over_ground.map(|(north, east)| north.hypot(east));
    let speed = over_ground.or_else(|| value(ChannelName::Airspeed));
    speed.is_none_or(|speed| speed > STANDING)
}

/// Pauses of a channel and the time after its end: from when each could be noticed to the next sample, seconds.
///
/// A pause is judged by the other intervals: among few it would be a measure of itself.
fn silences(channel: &Channel, span: (f64, f64)) -> Vec<DoubtedStretch> {
    let Some(end) = channel.times.last().copied() else {
        return Vec::new();
    };
    if channel.times.len() < FEWEST {
        return Vec::new();
    }
    let pauses = channel.times.windows(2).map(|pair| (pair[0], pair[1]));
    let mut steps: Vec<f64> = pauses.clone().map(|(last, next)| next - last).collect();
    steps.sort_by(f64::total_cmp);
    // One that the end of the flight cuts short is no interval; nothing comes after it.
    let last = (span.1 - end > 0.0).then_some((end, f64::INFINITY));
    pauses
        .chain(last)
        .filter(|(last, next)| next.min(span.1) - last > SHORTEST_SILENCE && *next > span.0)
        .filter_map(|(last, next)| {
            let usual = quantile_of_others(&steps, next - last, 0.9);
            let longest = (INTERVALS * usual).max(SHORTEST_SILENCE);
            (next.min(span.1) - last > longest).then_some(DoubtedStretch {
                right: last,
                since: last + longest,
                until: next,
            })
        })
        .collect()
}

/// Growth rate of the mean square of the angle by which a heading turns, rad²/s, as of a random walk.
fn wander(heading: &Channel) -> f64 {
    let turns = heading.times.iter().zip(&heading.values);
    let turns = turns.filter_map(|(time, value)| {
        let earlier = heading.times.partition_point(|t| *t <= time - WANDER);
        let before = earlier.checked_sub(1)?;
        let dt = time - heading.times[before];
        Some(wrap_pi(value - heading.values[before]).powi(2) / dt)
    });
    let turns: Vec<f64> = turns.collect();
    turns.iter().sum::<f64>() / turns.len().max(1) as f64
}

/// The usual one of `values`, and how far they stray from it.
fn usual(values: &[f64]) -> Option<(f64, f64)> {
    if values.len() < FEWEST {
        return None;
    }
    let usual = quantile(values.to_vec(), 0.5);
    let deviations = values.iter().map(|v| (v - usual).powi(2)).sum::<f64>();
    Some((usual, (deviations / values.len() as f64).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::super::flight_for_tests::flight_of;
    use super::*;

    /// An airplane on a racetrack for 90 s, read ten times a second.
    fn flight() -> Flight {
        let times: Vec<f64> = (0..900).map(|i| 0.1 * f64::from(i)).collect();
        let channel = |name, value: fn(f64) -> f64| Channel {
            name,
            times: times.clone(),
            values: times.iter().map(|t| value(*t)).collect(),
        };
        let turning = |t: f64| wrap_pi(0.06 * t + 0.8 * (0.2 * t).sin());
        flight_of(vec![
            channel(ChannelName::Airspeed, |t| 18.0 + (1.7 * t).sin()),
            channel(ChannelName::Heading, turning),
            channel(ChannelName::HeightAboveGround, |t| 120.0 + t.sin()),
        ])
    }

    fn channel(flight: &mut Flight, name: ChannelName) -> &mut Channel {
        flight.channels.iter_mut().find(|c| c.name == name).unwrap()
    }

    #[test]
    fn sound_instruments_are_believed_all_along() {
        let inputs = Inputs::of(&flight());
        assert!(inputs.doubted.is_empty(), "{:?}", inputs.doubted);
        assert_eq!(inputs.cruise(), None);
    }

    #[test]
    fn what_sticks_or_falls_silent_is_noticed_and_not_believed() {
        let mut flight = flight();
        let airspeed = channel(&mut flight, ChannelName::Airspeed);
        for (time, value) in airspeed.times.iter().zip(&mut airspeed.values) {
            if (30.0..50.0).contains(time) {
                *value = 12.0;
            }
        }
        let heading = channel(&mut flight, ChannelName::Heading);
        let end = heading.times.partition_point(|t| *t < 60.0);
        heading.times.truncate(end);
        heading.values.truncate(end);
        let inputs = Inputs::of(&flight);
        let input = |time| inputs.between(&flight, time - 0.05, time + 0.05);
        assert!(input(29.0).airspeed.is_some() && input(29.0).heading_deviation == 0.0);
        assert_eq!(input(45.0).airspeed, None);
        assert!(input(52.0).airspeed.is_some());
        let (soon, later) = (input(62.0).heading_deviation, input(80.0).heading_deviation);
        assert!(
            // Since 59.9 s, when it was read last: the root of 20.1 s against that of 2.1 s.
            0.0 < soon && (later / soon - 3.094).abs() < 0.01 && later < 3.0,
            "{soon} {later}"
        );
        let told = inputs.doubts(70.0);
        assert_eq!(told.len(), 1);
        assert_eq!(told[0].why, SensorFault::Silent);
        assert!((told[0].since - 61.5).abs() < 0.5, "{told:?}");
        let (cruise, deviation) = inputs.cruise().unwrap();
        assert!((14.0..24.0).contains(&cruise) && deviation < 3.0);
    }

    #[test]
    fn rare_readings_are_not_silent_and_what_stands_is_not_stuck() {
        let mut flight = flight();
        let heading = channel(&mut flight, ChannelName::Heading);
        heading.times = (0..18).map(|i| 5.0 * f64::from(i)).collect();
        heading.values = (0..18).map(f64::from).collect();
        let airspeed = channel(&mut flight, ChannelName::Airspeed);
        for (time, value) in airspeed.times.iter().zip(&mut airspeed.values) {
            if *time < 30.0 {
                *value = 0.0;
            }
        }
        let inputs = Inputs::of(&flight);
        assert!(inputs.doubted.is_empty(), "{:?}", inputs.doubted);
    }

    /// The flight with a velocity and a tilt that wag, but from 40 s to 60 s stand where they were.
    fn with_stuck(speed: f64) -> Flight {
        let mut flight = flight();
        let times: Vec<f64> = (0..900).map(|i| 0.1 * f64::from(i)).collect();
        for (name, middle) in [
            (ChannelName::VelocityNorth, speed),
            (ChannelName::VelocityEast, 0.0),
            (ChannelName::Roll, 0.0),
            (ChannelName::Pitch, -0.1),
        ] {
            let shown = |t: f64| if (40.0..60.0).contains(&t) { 40.0 } else { t };
            let values = times
                .iter()
                .map(|t| middle + 0.05 * (3.0 * shown(*t)).sin());
            flight.channels.push(Channel {
                name,
                times: times.clone(),
                values: values.collect(),
            });
        }
        flight
    }

    #[test]
    fn a_velocity_and_a_tilt_that_stick_are_found_and_not_flown_by() {
        let flight = with_stuck(12.0);
        let inputs = Inputs::of(&flight);
        let told: Vec<String> = inputs.doubts(50.0).iter().map(Doubt::words).collect();
        assert_eq!(
            told,
            [
                "roll is stuck since 43.0 s",
                "pitch is stuck since 43.0 s",
                "velocity north is stuck since 43.0 s",
                "velocity east is stuck since 43.0 s"
            ]
        );
        let input = |time| inputs.between(&flight, time - 0.05, time + 0.05);
        let stuck = input(50.0);
        assert_eq!(stuck.ground_velocity, None);
        assert!(stuck.tilt_deviation > 0.03, "{stuck:?}");
        for time in [30.0, 70.0] {
            let sound = input(time);
            assert!(sound.ground_velocity.is_some() && sound.tilt_deviation == 0.0);
            assert_eq!(inputs.doubts(time), []);
        }
        // The airspeed is sound: none is assumed.
        assert_eq!(inputs.cruise(), None);
        // What stands on the ground, or hovers still, is not stuck.
        assert_eq!(Inputs::of(&with_stuck(0.5)).doubts(50.0), []);
    }

    #[test]
    fn a_gimbal_that_holds_its_pitch_and_a_leg_due_north_are_no_stuck_instruments() {
        let mut flight = with_stuck(12.0);
        for channel in &mut flight.channels {
            if [ChannelName::Roll, ChannelName::VelocityNorth].contains(&channel.name) {
                let wags = channel.times.iter().map(|t| 12.0 + 0.05 * (3.0 * t).sin());
                channel.values = wags.collect();
            }
        }
        assert_eq!(Inputs::of(&flight).doubts(50.0), []);
    }

    #[test]
    fn a_pause_among_few_readings_is_judged_by_the_others() {
        let mut flight = flight();
        let heading = channel(&mut flight, ChannelName::Heading);
        // Photos every two seconds, and half a minute between two strips.
        heading.times = vec![0.0, 2.0, 4.0, 34.0, 36.0, 38.0];
        heading.values = vec![0.0, 0.1, 0.0, 3.1, 3.0, 3.1];
        let inputs = Inputs::of(&flight);
        let heading = |time| inputs.doubt(ChannelName::Heading, time);
        assert_eq!(heading(10.0), None);
        assert!((heading(20.0).unwrap().since - 14.0).abs() < 1e-9);
        assert_eq!(heading(34.0), None, "there is one again");
    }

    #[test]
    fn a_velocity_that_falls_silent_is_none_and_a_tilt_is_what_it_is_usually() {
        let mut flight = flight();
        let times: Vec<f64> = (0..200).map(|i| 0.1 * f64::from(i)).collect();
        for (name, middle) in [
            (ChannelName::VelocityNorth, 0.6),
            (ChannelName::VelocityEast, 0.0),
            (ChannelName::Roll, 0.0),
            (ChannelName::Pitch, -0.1),
        ] {
            let values = (0..200).map(|i| middle + if i % 2 == 0 { 0.05 } else { -0.05 });
            flight.channels.push(Channel {
                name,
                times: times.clone(),
                values: values.collect(),
            });
        }
        let inputs = Inputs::of(&flight);
        let input = |time| inputs.between(&flight, time - 0.05, time + 0.05);
        assert!(input(19.0).ground_velocity.is_some() && input(19.0).tilt_deviation == 0.0);
        let silent = input(30.0);
        assert_eq!(silent.ground_velocity, None);
        assert!((silent.tilt_deviation - 0.05).abs() < 0.051, "{silent:?}");
        assert!(silent.tilt_deviation > 0.04 && silent.attitude.pitch < 0.0);
        let told: Vec<String> = inputs.doubts(30.0).iter().map(Doubt::words).collect();
        assert_eq!(told.len(), 4, "{told:?}");
        assert_eq!(told[2], "velocity north is silent since 21.4 s");
        assert_eq!(inputs.cruise(), None);
    }

    #[test]
    fn a_doubt_names_its_instrument_and_what_is_wrong_with_it() {
        let words = |instrument, why| {
            let since = 12.34;
            let doubt = Doubt {
                instrument,
                why,
                since,
            };
            doubt.words()
        };
        let heading = Instrument::Channel(ChannelName::Heading);
        let by = -20.4_f64.to_radians();
        assert_eq!(
            words(heading, SensorFault::Turned { by }),
            "heading reads 20° too far left, corrected since 12.3 s"
        );
        assert_eq!(
            words(heading, SensorFault::Contradicted),
            "heading is contradicted by the pictures since 12.3 s"
        );
        assert_eq!(
            words(Instrument::Camera, SensorFault::Late { by: 0.96 }),
            "camera is 1.0 s late, allowed for since 12.3 s"
        );
        let height = Instrument::Channel(ChannelName::HeightAboveGround);
        assert_eq!(
            words(height, SensorFault::Silent),
            "height above ground is silent since 12.3 s"
        );
    }
}
