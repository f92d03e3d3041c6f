//! The text of a lesson by its sections.

use super::directive::{Directive, Piece, pieces};
use super::error::TextError;
use super::guess::Guess;
use super::section::Section;
use super::symbol::Symbol;
use crate::words::Words;

/// Words a minute that people read.
const PACE: f64 = 200.0;
/// Minutes that a control is tried.
const TRIAL: f64 = 0.3;

/// Text of a lesson, cut into its sections.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonText<'a> {
    /// Title.
    pub title: &'a str,
    /// The one question.
    pub question: &'a str,
    sections: Vec<(Section, &'a str)>,
}

impl<'a> LessonText<'a> {
    /// Reads a text.
    pub fn read(text: &'a str) -> Result<Self, TextError> {
        let mut parts = text.split("\n## ");
        let head = parts.next().unwrap_or_default();
        let mut lines = head.lines().filter(|line| !line.trim().is_empty());
        let title = lines
            .next()
            .and_then(|line| line.strip_prefix("# "))
            .ok_or(TextError::NoTitle)?;
        let question = lines
            .find_map(|line| line.strip_prefix("> "))
            .ok_or(TextError::NoQuestion)?;
        let mut sections = Vec::new();
        for part in parts {
            let (heading, body) = part.split_once('\n').unwrap_or((part, ""));
            let section = Section::named(heading.trim())
                .ok_or_else(|| TextError::UnknownSection(heading.trim().to_owned()))?;
            if sections.iter().any(|(own, _)| *own == section) {
                return Err(TextError::Twice(section));
            }
            sections.push((section, body.trim()));
        }
        let needed = Section::ALL
            .into_iter()
            .filter(|own| *own != Section::Sources);
        for section in needed {
            if !sections.iter().any(|(own, _)| *own == section) {
                return Err(TextError::Missing(section));
            }
        }
        Ok(Self {
            title: title.trim(),
            question: question.trim(),
            sections,
        })
    }

    /// Markdown of a section, empty where it has none.
    pub fn section(&self, section: Section) -> &'a str {
        let found = self.sections.iter().find(|(own, _)| *own == section);
        found.map_or("", |(_, body)| body)
    }

    /// Sections through which its reader goes, in the order of the lesson.
    pub fn steps(&self) -> impl Iterator<Item = Section> + '_ {
        let kept = |section: &Section| section.is_step() && !self.section(*section).is_empty();
        Section::ALL.into_iter().filter(kept)
    }

    /// Its guess.
    pub fn guess(&self) -> Result<Guess<'a>, TextError> {
        Guess::read(self.section(Section::Guess))
    }

    /// Words of its figure and controls.
    pub fn words(&self) -> Result<Words, TextError> {
        Words::read(self.section(Section::Labels)).map_err(TextError::Line)
    }

    /// Symbols of its equations.
    pub fn symbols(&self) -> Result<Vec<Symbol<'a>>, TextError> {
        let lines = self.section(Section::Symbols).lines();
        lines
            .filter(|line| !line.trim().is_empty())
            .map(Symbol::read)
            .collect()
    }

    /// Requests of its sections to the lesson.
    pub fn directives(&self) -> Result<Vec<(Section, Directive<'a>)>, TextError> {
        let mut found = Vec::new();
        for (section, body) in &self.sections {
            for piece in pieces(body)? {
                if let Piece::Directive(directive) = piece {
                    found.push((*section, directive));
                }
            }
        }
        Ok(found)
    }

    /// Minutes that it takes, without its mathematics.
    pub fn minutes(&self) -> f64 {
        let read = self
            .steps()
            .filter(|section| *section != Section::Mathematics);
        let words: usize = read
            .map(|section| self.section(section).split_whitespace().count())
            .sum();
        let controls = self
            .sections
            .iter()
            .map(|(_, body)| body.matches("{{control:").count());
        words as f64 / PACE + TRIAL * controls.sum::<usize>() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_named() {
        assert_eq!(LessonText::read("no title"), Err(TextError::NoTitle));
        assert_eq!(LessonText::read("# A\n\nb"), Err(TextError::NoQuestion));
        let unknown = LessonText::read("# A\n> b?\n\n## Weather\n");
        assert_eq!(
            unknown,
            Err(TextError::UnknownSection("Weather".to_owned()))
        );
        let twice = LessonText::read("# A\n> b?\n\n## Story\nx\n\n## Story\ny\n");
        assert_eq!(twice, Err(TextError::Twice(Section::Story)));
        let missing = LessonText::read("# A\n> b?\n\n## Story\nx\n");
        assert_eq!(missing, Err(TextError::Missing(Section::Guess)));
    }
}
