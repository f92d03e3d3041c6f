//! Tests of `picture_lag`.

use nalgebra::{Matrix4, Point3, Vector4};

use super::super::engine::engine;
use super::*;
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_vision::landmark::Landmark;

fn start() -> Box<dyn Engine> {
    engine(&NavigatorSettings::default(), GroundPoint::default(), 3.0).unwrap()
}

#[test]
fn a_landmark_that_is_seen_alone_again_and_again_says_no_more_than_that_it_may_be_wrong() {
    let rect = GroundRect::centered(GroundPoint::default(), 30.0, 30.0);
    let (one, other) = (
        Landmark::new(1, "one", rect),
        Landmark::new(2, "other", rect),
    );
    let place: SightedPlace = (Vector4::zeros(), Matrix4::identity());
    let mut lag = PictureLag::new(start().as_ref()).unwrap();
    let hypothesis = &mut lag.hypotheses[0];
    let before = hypothesis.weight;
    for _ in 0..20 {
        hypothesis.weigh(&[(&one, 0, place)], 3.0);
    }
    assert!((hypothesis.weight / before / ODDS_OF_ONE - 1.0).abs() < 1e-9);
    hypothesis.weigh(&[(&other, 0, place)], 2.0);
    hypothesis.weigh(&[(&one, 0, place), (&other, 1, place)], 1.0);
    let odds = (hypothesis.weight / before).ln();
    assert!((odds - ODDS_OF_ONE.ln() - 3.0).abs() < 1e-9, "{odds}");
}

#[test]
fn a_lag_that_was_ruled_out_may_begin_later_and_goes_on_from_the_first() {
    let mut first = start();
    let mut lag = PictureLag::new(first.as_ref()).unwrap();
    let ahead = ControlInput::new(18.0, Attitude::level(0.0));
    first.predict(&ahead, 1.0).unwrap();
    let likely = lag.hypotheses[1].weight;
    lag.hypotheses[0].weight = 1e-30;
    lag.hypotheses[0].alone.insert(7, -60.0);
    for time in [4.0, 14.0] {
        lag.let_begin(first.as_ref(), time).unwrap();
    }
    let begun = &lag.hypotheses[0];
    let expected = (1.0 - LATE) * BEGINS * 10.0 / f64::from(HYPOTHESES);
    assert!(
        (begun.weight / expected - 1.0).abs() < 1e-9,
        "{}",
        begun.weight
    );
    assert_eq!(begun.engine.state(), first.state());
    assert!(begun.alone.is_empty());
    // One that is likelier than that keeps its own belief.
    assert_eq!(lag.hypotheses[1].weight, likely);
    assert_eq!(lag.hypotheses[1].engine.state(), start().state());
}

#[test]
fn a_punctual_camera_leaves_the_belief_as_it_is() {
    let (mut engine, time) = (start(), 5.0);
    let mut lag = PictureLag::new(engine.as_ref()).unwrap();
    let past = |_| Vec::new();
    assert!(
        lag.together(engine.as_ref(), &engine.state(), &past)
            .is_none()
    );
    assert!(lag.doubt().is_none() && !lag.replace(&mut engine, time));
    assert!(
        (lag.weight + lag.hypotheses.iter().map(|h| h.weight).sum::<f64>() - 1.0).abs() < 1e-12
    );
}

#[test]
fn beliefs_are_mixed_while_a_lag_may_be_and_one_gives_way_that_hardly_can() {
    let mut first = start();
    let mut lag = PictureLag::new(first.as_ref()).unwrap();
    // One hypothesis, as likely as the first, believes to be 18 m farther north.
    lag.hypotheses.truncate(1);
    lag.hypotheses[0].weight = 0.5;
    lag.weight = 0.5;
    lag.doubted = Some(2.0);
    let ahead = ControlInput::new(18.0, Attitude::level(0.0));
    lag.predict(&ahead, 1.0);
    let state = first.state();
    let past = |lag| vec![(ahead, lag)];
    let together = lag.together(first.as_ref(), &state, &past).unwrap();
    assert!(
        (together.position().north - 9.0).abs() < 1e-6,
        "{together:?}"
    );
    let north = together.covariance[(0, 0)];
    assert!(
        (80.0..120.0).contains(&(north - state.covariance[(0, 0)])),
        "{north}"
    );
    // The hypothesis stands for lags of 0.5 s and their neighbours, over 18 · 0.5 m of its way, whatever the filters look at.
    let cell = north
        - lag
            .together(first.as_ref(), &state, &|_| Vec::new())
            .unwrap()
            .covariance[(0, 0)];
    assert!((cell - 0.5 * 81.0 / 12.0).abs() < 1e-6, "{cell}");
    lag.hypotheses[0].engine.look_now(&ahead);
    assert_eq!(lag.together(first.as_ref(), &state, &past), Some(together));
    assert_eq!(
        lag.doubt().unwrap().words(),
        "camera may be late since 2.0 s"
    );
    lag.weight = 1e-3;
    lag.share();
    assert!(lag.replace(&mut first, 7.0));
    assert!((first.state().position().north - 18.0).abs() < 1e-6);
    assert!((lag.assumed() - 0.5).abs() < 1e-12);
    assert_eq!(
        lag.doubt().unwrap().words(),
        "camera is 0.5 s late, allowed for since 7.0 s"
    );
}

#[test]
fn a_place_is_the_same_to_whoever_assumes_another_heading_and_height() {
    let pose = |yaw, height: f64| Pose {
        position_in_world: Point3::new(0.0, 0.0, -height),
        attitude: Attitude::level(yaw),
    };
    let place = (Vector4::new(320.0, 240.0, 0.1, 0.0), Matrix4::identity());
    let (seen, _) = seen_anew(&place, &pose(1.0, 100.0), &pose(1.2, 110.0));
    assert!((seen - Vector4::new(320.0, 240.0, 0.3, 1.1_f64.ln())).norm() < 1e-12);
}
