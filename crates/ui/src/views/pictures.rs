//! Pictures of the views over two flights, for people to look at.
//!
//! `PILOTAGE_PICTURES=folder cargo test -p pilotage-ui views::pictures` writes them.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use egui::{CentralPanel, Frame, Ui, vec2};
use pilotage_core::flight::{Flight, FrameSource as _};
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{KnownGround, Navigator, Run, StepReport, explain};
use pilotage_core::raster::decode_picture;
use pilotage_core::simulate::{Overrides, Scenario};

use super::fixture::{Fixture, match_pictures};
use super::{CameraView, ExplainedStep, InspectorView, MatchView, PlotsView, canvas, picking};
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::units::Units;
use pilotage_jobs::MatchPictures;

/// The encoded picture of a frame.
type FramePicture = dyn Fn(usize) -> Option<Arc<[u8]>>;
/// Function that explains the match of a landmark in a step.
type ExplainMatch = dyn Fn(&StepReport, u32) -> Option<MatchPictures>;

/// Documents that the views are drawn over.
pub(crate) struct ViewDocuments {
    mission: Mission,
    flight: Flight,
    run: Run,
    ghost: Option<Run>,
    pictures: Box<FramePicture>,
    matched: Box<ExplainMatch>,
}

impl ViewDocuments {
    /// The synthetic flight.
    pub(crate) fn synthetic() -> Self {
        let fixture = Fixture::new();
        let mut ghost = fixture.run.clone();
        for step in &mut ghost.steps {
            step.after.mean[0] += 3.0 * (step.time * 0.2).sin();
            step.after.mean[1] += 2.0;
        }
        Self {
            mission: fixture.mission.clone(),
            flight: fixture.flight.clone(),
            run: fixture.run.clone(),
            ghost: Some(ghost),
            pictures: Box::new(move |index| fixture.picture(index)),
            matched: Box::new(|step, id| Some(match_pictures(step.time, id))),
        }
    }

    /// A built-in scenario through the navigator itself.
    pub(crate) fn flown(name: &str) -> Self {
        let scenario = Scenario::named(name).expect("the scenario is built in");
        let simulated = scenario.simulate(1, &Overrides::default());
        let mission = scenario.mission();
        let map: Arc<dyn Imagery> = Arc::new(Scenario::map());
        let flight = Arc::new(simulated.flight.clone());
        let settings = mission.navigator.clone();
        let mut navigator = Navigator::new(
            Arc::clone(&flight),
            &KnownGround::of(&mission, Arc::clone(&map)),
            &settings,
        )
        .expect("the scenario can be navigated");
        let mut frames = simulated.frames;
        let mut run = navigator.run_head();
        while let Some(step) = navigator.advance(&mut frames, &|| 0.0) {
            run.steps.push(step.expect("the filter stays sound"));
        }
        let frames = Rc::new(RefCell::new((frames, HashMap::<usize, Arc<[u8]>>::new())));
        let same = Rc::clone(&frames);
        let landmarks = mission.landmarks.clone();
        Self {
            pictures: Box::new(move |index| {
                let (frames, known) = &mut *frames.borrow_mut();
                if let Some(bytes) = known.get(&index) {
                    return Some(Arc::clone(bytes));
                }
                let bytes: Arc<[u8]> = frames.encoded(index).ok()?.into();
                known.insert(index, Arc::clone(&bytes));
                Some(bytes)
            }),
            matched: Box::new(move |step, id| {
                let picture = same
                    .borrow_mut()
                    .0
                    .picture(step.frame.as_ref()?.index)
                    .ok()?;
                let landmark = landmarks.iter().find(|l| l.id == id)?;
                let evidence = explain(
                    &flight,
                    Arc::clone(&map),
                    &settings,
                    landmark,
                    step,
                    &picture,
                )?
                .ok()?;
                let mut peaks = evidence.peaks.into_iter();
                Some(MatchPictures {
                    time: step.time,
                    landmark: id,
                    patch: evidence.patch,
                    rectified: evidence.rectified,
                    surface: evidence.surface,
                    peak: peaks.next(),
                    second: peaks.next(),
                    gsd: evidence.gsd,
                })
            }),
            mission,
            flight: simulated.flight,
            run,
            ghost: None,
        }
    }

    /// Draws one view at `time` and writes it as PNG.
    pub(crate) fn write(
        &self,
        name: &str,
        size: [f32; 2],
        tokens: &Tokens,
        time: f64,
        selection: Option<u32>,
        mut draw: impl FnMut(&mut Ui, &mut ViewContext<'_>),
    ) {
        let Some(folder) = canvas::folder() else {
            return;
        };
        let picture = canvas::picture(
            vec2(size[0], size[1]),
            |context| crate::shell::apply_theme(context, tokens),
            |ui| {
                let frame = Frame::new().fill(tokens.surface).inner_margin(8.0);
                CentralPanel::default().frame(frame).show(ui, |ui| {
                    let mut commands = Vec::new();
                    let mut context = ViewContext {
                        mission: &self.mission,
                        flight: Some(&self.flight),
                        run: Some(&self.run),
                        ghost: self.ghost.as_ref(),
                        time,
                        is_recorded: false,
                        clock_zero: 0.0,
                        motion: 0.0,
                        selected_span: None,
                        playing: false,
                        selection,
                        route: None,
                        pictures: &|index| Some(index),
                        tokens,
                        units: Units::Metric,
                        flying: None,
                        commands: &mut commands,
                    };
                    draw(ui, &mut context);
                });
            },
        );
        let path = folder.join(format!("{name}.png"));
        picture.save(&path).expect("the folder can be written to");
    }

    /// Draws one view in both themes.
    fn both<View: Default>(
        &self,
        name: &str,
        size: [f32; 2],
        time: f64,
        selection: Option<u32>,
        show: impl Fn(&mut View, &mut Ui, &mut ViewContext<'_>),
    ) {
        for (theme, tokens) in [("dark", Tokens::dark()), ("light", Tokens::light())] {
            let mut view = View::default();
            let name = format!("{name}-{theme}");
            self.write(&name, size, &tokens, time, selection, |ui, context| {
                show(&mut view, ui, context);
            });
        }
    }

    /// Draws the camera view; what has to be decoded for it is there a frame later.
    fn show_decoded(&self, view: &mut CameraView, ui: &mut Ui, context: &mut ViewContext<'_>) {
        view.show(ui, context);
        if let Some((frame, key)) = view.wanted() {
            let encoded = (self.pictures)(key).expect("the flight has the picture");
            let picture = decode_picture(&encoded).expect("the fixture's pictures are whole");
            let opaque = |[r, g, b]: &[u8; 3]| [*r, *g, *b, u8::MAX];
            let pixels: Vec<u8> = picture.pixels().iter().flat_map(opaque).collect();
            view.prepare(frame, key, picture.width(), &pixels);
        }
    }

    /// Draws every view, the camera, match and inspector at `time`.
    fn write_all(&self, name: &str, time: f64) {
        let named = |view: &str| format!("{name}-{view}");
        self.both(
            &named("camera"),
            [420.0, 320.0],
            time,
            None,
            |view, ui, context| {
                self.show_decoded(view, ui, context);
            },
        );
        let matched = self.run.frame_step_at(time).and_then(|step| {
            let candidate = picking::candidate_to_explain(step.frame.as_ref()?, None)?;
            (self.matched)(step, candidate.landmark)
        });
        self.both(
            &named("match"),
            [360.0, 480.0],
            time,
            None,
            |view: &mut MatchView, ui, context| {
                let of = |matched: &MatchPictures| ExplainedStep {
                    run: 0,
                    time: matched.time,
                    landmark: matched.landmark,
                };
                let found = matched.as_ref().map(|it| (of(it), Ok(it.clone())));
                view.show(ui, context, found.as_ref().map(|(of, it)| (*of, it)));
            },
        );
        self.both(&named("plots"), [480.0, 460.0], time, None, PlotsView::show);
        self.both(
            &named("plots-wide"),
            [1064.0, 176.0],
            time,
            None,
            PlotsView::show,
        );
        self.both(
            &named("inspector"),
            [340.0, 1180.0],
            time,
            None,
            InspectorView::show,
        );
    }
}

#[test]
fn the_views_over_a_synthetic_flight_can_be_looked_at() {
    if canvas::folder().is_none() {
        println!("skipped: PILOTAGE_PICTURES names no folder");
        return;
    }
    ViewDocuments::synthetic().write_all("synthetic", 15.5);
}

#[test]
fn the_views_over_a_built_in_scenario_can_be_looked_at() {
    if canvas::folder().is_none() {
        println!("skipped: PILOTAGE_PICTURES names no folder");
        return;
    }
    ViewDocuments::flown("distinct-400ft-wind").write_all("flown", 15.5);
}
