//! The modules of one crate: what each of them defines and brings in, so that a path can be followed to the file
//! that defines what it names.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::{
    sources::Source,
    tokens::{NamedPath, paths_in},
};

/// Names of the modules from the crate's root down to one of them; the root's is empty.
pub type ModulePath = Vec<String>;

/// The modules of one crate, without its test code.
#[derive(Debug, Default)]
pub struct Modules {
    modules: BTreeMap<ModulePath, Module>,
}

/// Content of one module, be it a file or written inside one.
#[derive(Debug, Default)]
struct Module {
    /// Module of the file that it is written in.
    file: ModulePath,
    defined: BTreeSet<String>,
    /// Paths of `use` by the names that they bring in.
    imported: BTreeMap<String, Vec<String>>,
    /// Those of them that others may have from here.
    exported: BTreeSet<String>,
    /// Paths of `use` that end in `*`, without it.
    globs: Vec<Vec<String>>,
    /// Every path that stands in it.
    named: Vec<NamedPath>,
}

/// Use by one file of a name that another one defines.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Arrow {
    /// Module of the file that uses.
    pub from: ModulePath,
    /// Module of the file that defines.
    pub to: ModulePath,
    /// The name that is used.
    pub name: String,
}

/// Number of `use` that a name may pass through before it is given up: no code has as many.
const MOST_STEPS: usize = 16;

impl Modules {
    /// Reads the sources of one crate; test files are left out by the caller
    /// ([`without_test_files`](crate::reach::without_test_files)).
    ///
    /// # Panics
    /// If one of them is not Rust.
    pub fn read(sources: &[Source]) -> Self {
        let mut found = Self::default();
        let elsewhere: BTreeMap<_, _> = sources.iter().flat_map(declared_by_path).collect();
        for source in sources.iter().filter(|source| source.is("rs")) {
            let file = elsewhere.get(&source.path).cloned();
            let file = file.unwrap_or_else(|| module_of(&source.path));
            found.at(&file, &[]);
            let stream: TokenStream = source
                .text
                .parse()
                .unwrap_or_else(|error| panic!("{} is not Rust: {error}", source.path));
            found.define(&file, &mut Vec::new(), stream.clone());
            let mut is_declared = false;
            for path in paths_in(stream) {
                let declares = path.segments == ["mod"];
                if !path.in_test && !is_declared {
                    found.at(&file, &path.inside).take(path);
                }
                is_declared = declares;
            }
        }
        found
    }

    /// Uses of names of other files, each once. Re-exports use nothing: a name that they bring is followed to where
    /// it is defined, for whoever asks for it.
    pub fn arrows(&self) -> BTreeSet<Arrow> {
        let mut arrows = BTreeSet::new();
        for (path, module) in &self.modules {
            for named in &module.named {
                if let Some((to, name)) = self.file_behind(path, named)
                    && to != module.file
                {
                    let from = module.file.clone();
                    arrows.insert(Arrow { from, to, name });
                }
            }
        }
        arrows
    }

    /// Module of the file that defines what `named` stands for inside the module at `path`, with the name.
    fn file_behind(&self, path: &[String], named: &NamedPath) -> Option<(ModulePath, String)> {
        if named
            .import
            .as_ref()
            .is_some_and(|import| import.is_exported)
        {
            return None;
        }
        let [name] = named.segments.as_slice() else {
            return self.follow(path, &named.segments, MOST_STEPS);
        };
        // A name without a path comes through a `use` that counts by itself, unless that is a re-export or a glob.
        let module = self.modules.get(path)?;
        if module.exported.contains(name) {
            self.follow(path, &named.segments, MOST_STEPS)
        } else {
            self.through_globs(path, name, MOST_STEPS)
        }
    }

    /// File that defines what `segments` names from within the module at `path`, with the name.
    fn follow(
        &self,
        path: &[String],
        segments: &[String],
        steps: usize,
    ) -> Option<(ModulePath, String)> {
        let steps = steps.checked_sub(1)?;
        let (mut place, mut rest) = self.start(path, segments)?;
        loop {
            let (next, after) = rest.split_first()?;
            if next == "self" || next == "*" {
                return None;
            }
            let below = [place.as_slice(), std::slice::from_ref(next)].concat();
            let found = self.item(&place, next, after, steps);
            if !self.modules.contains_key(&below) || (found.is_some() && after.is_empty()) {
                return found;
            }
            place = below;
            rest = after;
        }
    }

    /// File that defines the item `name` of the module at `place`, or what follows it as `after`.
    fn item(
        &self,
        place: &[String],
        name: &String,
        after: &[String],
        steps: usize,
    ) -> Option<(ModulePath, String)> {
        let module = self.modules.get(place)?;
        if module.defined.contains(name) {
            Some((module.file.clone(), name.clone()))
        } else if let Some(import) = module.imported.get(name) {
            let whole = [import.as_slice(), after].concat();
            self.follow(place, &whole, steps)
        } else {
            self.through_globs(place, name, steps)
        }
    }

    /// Beginning of a path: the module it is counted from and the parts that are left; nothing where it leaves the
    /// crate or names something of the module's own.
    fn start<'a>(
        &self,
        path: &[String],
        segments: &'a [String],
    ) -> Option<(ModulePath, &'a [String])> {
        let first = segments.first()?;
        let climbed = segments
            .iter()
            .take_while(|segment| *segment == "super")
            .count();
        let below = [path, std::slice::from_ref(first)].concat();
        if first == "crate" {
            Some((Vec::new(), &segments[1..]))
        } else if first == "self" {
            Some((path.to_vec(), &segments[1..]))
        } else if climbed > 0 {
            let depth = path.len().checked_sub(climbed)?;
            Some((path[..depth].to_vec(), &segments[climbed..]))
        } else if self.modules.contains_key(&below)
            || self.modules.get(path)?.imported.contains_key(first)
        {
            Some((path.to_vec(), segments))
        } else {
            None
        }
    }

    /// File that defines `name` for the module at `path` by one of its globs.
    fn through_globs(
        &self,
        path: &[String],
        name: &str,
        steps: usize,
    ) -> Option<(ModulePath, String)> {
        let steps = steps.checked_sub(1)?;
        let module = self.modules.get(path)?;
        if module.defined.contains(name) || module.imported.contains_key(name) {
            return None;
        }
        module.globs.iter().find_map(|glob| {
            let whole = [glob.as_slice(), &[name.to_owned()]].concat();
            self.follow(path, &whole, steps)
        })
    }

    /// The module written at `inside` in the file of module `file`.
    fn at(&mut self, file: &[String], inside: &[String]) -> &mut Module {
        let path = [file, inside].concat();
        let module = self.modules.entry(path).or_default();
        module.file = file.to_vec();
        module
    }

    /// Notes the items that `stream`, the text of the module at `inside`, defines.
    fn define(&mut self, file: &[String], inside: &mut Vec<String>, stream: TokenStream) {
        let tokens: Vec<_> = stream.into_iter().collect();
        for (place, token) in tokens.iter().enumerate() {
            let (TokenTree::Ident(keyword), [next, after @ ..]) = (token, &tokens[place + 1..])
            else {
                continue;
            };
            let keyword = keyword.to_string();
            match (next, after.first()) {
                (TokenTree::Ident(name), Some(TokenTree::Group(body)))
                    if keyword == "mod" && body.delimiter() == Delimiter::Brace =>
                {
                    inside.push(name.to_string());
                    self.define(file, inside, body.stream());
                    inside.pop();
                }
                (TokenTree::Ident(name), _) if ITEMS.contains(&keyword.as_str()) => {
                    self.at(file, inside).defined.insert(name.to_string());
                }
                (TokenTree::Punct(bang), Some(TokenTree::Ident(name)))
                    if keyword == "macro_rules" && bang.as_char() == '!' =>
                {
                    let defined = &mut self.at(file, inside).defined;
                    defined.insert(name.to_string());
                    defined.insert(format!("{name}!"));
                }
                _ => {}
            }
        }
    }
}

/// Words that begin an item and stand before its name.
const ITEMS: [&str; 8] = [
    "fn", "struct", "enum", "union", "trait", "type", "const", "static",
];

impl Module {
    fn take(&mut self, path: NamedPath) {
        if let Some(import) = &path.import {
            let mut segments = path.segments.clone();
            if segments.last().is_some_and(|last| last == "self") {
                segments.pop();
            }
            if segments.last().is_some_and(|last| last == "*") {
                segments.pop();
                self.globs.push(segments);
            } else {
                self.imported.insert(import.name.clone(), segments);
                if import.is_exported {
                    self.exported.insert(import.name.clone());
                }
            }
        }
        self.named.push(path);
    }
}

/// Module that the file at `path` is: `camera/model.rs` is `[camera, model]`, `camera/mod.rs` `[camera]`.
fn module_of(path: &str) -> ModulePath {
    let mut module: Vec<_> = path
        .trim_end_matches(".rs")
        .split('/')
        .map(str::to_owned)
        .collect();
    if matches!(
        module.last().map(String::as_str),
        Some("mod" | "lib" | "main")
    ) {
        module.pop();
    }
    module
}

/// Files that `source` declares with their path, each with the module that it makes of them.
fn declared_by_path(source: &Source) -> Vec<(String, ModulePath)> {
    let folder = source.path.rsplit_once('/');
    let folder = folder.map_or(String::new(), |(folder, _)| format!("{folder}/"));
    let named = source.text.split("#[path = \"").skip(1);
    named
        .filter_map(|text| {
            let (file, after) = text.split_once("\"]")?;
            let (declared, _) = after.split_once(';')?;
            let name = declared.rsplit_once("mod ")?.1.to_owned();
            let module = [module_of(&source.path), vec![name]].concat();
            Some((format!("{folder}{file}"), module))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::made_of;

    fn arrows(files: &[(&str, &str)]) -> Vec<String> {
        let sources = made_of(files);
        let arrows = Modules::read(&sources).arrows();
        let told = arrows.iter().map(|arrow| {
            let (from, to) = (arrow.from.join("/"), arrow.to.join("/"));
            format!("{from} > {to}: {}", arrow.name)
        });
        told.collect()
    }

    #[test]
    fn a_use_is_followed_to_the_file_that_defines_what_it_names() {
        for spelling in [
            "use super::b::B;",
            "use super::B;",
            "use crate::a::b::{B as C};",
            "use super::b; fn f() -> b::B { b::B::new() }",
            "fn f() { super::b::B::new() }",
            "use super::*; struct S { b: B }",
            "fn f() { use super::b; vec![b::B::new()] }",
        ] {
            let found = arrows(&[
                ("lib.rs", "pub mod a;"),
                ("a/mod.rs", "mod b; mod c; pub use b::B;"),
                ("a/b.rs", "pub struct B;"),
                ("a/c.rs", spelling),
            ]);
            assert_eq!(found, ["a/c > a/b: B"], "{spelling}");
        }
    }

    #[test]
    fn a_declaration_or_a_re_export_is_no_arrow_unless_what_it_brings_in_is_used() {
        let b = ("a/b.rs", "pub struct B;");
        let found = arrows(&[("a/mod.rs", "mod b; pub(crate) use b::B;"), b]);
        assert!(found.is_empty(), "{found:?}");
        let same = [
            ("a/mod.rs", "pub use c::c; mod c;"),
            ("a/c.rs", "pub fn c() {}"),
        ];
        assert!(arrows(&same).is_empty());
        let text = "mod b; pub use b::B; fn f(b: B) {}";
        assert_eq!(arrows(&[("a/mod.rs", text), b]), ["a > a/b: B"]);
        let text = "mod b; pub use self::b::B; fn f() { B::new() }";
        assert_eq!(arrows(&[("a.rs", text), b]), ["a > a/b: B"]);
    }

    #[test]
    fn a_list_that_declares_its_files_brings_in_what_it_says() {
        let list = "orders! { small {} whole { Do: pub use b::B; Other(Box<C>); } }";
        let found = arrows(&[
            ("lib.rs", list),
            ("b.rs", "pub struct B;"),
            ("d.rs", "use super::B; fn f() { crate::B::new() }"),
        ]);
        assert_eq!(found, ["d > b: B"]);
    }

    #[test]
    fn tests_and_what_a_file_has_of_its_own_are_no_arrows() {
        let found = arrows(&[
            ("a.rs", "pub struct A; mod inner { use super::A; }"),
            (
                "b.rs",
                "#[cfg(test)] mod tests { use crate::a::A; } fn f() { std::mem::take(x) }",
            ),
        ]);
        assert!(found.is_empty(), "{found:?}");
    }

    #[test]
    fn a_file_declared_with_its_path_is_the_module_that_it_is_declared_as() {
        let found = arrows(&[
            ("a/b.rs", "struct B;\n#[path = \"b_more.rs\"]\nmod more;"),
            ("a/b_more.rs", "use super::B;"),
        ]);
        assert_eq!(found, ["a/b/more > a/b: B"]);
    }

    #[test]
    fn a_function_may_be_called_like_the_module_that_it_lies_in() {
        let b = ("a/b.rs", "pub fn b() {}");
        for text in [
            "mod b; fn f() { b::b() }",
            "mod b; pub use b::b; fn f() { self::b() }",
            "mod b; use b::b;",
        ] {
            assert_eq!(arrows(&[("a.rs", text), b]), ["a > a/b: b"], "{text}");
        }
    }

    #[test]
    fn names_that_lead_around_in_a_ring_of_uses_end() {
        let found = arrows(&[
            ("a.rs", "pub use crate::b::X; fn f() { X }"),
            ("b.rs", "pub use crate::a::X;"),
        ]);
        assert!(found.is_empty(), "{found:?}");
    }
}
