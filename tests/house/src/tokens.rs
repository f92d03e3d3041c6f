//! Rust sources as tokens: which paths they name, outside comments and texts.
//!
//! Tokens rather than a syntax tree, so that code inside macro calls counts as well.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// A path such as `std::fs::read`, as a source file names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedPath {
    /// Its parts; the trees of `use` are expanded, a glob ends in `*`, a macro call in `name!`.
    pub segments: Vec<String>,
    /// Modules opened inside the file around this place, outermost first.
    pub inside: Vec<String>,
    /// Line, counted from one.
    pub line: usize,
    /// Whether it stands under `#[cfg(test)]`.
    pub in_test: bool,
    /// Manner in which a `use` brings it in, where one does.
    pub import: Option<Import>,
}

/// Manner in which a `use` brings something in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Import {
    /// The name that it has from there on.
    pub name: String,
    /// Whether a visibility stands before the `use`, so that others may come here for it.
    pub is_exported: bool,
}

impl NamedPath {
    /// The path as it is written.
    pub fn text(&self) -> String {
        self.segments.join("::")
    }

    /// Whether this path is, lies below, or (through a glob) could bring in `other`.
    pub fn reaches(&self, other: &[&str]) -> bool {
        let own: Vec<_> = self.segments.iter().map(String::as_str).collect();
        match own.split_last() {
            Some((&"*", parents)) => other.starts_with(parents) || parents.starts_with(other),
            _ => own.starts_with(other),
        }
    }
}

/// Every path that `source` names, single identifiers included.
///
/// # Panics
/// If `source` is not Rust.
pub fn named_paths(source: &str) -> Vec<NamedPath> {
    let stream: TokenStream = source
        .parse()
        .unwrap_or_else(|error| panic!("not Rust: {error}:\n{source}"));
    paths_in(stream)
}

/// Every path that tokens name, single identifiers included.
pub(crate) fn paths_in(stream: TokenStream) -> Vec<NamedPath> {
    let mut walk = Walk::default();
    walk.tokens(stream);
    walk.found
}

#[derive(Default)]
struct Walk {
    found: Vec<NamedPath>,
    inside: Vec<String>,
    in_test: bool,
    /// Within a `use`: whether it exports what it brings in.
    in_use: Option<bool>,
}

impl Walk {
    fn tokens(&mut self, stream: TokenStream) {
        let tokens: Vec<_> = stream.into_iter().collect();
        let mut rest = tokens.as_slice();
        while !rest.is_empty() {
            rest = self.one(rest);
        }
    }

    /// Reads what begins here and returns what follows.
    fn one<'a>(&mut self, tokens: &'a [TokenTree]) -> &'a [TokenTree] {
        match tokens {
            [
                TokenTree::Punct(hash),
                TokenTree::Group(attribute),
                rest @ ..,
            ] if hash.as_char() == '#' && is_test_attribute(attribute) => {
                let (item, rest) = rest.split_at(item_length(rest));
                let before = std::mem::replace(&mut self.in_test, true);
                self.tokens(item.iter().cloned().collect());
                self.in_test = before;
                rest
            }
            [
                TokenTree::Ident(keyword),
                TokenTree::Ident(name),
                TokenTree::Group(body),
                rest @ ..,
            ] if keyword == "mod" && body.delimiter() == Delimiter::Brace => {
                self.inside.push(name.to_string());
                self.tokens(body.stream());
                self.inside.pop();
                rest
            }
            [
                TokenTree::Ident(public),
                TokenTree::Ident(keyword),
                rest @ ..,
            ] if public == "pub" && keyword == "use" => self.import(true, &tokens[1..2], rest),
            [
                TokenTree::Ident(public),
                TokenTree::Group(to),
                TokenTree::Ident(keyword),
                rest @ ..,
            ] if public == "pub" && keyword == "use" => {
                self.tokens(to.stream());
                self.import(true, &tokens[2..3], rest)
            }
            [TokenTree::Ident(keyword), rest @ ..] if keyword == "use" => {
                self.import(false, &tokens[..1], rest)
            }
            [TokenTree::Punct(dot), TokenTree::Punct(second), rest @ ..]
                if dot.as_char() == '.' && second.as_char() == '.' =>
            {
                rest
            }
            // A field or a method belongs to a value: its name is no path.
            [TokenTree::Punct(dot), TokenTree::Ident(_), rest @ ..] if dot.as_char() == '.' => rest,
            [TokenTree::Ident(_), ..] => self.path(&[], tokens),
            [TokenTree::Group(group), rest @ ..] => {
                self.tokens(group.stream());
                rest
            }
            _ => &tokens[1..],
        }
    }

    /// Reads what a `use` (`keyword`) brings in and returns what follows it.
    fn import<'a>(
        &mut self,
        is_exported: bool,
        keyword: &[TokenTree],
        tree: &'a [TokenTree],
    ) -> &'a [TokenTree] {
        self.path(&[], keyword);
        if !matches!(tree, [TokenTree::Ident(_), ..]) {
            return tree;
        }
        self.in_use = Some(is_exported);
        let rest = self.path(&[], tree);
        self.in_use = None;
        rest
    }

    /// Reads a path that begins here, after `prefix`, and returns what follows it.
    fn path<'a>(&mut self, prefix: &[String], mut tokens: &'a [TokenTree]) -> &'a [TokenTree] {
        let mut segments = prefix.to_vec();
        let line = tokens[0].span().start().line;
        loop {
            match tokens {
                [TokenTree::Ident(name), rest @ ..] => {
                    segments.push(name.to_string());
                    tokens = rest;
                }
                [TokenTree::Punct(star), rest @ ..] if star.as_char() == '*' => {
                    segments.push("*".to_owned());
                    tokens = rest;
                    break;
                }
                [TokenTree::Group(tree), rest @ ..] if tree.delimiter() == Delimiter::Brace => {
                    self.use_tree(&segments, tree);
                    return rest;
                }
                _ => break,
            }
            match tokens {
                [TokenTree::Punct(first), TokenTree::Punct(second), rest @ ..]
                    if first.as_char() == ':' && second.as_char() == ':' =>
                {
                    tokens = rest;
                }
                [TokenTree::Punct(bang), TokenTree::Group(_), ..] if bang.as_char() == '!' => {
                    if let Some(name) = segments.last_mut() {
                        name.push('!');
                    }
                    break;
                }
                _ => break,
            }
        }
        let import = self.in_use.map(|is_exported| Import {
            name: match tokens {
                [TokenTree::Ident(renames), TokenTree::Ident(name), ..] if renames == "as" => {
                    name.to_string()
                }
                _ => brought_in(&segments),
            },
            is_exported,
        });
        let (inside, in_test) = (self.inside.clone(), self.in_test);
        self.found.push(NamedPath {
            segments,
            inside,
            line,
            in_test,
            import,
        });
        tokens
    }

    /// Reads `{a, b::c, d::*}` after `prefix`.
    fn use_tree(&mut self, prefix: &[String], tree: &Group) {
        let tokens: Vec<_> = tree.stream().into_iter().collect();
        let is_comma =
            |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ',');
        for branch in tokens.split(is_comma).filter(|branch| !branch.is_empty()) {
            self.path(prefix, branch);
        }
    }
}

/// Name that a `use` of this path brings in: its last part, for `self` the part before it.
fn brought_in(segments: &[String]) -> String {
    let named = segments.iter().rev().find(|segment| *segment != "self");
    named.cloned().unwrap_or_default()
}

/// Whether an attribute is `#[cfg(test)]` (or a `cfg` that asks for `test` among others).
pub(crate) fn is_test_attribute(attribute: &Group) -> bool {
    let tokens: Vec<_> = attribute.stream().into_iter().collect();
    match tokens.as_slice() {
        [TokenTree::Ident(name), TokenTree::Group(condition)] if name == "cfg" => {
            let mut asked = condition.stream().into_iter();
            let first = asked.next();
            match first {
                Some(TokenTree::Ident(word)) if word == "test" => true,
                Some(TokenTree::Ident(word)) if word == "all" => asked
                    .next()
                    .is_some_and(|list| list.to_string().contains("test")),
                _ => false,
            }
        }
        _ => false,
    }
}

/// Words that begin an item or a statement; whatever begins otherwise is an arm, a variant or a field, which ends
/// at its comma.
const BEGINNINGS: [&str; 17] = [
    "pub",
    "fn",
    "struct",
    "enum",
    "union",
    "trait",
    "type",
    "const",
    "static",
    "mod",
    "use",
    "impl",
    "unsafe",
    "async",
    "extern",
    "macro_rules",
    "let",
];

/// Number of tokens up to the end of what begins here: its body, its semicolon or its comma.
pub(crate) fn item_length(tokens: &[TokenTree]) -> usize {
    let mut first = tokens;
    while let [TokenTree::Punct(hash), TokenTree::Group(_), rest @ ..] = first
        && hash.as_char() == '#'
    {
        first = rest;
    }
    let is_item = matches!(first.first(), Some(TokenTree::Ident(word))
        if BEGINNINGS.iter().any(|beginning| word == beginning));
    let ends = |token: &TokenTree| match token {
        TokenTree::Punct(mark) => mark.as_char() == ';' || (mark.as_char() == ',' && !is_item),
        TokenTree::Group(body) => body.delimiter() == Delimiter::Brace,
        _ => false,
    };
    tokens
        .iter()
        .position(ends)
        .map_or(tokens.len(), |last| last + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(source: &str) -> Vec<String> {
        named_paths(source).iter().map(NamedPath::text).collect()
    }

    #[test]
    fn the_tree_of_a_use_is_expanded() {
        let found = texts("use crate::{camera::Model, raster::{Image, warp::*}};");
        assert_eq!(
            found,
            [
                "use",
                "crate::camera::Model",
                "crate::raster::Image",
                "crate::raster::warp::*"
            ]
        );
    }

    #[test]
    fn a_use_tells_the_name_that_it_brings_in_and_whether_others_may_have_it() {
        let source =
            "use a::{b::{self, C}, d as e}; pub use f::*; pub(super) use g::h; fn i() { j::k() }";
        let found = named_paths(source);
        let imports = found.iter().filter_map(|path| path.import.as_ref());
        let imports: Vec<_> = imports
            .map(|import| (import.name.as_str(), import.is_exported))
            .collect();
        let expected = [
            ("b", false),
            ("C", false),
            ("e", false),
            ("*", true),
            ("h", true),
        ];
        assert_eq!(imports, expected);
    }

    #[test]
    fn comments_and_texts_name_nothing() {
        let found = texts("// crate::navigator\n/* std::fs */ const A: &str = \"std::fs\";");
        assert!(!found.iter().any(|path| path.contains("::")), "{found:?}");
    }

    #[test]
    fn code_inside_a_macro_call_counts() {
        let found = texts("fn f() { assert!(std::fs::exists(p)); }");
        assert!(found.contains(&"std::fs::exists".to_owned()), "{found:?}");
        assert!(found.contains(&"assert!".to_owned()), "{found:?}");
    }

    #[test]
    fn test_code_is_told_from_the_rest() {
        let source = "use a::b;\n#[cfg(test)]\nmod tests { use c::d; }\nuse e::f;";
        let found = named_paths(source);
        let test = |text: &str| {
            found
                .iter()
                .find(|path| path.text() == text)
                .map(|it| it.in_test)
        };
        assert_eq!(
            [test("a::b"), test("c::d"), test("e::f")],
            [Some(false), Some(true), Some(false)]
        );
    }

    #[test]
    fn fields_and_methods_are_no_paths_and_the_ends_of_a_range_are() {
        let found = texts("a.b.c::<D>(e..f, ..g)");
        assert_eq!(found, ["a", "D", "e", "f", "g"]);
    }

    #[test]
    fn an_arm_or_a_variant_of_the_tests_ends_at_its_comma() {
        let found = named_paths(
            "fn f() { match x { #[cfg(test)] A::B => a::b(), A::C => { c::d() } } }\n\
             enum E { #[cfg(test)] G, H(i::J) }\n\
             #[cfg(test)] fn k<L, M>() where L: N, M: o::P { q::r() }",
        );
        let tests = found.iter().filter(|path| path.in_test);
        let tests: Vec<_> = tests.map(NamedPath::text).collect();
        assert!(tests.contains(&"a::b".to_owned()) && tests.contains(&"q::r".to_owned()));
        let others = ["A::C", "c::d", "i::J"];
        assert!(
            !others
                .iter()
                .any(|other| tests.contains(&(*other).to_owned()))
        );
    }

    #[test]
    fn a_glob_reaches_what_it_could_bring_in() {
        let found = named_paths("use std::time::*; use std::*; use std::io::*;");
        let reaching = found
            .iter()
            .filter(|path| path.reaches(&["std", "time", "Instant"]));
        assert_eq!(
            reaching.map(NamedPath::text).collect::<Vec<_>>(),
            ["std::time::*", "std::*"]
        );
    }
}
