//! Field in which people read a number and change it.

use std::ops::RangeInclusive;

use egui::emath::Numeric;
use egui::response::Flags;
use egui::{DragValue, Response, Ui};

/// Degrees in a radian, and their sign.
const DEGREES: (f64, &str) = (180.0 / std::f64::consts::PI, "°");

/// Field for a number, in the unit that people read. A number that is only looked at stays what it is, to the last bit:
/// neither the range, nor the decimals that are shown, nor the keyboard on its way through the field change it.
///
/// ```
/// use pilotage_ui::shell::NumberField;
///
/// // A leg that a file flies at 3 m/s, in a field for 5 to 100.
/// let mut speed = 3.0;
/// let context = egui::Context::default();
/// let mut output = context.run_ui(egui::RawInput::default(), |ui| {
///     let field = NumberField::new(5.0..=100.0).unit((1.0, "m/s"));
///     assert!(!field.show(ui, &mut speed).changed());
/// });
/// assert_eq!(speed, 3.0);
/// output.textures_delta.clear();
/// ```
pub struct NumberField<'a> {
    factor: f64,
    range: RangeInclusive<f64>,
    speed: f64,
    decimals: usize,
    prefix: &'static str,
    suffix: String,
    words: Option<Box<dyn Fn(f64) -> String + 'a>>,
}

impl<'a> NumberField<'a> {
    /// A field for numbers of a range, in the unit of the number itself, whatever unit is shown.
    pub fn new(range: RangeInclusive<f64>) -> Self {
        Self {
            factor: 1.0,
            range,
            speed: 1.0,
            decimals: 0,
            prefix: "",
            suffix: String::new(),
            words: None,
        }
    }

    /// A field for a whole number, as slow as those change.
    pub fn whole<N: Numeric>(range: RangeInclusive<N>) -> Self {
        let range = range.start().to_f64()..=range.end().to_f64();
        Self::new(range).speed(0.25)
    }

    /// Shows the number times a factor, with its unit behind it.
    #[must_use]
    pub fn unit(self, (factor, unit): (f64, &str)) -> Self {
        let gap = if unit == "°" { "" } else { " " };
        Self { factor, ..self }.suffix(format!("{gap}{unit}"))
    }

    /// Shows radians in degrees.
    #[must_use]
    pub fn degrees(self) -> Self {
        self.unit(DEGREES)
    }

    /// Change per point of a drag, and per press of an arrow, in the unit that is shown.
    #[must_use]
    pub fn speed(self, speed: f64) -> Self {
        Self { speed, ..self }
    }

    /// Number of decimals that are shown.
    #[must_use]
    pub fn decimals(self, decimals: usize) -> Self {
        Self { decimals, ..self }
    }

    /// Something before the number.
    #[must_use]
    pub fn prefix(self, prefix: &'static str) -> Self {
        Self { prefix, ..self }
    }

    /// Something behind the number, in place of the unit alone.
    #[must_use]
    pub fn suffix(self, suffix: impl Into<String>) -> Self {
        Self {
            suffix: suffix.into(),
            ..self
        }
    }

    /// Words for the number as it is shown, its unit with it.
    #[must_use]
    pub fn words(self, words: impl Fn(f64) -> String + 'a) -> Self {
        Self {
            suffix: String::new(),
            words: Some(Box::new(words)),
            ..self
        }
    }

    /// Draws it. The response says that it is changed where `value` is another number than before.
    pub fn show<N: Numeric>(self, ui: &mut Ui, value: &mut N) -> Response {
        let (field, new) = self.add(ui, value.to_f64(), N::INTEGRAL);
        if let Some(new) = new {
            *value = N::from_f64(new);
        }
        field
    }

    /// Draws it for the number `own`; the new number, if it is another one.
    fn add(self, ui: &mut Ui, own: f64, is_whole: bool) -> (Response, Option<f64>) {
        // What was set here is shown as it was said: through the unit and back it may be another number, at which the text
        // that somebody is typing would be thrown away.
        let id = ui.next_auto_id().with("said");
        let said = ui.data(|it| it.get_temp::<(f64, f64, f64)>(id));
        let said = said.filter(|it| (it.0, it.1) == (own, self.factor));
        let old = said.map_or(own * self.factor, |it| it.2);
        // A number that came from elsewhere may lie beyond what can be set here.
        let least = (self.range.start() * self.factor).min(old);
        let most = (self.range.end() * self.factor).max(old);
        let (formatter, decimals) = (ui.style().number_formatter.clone(), self.decimals);
        let words = self.words;
        let words = move |value: f64| match &words {
            Some(words) => words(value),
            None => formatter.format(value, decimals..=decimals),
        };
        let is_shown = words(old);
        let parse = move |text: &str| {
            // What was only shown is no number that somebody stated.
            if text == is_shown {
                return Some(old);
            }
            typed_number(text).map(|it| if is_whole { it.round() } else { it })
        };
        let mut shown = old;
        let field = DragValue::new(&mut shown)
            .range(least..=most)
            .speed(self.speed)
            .fixed_decimals(decimals)
            .prefix(self.prefix)
            .suffix(self.suffix)
            .custom_formatter(move |value, _| words(value))
            .custom_parser(parse);
        let mut field = ui.add(field);
        // Arrows lead beyond the range.
        let new = shown.max(least).min(most);
        let set = new / self.factor;
        if new == old || set == own {
            field.flags.remove(Flags::CHANGED);
            return (field, None);
        }
        ui.data_mut(|it| it.insert_temp(id, (set, self.factor, new)));
        (field, Some(set))
    }
}

/// Number in what somebody typed, whatever unit stands behind it.
fn typed_number(text: &str) -> Option<f64> {
    let text = text.replace('\u{2212}', "-");
    let text: String = text.chars().filter(|it| !it.is_whitespace()).collect();
    let number = text.trim_end_matches(|it: char| it.is_alphabetic() || "°%×".contains(it));
    number.parse().ok().filter(|it: &f64| it.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Context, Event, Key, Modifiers, RawInput};

    /// Frames of a page with nothing but a field, which has the keyboard from the second to the last but one of them, and in
    /// between `events`; the number afterwards, and whether it was ever said to be changed.
    fn after(
        field: impl Fn() -> NumberField<'static>,
        mut value: f64,
        events: &[Event],
    ) -> (f64, bool) {
        let context = Context::default();
        let mut is_changed = false;
        let count = events.len() + 4;
        for number in 0..count {
            let event = number.checked_sub(3).and_then(|at| events.get(at)).cloned();
            let input = RawInput {
                events: event.into_iter().collect(),
                ..RawInput::default()
            };
            let mut output = context.run_ui(input, |ui| {
                if number == 1 {
                    let id = ui.next_auto_id();
                    ui.memory_mut(|it| it.request_focus(id));
                }
                let response = field().show(ui, &mut value);
                is_changed |= response.changed();
                if number == count - 2 {
                    response.surrender_focus();
                }
            });
            output.textures_delta.clear();
        }
        (value, is_changed)
    }

    fn key(key: Key) -> Event {
        Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        }
    }

    #[test]
    fn a_number_that_the_keyboard_only_passes_stays_what_it_is() {
        let knots = || NumberField::new(5.0..=100.0).unit((1.943_844, "kt"));
        for value in [18.867, 3.0, 250.0, 1.0 / 3.0] {
            assert_eq!(after(knots, value, &[]), (value, false));
        }
        let words = || NumberField::new(0.0..=1.0).words(|_| "7 s".to_owned());
        assert_eq!(after(words, 9.25, &[]), (9.25, false));
    }

    #[test]
    fn a_number_that_is_typed_is_taken_in_its_unit_and_within_the_range_in_it() {
        let feet = || NumberField::new(0.0..=5000.0).unit((1.0 / 0.3048, "ft"));
        let typed = |text: &str| after(feet, 120.0, &[Event::Text(text.to_owned())]);
        let close = |typed: (f64, bool), wanted: f64| {
            assert!(typed.1 && (typed.0 - wanted).abs() < 1e-9, "{typed:?}");
        };
        close(typed("500"), 152.4);
        close(typed("500 ft"), 152.4);
        close(typed("16000"), 4876.8);
        close(typed("17000"), 5000.0);
        close(typed("\u{2212}3"), 0.0);
        for nothing in ["nan", "inf", "high"] {
            assert_eq!(typed(nothing), (120.0, false), "{nothing}");
        }
    }

    /// 7 ft in metres and back are another number.
    #[test]
    fn a_decimal_that_is_typed_behind_a_whole_number_is_kept() {
        let field = || {
            let feet = NumberField::new(0.0..=60.0).unit((1.0 / 0.3048, "ft"));
            feet.decimals(1)
        };
        let typed = ["7", ".", "5"].map(|text| Event::Text(text.to_owned()));
        let (metres, is_changed) = after(field, 3.0, &typed);
        assert!(
            is_changed && (metres - 7.5 * 0.3048).abs() < 1e-12,
            "{metres}"
        );
    }

    #[test]
    fn arrows_step_within_the_range() {
        let share = || NumberField::new(0.0..=0.95).unit((100.0, "%"));
        let press = |times| after(share, 0.94, &vec![key(Key::ArrowUp); times]);
        let is_most = |it: (f64, bool)| (it.0 - 0.95).abs() < 1e-12;
        assert!(is_most(press(1)), "{:?}", press(1));
        assert!(is_most(press(3)), "{:?}", press(3));
    }

    #[test]
    fn whole_numbers_are_rounded() {
        let context = Context::default();
        let mut count = 7_u32;
        let mut output = context.run_ui(RawInput::default(), |ui| {
            let field = NumberField::whole(1..=99_u32).show(ui, &mut count);
            assert!(!field.changed());
        });
        output.textures_delta.clear();
        assert_eq!(count, 7);
        let whole = NumberField::whole(1..=99_u32);
        assert_eq!((whole.range, whole.decimals), (1.0..=99.0, 0));
    }
}
