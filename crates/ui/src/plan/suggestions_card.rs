//! Proposed landmarks listed, drawn on the map and added.

use egui::{Align2, Painter, Rect, Shape, Stroke, Ui, vec2};
use pilotage_core::frames::GroundRect;
use pilotage_core::landmark::Landmark;
use pilotage_core::plan::Suggestion;
use serde_json::{Value, json};

use super::button::button;
use super::command::PlanCommand;
use super::flown::flown_way;
use super::planner::Planner;
use super::suggest_command::SuggestCommand;
use super::suggestions::is_added;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::{Added, Brought, Documents};
use crate::map::{ScreenFromWorld, paint_halo_text, paint_lifted_line};
use crate::shell::{NumberField, caption, icon_button, icons::Icon, muted};
use crate::tokens::Tokens;
use pilotage_jobs::SuggestOrder;

impl Planner {
    /// Order of landmarks to be proposed; `None` while the map is missing.
    pub fn suggest_order(&self, documents: &Documents) -> Option<SuggestOrder> {
        documents.map.info.as_ref()?;
        let mission = &documents.mission;
        let route = mission.selected_route();
        let way = |route| flown_way(route, documents, self.preferences.bank).places;
        let places = route.map_or_else(Vec::new, way);
        let with = self.planned_with(documents);
        Some(with.proposal(&mission.landmarks, route, places, self.preferences.suggest))
    }

    /// Carries a command out; the landmarks that were added.
    pub fn suggest_command(&mut self, command: SuggestCommand, documents: &mut Documents) -> Added {
        let suggestions = &mut self.suggestions;
        match command {
            SuggestCommand::Count(count) => self.preferences.suggest = count.clamp(1, 99),
            SuggestCommand::Start => suggestions.wants = Some(true),
            SuggestCommand::Stop => suggestions.wants = Some(false),
            SuggestCommand::Dismiss => (suggestions.found, suggestions.trouble) = (None, None),
            SuggestCommand::Add(which) => {
                let free = documents.mission.free_landmark_id();
                let list = suggestions.list().iter().enumerate();
                let wanted = list.filter(|(i, s)| {
                    which.is_none_or(|w| w == *i) && !is_added(s, &documents.mission.landmarks)
                });
                let landmarks: Vec<Landmark> = wanted
                    .zip(free..)
                    .map(|((_, suggestion), id)| suggestion.landmark(id))
                    .collect();
                if !landmarks.is_empty() {
                    return documents.add_all(vec![Brought {
                        landmarks,
                        ..Brought::default()
                    }]);
                }
            }
        }
        Added::default()
    }

    /// Draws what is proposed beside the table of landmarks.
    pub(super) fn suggestions_card(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let say = |command| Command::from(PlanCommand::Suggest(command));
        let under_way = self.suggestions.asked.is_some();
        ui.horizontal(|ui| {
            if under_way {
                if icon_button(ui, tokens, Icon::Close, "Stop suggesting").clicked() {
                    context.commands.push(say(SuggestCommand::Stop));
                }
                let (share, words) = &self.suggestions.progress;
                ui.vertical(|ui| {
                    let bar = egui::ProgressBar::new(*share).desired_height(4.0);
                    ui.add(bar).accessible_name("How far suggesting is");
                    ui.add(egui::Label::new(muted(tokens, words)).truncate());
                });
                return;
            }
            let count = self.preferences.suggest;
            let place = match context.selected_route() {
                Some(_) => "this route",
                None => "the map",
            };
            let label = match count {
                1 => format!("Suggest a landmark for {place}"),
                _ => format!("Suggest {count} landmarks for {place}"),
            };
            let start = PlanCommand::Suggest(SuggestCommand::Start);
            button(ui, context, None, &label, false, start);
            let mut wanted = count;
            let field = NumberField::new(1.0..=99.0).speed(0.1);
            let field = field.show(ui, &mut wanted);
            let name = "How many landmarks to suggest";
            if field.accessible_name(name).changed() {
                context.commands.push(say(SuggestCommand::Count(wanted)));
            }
        });
        if let Some(why) = &self.suggestions.trouble {
            let text = format!("Nothing is suggested: {why}");
            ui.label(egui::RichText::new(text).color(tokens.warning));
        }
        if !self.suggestions.list().is_empty() {
            self.suggestions_list(ui, context);
        }
    }

    fn suggestions_list(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let mission = context.mission;
        let say = |command| Command::from(PlanCommand::Suggest(command));
        let Some((_, list)) = &self.suggestions.found else {
            return;
        };
        let added = |s: &Suggestion| is_added(s, &mission.landmarks);
        caption(ui, tokens, "Suggested");
        ui.horizontal(|ui| {
            if !list.iter().all(added) {
                let all = PlanCommand::Suggest(SuggestCommand::Add(None));
                button(ui, context, Some(Icon::Plus), "Add all", true, all);
            }
            let dismiss = PlanCommand::Suggest(SuggestCommand::Dismiss);
            button(ui, context, None, "Dismiss", false, dismiss);
        });
        if self.suggestions.is_outdated {
            let words = "The plan has changed since: they are for another route, height, camera or settings.";
            ui.label(egui::RichText::new(words).color(tokens.warning));
        }
        let mut hovered = None;
        for (index, suggestion) in list.iter().enumerate() {
            let number = index + 1;
            let row = ui.horizontal(|ui| {
                if added(suggestion) {
                    let (rect, _) = ui.allocate_exact_size(vec2(32.0, 32.0), egui::Sense::hover());
                    let at = rect.center();
                    ui.painter().circle_filled(at, 4.0, tokens.truth);
                } else {
                    let label = format!("Add suggestion {number}");
                    if icon_button(ui, tokens, Icon::Plus, &label).clicked() {
                        let add = SuggestCommand::Add(Some(index));
                        context.commands.push(say(add));
                    }
                }
                let made = if added(suggestion) { "Added: " } else { "" };
                let found = &suggestion.candidate;
                // A number and its unit stay on one line.
                let text = format!(
                    "{number}  {made}saves {:.0}\u{a0}s · found {:.0}\u{a0}% · look-alike {:.2}",
                    suggestion.gained,
                    100.0 * found.probability,
                    found.rival
                );
                let label = egui::Label::new(egui::RichText::new(text).color(tokens.text)).wrap();
                ui.add(label).on_hover_text(&suggestion.reason);
            });
            if ui.rect_contains_pointer(row.response.rect) {
                hovered = Some(index);
            }
        }
        self.suggestions.hovered = hovered;
        ui.add_space(tokens.space);
    }

    /// Draws on the map what is proposed and was not added, with the look-alike of one of them.
    pub(crate) fn paint_suggestions(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        landmarks: &[Landmark],
        tokens: &Tokens,
    ) {
        let dashed = |bounds: &GroundRect, color| {
            let mut corners = view.corners(bounds).to_vec();
            corners.extend(corners.first().copied());
            let below = Stroke::new(4.0, tokens.outline());
            painter.add(Shape::line(corners.clone(), below));
            painter.extend(Shape::dashed_line(
                &corners,
                Stroke::new(2.0, color),
                6.0,
                4.0,
            ));
            Rect::from_points(&corners)
        };
        for (index, suggestion) in self.suggestions.list().iter().enumerate() {
            if is_added(suggestion, landmarks) {
                continue;
            }
            let candidate = &suggestion.candidate;
            if self.suggestions.hovered == Some(index) {
                let b = &candidate.bounds;
                let rival = GroundRect::centered(candidate.rival_place, b.height(), b.width());
                let ends = [view.apply(&b.center()), view.apply(&rival.center())];
                paint_lifted_line(painter, ends, 1.0, tokens.warning, tokens);
                dashed(&rival, tokens.warning);
            }
            let around = dashed(&candidate.bounds, tokens.advice);
            let (at, align) = (around.center(), Align2::CENTER_CENTER);
            let text = format!("{}", index + 1);
            paint_halo_text(painter, at, align, &text, tokens.normal(), tokens.advice);
        }
    }

    /// Proposed landmarks as JSON, for journeys.
    pub fn suggestions_json(&self, landmarks: &[Landmark]) -> Value {
        let suggestions = &self.suggestions;
        let of = |s: &Suggestion| {
            let middle = s.candidate.bounds.center();
            json!({
                "north": middle.north,
                "east": middle.east,
                "probability": s.candidate.probability,
                "reason": s.reason,
                "added": is_added(s, landmarks),
            })
        };
        json!({
            "list": suggestions.list().iter().map(of).collect::<Vec<_>>(),
            "progress": suggestions.asked.as_ref().map(|_| suggestions.progress.0),
            "trouble": suggestions.trouble,
        })
    }
}
