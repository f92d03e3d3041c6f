//! Names of types that other files see: a name means one thing in the whole workspace.

use std::collections::BTreeMap;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::{Violation, sources::Source};

/// Names that several such types share, each with the reason.
pub const SHARED: [(&str, &str); 2] = [
    (
        "Arguments",
        "each command of the terminal has its own, written behind the name of the command's module",
    ),
    (
        "Blob",
        "the browser's own type, of which page and workers each bind what they need",
    ),
];

/// Words before the name of a type that is declared.
const DECLARING: [&str; 5] = ["struct", "enum", "trait", "type", "union"];

/// Public types of `sources`, those behind `pub(…)` too, whose name another has that comes earlier, but for the names in
/// `shared`.
pub fn shared_names(sources: &[Source], shared: &[(&str, &str)]) -> Vec<Violation> {
    let mut first: BTreeMap<String, String> = BTreeMap::new();
    let mut found = Vec::new();
    for (source, line, name) in public_types(sources) {
        let place = format!("{}:{line}", source.path);
        if let Some(other) = first.get(&name) {
            if !shared.iter().any(|(excused, _)| *excused == name) {
                let complaint = format!(
                    "`{name}` is the name of {other} as well: say in the name what it is the {name} of"
                );
                found.push(Violation {
                    file: source.path.clone(),
                    line,
                    complaint,
                });
            }
        } else {
            first.insert(name, place);
        }
    }
    found
}

/// Names in `shared` that fewer than two public types of `sources` have.
pub fn no_longer_shared<'a>(sources: &[Source], shared: &[(&'a str, &str)]) -> Vec<&'a str> {
    let names: Vec<_> = public_types(sources).map(|(_, _, name)| name).collect();
    let count = |excused: &str| names.iter().filter(|name| *name == excused).count();
    let names = shared.iter().map(|(excused, _)| *excused);
    names.filter(|excused| count(excused) < 2).collect()
}

/// Public types of all Rust files: file, line, name.
fn public_types(sources: &[Source]) -> impl Iterator<Item = (&Source, usize, String)> {
    let rust = sources.iter().filter(|source| source.is("rs"));
    rust.flat_map(|source| {
        let mut found = Vec::new();
        if let Ok(tokens) = source.text.parse::<TokenStream>() {
            look_through(tokens, &mut found);
        }
        found
            .into_iter()
            .map(move |(line, name)| (source, line, name))
    })
}

/// Notes line and name of each public type that is declared among `tokens` and in their groups, modules of tests
/// left out.
fn look_through(tokens: TokenStream, found: &mut Vec<(usize, String)>) {
    let tokens: Vec<_> = tokens.into_iter().collect();
    for (at, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Ident(word) if word == "pub" => {
                let after = tokens[at + 1..].iter();
                let after = after.skip_while(|token| is_in_parentheses(token)).take(2);
                if let [TokenTree::Ident(kind), TokenTree::Ident(name)] =
                    after.collect::<Vec<_>>()[..]
                    && DECLARING.iter().any(|declaring| kind == declaring)
                {
                    found.push((name.span().start().line, name.to_string()));
                }
            }
            TokenTree::Group(group)
                if group.delimiter() == Delimiter::Brace && !is_module_of_tests(&tokens[..at]) =>
            {
                look_through(group.stream(), found);
            }
            _ => {}
        }
    }
}

/// Whether a token is a group in parentheses, as what tells behind `pub` how far something is seen.
fn is_in_parentheses(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Parenthesis)
}

/// Whether `before`, what stands before a block, ends in `mod tests`.
fn is_module_of_tests(before: &[TokenTree]) -> bool {
    matches!(before, [.., TokenTree::Ident(word), TokenTree::Ident(name)] if word == "mod" && name == "tests")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::made_of;

    fn places(files: &[(&str, &str)]) -> Vec<String> {
        let found = shared_names(&made_of(files), &[("Arguments", "a reason")]);
        let place = |violation: &Violation| format!("{}:{}", violation.file, violation.line);
        found.iter().map(place).collect()
    }

    #[test]
    fn a_second_public_type_of_a_name_is_noticed_whatever_its_kind_and_wherever_it_stands() {
        let files = [
            ("a/src/peak.rs", "pub struct Peak;"),
            (
                "b/src/peak.rs",
                "//! Peaks.\n\nmod inner {\n    #[derive(Debug)]\n    pub enum Peak { High }\n}",
            ),
            ("c/src/lib.rs", "use x::Peak;\npub type Peak = (f64, f64);"),
            (
                "d/src/job.rs",
                "macro_rules! m { () => { pub trait Peak {} } }",
            ),
            (
                "e/src/peak.rs",
                "pub(in crate::e) struct Peak(pub(super) f64);",
            ),
        ];
        assert_eq!(
            places(&files),
            [
                "b/src/peak.rs:5",
                "c/src/lib.rs:2",
                "d/src/job.rs:1",
                "e/src/peak.rs:1"
            ]
        );
    }

    #[test]
    fn what_others_cannot_see_or_what_has_a_reason_may_share_its_name() {
        let files = [
            ("a.rs", "pub struct Peak;\npub struct Arguments;"),
            ("b.rs", "struct Peak;\npub struct Arguments;"),
            ("c.rs", "fn f() { struct Peak; }\npub use a::Peak;"),
            ("d.rs", "mod tests { pub struct Peak; }\nfn f(_: Peak) {}"),
            ("e.rs", "impl A for B { type Peak = f64; }"),
        ];
        assert_eq!(places(&files), [""; 0]);
    }

    #[test]
    fn a_reason_for_a_name_that_stands_once_is_noticed() {
        let sources = made_of(&[("a.rs", "pub struct A;"), ("b.rs", "pub struct B;")]);
        assert_eq!(no_longer_shared(&sources, &[("A", "a reason")]), ["A"]);
        let sources = made_of(&[("a.rs", "pub struct A;"), ("b.rs", "pub struct A;")]);
        assert_eq!(no_longer_shared(&sources, &[("A", "a reason")]), [""; 0]);
    }
}
