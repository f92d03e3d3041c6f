//! An open lesson: its text and what it computed.

use crate::course::Course;
use crate::lesson::{Lesson, LessonOutcome};
use crate::setting::Setting;
use crate::text::{LessonText, Renderer, Symbol, TextError, Words, glossary, page_words};

/// Open lesson with its course, its words and its outcome at the reader's setting.
pub(super) struct OpenLesson {
    /// Course to which it belongs.
    pub course: &'static Course,
    /// Number in the course, from 0.
    pub place: usize,
    /// The lesson.
    pub lesson: &'static Lesson,
    /// Its text.
    pub text: LessonText<'static>,
    /// Words of its figure and controls.
    pub words: Words,
    /// Words of the page.
    pub page: Words,
    /// Terms.
    pub glossary: Words,
    /// The reader's setting.
    pub setting: Setting,
    /// Figure and numbers at that setting.
    pub outcome: LessonOutcome,
}

impl OpenLesson {
    /// Opens a lesson as it is at the start.
    pub fn new(
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

    /// Maker of its HTML.
    pub fn renderer<'a>(&'a self, symbols: &'a [Symbol<'a>]) -> Renderer<'a> {
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
