//! Crates that the page has in another form than the native programs: those that ask what they are compiled for. All
//! others are the same text there, which the linter has read natively.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::failure::Failure;

/// Whether the crate that the compiler is told of by `options` is compiled for the page from other code than natively.
pub fn has_own_form(options: &[String]) -> Result<bool, Failure> {
    // Which features are chosen may differ.
    if options.iter().any(|option| option.starts_with("feature=")) {
        return Ok(true);
    }
    let mut sources = options.iter().map(Path::new);
    let source = sources.find(|source| source.extension().is_some_and(|end| end == "rs"));
    let folder = source.and_then(Path::parent);
    folder.map_or(Ok(true), holds_condition)
}

/// Whether a source in `folder` or below it has a condition other than that it is compiled for tests.
fn holds_condition(folder: &Path) -> Result<bool, Failure> {
    for entry in fs::read_dir(folder).map_err(Failure::file(folder))? {
        let path: PathBuf = entry.map_err(Failure::file(folder))?.path();
        let holds = if path.is_dir() {
            holds_condition(&path)?
        } else if path.extension().is_some_and(|end| end == "rs") {
            is_conditional(&fs::read_to_string(&path).map_err(Failure::file(&path))?)
        } else {
            false
        };
        if holds {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether a text has a condition other than that it is compiled for tests.
fn is_conditional(text: &str) -> bool {
    let conditions = ["cfg(", "cfg!(", "cfg_attr(", "cfg_select!"];
    let text = text.replace("cfg(test)", "");
    conditions.iter().any(|condition| text.contains(condition))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(line: &str) -> Vec<String> {
        line.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn texts_that_ask_what_they_are_compiled_for_are_told_from_those_that_have_tests() {
        for conditional in [
            "#[cfg(target_arch = \"wasm32\")]\nmod page;",
            "#![cfg(target_arch = \"wasm32\")]",
            "const FAST: bool = cfg!(debug_assertions);",
            "#[cfg_attr(not(unix), expect(unused))]",
            "#[cfg(any(test, not(target_arch = \"wasm32\")))]\nmod plain;",
            "#[cfg(test)]\nmod tests;\n#[cfg(windows)]\nmod windows;",
        ] {
            assert!(is_conditional(conditional), "{conditional}");
        }
        assert!(!is_conditional("#[cfg(test)]\nmod tests {}"));
    }

    #[test]
    fn crates_are_known_by_their_sources_and_features() {
        let of = |folder: &str, more: &str| {
            let source = crate::places::root().join(folder).join("src/lib.rs");
            let line = format!("--crate-name a {} --crate-type lib{more}", source.display());
            has_own_form(&options(&line)).unwrap()
        };
        assert!(of("crates/web", "") && of("crates/worker", "") && of("crates/core/raster", ""));
        assert!(!of("crates/core/flight", ""));
        assert!(of("crates/core/flight", " --cfg feature=\"small\""));
    }

    #[test]
    fn a_crate_whose_source_is_not_told_is_looked_at() {
        assert!(has_own_form(&options("--crate-name a")).unwrap());
    }
}
