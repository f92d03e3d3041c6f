//! An expression that was read.

use super::nearest::nearest;
use super::tree::{ExpressionNode, ExpressionPart};
use super::{ExpressionError, Trouble, written};

/// An expression whose words fit together.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    pub(super) root: ExpressionPart,
}

impl Expression {
    /// Names of the series in it, each once, in the order of the text.
    pub fn names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        self.root.visit_series(&mut |name, _| {
            if !names.contains(&name) {
                names.push(name);
            }
        });
        names
    }

    /// Checks that all series of the expression are among `names`.
    ///
    /// # Errors
    /// The first that is not, and the most similar name that is there.
    pub fn check<'a>(
        &self,
        names: &(impl Iterator<Item = &'a str> + Clone),
    ) -> Result<(), ExpressionError> {
        let mut error = None;
        self.root.visit_series(&mut |name, place| {
            if error.is_none() && !names.clone().any(|known| known == name) {
                let trouble = Trouble::UnknownSeries {
                    name: name.to_owned(),
                    nearest: nearest(name, names.clone()).map(written),
                };
                error = Some(ExpressionError::new(place.clone(), trouble));
            }
        });
        error.map_or(Ok(()), Err)
    }

    /// The expression is one series alone: its name.
    pub fn single(&self) -> Option<&str> {
        match &self.root.node {
            ExpressionNode::Series(name) => Some(name),
            _ => None,
        }
    }
}
