//! The field in which an expression over the series of a log is written: names are completed while
//! typing, what is wrong is said below with a mark under the place.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::{TextEditOutput, TextEditState};
use egui::{EventFilter, Id, Key, Modifiers, Pos2, RichText, Shape, Stroke, TextEdit, Ui, vec2};
use pilotage_core::flight::expression::{
    Completion, Expression, ExpressionError, Trouble, complete,
};

use super::OpenLog;
use super::completion_list::{Choice, CompletionList};
use super::names::{NamedSeries, names};
use crate::tokens::Tokens;

/// Result of a frame of typing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum TypedExpression {
    /// An expression to be plotted alone.
    Alone(String),
    /// An expression to be plotted with the fields of the panel touched last.
    Beside(String),
}

/// The field's own state.
#[derive(Clone, Debug, Default)]
pub(super) struct ExpressionField {
    text: String,
    list: CompletionList,
    error: Option<ExpressionError>,
    /// Whether to say what is missing at the end as well: not while people still write.
    is_entered: bool,
}

/// The keys that the field takes for itself.
#[derive(Clone, Copy, Debug, Default)]
struct Keys {
    enter: bool,
    beside: bool,
    choice: Choice,
}

impl ExpressionField {
    fn id() -> Id {
        Id::unique("expression over fields")
    }

    /// Draws the field; what was entered, if something was.
    pub fn show(&mut self, ui: &mut Ui, tokens: &Tokens, log: &OpenLog) -> Option<TypedExpression> {
        let id = Self::id();
        let has_focus = ui.memory(|memory| memory.has_focus(id));
        let keys = self.keys(ui, has_focus);
        let output = TextEdit::singleline(&mut self.text)
            .align(egui::Align2::LEFT_CENTER)
            .id(id)
            .hint_text("Expression: ATT.Roll - smooth({Roll}, 2)")
            .desired_width(f32::INFINITY)
            .return_key(None)
            .event_filter(EventFilter {
                horizontal_arrows: true,
                vertical_arrows: self.list.is_open(),
                tab: self.list.is_open(),
                escape: self.list.is_open(),
            })
            .show(ui);
        let field = output.response.response.clone();
        let field = field.accessible_name("Expression over fields");
        if field.changed() {
            self.is_entered = false;
            self.examine(log, cursor(&output, &self.text));
        }
        let below = field.rect.left_bottom() + vec2(0.0, 2.0);
        let clicked = self.list.show(ui, tokens, below, field.rect.width());
        if !field.has_focus() && !self.list.is_hovered(ui) {
            self.list.close();
        }
        let accepts = keys.choice == Choice::Accept;
        let chosen = clicked.or_else(|| self.list.chosen().filter(|_| accepts));
        if let Some(text) = chosen {
            self.accept(ui, &text);
            self.examine_text(log);
            return None;
        }
        self.list.move_by(keys.choice);
        let entered = self.entered(keys, log);
        self.tell(ui, tokens, &output);
        entered
    }

    /// Takes keys away from the field that are not for it.
    fn keys(&self, ui: &Ui, has_focus: bool) -> Keys {
        if !has_focus {
            return Keys::default();
        }
        let is_open = self.list.is_open();
        let chooses = is_open && self.list.chosen().is_some();
        ui.input_mut(|input| {
            let mut plain = |key| input.consume_key(Modifiers::NONE, key);
            let choice = if is_open && plain(Key::ArrowUp) {
                Choice::Up
            } else if is_open && plain(Key::ArrowDown) {
                Choice::Down
            } else if is_open && plain(Key::Escape) {
                Choice::Close
            } else if chooses && (plain(Key::Tab) || plain(Key::Enter)) {
                Choice::Accept
            } else {
                Choice::Stay
            };
            Keys {
                beside: input.consume_key(Modifiers::SHIFT, Key::Enter),
                enter: input.consume_key(Modifiers::NONE, Key::Enter),
                choice,
            }
        })
    }

    /// Checks the expression on Enter and hands it on.
    fn entered(&mut self, keys: Keys, log: &OpenLog) -> Option<TypedExpression> {
        if !keys.enter && !keys.beside {
            return None;
        }
        self.list.close();
        self.is_entered = true;
        self.examine_text(log);
        if self.error.is_some() {
            return None;
        }
        self.is_entered = false;
        let text = std::mem::take(&mut self.text);
        Some(if keys.beside {
            TypedExpression::Beside(text)
        } else {
            TypedExpression::Alone(text)
        })
    }

    /// Puts a name in the place of the half-written one, with the cursor behind it.
    fn accept(&mut self, ui: &Ui, name: &str) {
        let place = self.list.place();
        if self.text.get(place.clone()).is_none() {
            return;
        }
        self.text.replace_range(place.clone(), name);
        let letters = self.text[..place.start + name.len()].chars().count();
        let mut state = TextEditState::load(ui.ctx(), Self::id()).unwrap_or_default();
        let behind = CCursorRange::one(CCursor::new(letters));
        state.cursor.set_char_range(Some(behind));
        state.store(ui.ctx(), Self::id());
        ui.memory_mut(|memory| memory.request_focus(Self::id()));
        self.list.close();
    }

    /// Examines changed text of the field: names that may be meant, and what is wrong.
    fn examine(&mut self, log: &OpenLog, cursor: usize) {
        let names = names(log);
        let named = names.iter().map(|n| (n.name.as_str(), n.unit.as_str()));
        self.list.offer(complete(&self.text, cursor, named));
        self.check(&names);
    }

    fn examine_text(&mut self, log: &OpenLog) {
        self.check(&names(log));
    }

    fn check(&mut self, names: &[NamedSeries]) {
        let known = names.iter().map(|named| named.name.as_str());
        let checked = Expression::parse(&self.text).and_then(|it| it.check(&known));
        self.error = checked.err();
    }

    /// Error in the expression, unless it is about what is still being written.
    fn told(&self) -> Option<&ExpressionError> {
        let error = self.error.as_ref()?;
        let is_unfinished = error.place.end >= self.text.trim_end().len()
            || matches!(error.trouble, Trouble::OpenBrace);
        let waits = is_unfinished && !self.is_entered || self.list.is_open();
        (!waits && !self.text.trim().is_empty()).then_some(error)
    }

    /// Says what is wrong, with a mark under the place.
    fn tell(&self, ui: &mut Ui, tokens: &Tokens, output: &TextEditOutput) {
        let Some(error) = self.told() else { return };
        let letter = |byte: usize| {
            let before = self.text.get(..byte).unwrap_or(&self.text);
            before.chars().count()
        };
        let at = |byte: usize| {
            let cursor = CCursor::new(letter(byte));
            let rect = output.galley.pos_from_cursor(cursor);
            output.galley_pos + rect.left_bottom().to_vec2()
        };
        let (from, to) = (at(error.place.start), at(error.place.end));
        let painter = ui
            .painter()
            .with_clip_rect(output.text_clip_rect.expand(8.0));
        let stroke = Stroke::new(1.5, tokens.warning);
        painter.line_segment([from, Pos2::new(to.x.max(from.x + 4.0), to.y)], stroke);
        let tip = from + vec2(0.0, 2.0);
        let caret = vec![tip, tip + vec2(4.0, 6.0), tip + vec2(-4.0, 6.0)];
        painter.add(Shape::convex_polygon(caret, tokens.warning, Stroke::NONE));
        ui.add_space(4.0);
        let text = format!(
            "Letter {}: {}",
            letter(error.place.start) + 1,
            error.trouble
        );
        let text = RichText::new(text).size(tokens.text_sizes[0]);
        ui.add(egui::Label::new(text.color(tokens.warning)).wrap());
    }
}

/// Byte of the text at which the cursor stands; its end where there is none.
fn cursor(output: &TextEditOutput, text: &str) -> usize {
    let Some(range) = output.cursor_range else {
        return text.len();
    };
    let letters: usize = range.primary.index.0;
    let place = text.char_indices().nth(letters);
    place.map_or(text.len(), |(byte, _)| byte)
}

impl CompletionList {
    /// Offers what may be meant.
    fn offer(&mut self, completion: Completion) {
        let first = (!completion.is_whole).then_some(0);
        self.open(completion, first);
    }
}
