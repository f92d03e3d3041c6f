//! The functions of a module of WebAssembly: where their code stands and what they are called.

use std::{collections::BTreeMap, ops::Range};

use wasmparser::{KnownCustom, Name, NameSectionReader, Parser, Payload, TypeRef};

/// The functions of a module that has its names.
#[derive(Debug, Default)]
pub struct Functions<'a> {
    /// Functions that come from outside and are counted first.
    pub imported: u32,
    /// Bytes of the code of each own function, without the length that stands before it.
    pub bodies: Vec<Range<usize>>,
    /// Mangled names by number.
    names: BTreeMap<u32, &'a str>,
}

impl<'a> Functions<'a> {
    /// Those of `module`, or in words what is wrong with it.
    pub fn of(module: &'a [u8]) -> Result<Self, String> {
        let mut functions = Self::default();
        for payload in Parser::new(0).parse_all(module) {
            functions
                .take(payload.map_err(|error| error.to_string())?)
                .map_err(|error| error.to_string())?;
        }
        Ok(functions)
    }

    fn take(&mut self, payload: Payload<'a>) -> wasmparser::Result<()> {
        match payload {
            Payload::ImportSection(imports) => {
                for import in imports.into_imports() {
                    self.imported += u32::from(matches!(import?.ty, TypeRef::Func(_)));
                }
            }
            Payload::CodeSectionEntry(body) => self.bodies.push(body.range()),
            Payload::CustomSection(section) => {
                if let KnownCustom::Name(parts) = section.as_known() {
                    self.names.extend(function_names(parts)?);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Demangled name, empty where there is none, and bytes of code of each own function.
    pub fn own(&self) -> impl Iterator<Item = (String, Range<usize>)> {
        self.numbered()
            .map(|(number, name)| (name, self.bodies[(number - self.imported) as usize].clone()))
    }

    /// Number, counted behind the imported ones, and demangled name of each own function.
    pub fn numbered(&self) -> impl Iterator<Item = (u32, String)> {
        (self.imported..).take(self.bodies.len()).map(|number| {
            let mangled = self.names.get(&number).copied().unwrap_or_default();
            (number, demangled(mangled))
        })
    }
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

/// Path of a function from its mangled name, without what stands before it: `egui::Ui as core::ops::Drop>::drop` of
/// `<egui::Ui as core::ops::Drop>::drop`.
fn demangled(mangled: &str) -> String {
    let name = format!("{:#}", rustc_demangle::demangle(mangled));
    let begin = name.trim_start_matches(['<', '&', '*', '[', '(']);
    let begin = ["mut ", "dyn ", "const "]
        .iter()
        .fold(begin, |text, word| text.trim_start_matches(word));
    begin.to_owned()
}

/// Modules for the tests.
#[cfg(test)]
pub mod made {
    /// A length in two bytes of seven bits each.
    fn length(count: usize) -> [u8; 2] {
        let count = u16::try_from(count).expect("a short part");
        [(count & 0x7f) as u8 | 0x80, (count >> 7) as u8]
    }

    fn section(id: u8, content: &[u8]) -> Vec<u8> {
        [&[id][..], &length(content.len()), content].concat()
    }

    /// A text behind its length.
    fn text(text: &str) -> Vec<u8> {
        let length = u8::try_from(text.len()).expect("a short text");
        [&[length], text.as_bytes()].concat()
    }

    /// A custom section.
    fn custom(name: &str, content: &[u8]) -> Vec<u8> {
        section(0, &[&text(name)[..], content].concat())
    }

    /// A module with an imported function and three own ones of five, three and two bytes, named, of which the first is
    /// exported. That needs the second and a text; the second needs a table that holds the third. The last letter
    /// of the text is that of another one, which is to be kept.
    pub fn module() -> Vec<u8> {
        let named = [
            (0, "the_page"),
            (1, "_ZN4egui7context3run17h0123456789abcdefE"),
            (
                2,
                "_ZN50_$LT$egui..Ui$u20$as$u20$core..ops..drop..Drop$GT$4drop17h0123456789abcdefE",
            ),
            (3, "_ZN4egui7painter5paint17h0123456789abcdefE"),
        ];
        let mut names = vec![4];
        names.extend(
            named
                .iter()
                .flat_map(|(number, name)| [&[*number], &text(name)[..]].concat()),
        );
        let function = |number: u8| vec![0, 0, number];
        let data = |name: &str, flags: &[u8], offset: u8, size: u8| {
            [&[1], flags, &text(name)[..], &[0, offset, size]].concat()
        };
        let mut symbols = vec![6];
        for (number, name) in [(1, "run"), (2, "drop"), (3, "paint")] {
            symbols.extend([function(number), text(name)].concat());
        }
        symbols.extend(data("text", &[0], 0, 4));
        symbols.extend(data("table", &[0], 4, 4));
        symbols.extend(data("letter", &[0x80, 1], 3, 1));
        let linking = [&[2, 8][..], &length(symbols.len()), &symbols].concat();
        [
            b"\0asm\x01\0\0\0".to_vec(),
            section(1, &[1, 0x60, 0, 0]),
            section(2, b"\x01\x01a\x01b\0\0"),
            section(3, &[3, 0, 0, 0]),
            section(5, &[1, 0, 1]),
            section(7, b"\x01\x01r\0\x01"),
            section(10, &[3, 5, 0, 1, 1, 1, 0x0b, 3, 0, 1, 0x0b, 2, 0, 0x0b]),
            section(11, b"\x01\0\x41\0\x0b\x08texttabl"),
            custom("linking", &linking),
            // Kind, place in the section, symbol, and for an address what is added to it.
            custom("reloc.CODE", &[5, 3, 0, 3, 1, 4, 4, 3, 0, 4, 9, 4, 0]),
            custom("reloc.DATA", &[6, 1, 2, 10, 2]),
            custom("name", &[&[1][..], &length(names.len()), &names].concat()),
        ]
        .concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_functions_are_named_behind_what_is_imported() {
        let module = made::module();
        let functions = Functions::of(&module).unwrap();
        let own: Vec<_> = functions.own().collect();
        let lengths: Vec<_> = own.iter().map(|(_, body)| body.len()).collect();
        assert_eq!(lengths, [5, 3, 2]);
        assert_eq!(own[0].0, "egui::context::run");
        assert_eq!(own[1].0, "egui::Ui as core::ops::drop::Drop>::drop");
    }

    #[test]
    fn what_is_no_module_is_refused() {
        assert!(Functions::of(b"a letter").is_err());
    }
}
