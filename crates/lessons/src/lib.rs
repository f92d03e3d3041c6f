//! Lessons on finding one's way without GPS: their words, their numbers, their figures.
//!
//! A lesson is a file of `lessons/` (what it computes and draws) with its words in `texts/en/`, and a line in the list of
//! `lessons/mod.rs`. Whatever a lesson computes, the crates of the method compute. Knows no browser: a page shows the
//! HTML and SVG that it makes.

pub mod figure;
pub mod models;
pub mod text;

mod course;
mod lesson;
mod lessons;
mod number;
mod setting;
mod shown;
mod words;

pub use course::{Course, Courses};
pub use lesson::{Check, Lesson, LessonOutcome, Value};
pub use lessons::all;
pub use number::{Written, significant};
pub use setting::{LessonControl, Setting};
pub use shown::{LessonPatch, Reader, contents, plan};
