use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use pilotage_core::training::evaluation::{
    EvaluatedLook, EvaluatedMark, Evaluation, EvaluationSettings,
};

use super::*;

/// Six days of a detector whose right marks score about 0.8 and whose wrong ones about 0.2.
fn evaluation() -> EvaluationReport {
    let mut state = 5_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let looks: Vec<_> = (0..360)
        .map(|i| {
            let mut mark = |middle: f64, metres: f64, right| EvaluatedMark {
                score: middle + 0.35 * (random() + random() - 1.0),
                offset: [metres * (random() - 0.5), metres * (random() - 0.5)],
                right,
                rotation: 0.0,
                log_scale: 0.0,
            };
            EvaluatedLook {
                day: i / 60,
                height: 60.0 + (i * 7 % 120) as f64,
                tilt: (i * 3 % 40) as f64 / 100.0,
                heading_error: (i * 11 % 20) as f64 / 100.0 - 0.1,
                log_scale: 0.0,
                real: false,
                present: i % 6 != 0,
                marks: vec![mark(0.8, 2.0, true), mark(0.2, 40.0, false)],
            }
        })
        .collect();
    let settings = EvaluationSettings {
        replicates: 200,
        ..EvaluationSettings::default()
    };
    let evaluation = Evaluation::of(&looks, &settings).unwrap();
    EvaluationReport::of((3, "Pool 1/2"), &looks, 0.5, &evaluation)
}

struct State {
    evaluation: Option<EvaluationReport>,
    view: EvaluationView,
    file: Option<EvaluationFile>,
}

fn harness(evaluation: Option<EvaluationReport>, size: [f32; 2]) -> Harness<'static, State> {
    let state = State {
        evaluation,
        view: EvaluationView::default(),
        file: None,
    };
    Harness::builder().with_size(size).build_ui_state(
        |ui, state| {
            let scene = EvaluationScene {
                report: state.evaluation.as_ref(),
                tokens: &Tokens::dark(),
            };
            if let Some(file) = state.view.show(ui, &scene) {
                state.file = Some(file);
            }
        },
        state,
    )
}

#[test]
fn four_plots_stand_beside_the_figures() {
    let mut harness = harness(Some(evaluation()), [900.0, 640.0]);
    harness.run();
    for title in [
        "Detections against false alarms: found",
        "Precision against recall: right",
        "Detections by height above ground at 0.01 false alarms per picture: found",
        "Probabilities on days left out: right",
    ] {
        harness.get_by_label_contains(title);
    }
    harness.get_by_label_contains("average precision");
    harness.get_by_label_contains("on days left out 6");
}

#[test]
fn another_circumstance_is_shown_when_it_is_chosen() {
    let mut harness = harness(Some(evaluation()), [900.0, 640.0]);
    harness.run();
    harness.get_by_label("Day").click();
    harness.run();
    harness.get_by_label_contains("day, 6 points");
    // All are renders: there is nothing to compare them with.
    assert!(harness.query_by_label("Source").is_none());
}

#[test]
fn the_table_and_a_picture_are_given_to_be_saved() {
    let mut harness = harness(Some(evaluation()), [900.0, 640.0]);
    harness.run();
    harness.get_by_label("Save CSV").click();
    harness.run();
    let file = harness.state_mut().file.take().unwrap();
    assert_eq!(file.name, "Pool-1-2.evaluation.csv");
    assert!(file.text.starts_with("curve,x,y,low,high,threshold\n"));
    let save = "Save \"Precision against recall\" as SVG";
    harness.get_by_label(save).click();
    harness.run();
    let file = harness.state_mut().file.take().unwrap();
    assert_eq!(file.name, "Pool-1-2.precision_recall.svg");
    assert!(file.text.starts_with("<svg"));
}

#[test]
fn a_narrow_view_stacks_its_plots_and_an_empty_one_says_what_to_do() {
    let mut narrow = harness(Some(evaluation()), [360.0, 1000.0]);
    narrow.run();
    let top = |label: &str| narrow.get_by_label_contains(label).rect().top();
    assert!(top("Precision against recall: ") > top("Detections against false alarms: ") + 150.0);
    let mut empty = harness(None, [360.0, 300.0]);
    empty.run();
    empty.get_by_label_contains("Not evaluated yet");
}

#[test]
fn the_view_can_be_written_for_people_to_look_at() {
    let Some(folder) = crate::views::canvas::folder() else {
        return;
    };
    let evaluation = evaluation();
    for (name, tokens, size) in [
        ("evaluation-dark", Tokens::dark(), egui::vec2(900.0, 640.0)),
        (
            "evaluation-light",
            Tokens::light(),
            egui::vec2(640.0, 600.0),
        ),
        (
            "evaluation-narrow",
            Tokens::dark(),
            egui::vec2(360.0, 1000.0),
        ),
    ] {
        let mut view = EvaluationView::default();
        let picture = crate::views::canvas::picture(
            size,
            |context| crate::shell::apply_theme(context, &tokens),
            |ui| {
                egui::Frame::new()
                    .fill(tokens.surface)
                    .inner_margin(8.0)
                    .show(ui, |ui| {
                        let scene = EvaluationScene {
                            report: Some(&evaluation),
                            tokens: &tokens,
                        };
                        view.show(ui, &scene);
                    });
            },
        );
        picture.save(folder.join(format!("{name}.png"))).unwrap();
    }
}
