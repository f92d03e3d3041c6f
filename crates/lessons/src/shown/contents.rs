//! All courses with their lessons, and the plan of a presentation.

use std::fmt::Write as _;

use crate::course::{Course, Courses};
use crate::text::{
    CourseText, LessonText, Renderer, Section, TextError, Words, glossary, page_words,
};

/// Minutes of a presentation of a course.
const PRESENTATION: f64 = 45.0;
/// Minutes of it for questions at its end.
const DISCUSSION: f64 = 5.0;

/// HTML of all courses: their titles, what they are about, their lessons.
pub fn contents(courses: Courses) -> Result<String, TextError> {
    let page = page_words();
    let mut made = format!(
        r#"<header><h1 id="lesson-title" tabindex="-1">{}</h1><p class="question">{}</p></header>"#,
        page.get("contents"),
        page.get("about")
    );
    for course in courses.0 {
        made.push_str(&listed(course, &page)?);
    }
    Ok(made)
}

fn listed(course: &Course, page: &Words) -> Result<String, TextError> {
    let text = CourseText::read(course.text)?;
    let name = course.name;
    let mut made = format!(
        r#"<section class="course-list" id="{name}"><h2>{}</h2>{}<ol>"#,
        text.title,
        renderer(page, &glossary()).block(text.about)?
    );
    let mut minutes = 0.0;
    for lesson in course.lessons {
        let own = LessonText::read(lesson.text)?;
        minutes += own.minutes();
        let _ = write!(
            made,
            r##"<li><a href="#{}" data-lesson="{0}"><b>{}</b> <span>{}</span></a></li>"##,
            lesson.name, own.title, own.question
        );
    }
    let _ = write!(
        made,
        r##"</ol><p class="links"><a href="#{name}/plan">{}</a> <a href="#{name}/handout">{}</a></p></section>"##,
        plan_title(minutes, page),
        page.get("handout")
    );
    Ok(made)
}

/// Presentations that a course of so many minutes takes, so that none of its lessons is hurried.
fn presentations(minutes: f64) -> usize {
    (minutes / (PRESENTATION - DISCUSSION)).ceil().max(1.0) as usize
}

/// Title of the plan of a course of so many minutes: presentations and their length.
fn plan_title(minutes: f64, page: &Words) -> String {
    let times = match presentations(minutes) {
        1 => String::new(),
        several => format!("{several} × "),
    };
    let (plan, unit) = (page.get("plan"), page.get("plan-minutes"));
    format!("{plan} {times}{PRESENTATION:.0} {unit}")
}

/// HTML of the plan of presentations of 45 minutes: each lesson with its minutes and what is said, then the questions.
/// A course that is longer than one fills several.
pub fn plan(course: &Course) -> Result<String, TextError> {
    let (page, terms) = (page_words(), glossary());
    let text = CourseText::read(course.text)?;
    let lessons = course.lessons.iter();
    let lessons = lessons.map(|lesson| LessonText::read(lesson.text));
    let lessons: Vec<LessonText<'_>> = lessons.collect::<Result<_, _>>()?;
    let whole: f64 = lessons.iter().map(LessonText::minutes).sum();
    let parts = presentations(whole);
    let room = PRESENTATION * parts as f64 - DISCUSSION;
    let scale = room / whole.max(1e-9);
    let mut made = format!(
        r#"<header><h1 id="lesson-title" tabindex="-1">{}: {}</h1></header><table class="plan"><thead><tr><th>{}</th><th>{}</th><th>{}</th></tr></thead><tbody>"#,
        text.title,
        plan_title(whole, &page),
        page.get("minute"),
        page.get("lessons"),
        page.get("notes")
    );
    // Notes name no numbers of the reader's setting.
    let notes = renderer(&page, &terms);
    let (mut at, mut part, mut begins) = (0.0, 1, 0.0);
    for (lesson, own) in course.lessons.iter().zip(&lessons) {
        let takes = own.minutes() * scale;
        if at + 0.5 * takes > PRESENTATION * f64::from(part) {
            (part, begins) = (part + 1, at);
            let next = page.get("part");
            let _ = write!(made, r#"<tr><th colspan="3">{next} {part}</th></tr>"#);
        }
        let _ = write!(
            made,
            r##"<tr><td>{:.0}</td><td><a href="#{}">{}</a></td><td>{}</td></tr>"##,
            at - begins,
            lesson.name,
            own.title,
            notes.block(own.section(Section::Notes))?
        );
        at += takes;
    }
    at -= begins;
    let _ = write!(
        made,
        "<tr><td>{at:.0}</td><td>{}</td><td><ul>",
        page.get("discussion")
    );
    for question in &text.questions {
        let _ = write!(made, "<li>{}</li>", question.question);
    }
    made.push_str("</ul></td></tr></tbody></table>");
    Ok(made)
}

fn renderer<'a>(page: &'a Words, glossary: &'a Words) -> Renderer<'a> {
    Renderer {
        outcome: None,
        setting: None,
        words: page,
        page,
        glossary,
        symbols: &[],
    }
}
