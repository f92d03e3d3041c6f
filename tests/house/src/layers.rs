//! Lower crates and folders never import upper ones.

use std::cmp::Ordering;

use crate::{
    Violation,
    sources::Source,
    tokens::{NamedPath, named_paths},
};

/// The folders of one crate from the bottom up; modules in files of their own at the root count as folders.
#[derive(Debug)]
pub struct FolderOrder {
    /// Folder of the crate's sources, relative to the root of the repository.
    pub sources: &'static str,
    /// Names of the folders, the lowest first; [`FEATURES`] stands for those of a table of features that are not named.
    pub folders: &'static [&'static str],
}

/// Place in an order of all folders that a table of features lists and the order does not name: none of them imports
/// another.
pub const FEATURES: &str = "(features)";

/// Every crate with more than one folder.
pub const ORDERS: [&FolderOrder; 8] = [
    &FolderOrder {
        sources: "crates/core/base/src",
        folders: &[
            "sorting",
            "statistics",
            "angle_text",
            "bytes",
            "files",
            "frames",
            "gazetteer",
            "georeference",
            "hemisphere_in_name",
            "loose_json",
            "place_text",
            "separator",
            "text",
            "tiff_entry",
            "varint",
            "viridis",
        ],
    },
    &FolderOrder {
        sources: "crates/core/estimation/src",
        folders: &["filter", "vehicle", "estimator"],
    },
    &FolderOrder {
        sources: "crates/core/raster/src",
        folders: &["raster", "camera", "imagery"],
    },
    &FolderOrder {
        sources: "crates/core/vision/src",
        folders: &[
            "evidence",
            "texture",
            "geometry",
            "straight_edge",
            "ground_class",
            "landmark",
            "registration",
            "road",
        ],
    },
    &FolderOrder {
        sources: "crates/core/mission/src",
        folders: &["settings", "mission", "exchange"],
    },
    &FolderOrder {
        sources: "crates/core/navigator/src",
        folders: &["instruments", "navigator", "calibration", "study"],
    },
    &FolderOrder {
        sources: "crates/core/simulate/src",
        folders: &["simulate", "other_days"],
    },
    &UI,
];

/// Imports in `source` (its path relative to the order's folder of sources) that point upward, by `crate::`
/// or by a chain of `super::` that climbs out of the folder. Test code counts as well. `features` are the folders that
/// the crate's table of features lists.
pub fn upward_imports(source: &Source, order: &FolderOrder, features: &[String]) -> Vec<Violation> {
    let module = module_of(&source.path);
    let Some(folder) = module.first() else {
        return Vec::new();
    };
    let complain = |line, complaint| Violation {
        file: format!("{}/{}", order.sources, source.path),
        line,
        complaint,
    };
    let rank = |folder: &str| order.rank(folder, features);
    if rank(folder).is_none() {
        let folders = order.folders;
        return vec![complain(
            0,
            format!("`{folder}` has no place in the order {folders:?}"),
        )];
    }
    named_paths(&source.text)
        .iter()
        .filter_map(|path| {
            let target = target_folder(&module, path)?;
            if rank(target).is_none() {
                let text = path.text();
                let what = "name the folder it comes from, or give it a place in the order";
                return Some(complain(path.line, format!("`{text}`: {what}")));
            }
            let text = path.text();
            match rank(target).cmp(&rank(folder)) {
                Ordering::Greater => {
                    let what = format!("`{text}` imports upward, from {folder} to {target}");
                    Some(complain(path.line, what))
                }
                Ordering::Equal if target != *folder => {
                    let what = format!(
                        "`{text}`: {folder} and {target} are features of one height; name the lower one in the order"
                    );
                    Some(complain(path.line, what))
                }
                _ => None,
            }
        })
        .collect()
}

impl FolderOrder {
    fn rank(&self, folder: &str, features: &[String]) -> Option<usize> {
        let place = |wanted: &str| self.folders.iter().position(|name| *name == wanted);
        let is_feature = || features.iter().any(|feature| feature == folder);
        place(folder).or_else(|| is_feature().then(|| place(FEATURES)).flatten())
    }
}

/// The views, from the look to the whole (docs: `ARCHITECTURE.md`).
const UI: FolderOrder = FolderOrder {
    sources: "crates/ui/src",
    folders: &[
        "tokens",
        "units",
        "testing",
        "kept_mesh",
        "kept_tree",
        "state_json",
        "still",
        "short_map",
        "feature_command",
        "job_owners",
        "host",
        "command",
        "context",
        "export_command",
        "shell",
        "timeline",
        "views",
        "documents",
        "map",
        "feature_wishes",
        "feature",
        "feature_work",
        "explanations",
        // Features on which others stand.
        "plan",
        "web_map",
        FEATURES,
        "dialogs",
        "features",
        "app",
    ],
};

/// Module path of a file: `camera/model.rs` is `[camera, model]`, `camera/mod.rs` `[camera]`, and
/// `camera/model_tests.rs` `[camera, model, tests]`, for it is declared there.
fn module_of(path: &str) -> Vec<&str> {
    let mut module: Vec<_> = path.trim_end_matches(".rs").split('/').collect();
    if matches!(module.last(), Some(&("mod" | "lib"))) {
        module.pop();
    }
    let tested = module.last().and_then(|name| name.strip_suffix("_tests"));
    if let Some(tested) = tested {
        module.pop();
        module.extend([tested, "tests"]);
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

    const LADDER: FolderOrder = FolderOrder {
        sources: "house/src",
        folders: &[
            "frames",
            "camera",
            "filter",
            "navigator",
            "simulate",
            "study",
            FEATURES,
            "app",
        ],
    };

    fn source(path: &str, text: &str) -> Source {
        Source {
            path: path.to_owned(),
            text: text.to_owned(),
        }
    }

    fn complaints(path: &str, text: &str) -> usize {
        let features = ["hello", "log", "study"].map(str::to_owned);
        upward_imports(&source(path, text), &LADDER, &features).len()
    }

    #[test]
    fn an_upward_import_is_noticed_in_each_of_its_spellings() {
        let unscented = "filter/unscented.rs";
        assert_eq!(complaints(unscented, "use crate::navigator::Report;"), 1);
        assert_eq!(
            complaints(unscented, "use crate::{frames::X, study::Y};"),
            1
        );
        assert_eq!(
            complaints("filter/mod.rs", "use super::navigator::Report;"),
            1
        );
        let climbing = "use super::super::super::study::X;";
        assert_eq!(complaints("filter/deep/down.rs", climbing), 1);
        assert_eq!(
            complaints("camera/mod.rs", "fn f() { crate::simulate::fly(); }"),
            1
        );
        let in_test = "mod tests { use crate::study::X; }";
        assert_eq!(complaints("camera/model.rs", in_test), 1);
    }

    #[test]
    fn imports_downward_and_within_the_folder_are_fine() {
        let both = "use crate::{filter::X, frames::Y};";
        assert_eq!(complaints("navigator/mod.rs", both), 0);
        assert_eq!(
            complaints("filter/mod.rs", "mod tests { use super::*; }"),
            0
        );
        assert_eq!(
            complaints("filter/gate.rs", "use super::super::frames::Angle;"),
            0
        );
        let beside = "use super::super::noise::X;";
        assert_eq!(complaints("filter/gate_tests.rs", beside), 0);
        let noise = "mod tests { use super::super::noise::X; }";
        assert_eq!(complaints("filter/gate.rs", noise), 0);
        assert_eq!(complaints("lib.rs", "pub mod study;"), 0);
    }

    #[test]
    fn a_folder_or_a_name_outside_the_order_is_noticed() {
        assert_eq!(complaints("helpers/mod.rs", ""), 1);
        assert_eq!(complaints("camera/model.rs", "use crate::Navigator;"), 1);
    }

    #[test]
    fn a_feature_of_the_table_needs_no_place_of_its_own_and_imports_no_other_of_its_height() {
        let hello = "hello/panel.rs";
        assert_eq!(complaints(hello, "use crate::{frames::X, study::Y};"), 0);
        assert_eq!(complaints(hello, "use crate::hello::Z;"), 0);
        assert_eq!(complaints("app/mod.rs", "use crate::hello::Z;"), 0);
        assert_eq!(complaints(hello, "use crate::log::Z;"), 1);
        assert_eq!(complaints(hello, "use crate::app::Z;"), 1);
        assert_eq!(complaints("study/mod.rs", "use crate::hello::Z;"), 1);
    }
}
