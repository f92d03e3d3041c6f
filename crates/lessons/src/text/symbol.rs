//! Symbols of equations: what they mean, and which part of the figure shows it.

use super::error::TextError;

/// Symbol of a lesson's equations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol<'a> {
    /// As the equations have it: `K`, `\sigma`.
    pub symbol: &'a str,
    /// Part of the figure, or empty.
    pub part: &'a str,
    /// Meaning, as Markdown of one line, with its number in braces where it has one.
    pub meaning: &'a str,
}

impl<'a> Symbol<'a> {
    /// Reads a line `- K | gain | meaning`.
    pub fn read(line: &'a str) -> Result<Self, TextError> {
        let fault = || TextError::Line(line.to_owned());
        let mut parts = line
            .trim()
            .strip_prefix("- ")
            .ok_or_else(fault)?
            .splitn(3, '|');
        let mut next = || parts.next().map(str::trim).ok_or_else(fault);
        let (symbol, part, meaning) = (next()?, next()?, next()?);
        if symbol.is_empty() || meaning.is_empty() {
            return Err(fault());
        }
        Ok(Self {
            symbol,
            part,
            meaning,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symbol_has_a_part_and_a_meaning() {
        let symbol = Symbol::read("- K | gain | the gain, {{gain}}").unwrap();
        assert_eq!((symbol.symbol, symbol.part), ("K", "gain"));
        assert!(Symbol::read("- K | gain").is_err());
        assert!(Symbol::read("- K || alone").unwrap().part.is_empty());
    }
}
