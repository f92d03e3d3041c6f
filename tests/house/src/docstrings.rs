//! First words of documentation comments: the noun or the verb of the thing, in the field's words.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::{Violation, sources::Source};

/// First words that tell a reader nothing of the thing that is documented.
pub const EMPTY_WORDS: [&str; 6] = ["What", "Whether", "How", "Where", "One", "Which"];

/// Documentation comments of `source` that begin with one of [`EMPTY_WORDS`]. `Whether` may begin the
/// documentation of a `bool`: of a field, a constant, or a function that returns one.
pub fn empty_beginnings(source: &Source) -> Vec<Violation> {
    let mut found = Vec::new();
    if source.is("rs")
        && let Ok(tokens) = source.text.parse::<TokenStream>()
    {
        look_through(tokens, &mut found);
    }
    let complain = |(line, word): (usize, String)| Violation {
        file: source.path.clone(),
        line,
        complaint: format!("begins with `{word}`: begin with the noun or the verb of the thing"),
    };
    found.into_iter().map(complain).collect()
}

/// Notes line and first word of each documentation comment among `tokens`, and of those within their groups, that
/// begins with a word which it must not begin with.
fn look_through(tokens: TokenStream, found: &mut Vec<(usize, String)>) {
    let tokens: Vec<_> = tokens.into_iter().collect();
    let mut at = 0;
    while at < tokens.len() {
        if let Some((line, text, next)) = comment(&tokens, at) {
            let mut item = next;
            let is_of_file = is_mark(&tokens, at + 1, '!');
            while is_mark(&tokens, item + 1, '!') == is_of_file
                && let Some((_, after)) = attribute(&tokens, item)
            {
                item = after;
            }
            let word = text.split_whitespace().next().unwrap_or_default();
            let word = word.trim_matches(|letter: char| !letter.is_alphanumeric());
            let is_excused = word == "Whether" && is_bool(&tokens[item..]);
            if EMPTY_WORDS.contains(&word) && !is_excused {
                found.push((line, word.to_owned()));
            }
            at = item;
            continue;
        }
        if let TokenTree::Group(group) = &tokens[at] {
            look_through(group.stream(), found);
        }
        at += 1;
    }
}

/// The documentation comment at `at`: its line, the text of its first line, and the place after it.
fn comment(tokens: &[TokenTree], at: usize) -> Option<(usize, String, usize)> {
    let (text, next) = attribute(tokens, at)?;
    Some((tokens[at].span().start().line, text?, next))
}

/// The attribute at `at`: its text, if it is documentation, and the place after it.
fn attribute(tokens: &[TokenTree], at: usize) -> Option<(Option<String>, usize)> {
    if !is_mark(tokens, at, '#') {
        return None;
    }
    let inside = if is_mark(tokens, at + 1, '!') {
        at + 2
    } else {
        at + 1
    };
    let Some(TokenTree::Group(group)) = tokens.get(inside) else {
        return None;
    };
    if group.delimiter() != Delimiter::Bracket {
        return None;
    }
    let parts: Vec<_> = group.stream().into_iter().collect();
    let text = match parts.as_slice() {
        [TokenTree::Ident(name), _, TokenTree::Literal(text)] if name == "doc" => Some(
            text.to_string()
                .trim_matches(['"', 'r', '#', ' '])
                .to_owned(),
        ),
        _ => None,
    };
    Some((text, inside + 1))
}

/// Whether the token at `place` is that punctuation.
fn is_mark(tokens: &[TokenTree], place: usize, mark: char) -> bool {
    matches!(tokens.get(place), Some(TokenTree::Punct(it)) if it.as_char() == mark)
}

/// Whether the item at the beginning of `tokens` is a `bool` or returns one.
fn is_bool(tokens: &[TokenTree]) -> bool {
    let ends = |token: &TokenTree| match token {
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
        TokenTree::Punct(mark) => matches!(mark.as_char(), ';' | ',' | '='),
        _ => false,
    };
    let head: Vec<String> = until(tokens, ends)
        .iter()
        .map(ToString::to_string)
        .collect();
    head.iter().any(|token| token == "bool")
}

/// Tokens before the first that `ends`; an arrow is no equals sign.
fn until(tokens: &[TokenTree], ends: impl Fn(&TokenTree) -> bool) -> &[TokenTree] {
    let end = tokens.iter().position(ends);
    &tokens[..end.unwrap_or(tokens.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<usize> {
        let source = Source {
            path: "a.rs".to_owned(),
            text: text.to_owned(),
        };
        let found = empty_beginnings(&source);
        found.into_iter().map(|violation| violation.line).collect()
    }

    #[test]
    fn a_comment_that_begins_with_an_empty_word_is_noticed_wherever_it_stands() {
        let text = "//! What the file does.\n\n/// Where it lies.\npub struct A {\n    /// How far.\n    pub far: f64,\n}\n\
                    mod inner {\n    /// One of them.\n    fn f() {}\n}\n";
        assert_eq!(lines(text), [1, 3, 5, 9]);
        assert_eq!(
            lines("/// Place of the window.\n///\n/// What follows is more.\nfn f() {}"),
            [0; 0]
        );
        assert_eq!(lines("// What is no documentation.\nfn f() {}"), [0; 0]);
        assert_eq!(lines("/// Onewards, Whatever.\nfn f() {}"), [0; 0]);
    }

    #[test]
    fn whether_may_begin_what_a_bool_is_for() {
        assert_eq!(
            lines("/// Whether it is so.\n#[must_use]\npub fn f(a: &[u8; 4]) -> bool { true }"),
            [0; 0]
        );
        assert_eq!(
            lines("struct A {\n    /// Whether it is so.\n    pub so: bool,\n}"),
            [0; 0]
        );
        assert_eq!(
            lines("struct A {\n    /// Whether it is so.\n    pub so: f64,\n    b: bool,\n}"),
            [2]
        );
        assert_eq!(
            lines("/// Whether it is so.\nfn f() -> Result<(), ()> { bool::from(a) }"),
            [1]
        );
        assert_eq!(lines("/// How it is so.\nfn f() -> bool { true }"), [1]);
    }
}
