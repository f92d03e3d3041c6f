//! The reader of a lesson: opens it, sets its controls.

use serde::Serialize;

use super::article::article;
use super::opened::OpenLesson;
use crate::course::Courses;
use crate::text::{TextError, quantity};

/// Change of the page that a change of a control makes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LessonPatch {
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
    open: OpenLesson,
}

impl Reader {
    /// Opens the lesson of that name as it is at the start; `None` where there is none.
    pub fn open(courses: Courses, name: &str) -> Option<Result<Self, TextError>> {
        let (course, place, lesson) = courses.find(name)?;
        Some(OpenLesson::new(course, place, lesson).map(|open| Self { open }))
    }

    /// Sets several controls at once.
    ///
    /// ```
    /// use pilotage_lessons::{Reader, all};
    ///
    /// let mut reader = Reader::open(all(), "wind-carries").ok_or("there is no such lesson")??;
    /// // North at 20 m/s in a wind of 12 m/s from the west: √(20² + 12²) over the ground, atan(12 / 20) to the right.
    /// let patch = reader.set_all(&[("wind", 12.0)])?;
    /// let shown = |name: &str| patch.values.iter().find(|value| value.0 == name).map(|value| value.1.as_str());
    /// assert_eq!((shown("ground-speed"), shown("course")), (Some("23.3\u{a0}m/s"), Some("31.0°")));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_all(&mut self, numbers: &[(&str, f64)]) -> Result<LessonPatch, TextError> {
        for (control, number) in numbers {
            self.open.setting.set(control, *number);
        }
        self.open.outcome = (self.open.lesson.compute)(&self.open.setting, &self.open.words);
        self.patch()
    }

    /// Figure, numbers and checks at the reader's setting.
    pub fn patch(&self) -> Result<LessonPatch, TextError> {
        let renderer = self.open.renderer(&[]);
        let outcome = &self.open.outcome;
        Ok(LessonPatch {
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
                .open
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
        let described = self
            .open
            .renderer(&[])
            .plain(&self.open.words.get("figure"))?;
        Ok(self
            .open
            .outcome
            .figure
            .document(self.open.text.title, &described, alone))
    }

    /// The whole lesson as HTML.
    pub fn html(&self) -> Result<String, TextError> {
        article(&self.open)
    }
}
