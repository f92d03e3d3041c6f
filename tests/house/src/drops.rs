//! Events and commands are dropped by name alone: an arm that takes the rest of them says that nobody waits for it.

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

use crate::{
    Violation,
    sources::Source,
    tokens::{is_test_attribute, item_length},
};

/// The enum whose values tell what came of a job.
pub const EVENT: &str = "JobEvent";

fn is_event(name: &str) -> bool {
    name == EVENT
}

/// Whether values of the enum `name` are brought to whoever carries them out.
fn is_brought(name: &str) -> bool {
    is_event(name) || name.ends_with("Command")
}

/// Arms of `source` that take any event and neither hand it on nor answer `false` or `None`, those that take any command
/// and do nothing, and questions for one kind of event that say nothing of the others. Tests may do all of it.
pub fn silent_arms(source: &Source) -> Vec<Violation> {
    let stream: TokenStream = source.text.parse().unwrap_or_default();
    let mut lines = Vec::new();
    walk(stream, &mut lines);
    let found = lines.into_iter().map(|(line, complaint)| Violation {
        file: source.path.clone(),
        line,
        complaint: complaint.to_owned(),
    });
    found.collect()
}

const REST: &str = "drops every other event or command in silence: name those that may come and are of no use, and \
                    answer `false` (or `None`) to the rest, which is told";

const ONE: &str =
    "drops every other event in silence: match on the event, so that each kind has its arm";

fn walk(stream: TokenStream, lines: &mut Vec<(usize, &'static str)>) {
    let tokens: Vec<_> = stream.into_iter().collect();
    let mut rest = tokens.as_slice();
    while let [first, behind @ ..] = rest {
        rest = match (first, behind.first()) {
            (TokenTree::Punct(hash), Some(TokenTree::Group(attribute)))
                if hash.as_char() == '#' && is_test_attribute(attribute) =>
            {
                &behind[1 + item_length(&behind[1..])..]
            }
            _ => behind,
        };
        match first {
            TokenTree::Ident(word) if word == "match" => {
                let body = behind.iter().find_map(braces);
                lines.extend(body.and_then(|body| silent_arm(&body)));
            }
            TokenTree::Ident(word) if word == "let" && names(pattern(behind), is_event) => {
                lines.push((first.span().start().line, ONE));
            }
            TokenTree::Group(group) => walk(group.stream(), lines),
            _ => {}
        }
    }
}

/// Tokens of a block.
fn braces(token: &TokenTree) -> Option<Vec<TokenTree>> {
    match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
            Some(group.stream().into_iter().collect())
        }
        _ => None,
    }
}

/// Pattern of a `let`, which stands before this.
fn pattern(tokens: &[TokenTree]) -> &[TokenTree] {
    let ends = |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if matches!(mark.as_char(), '=' | ';'));
    let end = tokens.iter().position(ends).unwrap_or(0);
    &tokens[..end]
}

/// Whether a path among `tokens`, or in groups of them, begins with or leads through a name of these.
fn names(tokens: &[TokenTree], is_it: fn(&str) -> bool) -> bool {
    let leads_on = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Punct(mark)) if mark.as_char() == ':' && mark.spacing() == Spacing::Joint);
    let mut places = tokens.iter().enumerate();
    places.any(|(place, token)| match token {
        TokenTree::Ident(name) => is_it(&name.to_string()) && leads_on(tokens.get(place + 1)),
        TokenTree::Group(group) => names(&group.stream().into_iter().collect::<Vec<_>>(), is_it),
        _ => false,
    })
}

/// Arm of a `match`: its pattern with its guard, and what it does.
struct Arm<'a> {
    pattern: &'a [TokenTree],
    body: &'a [TokenTree],
}

/// Line of the arm in the body of a `match` on events or commands that takes the rest of them in silence.
fn silent_arm(body: &[TokenTree]) -> Option<(usize, &'static str)> {
    let arms = arms(body);
    let is_about = |is_it| arms.iter().any(|arm| names(arm.pattern, is_it));
    let (of_events, of_any) = (is_about(is_event), is_about(is_brought));
    // Much is asked about commands beside their being carried out, such as their keys.
    let is_silent = |arm: &&Arm<'_>| arm.is_silent() && (of_events || of_any && arm.does_nothing());
    let arm = arms.iter().find(is_silent)?;
    Some((arm.pattern.first()?.span().start().line, REST))
}

fn arms(body: &[TokenTree]) -> Vec<Arm<'_>> {
    let is_arrow = |pair: &[TokenTree]| match pair {
        [TokenTree::Punct(one), TokenTree::Punct(two)] => {
            one.as_char() == '=' && one.spacing() == Spacing::Joint && two.as_char() == '>'
        }
        _ => false,
    };
    let mut arrows: Vec<_> = body.windows(2).enumerate().collect();
    arrows.retain(|(_, pair)| is_arrow(pair));
    let arrows: Vec<_> = arrows.into_iter().map(|(place, _)| place).collect();
    let is_comma =
        |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ',');
    let mut begin = 0;
    let arm = |(number, arrow): (usize, &usize)| {
        let inside = arrow + 2;
        let next = arrows.get(number + 1).copied().unwrap_or(body.len());
        // A pattern has no comma outside its groups, and a block needs none behind it.
        let comma = body[inside..next].iter().rposition(is_comma);
        let end = match body.get(inside) {
            Some(block) if braces(block).is_some() => inside + 1,
            _ => comma.map_or(next, |comma| inside + comma),
        };
        let pattern = &body[begin..*arrow];
        begin = end + usize::from(body.get(end).is_some_and(is_comma));
        let body = &body[inside..end];
        Arm { pattern, body }
    };
    arrows.iter().enumerate().map(arm).collect()
}

impl Arm<'_> {
    fn is_silent(&self) -> bool {
        let is_guard = |token: &TokenTree| matches!(token, TokenTree::Ident(word) if word == "if");
        let end = self.pattern.iter().position(is_guard);
        let pattern = &self.pattern[..end.unwrap_or(self.pattern.len())];
        let is_or =
            |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == '|');
        let mut alternatives = pattern.split(is_or);
        alternatives.any(takes_any) && !self.answers_no() && !self.hands_on(pattern)
    }

    /// Whether it says that all is done, or nothing.
    fn does_nothing(&self) -> bool {
        match self.body {
            [TokenTree::Group(group)] => group.stream().is_empty(),
            [.., TokenTree::Ident(word)] => word == "return" || word == "true",
            _ => false,
        }
    }

    /// Whether it ends with `false` or `None`.
    fn answers_no(&self) -> bool {
        let block = self.body.first().and_then(braces);
        let body = block.as_deref().unwrap_or(self.body);
        let is_end = |token: &&TokenTree| matches!(token, TokenTree::Punct(mark) if matches!(mark.as_char(), ';' | ','));
        let last = body.iter().rev().find(|token| !is_end(token));
        matches!(last, Some(TokenTree::Ident(word)) if word == "false" || word == "None")
    }

    /// Whether what it took has a name, which it uses.
    fn hands_on(&self, pattern: &[TokenTree]) -> bool {
        match pattern {
            [TokenTree::Ident(name)] if name != "_" => is_used(&name.to_string(), self.body),
            _ => false,
        }
    }
}

/// Whether a pattern takes whatever comes: a gap, a name, or a gap in something that is no event or command.
fn takes_any(pattern: &[TokenTree]) -> bool {
    match pattern {
        [TokenTree::Ident(word)] => {
            let word = word.to_string();
            word.starts_with(|first: char| first == '_' || first.is_lowercase())
                && !["true", "false"].contains(&word.as_str())
        }
        [path @ .., TokenTree::Group(group)] if group.delimiter() == Delimiter::Parenthesis => {
            let inside: Vec<_> = group.stream().into_iter().collect();
            let is_gap = |token: &TokenTree| match token {
                TokenTree::Ident(word) => word == "_",
                TokenTree::Punct(mark) => mark.as_char() == ',',
                _ => false,
            };
            !names(path, is_brought) && !inside.is_empty() && inside.iter().all(is_gap)
        }
        _ => false,
    }
}

fn is_used(name: &str, tokens: &[TokenTree]) -> bool {
    tokens.iter().any(|token| match token {
        TokenTree::Ident(word) => word == name,
        TokenTree::Group(group) => is_used(name, &group.stream().into_iter().collect::<Vec<_>>()),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<usize> {
        let sources = crate::sources::made_of(&[("feature.rs", text)]);
        let found = sources.iter().flat_map(silent_arms);
        found.map(|violation| violation.line).collect()
    }

    #[test]
    fn a_rest_that_is_dropped_is_noticed_and_one_that_is_refused_is_not() {
        for (arm, is_silent) in [
            ("_ => {}", true),
            ("_ => return true,", true),
            ("_ => { self.job = Some(job); }", true),
            ("other => {}", true),
            ("JobEvent::Finished | _ => {}", true),
            ("_ if is_over => {}", true),
            ("WorkEvent::Content(_) => {}", true),
            ("(_, _) => {}", true),
            ("_ => return false,", false),
            ("_ => { self.job = Some(job); return false; }", false),
            ("_ => None,", false),
            ("other => self.plots.take(other),", false),
            ("JobEvent::Failed(_) => {}", false),
            ("JobEvent::Progress(..) | JobEvent::Finished => {}", false),
            ("WorkEvent::Taken => {}", false),
        ] {
            let text = format!(
                "fn f() {{ match event {{\n JobEvent::Flight(it) => self.take::<A, B>(it),\n \
                 JobEvent::Tile {{ window, .. }} => {{ window }}\n {arm}\n}} }}"
            );
            assert_eq!(lines(&text), vec![4; usize::from(is_silent)], "{arm}");
        }
    }

    #[test]
    fn commands_count_as_well_and_other_enums_and_tests_do_not() {
        let text = |name: &str| format!("fn f() {{ match it {{ {name}::A => b(), _ => {{}} }} }}");
        assert_eq!(lines(&text("PlanCommand")), [1]);
        let keys = text("PlanCommand").replace("{} } }", "Vec::new() } }");
        assert_eq!(lines(&keys), [0; 0]);
        assert_eq!(lines(&text("Key")), [0; 0]);
        let test = format!("#[cfg(test)] mod tests {{ {} }}", text("JobEvent"));
        assert_eq!(lines(&test), [0; 0]);
    }

    #[test]
    fn a_match_inside_another_counts_for_itself() {
        let text = "fn f() { match it {\n JobEvent::A(b) => match b {\n B::C => {}\n _ => {}\n },\n _ => return false,\n} }";
        assert_eq!(lines(text), [0; 0]);
        let text = "fn f() { match a {\n A::B => match it {\n JobEvent::C => {}\n _ => {}\n },\n _ => {}\n} }";
        assert_eq!(lines(text), [4]);
    }

    #[test]
    fn a_question_for_one_kind_of_event_is_noticed() {
        let text = "fn f() {\n if let (true, JobEvent::Flight(it)) = (a, event) { b(it) }\n}";
        assert_eq!(lines(text), [2]);
        let text = "fn f() { let Some(event) = next else { return }; g(JobEvent::Finished) }";
        assert_eq!(lines(text), [0; 0]);
    }
}
