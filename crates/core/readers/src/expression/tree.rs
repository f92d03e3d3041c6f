//! The tree of an expression.

use std::ops::Range;

use super::Function;

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
pub(super) enum ExpressionNode {
    /// A number.
    Number(f64),
    /// Seconds in the log's time base.
    Time,
    /// A series of the log.
    Series(String),
    /// The other sign.
    Negative(Box<ExpressionPart>),
    /// Two parts made one.
    Binary(Operator, Box<[ExpressionPart; 2]>),
    /// A function.
    Call(Function, Vec<ExpressionPart>),
}

/// A part of an expression and its bytes in the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ExpressionPart {
    pub node: ExpressionNode,
    pub place: Range<usize>,
}

impl ExpressionPart {
    /// The parts that it is made of.
    pub fn parts(&self) -> &[ExpressionPart] {
        match &self.node {
            ExpressionNode::Number(_) | ExpressionNode::Time | ExpressionNode::Series(_) => &[],
            ExpressionNode::Negative(part) => std::slice::from_ref(part),
            ExpressionNode::Binary(_, parts) => &**parts,
            ExpressionNode::Call(_, parts) => parts,
        }
    }

    /// Calls `visit` with every series in the order of the text.
    pub fn visit_series<'a>(&'a self, visit: &mut dyn FnMut(&'a str, &Range<usize>)) {
        if let ExpressionNode::Series(name) = &self.node {
            visit(name, &self.place);
        }
        for part in self.parts() {
            part.visit_series(visit);
        }
    }
}
