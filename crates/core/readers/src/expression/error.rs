//! Errors of an expression, with their places.

use std::fmt;
use std::ops::Range;

/// Kind of error in an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// Something else should stand here.
    Expected {
        /// Description of the text that should stand here.
        expected: &'static str,
        /// Text that stands here; empty at the end.
        found: String,
    },
    /// A sign that means nothing.
    StrangeSign(char),
    /// A brace that is never closed.
    OpenBrace,
    /// No series is called so.
    UnknownSeries {
        /// The name.
        name: String,
        /// The most similar one that there is.
        nearest: Option<String>,
    },
    /// No function is called so.
    UnknownFunction {
        /// The name.
        name: String,
        /// The most similar one that there is.
        nearest: Option<String>,
    },
    /// A function has too few arguments or too many.
    Arguments {
        /// Its name.
        function: &'static str,
        /// Number and kind of arguments that the function takes, in words.
        wanted: &'static str,
        /// Number of arguments that it was given.
        given: usize,
    },
    /// Length of time that depends on a series or on the time, or is not finite.
    NotConstant,
    /// A length of time that is not above zero.
    NotPositive,
    /// Nothing in it is a series of the log.
    NoSeries,
    /// Parentheses within parentheses beyond reason.
    TooDeep,
    /// More words than anybody writes.
    TooLong,
}

/// Error of an expression, with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionError {
    /// Bytes of the text that are meant; empty at its end where something is missing.
    pub place: Range<usize>,
    /// Kind of error.
    pub trouble: Trouble,
}

impl ExpressionError {
    pub(super) fn new(place: Range<usize>, trouble: Trouble) -> Self {
        Self { place, trouble }
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let maybe = |f: &mut fmt::Formatter<'_>, nearest: &Option<String>| match nearest {
            Some(nearest) => write!(f, "; did you mean {nearest}?"),
            None => Ok(()),
        };
        match self {
            Self::Expected { expected, found } if found.is_empty() => {
                write!(f, "{expected} is missing at the end")
            }
            Self::Expected { expected, found } => {
                write!(f, "{expected} should stand here, not `{found}`")
            }
            Self::StrangeSign(sign) => write!(f, "`{sign}` means nothing here"),
            Self::OpenBrace => f.write_str("this brace is never closed"),
            Self::UnknownSeries { name, nearest } => {
                write!(f, "no series is called {name}")?;
                maybe(f, nearest)
            }
            Self::UnknownFunction { name, nearest } => {
                write!(f, "no function is called {name}")?;
                maybe(f, nearest)
            }
            Self::Arguments {
                function,
                wanted,
                given,
            } => write!(f, "{function} takes {wanted}, not {given}"),
            Self::NotConstant => f.write_str("a number should stand here, the same for all times"),
            Self::NotPositive => f.write_str("this should be more than 0 seconds"),
            Self::NoSeries => f.write_str("no series of the log is named"),
            Self::TooDeep => f.write_str("too many parentheses within each other"),
            Self::TooLong => f.write_str("the expression is too long"),
        }
    }
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at byte {}: {}", self.place.start, self.trouble)
    }
}

impl std::error::Error for ExpressionError {}
