//! Findings of a run on pictures that its aids did not look at.

use super::{AidInfo, Run};
use pilotage_base::text::by_count;
use pilotage_flight::{Finding, Flight, Severity};

/// Findings on pictures of `flight` that aids of its `run` did not look at, such as roads from too high up: once for each aid and
/// reason, however many pictures.
pub fn passed_over(flight: &Flight, run: &Run) -> Vec<Finding> {
    let aids = run.settings.aids.iter();
    let aids = aids.filter_map(|aid| AidInfo::named(&aid.key).ok());
    aids.filter(|aid| aid.sees())
        .flat_map(|aid| of_aid(aid, flight, run))
        .collect()
}

/// Pictures that an aid passed over for a reason.
struct PassedOver {
    why: &'static str,
    count: usize,
    /// Times of the first and the last of them, seconds.
    span: (f64, f64),
}

fn of_aid(aid: &AidInfo, flight: &Flight, run: &Run) -> Vec<Finding> {
    let mut all: Vec<PassedOver> = Vec::new();
    let mut pictures = 0;
    for step in &run.steps {
        let Some(frame) = step.frame.as_ref().filter(|f| f.trouble.is_none()) else {
            continue;
        };
        pictures += 1;
        let camera = flight.camera_of_frame(frame.index);
        let reason = (aid.passes_over)(&camera, &frame.assumed_pose, flight.ground_down);
        let Some(why) = reason else { continue };
        match all.iter_mut().find(|known| known.why == why) {
            Some(known) => (known.count, known.span.1) = (known.count + 1, step.time),
            None => all.push(PassedOver {
                why,
                count: 1,
                span: (step.time, step.time),
            }),
        }
    }
    let of = by_count(pictures, "picture", "pictures");
    let finding = |PassedOver { why, count, span }| Finding {
        severity: Severity::Warning,
        title: format!("{}: {count} of {pictures} {of} not looked at", aid.label),
        text: format!("The aid passed them over: {why}. The estimate goes on without it there."),
        span: Some(span),
    };
    all.into_iter().map(finding).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::super::flight_for_tests::flight_of;
    use super::super::step_for_tests::step_at;
    use super::super::{FrameReport, StepReport};
    use super::*;
    use pilotage_base::frames::{Attitude, Pose};
    use pilotage_mission::settings::{ChosenAid, NavigatorSettings};

    #[test]
    fn pictures_from_too_high_up_are_told_once_for_each_aid_that_passes_them_over() {
        let flight = flight_of(Vec::new());
        let step = |number: u32, height: f64| StepReport {
            frame: Some(FrameReport {
                index: 0,
                assumed_pose: Pose {
                    position_in_world: Point3::new(0.0, 0.0, -height),
                    attitude: Attitude::default(),
                },
                footprint: Vec::new(),
                candidates: Vec::new(),
                joint: None,
                laid: None,
                trouble: (height == 0.0).then(|| "it is missing".to_owned()),
            }),
            ..step_at(f64::from(number))
        };
        // A pixel shows 1.2 m of ground from 1.2 focal lengths.
        let focal = flight.camera.focal;
        let heights = [0.5, 1.1, 1.3, 200.0, 0.0].map(|share| share * focal);
        let run = |aids: &[&str]| Run {
            name: "a run".to_owned(),
            settings: NavigatorSettings {
                aids: aids.iter().map(|key| ChosenAid::usual(key)).collect(),
                ..NavigatorSettings::default()
            },
            landmarks: Vec::new(),
            state_names: Vec::new(),
            steps: (1..).zip(heights).map(|(k, h)| step(k, h)).collect(),
        };
        let told = |aids: &[&str]| {
            let found = passed_over(&flight, &run(aids));
            let words = found.iter().map(|it| (it.title.clone(), it.span));
            words.collect::<Vec<_>>()
        };
        let roads = "Roads: 2 of 4 pictures not looked at".to_owned();
        let landmarks = "Generic landmarks: 1 of 4 pictures not looked at".to_owned();
        assert_eq!(
            told(&["roads", "generic-landmarks", "gps-position"]),
            [(roads, Some((3.0, 4.0))), (landmarks, Some((4.0, 4.0)))]
        );
        assert_eq!(told(&["gps-position"]), []);
    }
}
