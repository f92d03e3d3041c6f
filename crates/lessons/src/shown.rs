//! A lesson as it is read: its HTML, and what changes when its reader sets something.

mod article;
mod contents;

use serde::Serialize;

use crate::course::{Course, Courses};
use crate::lesson::{Lesson, Outcome};
use crate::setting::Setting;
use crate::text::{LessonText, Renderer, Symbol, TextError, Words, glossary, page_words};

pub use contents::{contents, plan};

/// What a change of a control changes on the page.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Patch {
    /// The figure.
    pub figure: String,
    /// Numbers by name, as they are shown.
    pub values: Vec<(String, String)>,
    /// Checks by name: whether they pass, and the words on it.
    pub checks: Vec<(String, bool, String)>,
    /// Controls by name: number, and as it is shown.
    pub controls: Vec<(String, f64, String)>,
}

/// Lesson that somebody reads.
pub struct Reader {
    course: &'static Course,
    place: usize,
    lesson: &'static Lesson,
    text: LessonText<'static>,
    words: Words,
    page: Words,
    glossary: Words,
    setting: Setting,
    outcome: Outcome,
}

impl Reader {
    /// Opens the lesson of that name as it is at the start; `None` where there is none.
    pub fn open(courses: Courses, name: &str) -> Option<Result<Self, TextError>> {
        let (course, place, lesson) = courses.find(name)?;
        Some(Self::of(course, place, lesson))
    }

    fn of(
        course: &'static Course,
        place: usize,
        lesson: &'static Lesson,
    ) -> Result<Self, TextError> {
        let text = LessonText::read(lesson.text)?;
        let words = text.words()?;
        let setting = Setting::usual(lesson.controls);
        let outcome = (lesson.compute)(&setting, &words);
        Ok(Self {
            course,
            place,
            lesson,
            text,
            words,
            page: page_words(),
            glossary: glossary(),
            setting,
            outcome,
        })
    }

    /// Sets a control, and says what that changes.
    pub fn set(&mut self, control: &str, number: f64) -> Result<Patch, TextError> {
        self.set_all(&[(control, number)])
    }

    /// Sets several controls at once.
    pub fn set_all(&mut self, numbers: &[(&str, f64)]) -> Result<Patch, TextError> {
        for (control, number) in numbers {
            self.setting.set(control, *number);
        }
        self.outcome = (self.lesson.compute)(&self.setting, &self.words);
        self.patch()
    }

    /// What is shown at the reader's setting.
    pub fn patch(&self) -> Result<Patch, TextError> {
        let symbols = self.text.symbols()?;
        let renderer = self.renderer(&symbols);
        let quantity = crate::text::quantity;
        let outcome = &self.outcome;
        Ok(Patch {
            figure: self.figure(false)?,
            values: outcome
                .values
                .iter()
                .map(|it| (it.name.to_owned(), quantity(it.number, it.unit)))
                .collect(),
            checks: outcome
                .checks
                .iter()
                .map(|it| {
                    (
                        it.value.to_owned(),
                        it.passes(outcome),
                        renderer.verdict(it.value),
                    )
                })
                .collect(),
            controls: self
                .setting
                .iter()
                .map(|(control, number)| {
                    (
                        control.name.to_owned(),
                        number,
                        quantity(number, control.unit),
                    )
                })
                .collect(),
        })
    }

    /// The figure as SVG; `alone` with all that it needs to be a file.
    pub fn figure(&self, alone: bool) -> Result<String, TextError> {
        let symbols = Vec::new();
        let described = self.renderer(&symbols).plain(&self.words.get("figure"))?;
        Ok(self
            .outcome
            .figure
            .document(self.text.title, &described, alone))
    }

    /// The whole lesson as HTML.
    pub fn html(&self) -> Result<String, TextError> {
        article::article(self)
    }

    fn renderer<'a>(&'a self, symbols: &'a [Symbol<'a>]) -> Renderer<'a> {
        Renderer {
            outcome: Some(&self.outcome),
            setting: Some(&self.setting),
            words: &self.words,
            page: &self.page,
            glossary: &self.glossary,
            symbols,
        }
    }
}
