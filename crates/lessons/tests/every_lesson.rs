//! Rules that every lesson and every course keeps.

use std::collections::BTreeSet;

use pilotage_lessons::text::{CourseText, Directive, LessonText, Piece, Section, pieces};
use pilotage_lessons::{Lesson, LessonOutcome, Reader, Setting, Written, all};

/// Minutes of a lesson.
const LONGEST: f64 = 5.0;

/// Outcome of a lesson at the start's setting with some controls set otherwise.
fn outcome(lesson: &Lesson, numbers: &[(&str, f64)]) -> LessonOutcome {
    let text = LessonText::read(lesson.text).expect("a text with all sections");
    let words = text.words().expect("labels with their keys");
    let mut setting = Setting::usual(lesson.controls);
    for (name, number) in numbers {
        assert!(
            setting.set(name, *number),
            "{}: no control {name}",
            lesson.name
        );
        let got = setting.get(name);
        assert!(
            (got - number).abs() < 1e-9,
            "{}: {name} cannot be {number}, but {got}",
            lesson.name
        );
    }
    (lesson.compute)(&setting, &words)
}

fn directives(lesson: &'static Lesson) -> Vec<(Section, Directive<'static>)> {
    let text = LessonText::read(lesson.text).unwrap_or_else(|e| panic!("{}: {e}", lesson.name));
    text.directives()
        .unwrap_or_else(|e| panic!("{}: {e}", lesson.name))
}

#[test]
fn every_text_becomes_a_page_without_a_gap() {
    for lesson in all().lessons() {
        let reader = Reader::open(all(), lesson.name)
            .unwrap()
            .unwrap_or_else(|e| panic!("{}: {e}", lesson.name));
        let html = reader
            .html()
            .unwrap_or_else(|e| panic!("{}: {e}", lesson.name));
        let figure = reader
            .figure(true)
            .unwrap_or_else(|e| panic!("{}: {e}", lesson.name));
        // The page forbids styles inside its text, so that such an equation would be drawn otherwise.
        assert!(
            !html.contains(" style=\""),
            "{}: an equation asks for a style",
            lesson.name
        );
        for (what, made) in [("text", &html), ("figure", &figure)] {
            let gap = made
                .find('⟦')
                .map(|at| made[at..].chars().take(30).collect::<String>());
            assert_eq!(gap, None, "{}: the {what} lacks words", lesson.name);
            assert!(
                !made.contains("NaN") && !made.contains("inf\""),
                "{}: the {what} has a number that is none",
                lesson.name
            );
        }
        assert!(
            !html.contains("{{") && !html.contains("[["),
            "{}",
            lesson.name
        );
    }
}

#[test]
fn every_written_number_is_the_program_s() {
    for lesson in all().lessons() {
        let mut worked = 0;
        for (section, directive) in directives(lesson) {
            let Directive::Written {
                name,
                number,
                unit,
                setting,
            } = directive
            else {
                continue;
            };
            worked += usize::from(section == Section::WorkedNumber);
            let place = format!("{}, {}: {name} = {number}", lesson.name, section.heading());
            let written = Written::read(number).unwrap_or_else(|| panic!("{place}: no number"));
            let shown = outcome(lesson, &setting);
            let value = shown
                .value(name)
                .unwrap_or_else(|| panic!("{place}: the lesson computes no such number"));
            assert_eq!(unit, value.unit, "{place}: unit");
            assert!(
                (value.number - written.number).abs() <= 0.5 * written.last_digit + 1e-9,
                "{place}: the program has {}",
                value.number
            );
            let exact = (value.number - written.number).abs() < 1e-9;
            assert!(
                written.digits >= 3 || exact,
                "{place}: three digits, please"
            );
        }
        assert!(worked > 0, "{}: no number is worked out", lesson.name);
    }
}

#[test]
fn numbers_controls_and_parts_that_are_named_are_there_and_the_others_are_named() {
    for lesson in all().lessons() {
        let name = lesson.name;
        let shown = outcome(lesson, &[]);
        let text = LessonText::read(lesson.text).unwrap();
        let mut named = BTreeSet::new();
        let mut set = BTreeSet::new();
        for (_, directive) in directives(lesson) {
            match directive {
                Directive::Live(value) | Directive::Written { name: value, .. } => {
                    named.insert(value);
                }
                Directive::Low(value) | Directive::High(value) | Directive::Check(value) => {
                    let check = shown.checks.iter().any(|check| check.value == value);
                    assert!(check, "{name}: no check of {value}");
                    named.insert(value);
                }
                Directive::Control(control) => {
                    set.insert(control);
                }
                Directive::Set(..) | Directive::Passes(_) | Directive::Flight(..) => {}
            }
        }
        let computed: BTreeSet<&str> = shown.values.iter().map(|value| value.name).collect();
        assert_eq!(named, computed, "{name}: numbers of text and program");
        let controls: BTreeSet<&str> = lesson.controls.iter().map(|own| own.name).collect();
        assert_eq!(set, controls, "{name}: controls of text and program");
        for symbol in text.symbols().unwrap() {
            assert!(
                symbol.part.is_empty() || shown.figure.has_part(symbol.part),
                "{name}: no part {} in the figure",
                symbol.part
            );
        }
    }
}

#[test]
fn the_start_does_not_pass_and_what_is_shown_as_passing_does() {
    for lesson in all().lessons() {
        let passes = |numbers: &[(&str, f64)]| {
            let shown = outcome(lesson, numbers);
            assert!(
                !shown.checks.is_empty(),
                "{}: nothing is judged",
                lesson.name
            );
            shown.checks.iter().all(|check| check.passes(&shown))
        };
        assert!(!passes(&[]), "{}: the start passes", lesson.name);
        let own: Vec<_> = directives(lesson)
            .into_iter()
            .filter_map(|(section, directive)| match directive {
                Directive::Passes(setting) if section == Section::YourTurn => Some(setting),
                _ => None,
            })
            .collect();
        assert_eq!(own.len(), 1, "{}: one setting that passes", lesson.name);
        assert!(
            passes(&own[0]),
            "{}: {:?} does not pass",
            lesson.name,
            own[0]
        );
    }
}

/// A number comes with its unit: a text that writes it as well says "2 m m".
#[test]
fn no_unit_is_said_twice() {
    for lesson in all().lessons() {
        let shown = outcome(lesson, &[]);
        let pieces = pieces(lesson.text).unwrap_or_else(|e| panic!("{}: {e}", lesson.name));
        for pair in pieces.windows(2) {
            let [Piece::Directive(directive), Piece::Markdown(after)] = pair else {
                continue;
            };
            let unit = match directive {
                Directive::Live(name) | Directive::Low(name) | Directive::High(name) => {
                    shown.value(name).map_or("", |value| value.unit)
                }
                Directive::Written { unit, .. } => unit,
                _ => "",
            };
            let again = after.trim_start().strip_prefix(unit).unwrap_or("…");
            let is_again =
                !unit.is_empty() && !again.starts_with(|c: char| c == '…' || c.is_alphanumeric());
            let place: String = after.chars().take(30).collect();
            assert!(!is_again, "{}: {directive:?}{place}", lesson.name);
        }
    }
}

/// Lessons that a control of another step would make easy, were it not for their checks.
const KEPT: [&str; 5] = [
    "why-gps-fails",
    "late-look",
    "wind-on-turns",
    "joint-update",
    "bent-function",
];

/// Whoever is shown a mistake, or makes one by a control that belongs to another step, has not passed.
#[test]
fn nothing_passes_that_is_not_the_reader_s_turn() {
    for lesson in all().lessons() {
        let passes = |numbers: &[(&str, f64)]| {
            let shown = outcome(lesson, numbers);
            shown.checks.iter().all(|check| check.passes(&shown))
        };
        let mut own = BTreeSet::new();
        for (section, directive) in directives(lesson) {
            match directive {
                Directive::Set(setting, _) => {
                    assert!(!passes(&setting), "{}: {setting:?} passes", lesson.name);
                }
                Directive::Control(name) if section == Section::YourTurn => {
                    own.insert(name);
                }
                _ => {}
            }
        }
        let is_kept = KEPT.contains(&lesson.name);
        let others = (lesson.controls.iter()).filter(|it| is_kept && !own.contains(it.name));
        for control in others {
            let steps = ((control.most - control.least) / control.step).round();
            for step in 0..=steps as u32 {
                let number = control.nearest(control.least + f64::from(step) * control.step);
                let place = format!("{}: {} = {number}", lesson.name, control.name);
                assert!(!passes(&[(control.name, number)]), "{place} passes");
            }
        }
    }
}

#[test]
fn every_lesson_has_each_step_of_a_lesson() {
    for lesson in all().lessons() {
        let has = |section: Section, wanted: fn(&Directive<'_>) -> bool| {
            let found = directives(lesson)
                .into_iter()
                .any(|(own, directive)| own == section && wanted(&directive));
            assert!(
                found,
                "{}: {} lacks something",
                lesson.name,
                section.heading()
            );
        };
        has(Section::TryIt, |it| matches!(it, Directive::Control(_)));
        has(Section::BreakIt, |it| {
            matches!(it, Directive::Set(..) | Directive::Control(_))
        });
        has(Section::YourTurn, |it| matches!(it, Directive::Control(_)));
        has(Section::YourTurn, |it| matches!(it, Directive::Check(_)));
        has(Section::InTheFlight, |it| {
            matches!(it, Directive::Flight(..))
        });
        let text = LessonText::read(lesson.text).unwrap();
        let minutes = text.minutes();
        assert!(minutes <= LONGEST, "{}: {minutes:.1} minutes", lesson.name);
        text.guess()
            .unwrap_or_else(|e| panic!("{}: {e}", lesson.name));
    }
}

#[test]
fn every_setting_has_an_outcome_and_always_the_same() {
    for lesson in all().lessons() {
        for control in lesson.controls {
            for number in [control.least, control.most] {
                let [first, second] = [0, 1].map(|_| outcome(lesson, &[(control.name, number)]));
                assert_eq!(first.figure, second.figure, "{}", lesson.name);
                let finite = first.values.iter().all(|value| value.number.is_finite());
                assert!(finite, "{}: {} = {number}", lesson.name, control.name);
            }
        }
    }
}

#[test]
fn every_course_answers_ten_questions_in_words_of_its_lessons() {
    for course in all().0 {
        let text = CourseText::read(course.text).unwrap_or_else(|e| panic!("{}: {e}", course.name));
        assert!(
            text.questions.len() >= 10,
            "{}: {}",
            course.name,
            text.questions.len()
        );
        for question in &text.questions {
            let (own, _, lesson) = all()
                .find(question.lesson)
                .unwrap_or_else(|| panic!("{}: no lesson {}", course.name, question.lesson));
            assert_eq!(own.name, course.name, "{}", question.question);
            let spaces = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(
                spaces(lesson.text).contains(&spaces(question.sentence)),
                "{}: {} does not say: {}",
                course.name,
                lesson.name,
                question.sentence
            );
        }
    }
}

#[test]
fn names_are_those_of_files_and_stand_once() {
    let names: Vec<&str> = all().lessons().map(|lesson| lesson.name).collect();
    let apart: BTreeSet<&str> = names.iter().copied().collect();
    assert_eq!(names.len(), apart.len());
    for course in all().0 {
        assert!(!apart.contains(course.name), "{}", course.name);
    }
}

#[test]
fn no_plan_hurries_a_lesson_and_each_presentation_ends_in_time() {
    for course in all().0 {
        let plan = pilotage_lessons::plan(course).expect("a text with all sections");
        let rows: Vec<&str> = plan.split("<tr>").skip(2).collect();
        let minute = |row: &str| -> Option<f64> {
            row.strip_prefix("<td>")?.split('<').next()?.parse().ok()
        };
        let mut lessons = course.lessons.iter();
        for pair in rows.windows(2) {
            let Some(begin) = minute(pair[0]) else {
                continue;
            };
            let lesson = lessons.next().expect("a row for each lesson");
            let text = LessonText::read(lesson.text).expect("a text with all sections");
            let end = minute(pair[1]).unwrap_or(45.0 + LONGEST);
            // Minutes are rounded.
            let room = end - begin + 1.0;
            assert!(room >= text.minutes(), "{}: {room} minutes", lesson.name);
            assert!(begin < 45.0, "{}: begins at {begin}", lesson.name);
        }
        assert!(
            lessons.next().is_none(),
            "{}: lessons left out",
            course.name
        );
    }
}
