//! The workers on which trainings go on, and the restart of a training whose worker dies.

use super::*;
use crate::{DescribeMapOrder, TileOrder};

fn train(left: Option<crate::TrainingLeft>) -> Job {
    use pilotage_core::frames::{GroundPoint, GroundRect};
    let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 20.0, 20.0);
    Job::Train(Box::new(crate::TrainOrder {
        map: MapSource::world("countryside"),
        landmark: pilotage_core::landmark::Landmark::new(1, "barn", bounds),
        camera: pilotage_core::camera::CameraModel::pinhole(640, 480, 1.0),
        height: 120.0,
        sensors: pilotage_core::navigator::NavigatorSettings::default().sensors,
        ground_down: 0.0,
        plan: pilotage_core::training::TrainingPlan::default(),
        look_alikes_within: 0.0,
        labelled: None,
        left,
    }))
}

#[test]
fn trainings_go_on_side_by_side_and_one_that_is_held_makes_room() {
    let (mut worker_pool, notes) = worker_pool();
    let (first, second) = (
        worker_pool.start(train(None)),
        worker_pool.start(train(None)),
    );
    assert_eq!(
        sent_to(&notes, WHOLE_FLIES),
        [Request::Start(first, train(None))]
    );
    assert_eq!(
        sent_to(&notes, WHOLE_SHOWS),
        [Request::Start(second, train(None))]
    );
    worker_pool.hold(second, true);
    let third = worker_pool.start(train(None));
    let expected = [
        Request::Start(second, train(None)),
        Request::Hold(second, true),
        Request::Start(third, train(None)),
    ];
    assert_eq!(sent_to(&notes, WHOLE_SHOWS), expected);
    assert!(
        sent_to(&notes, WHOLE_ANSWERS).is_empty(),
        "questions are answered at once"
    );
}

#[test]
fn a_training_does_not_wait_behind_a_flight_because_tiles_are_drawn_elsewhere() {
    use pilotage_core::frames::{GroundPoint, GroundRect};
    let (mut worker_pool, notes) = worker_pool();
    worker_pool.start(fly());
    let area = GroundRect::centered(GroundPoint::new(0.0, 0.0), 50.0, 50.0);
    let window = pilotage_core::imagery::Window::covering(&area, 1.0);
    let map = MapSource::world("countryside");
    worker_pool.start(Job::DescribeMap(DescribeMapOrder(map.clone())));
    for _ in 0..4 {
        let map = map.clone();
        worker_pool.start(Job::Tile(TileOrder { map, window }));
    }
    let training = worker_pool.start(train(None));
    assert_eq!(
        sent_to(&notes, WHOLE_SHOWS)[0],
        Request::Start(training, train(None))
    );
    assert!(sent_to(&notes, WHOLE_FLIES).is_empty());
}

#[test]
fn a_training_whose_worker_dies_goes_on_behind_its_last_whole_stage_and_stays_held() {
    use crate::{TrainingLeft, TrainingReport};
    let (mut worker_pool, notes) = worker_pool();
    let id = worker_pool.start(train(None));
    let left = TrainingLeft {
        progress: vec![4, 5, 6],
        stages: Vec::new(),
        seconds: 12.0,
    };
    let report = |left| {
        let report = TrainingReport {
            fraction: 0.5,
            phase: pilotage_core::training::TrainingPhase::Mining,
            stages: Vec::new(),
            growing: None,
            seconds: 13.0,
            left,
        };
        Reply::Event(id, JobEvent::Training(Box::new(report)))
    };
    worker_pool.receive(WHOLE_FLIES, report(Some(left.clone())));
    worker_pool.receive(WHOLE_FLIES, report(None));
    worker_pool.hold(id, true);
    worker_pool.worker_died(WHOLE_FLIES);
    let again = [
        Request::Start(id, train(Some(left))),
        Request::Hold(id, true),
    ];
    let all = sent_to(&notes, WHOLE_FLIES);
    assert_eq!(all[all.len() - 2..], again);
}
