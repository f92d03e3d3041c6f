//! Papers against the sources: what can be chosen is written up, what is written up exists, and papers stay short.

use std::collections::BTreeSet;

use crate::{Violation, sources::Source};

/// Papers that are read at one sitting, with the lines that they may have.
pub const SHORT_PAPERS: [(&str, usize); 2] = [("README.md", 120), ("docs/results.md", 200)];

/// The violation of a paper with over `most` lines; `None` of a shorter one.
pub fn too_long(path: &str, text: &str, most: usize) -> Option<Violation> {
    let length = text.lines().count();
    (length > most).then(|| Violation {
        file: path.to_owned(),
        line: 0,
        complaint: format!(
            "{length} lines, more than {most}: give what is of less use a page of its own"
        ),
    })
}

/// Names of which `paper` says nothing in backticks.
pub fn unwritten(path: &str, paper: &str, names: &[String]) -> Vec<Violation> {
    let all = spans(paper);
    let written: BTreeSet<&str> = all.iter().flat_map(|(_, span)| words(span)).collect();
    let is_written = |name: &&String| {
        written.contains(name.as_str()) || all.iter().any(|(_, span)| span == name)
    };
    let missing = names.iter().filter(|name| !is_written(name));
    let violation = |name: &String| Violation {
        file: path.to_owned(),
        line: 0,
        complaint: format!("says nothing of `{name}`"),
    };
    missing.map(violation).collect()
}

/// Identifiers and keys in backticks of `paper` that no Rust file of `sources` has: of paths as `Gate::of`, and of keys
/// with hyphens as `gps-velocity`, which are texts there. Files, commands and formulas are passed over.
pub fn unknown(path: &str, paper: &str, sources: &[Source]) -> Vec<Violation> {
    let rust = || sources.iter().filter(|source| source.is("rs"));
    let known: BTreeSet<&str> = rust().flat_map(|source| words(&source.text)).collect();
    let is_text = |key: &str| {
        let quoted = format!("\"{key}\"");
        rust().any(|source| source.text.contains(&quoted))
    };
    let mut found = Vec::new();
    for (line, span) in spans(paper) {
        let is_known = if is_key(span) {
            is_text(span)
        } else {
            !is_path(span) || words(span).all(|word| known.contains(word))
        };
        if !is_known {
            found.push(Violation {
                file: path.to_owned(),
                line,
                complaint: format!("the sources have no `{span}`"),
            });
        }
    }
    found
}

/// Sections of a file's documentation that make it a paper of its own.
const EQUATIONS: &str = "# Equations";
const SOURCE: &str = "# Source";

/// Whether the documentation at the beginning of a file gives the equations of what it has (at least one, under the
/// heading `# Equations`) and says where they are from (under `# Source`).
pub fn gives_equations(text: &str) -> bool {
    let lines: Vec<&str> = text
        .lines()
        .map_while(|line| line.strip_prefix("//!"))
        .map(str::trim)
        .collect();
    let section = |heading: &str| {
        let begin = lines.iter().position(|line| *line == heading)?;
        let rest = lines[begin + 1..].iter().copied();
        let rest = rest.take_while(|line| !line.starts_with("# "));
        Some(rest.collect::<String>())
    };
    section(EQUATIONS).is_some_and(|words| words.contains('='))
        && section(SOURCE).is_some_and(|words| !words.is_empty())
}

/// Keys by which people choose among the constants `NAME: info = info { key: … }` of the files, each with its file.
///
/// A key that is no text is the member of another constant of the files, as `ROADS.aid`.
pub fn keys<'a>(sources: &'a [Source], info: &str) -> Vec<(&'a Source, String)> {
    let declared = format!(": {info} = {info} {{");
    let bodies = sources.iter().filter_map(|source| {
        let (_, body) = source.text.split_once(&declared)?;
        let (_, key) = body.split_once("key: ")?;
        Some((source, key))
    });
    let read = |key: &str| {
        text_at(key).or_else(|| {
            let (name, member) = key.split_once(',')?.0.split_once('.')?;
            let (constant, member) = (format!("const {name}: "), format!("{member}: "));
            let rest = |source: &Source| {
                let (_, body) = source.text.split_once(&constant)?;
                text_at(body.split_once(&member)?.1)
            };
            sources.iter().find_map(rest)
        })
    };
    bodies
        .filter_map(|(source, key)| Some((source, read(key)?)))
        .collect()
}

/// Names of the lines `Name = "key", …` in the list `list! { … }` of a file.
pub fn listed(text: &str, list: &str) -> Vec<String> {
    let begin = format!("\n{list}! {{\n");
    let body = text.split_once(&begin).map_or("", |(_, body)| body);
    let body = body.split_once("\n}").map_or("", |(body, _)| body);
    let name = |line: &str| Some(line.split_once(" = \"")?.0.trim().to_owned());
    body.lines().filter_map(name).collect()
}

/// The text in quotation marks with which `rest` begins.
fn text_at(rest: &str) -> Option<String> {
    let (text, _) = rest.strip_prefix('"')?.split_once('"')?;
    Some(text.to_owned())
}

/// Spans in backticks, each with its line; those of a fenced block are none.
fn spans(paper: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut is_fenced = false;
    for (index, line) in paper.lines().enumerate() {
        is_fenced ^= line.starts_with("```");
        if !is_fenced {
            let within = line.split('`').skip(1).step_by(2);
            found.extend(within.map(|span| (index + 1, span)));
        }
    }
    found
}

/// Identifiers of a text: letters, digits and underscores, no digit first.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
    parts.filter(|part| part.starts_with(|first: char| first.is_alphabetic() || first == '_'))
}

/// Whether a span is an identifier, or some of them behind each other as in `Gate::of`, with their parameters.
fn is_path(span: &str) -> bool {
    let is_allowed = |letter: char| letter.is_ascii_alphanumeric() || "_:<>{}, ".contains(letter);
    let begins = span.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_');
    begins && span.chars().all(is_allowed) && (!span.contains(' ') || span.contains("::{"))
}

/// Whether a span is a key of several words, as `gps-velocity`.
fn is_key(span: &str) -> bool {
    let is_part = |part: &str| {
        !part.is_empty() && (part.chars()).all(|c| c.is_ascii_lowercase() || c.is_ascii_digit())
    };
    span.contains('-') && span.split('-').all(is_part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::made_of;

    fn complaints(found: &[Violation]) -> Vec<(usize, &str)> {
        (found.iter().map(|v| (v.line, v.complaint.as_str()))).collect()
    }

    #[test]
    fn a_paper_that_is_too_long_is_noticed() {
        assert_eq!(too_long("a.md", "a\nb\n", 2), None);
        assert!(too_long("a.md", "a\nb\nc\n", 2).is_some());
    }

    #[test]
    fn names_of_things_that_are_gone_are_noticed_and_formulas_and_files_are_not() {
        let sources = made_of(&[
            (
                "a.rs",
                "struct Gate<const N: usize>; impl Gate { fn of() {} } const A: &str = \"gps-velocity\";",
            ),
            ("b.md", "Door"),
        ]);
        let paper = "`Gate::of`, `Gate<N>`, `gps-velocity`, `Gate::{of, Door}`\n`gps-speed`, `Door`\n```\n`Door`\n```\n\
                     `Door / 2`, `door/open.rs`, `pilotage open --door`, `Door(a - b)`";
        let found = unknown("p.md", paper, &sources);
        assert_eq!(
            complaints(&found),
            [
                (1, "the sources have no `Gate::{of, Door}`"),
                (2, "the sources have no `gps-speed`"),
                (2, "the sources have no `Door`"),
            ]
        );
    }

    #[test]
    fn keys_are_read_from_where_they_stand_and_one_of_which_nothing_is_written_is_noticed() {
        let sources = made_of(&[
            (
                "a.rs",
                "pub const INFO: AidInfo = AidInfo {\n    key: \"gps\",\n    numbers: &[N { key: \"x\" }],\n};",
            ),
            (
                "b.rs",
                "pub const INFO: AidInfo = AidInfo {\n    key: ROADS.aid,\n};",
            ),
            (
                "c.rs",
                "pub const ROADS: MapErrorOf = MapErrorOf {\n    aid: \"roads\",\n};",
            ),
            (
                "d.rs",
                "pub const INFO: OtherInfo = OtherInfo {\n    key: \"other\",\n};",
            ),
        ]);
        let found = keys(&sources, "AidInfo");
        let files: Vec<_> = found.iter().map(|(source, _)| &*source.path).collect();
        assert_eq!(files, ["a.rs", "b.rs"]);
        let keys: Vec<_> = found.into_iter().map(|(_, key)| key).collect();
        assert_eq!(keys, ["gps", "roads"]);
        let found = unwritten("p.md", "By `gps` on roads.", &keys);
        assert_eq!(complaints(&found), [(0, "says nothing of `roads`")]);
    }

    #[test]
    fn a_file_that_gives_its_equations_and_their_source_is_a_paper_of_its_own() {
        let file = |equations: &str, source: &str| {
            format!(
                "//! A filter.\n//!\n//! {equations}\n//!\n//! {source}\n\nfn f() {{}}\n//! # Source\n//! Later."
            )
        };
        let equations = "# Equations\n//!\n//! K = P Hᵀ S⁻¹.";
        let source = "# Source\n//!\n//! Kalman 1960.";
        assert!(gives_equations(&file(equations, source)));
        for (equations, source) in [
            ("K = P Hᵀ S⁻¹.", source),
            ("# Equations\n//!\n//! As usual.", source),
            (equations, "Kalman 1960."),
            (equations, "# Source"),
            ("# Equations", "# Source\n//!\n//! K = P Hᵀ S⁻¹."),
        ] {
            assert!(
                !gives_equations(&file(equations, source)),
                "{equations}, {source}"
            );
        }
    }

    #[test]
    fn names_of_a_list_are_read() {
        let text = "macro_rules! list { () => {} }\n\nlist! {\n    /// Text.\n    Walk = \"walk\", 2,\n        \"About.\";\n    Fly = \"fly\", 4,\n        \"About.\";\n}\n\nconst A: &str = \"a\";\n";
        assert_eq!(listed(text, "list"), ["Walk", "Fly"]);
    }
}
