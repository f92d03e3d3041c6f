//! Tests of `estimate`.

use nalgebra::{Point2, Point3};

use super::*;
use crate::calibration::ResidualSummary;
use crate::calibration::residual::RegisteredPose;
use pilotage_base::frames::{Attitude, GroundPoint, Pose};
use pilotage_flight::{Channel, ChannelName, Frame, StartFix};
use pilotage_raster::camera::CameraModel;

const HEIGHT: f64 = 80.0;

fn align(
    flight: &Flight,
    frames: &[RegisteredPose],
    believed: &CameraPrior,
) -> Result<CameraToLog, CalibrationError> {
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

/// Frames as the pictures show them if the frames' clock, the mount and the lens are off by `truth`, with
/// noise in their last digits; every tenth is laid somewhere else.
fn shown(flight: &Flight, truth: &Unknowns, noise: f64) -> Vec<RegisteredPose> {
    let log = ReferenceLog::new(flight, &[]).unwrap();
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
        RegisteredPose {
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
    let frames: Vec<RegisteredPose> = (10..60)
        .map(|i| RegisteredPose {
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
        Err(CalibrationError::TooFewFrames { found: 4 })
    );
    flight.channels.clear();
    assert_eq!(
        align(&flight, &frames, &believed),
        Err(CalibrationError::NoFixes)
    );
}
