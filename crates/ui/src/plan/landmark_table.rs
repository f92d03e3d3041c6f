//! The table of landmarks: name, size, how often each is found; sorted as the user likes.

use pilotage_core::sorting::sort;
use std::collections::BTreeSet;

use egui::{Align2, Modifiers, Response, Role, Sense, TextEdit, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Mission;

use super::assessments::Assessments;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{muted, text_button};
use crate::tokens::Tokens;
use crate::views::{landmark_row, rows_in_view};

/// Column that the table is sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum LandmarkColumn {
    #[default]
    Order,
    Name,
    Category,
    Size,
    Found,
}

/// Sorting, filter and marks of the table.
#[derive(Debug, Default)]
pub struct LandmarkTable {
    by: LandmarkColumn,
    descending: bool,
    /// Words that every landmark shown must have.
    filter: String,
    /// The landmarks that are marked.
    marked: BTreeSet<u32>,
    /// Landmark at which a range begins.
    anchor: Option<u32>,
}

/// Widths of the columns, points.
const FOUND: f32 = 62.0;
const SIZE: f32 = 84.0;
const CATEGORY: f32 = 92.0;
/// Between a cell's right edge and its text, points.
const PADDING: f32 = 8.0;

/// Ends of the columns of a row; that of categories is there if any landmark has one.
#[derive(Clone, Copy)]
struct ColumnEnds {
    left: f32,
    name: f32,
    category: f32,
    size: f32,
    found: f32,
}

impl ColumnEnds {
    fn of(rect: &egui::Rect, categories: bool) -> Self {
        let found = rect.right();
        let size = found - FOUND;
        let category = size - SIZE;
        let name = category - if categories { CATEGORY } else { 0.0 };
        Self {
            left: rect.left(),
            name,
            category,
            size,
            found,
        }
    }
}

impl LandmarkTable {
    /// Draws the table.
    pub fn show(&mut self, ui: &mut Ui, assessments: &Assessments, context: &mut ViewContext<'_>) {
        let mission = context.mission;
        let mut rows: Vec<&Landmark> = mission.landmarks.iter().collect();
        rows.retain(|l| fits(l, &self.filter));
        self.sort(&mut rows, assessments);
        let ids: Vec<u32> = rows.iter().map(|l| l.id).collect();
        self.filter(ui, &ids, context);
        let categories = mission.landmarks.iter().any(|l| !l.category().is_empty());
        self.header(ui, context.tokens, categories);
        // What is selected elsewhere is what is marked here.
        let strange = context
            .selection
            .is_some_and(|id| !self.marked.contains(&id));
        if strange || context.selection.is_none() && self.marked.len() < 2 {
            self.marked = context.selection.into_iter().collect();
        }
        let (top, height) = (ui.cursor().top(), context.tokens.target());
        rows_in_view(ui, rows.len(), height, |ui, number| {
            let landmark = rows[number];
            let is_marked = self.marked.contains(&landmark.id);
            if row(ui, landmark, is_marked, categories, assessments, context) {
                let keys = click_modifiers(ui);
                self.click(landmark.id, &ids, keys, context);
            }
        });
        let chosen = context.selection.filter(|_| strange);
        if let Some(number) = ids.iter().position(|id| Some(*id) == chosen) {
            let top = top + number as f32 * height;
            let across = ui.max_rect().x_range();
            ui.scroll_to_rect(
                egui::Rect::from_x_y_ranges(across, top..=top + height),
                None,
            );
        }
        if ids.is_empty() {
            let words = "No landmark has these words in its name, category or notes.";
            ui.label(muted(context.tokens, words));
        }
    }

    /// The landmarks that are marked.
    pub fn marked(&self) -> &BTreeSet<u32> {
        &self.marked
    }

    /// Marks these, and no others.
    pub fn mark(&mut self, ids: Vec<u32>) {
        self.anchor = ids.last().copied();
        self.marked = ids.into_iter().collect();
    }

    /// Lets go of what does not exist any more.
    pub fn settle(&mut self, mission: &Mission) {
        self.marked.retain(|id| mission.landmark(*id).is_some());
        self.anchor = self.anchor.filter(|id| mission.landmark(*id).is_some());
    }

    fn filter(&mut self, ui: &mut Ui, shown: &[u32], context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        ui.horizontal(|ui| {
            let width = ui.available_width() - 92.0;
            let field = TextEdit::singleline(&mut self.filter)
                .align(egui::Align2::LEFT_CENTER)
                .hint_text("Filter by name, category or notes")
                .desired_width(width);
            ui.add(field).accessible_name("Filter the landmarks");
            if text_button(ui, tokens, None, "Mark all", false).clicked() {
                self.mark(shown.to_vec());
                let last = shown.last().copied();
                context.commands.push(Command::SelectLandmark(last));
            }
        });
    }

    /// Marks by a click on a row of `rows`: with Ctrl one more or one less, with Shift up to there.
    fn click(&mut self, id: u32, rows: &[u32], keys: Modifiers, context: &mut ViewContext<'_>) {
        let was_alone = self.marked.len() == 1 && self.marked.contains(&id);
        let at = |id: u32| rows.iter().position(|r| *r == id);
        let anchor = self.anchor.or(context.selection).and_then(at);
        match (keys.shift, keys.command, anchor, at(id)) {
            (true, _, Some(from), Some(to)) => {
                self.marked = rows[from.min(to)..=from.max(to)].iter().copied().collect();
            }
            (false, true, ..) => {
                if !self.marked.remove(&id) {
                    self.marked.insert(id);
                }
                self.anchor = Some(id);
            }
            _ if was_alone => {
                self.marked.clear();
                self.anchor = None;
            }
            _ => {
                self.marked = BTreeSet::from([id]);
                self.anchor = Some(id);
            }
        }
        let selected = Some(id).filter(|id| self.marked.contains(id));
        let selected = selected.or(self.marked.last().copied());
        context.commands.push(Command::SelectLandmark(selected));
    }

    /// Sorts rows as the user likes; what each is sorted by is asked once.
    fn sort(&self, rows: &mut Vec<&Landmark>, assessments: &Assessments) {
        let key = |l: &Landmark| -> (String, f64) {
            match self.by {
                LandmarkColumn::Order => Default::default(),
                LandmarkColumn::Name => (l.name.to_lowercase(), 0.0),
                LandmarkColumn::Category => (l.category().to_lowercase(), 0.0),
                LandmarkColumn::Size => (String::new(), l.bounds.width() * l.bounds.height()),
                LandmarkColumn::Found => {
                    let measured = assessments.of(l);
                    // Those that nobody tested come before the worst.
                    let found = measured.map_or(-1.0, |m| m.last.expected.probability());
                    (String::new(), found)
                }
            }
        };
        if self.by == LandmarkColumn::Order {
            return;
        }
        let mut keyed: Vec<_> = rows
            .iter()
            .map(|landmark| (key(landmark), *landmark))
            .collect();
        sort(&mut keyed, &|((a, x), _), ((b, y), _)| {
            let order = a.cmp(b).then(x.total_cmp(y));
            if self.descending {
                order.reverse()
            } else {
                order
            }
        });
        *rows = keyed.into_iter().map(|(_, landmark)| landmark).collect();
    }

    fn header(&mut self, ui: &mut Ui, tokens: &Tokens, categories: bool) {
        let width = ui.available_width();
        let (rect, _) = ui.allocate_exact_size(vec2(width, 24.0), Sense::hover());
        let at = ColumnEnds::of(&rect, categories);
        let mut columns = vec![(LandmarkColumn::Name, "Landmark", at.left..=at.name)];
        if categories {
            columns.push((LandmarkColumn::Category, "Category", at.name..=at.category));
        }
        columns.push((LandmarkColumn::Size, "Size", at.category..=at.size));
        columns.push((LandmarkColumn::Found, "Found", at.size..=at.found));
        for (column, label, x) in columns {
            let cell = egui::Rect::from_x_y_ranges(x, rect.y_range());
            let id = ui.scope_id().with(label);
            let response = ui.interact(cell, id, Sense::click());
            self.title(ui, &response, column, label, tokens);
            if response.clicked() {
                (self.by, self.descending) = match (self.by == column, self.descending) {
                    (false, _) => (column, false),
                    (true, false) => (column, true),
                    (true, true) => (LandmarkColumn::Order, false),
                };
            }
        }
    }

    fn title(
        &self,
        ui: &Ui,
        response: &Response,
        column: LandmarkColumn,
        label: &str,
        tokens: &Tokens,
    ) {
        let sorted = self.by == column;
        response.widget_info(|| {
            let name = format!("Sort by {}", label.to_lowercase());
            WidgetInfo::selected(Role::Button, true, sorted, name)
        });
        let color = if sorted || response.hovered() || response.has_focus() {
            tokens.text
        } else {
            tokens.muted
        };
        let (at, align) = if column == LandmarkColumn::Name {
            (
                response.rect.left_center() + vec2(8.0, 0.0),
                Align2::LEFT_CENTER,
            )
        } else {
            (
                response.rect.right_center() - vec2(8.0, 0.0),
                Align2::RIGHT_CENTER,
            )
        };
        let painter = ui.painter();
        let words = painter.text(at, align, label, tokens.small(), color);
        if sorted {
            let middle = if column == LandmarkColumn::Name {
                words.right_center() + vec2(9.0, 0.0)
            } else {
                words.left_center() - vec2(9.0, 0.0)
            };
            let tip = if self.descending { 3.0 } else { -3.0 };
            let corners = [vec2(0.0, tip), vec2(4.0, -tip), vec2(-4.0, -tip)];
            let corners = corners.map(|c| middle + c).to_vec();
            let shape = egui::Shape::convex_polygon(corners, color, egui::Stroke::NONE);
            painter.add(shape);
        }
    }
}

/// The keys that were held at the click, which may be up again by the time it is seen.
fn click_modifiers(ui: &Ui) -> Modifiers {
    ui.input(|input| {
        let at_release = input.events.iter().find_map(|event| match event {
            egui::Event::PointerButton {
                pressed: false,
                modifiers,
                ..
            } => Some(*modifiers),
            _ => None,
        });
        at_release.unwrap_or(input.modifiers)
    })
}

/// Whether every word of `filter` stands in a landmark's name, category or notes.
fn fits(landmark: &Landmark, filter: &str) -> bool {
    if filter.trim().is_empty() {
        return true;
    }
    let all = [landmark.name.clone(), landmark.category(), landmark.notes()];
    let all = all.join(" ").to_lowercase();
    filter
        .to_lowercase()
        .split_whitespace()
        .all(|word| all.contains(word))
}

/// Draws a row; true if it was clicked.
fn row(
    ui: &mut Ui,
    landmark: &Landmark,
    selected: bool,
    categories: bool,
    assessments: &Assessments,
    context: &mut ViewContext<'_>,
) -> bool {
    let (tokens, units) = (context.tokens, context.units);
    let category = match landmark.category() {
        none if none.is_empty() => "no category".to_owned(),
        category => category,
    };
    let [width, height] = [landmark.bounds.width(), landmark.bounds.height()];
    let words = format!(
        "{}: {category}, {width:.0} by {height:.0} metres",
        landmark.name
    );
    let response = landmark_row(ui, context, landmark, selected, &words, |row| {
        let at = ColumnEnds::of(&row.rect, categories);
        let cell = |from: f32, to: f32| {
            egui::Rect::from_x_y_ranges(from..=to - PADDING, row.rect.y_range())
        };
        row.name(cell(at.left, at.name));
        let room = cell(at.name, at.category);
        let clip = room.intersect(row.painter.clip_rect());
        row.painter.with_clip_rect(clip).text(
            room.right_center(),
            Align2::RIGHT_CENTER,
            landmark.category(),
            tokens.small(),
            tokens.muted,
        );
        let (factor, unit) = units.length();
        let text = format!("{:.0} × {:.0} {unit}", width * factor, height * factor);
        let place = pos2(at.size - PADDING, row.rect.center().y);
        let (font, muted) = (tokens.small(), tokens.muted);
        row.painter
            .text(place, Align2::RIGHT_CENTER, text, font, muted);
        let (text, font, color) = found_words(landmark, assessments, tokens, row.color);
        let place = pos2(at.found - PADDING, row.rect.center().y);
        row.painter
            .text(place, Align2::RIGHT_CENTER, text, font, color);
    });
    let response = if assessments.of(landmark).is_some() {
        response
    } else {
        response.on_hover_text("Not tested; press D or Test all to look for it on other days")
    };
    response.clicked()
}

/// Detection probability of a landmark in words, with their font and colour.
fn found_words(
    landmark: &Landmark,
    assessments: &Assessments,
    tokens: &Tokens,
    color: egui::Color32,
) -> (String, egui::FontId, egui::Color32) {
    let percent = |p: f64| format!("{:.0} %", 100.0 * p);
    let under_way = assessments.under_way();
    // No share of the test that is done: it would stand among shares of pictures.
    if under_way.is_some_and(|(of, ..)| of == landmark.id) {
        return ("testing …".to_owned(), tokens.small(), tokens.accent);
    }
    if let Some(measured) = assessments.of(landmark) {
        let p = measured.last.expected.probability();
        return (percent(p), tokens.normal(), color);
    }
    ("not tested".to_owned(), tokens.small(), tokens.muted)
}
