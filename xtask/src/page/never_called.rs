//! Code that libraries bring and the page never runs, taken out of its programs.
//!
//! The compiler cannot know that the page brings its own letters, or that it copies no pictures: which kind of font is
//! read and what is copied is decided while it runs. `xtask/never_called.toml` lists such functions with the reason; each
//! ends the program should it be called after all. What only they need goes with them: functions, and data, which become
//! zeros (`references.rs`). The journeys walk through programs that are built so.

use std::collections::BTreeSet;

use toml::{Table, Value};

use wasmparser::{Parser, Payload};

use super::{
    functions::Functions,
    profile::PROGRAMS,
    references::{References, Unneeded},
};

/// Code of a function that ends the program: no variables, `unreachable`, `end`.
const TRAP: [u8; 3] = [0, 0, 0x0b];

/// Number of the section of code.
const CODE: u8 = 10;

/// Functions that a program never calls.
#[derive(Debug)]
struct Group {
    /// Beginnings of their names, and behind a `*` what the names have later.
    begins: Vec<String>,
}

impl Group {
    /// Beginning of the list that `name` has.
    fn begin_of(&self, name: &str) -> Option<&str> {
        let mut begins = self.begins.iter().map(String::as_str);
        begins.find(|begin| match begin.split_once('*') {
            Some((begin, later)) => name
                .strip_prefix(begin)
                .is_some_and(|rest| rest.contains(later)),
            None => name.starts_with(begin),
        })
    }
}

/// The module without the code of what `list` (the text of `xtask/never_called.toml`) says that the program of
/// `package` never calls, or in words what is wrong with either. In a program that `is_shipped` a beginning that no
/// function has is wrong, too: what it was for is gone or has another name. Elsewhere some have become part of what calls
/// them, so that a group has to have one of them.
pub fn without(
    module: &[u8],
    list: &str,
    package: &str,
    is_shipped: bool,
) -> Result<Vec<u8>, String> {
    let groups = groups(list, package)?;
    let functions = Functions::of(module)?;
    // Telling their names takes longer than looking for them.
    let own: Vec<_> = functions.numbered().collect();
    let mut taken = Vec::new();
    let mut missing = Vec::new();
    for group in &groups {
        let mut unfound: BTreeSet<&str> = group.begins.iter().map(String::as_str).collect();
        for (number, name) in &own {
            if let Some(begin) = group.begin_of(name) {
                unfound.remove(begin);
                taken.push(*number);
            }
        }
        if is_shipped || unfound.len() == group.begins.len() {
            missing.extend(unfound);
        }
    }
    if !missing.is_empty() {
        let missing = missing.join(", ");
        return Err(format!("{package} has no function {missing} any more"));
    }
    taken.sort_unstable();
    let mut unneeded = References::of(module)?.unneeded(&functions, &taken);
    unneeded.functions.extend(taken);
    unneeded.functions.sort_unstable();
    rewritten(module, &functions, &unneeded).map_err(|error| error.to_string())
}

/// The groups of `package` in the text of the list.
fn groups(list: &str, package: &str) -> Result<Vec<Group>, String> {
    let table: Table = list.parse().map_err(|error| format!("{error}"))?;
    let mut groups = Vec::new();
    for entry in table
        .get("group")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
    {
        let texts = |key: &str| -> Vec<String> {
            let texts = entry.get(key).and_then(Value::as_array);
            let texts = texts.into_iter().flatten().filter_map(Value::as_str);
            texts.map(str::to_owned).collect()
        };
        let (programs, begins) = (texts("programs"), texts("begins"));
        let reason = entry.get("because").and_then(Value::as_str);
        if let Some(unknown) = programs
            .iter()
            .find(|name| !PROGRAMS.contains(&name.as_str()))
        {
            return Err(format!("{unknown} is no program of the page"));
        }
        if programs.is_empty() || begins.is_empty() || reason.is_none() {
            return Err("a group needs `programs`, `because` and `begins`".to_owned());
        }
        if programs.iter().any(|name| name == package) {
            groups.push(Group { begins });
        }
    }
    Ok(groups)
}

/// The module with traps in the place of functions and zeros in the place of data that are `unneeded`, and without what
/// the linker told.
fn rewritten(
    module: &[u8],
    functions: &Functions<'_>,
    unneeded: &Unneeded,
) -> wasmparser::Result<Vec<u8>> {
    let mut cleared = module.to_vec();
    for place in &unneeded.data {
        cleared[place.clone()].fill(0);
    }
    let mut made = Vec::new();
    let mut end = 0;
    for payload in Parser::new(0).parse_all(module) {
        let payload = payload?;
        let begin = end;
        match &payload {
            Payload::Version { range, .. } => end = range.end,
            _ => end = payload.as_section().map_or(end, |(_, section)| section.end),
        }
        match &payload {
            Payload::CodeSectionStart { .. } => made.extend(code(module, functions, unneeded)),
            Payload::DataSection(_) => made.extend(&cleared[begin..end]),
            Payload::CustomSection(section) if is_of_linker(section.name()) => {}
            _ => made.extend(&module[begin..end]),
        }
    }
    Ok(made)
}

/// Whether the linker wrote the section of that name for itself.
fn is_of_linker(name: &str) -> bool {
    name == "linking" || name.starts_with("reloc.")
}

/// The section of code with traps in the place of functions that are `unneeded`.
fn code(module: &[u8], functions: &Functions<'_>, unneeded: &Unneeded) -> Vec<u8> {
    let mut code = length(functions.bodies.len());
    for (number, body) in (functions.imported..).zip(&functions.bodies) {
        let content = if unneeded.functions.binary_search(&number).is_ok() {
            &TRAP
        } else {
            &module[body.clone()]
        };
        code.extend(length(content.len()));
        code.extend(content);
    }
    [&[CODE], &length(code.len())[..], &code].concat()
}

/// Number in bytes of seven bits each, the last of which come last.
fn length(mut rest: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    loop {
        let low = (rest & 0x7f) as u8;
        rest >>= 7;
        if rest == 0 {
            bytes.push(low);
            return bytes;
        }
        bytes.push(low | 0x80);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::functions::made;

    const PAGE: &str = PROGRAMS[0];

    fn list(begins: &str) -> String {
        format!("[[group]]\nprograms = [\"{PAGE}\"]\nbecause = \"a test\"\nbegins = [{begins}]")
    }

    /// Code of the three functions of the made module that are left.
    fn left(begins: &str) -> Result<Vec<Vec<u8>>, String> {
        let module = without(&made::module(), &list(begins), PAGE, true)?;
        let functions = Functions::of(&module)?;
        let own = functions.own();
        Ok(own.map(|(_, body)| module[body].to_vec()).collect())
    }

    #[test]
    fn what_is_listed_ends_the_program_and_the_rest_stays() {
        let (run, drop) = (vec![0, 1, 1, 1, 0x0b], vec![0, 1, 0x0b]);
        let third = left("\"egui::painter\"").unwrap();
        assert_eq!(third, [run.clone(), drop, TRAP.to_vec()]);
        let second = left("\"egui::*>::drop\"").unwrap();
        assert_eq!(second, [run, TRAP.to_vec(), TRAP.to_vec()]);
        let first = left("\"egui::context\"").unwrap();
        assert_eq!(first, [TRAP, TRAP, TRAP]);
    }

    #[test]
    fn data_that_only_they_need_become_zeros_and_the_linker_is_not_heard_any_more() {
        let has = |module: &[u8], text: &[u8]| module.windows(text.len()).any(|part| part == text);
        let taken = without(&made::module(), &list("\"egui::*>::drop\""), PAGE, true).unwrap();
        assert!(has(&taken, b"text\0\0\0\0") && has(&taken, b"egui7painter"));
        let whole = without(&made::module(), "", PAGE, true).unwrap();
        assert!(has(&whole, b"texttabl"));
        for module in [taken, whole] {
            assert!(!has(&module, b"linking") && !has(&module, b"reloc."));
        }
    }

    #[test]
    fn a_list_that_is_out_of_date_is_an_error() {
        assert!(left("\"gone\"").is_err());
        assert!(left("\"egui\", \"gone\"").is_err());
        assert!(left("").is_err());
        let without = |list: &str, shipped| without(&made::module(), list, PAGE, shipped).is_ok();
        assert!(without(&list("\"egui\", \"gone\""), false));
        assert!(!without(&list("\"gone\""), false));
        assert!(!without(&list("\"egui\"").replace("because", "why"), true));
        assert!(!without(&list("\"egui\"").replace(PAGE, "another"), true));
        let of_other = list("\"gone\"").replace(PAGE, PROGRAMS[1]);
        assert!(without(&of_other, true), "nothing is listed for the page");
    }

    #[test]
    fn the_list_can_be_read() {
        let list = include_str!("../../never_called.toml");
        assert!(!groups(list, PAGE).unwrap().is_empty());
    }

    #[test]
    fn numbers_are_written_as_the_format_has_them() {
        assert_eq!(length(0), [0]);
        assert_eq!(length(624_485), [0xe5, 0x8e, 0x26]);
    }
}
