//! Faults of texts.

use super::section::Section;

/// Fault of a text, with its place.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum TextError {
    /// The first line is no title.
    #[error("the text has to begin with a title: `# …`")]
    NoTitle,
    /// No line is the question.
    #[error("the text has no question: a line `> …` below the title")]
    NoQuestion,
    /// A heading that no section has.
    #[error("no section is called `{0}`")]
    UnknownSection(String),
    /// A section that stands twice.
    #[error("the section `{}` stands twice", .0.heading())]
    Twice(Section),
    /// A section that every lesson has.
    #[error("the section `{}` is missing", .0.heading())]
    Missing(Section),
    /// Braces that say nothing known.
    #[error("`{{{{{0}}}}}` is none of the forms that texts/README.md lists")]
    UnknownDirective(String),
    /// Braces without an end.
    #[error("`{{{{` without an end: {0}")]
    Open(String),
    /// A guess without options, or with none or several that are right.
    #[error("a guess has two options or more, one of them right, then its answer")]
    Guess,
    /// A line that cannot be read where a list is expected.
    #[error("`{0}` has not the parts that its section needs, with `|` between them")]
    Line(String),
    /// An equation that cannot be read.
    #[error("the equation `{equation}` cannot be read: {reason}")]
    Equation {
        /// As it stands in the text.
        equation: String,
        /// Why not.
        reason: String,
    },
}
