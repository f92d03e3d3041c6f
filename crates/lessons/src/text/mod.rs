//! Texts of lessons and courses: a small Markdown with numbers that the lesson computes. `texts/README.md` says how
//! they are written.

mod directive;
mod equation;
mod error;
mod guess;
mod html;
mod lesson_text;
mod questions;
mod section;
mod symbol;

pub use crate::words::{Words, glossary, page_words};
pub use directive::{Directive, Piece, pieces};
pub use error::TextError;
pub use guess::Guess;
pub use html::Renderer;
pub(crate) use html::quantity;
pub use lesson_text::LessonText;
pub use questions::{CourseText, Question};
pub use section::Section;
pub use symbol::Symbol;
