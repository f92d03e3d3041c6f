//! Sums that the lessons write out are right: `45 × cos 50° + 30 × sin 50° = 51.9 m` is worked out here.

use std::fmt::Write as _;

use pilotage_lessons::all;
use pilotage_lessons::text::{Directive, Piece, pieces};

/// Error beside that of the last digit that rounded numbers of a sum may make, as a share.
const ROUNDED: f64 = 0.004;
/// Words of a sum that change nothing.
const UNITS: [&str; 8] = ["m", "s", "m/s", "m²", "px", "pixels", "m²/s", "%"];

/// Part of a sum.
#[derive(Clone, Copy, Debug)]
enum Token {
    Number(f64),
    Function(fn(f64) -> f64),
    Sign(char),
    Power(f64),
}

/// Tokens of a text that is a sum through and through.
fn tokens(text: &str) -> Option<Vec<Token>> {
    let mut found = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = |is_in: fn(char) -> bool| rest.find(|c| !is_in(c)).unwrap_or(rest.len());
        let used = if first.is_ascii_digit() {
            let used = length(|c| c.is_ascii_digit() || c == '.' || c == ',');
            found.push(Token::Number(number(&rest[..used])?));
            used
        } else if superscript(first).is_some() {
            let used = length(|c| superscript(c).is_some());
            let digits: String = rest[..used].chars().filter_map(superscript).collect();
            found.push(Token::Power(digits.parse().ok()?));
            used
        } else if "×/+−()√°".contains(first) {
            found.push(Token::Sign(first));
            first.len_utf8()
        } else {
            let used = length(|c| c.is_alphabetic() || "/²%".contains(c));
            match &rest[..used] {
                "cos" => found.push(Token::Function(f64::cos)),
                "sin" => found.push(Token::Function(f64::sin)),
                "tan" => found.push(Token::Function(f64::tan)),
                "ln" => found.push(Token::Function(f64::ln)),
                unit if UNITS.contains(&unit) => {}
                _ => return None,
            }
            used
        };
        rest = rest[used..].trim_start();
    }
    Some(found)
}

fn number(text: &str) -> Option<f64> {
    text.replace(',', "").parse().ok()
}

fn superscript(c: char) -> Option<char> {
    let place = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|it| it == c)?;
    char::from_digit(place as u32, 10)
}

/// Sum of the tokens from the first on, which are used up.
fn sum(tokens: &mut &[Token]) -> Option<f64> {
    let mut value = product(tokens)?;
    while let [Token::Sign(sign @ ('+' | '−')), rest @ ..] = *tokens {
        *tokens = rest;
        let other = product(tokens)?;
        value += if *sign == '+' { other } else { -other };
    }
    Some(value)
}

fn product(tokens: &mut &[Token]) -> Option<f64> {
    let mut value = factor(tokens)?;
    while let [Token::Sign(sign @ ('×' | '/')), rest @ ..] = *tokens {
        *tokens = rest;
        let other = factor(tokens)?;
        value *= if *sign == '×' { other } else { 1.0 / other };
    }
    Some(value)
}

fn factor(tokens: &mut &[Token]) -> Option<f64> {
    let (first, rest) = tokens.split_first()?;
    *tokens = rest;
    let mut value = match first {
        Token::Sign('−') => return Some(-product(tokens)?),
        Token::Sign('√') => factor(tokens)?.sqrt(),
        Token::Sign('(') => {
            let value = sum(tokens)?;
            let (Token::Sign(')'), rest) = tokens.split_first()? else {
                return None;
            };
            *tokens = rest;
            value
        }
        Token::Number(number) => *number,
        Token::Function(of) => of(factor(tokens)?),
        _ => return None,
    };
    loop {
        match tokens.split_first() {
            Some((Token::Power(power), rest)) => (value, *tokens) = (value.powf(*power), rest),
            Some((Token::Sign('°'), rest)) => (value, *tokens) = (value.to_radians(), rest),
            Some((Token::Function(of), rest)) => {
                *tokens = rest;
                value *= of(factor(tokens)?);
            }
            _ => return Some(value),
        }
    }
}

/// The longest sum at the end of a text, and what it comes to; `None` of a number by itself.
fn sum_at_end(text: &str) -> Option<(&str, f64)> {
    let begins = |(at, c): (usize, char)| {
        let before = text[..at].chars().next_back();
        let is_inside = before.is_some_and(|it| it.is_alphanumeric() || ".,²".contains(it));
        (!c.is_whitespace() && !is_inside).then_some(at)
    };
    let longest = text.char_indices().filter_map(begins).find_map(|at| {
        let tokens = tokens(&text[at..])?;
        let works = tokens.iter().any(|it| match it {
            Token::Sign(sign) => "×/+√−".contains(*sign),
            Token::Function(_) | Token::Power(_) => true,
            Token::Number(_) => false,
        });
        // The end of what is not understood is no sum.
        let before = text[..at].trim_end().chars().next_back();
        let is_end = before.is_some_and(|it| "×/+−√·^(²".contains(it))
            || text[at..].starts_with('(') && before.is_some_and(char::is_alphabetic);
        let mut left = &tokens[..];
        let value = sum(&mut left)?;
        (works && left.is_empty()).then_some((!is_end).then_some((&text[at..], value)))
    });
    longest.flatten()
}

/// A text with its numbers as they are written, and without its equations.
fn written(text: &str) -> String {
    let mut plain = String::new();
    for piece in pieces(text).expect("a text that reads") {
        match piece {
            Piece::Directive(Directive::Written { number, unit, .. }) => {
                let _ = write!(plain, "{number} {unit}");
            }
            Piece::Directive(_) => plain.push(';'),
            Piece::Markdown(text) => plain += text,
        }
    }
    let without_equations: Vec<&str> = plain.split('$').step_by(2).collect();
    without_equations.join(";").replace('·', "×")
}

/// Sums of a text that are followed by what they come to: the sum, the result as it is written, and whether it is right.
fn sums(text: &str) -> Vec<(String, String, bool)> {
    let mut found = Vec::new();
    for line in text.lines() {
        for (at, _) in line.match_indices('=') {
            let Some((words, value)) = sum_at_end(&line[..at]) else {
                continue;
            };
            let result = line[at + 1..].trim_start();
            let (sign, digits) = match result.strip_prefix('−') {
                Some(digits) => (-1.0, digits),
                None => (1.0, result),
            };
            let is_digit = |c: char| c.is_ascii_digit() || c == '.' || c == ',';
            let end = digits.find(|c| !is_digit(c)).unwrap_or(digits.len());
            let (digits, unit) = digits.split_at(end);
            let digits = digits.trim_end_matches(['.', ',']);
            // A further sum follows, whose own result is looked at; or the unit is another than that of what was added up.
            let unit = unit.trim_start();
            let goes_on = unit.starts_with(['×', '/', '+', '−', '°']) || unit.starts_with("cm");
            let Some(size) = number(digits).filter(|_| !goes_on) else {
                continue;
            };
            let result = sign * size;
            let places = digits.split_once('.').map_or(0, |(_, places)| places.len());
            let room = 0.5 * 10_f64.powi(-(places as i32)) + ROUNDED * size + 1e-9;
            let scale = if unit.starts_with('%') { 100.0 } else { 1.0 };
            let is_right = [1.0, scale]
                .iter()
                .any(|it| (it * value - result).abs() <= room);
            found.push((words.to_owned(), digits.to_owned(), is_right));
        }
    }
    found
}

#[test]
fn sums_are_worked_out() {
    let read = |text: &str| sums(&written(text));
    let right = |text: &str| read(text).iter().map(|it| it.2).collect::<Vec<_>>();
    assert_eq!(
        right("makes √(20² + 6²) = {{speed = 20.9 m/s}} there"),
        [true]
    );
    assert_eq!(
        right("ahead −45 × sin 50° + 30 × cos 50° = −15.2 m"),
        [true]
    );
    assert_eq!(
        right("ahead −45 × sin 50° + 30 × cos 50° = 15.2 m"),
        [false]
    );
    assert_eq!(
        right("0.4⁵ = 1.02 % of it, and −2 ln 0.003 = 11.6"),
        [true, true]
    );
    assert_eq!(
        right("(0.8587 − 0.6951) / 2 = 0.0818, not 7 × 5 = 36.0 m"),
        [true, false]
    );
    assert_eq!(right("at 4 m = 4.0 m, $2 + 2 = 5$"), [true; 0]);
}

#[test]
fn every_sum_of_the_lessons_is_right() {
    let (mut count, mut wrong) = (0, Vec::new());
    for lesson in all().lessons() {
        for (sum, result, is_right) in sums(&written(lesson.text)) {
            count += 1;
            if !is_right {
                wrong.push(format!("{}: {sum} = {result}", lesson.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 70, "{count} sums were found");
}
