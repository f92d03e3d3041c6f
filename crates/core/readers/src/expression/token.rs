//! The words of an expression.

use std::ops::Range;

use super::{ExpressionError, Function, Trouble};

/// Part of an expression's text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// A number.
    Number(f64),
    /// A name as the log has it, without braces.
    Name {
        /// The name.
        name: String,
        /// Whether it stood in braces.
        braced: bool,
    },
    /// An operator.
    Operator(&'static str),
    /// `(`
    Open,
    /// `)`
    Close,
    /// `,`
    Comma,
}

/// A word and its bytes in the text.
pub(super) type Placed = (Token, Range<usize>);

/// Operators, the longer ones before those that they begin with, and what they are read as.
const OPERATORS: [(&str, &str); 16] = [
    ("<=", "<="),
    (">=", ">="),
    ("==", "=="),
    ("!=", "!="),
    ("<", "<"),
    (">", ">"),
    ("+", "+"),
    ("-", "-"),
    ("−", "-"),
    ("*", "*"),
    ("×", "*"),
    ("·", "*"),
    ("/", "/"),
    ("%", "%"),
    ("^", "^"),
    ("≠", "!="),
];

/// The words of a text.
pub(super) fn tokens(text: &str) -> Result<Vec<Placed>, ExpressionError> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let (token, length) = if let Some((sign, meaning)) = operator(rest) {
            (Token::Operator(meaning), sign.len())
        } else {
            match first {
                '(' => (Token::Open, 1),
                ')' => (Token::Close, 1),
                ',' => (Token::Comma, 1),
                '{' => braced(rest, at)?,
                _ if number_length(rest) > 0 => {
                    let length = number_length(rest);
                    (
                        Token::Number(rest[..length].parse().unwrap_or(f64::NAN)),
                        length,
                    )
                }
                _ if name_length(rest) > 0 => {
                    let length = name_length(rest);
                    let name = rest[..length].to_owned();
                    (
                        Token::Name {
                            name,
                            braced: false,
                        },
                        length,
                    )
                }
                strange => {
                    let place = at..at + strange.len_utf8();
                    return Err(ExpressionError::new(place, Trouble::StrangeSign(strange)));
                }
            }
        };
        found.push((token, at..at + length));
        at += length;
    }
    Ok(found)
}

fn operator(rest: &str) -> Option<(&'static str, &'static str)> {
    OPERATORS
        .into_iter()
        .find(|(sign, _)| rest.starts_with(sign))
}

/// A name in braces, of which `}}` is one closing brace.
fn braced(rest: &str, at: usize) -> Result<(Token, usize), ExpressionError> {
    let mut name = String::new();
    let mut signs = rest.char_indices().skip(1).peekable();
    while let Some((place, sign)) = signs.next() {
        let is_twice = signs.peek().is_some_and(|(_, next)| *next == '}');
        match sign {
            '}' if is_twice => {
                signs.next();
                name.push('}');
            }
            '}' => {
                let name = name.trim().to_owned();
                return Ok((Token::Name { name, braced: true }, place + 1));
            }
            other => name.push(other),
        }
    }
    Err(ExpressionError::new(at..at + 1, Trouble::OpenBrace))
}

/// Bytes of the number that `rest` begins with, 0 if it is none: `1`, `.5`, `2.5e-3`.
fn number_length(rest: &str) -> usize {
    let digits = |from: usize| {
        let bytes = rest.as_bytes().get(from..).unwrap_or_default();
        bytes.iter().take_while(|b| b.is_ascii_digit()).count()
    };
    let is_at =
        |at: usize, signs: &[u8]| rest.as_bytes().get(at).is_some_and(|b| signs.contains(b));
    let mut length = digits(0);
    let mut has_digits = length > 0;
    if is_at(length, b".") {
        let fraction = digits(length + 1);
        has_digits |= fraction > 0;
        length += 1 + fraction;
    }
    if !has_digits {
        return 0;
    }
    if is_at(length, b"eE") {
        let sign = usize::from(is_at(length + 1, b"+-"));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}

/// Bytes of the name that `rest` begins with, 0 if it is none: `Roll`, `ATT.Roll`, `GPS[1].Spd`, `q[0]`.
pub(super) fn name_length(rest: &str) -> usize {
    let word = |from: usize| {
        let signs = rest[from..].chars();
        let inside = signs.take_while(|c| c.is_alphanumeric() || *c == '_');
        inside.map(char::len_utf8).sum::<usize>()
    };
    if rest.starts_with(|c: char| c.is_numeric()) {
        return 0;
    }
    let mut length = word(0);
    if length == 0 {
        return 0;
    }
    loop {
        let rest = &rest[length..];
        if rest.starts_with('.') && word(length + 1) > 0 {
            length += 1 + word(length + 1);
            continue;
        }
        let Some(index) = rest.strip_prefix('[').and_then(|r| r.split_once(']')) else {
            return length;
        };
        let is_number = !index.0.is_empty() && index.0.bytes().all(|b| b.is_ascii_digit());
        if !is_number {
            return length;
        }
        length += index.0.len() + 2;
    }
}

/// A name as it is written in an expression: in braces unless it reads as one word without.
pub fn written(name: &str) -> String {
    let is_plain = !name.is_empty() && name_length(name) == name.len();
    let is_taken = matches!(name, "pi" | "time") || Function::named(name).is_some();
    if is_plain && !is_taken {
        name.to_owned()
    } else {
        format!("{{{}}}", name.replace('}', "}}"))
    }
}
