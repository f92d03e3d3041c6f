//! Markdown with numbers, controls and equations, as HTML.

use std::fmt::Write as _;

use pilotage_base::text::without_markup;
use pulldown_cmark::{CowStr, Event, Options, Parser, html};

use super::directive::{Directive, Piece, pieces};
use super::equation::mathml;
use super::error::TextError;
use super::symbol::Symbol;
use crate::lesson::LessonOutcome;
use crate::number::significant;
use crate::setting::{LessonControl, Setting};
use crate::words::Words;

/// Maker of HTML from the texts of a lesson.
pub struct Renderer<'a> {
    /// Outcome of the lesson at the reader's setting; nothing for texts of courses.
    pub outcome: Option<&'a LessonOutcome>,
    /// The reader's setting.
    pub setting: Option<&'a Setting>,
    /// Words of the lesson.
    pub words: &'a Words,
    /// Words of the page.
    pub page: &'a Words,
    /// Terms that texts may mark.
    pub glossary: &'a Words,
    /// Symbols of the equations.
    pub symbols: &'a [Symbol<'a>],
}

impl Renderer<'_> {
    /// HTML of a text of several paragraphs.
    pub fn block(&self, text: &str) -> Result<String, TextError> {
        let mut whole = String::new();
        for piece in pieces(text)? {
            match piece {
                Piece::Markdown(markdown) => whole.push_str(&self.with_terms(markdown)),
                Piece::Directive(directive) => whole.push_str(&self.directive(&directive)),
            }
        }
        let parser = Parser::new_ext(&whole, Options::ENABLE_MATH | Options::ENABLE_TABLES);
        let mut fault = None;
        let mut equation = |latex: &str, display: bool| match mathml(latex, display, self.symbols) {
            Ok(made) => Event::InlineHtml(CowStr::from(made)),
            Err(error) => {
                fault = Some(error);
                Event::Text(CowStr::Borrowed(""))
            }
        };
        let events = parser.map(|event| match event {
            Event::InlineMath(latex) => equation(&latex, false),
            Event::DisplayMath(latex) => equation(&latex, true),
            other => other,
        });
        let mut made = String::new();
        html::push_html(&mut made, events);
        fault.map_or(Ok(made), Err)
    }

    /// HTML of a text of one line, without a paragraph around it.
    pub fn line(&self, text: &str) -> Result<String, TextError> {
        let made = self.block(text)?;
        let inner = made.trim();
        let inner = inner
            .strip_prefix("<p>")
            .and_then(|it| it.strip_suffix("</p>"));
        Ok(inner.map_or_else(|| made.clone(), str::to_owned))
    }

    /// Text alone, of a line with numbers: for whoever does not see the figure.
    pub fn plain(&self, text: &str) -> Result<String, TextError> {
        let parts = pieces(text)?.into_iter().map(|piece| match piece {
            Piece::Markdown(markdown) => markdown.to_owned(),
            Piece::Directive(Directive::Live(name)) => self.number(name),
            Piece::Directive(_) => String::new(),
        });
        Ok(parts.collect())
    }

    /// Marked terms, `[[innovation]]` or `[[innovations|innovation]]`, with their meaning.
    fn with_terms(&self, markdown: &str) -> String {
        let mut made = String::new();
        let mut rest = markdown;
        while let Some((before, after)) = rest.split_once("[[") {
            let Some((term, tail)) = after.split_once("]]") else {
                break;
            };
            let (shown, key) = term.split_once('|').unwrap_or((term, term));
            let meaning = self.glossary.get(&key.to_lowercase());
            let _ = write!(
                made,
                r#"{before}<button type="button" class="term" data-meaning="{}">{shown}</button>"#,
                without_markup(&meaning)
            );
            rest = tail;
        }
        made.push_str(rest);
        made
    }

    fn number(&self, name: &str) -> String {
        let value = self.outcome.and_then(|outcome| outcome.value(name));
        value.map_or_else(
            || format!("⟦{name}⟧"),
            |value| quantity(value.number, value.unit),
        )
    }

    fn bound(&self, name: &str, pick: impl Fn(&crate::lesson::Check) -> f64) -> String {
        let check = self
            .outcome
            .and_then(|outcome| outcome.checks.iter().find(|check| check.value == name));
        let unit = self
            .outcome
            .and_then(|outcome| outcome.value(name))
            .map_or("", |value| value.unit);
        check.map_or_else(|| format!("⟦{name}⟧"), |check| quantity(pick(check), unit))
    }

    fn directive(&self, directive: &Directive<'_>) -> String {
        match directive {
            Directive::Live(name) => {
                format!(
                    r#"<output data-value="{name}">{}</output>"#,
                    self.number(name)
                )
            }
            Directive::Low(name) => self.bound(name, |check| check.low),
            Directive::High(name) => self.bound(name, |check| check.high),
            Directive::Written { number, unit, .. } => {
                let space = if unit.is_empty() || *unit == "°" {
                    ""
                } else {
                    "\u{a0}"
                };
                format!("{number}{space}{unit}")
            }
            Directive::Control(name) => self.control(name),
            Directive::Set(setting, words) => button("set", setting, words),
            Directive::Passes(setting) => button("set passes", setting, &self.page.get("passing")),
            Directive::Check(name) => format!(
                r#"<output class="check" data-check="{name}">{}</output>"#,
                self.verdict(name)
            ),
            Directive::Flight(stop, words) => {
                format!(
                    r#"<a class="flight" data-stop="{stop}" href="./#tour={stop}" target="pilotage">{words}</a>"#
                )
            }
        }
    }

    /// Words on whether a number passes.
    pub(crate) fn verdict(&self, name: &str) -> String {
        let passes = self.outcome.is_some_and(|outcome| {
            outcome
                .checks
                .iter()
                .any(|check| check.value == name && check.passes(outcome))
        });
        self.page.get(if passes { "passed" } else { "not-passed" })
    }

    fn control(&self, name: &str) -> String {
        let found = self
            .setting
            .and_then(|setting| setting.iter().find(|(own, _)| own.name == name));
        let Some((control, number)) = found else {
            return format!("⟦{name}⟧");
        };
        let label = self.words.get(&format!("control.{name}"));
        if control.choice {
            return self.choice(control, number, &label);
        }
        let LessonControl {
            least, most, step, ..
        } = control;
        let text = without_markup(&quantity(number, control.unit));
        format!(
            r#"<label class="control"><span>{label}</span><input type="range" data-control="{name}" min="{least}" max="{most}" step="{step}" value="{number}" aria-valuetext="{text}"><output data-control-value="{name}">{text}</output></label>"#
        )
    }

    fn choice(&self, control: &LessonControl, number: f64, label: &str) -> String {
        let name = control.name;
        let mut made = format!(r#"<fieldset class="control"><legend>{label}</legend>"#);
        for index in 0..=control.most as usize {
            let words = self.words.get(&format!("{name}.{index}"));
            let checked = if index == number as usize {
                " checked"
            } else {
                ""
            };
            let _ = write!(
                made,
                r#"<label><input type="radio" name="control-{name}" data-control="{name}" value="{index}"{checked}>{words}</label>"#
            );
        }
        made + "</fieldset>"
    }
}

/// Number with its unit as the page shows it.
pub(crate) fn quantity(number: f64, unit: &str) -> String {
    let space = if unit.is_empty() || unit == "°" {
        ""
    } else {
        "\u{a0}"
    };
    // What is counted is whole.
    let is_count = unit.is_empty() && number.fract() == 0.0 && number.abs() < 1e6;
    let number = if is_count {
        format!("{number:.0}").replace('-', "\u{2212}")
    } else {
        significant(number)
    };
    format!("{number}{space}{unit}")
}

fn button(class: &str, setting: &[(&str, f64)], words: &str) -> String {
    let pairs: Vec<String> = setting
        .iter()
        .map(|(name, number)| format!("{name}={number}"))
        .collect();
    format!(
        r#"<button type="button" class="{class}" data-set="{}">{words}</button>"#,
        pairs.join(",")
    )
}
