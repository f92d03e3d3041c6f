//! The ground: where a fix would be had, and finding a route over it, between no-fly areas and rally points.

use egui::{Align, Layout, Slider, Ui};
use pilotage_core::frames::AltitudeFrame;
use pilotage_core::plan::{Aim, BudgetOf};

use super::PlanCommand;
use super::button::button;
use super::compared::RouteFigures;
use super::find_command::{FindCommand, FindPick};
use super::find_tool::hint;
use super::heat::BLIND;
use super::heat_command::HeatCommand;
use super::legs::time_text;
use super::no_fly_card::no_fly_card;
use super::planner::Planner;
use super::rally_card::rally_card;
use super::way_points::altitude_words;
use super::words::distance_text;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{NumberField, caption, icon_button, icons::Icon, muted};
use crate::units::{Units, with_minus};
use pilotage_jobs::{FixesFrom, Foreseen};

/// Stretches near no-fly areas that are told of a found route; all are told of it once it is a route of the mission.
const MOST_REACHED: usize = 3;

/// Draws the tab.
pub fn ground_tab(
    ui: &mut Ui,
    planner: &mut Planner,
    documents: &Documents,
    context: &mut ViewContext<'_>,
) {
    let space = context.tokens.space;
    heat(ui, planner, context);
    ui.add_space(2.0 * space);
    no_fly_card(ui, planner, context);
    ui.add_space(2.0 * space);
    find(ui, planner, documents, context);
    ui.add_space(2.0 * space);
    rally_card(ui, planner, context);
}

fn say_heat(context: &mut ViewContext<'_>, command: HeatCommand) {
    let command = Command::from(PlanCommand::Heat(command));
    context.commands.push(command);
}

fn say(context: &mut ViewContext<'_>, command: FindCommand) {
    let command = Command::from(PlanCommand::Find(command));
    context.commands.push(command);
}

/// A label at the left and something at the right of one line.
fn row(ui: &mut Ui, label: &str, add: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.label(label);
        ui.with_layout(Layout::right_to_left(Align::Center), add);
    });
}

fn heat(ui: &mut Ui, planner: &Planner, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let mut heat = planner.preferences.heat;
    caption(ui, tokens, "Where landmarks can be recognised");
    ui.horizontal(|ui| {
        ui.checkbox(&mut heat.shown, "Heat map");
        ui.add_enabled_ui(heat.shown, |ui| {
            ui.checkbox(&mut heat.blind, "Blind areas only");
        });
    });
    row(ui, "Fixes from", |ui| {
        // Right to left.
        ui.selectable_value(&mut heat.of, FixesFrom::Map, "the map alone");
        ui.selectable_value(&mut heat.of, FixesFrom::Landmarks, "landmarks");
    });
    row(ui, "Position error before it (1σ)", |ui| {
        let field = NumberField::new(0.0..=1000.0).unit(context.units.length());
        let field = field.speed(0.5).show(ui, &mut heat.position);
        field.accessible_name("Uncertainty of the position");
    });
    row(ui, "Opacity", |ui| {
        let slider = Slider::new(&mut heat.opacity, 0.1..=1.0).show_value(false);
        ui.add(slider).accessible_name("Opacity of the heat map");
    });
    if heat != planner.preferences.heat {
        say_heat(context, HeatCommand::Set(heat));
    }
    if !heat.shown {
        let words = tokens.advice(
            "Shows on the map how likely the camera finds its place there. Press H.",
            "Shows on the map how likely the camera finds its place there.",
        );
        ui.label(muted(tokens, words));
        return;
    }
    heat_state(ui, planner, context);
}

fn heat_state(ui: &mut Ui, planner: &Planner, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    if let Some((share, words)) = planner.heat.under_way() {
        ui.horizontal(|ui| {
            if icon_button(ui, tokens, Icon::Close, "Stop the heat map").clicked() {
                say_heat(context, HeatCommand::Stop);
            }
            ui.vertical(|ui| {
                let bar = egui::ProgressBar::new(share).desired_height(4.0);
                ui.add(bar).accessible_name("How far the heat map is");
                ui.add(egui::Label::new(muted(tokens, words)).truncate());
            });
        });
        return;
    }
    if let Some(why) = planner.heat.trouble() {
        let text = format!("It cannot be computed: {why}");
        ui.label(egui::RichText::new(text).color(tokens.warning));
        return;
    }
    if planner.heat.is_stopped() {
        ui.horizontal(|ui| {
            ui.label(muted(tokens, "Stopped; what is known stays."));
            let resume = PlanCommand::Heat(HeatCommand::Resume);
            button(ui, context, None, "Compute all of it", false, resume);
        });
        return;
    }
    let (factor, unit) = context.units.length();
    let share = planner.heat.field().and_then(|f| f.blind_share(BLIND));
    if let Some((share, order)) = share.zip(planner.heat.order()) {
        ui.label(muted(
            tokens,
            format!(
                "A fix is less likely than {BLIND:.1} over {:.0} % of the map, from {:.0} {unit} above ground.",
                100.0 * share,
                order.view.height * factor
            ),
        ));
    }
}

fn find(ui: &mut Ui, planner: &Planner, documents: &Documents, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let finder = &planner.finder;
    caption(ui, tokens, "Find a route");
    ui.horizontal(|ui| {
        for (pick, end, name) in [
            (FindPick::From, finder.from, "start A"),
            (FindPick::To, finder.to, "end B"),
        ] {
            let label = match (finder.pick == pick, end) {
                (true, _) => format!("Click {name} …"),
                (false, Some(_)) => format!("Move {name}"),
                (false, None) => format!("Choose {name}"),
            };
            let command = PlanCommand::Find(FindCommand::Pick(pick));
            button(ui, context, None, &label, false, command);
        }
        if let Some(straight) = finder.from.zip(finder.to).map(|(a, b)| a.distance(&b)) {
            let text = format!("{} apart", distance_text(straight, context.units));
            ui.label(muted(tokens, text));
        }
    });
    if let Some(words) = hint(finder.pick, tokens) {
        ui.label(egui::RichText::new(words).color(tokens.accent));
    }
    wishes(ui, planner, documents, context);
    if let Some((share, words)) = finder.under_way() {
        ui.horizontal(|ui| {
            if icon_button(ui, tokens, Icon::Close, "Stop searching").clicked() {
                say(context, FindCommand::Stop);
            }
            ui.vertical(|ui| {
                let bar = egui::ProgressBar::new(share).desired_height(4.0);
                ui.add(bar).accessible_name("How far the search is");
                ui.label(muted(tokens, words));
            });
        });
    } else {
        let ready = finder.from.is_some() && finder.to.is_some();
        ui.add_enabled_ui(ready, |ui| {
            let strong = finder.found.is_none();
            let start = PlanCommand::Find(FindCommand::Start);
            button(ui, context, None, "Find the route", strong, start);
        });
    }
    if let Some(why) = &finder.trouble {
        let text = egui::RichText::new(format!("No route: {why}"));
        ui.label(text.color(tokens.warning));
    }
    comparison(ui, planner, context);
}

/// A length at the right of one line.
fn length(
    ui: &mut Ui,
    label: &str,
    name: &str,
    metres: &mut f64,
    most: f64,
    context: &ViewContext<'_>,
) {
    row(ui, label, |ui| {
        let field = NumberField::new(0.0..=most).unit(context.units.length());
        let field = field.speed(0.5).show(ui, metres);
        field.accessible_name(name);
    });
}

fn wishes(ui: &mut Ui, planner: &Planner, documents: &Documents, context: &mut ViewContext<'_>) {
    let mut wanted = planner.preferences.find;
    row(ui, "Use", |ui| {
        ui.selectable_value(&mut wanted.over, FixesFrom::Map, "any good place");
        ui.selectable_value(&mut wanted.over, FixesFrom::Landmarks, "my landmarks");
    });
    row(ui, "Minimise", |ui| {
        ui.selectable_value(&mut wanted.aim, Aim::Mean, "the mean");
        ui.selectable_value(&mut wanted.aim, Aim::Worst, "the worst uncertainty");
    });
    row(ui, "Detour up to", |ui| {
        ui.selectable_value(&mut wanted.budget_of, BudgetOf::Length, "length");
        ui.selectable_value(&mut wanted.budget_of, BudgetOf::Time, "time");
        let mut percent = 100.0 * (wanted.budget - 1.0);
        let field = NumberField::new(0.0..=400.0).speed(0.5);
        let field = field.prefix("+").suffix(" %").show(ui, &mut percent);
        let field = field.accessible_name("Budget over the shortest route");
        if field.changed() {
            wanted.budget = 1.0 + percent / 100.0;
        }
    });
    if !context.mission.no_fly.is_empty() {
        let label = "Distance from no-fly areas";
        length(ui, label, label, &mut wanted.clearance, 5000.0, context);
    }
    if !documents.relief().is_level() {
        let (label, least) = (
            "Height over the ground, at least",
            &mut wanted.ground_clearance,
        );
        length(ui, label, label, least, 5000.0, context);
        let words = clearance_words(planner, documents, context.units);
        ui.label(muted(context.tokens, words));
    }
    if wanted != planner.preferences.find {
        say(context, FindCommand::Set(wanted));
    }
}

/// Words on how a search keeps clear of the ground.
fn clearance_words(planner: &Planner, documents: &Documents, units: Units) -> String {
    let altitude = planner.found_altitude(documents);
    let flown = altitude_words(&altitude, units);
    let follows = altitude.frame == AltitudeFrame::AboveGround;
    match planner.highest_ground(documents) {
        Some(highest) if highest.is_finite() => {
            let (factor, unit) = units.length();
            let frame = documents.relief().frame();
            let highest = highest * factor;
            format!("Flown at {flown}: ground over {highest:.0} {unit} {frame} is avoided.")
        }
        Some(_) => format!("Flown at {flown}, which is lower than that: choose a higher altitude."),
        None if follows => format!("Flown at {flown}: it follows the ground."),
        None => format!("Flown at {flown}."),
    }
}

fn comparison(ui: &mut Ui, planner: &Planner, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let Some(found) = &planner.finder.found else {
        return;
    };
    let both = RouteFigures::of(&found.shortest).zip(RouteFigures::of(&found.surest));
    let Some((shortest, surest)) = both else {
        return;
    };
    ui.add_space(tokens.space);
    let units = context.units;
    let metres = |m: f64| units.short(m);
    let change = |a: f64, b: f64| with_minus(&format!("{:+.0} %", 100.0 * (b / a - 1.0)));
    let rows = [
        (
            "Length",
            distance_text(shortest.length, units),
            distance_text(surest.length, units),
            change(shortest.length, surest.length),
        ),
        (
            "Time",
            time_text(Some(shortest.time)),
            time_text(Some(surest.time)),
            change(shortest.time, surest.time),
        ),
        (
            "Largest error (1σ)",
            metres(shortest.worst),
            metres(surest.worst),
            change(shortest.worst, surest.worst),
        ),
        (
            "Mean error (1σ)",
            metres(shortest.mean),
            metres(surest.mean),
            change(shortest.mean, surest.mean),
        ),
    ];
    let width = (ui.available_width() - 3.0 * 12.0) / 4.0;
    egui::Grid::new("found route")
        .num_columns(4)
        .min_col_width(width)
        .spacing([12.0, 4.0])
        .show(ui, |ui| {
            let right = |ui: &mut Ui, text: egui::RichText| {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(text));
            };
            ui.label("");
            let is_straight = found.shortest.route.way_points.len() == 2;
            let first = if is_straight { "Straight" } else { "Shortest" };
            for head in [first, "Found", ""] {
                right(ui, muted(tokens, head));
            }
            ui.end_row();
            for (name, straight, found, change) in rows {
                ui.label(muted(tokens, name));
                right(ui, egui::RichText::new(straight));
                right(ui, egui::RichText::new(found).font(tokens.heading()));
                right(ui, muted(tokens, change));
                ui.end_row();
            }
        });
    if found.surest.route.way_points == found.shortest.route.way_points {
        ui.label(muted(
            tokens,
            "Nothing within the budget is better than the shortest way.",
        ));
    }
    reached(ui, &found.surest, context);
    if let Some(altitude) = planner
        .finder
        .altitude()
        .filter(|_| planner.finder.is_outdated)
    {
        let flown = altitude_words(&altitude, units);
        let words = format!(
            "The plan has changed since: these figures are of the plan before, flown at {flown}. Find the route again for \
             those of now."
        );
        ui.label(egui::RichText::new(words).color(tokens.warning));
    }
    if planner.finder.is_over_map() {
        ui.label(muted(
            tokens,
            "Predicted with the landmarks in use: draw some along the found route.",
        ));
    }
    ui.horizontal(|ui| {
        let accept = PlanCommand::Find(FindCommand::Accept);
        button(ui, context, None, "Make it a route", true, accept);
        let dismiss = PlanCommand::Find(FindCommand::Dismiss);
        button(ui, context, None, "Dismiss", false, dismiss);
    });
}

/// Warns of areas that the corridor of a found route reaches into: it keeps its distance from them as it is flown, and not as
/// uncertain as it is.
fn reached(ui: &mut Ui, found: &Foreseen, context: &ViewContext<'_>) {
    let no_fly = &context.mission.no_fly;
    let far = |metres| distance_text(metres, context.units);
    for it in found.reached(no_fly).iter().take(MOST_REACHED) {
        let text = egui::RichText::new(it.sentence(&no_fly[it.zone].name, &far));
        ui.label(text.color(context.tokens.warning));
    }
}
