//! Numbers, controls and checks within a text: what stands in double braces.

use super::error::TextError;

/// Part of a text.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece<'a> {
    /// Markdown.
    Markdown(&'a str),
    /// Content of double braces.
    Directive(Directive<'a>),
}

/// Request of a text to the lesson.
#[derive(Clone, Debug, PartialEq)]
pub enum Directive<'a> {
    /// `{{name}}`: a number at the reader's setting.
    Live(&'a str),
    /// `{{name.low}}`: least number that passes.
    Low(&'a str),
    /// `{{name.high}}`: greatest number that passes.
    High(&'a str),
    /// `{{name = 3.42 m}}`, `{{name = 3.42 m | wind = 12}}`: a number as it was worked out, at the start's setting or
    /// another.
    Written {
        /// Name of the number.
        name: &'a str,
        /// The number with its digits.
        number: &'a str,
        /// Its unit.
        unit: &'a str,
        /// Controls that are set otherwise than at the start.
        setting: Vec<(&'a str, f64)>,
    },
    /// `{{control: wind}}`: a control.
    Control(&'a str),
    /// `{{set: wind = 12 | Blow}}`: a button that sets controls.
    Set(Vec<(&'a str, f64)>, &'a str),
    /// `{{check: nis}}`: whether a number passes.
    Check(&'a str),
    /// `{{passes: wind = 2}}`: a setting that passes.
    Passes(Vec<(&'a str, f64)>),
    /// `{{flight: gate | Open}}`: the flight at a stop of the tour.
    Flight(&'a str, &'a str),
}

/// Parts of a text in their order.
///
/// ```
/// use pilotage_lessons::text::{Directive, Piece, pieces};
///
/// let parts = pieces("Blows with {{control: wind}} from the {{set: from = 270 | west}}.")?;
/// assert_eq!(parts[1], Piece::Directive(Directive::Control("wind")));
/// assert_eq!(parts[3], Piece::Directive(Directive::Set(vec![("from", 270.0)], "west")));
/// assert_eq!(parts[4], Piece::Markdown("."));
/// assert!(pieces("{{control: wind").is_err());
/// # Ok::<(), pilotage_lessons::text::TextError>(())
/// ```
pub fn pieces(text: &str) -> Result<Vec<Piece<'_>>, TextError> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(begin) = rest.find("{{") {
        let inside = &rest[begin + 2..];
        let Some(end) = inside.find("}}") else {
            return Err(TextError::Open(inside.chars().take(40).collect()));
        };
        found.push(Piece::Markdown(&rest[..begin]));
        let body = inside[..end].trim();
        let directive = read(body).ok_or_else(|| TextError::UnknownDirective(body.to_owned()))?;
        found.push(Piece::Directive(directive));
        rest = &inside[end + 2..];
    }
    found.push(Piece::Markdown(rest));
    Ok(found)
}

fn read(body: &str) -> Option<Directive<'_>> {
    if let Some((kind, rest)) = body.split_once(':') {
        let rest = rest.trim();
        let (first, words) = match rest.split_once('|') {
            Some((first, words)) => (first.trim(), words.trim()),
            None => (rest, ""),
        };
        return match kind.trim() {
            "control" => Some(Directive::Control(name(first)?)),
            "check" => Some(Directive::Check(name(first)?)),
            "passes" => Some(Directive::Passes(settings(first)?)),
            "set" if !words.is_empty() => Some(Directive::Set(settings(first)?, words)),
            "flight" if !words.is_empty() => Some(Directive::Flight(name(first)?, words)),
            _ => None,
        };
    }
    if let Some((own, rest)) = body.split_once('=') {
        let (value, at) = match rest.split_once('|') {
            Some((value, at)) => (value.trim(), settings(at)?),
            None => (rest.trim(), Vec::new()),
        };
        let (number, unit) = split_unit(value);
        return Some(Directive::Written {
            name: name(own.trim())?,
            number,
            unit,
            setting: at,
        });
    }
    match body.split_once('.') {
        Some((own, "low")) => Some(Directive::Low(name(own)?)),
        Some((own, "high")) => Some(Directive::High(name(own)?)),
        Some(_) => None,
        None => Some(Directive::Live(name(body)?)),
    }
}

/// Name of letters, digits and hyphens.
fn name(text: &str) -> Option<&str> {
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (!text.is_empty() && text.chars().all(fits)).then_some(text)
}

fn settings(text: &str) -> Option<Vec<(&str, f64)>> {
    text.split(',')
        .map(|part| {
            let (own, number) = part.split_once('=')?;
            let number = number.trim().replace('\u{2212}', "-").parse().ok()?;
            Some((name(own.trim())?, number))
        })
        .collect()
}

/// Number and unit: `12.5 m/s`, `95 %`, `12°`.
fn split_unit(value: &str) -> (&str, &str) {
    let numeral = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '\u{2212}' | 'e');
    let end = value.find(|c| !numeral(c)).unwrap_or(value.len());
    (&value[..end], value[end..].trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn only(text: &str) -> Directive<'_> {
        let parts = pieces(text).unwrap();
        match parts.into_iter().nth(1) {
            Some(Piece::Directive(directive)) => directive,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn every_form_is_read() {
        assert_eq!(only("{{nis}}"), Directive::Live("nis"));
        assert_eq!(only("{{nis.low}}"), Directive::Low("nis"));
        assert_eq!(only("{{control: wind}}"), Directive::Control("wind"));
        assert_eq!(
            only("{{passes: wind = 2, rate=0.5}}"),
            Directive::Passes(vec![("wind", 2.0), ("rate", 0.5)])
        );
        assert_eq!(
            only("{{set: wind = 12 | Blow}}"),
            Directive::Set(vec![("wind", 12.0)], "Blow")
        );
        assert_eq!(
            only("{{flight: gate | Open it}}"),
            Directive::Flight("gate", "Open it")
        );
        let written = Directive::Written {
            name: "error",
            number: "\u{2212}3.40",
            unit: "m/s",
            setting: vec![("wind", 12.0)],
        };
        assert_eq!(only("{{error = \u{2212}3.40 m/s | wind = 12}}"), written);
        let Directive::Written { number, unit, .. } = only("{{turn = 12.5°}}") else {
            panic!()
        };
        assert_eq!((number, unit), ("12.5", "°"));
    }

    #[test]
    fn other_braces_are_refused() {
        for text in [
            "{{a b}}",
            "{{set: wind = 3}}",
            "{{fly: x}}",
            "{{}}",
            "{{open",
        ] {
            assert!(pieces(text).is_err(), "{text}");
        }
    }
}
