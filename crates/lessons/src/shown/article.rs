//! The HTML of a lesson: its steps in their order, the figure beside them.

use std::fmt::Write as _;

use super::opened::OpenLesson;
use crate::text::{CourseText, Renderer, Section, Symbol, TextError};

/// The whole lesson.
pub(super) fn article(reader: &OpenLesson) -> Result<String, TextError> {
    let symbols = reader.text.symbols()?;
    let renderer = reader.renderer(&symbols);
    let page = |key: &str| reader.page.get(key);
    let course = CourseText::read(reader.course.text)?;
    let mut made = format!(
        r##"<header><p class="course"><a href="#{}">{}</a> · {} {} {} {} · {:.0} {}</p><h1 id="lesson-title" tabindex="-1">{}</h1><p class="question">{}</p></header>"##,
        reader.course.name,
        course.title,
        page("lesson"),
        reader.place + 1,
        page("of"),
        reader.course.lessons.len(),
        reader.text.minutes().ceil(),
        page("minutes"),
        renderer.line(reader.text.title)?,
        renderer.line(reader.text.question)?,
    );
    for section in reader.text.steps() {
        let name = section.name();
        let heading = page(&name);
        let _ = write!(
            made,
            r#"<section id="{name}" aria-labelledby="{name}-heading"><h2 id="{name}-heading" tabindex="-1">{heading}</h2>"#
        );
        match section {
            Section::Guess => guess(reader, &renderer, &mut made)?,
            Section::Mathematics => {
                made.push_str(&renderer.block(reader.text.section(section))?);
                legend(reader, &renderer, &symbols, &mut made)?;
            }
            _ => made.push_str(&renderer.block(reader.text.section(section))?),
        }
        made.push_str("</section>");
    }
    let sources = reader.text.section(Section::Sources);
    if !sources.is_empty() {
        let _ = write!(
            made,
            r#"<section id="sources" class="sources"><h2>{}</h2>{}</section>"#,
            page("sources"),
            renderer.block(sources)?
        );
    }
    let _ = write!(
        made,
        r#"<aside class="notes" id="notes" hidden><h2>{}</h2>{}</aside>"#,
        page("notes"),
        renderer.block(reader.text.section(Section::Notes))?
    );
    Ok(made)
}

fn guess(reader: &OpenLesson, renderer: &Renderer<'_>, made: &mut String) -> Result<(), TextError> {
    let guess = reader.text.guess()?;
    let page = |key: &str| reader.page.get(key);
    let _ = write!(
        made,
        r#"{}<fieldset class="guess" data-right="{}"><legend class="unseen">{}</legend>"#,
        renderer.block(guess.question)?,
        guess.right,
        page("your-guess")
    );
    for (index, option) in guess.options.iter().enumerate() {
        let _ = write!(
            made,
            r#"<label><input type="radio" name="guess" value="{index}">{}</label>"#,
            renderer.line(option)?
        );
    }
    let _ = write!(
        made,
        r#"<p class="buttons"><button type="button" class="commit" disabled>{}</button><button type="button" class="reveal quiet">{}</button></p></fieldset><div class="answer" hidden><p class="verdict" role="status" data-right-words="{}" data-wrong-words="{}"></p>{}</div>"#,
        page("commit"),
        page("show-answer"),
        page("guessed-right"),
        page("guessed-wrong"),
        renderer.block(guess.answer)?
    );
    Ok(())
}

fn legend(
    reader: &OpenLesson,
    renderer: &Renderer<'_>,
    symbols: &[Symbol<'_>],
    made: &mut String,
) -> Result<(), TextError> {
    if symbols.is_empty() {
        return Ok(());
    }
    let _ = write!(
        made,
        r#"<dl class="symbols" aria-label="{}">"#,
        reader.page.get("symbols")
    );
    for symbol in symbols {
        let equation = renderer.line(&format!("${}$", symbol.symbol))?;
        let shown = if symbol.part.is_empty() {
            equation
        } else {
            format!(
                r#"<button type="button" data-symbol="{}">{equation}</button>"#,
                symbol.part
            )
        };
        let _ = write!(
            made,
            "<dt>{shown}</dt><dd>{}</dd>",
            renderer.line(symbol.meaning)?
        );
    }
    made.push_str("</dl>");
    Ok(())
}
