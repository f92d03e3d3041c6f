//! Names that a crate must not reach: `core` no screen, clock, file or thread; `ui` no browser.

use crate::{Violation, sources::Source, tokens::named_paths};

/// Paths that `core` must not name outside its tests. Time, files and threads come in as values from the
/// caller, so that the same flight gives the same run on every platform.
pub const FORBIDDEN_IN_CORE: [&[&str]; 27] = [
    &["std", "time", "Instant"],
    &["std", "time", "SystemTime"],
    &["std", "fs"],
    &["std", "env"],
    &["std", "net"],
    &["std", "os"],
    &["std", "process"],
    &["std", "thread"],
    &["std", "io", "stdin"],
    &["std", "io", "stdout"],
    &["std", "io", "stderr"],
    &["println!"],
    &["print!"],
    &["eprintln!"],
    &["eprint!"],
    &["dbg!"],
    &["egui"],
    &["eframe"],
    &["web_sys"],
    &["js_sys"],
    &["wasm_bindgen"],
    &["rayon"],
    &["pilotage_jobs"],
    &["pilotage_ui"],
    &["pilotage_web"],
    &["pilotage_worker"],
    &["rand", "rng"],
];

/// Paths that `ui` must not name: it runs natively under test, without page or window.
pub const FORBIDDEN_IN_UI: [&[&str]; 10] = [
    &["eframe"],
    &["web_sys"],
    &["js_sys"],
    &["wasm_bindgen"],
    &["wasm_bindgen_futures"],
    &["pilotage_web"],
    &["pilotage_worker"],
    &["std", "fs"],
    &["std", "thread"],
    &["std", "net"],
];

/// Field of egui that writes what it only shows, rounded and cut, into the number: `NumberField` alone may use it.
pub const BEHIND_NUMBER_FIELD: [&[&str]; 2] = [&["egui", "DragValue"], &["egui", "widgets"]];

/// Paths that start threads, which of all that runs without a page `disk/workers.rs` alone does.
pub const FORBIDDEN_BESIDE_WORKERS: [&[&str]; 7] = [
    &["thread", "spawn"],
    &["thread", "scope"],
    &["thread", "Builder"],
    &["std", "thread", "spawn"],
    &["std", "thread", "scope"],
    &["std", "thread", "Builder"],
    &["rayon"],
];

/// Types whose work the orders of the page do for the terminal as well.
pub const FORBIDDEN_AT_THE_TERMINAL: [&[&str]; 3] = [
    &["pilotage_core", "navigator", "Navigator"],
    &["pilotage_core", "training", "DetectorTraining"],
    &["pilotage_core", "training", "DetectorJudge"],
];

/// Places outside test code where `source` names one of `forbidden`.
pub fn forbidden_paths(source: &Source, forbidden: &[&[&str]]) -> Vec<Violation> {
    named_paths(&source.text)
        .iter()
        .filter(|path| !path.in_test && forbidden.iter().any(|other| path.reaches(other)))
        .map(|path| Violation {
            file: source.path.clone(),
            line: path.line,
            complaint: format!("`{}` is out of reach for this crate", path.text()),
        })
        .collect()
}

/// `sources` (all those of one crate) without the files that are test code as a whole: those that
/// another one declares by `#[cfg(test)] mod name;` or `#[cfg(test)] #[path = "name.rs"] mod …;`, what lies
/// below them, and folders `tests`.
pub fn without_test_files(sources: Vec<Source>) -> Vec<Source> {
    let declared = sources.iter().flat_map(test_modules);
    let roots: Vec<String> = declared
        .chain(sources.iter().flat_map(test_files))
        .collect();
    let is_test = |path: &str| {
        let module = path.trim_end_matches(".rs");
        if module.split('/').any(|part| part == "tests") {
            return true;
        }
        roots
            .iter()
            .any(|root| module == root || module.starts_with(&format!("{root}/")))
    };
    sources
        .into_iter()
        .filter(|source| !is_test(&source.path))
        .collect()
}

/// The modules in files of their own that `source` declares for its tests only, as paths without
/// an ending.
fn test_modules(source: &Source) -> Vec<String> {
    let own = source.path.trim_end_matches(".rs");
    let (parent, name) = own.rsplit_once('/').unwrap_or(("", own));
    let folder = if matches!(name, "mod" | "lib" | "main") {
        parent
    } else {
        own
    };
    // Few files declare another one: the others need not be read as tokens.
    let declares = |line: &str| line.contains("mod ") && line.trim_end().ends_with(';');
    if !source.text.lines().any(declares) {
        return Vec::new();
    }
    let paths = named_paths(&source.text);
    let declared = paths
        .windows(2)
        .filter(|pair| pair[0].in_test && pair[0].inside.is_empty() && pair[0].segments == ["mod"]);
    declared
        .map(|pair| {
            format!("{folder}/{}", pair[1].text())
                .trim_matches('/')
                .to_owned()
        })
        .collect()
}

/// The files beside `source` that it declares for its tests only by an attribute with their path, as paths
/// without an ending.
fn test_files(source: &Source) -> Vec<String> {
    let folder = source
        .path
        .rsplit_once('/')
        .map_or("", |(folder, _)| folder);
    let after = source.text.split("#[cfg(test)]").skip(1);
    let named = after.filter_map(|text| {
        let path = text.trim_start().strip_prefix("#[path = \"")?;
        path.split('"').next()?.strip_suffix(".rs")
    });
    named
        .map(|name| format!("{folder}/{name}").trim_matches('/').to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn in_core(text: &str) -> usize {
        let source = Source {
            path: "filter/mod.rs".to_owned(),
            text: text.to_owned(),
        };
        forbidden_paths(&source, &FORBIDDEN_IN_CORE).len()
    }

    #[test]
    fn a_thread_beside_the_workers_and_a_navigator_at_the_terminal_are_noticed() {
        let count = |text: &str, forbidden: &[&[&str]]| {
            let source = Source {
                path: "crates/cli/src/fly.rs".to_owned(),
                text: text.to_owned(),
            };
            forbidden_paths(&source, forbidden).len()
        };
        let workers = &FORBIDDEN_BESIDE_WORKERS;
        assert_eq!(count("fn f() { std::thread::spawn(g); }", workers), 1);
        assert_eq!(
            count("use std::thread; fn f() { thread::scope(g); }", workers),
            1
        );
        assert_eq!(count("use rayon::prelude::*;", workers), 1);
        assert_eq!(
            count("fn f() { std::thread::available_parallelism(); }", workers),
            0
        );
        let terminal = &FORBIDDEN_AT_THE_TERMINAL;
        let flies = "use pilotage_core::navigator::{Navigator, Run};";
        assert_eq!(count(flies, terminal), 1);
        assert_eq!(count("use pilotage_core::navigator::Run;", terminal), 0);
    }

    #[test]
    fn a_clock_a_file_a_thread_and_a_screen_are_noticed_in_core() {
        assert_eq!(in_core("use std::time::{Duration, Instant};"), 1);
        assert_eq!(
            in_core("fn f() { let now = std::time::SystemTime::now(); }"),
            1
        );
        assert_eq!(in_core("use std::{fs, io};"), 1);
        assert_eq!(in_core("use std::time::*;"), 1);
        assert_eq!(in_core("fn f() { std::thread::spawn(g); }"), 1);
        assert_eq!(in_core("fn f() { println!(\"{x}\"); }"), 1);
        assert_eq!(in_core("use egui::Ui;"), 1);
    }

    #[test]
    fn durations_and_byte_streams_are_within_reach_of_core() {
        assert_eq!(in_core("use std::{io::Read, time::Duration};"), 0);
    }

    #[test]
    fn tests_of_core_may_read_files() {
        assert_eq!(in_core("#[cfg(test)]\nmod tests { use std::fs; }"), 0);
    }

    #[test]
    fn files_declared_for_tests_only_are_test_code_and_others_are_not() {
        let source = |path: &str, text: &str| Source {
            path: path.to_owned(),
            text: text.to_owned(),
        };
        let kept = without_test_files(vec![
            source("lib.rs", "mod views; #[cfg(test)] mod fixture;"),
            source("fixture.rs", ""),
            source("views/mod.rs", "#[cfg(test)]\nmod canvas;\nmod plots;"),
            source("views/canvas.rs", ""),
            source("views/plots_tests.rs", ""),
            source(
                "views/plots.rs",
                "#[cfg(test)] mod tests;\n#[cfg(test)]\n#[path = \"plots_tests.rs\"]\nmod more;",
            ),
            source("views/other_tests.rs", ""),
            source("views/plots/tests.rs", ""),
            source("views/plots/axis.rs", ""),
            source("views/tests/pictures.rs", ""),
        ]);
        let kept: Vec<_> = kept.iter().map(|source| source.path.as_str()).collect();
        assert_eq!(
            kept,
            [
                "lib.rs",
                "views/mod.rs",
                "views/plots.rs",
                "views/other_tests.rs",
                "views/plots/axis.rs"
            ]
        );
    }

    #[test]
    fn the_window_system_is_noticed_in_ui() {
        let text = "use eframe::App; fn f() { web_sys::window(); }".to_owned();
        let source = Source {
            path: "map/mod.rs".to_owned(),
            text,
        };
        assert_eq!(forbidden_paths(&source, &FORBIDDEN_IN_UI).len(), 2);
    }
}
