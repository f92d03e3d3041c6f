//! From words to a tree, by how tightly operators bind (Pratt 1973, "Top down operator precedence").

use std::ops::Range;

use super::evaluate::seconds_of;
use super::nearest::nearest;
use super::token::{Placed, Token, tokens};
use super::tree::{ExpressionNode, ExpressionPart, Operator};
use super::{Expression, ExpressionError, FUNCTIONS, Function, Trouble};

/// Parts within each other that nobody writes, but that would fill the stack.
const DEEPEST: usize = 64;
/// Words that nobody writes; each may be one part within the other.
const LONGEST: usize = 1000;
/// Binding power of a sign: more than a product, less than a power.
const SIGN: u8 = 7;

/// Name of a missing operand in an error.
const OPERAND: &str = "a name, a number or `(`";

impl Expression {
    /// Reads an expression. Whether there are series of these names, [`Expression::check`] says.
    ///
    /// # Errors
    /// What is wrong and where, as bytes of `text`.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        parse(text).map(|root| Self { root })
    }
}

/// Reads an expression.
fn parse(text: &str) -> Result<ExpressionPart, ExpressionError> {
    let tokens = tokens(text)?;
    if let Some((_, place)) = tokens.get(LONGEST) {
        return Err(ExpressionError::new(place.clone(), Trouble::TooLong));
    }
    let mut parser = Parser {
        tokens,
        next: 0,
        end: text.trim_end().len(),
        text,
        depth: 0,
    };
    let root = parser.part(0)?;
    if parser.peek().is_some() {
        return Err(parser.expected("an operator"));
    }
    let mut has_series = false;
    root.visit_series(&mut |_, _| has_series = true);
    if !has_series {
        return Err(ExpressionError::new(root.place, Trouble::NoSeries));
    }
    Ok(root)
}

struct Parser<'a> {
    tokens: Vec<Placed>,
    next: usize,
    end: usize,
    text: &'a str,
    depth: usize,
}

/// An operator, and how tightly it binds what stands to its left and to its right.
fn binary(sign: &str) -> Option<(Operator, u8, u8)> {
    Some(match sign {
        "<" => (Operator::Less, 1, 2),
        "<=" => (Operator::LessOrEqual, 1, 2),
        ">" => (Operator::Greater, 1, 2),
        ">=" => (Operator::GreaterOrEqual, 1, 2),
        "==" => (Operator::Equal, 1, 2),
        "!=" => (Operator::NotEqual, 1, 2),
        "+" => (Operator::Add, 3, 4),
        "-" => (Operator::Subtract, 3, 4),
        "*" => (Operator::Multiply, 5, 6),
        "/" => (Operator::Divide, 5, 6),
        "%" => (Operator::Modulo, 5, 6),
        "^" => (Operator::Power, 10, 9),
        _ => return None,
    })
}

impl Parser<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(token, _)| token)
    }

    fn take(&mut self) -> Option<Placed> {
        let taken = self.tokens.get(self.next).cloned();
        self.next += usize::from(taken.is_some());
        taken
    }

    /// That something else should stand at the next word.
    fn expected(&self, expected: &'static str) -> ExpressionError {
        let place = self.tokens.get(self.next).map(|(_, place)| place.clone());
        let place = place.unwrap_or(self.end..self.end);
        let found = self.text[place.clone()].to_owned();
        ExpressionError::new(place, Trouble::Expected { expected, found })
    }

    /// A part whose operators bind at least so tightly.
    fn part(&mut self, least: u8) -> Result<ExpressionPart, ExpressionError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            let place = self.tokens.get(self.next).map(|(_, place)| place.clone());
            let place = place.unwrap_or(self.end..self.end);
            return Err(ExpressionError::new(place, Trouble::TooDeep));
        }
        let mut left = self.operand()?;
        while let Some(Token::Operator(sign)) = self.peek() {
            let Some((operator, to_left, to_right)) = binary(sign) else {
                break;
            };
            if to_left < least {
                break;
            }
            self.next += 1;
            let right = self.part(to_right)?;
            let place = left.place.start..right.place.end;
            let node = ExpressionNode::Binary(operator, Box::new([left, right]));
            left = ExpressionPart { node, place };
        }
        self.depth -= 1;
        Ok(left)
    }

    fn operand(&mut self) -> Result<ExpressionPart, ExpressionError> {
        let Some((token, place)) = self.take() else {
            return Err(self.expected(OPERAND));
        };
        let node = match token {
            Token::Number(number) => ExpressionNode::Number(number),
            Token::Operator("-") => {
                let part = self.part(SIGN)?;
                let place = place.start..part.place.end;
                let node = ExpressionNode::Negative(Box::new(part));
                return Ok(ExpressionPart { node, place });
            }
            Token::Operator("+") => return self.part(SIGN),
            Token::Open => {
                let inner = self.part(0)?;
                let close = self.close()?;
                return Ok(ExpressionPart {
                    node: inner.node,
                    place: place.start..close.end,
                });
            }
            Token::Name { name, braced: true } => ExpressionNode::Series(name),
            Token::Name { name, .. } if self.peek() == Some(&Token::Open) => {
                return self.call(&name, place);
            }
            Token::Name { name, .. } => match name.as_str() {
                "pi" => ExpressionNode::Number(std::f64::consts::PI),
                "time" => ExpressionNode::Time,
                _ if Function::named(&name).is_some() => {
                    return Err(self.expected("`(` after a function"));
                }
                _ => ExpressionNode::Series(name),
            },
            Token::Operator(_) | Token::Close | Token::Comma => {
                self.next -= 1;
                return Err(self.expected(OPERAND));
            }
        };
        Ok(ExpressionPart { node, place })
    }

    fn close(&mut self) -> Result<Range<usize>, ExpressionError> {
        match self.tokens.get(self.next) {
            Some((Token::Close, place)) => {
                let place = place.clone();
                self.next += 1;
                Ok(place)
            }
            _ => Err(self.expected("`)` or an operator")),
        }
    }

    /// The arguments of a function, from the opening parenthesis on.
    fn call(&mut self, name: &str, place: Range<usize>) -> Result<ExpressionPart, ExpressionError> {
        let Some(function) = Function::named(name) else {
            let names = FUNCTIONS.iter().map(|info| info.name);
            let trouble = Trouble::UnknownFunction {
                name: name.to_owned(),
                nearest: nearest(name, names).map(str::to_owned),
            };
            return Err(ExpressionError::new(place, trouble));
        };
        self.next += 1;
        let mut arguments = Vec::new();
        if self.peek() != Some(&Token::Close) {
            arguments.push(self.part(0)?);
            while self.peek() == Some(&Token::Comma) {
                self.next += 1;
                arguments.push(self.part(0)?);
            }
        }
        let end = match self.tokens.get(self.next) {
            Some((Token::Close, place)) => place.end,
            _ => return Err(self.expected("`,`, `)` or an operator")),
        };
        self.next += 1;
        let place = place.start..end;
        let (least, most, wanted) = function.arguments();
        if !(least..=most).contains(&arguments.len()) {
            let trouble = Trouble::Arguments {
                function: function.info().name,
                wanted,
                given: arguments.len(),
            };
            return Err(ExpressionError::new(place, trouble));
        }
        seconds_of(function, &arguments)?;
        let node = ExpressionNode::Call(function, arguments);
        Ok(ExpressionPart { node, place })
    }
}
