//! Pieces of a JSON text that keep their place in it.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use serde_json::value::RawValue;

use super::MissionError;

/// Members of an object as they stand in the text.
pub(crate) type ObjectMembers<'a> = BTreeMap<String, &'a RawValue>;

/// The whole text, to find the line of a piece of it.
pub(crate) struct Text<'a>(pub(crate) &'a str);

impl<'a> Text<'a> {
    /// Line and column of the beginning of `piece`, counted from one.
    fn place(&self, piece: &str) -> (usize, usize) {
        // Pieces are borrowed from the text, so that the difference of addresses is their offset.
        let offset = (piece.as_ptr() as usize)
            .wrapping_sub(self.0.as_ptr() as usize)
            .min(self.0.len());
        let before = self.0.get(..offset).unwrap_or("");
        let line_begin = before.rfind('\n').map_or(0, |i| i + 1);
        let lines = before.bytes().filter(|b| *b == b'\n').count();
        (lines + 1, offset - line_begin + 1)
    }

    /// A complaint about `piece`.
    pub(crate) fn error(&self, piece: &str, cause: impl Into<String>) -> MissionError {
        let (line, column) = self.place(piece);
        MissionError::Json {
            line,
            column,
            cause: cause.into(),
        }
    }

    /// Line of the beginning of `piece`.
    pub(crate) fn line(&self, piece: &str) -> usize {
        self.place(piece).0
    }

    fn json_error(&self, piece: &str, error: &serde_json::Error) -> MissionError {
        let (line, column) = self.place(piece);
        let text = error.to_string();
        let cause = text
            .rfind(" at line ")
            .map_or(text.as_str(), |i| &text[..i]);
        MissionError::Json {
            line: line + error.line().max(1) - 1,
            column: if error.line() <= 1 {
                column + error.column().max(1) - 1
            } else {
                error.column()
            },
            cause: cause.to_owned(),
        }
    }

    /// Members of the object that `piece` is.
    pub(crate) fn members(&self, piece: &'a str) -> Result<ObjectMembers<'a>, MissionError> {
        serde_json::from_str(piece).map_err(|e| self.json_error(piece, &e))
    }

    /// Elements of the array that `piece` is.
    pub(crate) fn elements(&self, piece: &'a str) -> Result<Vec<&'a RawValue>, MissionError> {
        serde_json::from_str(piece).map_err(|e| self.json_error(piece, &e))
    }

    /// The value that `piece` stands for, which may borrow from the text.
    pub(crate) fn read<T: serde::Deserialize<'a>>(
        &self,
        piece: &'a str,
    ) -> Result<T, MissionError> {
        serde_json::from_str(piece).map_err(|e| self.json_error(piece, &e))
    }

    /// The value that `piece` stands for.
    pub(crate) fn value<T: DeserializeOwned>(&self, piece: &str) -> Result<T, MissionError> {
        serde_json::from_str(piece).map_err(|e| self.json_error(piece, &e))
    }

    /// Takes a member out and reads it; `None` if it is absent or null.
    pub(crate) fn take<T: DeserializeOwned>(
        &self,
        members: &mut ObjectMembers<'a>,
        name: &str,
    ) -> Result<Option<T>, MissionError> {
        match members.remove(name) {
            Some(piece) => self.value(piece.get()),
            None => Ok(None),
        }
    }
}
