//! A lesson as it is read: its HTML, and what changes when its reader sets something.

mod article;
mod contents;
mod opened;
mod reader;

pub use contents::{contents, plan};
pub use reader::{LessonPatch, Reader};
