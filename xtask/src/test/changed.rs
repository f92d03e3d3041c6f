//! Reach of a change: the packages that it touches, those that stand on them, and the page.

use std::collections::BTreeSet;

use serde_json::Value;

use super::passed::readers_of;
use crate::{
    failure::Failure,
    metadata, places,
    process::{capture, program, succeed},
};

/// Packages whose part of the page some journeys walk through: those journeys export its name among their
/// tags. Whatever else the page is made of, all journeys can notice.
const TAGS: [&str; 6] = ["readers", "maps", "plan", "training", "lessons", "study"];
/// The packages that the page is.
const PAGE: [&str; 7] = [
    "pilotage-jobs",
    "pilotage-ui",
    "pilotage-web",
    "pilotage-worker",
    "pilotage-worker-flying",
    "pilotage-worker-whole",
    "pilotage-lesson-page",
];

/// Packages, page and journeys that are worth checking after a change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reach {
    /// Packages that are changed or stand on changed ones, sorted.
    pub packages: Vec<String>,
    /// Whether the page can have changed.
    pub page: bool,
    /// Tags of the journeys that are enough, if not all are to be walked.
    pub tags: Option<Vec<String>>,
}

/// A package of the workspace.
#[derive(Debug, Clone, Default)]
struct Package {
    name: String,
    /// Its folder, relative to the root.
    folder: String,
    /// Names of the packages of the workspace that it or its tests stand on.
    stands_on: Vec<String>,
}

/// The reach of what differs from `base` (from the last commit if `None`), files that git does not know yet
/// included.
pub fn reach(base: Option<&str>) -> Result<Reach, Failure> {
    let base = base.unwrap_or("HEAD");
    let mut files = git(&["diff", "--name-only", base])?;
    files.extend(git(&["ls-files", "--others", "--exclude-standard"])?);
    let reach = of_files(&files, &workspace()?);
    println!(
        "{} files differ from {base}: {} packages{}",
        files.len(),
        reach.packages.len(),
        if reach.page { ", and the page" } else { "" }
    );
    Ok(reach)
}

fn git(arguments: &[&str]) -> Result<Vec<String>, Failure> {
    let mut git = program("git");
    git.args(arguments).stderr(std::process::Stdio::inherit());
    let output = capture(&mut git, "git is needed to see what changed")?;
    succeed(&git, output.status)?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok(text.lines().map(str::to_owned).collect())
}

fn workspace() -> Result<Vec<Package>, Failure> {
    let root = places::root();
    let root = root.to_string_lossy();
    let packages = metadata::packages(false)?;
    Ok(packages.iter().map(|entry| package(entry, &root)).collect())
}

fn package(entry: &Value, root: &str) -> Package {
    let manifest = entry["manifest_path"].as_str().unwrap_or_default();
    let folder = manifest.strip_prefix(root).unwrap_or(manifest);
    let folder = folder
        .trim_end_matches("Cargo.toml")
        .trim_matches(['/', '\\']);
    let dependencies = entry["dependencies"].as_array().into_iter().flatten();
    Package {
        name: entry["name"].as_str().unwrap_or_default().to_owned(),
        folder: folder.replace('\\', "/"),
        stands_on: dependencies
            .filter(|dependency| dependency["path"].is_string())
            .filter_map(|dependency| Some(dependency["name"].as_str()?.to_owned()))
            .collect(),
    }
}

fn of_files(files: &[String], workspace: &[Package]) -> Reach {
    let mut changed = BTreeSet::new();
    let mut page = false;
    for file in files {
        changed.extend(readers_of(file));
        page |= of_page_build(file);
        match owner(file, workspace) {
            Owner::Package(name) => {
                changed.insert(name);
            }
            Owner::Page => page = true,
            Owner::Everyone => {
                changed.extend(workspace.iter().map(|package| package.name.clone()));
            }
            Owner::Nobody => {}
        }
    }
    let mut reached = changed.clone();
    loop {
        let stands_on_reached = |package: &&Package| {
            !reached.contains(&package.name)
                && package.stands_on.iter().any(|name| reached.contains(name))
        };
        let more: Vec<String> = workspace
            .iter()
            .filter(stands_on_reached)
            .map(|package| package.name.clone())
            .collect();
        if more.is_empty() {
            break;
        }
        reached.extend(more);
    }
    let tag = |name: &String| {
        let name = name.strip_prefix("pilotage-")?;
        TAGS.contains(&name).then(|| name.to_owned())
    };
    let tags: Option<Vec<String>> = changed.iter().map(tag).collect();
    Reach {
        tags: tags.filter(|_| !page),
        page: page || PAGE.iter().any(|name| reached.contains(*name)),
        packages: reached.into_iter().collect(),
    }
}

/// Whether `file` decides how the page is put together, shown or weighed, though the page is not compiled from it.
fn of_page_build(file: &str) -> bool {
    [
        "src/page/",
        "src/serve/",
        "budgets.toml",
        "never_called.toml",
    ]
    .iter()
    .any(|place| {
        file.strip_prefix("xtask/")
            .is_some_and(|rest| rest.starts_with(place))
    })
}

enum Owner {
    Package(String),
    Page,
    Everyone,
    Nobody,
}

fn owner(file: &str, workspace: &[Package]) -> Owner {
    let of_page = ["tests/browser/", "www/", "index.html"];
    if of_page.iter().any(|place| file.starts_with(place)) {
        return Owner::Page;
    }
    let holds = |package: &&Package| {
        let rest = file.strip_prefix(package.folder.as_str());
        rest.is_some_and(|rest| rest.starts_with('/'))
    };
    let closest = workspace
        .iter()
        .filter(holds)
        .max_by_key(|package| package.folder.len());
    if let Some(package) = closest {
        return Owner::Package(package.name.clone());
    }
    let is_prose = file.starts_with("docs/")
        || file.starts_with("LICENSE")
        || file
            .rsplit_once('.')
            .is_some_and(|(_, ending)| ending == "md");
    if is_prose {
        Owner::Nobody
    } else {
        Owner::Everyone
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn workspace() -> Vec<Package> {
        let package = |name: &str, folder: &str, stands_on: &[&str]| Package {
            name: name.to_owned(),
            folder: folder.to_owned(),
            stands_on: stands_on.iter().map(|name| (*name).to_owned()).collect(),
        };
        vec![
            package(
                "pilotage-core",
                "crates/core",
                &["pilotage-base", "pilotage-readers"],
            ),
            package("pilotage-base", "crates/core/base", &[]),
            package(
                "pilotage-readers",
                "crates/core/readers",
                &["pilotage-base"],
            ),
            package("pilotage-maps", "crates/core/maps", &["pilotage-base"]),
            package("pilotage-ui", "crates/ui", &["pilotage-core"]),
            package("pilotage-tests", "tests", &["pilotage-core"]),
            package("pilotage-house", "tests/house", &[]),
            package("xtask", "xtask", &[]),
        ]
    }

    fn reached(files: &[&str]) -> Reach {
        let files: Vec<String> = files.iter().map(|file| (*file).to_owned()).collect();
        of_files(&files, &workspace())
    }

    #[test]
    fn a_reader_reaches_what_stands_on_it_and_the_journeys_that_open_files() {
        let reach = reached(&["crates/core/readers/src/log/mod.rs"]);
        let names = [
            "pilotage-core",
            "pilotage-readers",
            "pilotage-tests",
            "pilotage-ui",
        ];
        assert_eq!(reach.packages, names);
        assert!(reach.page);
        assert_eq!(reach.tags.as_deref(), Some(&["readers".to_owned()][..]));
    }

    #[test]
    fn a_file_belongs_to_the_closest_package() {
        let reach = reached(&["tests/house/src/lib.rs"]);
        assert_eq!(reach.packages, ["pilotage-house"]);
        assert!(!reach.page);
        let reach = reached(&["crates/core/src/lib.rs"]);
        let names = ["pilotage-core", "pilotage-tests", "pilotage-ui"];
        assert_eq!(reach.packages, names);
        assert_eq!(
            reach.tags, None,
            "the facade is no part with journeys of its own"
        );
    }

    #[test]
    fn a_manifest_of_the_workspace_reaches_everything_and_prose_nothing() {
        assert_eq!(reached(&["Cargo.lock"]).packages.len(), workspace().len());
        let prose = reached(&["docs/testing.md", "README.md"]);
        assert!(prose.packages.is_empty() && !prose.page);
    }

    #[test]
    fn a_file_that_tests_read_reaches_them_and_what_the_page_is_built_by_reaches_it() {
        let reads = |file: &str| reached(&[file]).packages;
        assert_eq!(reads("docs/results.md"), ["pilotage-cli"]);
        assert!(reads("www/places.bin").contains(&"pilotage-base".to_owned()));
        assert!(reads("tests/data/traces/a.geojson").contains(&"pilotage-vision".to_owned()));
        assert!(reads("docs/results.md.txt").is_empty());
        for file in [
            "xtask/never_called.toml",
            "xtask/budgets.toml",
            "xtask/src/page/wasm.rs",
        ] {
            assert!(reached(&[file]).page, "{file}");
        }
        assert!(!reached(&["xtask/src/test/table.rs"]).page);
    }

    #[test]
    fn the_shell_of_the_page_reaches_all_journeys_and_no_package() {
        let reach = reached(&["www/worker.js", "crates/core/readers/src/lib.rs"]);
        assert!(reach.page);
        assert_eq!(reach.tags, None);
        for file in ["index.html", "www/style.css", "www/sw.js"] {
            assert!(reached(&[file]).packages.is_empty(), "{file}");
        }
    }
}
