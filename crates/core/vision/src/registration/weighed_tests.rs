//! Tests of `weighed`.

use nalgebra::Point3;

use super::super::prior_for_tests::{GreyFrame, usual_prior};
use super::super::shape::MapShape;
use super::*;
use pilotage_base::frames::{Attitude, GroundRect, Pose};
use pilotage_raster::camera::CameraModel;

/// Samples to each side of the middle of a surface.
const MIDDLE: usize = 20;
const SIDE: usize = 2 * MIDDLE + 1;

/// A prior of a place as uncertain as this, metres, with a told height and heading.
fn prior(position_deviation: f64) -> PosePrior {
    PosePrior {
        position_deviation,
        tilt_deviation: 0.02,
        slope_deviation: 0.02,
        ..usual_prior()
    }
}

/// Poses of one height and heading around the prior's place.
fn poses(prior: &PosePrior) -> Poses {
    Poses {
        center: prior.position,
        reach: super::super::limits::REACH * prior.position_deviation,
        heights: vec![prior.height],
        headings: vec![0.0],
        cell: 0.01,
        turns: vec![0],
    }
}

/// Weighs a surface whose places are a metre apart, its middle this far north and east of the prior's place.
fn weigh(
    weighed: &mut WeighedPoses,
    prior: &PosePrior,
    surface: &ChannelSurface,
    [north, east]: [f64; 2],
) {
    let poses = poses(prior);
    let seen = FrameAtHeading {
        at: MapPose {
            pose: Pose {
                position_in_world: Point3::new(north, east, -100.0),
                attitude: Attitude::level(0.0),
            },
            shape: MapShape::default(),
        },
        height: 100.0,
        turn: 0,
        surface,
        corner: (MIDDLE, MIDDLE),
        gsd: 1.0,
        reach: reach_on(poses.reach, 1.0),
        cell: poses.cell,
        evidence: Evidence { chance: 0.05 },
    };
    weighed.weigh(&seen, prior, poses.center);
}

/// A surface on which the frame correlates nowhere.
fn blank() -> ChannelSurface {
    ChannelSurface {
        score: Gray::filled(SIDE, SIDE, 0.0),
        share: None,
    }
}

fn begun(prior: &PosePrior) -> WeighedPoses {
    WeighedPoses::new(prior, &poses(prior), SweepGrid::full())
}

/// The probability of the likeliest guess.
fn likeliest(mut weighed: WeighedPoses) -> f64 {
    let frame = GreyFrame::new(CameraModel::pinhole(64, 48, 1.0));
    weighed.guesses(&[frame.look()], 1)[0].probability
}

#[test]
fn what_is_looked_at_of_a_prior_is_all_of_it_wherever_the_lattice_lies() {
    for deviation in [0.0, 0.05, 0.1, 0.16, 0.3, 0.5, 0.7, 1.0, 2.0, 5.0] {
        for shift in [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.25, -0.4]] {
            let prior = prior(deviation);
            let mut weighed = begun(&prior);
            weigh(&mut weighed, &prior, &blank(), shift);
            let share = weighed.prior_seen / weighed.prior_all;
            assert!((share - 1.0).abs() < 0.04, "{deviation} {shift:?}: {share}");
        }
    }
}

#[test]
fn a_sharp_prior_is_no_evidence_for_a_frame_that_shows_nothing() {
    for deviation in [0.1, 0.16, 0.5] {
        for shift in [[0.0, 0.0], [0.5, 0.5]] {
            let prior = prior(deviation);
            let mut weighed = begun(&prior);
            weigh(&mut weighed, &prior, &blank(), shift);
            let probability = likeliest(weighed);
            assert!(probability <= 0.9, "{deviation} {shift:?}: {probability}");
        }
    }
}

#[test]
fn a_second_look_does_not_see_what_lies_off_the_map() {
    let prior = prior(3.0);
    let mut weighed = begun(&prior);
    // The map ends at the middle: nothing of the frame lies over it to the west of that.
    let on_map = Gray::from_fn(SIDE, SIDE, |column, _| {
        f32::from(u8::from(column >= MIDDLE))
    });
    let edge = ChannelSurface {
        share: Some(on_map),
        ..blank()
    };
    weigh(&mut weighed, &prior, &edge, [0.0, 0.0]);
    let off = weighed.off_the_map();
    // Half of the bell less half of its middle column: 0.5 - 0.5 / (√2π · 3) = 0.434, and what is not looked at beyond.
    let share = off / weighed.prior_all;
    assert!((0.42..0.46).contains(&share), "{share}");
    let mut again = weighed.without(&[], &[], SweepGrid::finest());
    for _ in 0..2 {
        weigh(&mut again, &prior, &edge, [0.25, 0.0]);
        assert_eq!(again.off_the_map(), off);
    }
}

#[test]
fn a_frame_that_may_be_anywhere_is_as_likely_at_the_corner_as_in_the_middle() {
    let ground = GroundRect::centered(GroundPoint::new(0.0, 0.0), 30.0, 30.0);
    let prior = PosePrior {
        anywhere_on: Some(ground),
        ..prior(6.0)
    };
    let found_at = |column: usize, row: usize| {
        let mut score = Gray::filled(SIDE, SIDE, 0.0);
        score.set(column, row, 0.3);
        let surface = ChannelSurface { score, share: None };
        let mut weighed = begun(&prior);
        weigh(&mut weighed, &prior, &surface, [0.5, 0.5]);
        // 900 places of a square metre.
        assert!((weighed.prior_seen / weighed.prior_all - 1.0).abs() < 1e-9);
        likeliest(weighed)
    };
    let (middle, corner) = (found_at(MIDDLE, MIDDLE), found_at(MIDDLE - 15, MIDDLE - 14));
    assert!(middle > 0.1, "{middle}");
    assert!((corner / middle - 1.0).abs() < 0.1, "{middle} {corner}");
}
