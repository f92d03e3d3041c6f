//! Time offset, drift, mount and focal length of a camera beside a log.

use serde::{Deserialize, Serialize};

use super::CameraEvidence;
use super::residual::{Log, Unknowns};
use super::solve::{Solution, solve};
use crate::navigator::Run;
use pilotage_flight::Flight;
use pilotage_mission::settings::CameraAdjustment;

/// Fewest frames from which anything can be told.
const FEWEST: usize = 6;
/// Guesses of the time offset, from one to the next, seconds.
const STEP: f64 = 0.1;

/// A number with its standard deviation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimated {
    /// The number.
    pub value: f64,
    /// Its standard deviation; that of what was assumed where the flight does not tell.
    pub deviation: f64,
    /// Whether the flight tells it: whether it is known at least twice as well as before.
    pub is_told: bool,
}

/// What is believed before the flight is looked at: standard deviations about zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraPrior {
    /// Time offset, seconds; three of them to each side are searched.
    pub offset: f64,
    /// Drift of the camera's clock against the log's, seconds per second.
    pub drift: f64,
    /// Each of the mount's angles, radians.
    pub mount: f64,
    /// Natural logarithm of the factor on the focal length.
    pub log_focal: f64,
    /// Natural logarithm of the factor on all of the log's heights: the ground is not where it took off.
    pub log_height: f64,
    /// Bias of satellite navigation against the map per axis, metres.
    pub bias: f64,
}

impl Default for CameraPrior {
    fn default() -> Self {
        Self {
            offset: 1.0,
            drift: 1e-4,
            mount: 3_f64.to_radians(),
            log_focal: 0.1,
            log_height: 0.03,
            bias: 3.0,
        }
    }
}

/// A camera beside a log. Time by the log is t + `offset` + `drift` (t - `middle`) for a time t of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraToLog {
    /// Seconds to add to the times of the frames, in the middle of the flight.
    pub offset: Estimated,
    /// Seconds per second by which the camera's clock is slow.
    pub drift: Estimated,
    /// The middle of the flight, seconds.
    pub middle: f64,
    /// To add to the mount's roll, radians.
    pub roll: Estimated,
    /// To add to the mount's pitch, radians.
    pub pitch: Estimated,
    /// To add to the mount's yaw, radians.
    pub yaw: Estimated,
    /// Natural logarithm of the factor on the focal length.
    pub log_focal: Estimated,
    /// What satellite navigation is off the map (north, east), metres: to add to its places.
    pub bias: [Estimated; 2],
    /// Frames that were held against the log.
    pub frames: usize,
    /// Standard deviation per axis of places of satellite navigation about those of the frames, metres, before
    /// and after.
    pub place_deviation: [f64; 2],
}

/// Why nothing can be told.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AlignmentError {
    /// Too few frames lie on the map.
    #[error(
        "{found} frames of the flight were laid on the map during the log; at least {FEWEST} are needed"
    )]
    TooFewFrames {
        /// How many do.
        found: usize,
    },
    /// Nothing to hold the frames against.
    #[error("the log has no satellite navigation against which the frames could be held")]
    NoFixes,
    /// The equations have no solution.
    #[error("the frames and the log contradict each other beyond reason")]
    NoSolution,
}

/// Estimates the camera of `flight` from the frames that `run` laid on the map, by robust least squares from
/// every time offset that is possible. Deviations count the errors of neighbouring frames as alike as they are.
///
/// # Errors
/// Too few frames, no satellite navigation, or nothing that explains the frames.
pub fn camera_to_log(
    flight: &Flight,
    run: &Run,
    believed: &CameraPrior,
) -> Result<CameraToLog, AlignmentError> {
    CameraEvidence::of(flight, run).estimate(believed)
}

/// An estimate under way: a guess of the time offset after the other. The evidence has to be the same in every
/// call.
#[derive(Clone, Debug)]
pub struct CameraSearch {
    believed: CameraPrior,
    prior: Unknowns,
    /// Guesses of the time offset, and how many of them are done.
    guesses: Vec<f64>,
    done: usize,
    likely: Option<Solution>,
}

impl CameraSearch {
    /// Nothing tried yet.
    ///
    /// # Errors
    /// Too few frames, or no satellite navigation.
    pub fn new(evidence: &CameraEvidence, believed: &CameraPrior) -> Result<Self, AlignmentError> {
        let log = evidence.log().ok_or(AlignmentError::NoFixes)?;
        if evidence.frames() < FEWEST {
            return Err(AlignmentError::TooFewFrames {
                found: evidence.frames(),
            });
        }
        let count = (3.0 * believed.offset / STEP).ceil() as i32;
        Ok(Self {
            believed: *believed,
            prior: prior(&log, believed),
            guesses: (-count..=count).map(|i| f64::from(i) * STEP).collect(),
            done: 0,
            likely: None,
        })
    }

    /// Share of the guesses that were tried, 0 to 1.
    pub fn progress(&self) -> f64 {
        self.done as f64 / self.guesses.len().max(1) as f64
    }

    /// Tries the next guess; false once there is none left.
    pub fn advance(&mut self, evidence: &CameraEvidence) -> bool {
        let (Some(log), Some(offset)) = (evidence.log(), self.guesses.get(self.done)) else {
            return false;
        };
        // At first with the offset held: its valley is narrow where the aircraft turns.
        let mut held = self.prior;
        held[0] = 0.0;
        held[1] = 0.0;
        let mut guess = Unknowns::zeros();
        guess[0] = *offset;
        self.done += 1;
        let frames = evidence.laid();
        let solution = solve(&log, frames, &guess, &held);
        let enough = |s: &Solution| 2 * s.frames > frames.len() && s.frames >= FEWEST;
        let best = self.likely.as_ref().map_or(f64::INFINITY, |s| s.cost);
        if let Some(found) = solution.filter(|s| enough(s) && s.cost < best) {
            self.likely = Some(found);
        }
        true
    }

    /// The estimate around the likeliest guess.
    ///
    /// # Errors
    /// Too few frames fall into the log, or nothing explains them.
    pub fn finish(&self, evidence: &CameraEvidence) -> Result<CameraToLog, AlignmentError> {
        let log = evidence.log().ok_or(AlignmentError::NoFixes)?;
        let (frames, prior) = (evidence.laid(), &self.prior);
        let likely = self.likely.as_ref();
        let likely = likely.ok_or(AlignmentError::TooFewFrames { found: 0 })?;
        let best =
            solve(&log, frames, &likely.unknowns, prior).ok_or(AlignmentError::NoSolution)?;
        let before = solve(&log, frames, &Unknowns::zeros(), &Unknowns::zeros());
        let before = before.map_or(f64::NAN, |solution| solution.place_deviation);
        let mut found = told(&best, prior, log.middle, before);
        // A longer lens and higher ground look alike.
        let deviation = found.log_focal.deviation.hypot(self.believed.log_height);
        found.log_focal.is_told &= 2.0 * deviation < self.believed.log_focal;
        found.log_focal.deviation = deviation;
        Ok(found)
    }
}

/// Standard deviations of the unknowns; zero for what the log cannot tell.
fn prior(log: &Log<'_>, believed: &CameraPrior) -> Unknowns {
    let mount = if log.has_heading { believed.mount } else { 0.0 };
    let focal = if log.has_height {
        believed.log_focal
    } else {
        0.0
    };
    Unknowns::from([
        believed.offset,
        believed.drift,
        mount,
        mount,
        mount,
        focal,
        believed.bias,
        believed.bias,
    ])
}

fn told(best: &Solution, prior: &Unknowns, middle: f64, before: f64) -> CameraToLog {
    let number = |i: usize| {
        let deviation = best.covariance[(i, i)].max(0.0).sqrt();
        Estimated {
            value: best.unknowns[i],
            deviation,
            is_told: prior[i] > 0.0 && 2.0 * deviation < prior[i],
        }
    };
    CameraToLog {
        offset: number(0),
        drift: number(1),
        middle,
        roll: number(2),
        pitch: number(3),
        yaw: number(4),
        log_focal: number(5),
        bias: [number(6), number(7)],
        frames: best.frames,
        place_deviation: [before, best.place_deviation],
    }
}

impl CameraToLog {
    /// What is to be changed of the camera. What the flight does not tell stays near what was believed, since
    /// the estimate does.
    pub fn adjustment(&self) -> CameraAdjustment {
        CameraAdjustment {
            offset: self.offset.value,
            drift: self.drift.value,
            middle: self.middle,
            roll: self.roll.value,
            pitch: self.pitch.value,
            yaw: self.yaw.value,
            log_focal: self.log_focal.value,
        }
    }

    /// The same estimate for a flight of which all but `left` was changed already: known as well, and about the
    /// middle of `left`.
    #[must_use]
    pub fn with(&self, left: &CameraAdjustment) -> Self {
        let number = |value, known: Estimated| Estimated { value, ..known };
        Self {
            offset: number(left.offset, self.offset),
            drift: number(left.drift, self.drift),
            middle: left.middle,
            roll: number(left.roll, self.roll),
            pitch: number(left.pitch, self.pitch),
            yaw: number(left.yaw, self.yaw),
            log_focal: number(left.log_focal, self.log_focal),
            ..*self
        }
    }

    /// Satellite navigation's bias against the map: north, east, metres.
    pub fn bias_values(&self) -> [f64; 2] {
        self.bias.map(|axis| axis.value)
    }

    /// The flight with its frames at the log's times and its camera as estimated.
    pub fn apply(&self, flight: &Flight) -> Flight {
        self.adjustment().apply(flight)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point2, Point3};

    use super::*;
    use crate::alignment::ResidualSummary;
    use crate::alignment::residual::Laid;
    use pilotage_base::frames::{Attitude, GroundPoint, Pose};
    use pilotage_flight::{Channel, ChannelName, Frame, StartFix};
    use pilotage_raster::camera::CameraModel;

    const HEIGHT: f64 = 80.0;

    fn align(
        flight: &Flight,
        frames: &[Laid],
        believed: &CameraPrior,
    ) -> Result<CameraToLog, AlignmentError> {
        CameraEvidence::from_frames(flight, frames.to_vec()).estimate(believed)
    }

    /// A flight in eights at 15 m/s that banks in its turns, with fixes five times a second.
    fn flight() -> Flight {
        let times: Vec<f64> = (0..1500).map(|i| 0.2 * f64::from(i)).collect();
        let state = |t: f64| {
            let heading = 2.0 * (0.06 * t).sin() + 0.01 * t;
            (heading, 0.25 * (0.06 * t).cos(), 0.03 * (0.2 * t).sin())
        };
        let (mut north, mut east) = (0.0, 0.0);
        let mut places = Vec::new();
        for time in &times {
            let (heading, _, _) = state(*time);
            north += 3.0 * heading.cos();
            east += 3.0 * heading.sin();
            places.push((north, east));
        }
        let channel = |name, value: &dyn Fn(usize) -> f64| Channel {
            name,
            times: times.clone(),
            values: (0..times.len()).map(value).collect(),
        };
        Flight {
            name: "eights".to_owned(),
            frame_on_globe: None,
            camera: CameraModel::pinhole(640, 480, 1.0),
            ground_down: 0.0,
            channels: vec![
                channel(ChannelName::GpsNorth, &|i| places[i].0),
                channel(ChannelName::GpsEast, &|i| places[i].1),
                channel(ChannelName::Heading, &|i| {
                    pilotage_base::frames::wrap_pi(state(times[i]).0)
                }),
                channel(ChannelName::Roll, &|i| state(times[i]).1),
                channel(ChannelName::Pitch, &|i| state(times[i]).2),
                channel(ChannelName::HeightAboveGround, &|_| HEIGHT),
            ],
            frames: (10..140)
                .map(|i| Frame {
                    time: 2.0 * f64::from(i),
                    name: i.to_string(),
                    stored_turn: 0.0,
                })
                .collect(),
            start: StartFix {
                time: 0.0,
                position: GroundPoint::default(),
                standard_deviation: 3.0,
            },
            truth: None,
        }
    }

    /// What pictures show if the frames' clock, the mount and the lens are off by `truth`, with noise in their
    /// last digits; every tenth is laid somewhere else.
    fn shown(flight: &Flight, truth: &Unknowns, noise: f64) -> Vec<Laid> {
        let log = Log::new(flight, &[]).unwrap();
        let mut camera = flight.camera.clone();
        camera.mount.roll += truth[2];
        camera.mount.pitch += truth[3];
        camera.mount.yaw += truth[4];
        camera.focal *= truth[5].exp();
        let frames = flight.frames.iter().enumerate();
        let laid = frames.map(|(index, frame)| {
            let middle = 150.0;
            let time = frame.time + truth[0] + truth[1] * (frame.time - middle);
            let value = |name| flight.value(name, time).unwrap();
            let attitude = Attitude {
                roll: value(ChannelName::Roll),
                pitch: value(ChannelName::Pitch),
                yaw: value(ChannelName::Heading),
            };
            let pose = Pose {
                position_in_world: Point3::new(
                    value(ChannelName::GpsNorth),
                    value(ChannelName::GpsEast),
                    -HEIGHT,
                ),
                attitude,
            };
            let pixel = Point2::new(320.0, 240.0);
            let centre = camera.ground_at(&pose, &pixel, 0.0).unwrap();
            let wrong = if index % 10 == 3 { 25.0 } else { 0.0 };
            let wave = |k: f64| noise * (k * index as f64).sin();
            Laid {
                index,
                time: frame.time,
                centre: GroundPoint::new(
                    centre.north + truth[6] + wave(2.1) + wrong,
                    centre.east + truth[7] + wave(3.7),
                ),
                yaw: attitude.yaw + truth[4] + 0.01 * wave(1.3),
                height: HEIGHT * (-truth[5]).exp(),
                stored_turn: 0.0,
            }
        });
        assert_eq!(log.span.0, 0.0);
        laid.collect()
    }

    #[test]
    fn offset_mount_and_lens_are_found_within_what_is_said_of_them() {
        let flight = flight();
        let truth = Unknowns::from([0.83, 0.0, 0.02, -0.035, 0.05, -0.04, 1.2, -0.8]);
        let frames = shown(&flight, &truth, 0.4);
        let found = align(&flight, &frames, &CameraPrior::default()).unwrap();
        for (name, number, wanted, most) in [
            ("offset", found.offset, truth[0], 0.05),
            ("roll", found.roll, truth[2], 0.01),
            ("pitch", found.pitch, truth[3], 0.01),
            ("yaw", found.yaw, truth[4], 0.01),
            ("north", found.bias[0], truth[6], 0.5),
            ("east", found.bias[1], truth[7], 0.5),
        ] {
            let error = number.value - wanted;
            assert!(
                error.abs() < 3.0 * number.deviation,
                "{name}: {number:?}, {wanted}"
            );
            assert!(number.deviation < most, "{name}: {number:?}");
            assert!(number.is_told, "{name}");
        }
        assert!((found.log_focal.value - truth[5]).abs() < 0.002);
        // The height above the ground is not known better than this.
        assert!(found.log_focal.deviation >= CameraPrior::default().log_height);
        assert!(found.place_deviation[0] > 5.0 * found.place_deviation[1]);

        let mended = found.apply(&flight);
        assert!((mended.frames[0].time - flight.frames[0].time - 0.83).abs() < 0.1);
        assert!((mended.camera.mount.pitch + 0.035).abs() < 0.01);
    }

    /// Root mean squares with the time offset and the mount's pitch moved away from the estimate.
    #[test]
    fn residuals_are_least_at_the_estimate_and_grow_to_both_sides() {
        let flight = flight();
        let truth = Unknowns::from([0.83, 0.0, 0.02, -0.035, 0.05, -0.04, 1.2, -0.8]);
        let mut frames = shown(&flight, &truth, 0.4);
        frames.retain(|frame| frame.index % 10 != 3);
        let evidence = CameraEvidence::from_frames(&flight, frames);
        let found = evidence.estimate(&CameraPrior::default()).unwrap();
        let at = |change: &CameraAdjustment| {
            ResidualSummary::of(&evidence.residuals(change, found.bias_values()))
        };
        let best = found.adjustment();
        let here = at(&best);
        assert_eq!(here.frames, evidence.frames());
        let none = at(&CameraAdjustment::none(best.middle));
        assert!(none.place > 5.0 * here.place, "{none:?} {here:?}");
        assert!(none.heading > here.heading && none.log_height > here.log_height);
        for away in [-0.2, -0.1, 0.1, 0.2] {
            let mut changed = best;
            changed.offset += away;
            assert!(at(&changed).place > here.place, "{away} s");
            let mut changed = best;
            changed.pitch += 0.2 * away;
            assert!(at(&changed).place > here.place, "pitch {away}");
            let mut changed = best;
            changed.yaw += 0.2 * away;
            assert!(at(&changed).heading > here.heading, "yaw {away}");
            let mut changed = best;
            changed.log_focal += 0.2 * away;
            assert!(at(&changed).log_height > here.log_height, "lens {away}");
        }
    }

    #[test]
    fn frames_stamped_early_lie_ahead_along_the_track_until_time_is_added() {
        let flight = flight();
        let mut truth = Unknowns::zeros();
        truth[0] = 1.0;
        let mut frames = shown(&flight, &truth, 0.0);
        frames.retain(|frame| frame.index % 10 != 3);
        let evidence = CameraEvidence::from_frames(&flight, frames);
        let seen = |offset: f64| {
            let change = CameraAdjustment {
                offset,
                ..CameraAdjustment::none(0.0)
            };
            let residuals = evidence.residuals(&change, [0.0; 2]);
            let along = residuals.iter().filter_map(|r| r.along_and_across);
            let (mut sum, mut count) = (0.0, 0.0);
            for (along, _) in along {
                sum += along;
                count += 1.0;
            }
            sum / count
        };
        // 15 m/s: a second is about 15 m, less where it turns and more or less where it pitches.
        let ahead = seen(0.0);
        assert!((10.0..18.0).contains(&ahead), "{ahead}");
        assert!(seen(1.0).abs() < 0.1, "{}", seen(1.0));
        assert!((-18.0..-10.0).contains(&seen(2.0)), "{}", seen(2.0));
    }

    #[test]
    fn the_footprint_moves_with_the_time_offset_and_shrinks_under_a_longer_lens() {
        let flight = flight();
        let frames = shown(&flight, &Unknowns::zeros(), 0.0);
        let evidence = CameraEvidence::from_frames(&flight, frames);
        let none = CameraAdjustment::none(0.0);
        let corners = |change: &CameraAdjustment| evidence.footprint(40, change).unwrap();
        let middle = |c: &[GroundPoint]| {
            let sum = c
                .iter()
                .fold((0.0, 0.0), |s, p| (s.0 + p.north, s.1 + p.east));
            GroundPoint::new(sum.0 / 4.0, sum.1 / 4.0)
        };
        let later = CameraAdjustment {
            offset: 1.0,
            ..none
        };
        let moved = middle(&corners(&none)).distance(&middle(&corners(&later)));
        assert!((8.0..25.0).contains(&moved), "{moved}");
        let longer = CameraAdjustment {
            log_focal: 0.5_f64.ln(),
            ..none
        };
        let side = |c: &[GroundPoint]| c[0].distance(&c[1]);
        let ratio = side(&corners(&longer)) / side(&corners(&none));
        assert!((1.8..2.3).contains(&ratio), "{ratio}");
        assert!(evidence.footprint(9999, &none).is_none());
    }

    #[test]
    fn a_clock_that_runs_wrong_is_noticed_over_a_flight() {
        let flight = flight();
        let truth = Unknowns::from([-0.4, 2e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let frames = shown(&flight, &truth, 0.2);
        let believed = CameraPrior {
            drift: 1e-2,
            ..CameraPrior::default()
        };
        let found = align(&flight, &frames, &believed).unwrap();
        let error = found.drift.value - 2e-3;
        assert!(
            error.abs() < 3.0 * found.drift.deviation.max(5e-5),
            "{found:?}"
        );
        assert!(found.drift.is_told);
    }

    #[test]
    fn what_a_straight_flight_without_attitude_cannot_tell_is_not_told() {
        let mut flight = flight();
        flight
            .channels
            .retain(|c| matches!(c.name, ChannelName::GpsNorth | ChannelName::GpsEast));
        for channel in &mut flight.channels {
            let slope = if channel.name == ChannelName::GpsNorth {
                12.0
            } else {
                0.0
            };
            channel.values = channel.times.iter().map(|t| slope * t).collect();
        }
        let frames: Vec<Laid> = (10..60)
            .map(|i| Laid {
                index: i,
                time: 2.0 * i as f64,
                centre: GroundPoint::new(12.0 * (2.0 * i as f64 + 0.5), 0.0),
                yaw: 0.0,
                height: HEIGHT,
                stored_turn: 0.0,
            })
            .collect();
        let found = align(&flight, &frames, &CameraPrior::default()).unwrap();
        assert!(!found.roll.is_told && !found.yaw.is_told && !found.log_focal.is_told);
        // Six metres ahead may be half a second or a bias along the track.
        assert!(found.offset.deviation > 0.15, "{:?}", found.offset);
        let (offset, bias) = (found.offset.value, found.bias[0].value);
        assert!((12.0 * offset + bias - 6.0).abs() < 0.3, "{found:?}");
    }

    #[test]
    fn what_is_missing_is_said() {
        let mut flight = flight();
        let frames = shown(&flight, &Unknowns::zeros(), 0.1);
        let believed = CameraPrior::default();
        assert_eq!(
            align(&flight, &frames[..4], &believed),
            Err(AlignmentError::TooFewFrames { found: 4 })
        );
        flight.channels.clear();
        assert_eq!(
            align(&flight, &frames, &believed),
            Err(AlignmentError::NoFixes)
        );
    }
}
