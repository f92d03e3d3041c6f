//! Routes: which, its legs and totals, the wind, the limit, and what is predicted.

use std::f64::consts::TAU;

use egui::{Align, Layout, TextEdit, Ui, UiBuilder};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Route, WayPoint, WayPointAction};

use super::PlanCommand;
use super::actions::ends;
use super::aircraft::{aircraft, energy_left, tight_legs};
use super::button::button;
use super::flown::{flight_wind, pictures_words, way_back};
use super::legs::{legs, time_text, totals};
use super::pattern_card::pattern_card;
use super::patterns::Pattern;
use super::planner::{Planner, by_name, made_for};
use super::purpose::Purpose;
use super::relief::ground;
use super::verdict::LandmarkVerdict;
use super::way_points::{Sums, way_points};
use super::words::{PredictionFigures, distance_text};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{
    NumberField, at_right, caption, heading, icon_button, icon_toggle, icons::Icon, muted,
};
use crate::units::{Units, direction};
use pilotage_core::plan::{MOST_CIRCLES, circles_at, cruise};
use pilotage_jobs::FlightSource;

/// Least width of the name of a route beside its buttons, points.
const LEAST_NAME: f32 = 130.0;

/// Draws the tab.
pub fn route_tab(
    ui: &mut Ui,
    planner: &mut Planner,
    documents: &Documents,
    context: &mut ViewContext<'_>,
) {
    let tokens = context.tokens;
    let Some(route) = documents.mission.selected_route() else {
        nothing(ui, planner, documents, context);
        return;
    };
    chooser(ui, planner, route, context);
    ui.add_space(tokens.space);
    if let Some(pattern) = Pattern::of(route) {
        let made_for = made_for(planner, documents, Some(route));
        pattern_card(ui, route, &pattern, &made_for, cruise(), context);
        ui.add_space(tokens.space);
    }
    let id = egui::Id::unique("plan prediction");
    ui.scope_builder(UiBuilder::new().scope_id(id), |ui| {
        prediction(ui, planner, documents, route, context);
    });
    ui.add_space(tokens.space);
    let id = egui::Id::unique("plan rehearsal");
    ui.scope_builder(UiBuilder::new().scope_id(id), |ui| {
        planner.rehearsal_card(ui, context);
    });
    ui.add_space(tokens.space);
    let air = planner.wind(documents);
    let flies = (cruise(), planner.preferences.bank);
    let legs = legs(route, way_back(route, documents), flies, &air);
    let (length, time) = totals(&legs);
    ui.horizontal(|ui| {
        caption(ui, tokens, "Legs");
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let total = format!(
                "{} · {} in the wind",
                distance_text(length, context.units),
                time_text(time)
            );
            ui.label(egui::RichText::new(total).color(tokens.text));
        });
    });
    let left = energy_left(&legs, &planner.preferences);
    let tight = tight_legs(route, planner.preferences.bank);
    let relief = documents.relief();
    let sums = Sums {
        relief,
        legs: &legs,
        left,
        tight,
    };
    way_points(ui, planner, route, &sums, context);
    ends(ui, route, context);
    ui.add_space(tokens.space);
    let id = egui::Id::unique("plan wind");
    ui.scope_builder(UiBuilder::new().scope_id(id), |ui| {
        ground(ui, &relief, route, context);
        ui.add_space(tokens.space);
        wind(ui, planner, documents, context);
        ui.add_space(tokens.space);
        aircraft(ui, &planner.preferences, context);
    });
}

fn nothing(ui: &mut Ui, planner: &Planner, documents: &Documents, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    ui.add_space(tokens.space);
    if planner.drawing {
        heading(ui, tokens, "Draw a route");
        ui.label(muted(
            tokens,
            tokens.advice(
                "Click on the map where it begins, then where it goes on. Enter or a double click ends it. \
                 Or press I for a way-point in the middle of the map.",
                "Tap the map where it begins, then where it goes on. A double tap ends it.",
            ),
        ));
        return;
    }
    heading(ui, tokens, "No route yet");
    ui.label(muted(
        tokens,
        "A route is drawn by clicking its way-points on the map. While you draw you see how well the \
         aircraft will know its place along it.",
    ));
    ui.add_space(tokens.space);
    let built_in = matches!(documents.flight.source, FlightSource::Simulated(_));
    ui.horizontal_wrapped(|ui| {
        button(
            ui,
            context,
            Some(Icon::Plus),
            "Draw a route",
            true,
            PlanCommand::ToggleDraw,
        );
        if built_in {
            let take = PlanCommand::TakeFlightRoute;
            button(
                ui,
                context,
                None,
                "Plan the route of this flight",
                false,
                take,
            );
        }
        let survey = PlanCommand::Mark(Purpose::Survey);
        button(ui, context, None, "Survey an area", false, survey);
    });
}

fn chooser(ui: &mut Ui, planner: &mut Planner, route: &Route, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let mut say = Vec::new();
    if context.mission.routes.len() > 1 {
        ui.horizontal_wrapped(|ui| {
            for other in &context.mission.routes {
                let on = other.id == route.id;
                let label = ui.selectable_label(on, &other.name);
                if label.clicked() {
                    say.push(PlanCommand::SelectRoute(other.id));
                }
            }
        });
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let draft = match &mut planner.name_draft {
            Some((of, text)) if *of == route.id => text,
            other => &mut other.insert((route.id, route.name.clone())).1,
        };
        // The name has a row of its own where it would have no room beside the five buttons.
        let beside = ui.available_width() - 5.0 * tokens.target() - 40.0;
        let is_beside = beside >= LEAST_NAME;
        let width = if is_beside {
            beside
        } else {
            ui.available_width() - 2.0 * tokens.space
        };
        let field = ui
            .add(
                TextEdit::singleline(draft)
                    .align(egui::Align2::LEFT_CENTER)
                    .desired_width(width),
            )
            .accessible_name("Name of the route");
        if field.lost_focus() {
            let name = draft.trim().to_owned();
            if !name.is_empty() {
                context.say_first(PlanCommand::RenameRoute { id: route.id, name });
            }
            planner.name_draft = None;
        } else if !field.has_focus() {
            planner.name_draft = None;
        }
        if is_beside {
            ui.add_space(8.0);
        } else {
            ui.end_row();
        }
        let draw = if planner.drawing {
            "Finish the route"
        } else {
            "Draw another route"
        };
        if icon_toggle(ui, tokens, Icon::Path, draw, planner.drawing).clicked() {
            say.push(PlanCommand::ToggleDraw);
        }
        let more = icon_button(ui, tokens, Icon::More, "Patterns");
        egui::Popup::menu(&more).show(|ui| {
            ui.set_min_width(220.0);
            let released = Pattern::of(route).is_some();
            for (label, command, enabled) in [
                ("Survey an area", PlanCommand::Mark(Purpose::Survey), true),
                (
                    "Corridor along this route",
                    PlanCommand::CorridorAlong.of(route.id),
                    true,
                ),
                (
                    "Edit the pattern's way-points",
                    PlanCommand::ReleasePattern.of(route.id),
                    released,
                ),
            ] {
                if ui.add_enabled(enabled, egui::Button::new(label)).clicked() {
                    say.push(command);
                    ui.close();
                }
            }
        });
        for (icon, label, command) in [
            (Icon::Reverse, "Fly it the other way", PlanCommand::Reverse),
            (
                Icon::Duplicate,
                "Duplicate the route",
                PlanCommand::DuplicateRoute,
            ),
            (Icon::Trash, "Delete the route", PlanCommand::DeleteRoute),
        ] {
            if icon_button(ui, tokens, icon, label).clicked() {
                say.push(command.of(route.id));
            }
        }
    });
    context.commands.extend(say.into_iter().map(Command::from));
}

fn prediction(
    ui: &mut Ui,
    planner: &Planner,
    documents: &Documents,
    route: &Route,
    context: &mut ViewContext<'_>,
) {
    let tokens = context.tokens;
    for sentence in planner.no_fly_sentences(context.units) {
        ui.label(egui::RichText::new(sentence).color(tokens.no_fly));
    }
    ui.horizontal(|ui| {
        caption(ui, tokens, "Predicted accuracy");
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let mut limit = planner.preferences.limit;
            let field = NumberField::new(1.0..=5000.0).unit(context.units.length());
            let field = field.speed(0.25).show(ui, &mut limit);
            if field.accessible_name("Limit (1σ)").changed() {
                let limit = PlanCommand::SetLimit(limit);
                context.commands.push(Command::from(limit));
            }
            ui.label(muted(tokens, "limit (1σ)"));
        });
    });
    let Some(shown) = planner.forecast.shown() else {
        let words = planner.forecast.trouble().map_or_else(
            || "It is predicted as soon as the route has two way-points.".to_owned(),
            |why| format!("It cannot be predicted: {why}."),
        );
        ui.label(muted(tokens, words));
        return;
    };
    if let Some(outlook) = PredictionFigures::of(&shown.prediction) {
        let limit = planner.preferences.limit;
        let landmarks = by_name(&shown.order, &documents.mission);
        for (index, sentence) in outlook
            .sentences(limit, &landmarks, context.units)
            .into_iter()
            .enumerate()
        {
            let bad = index == 2 && outlook.stretches > 0;
            let color = if bad { tokens.warning } else { tokens.text };
            ui.label(egui::RichText::new(sentence).color(color));
        }
        planner.remedies_card(ui, context);
    }
    if let Some(sentence) = stopped(planner) {
        ui.label(egui::RichText::new(sentence).color(tokens.warning));
    }
    if let Some(sentence) = misled(planner, documents) {
        ui.label(egui::RichText::new(sentence).color(tokens.warning));
    }
    for sentence in assumptions(planner, documents, route, context.units) {
        ui.label(muted(tokens, sentence));
    }
}

/// Wind that is planned with, in words.
pub fn wind_words(planner: &Planner, documents: &Documents, units: Units) -> String {
    let Some(wind) = planner.known_wind(documents) else {
        return "Calm: nobody stated a wind, and no flight tells one.".to_owned();
    };
    let (factor, unit) = units.speed();
    format!(
        "Wind from {:0>3}° with {:.1} {unit}.",
        direction(wind.from, 0),
        wind.speed * factor
    )
}

/// Assumptions of the prediction, in words.
pub fn assumptions(
    planner: &Planner,
    documents: &Documents,
    route: &Route,
    units: Units,
) -> Vec<String> {
    let used: Vec<_> = documents
        .mission
        .landmarks
        .iter()
        .filter(|l| l.enabled)
        .cloned()
        .collect();
    let measured = planner.assessments.count(&used);
    let too_large = used.iter().filter(|l| planner.assessments.is_misfit(l));
    let mut list = vec![tested_words(
        measured,
        too_large.count(),
        used.len(),
        &planner.untested.words(),
    )];
    list.push(pictures_words(documents));
    let climbs = route
        .way_points
        .windows(2)
        .any(|p| p[0].altitude != p[1].altitude);
    if climbs {
        list.push("Between way-points of different heights it climbs or sinks evenly.".to_owned());
    }
    let bank = planner.preferences.bank;
    let flown = |w: &WayPoint| circles_at(w, bank).map(|(_, turns)| turns);
    if route.way_points.iter().skip(1).any(|w| flown(w).is_some()) {
        let words = "Circles and waiting are predicted as circles around the way-point, as tight as the \
                     bank limit lets them be.";
        list.push(words.to_owned());
    }
    if route
        .way_points
        .iter()
        .filter_map(flown)
        .any(|turns| turns > MOST_CIRCLES)
    {
        list.push(format!(
            "Of more than {MOST_CIRCLES} circles {MOST_CIRCLES} are predicted."
        ));
    }
    if route
        .way_points
        .iter()
        .any(|w| matches!(w.action, WayPointAction::Wait { seconds: None, .. }))
    {
        list.push("Waiting without an end is predicted as flying by.".to_owned());
    }
    if way_back(route, documents).is_some() {
        list.push("It returns at the altitude of the last way-point.".to_owned());
    }
    list.extend(documents.relief().assumptions(route, units));
    list
}

/// Landmarks for which something else is often taken, which no prediction counts.
pub fn misled(planner: &Planner, documents: &Documents) -> Option<String> {
    let misleads = |landmark: &&Landmark| {
        let measured = planner.assessments.of(landmark);
        measured.is_some_and(|it| LandmarkVerdict::misleads(&it.last))
    };
    let used = documents.mission.landmarks.iter().filter(|it| it.enabled);
    let names = used.filter(misleads).map(|it| it.name.as_str());
    let names: Vec<&str> = names.collect();
    (!names.is_empty()).then(|| {
        format!(
            "Something else is often taken for {}. Only right matches are predicted: switch it off, or draw it elsewhere.",
            names.join(", ")
        )
    })
}

/// Warning where the wind lets no flight come to the end of the route.
pub fn stopped(planner: &Planner) -> Option<&'static str> {
    let shown = planner.forecast.shown();
    shown
        .filter(|it| it.order.is_stopped(&it.prediction))
        .map(|_| {
            "The wind is too strong to get to the end: what is predicted is of the part that is flown."
        })
}

fn wind(ui: &mut Ui, planner: &Planner, documents: &Documents, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let own = planner.preferences.wind.is_some();
    let of_flight = flight_wind(documents).is_some();
    let mut wind = planner.wind(documents);
    ui.horizontal(|ui| {
        caption(ui, tokens, "Wind");
        at_right(
            ui,
            |_| {},
            |ui| {
                let mut from = wind.from.rem_euclid(TAU);
                let back = if of_flight {
                    "Use the flight's wind"
                } else {
                    "No wind"
                };
                if !own {
                    let words = if of_flight {
                        "as on the flight, from"
                    } else {
                        "calm unless set, from"
                    };
                    ui.label(muted(tokens, words));
                } else if icon_button(ui, tokens, Icon::Undo, back).clicked() {
                    let command = PlanCommand::SetWind(None);
                    context.commands.push(Command::from(command));
                }
                let field = NumberField::new(0.0..=TAU).degrees().show(ui, &mut from);
                let is_turned = field.accessible_name("Wind from").changed();
                if is_turned {
                    wind.from = from;
                }
                let field = NumberField::new(0.0..=60.0).unit(context.units.speed());
                let field = field.speed(0.1).decimals(1).show(ui, &mut wind.speed);
                if field.accessible_name("Wind speed").changed() || is_turned {
                    let wind = PlanCommand::SetWind(Some(wind));
                    context.commands.push(Command::from(wind));
                }
            },
        );
    });
}

/// Number of the landmarks in use that are tested and of those that are too large for a picture, and what one that is
/// neither counts like, in words.
fn tested_words(tested: usize, too_large: usize, used: usize, like: &str) -> String {
    let rest = match used.saturating_sub(tested + too_large) {
        0 => String::new(),
        1 if used > 1 => format!(" The other one counts like {like}."),
        _ if tested + too_large > 0 => format!(" Each of the others counts like {like}."),
        1 => format!(" It counts like {like}."),
        _ => format!(" Each counts like {like}."),
    };
    let are_tested = match (tested, used) {
        (_, 0) => return "No landmark is switched on.".to_owned(),
        (0, 1) if too_large == 1 => {
            return "The landmark in use does not fit into a picture from this height: it counts as never found."
                .to_owned();
        }
        (0, 1) => "The landmark in use is not tested".to_owned(),
        (0, all) => format!("None of {all} landmarks is tested"),
        (1, 1) => "The landmark in use is tested".to_owned(),
        (2, 2) => "Both landmarks in use are tested".to_owned(),
        (some, all) if some >= all => format!("All {all} landmarks in use are tested"),
        (1, all) => format!("1 of {all} landmarks is tested"),
        (some, all) => format!("{some} of {all} landmarks are tested"),
    };
    let misfits = match too_large {
        0 => String::new(),
        1 => {
            " 1 does not fit into a picture from this height and counts as never found.".to_owned()
        }
        some => {
            format!(" {some} do not fit into a picture from this height and count as never found.")
        }
    };
    format!("{are_tested}.{misfits}{rest}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::documents::Session;
    use pilotage_core::simulate::Wind;

    #[test]
    fn tested_landmarks_are_counted_as_people_say_it() {
        let told = |tested, used| tested_words(tested, 0, used, "a box");
        assert_eq!(
            told(0, 1),
            "The landmark in use is not tested. It counts like a box."
        );
        assert_eq!(
            told(0, 3),
            "None of 3 landmarks is tested. Each counts like a box."
        );
        assert_eq!(
            told(1, 2),
            "1 of 2 landmarks is tested. The other one counts like a box."
        );
        assert_eq!(
            told(2, 5),
            "2 of 5 landmarks are tested. Each of the others counts like a box."
        );
        assert_eq!(told(2, 2), "Both landmarks in use are tested.");
        assert_eq!(told(9, 9), "All 9 landmarks in use are tested.");
        let told = |tested, too_large, used| tested_words(tested, too_large, used, "a box");
        assert_eq!(
            told(0, 1, 1),
            "The landmark in use does not fit into a picture from this height: it counts as never found."
        );
        assert_eq!(
            told(0, 1, 5),
            "None of 5 landmarks is tested. 1 does not fit into a picture from this height and counts as never \
             found. Each of the others counts like a box."
        );
        assert_eq!(
            told(2, 2, 5),
            "2 of 5 landmarks are tested. 2 do not fit into a picture from this height and count as never found. \
             The other one counts like a box."
        );
        assert_eq!(
            told(2, 1, 3),
            "2 of 3 landmarks are tested. 1 does not fit into a picture from this height and counts as never found."
        );
    }

    #[test]
    fn calm_is_the_wind_of_no_flight() {
        let mut documents = Documents::new(&Session::demo());
        let mut planner = Planner::default();
        let told = |planner: &Planner, documents: &Documents| {
            wind_words(planner, documents, Units::Metric)
        };
        let flown = told(&planner, &documents);
        assert!(flown.starts_with("Wind from "), "{flown}");
        documents.flight.source = FlightSource::Files("log".to_owned());
        assert_eq!(
            told(&planner, &documents),
            "Calm: nobody stated a wind, and no flight tells one."
        );
        assert_eq!(planner.wind(&documents), Wind::default());
        planner.preferences.wind = Some(Wind {
            speed: 8.0,
            from: std::f64::consts::FRAC_PI_2,
        });
        assert_eq!(told(&planner, &documents), "Wind from 090° with 8.0 m/s.");
    }
}
