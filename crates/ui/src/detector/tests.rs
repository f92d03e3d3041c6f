use egui::Key;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::imagery::{Imagery, Window};
use pilotage_core::landmark::Landmark;
use pilotage_core::landmark::cascade::{
    Cascade, CascadeFeature, HaarFeature, NodeSplit, TrainedStage, TrainedTree,
};
use pilotage_core::landmark::trained::{
    DetectorWindow, Likelihood, MarkPrecision, TrainedDetector, Variants,
};
use pilotage_core::navigator::explain_cascade;
use pilotage_core::raster::{Raster, Rgba, decode_picture};

use super::*;
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::canvas;
use crate::views::fixture::Fixture;

/// The map of the fixture's landmarks: bright blocks.
struct Blocks(Vec<GroundRect>);

impl Imagery for Blocks {
    fn name(&self) -> &'static str {
        "blocks"
    }
    fn bounds(&self) -> GroundRect {
        GroundRect::centered(GroundPoint::default(), 2000.0, 2000.0)
    }
    fn native_gsd(&self) -> f64 {
        0.5
    }
    fn window(&self, window: &Window) -> Raster<Rgba> {
        Raster::from_fn(window.width, window.height, |x, y| {
            let place = window.ground_at(x as f64 + 0.5, y as f64 + 0.5);
            let inside = self.0.iter().any(|block| block.contains(&place));
            let grey = if inside { 140 } else { 110 };
            [grey, grey, grey, 255]
        })
    }
}

/// Kind of features that the stages of a made-up detector look at.
#[derive(Clone, Copy)]
enum Look {
    Edges,
    Patterns,
    Rectangles,
}

/// Three stages of two, three and four features; a block of the fixture passes those that look for edges.
fn detector(bounds: GroundRect, look: Look) -> TrainedDetector {
    let feature = |number: i32| match look {
        Look::Edges => CascadeFeature::Hog {
            cell: [0, 4 + 2 * (number % 4), 5, 5],
            component: 8,
        },
        Look::Patterns => CascadeFeature::Lbp([number, 2, 6, 6]),
        Look::Rectangles => CascadeFeature::Haar(HaarFeature {
            areas: [
                ([6 + number, 2, 8, 6], -1.0),
                ([6 + number, 2, 4, 6], 2.0),
                ([0; 4], 0.0),
            ],
            tilted: number % 2 == 1,
        }),
    };
    let split = match look {
        Look::Edges => NodeSplit::Threshold(0.12),
        Look::Patterns => NodeSplit::Codes([0x5555_3333; 8]),
        Look::Rectangles => NodeSplit::Threshold(0.02),
    };
    let stage = |votes: usize| TrainedStage {
        trees: (0..votes)
            .map(|tree| TrainedTree::stump(tree, split, -0.6, 0.9))
            .collect(),
        threshold: 0.1,
    };
    let features = (0..4).map(feature).collect();
    let stages = [stage(2), stage(3), stage(4)];
    TrainedDetector {
        cascade: Cascade::from_parts(24, 24, features, &stages).unwrap(),
        window: DetectorWindow {
            gsd: 1.25,
            width: 24,
            height: 24,
            variants: Variants::default(),
        },
        bounds,
        least_score: 0.4,
        likelihood: Likelihood {
            offset: -2.0,
            slope: 1.5,
        },
        precision: MarkPrecision::even(1.0),
        template: None,
    }
}

struct State {
    fixture: Fixture,
    view: DetectorView,
    search: Option<DetectorSearch>,
    /// Generation of the run that the search is of.
    run: u64,
    time: f64,
    commands: Vec<Command>,
    units: Units,
}

impl State {
    /// Every landmark has a detector.
    fn new(look: Look) -> Self {
        let mut fixture = Fixture::lasting(20.0);
        for landmark in &mut fixture.mission.landmarks {
            let trained = detector(landmark.bounds, look);
            landmark.keep_trained(Some(&trained));
        }
        Self {
            fixture,
            view: DetectorView::default(),
            search: None,
            run: 1,
            time: 9.0,
            commands: Vec::new(),
            units: Units::Metric,
        }
    }

    /// Search of the core that the view wants.
    fn looked(&self, (time, landmark): (f64, u32)) -> DetectorSearch {
        let fixture = &self.fixture;
        let step = fixture.run.step_at(time).unwrap();
        let bytes = fixture.picture(step.frame.as_ref().unwrap().index).unwrap();
        let picture = decode_picture(&bytes).unwrap();
        let marked = fixture.mission.landmark(landmark).unwrap();
        let blocks = fixture.mission.landmarks.iter().map(|l| l.bounds).collect();
        let settings = &fixture.mission.navigator;
        let map = Blocks(blocks);
        let found = explain_cascade(&fixture.flight, &map, settings, marked, step, &picture);
        DetectorSearch {
            time,
            landmark,
            found: found
                .unwrap()
                .map_err(|refusal| refusal.reason().to_owned()),
        }
    }

    /// Draws the view and does what it asks of itself, as the app would.
    fn draw(&mut self, ui: &mut Ui, tokens: &Tokens, selection: Option<u32>) {
        let mut commands = Vec::new();
        let mut context = ViewContext {
            selection,
            tokens,
            units: self.units,
            ..self.fixture.context(self.time, &mut commands)
        };
        let search = self.search.as_ref().map(|search| {
            let of = ExplainedStep {
                run: self.run,
                time: search.time,
                landmark: search.landmark,
            };
            (of, search)
        });
        self.view.show(ui, &mut context, search);
        for command in &commands {
            let Command::Feature(command) = command else {
                continue;
            };
            if let Some(command) = command.action() {
                self.view.act(command);
            }
        }
        self.commands.extend(commands);
    }
}

fn harness(state: State) -> Harness<'static, State> {
    let draw = |ui: &mut Ui, state: &mut State| state.draw(ui, &Tokens::dark(), None);
    let size = [360.0, 1400.0];
    Harness::builder()
        .with_size(size)
        .build_ui_state(draw, state)
}

/// The view over a search that has arrived.
fn looked(look: Look) -> Harness<'static, State> {
    let mut harness = harness(State::new(look));
    harness.run();
    let wanted = harness.state().view.wanted().expect("a landmark in view");
    let search = harness.state().looked(wanted);
    assert!(search.found.is_ok(), "{:?}", search.found);
    harness.state_mut().search = Some(search);
    harness.run();
    harness
}

fn evidence(harness: &Harness<'static, State>) -> CascadeEvidence {
    let search = harness.state().search.as_ref().unwrap();
    search.found.clone().unwrap()
}

#[test]
fn a_landmark_without_a_detector_says_what_to_do_and_asks_for_nothing() {
    let mut state = State::new(Look::Edges);
    for landmark in &mut state.fixture.mission.landmarks {
        landmark.keep_trained(None);
    }
    let mut harness = harness(state);
    harness.run();
    harness.get_by_label_contains("No detector was trained for");
    harness.get_by_label_contains("train a detector for it");
    assert_eq!(harness.state().view.wanted(), None);
    assert!(harness.state().commands.is_empty());
}

#[test]
fn the_search_is_asked_for_and_another_one_is_not_shown() {
    let mut harness = harness(State::new(Look::Edges));
    harness.run();
    harness.get_by_label("Looking …");
    let (time, landmark) = harness.state().view.wanted().unwrap();
    let ask = DetectorCommand::Explain { time, landmark };
    assert!(harness.state().commands.contains(&Command::from(ask)));
    let mut other = harness.state().looked((time, landmark));
    other.time -= 1.0;
    harness.state_mut().search = Some(other);
    harness.run();
    harness.get_by_label("Looking …");
}

#[test]
fn the_pictures_of_the_run_before_are_not_shown_beside_the_numbers_of_the_run_of_now() {
    let mut harness = looked(Look::Edges);
    let shown = |harness: &Harness<'static, State>| {
        let textures = harness.state().view.textures.as_ref().unwrap();
        let rejected = textures.rejected.as_ref().map(|(_, texture)| texture.id());
        [textures.ground.id(), textures.score.id(), rejected.unwrap()]
    };
    let before = shown(&harness);
    harness.run();
    assert_eq!(shown(&harness), before, "once for each search");
    // The flight is flown again: the same step and the same landmark.
    harness.state_mut().run = 2;
    harness.run();
    let after = shown(&harness);
    for (before, after) in before.into_iter().zip(after) {
        assert_ne!(before, after);
    }
}

#[test]
fn stages_are_stepped_through_and_the_counts_are_those_of_the_search() {
    let mut harness = looked(Look::Edges);
    let told = evidence(&harness);
    assert_eq!(told.all_votes(), 9);
    assert!(told.left_after(3) > 0 && told.left_after(3) < told.windows);
    harness.get_by_label_contains("all 9 everywhere would take");
    assert_eq!(harness.state().view.passed(), (3, 3), "all at first");
    harness.get_by_label("One stage back (,)").click();
    harness.run();
    assert_eq!(harness.state().view.passed(), (2, 3));
    harness.get_by_label(&words::left(&told, 2));
    let row = format!("Show {}", words::left(&told, 1));
    harness.get_by_label(&row).click();
    harness.run();
    assert_eq!(harness.state().view.passed(), (1, 3));
    harness.get_by_label("feature 1 of 2");
    let slider = "Stages that have rejected their windows";
    harness.get_by_label(slider).focus();
    harness.run();
    harness.key_press(Key::ArrowRight);
    harness.run();
    assert_eq!(harness.state().view.passed(), (2, 3));
    harness.get_by_label("feature 1 of 3");
}

#[test]
fn stages_pass_by_themselves_until_the_last() {
    let mut harness = looked(Look::Edges);
    harness.state_mut().view.act(&DetectorCommand::Play);
    harness.step();
    let (first, all) = harness.state().view.passed();
    assert_eq!((first, all), (0, 3), "from the beginning");
    let mut seen = vec![first];
    for _ in 0..200 {
        harness.step();
        seen.push(harness.state().view.passed().0);
    }
    seen.dedup();
    assert_eq!(seen, [0, 1, 2, 3]);
    harness.get_by_label("Let the stages pass (Shift Z)");
}

#[test]
fn features_of_every_kind_are_stepped_through_with_what_they_answer() {
    let kinds = [
        (Look::Edges, "as a share of all in its block"),
        (Look::Patterns, "of 256; votes"),
        (Look::Rectangles, "amber counts up, blue down"),
    ];
    for (look, words) in kinds {
        let mut harness = looked(look);
        harness.get_by_label("feature 1 of 4");
        let told = harness.query_all_by_label_contains(words).count();
        assert!(told > 0, "{words}");
        harness.get_by_label("Next feature").click();
        harness.run();
        harness.get_by_label("feature 2 of 4");
        harness.get_by_label("Previous feature").click();
        harness.run();
        harness.get_by_label("Previous feature").click();
        harness.run();
        harness.get_by_label("feature 4 of 4");
        harness.get_by_label("The landmark on the map").click();
        harness.run();
        let chip = harness.get_by_label("The landmark on the map");
        assert!(chip.accesskit_node().toggled().is_some());
    }
}

#[test]
fn the_selected_landmark_is_shown_even_without_a_detector() {
    let mut state = State::new(Look::Edges);
    let step = state.fixture.run.frame_step_at(9.0).unwrap();
    let seen: Vec<u32> = (step.frame.iter())
        .flat_map(|f| f.candidates.iter().map(|c| c.landmark))
        .collect();
    let id = *seen.first().expect("a landmark in view");
    let marked = state.fixture.mission.landmarks.iter_mut();
    for landmark in marked.filter(|l: &&mut Landmark| l.id == id) {
        landmark.keep_trained(None);
    }
    let draw = move |ui: &mut Ui, state: &mut State| state.draw(ui, &Tokens::dark(), Some(id));
    let mut harness = Harness::builder()
        .with_size([360.0, 900.0])
        .build_ui_state(draw, state);
    harness.run();
    harness.get_by_label_contains("No detector was trained for");
}

#[test]
fn the_view_can_be_looked_at() {
    let Some(folder) = canvas::folder() else {
        println!("skipped: PILOTAGE_PICTURES names no folder");
        return;
    };
    for (name, look) in [
        ("edges", Look::Edges),
        ("patterns", Look::Patterns),
        ("rectangles", Look::Rectangles),
    ] {
        for (theme, tokens) in [("dark", Tokens::dark()), ("light", Tokens::light())] {
            let mut state = State::new(look);
            let picture = canvas::picture(
                egui::vec2(360.0, 1160.0),
                |context| crate::shell::apply_theme(context, &tokens),
                |ui| {
                    let frame = egui::Frame::new().fill(tokens.surface).inner_margin(8.0);
                    egui::CentralPanel::default().frame(frame).show(ui, |ui| {
                        state.draw(ui, &tokens, None);
                    });
                    if let Some(wanted) = state.view.wanted().filter(|_| state.search.is_none()) {
                        state.search = Some(state.looked(wanted));
                    }
                },
            );
            let path = folder.join(format!("detector-{name}-{theme}.png"));
            picture.save(path).unwrap();
        }
    }
}

#[test]
fn lengths_are_told_in_the_units_of_the_page() {
    let mut harness = looked(Look::Edges);
    let count = |harness: &Harness<'static, State>, unit: &str| {
        let words = format!(" {unit} north and ");
        harness.query_all_by_label_contains(&words).count()
    };
    let in_metres = count(&harness, "m");
    assert!(in_metres > 0);
    harness.state_mut().units = Units::Aviation;
    harness.run();
    assert_eq!(
        (count(&harness, "m"), count(&harness, "ft")),
        (0, in_metres)
    );
}
