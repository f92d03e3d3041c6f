//! The tree of an expression.

use std::ops::Range;

use super::nearest::nearest;
use super::{ExpressionError, Function, Trouble, parse, written};

/// Two numbers made one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
    Power,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    NotEqual,
}

/// A part of an expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    /// A number.
    Number(f64),
    /// Seconds in the log's time base.
    Time,
    /// A series of the log.
    Series(String),
    /// The other sign.
    Negative(Box<Part>),
    /// Two parts made one.
    Binary(Operator, Box<[Part; 2]>),
    /// A function.
    Call(Function, Vec<Part>),
}

/// A part of an expression and its bytes in the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    pub node: Node,
    pub place: Range<usize>,
}

impl Part {
    /// The parts that it is made of.
    pub fn parts(&self) -> &[Part] {
        match &self.node {
            Node::Number(_) | Node::Time | Node::Series(_) => &[],
            Node::Negative(part) => std::slice::from_ref(part),
            Node::Binary(_, parts) => &**parts,
            Node::Call(_, parts) => parts,
        }
    }

    /// Calls `visit` with every series in the order of the text.
    pub fn visit_series<'a>(&'a self, visit: &mut dyn FnMut(&'a str, &Range<usize>)) {
        if let Node::Series(name) = &self.node {
            visit(name, &self.place);
        }
        for part in self.parts() {
            part.visit_series(visit);
        }
    }
}

/// An expression whose words fit together.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    pub(super) root: Part,
}

impl Expression {
    /// Reads an expression. Whether there are series of these names, [`Expression::check`] says.
    ///
    /// # Errors
    /// What is wrong and where, as bytes of `text`.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        parse::parse(text).map(|root| Self { root })
    }

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

    /// Whether all of its series are among `names`.
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
            Node::Series(name) => Some(name),
            _ => None,
        }
    }
}
