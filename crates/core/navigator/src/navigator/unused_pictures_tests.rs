use nalgebra::{DMatrix, DVector, Matrix2, Point2, Point3};
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect, Pose};
use pilotage_mission::settings::{ChosenAid, NavigatorSettings};
use pilotage_vision::landmark::{Landmark, Refusal};

use super::super::step_for_tests::step_at;
use super::super::{CandidateReport, JointReport, UpdateReport};
use super::*;

const PLACE: GroundPoint = GroundPoint {
    north: 0.0,
    east: 0.0,
};

fn frame(index: usize, trouble: Option<&str>, refused: &[Refusal]) -> FrameReport {
    let candidate = |refusal: &Refusal| CandidateReport {
        landmark: 1,
        predicted_pixel: Point2::origin(),
        innovation_covariance: Matrix2::identity(),
        search_region: GroundRect::centered(PLACE, 1.0, 1.0),
        search_outline: Vec::new(),
        measured_pixel: None,
        rotation: None,
        log_scale: None,
        measurement_covariance: None,
        score: 0.0,
        second_score: 0.0,
        probability: None,
        turn_and_size: [0.0; 2],
        innovation: None,
        nis: None,
        threshold: 0.0,
        outcome: Outcome::Refused(*refusal),
    };
    FrameReport {
        index,
        assumed_pose: Pose {
            position_in_world: Point3::origin(),
            attitude: Attitude::default(),
        },
        footprint: Vec::new(),
        candidates: refused.iter().map(candidate).collect(),
        joint: None,
        laid: None,
        trouble: trouble.map(str::to_owned),
    }
}

fn update(aid: &str, is_accepted: bool) -> UpdateReport {
    UpdateReport {
        aid: aid.to_owned(),
        measured: DVector::zeros(1),
        innovation: DVector::zeros(1),
        innovation_covariance: DMatrix::identity(1, 1),
        nis: 0.0,
        degrees_of_freedom: 1,
        threshold: 9.0,
        gain: is_accepted.then(|| DMatrix::zeros(2, 1)),
    }
}

fn step(frame: Option<FrameReport>, updates: Vec<UpdateReport>) -> StepReport {
    StepReport {
        frame,
        updates,
        ..step_at(1.0)
    }
}

/// A run that looks for one landmark and by these aids.
fn run(aids: &[&str], steps: Vec<StepReport>) -> Run {
    let bounds = GroundRect::centered(PLACE, 30.0, 30.0);
    Run {
        name: "a run".to_owned(),
        settings: NavigatorSettings {
            aids: aids.iter().map(|key| ChosenAid::usual(key)).collect(),
            ..NavigatorSettings::default()
        },
        landmarks: vec![Landmark::new(1, "barn", bounds)],
        state_names: Vec::new(),
        steps,
    }
}

fn refused(refusals: &[Refusal]) -> StepReport {
    step(Some(frame(0, None, refusals)), Vec::new())
}

fn missing(name: &str) -> StepReport {
    let trouble = format!("{name}: the file is missing");
    step(Some(frame(0, Some(&trouble), &[])), Vec::new())
}

#[test]
fn the_reason_of_most_pictures_is_told_once_for_each_whatever_they_are_called() {
    let steps = vec![
        refused(&[Refusal::LowScore; 4]),
        missing("a7.jpg"),
        missing("b8.jpg"),
        step(None, Vec::new()),
    ];
    let told = unused_pictures(&run(&[], steps)).unwrap();
    let expected = "None of its 3 pictures corrected the estimate, which rests on the instruments alone. Most often, in \
                    2 of them: a7.jpg: the file is missing.";
    assert_eq!(told, expected);
    let one = unused_pictures(&run(&[], vec![refused(&[Refusal::LowScore])])).unwrap();
    assert!(
        one.starts_with("Its one picture did not correct the estimate"),
        "{one}"
    );
    assert!(
        one.ends_with("alone. Why: the best score is too low."),
        "{one}"
    );
    let unseen = unused_pictures(&run(&[], vec![refused(&[]), refused(&[]), missing("c")]));
    let unseen = unseen.unwrap();
    assert!(
        unseen.contains("in 2 of them: no landmark was in view"),
        "{unseen}"
    );
}

#[test]
fn nothing_is_told_where_a_picture_was_used_by_whatever_aid_or_nothing_was_looked_for() {
    let mut corrected = frame(0, None, &[]);
    corrected.joint = Some(JointReport {
        nis: 1.0,
        degrees_of_freedom: 4,
        threshold: 18.0,
        gain: DMatrix::zeros(2, 4),
        innovation: DVector::zeros(4),
        innovation_covariance: DMatrix::identity(4, 4),
        recovered: None,
    });
    let corrected = step(Some(corrected), Vec::new());
    let lost = refused(&[Refusal::LowScore]);
    assert_eq!(
        unused_pictures(&run(&[], vec![lost.clone(), corrected])),
        None
    );
    // An aid that sees counts whether or not it keeps what it saw; one that does not see never does.
    for (aid, is_used) in [
        ("map-edges", true),
        ("roads", true),
        ("barometric-height", false),
    ] {
        let by_aid = step(Some(frame(1, None, &[])), vec![update(aid, true)]);
        let told = unused_pictures(&run(&[aid], vec![lost.clone(), by_aid]));
        assert_eq!(told.is_none(), is_used, "{aid}");
        let refused = step(Some(frame(1, None, &[])), vec![update(aid, false)]);
        assert!(unused_pictures(&run(&[aid], vec![lost.clone(), refused])).is_some());
    }
    let mut blind = run(&["barometric-height"], vec![lost.clone(), missing("a")]);
    blind.landmarks[0].enabled = false;
    assert_eq!(unused_pictures(&blind), None);
    let mut open = frame(0, None, &[]);
    open.laid = Some(RegistrationReport {
        place: None,
        refusal: Some("two places".to_owned()),
        refused_as: Some(RegistrationRefusal::Open),
        laid_by: pilotage_vision::registration::RegistrationMethod::default(),
        tried: 0,
        log_false_alarms: 0.0,
        probability: None,
    });
    let open = step(Some(open), Vec::new());
    assert_eq!(unused_pictures(&run(&[], vec![lost, open])), None);
}
