//! Additions stay cheap: an entry of a table is a file or folder and a line, and no other file names it.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

use crate::{
    Violation,
    modules::{ModulePath, Modules},
    sources::Source,
    tokens::{NamedPath, named_paths},
};

/// A table whose macro declares the modules of its entries.
#[derive(Debug, Clone, Copy)]
pub struct EntryTable {
    /// Folder of the crate's sources, relative to the root of the repository.
    pub sources: &'static str,
    /// Folder in it that has the table in its own file; empty for the root.
    pub folder: &'static str,
    /// Name of the macro.
    pub call: &'static str,
    /// The enum that it makes, if it does, and the folder in whose files its variants count: who asks for a job names it.
    pub variants: Option<(&'static str, &'static str)>,
}

/// Every table to which people add.
pub const TABLES: [EntryTable; 9] = [
    EntryTable {
        sources: "crates/core/estimation/src",
        folder: "estimator",
        call: "estimators",
        variants: Some(("EstimatorChoice", "crates")),
    },
    EntryTable {
        sources: "crates/core/mission/src",
        folder: "exchange",
        call: "formats",
        variants: Some(("Format", "crates")),
    },
    EntryTable {
        sources: "crates/core/navigator/src",
        folder: "navigator/aids",
        call: "aids",
        variants: None,
    },
    EntryTable {
        sources: "crates/core/readers/src",
        folder: "log",
        call: "log_formats",
        variants: Some(("LogFormat", "crates")),
    },
    EntryTable {
        sources: "crates/core/simulate/src",
        folder: "simulate",
        call: "worlds",
        variants: None,
    },
    EntryTable {
        sources: "crates/jobs/src",
        folder: "",
        call: "orders",
        variants: Some(("Job", "crates/jobs/src")),
    },
    EntryTable {
        sources: "crates/lessons/src",
        folder: "lessons",
        call: "courses",
        variants: None,
    },
    EntryTable {
        sources: "crates/ui/src",
        folder: "",
        call: "features",
        variants: None,
    },
    EntryTable {
        sources: "crates/ui/src",
        folder: "learn/lessons",
        call: "lessons",
        variants: None,
    },
];

/// Line of a table.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry {
    /// Module that the line declares, if it does.
    pub module: Option<String>,
    /// Variant that it makes of the table's enum, if it makes one.
    pub variant: Option<String>,
}

/// Entry that other files name all the same: the table's macro, the entry as [`Entry::name`] has it, and the number of
/// those files.
pub type Named = (&'static str, &'static str, usize);

/// The entries that other files name, each with how many do: a number may shrink, never grow, and nothing be added.
pub const LEFT: [Named; 17] = [
    ("formats", "GeoJson", 1),
    ("orders", "Assess", 1),
    ("orders", "AssessShare", 1),
    ("orders", "DescribeMap", 1),
    ("orders", "Fly", 2),
    ("orders", "FramePicture", 2),
    ("orders", "LetGo", 1),
    ("orders", "Predict", 1),
    ("orders", "Propose", 1),
    ("orders", "Provide", 1),
    ("orders", "ReadLog", 1),
    ("orders", "Suggest", 1),
    ("orders", "SuggestShare", 1),
    ("orders", "SumUp", 1),
    ("orders", "Train", 1),
    ("features", "plan", 2),
    ("features", "web_map", 2),
];

impl EntryTable {
    /// The entries of the table among `sources`, those of its crate.
    pub fn entries(&self, sources: &[Source]) -> Vec<Entry> {
        let beside: BTreeSet<&str> = sources
            .iter()
            .filter_map(|source| self.module_of_folder(&source.path))
            .collect();
        let own = sources.iter().filter(|source| self.is_own(&source.path));
        own.flat_map(|source| {
            let stream: TokenStream = source.text.parse().unwrap_or_default();
            let call = call_of(self.call, stream);
            let mut entries = Vec::new();
            read(call, None, &beside, &mut entries);
            entries
        })
        .collect()
    }

    /// Whether the file at `path` is the own file of the table's folder.
    fn is_own(&self, path: &str) -> bool {
        let own = path.strip_prefix(self.folder).unwrap_or("");
        matches!(own, "/mod.rs" | "lib.rs")
    }

    /// Module directly in the table's folder to which the file at `path` belongs.
    fn module_of_folder<'a>(&self, path: &'a str) -> Option<&'a str> {
        let inside = path.strip_prefix(self.folder)?.trim_start_matches('/');
        let module = inside.split('/').next()?;
        Some(module.trim_end_matches(".rs"))
    }
}

impl Entry {
    /// Name of the entry: its variant, or its module.
    pub fn name(&self) -> &str {
        let name = self.variant.as_ref().or(self.module.as_ref());
        name.map_or("", String::as_str)
    }
}

/// Tokens in the call of the macro `name` among `stream`.
fn call_of(name: &str, stream: TokenStream) -> TokenStream {
    let tokens: Vec<_> = stream.into_iter().collect();
    let call = tokens.windows(3).find_map(|three| match three {
        [
            TokenTree::Ident(called),
            TokenTree::Punct(bang),
            TokenTree::Group(list),
        ] if called == name && bang.as_char() == '!' => Some(list.stream()),
        _ => None,
    });
    call.unwrap_or_default()
}

/// Notes the entries in `stream`, which stands in the braces behind the module `around` if it is given.
fn read(
    stream: TokenStream,
    around: Option<&str>,
    beside: &BTreeSet<&str>,
    entries: &mut Vec<Entry>,
) {
    let tokens: Vec<_> = stream.into_iter().collect();
    let ends = |token: &TokenTree| match token {
        TokenTree::Punct(mark) => matches!(mark.as_char(), ',' | ';'),
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
        _ => false,
    };
    for line in tokens.split_inclusive(ends) {
        let mut words = Vec::new();
        flatten(line, &mut words);
        let module = words.iter().find(|word| beside.contains(word.as_str()));
        if let Some(TokenTree::Group(list)) = line.last()
            && list.delimiter() == Delimiter::Brace
        {
            let around = module.map(String::as_str).or(around);
            read(list.stream(), around, beside, entries);
            continue;
        }
        let begins = line
            .iter()
            .position(|token| matches!(token, TokenTree::Ident(_)));
        let variant = begins.and_then(|begins| match &line[begins..] {
            [TokenTree::Ident(name), TokenTree::Group(_), ..] => Some(name.to_string()),
            [TokenTree::Ident(name), TokenTree::Punct(mark), ..]
                if mark.as_char() == ':' && mark.spacing() == Spacing::Alone =>
            {
                Some(name.to_string())
            }
            _ => None,
        });
        let module = module.cloned().or_else(|| around.map(str::to_owned));
        if module.is_some() || variant.is_some() {
            entries.push(Entry { module, variant });
        }
    }
}

/// Identifiers among `tokens` and in their groups, but for those in braces.
fn flatten(tokens: &[TokenTree], words: &mut Vec<String>) {
    for token in tokens {
        match token {
            TokenTree::Ident(word) => words.push(word.to_string()),
            TokenTree::Group(group) if group.delimiter() != Delimiter::Brace => {
                let inside: Vec<_> = group.stream().into_iter().collect();
                flatten(&inside, words);
            }
            _ => {}
        }
    }
}

/// Files that name an entry of `table` outside the entry's own file or folder and the table, by the entry's name.
/// `sources` are those of the table's crate, `others` those of all crates by their path in the repository; both
/// without test files.
pub fn named_elsewhere(
    table: &EntryTable,
    sources: &[Source],
    others: &[Source],
) -> BTreeMap<String, BTreeSet<String>> {
    let entries = table.entries(sources);
    let folder: ModulePath = table.folder.split('/').map(str::to_owned).collect();
    let folder: ModulePath = folder.into_iter().filter(|part| !part.is_empty()).collect();
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for arrow in Modules::read(sources).arrows() {
        let of = entries.iter().filter(|entry| {
            let module = entry.module.iter().cloned();
            let own: ModulePath = folder.iter().cloned().chain(module).collect();
            own.len() > folder.len()
                && arrow.to.starts_with(&own)
                && !arrow.from.starts_with(&own)
                && arrow.from != folder
        });
        for entry in of {
            let file = format!("{}/{}", table.sources, arrow.from.join("/"));
            found
                .entry(entry.name().to_owned())
                .or_default()
                .insert(file);
        }
    }
    let Some((made, counted)) = table.variants else {
        return found;
    };
    let naming = others
        .iter()
        .filter(|source| source.path.starts_with(counted) && source.text.contains(made));
    for source in naming.filter(|source| source.is("rs")) {
        let inside = source.path.strip_prefix(table.sources);
        let inside = inside.map(|path| path.trim_start_matches('/'));
        if inside.is_some_and(|path| table.is_own(path)) {
            continue;
        }
        let own = inside.and_then(|path| table.module_of_folder(path));
        let paths = named_paths(&source.text);
        let has_methods = source.text.contains(&format!("impl {made} {{"));
        for entry in &entries {
            let Some(variant) = &entry.variant else {
                continue;
            };
            let names = |path: &NamedPath| {
                let pairs = path.segments.windows(2);
                let mut pairs = pairs.filter(|pair| pair[1] == *variant);
                !path.in_test
                    && pairs.any(|pair| pair[0] == made || (has_methods && pair[0] == "Self"))
            };
            if (own.is_none() || own != entry.module.as_deref()) && paths.iter().any(names) {
                let file = source.path.trim_end_matches(".rs");
                let file = file.trim_end_matches("/mod").to_owned();
                found.entry(variant.clone()).or_default().insert(file);
            }
        }
    }
    found
}

/// Entries of `table` that more files name than `left` allows.
pub fn dear_additions(
    table: &EntryTable,
    named: &BTreeMap<String, BTreeSet<String>>,
    left: &[Named],
) -> Vec<Violation> {
    let dear = named.iter().filter(|(name, files)| {
        let allowed = left
            .iter()
            .find(|(call, entry, _)| *call == table.call && entry == name);
        files.len() > allowed.map_or(0, |(.., count)| *count)
    });
    dear.map(|(name, files)| {
        let files: Vec<_> = files.iter().map(String::as_str).collect();
        Violation {
            file: format!("{}/{}", table.sources, table.folder),
            line: 0,
            complaint: format!(
                "`{name}` of `{}!` is named outside its own file and its line ({}): another entry would touch these files \
                 as well, so let them ask the table",
                table.call,
                files.join(", ")
            ),
        }
    })
    .collect()
}

/// Those in `left` that fewer files name by now: write the smaller number down, or take them off the list.
pub fn cheaper_by_now(
    table: &EntryTable,
    named: &BTreeMap<String, BTreeSet<String>>,
    left: &[Named],
) -> Vec<(&'static str, usize)> {
    let own = left.iter().filter(|(call, ..)| *call == table.call);
    own.map(|(_, name, count)| (*name, *count, named.get(*name).map_or(0, BTreeSet::len)))
        .filter(|(_, count, today)| today < count)
        .map(|(name, _, today)| (name, today))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::made_of;

    const TABLE: EntryTable = EntryTable {
        sources: "house/src",
        folder: "formats",
        call: "formats",
        variants: Some(("Format", "house")),
    };

    fn entry(module: &str, variant: &str) -> Entry {
        let some = |text: &str| (!text.is_empty()).then(|| text.to_owned());
        Entry {
            module: some(module),
            variant: some(variant),
        }
    }

    #[test]
    fn lines_of_every_table_are_read() {
        let files = |text| {
            made_of(&[
                ("formats/mod.rs", text),
                ("formats/a.rs", ""),
                ("formats/b/mod.rs", ""),
            ])
        };
        for (text, expected) in [
            (
                "formats! { /// A.\n A(a), B(b, crate::B), }",
                vec![entry("a", "A"), entry("b", "B")],
            ),
            (
                "formats! { small { pub a::Some, } whole { b::Other: \"x\", } }",
                vec![entry("a", ""), entry("b", "")],
            ),
            (
                "formats! { \"one\" { a, } \"two\" { b, } }",
                vec![entry("a", ""), entry("b", "")],
            ),
            (
                "formats! { a { A(\"x\", ONE), C(\"y\", TWO), } }",
                vec![entry("a", "A"), entry("a", "C")],
            ),
            (
                "formats! { A: pub use a::Some; C(Box<Other>); }",
                vec![entry("a", "A"), entry("", "C")],
            ),
            ("other! { A(a), }", vec![]),
        ] {
            assert_eq!(TABLE.entries(&files(text)), expected, "{text}");
        }
    }

    fn named(files: &[(&str, &str)]) -> Vec<String> {
        let own = made_of(files);
        let mut all = own.clone();
        for source in &mut all {
            source.path = format!("house/src/{}", source.path);
        }
        all.extend(made_of(&[("house/other.rs", "fn f() { x::Format::C }")]));
        let found = named_elsewhere(&TABLE, &own, &all);
        let told = found.iter().flat_map(|(name, files)| {
            let files = files.iter().map(|file| file.replace("house/", ""));
            files.map(move |file| format!("{name}: {file}"))
        });
        told.collect()
    }

    #[test]
    fn a_file_that_names_an_entry_by_its_module_or_its_variant_is_noticed() {
        let table = ("formats/mod.rs", "mod of; mod c; formats! { A(a), B(b), }");
        let a = (
            "formats/a.rs",
            "pub const INFO: u8 = 0; fn f() { Format::A }",
        );
        let b = ("formats/b.rs", "pub struct B;");
        assert_eq!(named(&[table, a, b]), [""; 0]);
        let of = (
            "formats/of.rs",
            "impl Format { fn is_a(self) { self == Self::A } }",
        );
        let menu = (
            "menu.rs",
            "use crate::formats::Format; fn f() { Format::B }",
        );
        let c = ("formats/c.rs", "use super::b::B; fn f() { Self::A }");
        let found = named(&[table, a, b, of, menu, c]);
        assert_eq!(
            found,
            ["A: src/formats/of", "B: src/formats/c", "B: src/menu"]
        );
        let of = (
            "formats/of.rs",
            "#[cfg(test)] mod tests { fn f() { Format::A } }",
        );
        assert_eq!(named(&[table, a, b, of]), [""; 0]);
    }

    #[test]
    fn a_listed_entry_passes_until_it_is_named_more_often_and_is_to_be_written_down_when_it_is_less()
     {
        let files = |count: usize| (0..count).map(|file| format!("{file}.rs")).collect();
        let named = |count| BTreeMap::from([("A".to_owned(), files(count))]);
        let left: [Named; 2] = [("formats", "A", 2), ("others", "A", 1)];
        assert!(dear_additions(&TABLE, &named(2), &left).is_empty());
        assert!(cheaper_by_now(&TABLE, &named(2), &left).is_empty());
        assert_eq!(dear_additions(&TABLE, &named(3), &left).len(), 1);
        assert_eq!(dear_additions(&TABLE, &named(1), &[]).len(), 1);
        assert_eq!(cheaper_by_now(&TABLE, &named(1), &left), [("A", 1)]);
        assert_eq!(cheaper_by_now(&TABLE, &BTreeMap::new(), &left), [("A", 0)]);
    }
}
