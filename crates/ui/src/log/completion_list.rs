//! The list of names that a half-written one may become.

use std::ops::Range;

use egui::{Area, Frame, Id, Order, Pos2, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::flight::expression::{Completion, NameCandidate};

use crate::tokens::Tokens;

/// Height of a row, in units of the spacing.
const ROW: f32 = 2.5;

/// Effect of keys on the list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Choice {
    /// Nothing.
    #[default]
    Stay,
    /// Move up by a name.
    Up,
    /// Move down by a name.
    Down,
    /// None of them is meant.
    Close,
    /// The chosen one is meant.
    Accept,
}

/// The list and which of it is chosen.
#[derive(Clone, Debug, Default)]
pub(super) struct CompletionList {
    completion: Completion,
    chosen: Option<usize>,
}

impl CompletionList {
    fn id() -> Id {
        Id::unique("names that may be meant")
    }

    /// Whether there is anything in it.
    pub fn is_open(&self) -> bool {
        !self.completion.candidates.is_empty()
    }

    /// Shows names, one of them chosen.
    pub fn open(&mut self, completion: Completion, chosen: Option<usize>) {
        self.completion = completion;
        self.chosen = chosen;
    }

    /// Shows nothing.
    pub fn close(&mut self) {
        self.completion.candidates.clear();
    }

    /// Bytes of the text that a name takes the place of.
    pub fn place(&self) -> Range<usize> {
        self.completion.place.clone()
    }

    /// The name that is chosen.
    pub fn chosen(&self) -> Option<String> {
        let candidate = self.completion.candidates.get(self.chosen?);
        candidate.map(|candidate| candidate.text.clone())
    }

    /// Follows the keys.
    pub fn move_by(&mut self, choice: Choice) {
        let count = self.completion.candidates.len();
        if count == 0 {
            return;
        }
        match (choice, self.chosen) {
            (Choice::Close, _) => self.close(),
            (Choice::Down, None) => self.chosen = Some(0),
            (Choice::Down, Some(at)) => self.chosen = Some((at + 1) % count),
            (Choice::Up, at) => self.chosen = Some((at.unwrap_or(0) + count - 1) % count),
            (Choice::Stay | Choice::Accept, _) => {}
        }
    }

    /// Whether the pointer is over it.
    pub fn is_hovered(&self, ui: &Ui) -> bool {
        let rect = ui.memory(|memory| memory.area_rect(Self::id()));
        let pointer = ui.input(|i| i.pointer.interact_pos());
        self.is_open()
            && rect
                .zip(pointer)
                .is_some_and(|(rect, at)| rect.contains(at))
    }

    /// Draws the list; the name that was clicked.
    pub fn show(&self, ui: &Ui, tokens: &Tokens, corner: Pos2, width: f32) -> Option<String> {
        if !self.is_open() {
            return None;
        }
        let mut clicked = None;
        Area::new(Self::id())
            .order(Order::Foreground)
            .fixed_pos(corner)
            .constrain(true)
            .show(ui.ctx(), |ui| {
                Frame::popup(ui.style()).inner_margin(4).show(ui, |ui| {
                    ui.set_width(width - 10.0);
                    ui.spacing_mut().item_spacing.y = 0.0;
                    for (index, candidate) in self.completion.candidates.iter().enumerate() {
                        if row(ui, tokens, candidate, self.chosen == Some(index)) {
                            clicked = Some(candidate.text.clone());
                        }
                    }
                });
            });
        clicked
    }
}

/// Draws the row of a name; whether it was clicked.
fn row(ui: &mut Ui, tokens: &Tokens, candidate: &NameCandidate, is_chosen: bool) -> bool {
    let size = vec2(ui.available_width(), ROW * tokens.space);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let name = format!("Write {}", candidate.text);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_chosen, &name));
    let painter = ui.painter_at(rect);
    if is_chosen || response.hovered() {
        painter.rect_filled(rect, 0.5 * tokens.radius, tokens.hover());
    }
    let middle = rect.center().y;
    let name = painter.text(
        pos2(rect.left() + 0.5 * tokens.space, middle),
        egui::Align2::LEFT_CENTER,
        &candidate.text,
        tokens.normal(),
        tokens.text,
    );
    let about = painter.layout_no_wrap(candidate.about.clone(), tokens.small(), tokens.muted);
    let left = rect.right() - 0.5 * tokens.space - about.size().x;
    let left = left.max(name.right() + tokens.space);
    painter.galley(
        pos2(left, middle - 0.5 * about.size().y),
        about,
        tokens.muted,
    );
    response.clicked()
}
