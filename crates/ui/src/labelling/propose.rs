//! Expected box of a landmark in a picture, by the pose from which the picture was taken.

use nalgebra::Point3;
use pilotage_core::flight::FrameTruth;
use pilotage_core::frames::Pose;
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::LabelBox;
use pilotage_core::navigator::StepReport;

use crate::context::ViewContext;

/// Least share of a landmark that is in the picture if it is proposed: of less than half nobody knows it again.
const LEAST_IN_PICTURE: f64 = 0.5;

/// The box around a landmark's map box as the frame's pose sees it: the true pose where it is known,
/// else the one that the navigator assumed. `None` if no pose is known or too little is in the picture.
pub(super) fn proposed(
    context: &ViewContext<'_>,
    frame: usize,
    landmark: &Landmark,
) -> Option<LabelBox> {
    let flight = context.flight?;
    let truth = flight.truth.as_ref().and_then(|t| t.frames.get(frame));
    let pose = truth
        .and_then(FrameTruth::pose)
        .or_else(|| assumed(&context.run?.steps, flight.frames.get(frame)?.time, frame))?;
    let camera = flight.camera_of_frame(frame);
    let bounds = landmark.bounds;
    let corners = [
        (bounds.north, bounds.west),
        (bounds.north, bounds.east),
        (bounds.south, bounds.east),
        (bounds.south, bounds.west),
    ];
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (north, east) in corners {
        let pixel = camera.project(&pose, &Point3::new(north, east, flight.ground_down))?;
        for (axis, value) in [pixel.x, pixel.y].into_iter().enumerate() {
            low[axis] = low[axis].min(value);
            high[axis] = high[axis].max(value);
        }
    }
    let size = (camera.width as u32, camera.height as u32);
    let label = LabelBox::new(landmark.id, &landmark.name, [low, high], size);
    label.filter(|label| is_mostly_seen(label, [low, high]))
}

/// Whether most of what lies between these corners is in the picture, as the label is.
fn is_mostly_seen(label: &LabelBox, [low, high]: [[f64; 2]; 2]) -> bool {
    area(label.min, label.max) >= LEAST_IN_PICTURE * area(low, high)
}

/// Area of a box, pixels squared.
fn area(low: [f64; 2], high: [f64; 2]) -> f64 {
    (high[0] - low[0]) * (high[1] - low[1])
}

/// Pose that the navigator assumed of the frame of that index, taken at `time`, seconds: steps and their frames are in the
/// order of time, so that it is found from there.
fn assumed(steps: &[StepReport], time: f64, frame: usize) -> Option<Pose> {
    let (before, after) = steps.split_at(steps.partition_point(|step| step.time < time));
    let reports = |step: &StepReport| step.frame.as_ref().map(|it| (it.index, it.assumed_pose));
    let mut behind = after.iter().filter_map(reports);
    let mut ahead = before.iter().rev().filter_map(reports);
    let found = behind.find(|(index, _)| *index >= frame);
    let found = found.filter(|(index, _)| *index == frame);
    let found = found.or_else(|| ahead.find(|(index, _)| *index <= frame));
    let found = found.filter(|(index, _)| *index == frame);
    found.map(|(_, pose)| pose)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::fixture::Fixture;

    #[test]
    fn the_pose_of_a_frame_is_found_from_its_time_however_late_it_was_used() {
        let fixture = Fixture::lasting(20.0);
        let steps = &fixture.run.steps;
        let used: Vec<_> = steps.iter().filter_map(|it| it.frame.as_ref()).collect();
        assert!(used.len() > 5);
        for late in [-1.3, 0.0, 0.7] {
            for report in &used {
                let time = fixture.flight.frames[report.index].time + late;
                let pose = assumed(steps, time, report.index);
                assert_eq!(pose, Some(report.assumed_pose), "{late}");
            }
        }
        assert_eq!(assumed(steps, 3.0, 100_000), None);
        assert_eq!(assumed(&[], 3.0, 1), None);
    }

    #[test]
    fn of_a_landmark_most_of_which_is_outside_no_sliver_is_proposed() {
        let is_proposed = |east: f64| {
            let corners = [[east, 100.0], [east + 80.0, 160.0]];
            let label = LabelBox::new(1, "Barn", corners, (640, 480));
            label.is_some_and(|label| is_mostly_seen(&label, corners))
        };
        assert!(is_proposed(300.0));
        assert!(is_proposed(640.0 - 41.0));
        assert!(!is_proposed(640.0 - 39.0));
        assert!(!is_proposed(-60.0));
    }
}
