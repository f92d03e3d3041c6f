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
    let mut walk = Walk::default();
    walk.tokens(stream);
    walk.found
}

#[derive(Default)]
struct Walk {
    found: Vec<NamedPath>,
    inside: Vec<String>,
    in_test: bool,
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
            [TokenTree::Ident(_), ..] => self.path(&[], tokens),
            [TokenTree::Group(group), rest @ ..] => {
                self.tokens(group.stream());
                rest
            }
            _ => &tokens[1..],
        }
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
        let (inside, in_test) = (self.inside.clone(), self.in_test);
        self.found.push(NamedPath {
            segments,
            inside,
            line,
            in_test,
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

/// Whether an attribute is `#[cfg(test)]` (or a `cfg` that asks for `test` among others).
fn is_test_attribute(attribute: &Group) -> bool {
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

/// Number of tokens up to the end of the item that begins here: its body or its semicolon.
fn item_length(tokens: &[TokenTree]) -> usize {
    let ends = |token: &TokenTree| match token {
        TokenTree::Punct(mark) => mark.as_char() == ';',
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
