//! Pictures of the views over the fixture, for people to look at.
//!
//! `PILOTAGE_PICTURES=folder cargo test -p pilotage-ui views::pictures` writes them.

use egui::{CentralPanel, Frame, Ui, vec2};

use super::fixture::Fixture;
use super::{CameraView, InspectorView, MatchView, PlotsView, Tour, canvas};
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::units::Units;

/// Draws one view over the fixture at `time` and writes it as PNG.
fn write(
    name: &str,
    size: [f32; 2],
    tokens: &Tokens,
    time: f64,
    selection: Option<u32>,
    mut draw: impl FnMut(&mut Ui, &mut ViewContext<'_>),
) {
    let Some(folder) = canvas::folder() else {
        println!("skipped: PILOTAGE_PICTURES names no folder");
        return;
    };
    let fixture = Fixture::new();
    let mut ghost = fixture.run.clone();
    for step in &mut ghost.steps {
        step.after.mean[0] += 3.0 * (step.time * 0.2).sin();
        step.after.mean[1] += 2.0;
    }
    let frame_time = fixture.run.frame_step_at(time).map_or(time, |s| s.time);
    let landmark = selection.unwrap_or(1);
    let matched = fixture.match_pictures(frame_time, landmark);
    let picture = canvas::picture(
        vec2(size[0], size[1]),
        |context| {
            crate::shell::apply_theme(context, tokens);
        },
        |ui| {
            let frame = Frame::new().fill(tokens.surface).inner_margin(8.0);
            CentralPanel::default().frame(frame).show(ui, |ui| {
                let mut commands = Vec::new();
                let mut context = ViewContext {
                    mission: &fixture.mission,
                    flight: Some(&fixture.flight),
                    run: Some(&fixture.run),
                    ghost: Some(&ghost),
                    time,
                    playing: false,
                    selection,
                    pictures: &|index| fixture.picture(index),
                    match_pictures: Some(&matched),
                    tokens,
                    units: Units::Metric,
                    commands: &mut commands,
                };
                draw(ui, &mut context);
            });
        },
    );
    let path = folder.join(format!("{name}.png"));
    picture.save(&path).expect("the folder can be written to");
}

fn both<View: Default>(
    name: &str,
    size: [f32; 2],
    time: f64,
    selection: Option<u32>,
    show: fn(&mut View, &mut Ui, &mut ViewContext<'_>),
) {
    for (theme, tokens) in [("dark", Tokens::dark()), ("light", Tokens::light())] {
        let mut view = View::default();
        write(
            &format!("{name}-{theme}"),
            size,
            &tokens,
            time,
            selection,
            |ui, context| {
                show(&mut view, ui, context);
            },
        );
    }
}

#[test]
fn the_camera_view_can_be_looked_at() {
    both("camera", [420.0, 320.0], 15.5, Some(2), CameraView::show);
}

#[test]
fn the_match_view_can_be_looked_at() {
    both("match", [360.0, 480.0], 12.5, Some(1), MatchView::show);
}

#[test]
fn the_plots_can_be_looked_at() {
    both("plots", [480.0, 460.0], 40.0, None, PlotsView::show);
}

#[test]
fn the_plots_can_be_looked_at_below_the_map() {
    both("plots-wide", [1064.0, 176.0], 40.0, None, PlotsView::show);
}

#[test]
fn the_inspector_can_be_looked_at() {
    both(
        "inspector",
        [340.0, 1180.0],
        15.5,
        None,
        InspectorView::show,
    );
}

#[test]
fn every_stop_of_the_tour_can_be_looked_at() {
    for stop in 0..Tour::STOPS {
        let mut tour = Tour::default();
        tour.go_to(stop);
        let name = format!("tour-{:02}", stop + 1);
        write(
            &name,
            [352.0, 440.0],
            &Tokens::dark(),
            40.0,
            None,
            |ui, context| {
                tour.show(ui, context);
            },
        );
    }
}
