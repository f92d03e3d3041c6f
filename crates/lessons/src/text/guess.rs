//! A guess that the reader commits to before the answer.

use super::error::TextError;

/// Question with options, one of them right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Guess<'a> {
    /// Question, as Markdown.
    pub question: &'a str,
    /// Options, as Markdown of one line.
    pub options: Vec<&'a str>,
    /// Index of the right one.
    pub right: usize,
    /// The answer, as Markdown.
    pub answer: &'a str,
}

impl<'a> Guess<'a> {
    /// Reads a question, then lines `- [ ] …` of which one is `- [x] …`, then the answer.
    pub fn read(text: &'a str) -> Result<Self, TextError> {
        let is_option = |line: &str| line.starts_with("- [ ] ") || line.starts_with("- [x] ");
        let begin = text.find("- [").ok_or(TextError::Guess)?;
        let options: Vec<&str> = text[begin..]
            .lines()
            .take_while(|line| is_option(line))
            .collect();
        let lines = text[begin..].split_inclusive('\n').take(options.len());
        let after = begin + lines.map(str::len).sum::<usize>();
        let marked = |line: &str| line.starts_with("- [x]");
        let answer = text[after..].trim();
        let right = options
            .iter()
            .position(|line| marked(line))
            .ok_or(TextError::Guess)?;
        if options.len() < 2
            || options.iter().filter(|line| marked(line)).count() != 1
            || answer.is_empty()
        {
            return Err(TextError::Guess);
        }
        Ok(Self {
            question: text[..begin].trim(),
            options: options.into_iter().map(|line| line[6..].trim()).collect(),
            right,
            answer,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_guess_has_a_question_options_and_an_answer() {
        let guess =
            Guess::read("Which?\n\n- [ ] left\n- [x] right\n- [ ] none\n\nRight it is.").unwrap();
        assert_eq!(guess.question, "Which?");
        assert_eq!(guess.options, ["left", "right", "none"]);
        assert_eq!((guess.right, guess.answer), (1, "Right it is."));
    }

    #[test]
    fn one_option_is_right() {
        for text in [
            "Which?",
            "a\n- [x] b\n\nc",
            "a\n- [ ] b\n- [ ] c\n\nd",
            "a\n- [x] b\n- [x] c\n\nd",
            "a\n- [x] b\n- [ ] c",
        ] {
            assert_eq!(Guess::read(text), Err(TextError::Guess), "{text}");
        }
    }
}
