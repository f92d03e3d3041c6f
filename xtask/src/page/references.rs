//! Code and data that a module needs, as the linker tells it (`--emit-relocs` in `.cargo/config.toml`): it leaves
//! every place that it has filled in with a function or an address, and what that is of. Format: Linking.md of
//! WebAssembly's tool conventions.

use std::ops::Range;

use wasmparser::{
    KnownCustom, Linking, LinkingSectionReader, Parser, Payload, RelocSectionReader,
    RelocationType, SymbolFlags, SymbolInfo,
};

use super::functions::Functions;

/// A function or a piece of data that has a name for the linker.
#[derive(Debug)]
enum Symbol {
    /// The function of that number.
    Function(u32),
    /// Bytes of the module.
    Data(Range<usize>),
    /// A global or a table, or data that only an address is known of.
    Other,
}

/// The references of a module.
#[derive(Debug, Default)]
pub struct References {
    symbols: Vec<Symbol>,
    /// Symbols that are meant to stay, whoever needs them.
    kept: Vec<usize>,
    /// Functions that are called from outside.
    exported: Vec<u32>,
    /// Whether functions run before all others.
    has_beginners: bool,
    /// Place in the module and the symbol that it needs, in the order of the places.
    needs: Vec<(usize, usize)>,
}

/// Code and data of a module that nothing needs.
#[derive(Debug, PartialEq, Eq)]
pub struct Unneeded {
    /// Numbers of functions, imported ones counted first, in order.
    pub functions: Vec<u32>,
    /// Bytes of the module.
    pub data: Vec<Range<usize>>,
}

impl References {
    /// Those of `module`, or in words what is wrong with it.
    pub fn of(module: &[u8]) -> Result<Self, String> {
        let mut reading = Reading::default();
        for payload in Parser::new(0).parse_all(module) {
            payload
                .and_then(|payload| reading.take(payload))
                .map_err(|error| error.to_string())?;
        }
        let mut references = reading.references;
        if references.symbols.is_empty() {
            return Err("the linker was not told to leave its references".to_owned());
        }
        if references.has_beginners {
            let why =
                "functions run before all others, and the linker does not tell who calls them";
            return Err(why.to_owned());
        }
        references.needs.sort_unstable();
        Ok(references)
    }

    /// Code and data that nothing needs once the functions `taken` (numbers, in order) need nothing any more.
    pub fn unneeded(&self, functions: &Functions<'_>, taken: &[u32]) -> Unneeded {
        let count = functions.imported as usize + functions.bodies.len();
        let (mut needed, mut called) = (vec![false; self.symbols.len()], vec![false; count]);
        let mut left: Vec<usize> = self.kept.clone();
        let mut calls: Vec<u32> = self.exported.clone();
        loop {
            let place = if let Some(number) = calls.pop() {
                if std::mem::replace(&mut called[number as usize], true) {
                    continue;
                }
                let own = number.checked_sub(functions.imported);
                let is_taken = taken.binary_search(&number).is_ok();
                own.filter(|_| !is_taken)
                    .map(|own| functions.bodies[own as usize].clone())
            } else if let Some(symbol) = left.pop() {
                if std::mem::replace(&mut needed[symbol], true) {
                    continue;
                }
                match &self.symbols[symbol] {
                    Symbol::Function(number) => {
                        calls.push(*number);
                        None
                    }
                    Symbol::Data(place) => Some(place.clone()),
                    Symbol::Other => None,
                }
            } else {
                break;
            };
            left.extend(place.into_iter().flat_map(|place| self.needs_of(place)));
        }
        let own = (functions.imported..).take(functions.bodies.len());
        Unneeded {
            functions: own.filter(|number| !called[*number as usize]).collect(),
            data: self.data_but(&needed),
        }
    }

    /// Symbols that the bytes at `place` need.
    fn needs_of(&self, place: Range<usize>) -> impl Iterator<Item = usize> {
        let at = |place: usize| self.needs.partition_point(|need| need.0 < place);
        self.needs[at(place.start)..at(place.end)]
            .iter()
            .map(|need| need.1)
    }

    /// Bytes of the data that belong to no `needed` symbol: several may share some.
    fn data_but(&self, needed: &[bool]) -> Vec<Range<usize>> {
        let data = |wanted: bool| {
            let symbols = self.symbols.iter().zip(needed);
            let places = symbols.filter_map(move |(symbol, is_needed)| match symbol {
                Symbol::Data(place) if *is_needed == wanted => Some(place.clone()),
                _ => None,
            });
            let mut places: Vec<_> = places.collect();
            places.sort_by_key(|place| place.start);
            places
        };
        let kept = data(true);
        let mut free = Vec::new();
        for place in data(false) {
            let mut begin = place.start;
            let others = kept.iter().filter(|kept| kept.end > place.start);
            for other in others.take_while(|kept| kept.start < place.end) {
                if other.start > begin {
                    free.push(begin..other.start);
                }
                begin = begin.max(other.end);
            }
            if begin < place.end {
                free.push(begin..place.end);
            }
        }
        free
    }
}

/// A module as far as it was read.
#[derive(Default)]
struct Reading {
    /// Beginnings of the contents of the sections.
    sections: Vec<usize>,
    /// Sections of code and of data.
    with_needs: Vec<u32>,
    /// Beginnings of the bytes of the pieces of memory.
    segments: Vec<usize>,
    references: References,
}

impl Reading {
    fn take(&mut self, payload: Payload<'_>) -> wasmparser::Result<()> {
        let number = u32::try_from(self.sections.len()).unwrap_or(u32::MAX);
        if let Some((_, content)) = payload.as_section() {
            self.sections.push(content.start);
        }
        match payload {
            Payload::ExportSection(exports) => {
                for export in exports {
                    let export = export?;
                    if export.kind == wasmparser::ExternalKind::Func {
                        self.references.exported.push(export.index);
                    }
                }
            }
            Payload::StartSection { func, .. } => self.references.exported.push(func),
            Payload::CodeSectionStart { .. } => self.with_needs.push(number),
            Payload::DataSection(segments) => {
                self.with_needs.push(number);
                for segment in segments {
                    let segment = segment?;
                    self.segments.push(segment.range.end - segment.data.len());
                }
            }
            Payload::CustomSection(section) => match section.as_known() {
                KnownCustom::Linking(parts) => self.symbols(&parts)?,
                KnownCustom::Reloc(needs) => self.needs(&needs)?,
                _ => {}
            },
            _ => {}
        }
        Ok(())
    }

    fn symbols(&mut self, parts: &LinkingSectionReader<'_>) -> wasmparser::Result<()> {
        for part in parts.subsections() {
            match part? {
                Linking::SymbolTable(symbols) => {
                    for symbol in symbols {
                        self.symbol(&symbol?);
                    }
                }
                Linking::InitFuncs(_) => self.references.has_beginners = true,
                _ => {}
            }
        }
        Ok(())
    }

    fn symbol(&mut self, symbol: &SymbolInfo<'_>) {
        let (flags, symbol) = match *symbol {
            SymbolInfo::Func { flags, index, .. } => (flags, Symbol::Function(index)),
            SymbolInfo::Data { flags, symbol, .. } => {
                let place = symbol.and_then(|symbol| {
                    let segment = self.segments.get(symbol.index as usize)?;
                    let begin = segment + symbol.offset as usize;
                    Some(begin..begin + symbol.size as usize)
                });
                (flags, place.map_or(Symbol::Other, Symbol::Data))
            }
            SymbolInfo::Global { flags, .. }
            | SymbolInfo::Section { flags, .. }
            | SymbolInfo::Event { flags, .. }
            | SymbolInfo::Table { flags, .. } => (flags, Symbol::Other),
        };
        let references = &mut self.references;
        if flags.intersects(SymbolFlags::EXPORTED | SymbolFlags::NO_STRIP) {
            references.kept.push(references.symbols.len());
        }
        references.symbols.push(symbol);
    }

    fn needs(&mut self, needs: &RelocSectionReader<'_>) -> wasmparser::Result<()> {
        let section = needs.section_index();
        if !self.with_needs.contains(&section) {
            return Ok(());
        }
        let begin = self.sections[section as usize];
        for need in needs.entries() {
            let need = need?;
            // A type has no symbol.
            if need.ty != RelocationType::TypeIndexLeb {
                let place = begin + need.offset as usize;
                self.references.needs.push((place, need.index as usize));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::functions::made;

    /// Functions and bytes of data that are unneeded once `taken` are taken.
    fn unneeded(taken: &[u32]) -> (Vec<u32>, Vec<Vec<u8>>) {
        let module = made::module();
        let references = References::of(&module).unwrap();
        let unneeded = references.unneeded(&Functions::of(&module).unwrap(), taken);
        let data = unneeded
            .data
            .into_iter()
            .map(|place| module[place].to_vec());
        (unneeded.functions, data.collect())
    }

    #[test]
    fn what_only_taken_code_needs_is_unneeded() {
        assert_eq!(unneeded(&[]), (vec![], vec![]));
        // `drop` needs the table that holds `paint`; `run` needs `drop` and its own text.
        assert_eq!(unneeded(&[2]), (vec![3], vec![b"tabl".to_vec()]));
        let both = (vec![2, 3], vec![b"tex".to_vec(), b"tabl".to_vec()]);
        assert_eq!(unneeded(&[1]), both, "the last letter is another's, too");
    }

    #[test]
    fn a_module_that_says_no_references_is_refused() {
        let bare = b"\0asm\x01\0\0\0";
        assert!(References::of(bare).unwrap_err().contains("references"));
    }
}
