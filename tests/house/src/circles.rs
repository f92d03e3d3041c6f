//! Files of a folder do not need each other in a circle: what two of them share lies in a file below both.

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    Violation,
    modules::{Arrow, Modules},
    sources::Source,
};

/// Files of one folder that need each other, directly or around.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Circle {
    /// Folder, relative to the root of the repository.
    pub folder: String,
    /// Names of its files and folders without an ending, in order; `mod` is the folder's own file, be it in it or
    /// beside it.
    pub files: Vec<String>,
    /// The arrows among them, each as "`from` uses `name` of `to`".
    pub arrows: Vec<String>,
}

/// A circle that is there all the same: its folder and its files.
pub type LeftCircle = (&'static str, &'static [&'static str]);

/// The circles that are left, each waiting to be opened: the list may shrink, never grow.
pub const LEFT: [LeftCircle; 0] = [];

/// Node of the folder's own file.
const OWN: &str = "mod";

/// The circles in the folders of the crate whose sources lie in `folder` (relative to the root of the repository).
/// A folder inside a folder counts as one file of it. `with_root` tells whether the files and folders at the root
/// of the crate count: they need not where an order holds them.
pub fn circles(folder: &str, sources: &[Source], with_root: bool) -> Vec<Circle> {
    let mut folders: BTreeMap<Vec<String>, BTreeSet<(String, String, String)>> = BTreeMap::new();
    for arrow in Modules::read(sources).arrows() {
        let (place, from, to) = between(&arrow);
        if with_root || !place.is_empty() {
            let arrows = folders.entry(place).or_default();
            arrows.insert((from, to, arrow.name));
        }
    }
    let mut found = Vec::new();
    for (place, arrows) in folders {
        for files in components(&arrows) {
            let inside = arrows
                .iter()
                .filter(|(from, to, _)| files.contains(from) && files.contains(to));
            found.push(Circle {
                folder: [&[folder.to_owned()], place.as_slice()].concat().join("/"),
                arrows: inside
                    .map(|(from, to, name)| format!("{from} uses {name} of {to}"))
                    .collect(),
                files,
            });
        }
    }
    found
}

/// Those of the circles `found` that `left` does not list.
pub fn new_circles(found: &[Circle], left: &[LeftCircle]) -> Vec<Violation> {
    let new = found
        .iter()
        .filter(|circle| !left.iter().any(|listed| circle.is(listed)));
    new.map(|circle| {
        let (files, arrows) = (circle.files.join(", "), circle.arrows.join("; "));
        Violation {
            file: circle.folder.clone(),
            line: 0,
            complaint: format!(
                "{files} need each other in a circle: move what they share to a file below them ({arrows})"
            ),
        }
    })
    .collect()
}

/// Those of the circles that `left` lists that are not among those `found`: take them off the list.
pub fn opened_circles(found: &[Circle], left: &[LeftCircle]) -> Vec<LeftCircle> {
    let listed = left.iter().copied();
    listed
        .filter(|listed| !found.iter().any(|circle| circle.is(listed)))
        .collect()
}

impl Circle {
    fn is(&self, (folder, files): &LeftCircle) -> bool {
        self.folder == *folder && self.files == *files
    }
}

/// The folder in which an arrow runs, and the names of both ends in it.
fn between(arrow: &Arrow) -> (Vec<String>, String, String) {
    let common = arrow
        .from
        .iter()
        .zip(&arrow.to)
        .take_while(|(one, other)| one == other)
        .count();
    let end = |module: &[String]| module.get(common).map_or(OWN, String::as_str).to_owned();
    (
        arrow.from[..common].to_vec(),
        end(&arrow.from),
        end(&arrow.to),
    )
}

/// Sets of more than one file each of which leads to each other along `arrows`.
fn components(arrows: &BTreeSet<(String, String, String)>) -> Vec<Vec<String>> {
    let mut next: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (from, to, _) in arrows {
        next.entry(from).or_default().insert(to);
        next.entry(to).or_default();
    }
    let reached: BTreeMap<&str, BTreeSet<&str>> = next
        .keys()
        .map(|file| (*file, reachable(file, &next)))
        .collect();
    let mut found = BTreeSet::new();
    for (file, others) in &reached {
        let around: Vec<_> = others
            .iter()
            .filter(|other| reached[**other].contains(file))
            .map(|other| (*other).to_owned())
            .collect();
        if around.len() > 1 {
            found.insert(around);
        }
    }
    found.into_iter().collect()
}

/// Files that `file` leads to by one arrow or several.
fn reachable<'a>(file: &str, next: &BTreeMap<&'a str, BTreeSet<&'a str>>) -> BTreeSet<&'a str> {
    let mut found = BTreeSet::new();
    let mut open: Vec<&str> = next[file].iter().copied().collect();
    while let Some(other) = open.pop() {
        if found.insert(other) {
            open.extend(next[other].iter().copied());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::made_of;

    fn found(files: &[(&str, &str)], with_root: bool) -> Vec<Circle> {
        circles("house/src", &made_of(files), with_root)
    }

    fn files(circles: &[Circle]) -> Vec<String> {
        let named = circles
            .iter()
            .map(|circle| format!("{}: {}", circle.folder, circle.files.join(" ")));
        named.collect()
    }

    #[test]
    fn two_files_that_use_each_other_are_a_circle_and_a_file_below_both_opens_it() {
        let circle = found(
            &[
                ("a/mod.rs", "mod b; mod c; pub use b::B; pub use c::C;"),
                ("a/b.rs", "use super::C; pub struct B;"),
                ("a/c.rs", "use super::b::B; pub struct C;"),
            ],
            false,
        );
        assert_eq!(files(&circle), ["house/src/a: b c"]);
        assert_eq!(circle[0].arrows, ["b uses C of c", "c uses B of b"]);
        let open = found(
            &[
                ("a/mod.rs", "mod b; mod c; pub use b::B; pub use c::C;"),
                ("a/b.rs", "use super::shared::S; pub struct B;"),
                ("a/c.rs", "use super::{b::B, shared::S}; pub struct C;"),
                ("a/shared.rs", "pub struct S;"),
            ],
            false,
        );
        assert!(open.is_empty(), "{open:?}");
    }

    #[test]
    fn the_file_of_a_folder_is_in_a_circle_where_it_uses_a_file_that_uses_it() {
        for own in ["a/mod.rs", "a.rs"] {
            let circle = found(
                &[
                    (own, "mod b; pub struct A; fn f() { b::g() }"),
                    ("a/b.rs", "use super::A; pub fn g() {}"),
                ],
                false,
            );
            assert_eq!(files(&circle), ["house/src/a: b mod"], "{own}");
        }
    }

    #[test]
    fn a_circle_may_lead_through_several_files_and_through_a_folder() {
        let circle = found(
            &[
                ("a/mod.rs", "mod b; mod c; mod d; mod e;"),
                ("a/b.rs", "pub struct B(super::c::C);"),
                ("a/c.rs", "pub struct C(super::d::deep::D);"),
                ("a/d/mod.rs", "pub mod deep;"),
                ("a/d/deep.rs", "pub struct D(crate::a::b::B);"),
                ("a/e.rs", "use super::b::B;"),
            ],
            false,
        );
        assert_eq!(files(&circle), ["house/src/a: b c d"]);
    }

    #[test]
    fn the_root_of_a_crate_counts_where_it_is_asked_for() {
        let both = [
            ("b.rs", "pub struct B(crate::c::C);"),
            ("c.rs", "pub struct C(crate::b::B);"),
        ];
        assert_eq!(files(&found(&both, true)), ["house/src: b c"]);
        assert!(found(&both, false).is_empty());
    }

    #[test]
    fn a_listed_circle_passes_until_it_is_opened_and_is_asked_off_the_list_then() {
        const LISTED: [LeftCircle; 1] = [("house/src", &["b", "c"])];
        let circle = |names: &[&str]| Circle {
            folder: "house/src".to_owned(),
            files: names.iter().map(|name| (*name).to_owned()).collect(),
            arrows: Vec::new(),
        };
        let same = [circle(&["b", "c"])];
        assert!(new_circles(&same, &LISTED).is_empty());
        assert!(opened_circles(&same, &LISTED).is_empty());
        let grown = [circle(&["b", "c", "d"])];
        assert_eq!(new_circles(&grown, &LISTED).len(), 1);
        assert_eq!(opened_circles(&grown, &LISTED), LISTED);
        assert_eq!(opened_circles(&[], &LISTED), LISTED);
    }
}
