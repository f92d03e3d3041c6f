//! Weight of a program by crate, from its code and the names in it.

use std::{collections::BTreeMap, fs, path::Path};

use wasmparser::{KnownCustom, Name, NameSectionReader, Parser, Payload};

use crate::failure::Failure;

/// Bytes of code by crate in the module at `place` (with its names), the heaviest first. Code made from a
/// generic function counts for the crate that wrote the function.
pub fn by_crate(place: &Path) -> Result<Vec<(String, u64)>, Failure> {
    let module = fs::read(place).map_err(Failure::file(place))?;
    of_module(&module).map_err(|reason| Failure::Content {
        path: place.to_owned(),
        reason,
    })
}

fn of_module(module: &[u8]) -> Result<Vec<(String, u64)>, String> {
    let mut imported = 0;
    let mut bodies = Vec::new();
    let mut names = BTreeMap::new();
    for payload in Parser::new(0).parse_all(module) {
        match payload.map_err(|error| error.to_string())? {
            Payload::ImportSection(imports) => {
                for import in imports.into_imports() {
                    let import = import.map_err(|error| error.to_string())?;
                    let is_function = matches!(import.ty, wasmparser::TypeRef::Func(_));
                    imported += u32::from(is_function);
                }
            }
            Payload::CodeSectionEntry(body) => {
                let range = body.range();
                bodies.push((range.end - range.start) as u64);
            }
            Payload::CustomSection(section) => {
                if let KnownCustom::Name(parts) = section.as_known() {
                    names.extend(function_names(parts).map_err(|error| error.to_string())?);
                }
            }
            _ => {}
        }
    }
    let mut sums: BTreeMap<String, u64> = BTreeMap::new();
    for (index, bytes) in (imported..).zip(&bodies) {
        let name = names.get(&index).copied().unwrap_or_default();
        *sums.entry(crate_of(name)).or_default() += bytes;
    }
    let mut sums: Vec<_> = sums.into_iter().collect();
    sums.sort_by(|one, other| other.1.cmp(&one.1).then(one.0.cmp(&other.0)));
    Ok(sums)
}

/// Names of functions by their number.
fn function_names(parts: NameSectionReader<'_>) -> wasmparser::Result<Vec<(u32, &str)>> {
    let mut names = Vec::new();
    for part in parts {
        if let Name::Function(map) = part? {
            for naming in map {
                let naming = naming?;
                names.push((naming.index, naming.name));
            }
        }
    }
    Ok(names)
}

/// The crate that a mangled name comes from: `egui` of `egui::context::Context::run`, and of
/// `<egui::Ui as core::ops::Drop>::drop`.
fn crate_of(mangled: &str) -> String {
    let name = format!("{:#}", rustc_demangle::demangle(mangled));
    let begin = name.trim_start_matches(['<', '&', '*', '[', '(']);
    let begin = ["mut ", "dyn ", "const "]
        .iter()
        .fold(begin, |text, word| text.trim_start_matches(word));
    let end = begin.find(|c: char| !(c.is_alphanumeric() || c == '_'));
    match end {
        Some(end) if end > 0 && begin[end..].starts_with("::") => begin[..end].to_owned(),
        _ => "(no crate)".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A module with an imported function and two own ones of five and of three bytes, named.
    fn module() -> Vec<u8> {
        // A length in two bytes of seven bits each.
        let length = |count: usize| {
            let count = u16::try_from(count).expect("a short part");
            [(count & 0x7f) as u8 | 0x80, (count >> 7) as u8]
        };
        let section =
            |id: u8, content: &[u8]| [&[id][..], &length(content.len()), content].concat();
        let names = |names: &[(u8, &str)]| {
            let count = u8::try_from(names.len()).expect("few names");
            let mut map = vec![count];
            for (index, name) in names {
                map.extend([*index, u8::try_from(name.len()).expect("a short name")]);
                map.extend(name.as_bytes());
            }
            [&[4][..], b"name", &[1], &length(map.len()), &map].concat()
        };
        let named = names(&[
            (0, "the_page"),
            (1, "_ZN4egui7context3run17h0123456789abcdefE"),
            (
                2,
                "_ZN50_$LT$egui..Ui$u20$as$u20$core..ops..drop..Drop$GT$4drop17h0123456789abcdefE",
            ),
        ]);
        [
            b"\0asm\x01\0\0\0".to_vec(),
            section(1, &[1, 0x60, 0, 0]),
            section(2, b"\x01\x01a\x01b\0\0"),
            section(3, &[2, 0, 0]),
            section(10, &[2, 5, 0, 1, 1, 1, 0x0b, 3, 0, 1, 0x0b]),
            section(0, &named),
        ]
        .concat()
    }

    #[test]
    fn code_is_summed_by_the_crate_that_wrote_it_behind_what_is_imported() {
        assert_eq!(of_module(&module()), Ok(vec![("egui".to_owned(), 8)]));
    }

    #[test]
    fn a_crate_is_read_from_names_of_functions_methods_and_impls() {
        assert_eq!(crate_of("_ZN4core3fmt5write17h0123456789abcdefE"), "core");
        let of_trait =
            "_ZN50_$LT$egui..Ui$u20$as$u20$core..ops..drop..Drop$GT$4drop17h0123456789abcdefE";
        assert_eq!(crate_of(of_trait), "egui");
        assert_eq!(crate_of("__wbindgen_malloc"), "(no crate)");
    }

    #[test]
    fn what_is_no_module_is_refused() {
        assert!(of_module(b"a letter").is_err());
    }
}
