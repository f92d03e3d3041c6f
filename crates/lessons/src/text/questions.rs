//! The text of a course: what it is about, and questions that its reader can answer afterwards.

use super::error::TextError;

/// Text of a course.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CourseText<'a> {
    /// Title.
    pub title: &'a str,
    /// Subject, as Markdown.
    pub about: &'a str,
    /// Questions that it answers.
    pub questions: Vec<Question<'a>>,
}

/// Question that a course answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question<'a> {
    /// Question as people ask it.
    pub question: &'a str,
    /// Name of the lesson that answers it.
    pub lesson: &'a str,
    /// The sentence that does, word by word.
    pub sentence: &'a str,
}

impl<'a> CourseText<'a> {
    /// Reads `# title`, words, and `## Questions` with lines `- question | lesson | sentence`.
    pub fn read(text: &'a str) -> Result<Self, TextError> {
        let (head, list) = text.split_once("\n## Questions").unwrap_or((text, ""));
        let (first, about) = head.split_once('\n').unwrap_or((head, ""));
        let title = first.strip_prefix("# ").ok_or(TextError::NoTitle)?;
        let lines = list.lines().filter(|line| line.starts_with("- "));
        let questions = lines.map(|line| {
            let mut parts = line[2..].splitn(3, '|').map(str::trim);
            let mut next = || parts.next().filter(|it| !it.is_empty());
            let (Some(question), Some(lesson), Some(sentence)) = (next(), next(), next()) else {
                return Err(TextError::Line(line.to_owned()));
            };
            Ok(Question {
                question,
                lesson,
                sentence,
            })
        });
        Ok(Self {
            title: title.trim(),
            about: about.trim(),
            questions: questions.collect::<Result<_, _>>()?,
        })
    }
}
