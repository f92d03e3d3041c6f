//! Lower folders of `core` never import upper ones.

use super::{
    Violation,
    sources::Source,
    tokens::{NamedPath, named_paths},
};

/// The folders of `crates/core/src` from the bottom up.
pub const ORDER: [&str; 18] = [
    "frames",
    "raster",
    "camera",
    "filter",
    "vehicle",
    "imagery",
    "landmark",
    "registration",
    "flight",
    "instruments",
    "navigator",
    "alignment",
    "mission",
    "exchange",
    "simulate",
    "plan",
    "training",
    "study",
];

/// Imports in `source` (its path relative to `crates/core/src`) that point upward, by `crate::`
/// or by a chain of `super::` that climbs out of the folder. Test code counts as well.
pub fn upward_imports(source: &Source) -> Vec<Violation> {
    let module = module_of(&source.path);
    let Some(folder) = module.first() else {
        return Vec::new();
    };
    let complain = |line, complaint| Violation {
        file: source.path.clone(),
        line,
        complaint,
    };
    let Some(own) = rank(folder) else {
        return vec![complain(
            0,
            format!("`{folder}` has no place in the order {ORDER:?}"),
        )];
    };
    named_paths(&source.text)
        .iter()
        .filter_map(|path| {
            let target = target_folder(&module, path)?;
            match rank(target) {
                Some(other) if other <= own => None,
                Some(_) => Some(complain(
                    path.line,
                    format!(
                        "`{}` imports upward, from {folder} to {target}",
                        path.text()
                    ),
                )),
                None => Some(complain(
                    path.line,
                    format!(
                        "`{}`: name the folder it comes from, or give it a place in the order",
                        path.text()
                    ),
                )),
            }
        })
        .collect()
}

fn rank(folder: &str) -> Option<usize> {
    ORDER.iter().position(|name| *name == folder)
}

/// Module path of a file: `camera/model.rs` is `[camera, model]`, `camera/mod.rs` `[camera]`.
fn module_of(path: &str) -> Vec<&str> {
    let mut module: Vec<_> = path.trim_end_matches(".rs").split('/').collect();
    if matches!(module.last(), Some(&("mod" | "lib"))) {
        module.pop();
    }
    module
}

/// Folder of `core` that `path` names from within `module`, or `None` where it stays below the
/// crate's root or leaves the crate.
fn target_folder<'a>(module: &[&str], path: &'a NamedPath) -> Option<&'a str> {
    let climbed = path
        .segments
        .iter()
        .take_while(|segment| *segment == "super")
        .count();
    let depth = module.len() + path.inside.len();
    let after = match path.segments.first()?.as_str() {
        "crate" => 1,
        "super" if climbed == depth => climbed,
        _ => return None,
    };
    path.segments.get(after).map(String::as_str)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complaints(path: &str, text: &str) -> usize {
        upward_imports(&Source {
            path: path.to_owned(),
            text: text.to_owned(),
        })
        .len()
    }

    #[test]
    fn an_upward_import_is_noticed_in_each_of_its_spellings() {
        assert_eq!(
            complaints("filter/unscented.rs", "use crate::navigator::Report;"),
            1
        );
        assert_eq!(
            complaints("filter/unscented.rs", "use crate::{frames::X, flight::Y};"),
            1
        );
        assert_eq!(
            complaints("filter/mod.rs", "use super::navigator::Report;"),
            1
        );
        assert_eq!(
            complaints("filter/deep/down.rs", "use super::super::super::study::X;"),
            1
        );
        assert_eq!(
            complaints("filter/mod.rs", "fn f() { crate::simulate::fly(); }"),
            1
        );
        assert_eq!(
            complaints("camera/model.rs", "mod tests { use crate::flight::X; }"),
            1
        );
    }

    #[test]
    fn imports_downward_and_within_the_folder_are_fine() {
        assert_eq!(
            complaints("navigator/mod.rs", "use crate::{filter::X, frames::Y};"),
            0
        );
        assert_eq!(
            complaints("filter/mod.rs", "mod tests { use super::*; }"),
            0
        );
        assert_eq!(
            complaints("filter/gate.rs", "use super::super::frames::Angle;"),
            0
        );
        assert_eq!(
            complaints(
                "filter/gate.rs",
                "mod tests { use super::super::noise::X; }"
            ),
            0
        );
        assert_eq!(complaints("lib.rs", "pub mod study;"), 0);
    }

    #[test]
    fn a_folder_or_a_name_outside_the_order_is_noticed() {
        assert_eq!(complaints("helpers/mod.rs", ""), 1);
        assert_eq!(complaints("camera/model.rs", "use crate::Navigator;"), 1);
    }
}
