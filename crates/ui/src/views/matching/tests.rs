use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use pilotage_core::raster::Gray;
use pilotage_core::registration::FollowSettings;

use super::super::fixture::match_pictures;
use super::super::shown::{Shown, shown};
use super::*;

/// The view, and the pictures that it is given with what they are of.
type WithPictures = (
    MatchView,
    Option<(ExplainedStep, Result<MatchPictures, String>)>,
);

fn harness(time: f64) -> Harness<'static, Shown<WithPictures>> {
    let draw = |(view, given): &mut WithPictures, ui: &mut Ui, context: &mut ViewContext<'_>| {
        let pictures = given.as_ref().map(|(of, pictures)| (*of, pictures));
        view.show(ui, context, pictures);
    };
    shown([420.0, 560.0], time, draw)
}

/// Pictures of a run of that generation, as the view is given them.
fn of_run(run: u64, pictures: MatchPictures) -> (ExplainedStep, Result<MatchPictures, String>) {
    let (time, landmark) = (pictures.time, pictures.landmark);
    let of = ExplainedStep {
        run,
        time,
        landmark,
    };
    (of, Ok(pictures))
}

#[test]
fn the_numbers_stand_before_the_pictures_arrive_and_the_pictures_are_asked_for() {
    let mut harness = harness(12.0);
    harness.run();
    harness.get_by_label_contains("Score");
    harness.get_by_label("The pictures of this match are on their way");
    let (time, landmark) = harness.state().view.0.wanted().unwrap();
    assert!(
        harness
            .state()
            .commands
            .contains(&MatchCommand { time, landmark }.into())
    );
}

#[test]
fn pictures_of_another_match_are_not_shown() {
    let mut harness = harness(12.0);
    harness.run();
    let (time, landmark) = harness.state().view.0.wanted().unwrap();
    let other = match_pictures(time - 1.0, landmark);
    harness.state_mut().view.1 = Some(of_run(1, other));
    harness.run();
    harness.get_by_label("The pictures of this match are on their way");
    let right = match_pictures(time, landmark);
    harness.state_mut().view.1 = Some(of_run(1, right));
    harness.run();
    harness.get_by_label("Map patch, rectified picture, and score at every place");
}

#[test]
fn the_pictures_of_the_run_before_are_not_shown_for_the_match_of_now() {
    let mut harness = harness(12.0);
    harness.run();
    let (time, landmark) = harness.state().view.0.wanted().unwrap();
    harness.state_mut().view.1 = Some(of_run(1, match_pictures(time, landmark)));
    harness.run();
    let shown =
        |harness: &Harness<'static, Shown<WithPictures>>| harness.state().view.0.textures.ids();
    let before = shown(&harness);
    assert_eq!(before.len(), 3);
    harness.run();
    assert_eq!(shown(&harness), before, "once for each match");
    // The landmark was made larger, and the flight flown again.
    harness.state_mut().view.1 = Some(of_run(2, match_pictures(time, landmark)));
    harness.run();
    for (before, after) in before.into_iter().zip(shown(&harness)) {
        assert_ne!(before, after);
    }
}

#[test]
fn captions_of_pictures_keep_apart_however_narrow_a_picture_is() {
    for patch in [4, 9, 20] {
        let mut harness = harness(12.0);
        harness.run();
        let (time, landmark) = harness.state().view.0.wanted().unwrap();
        let mut pictures = match_pictures(time, landmark);
        pictures.patch = Gray::from_fn(patch, 30, |_, _| 100.0);
        harness.state_mut().view.1 = Some(of_run(1, pictures));
        harness.run();
        let shapes = harness.output().shapes.iter();
        let texts = shapes.filter_map(|drawn| match &drawn.shape {
            egui::Shape::Text(text) => {
                let rect = text.galley.rect.translate(text.pos.to_vec2());
                Some((text.galley.text(), rect.intersect(drawn.clip_rect)))
            }
            _ => None,
        });
        let captions = ["Map", "Camera", "Score"];
        let is_caption = |text: &str| captions.iter().any(|it| text.starts_with(it));
        let shown: Vec<_> = texts.filter(|(text, _)| is_caption(text)).collect();
        // The last is the name of the number below.
        for pair in shown[..3].windows(2) {
            assert!(
                pair[0].1.right() + 4.0 <= pair[1].1.left(),
                "{patch}: {pair:?}"
            );
        }
    }
}

#[test]
fn between_landmarks_the_last_one_stays_with_its_age() {
    let mut harness = harness(12.0);
    harness.run();
    let (seen, landmark) = harness.state().view.0.wanted().unwrap();
    for step in &mut harness.state_mut().fixture.run.steps {
        if step.time > seen
            && let Some(frame) = &mut step.frame
        {
            frame.candidates.clear();
        }
    }
    harness.state_mut().time = seen + 4.0;
    harness.run();
    harness.get_by_label_contains("the last one looked for, 4.0 s ago");
    assert_eq!(harness.state().view.0.wanted(), Some((seen, landmark)));
}

#[test]
fn before_the_first_landmark_it_says_when_one_comes() {
    let mut harness = harness(0.6);
    for step in &mut harness.state_mut().fixture.run.steps {
        if step.time < 2.0
            && let Some(frame) = &mut step.frame
        {
            frame.candidates.clear();
        }
    }
    harness.run();
    harness.get_by_label("No landmark looked for yet");
    harness.get_by_label("Go to the next landmark looked for");
}

#[test]
fn the_next_landmark_never_comes_in_no_time() {
    assert_eq!(super::coming(0.02), "The next comes now: go there");
    assert_eq!(super::coming(0.06), "The next comes in 0.1 s: go there");
}

#[test]
fn where_no_landmark_is_known_it_says_what_to_do_and_where_whole_pictures_are_laid_where_to_look() {
    let mut harness = harness(3.0);
    let run = &mut harness.state_mut().fixture.run;
    run.landmarks.clear();
    for frame in run.steps.iter_mut().filter_map(|step| step.frame.as_mut()) {
        frame.candidates.clear();
    }
    harness.run();
    harness.get_by_label("This flight knows no landmark");
    harness.state_mut().fixture.run.settings.whole_frames = Some(FollowSettings::default());
    harness.run();
    harness.get_by_label("Whole pictures are laid on the map");
}
