//! Editor of the properties of landmarks: category, notes, reference point, height, direction.

use std::collections::BTreeSet;

use egui::{TextEdit, Ui};
use pilotage_core::landmark::Landmark;

use super::PlanCommand;
use super::purpose::Purpose;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::landmarks::LandmarkChange;
use crate::shell::{NumberField, caption, icon_button, icons::Icon, muted, text_button};

/// Categories that are offered where the mission has none of its own.
const USUAL: [&str; 8] = [
    "building",
    "bridge",
    "crossing",
    "field corner",
    "mast",
    "pool",
    "roundabout",
    "tree group",
];

/// A text being typed: of which landmarks, and how it stands.
type Draft = Option<(Vec<u32>, String)>;

/// The editor's own state.
#[derive(Debug, Default)]
pub struct LandmarkEditor {
    category: Draft,
    notes: Draft,
}

impl LandmarkEditor {
    /// Draws the fields of one landmark.
    pub fn one(&mut self, ui: &mut Ui, landmark: &Landmark, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let ids = vec![landmark.id];
        caption(ui, tokens, "Notes");
        let mut changes = Vec::new();
        ui.horizontal(|ui| {
            let now = landmark.category();
            changes.extend(self.category(ui, &ids, &now, context));
        });
        let draft = draft(&mut self.notes, &ids, &landmark.notes());
        let field = TextEdit::multiline(draft)
            .hint_text("Notes")
            .desired_rows(2)
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Notes on the landmark");
        if field.lost_focus() {
            changes.push((LandmarkChange::Notes(draft.clone()), true));
        }
        if !field.has_focus() {
            self.notes = None;
        }
        ui.horizontal(|ui| changes.extend(numbers(ui, landmark, context)));
        ui.horizontal(|ui| {
            let (factor, unit) = context.units.length();
            let middle = landmark.bounds.center();
            let r = landmark.reference;
            let (north, east) = (r.north - middle.north, r.east - middle.east);
            let place = if north.hypot(east) < 0.05 {
                "Reference point: the middle".to_owned()
            } else {
                let part = |metres: f64, plus: &str, minus: &str| {
                    let word = if metres < 0.0 { minus } else { plus };
                    format!("{:.1} {unit} {word}", metres.abs() * factor)
                };
                format!(
                    "Reference point: {}, {} of the middle",
                    part(north, "north", "south"),
                    part(east, "east", "west")
                )
            };
            ui.spacing_mut().item_spacing.x = 0.0;
            if icon_button(
                ui,
                tokens,
                Icon::Target,
                "Set the reference point on the map",
            )
            .clicked()
            {
                let command = PlanCommand::Mark(Purpose::Reference);
                context.commands.push(Command::from(command));
            }
            let label = "Reference point to the middle";
            if north.hypot(east) >= 0.05 && icon_button(ui, tokens, Icon::Undo, label).clicked() {
                changes.push((LandmarkChange::Reference(middle), true));
            }
            ui.add_space(4.0);
            ui.add(egui::Label::new(muted(tokens, place)).truncate());
        });
        for (change, finished) in changes {
            context.say_first(PlanCommand::EditLandmarks {
                ids: ids.clone(),
                change,
                finished,
            });
        }
    }

    /// Draws what can be done with several landmarks.
    pub fn several(&mut self, ui: &mut Ui, ids: &[u32], context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        caption(ui, tokens, &format!("{} landmarks selected", ids.len()));
        let mission = context.mission;
        let of = || ids.iter().filter_map(|id| mission.landmark(*id));
        let categories: BTreeSet<String> = of().map(Landmark::category).collect();
        let common = match categories.iter().next() {
            Some(one) if categories.len() == 1 => one.clone(),
            _ => String::new(),
        };
        let mut say = Vec::new();
        let edit = |change| PlanCommand::EditLandmarks {
            ids: ids.to_vec(),
            change,
            finished: true,
        };
        ui.horizontal(|ui| {
            if let Some((change, _)) = self.category(ui, ids, &common, context) {
                say.push(edit(change));
            }
        });
        ui.horizontal_wrapped(|ui| {
            let all_on = of().all(|l| l.enabled);
            let label = if all_on { "Switch off" } else { "Switch on" };
            for (icon, label, command) in [
                (
                    Icon::Trash,
                    "Delete",
                    PlanCommand::DeleteLandmarks(ids.to_vec()),
                ),
                (Icon::Duplicate, "Duplicate", PlanCommand::DuplicateLandmark),
                (Icon::Eye, label, edit(LandmarkChange::Enabled(!all_on))),
            ] {
                if text_button(ui, tokens, Some(icon), label, false).clicked() {
                    say.push(command);
                }
            }
        });
        context.commands.extend(say.into_iter().map(Command::from));
    }

    fn category(
        &mut self,
        ui: &mut Ui,
        ids: &[u32],
        now: &str,
        context: &ViewContext<'_>,
    ) -> Option<(LandmarkChange, bool)> {
        let draft = draft(&mut self.category, ids, now);
        let width = ui.available_width() - 44.0;
        let field = TextEdit::singleline(draft)
            .align(egui::Align2::LEFT_CENTER)
            .hint_text("Category")
            .desired_width(width);
        let field = ui.add(field).accessible_name("Category");
        let mut chosen = field.lost_focus().then(|| draft.trim().to_owned());
        if !field.has_focus() {
            self.category = None;
        }
        let button = icon_button(ui, context.tokens, Icon::More, "Choose a category");
        egui::Popup::menu(&button).show(|ui| {
            let own = context.mission.landmarks.iter().map(Landmark::category);
            let own = own.filter(|c| !c.is_empty());
            let all: BTreeSet<String> = own.chain(USUAL.map(str::to_owned)).collect();
            for category in all {
                if ui.button(&category).clicked() {
                    chosen = Some(category);
                    ui.close();
                }
            }
        });
        let chosen = chosen.filter(|c| c != now);
        chosen.map(|category| (LandmarkChange::Category(category), true))
    }
}

fn draft<'a>(draft: &'a mut Draft, ids: &[u32], now: &str) -> &'a mut String {
    if draft.as_ref().is_some_and(|(of, _)| of != ids) {
        *draft = None;
    }
    &mut draft
        .get_or_insert_with(|| (ids.to_vec(), now.to_owned()))
        .1
}

/// Height above ground and direction.
fn numbers(
    ui: &mut Ui,
    landmark: &Landmark,
    context: &ViewContext<'_>,
) -> Vec<(LandmarkChange, bool)> {
    let tokens = context.tokens;
    let mut changes = Vec::new();
    let (factor, unit) = context.units.length();
    let mut height = landmark.height;
    ui.label(muted(tokens, "Height"));
    let field = NumberField::new(-100.0..=1000.0).unit((factor, unit));
    let field = field.suffix(format!(" {unit} above ground"));
    let field = field.speed(0.1).decimals(1).show(ui, &mut height);
    let field = field.accessible_name("Height of the reference point");
    if field.changed() {
        let change = LandmarkChange::Height(height);
        changes.push((change, !field.dragged()));
    }
    let stated = landmark.orientation();
    let mut direction = stated.unwrap_or(0.0);
    ui.label(muted(tokens, "Direction"));
    let field = NumberField::new(f64::MIN..=f64::MAX).degrees();
    let field = field.speed(0.5).decimals(1);
    let field = field.words(move |value| match stated {
        Some(_) => format!("{value:.0}°"),
        None => "none".to_owned(),
    });
    let field = field.show(ui, &mut direction);
    let field = field.accessible_name("Direction of the landmark, degrees from north");
    if field.changed() {
        let change = LandmarkChange::Orientation(Some(direction));
        changes.push((change, !field.dragged()));
    }
    if stated.is_some() && icon_button(ui, tokens, Icon::Close, "No direction").clicked() {
        changes.push((LandmarkChange::Orientation(None), true));
    }
    changes
}
