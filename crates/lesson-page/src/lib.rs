//! The program of the page of lessons: opens a lesson, and says what a change of a control changes.
#![cfg(target_arch = "wasm32")]

use std::collections::BTreeMap;

use pilotage_lessons::{Courses, Reader, all};
use wasm_bindgen::prelude::wasm_bindgen;

/// Lessons as the page has them.
#[wasm_bindgen]
pub struct LessonPage {
    courses: Courses,
    reader: Option<Reader>,
}

#[wasm_bindgen]
impl LessonPage {
    /// Page without an open lesson.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        console_error_panic_hook::set_once();
        Self {
            courses: all(),
            reader: None,
        }
    }

    /// Colours of the figures, as a style sheet.
    pub fn style(&self) -> String {
        pilotage_lessons::figure::STYLE.to_owned()
    }

    /// Words of the page around lessons by their keys, as JSON.
    pub fn words(&self) -> Result<String, String> {
        let words = pilotage_lessons::text::page_words();
        let words: BTreeMap<&str, &str> = words.iter().collect();
        serde_json::to_string(&words).map_err(|error| error.to_string())
    }

    /// Names of all lessons in their order, by course, as JSON: `[[course, [lesson, …]], …]`.
    pub fn list(&self) -> Result<String, String> {
        let names: Vec<(&str, Vec<&str>)> = self
            .courses
            .0
            .iter()
            .map(|course| {
                (
                    course.name,
                    course.lessons.iter().map(|lesson| lesson.name).collect(),
                )
            })
            .collect();
        serde_json::to_string(&names).map_err(|error| error.to_string())
    }

    /// HTML of all courses.
    pub fn contents(&self) -> Result<String, String> {
        pilotage_lessons::contents(self.courses).map_err(|error| error.to_string())
    }

    /// HTML of the plan of a presentation of a course.
    pub fn plan(&self, course: &str) -> Result<String, String> {
        let found = self.courses.0.iter().find(|own| own.name == course);
        let course = found.ok_or_else(|| format!("no course is called {course}"))?;
        pilotage_lessons::plan(course).map_err(|error| error.to_string())
    }

    /// Opens a lesson; its HTML.
    pub fn open(&mut self, name: &str) -> Result<String, String> {
        let opened = Reader::open(self.courses, name)
            .ok_or_else(|| format!("no lesson is called {name}"))?;
        let reader = opened.map_err(|error| error.to_string())?;
        let html = reader.html().map_err(|error| error.to_string())?;
        self.reader = Some(reader);
        Ok(html)
    }

    /// Sets controls, `wind=12,rate=2`, or none; what that changes, as JSON.
    pub fn set(&mut self, controls: &str) -> Result<String, String> {
        let reader = self.reader.as_mut().ok_or("no lesson is open")?;
        let numbers: Vec<(&str, f64)> = controls
            .split(',')
            .filter_map(|pair| pair.split_once('='))
            .filter_map(|(name, number)| Some((name, number.parse().ok()?)))
            .collect();
        let patch = reader
            .set_all(&numbers)
            .map_err(|error| error.to_string())?;
        serde_json::to_string(&patch).map_err(|error| error.to_string())
    }

    /// The figure as a file of its own.
    pub fn figure(&self) -> Result<String, String> {
        let reader = self.reader.as_ref().ok_or("no lesson is open")?;
        reader.figure(true).map_err(|error| error.to_string())
    }
}

impl Default for LessonPage {
    fn default() -> Self {
        Self::new()
    }
}
