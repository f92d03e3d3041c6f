//! The shape of the sources: length of files, places of `unsafe`, paths of somebody's machine,
//! and whether the architecture page names every folder.

use crate::{Violation, sources::Source, tokens::named_paths};

/// No source file is longer, in lines.
pub const LONGEST: usize = 700;
/// Half of the source files are shorter, in lines.
pub const MEDIAN_BELOW: usize = 200;

/// Kinds of files that count as source.
const CODE: [&str; 6] = ["rs", "js", "mjs", "py", "html", "css"];

/// Source files over [`LONGEST`] lines.
pub fn too_long(sources: &[Source]) -> Vec<Violation> {
    let code = sources
        .iter()
        .filter(|source| CODE.iter().any(|kind| source.is(kind)));
    code.filter(|source| source.text.lines().count() > LONGEST)
        .map(|source| {
            let length = source.text.lines().count();
            let complaint = format!("{length} lines, more than {LONGEST}: cut it by what it does");
            Violation {
                file: source.path.clone(),
                line: 0,
                complaint,
            }
        })
        .collect()
}

/// Median length of the Rust files in lines, or 0 where there is none.
pub fn median_length(sources: &[Source]) -> usize {
    let rust = sources.iter().filter(|source| source.is("rs"));
    let mut lengths: Vec<_> = rust.map(|source| source.text.lines().count()).collect();
    lengths.sort_unstable();
    lengths.get(lengths.len() / 2).copied().unwrap_or(0)
}

/// `unsafe` in a Rust file whose name (or whose folder's name) does not begin with `simd`.
pub fn misplaced_unsafe(source: &Source) -> Vec<Violation> {
    if !source.is("rs") || source.path.split('/').any(|part| part.starts_with("simd")) {
        return Vec::new();
    }
    let is_unsafe = |segments: &[String]| segments.iter().any(|segment| segment == "unsafe");
    named_paths(&source.text)
        .iter()
        .filter(|path| is_unsafe(&path.segments))
        .map(|path| Violation {
            file: source.path.clone(),
            line: path.line,
            complaint: "`unsafe` belongs into a module named simd…".to_owned(),
        })
        .collect()
}

/// Lines that name a folder of somebody's machine.
pub fn machine_paths(source: &Source) -> Vec<Violation> {
    // Put together here, so that this file does not name them itself.
    let marks: Vec<String> = ["work", "home", "root", "Users", "tmp/bash"]
        .iter()
        .map(|folder| format!("/{folder}/"))
        .chain([format!("C:{}", '\\')])
        .collect();
    let lines = source.text.lines().enumerate();
    lines
        .filter(|(_, line)| marks.iter().any(|mark| names_folder(line, mark)))
        .map(|(index, line)| Violation {
            file: source.path.clone(),
            line: index + 1,
            complaint: format!("a folder of one machine: {}", line.trim()),
        })
        .collect()
}

/// Whether `line` has `mark` at the beginning of a path, not in the middle of one.
fn names_folder(line: &str, mark: &str) -> bool {
    line.match_indices(mark).any(|(place, _)| {
        let before = line[..place].chars().next_back();
        !before.is_some_and(|letter| letter.is_alphanumeric() || "._-/".contains(letter))
    })
}

/// Folders that `architecture` does not mention as `` `folder/` ``.
pub fn unmentioned_folders(architecture: &str, folders: &[String]) -> Vec<Violation> {
    folders
        .iter()
        .filter(|folder| !architecture.contains(&format!("`{folder}/`")))
        .map(|folder| Violation {
            file: "ARCHITECTURE.md".to_owned(),
            line: 0,
            complaint: format!("has no line for `{folder}/`"),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(path: &str, text: &str) -> Source {
        Source {
            path: path.to_owned(),
            text: text.to_owned(),
        }
    }

    #[test]
    fn a_file_that_is_too_long_is_noticed() {
        let at_the_limit = source("a.rs", &"//\n".repeat(LONGEST));
        let above = source("b.mjs", &"//\n".repeat(LONGEST + 1));
        let found = too_long(&[at_the_limit, above]);
        assert_eq!(
            found.iter().map(|it| it.file.as_str()).collect::<Vec<_>>(),
            ["b.mjs"]
        );
    }

    #[test]
    fn the_median_is_the_length_in_the_middle() {
        let lengths = [1, 300, 7].map(|length| source("a.rs", &"//\n".repeat(length)));
        assert_eq!(median_length(&lengths), 7);
    }

    #[test]
    fn unsafe_is_noticed_outside_simd_modules_only() {
        let block = "fn f() { unsafe { g() } }";
        assert_eq!(misplaced_unsafe(&source("raster/warp.rs", block)).len(), 1);
        assert!(misplaced_unsafe(&source("raster/simd_x86.rs", block)).is_empty());
        assert!(misplaced_unsafe(&source("raster/simd/x86.rs", block)).is_empty());
        assert!(misplaced_unsafe(&source("raster/warp.rs", "#![deny(unsafe_code)]")).is_empty());
    }

    #[test]
    fn a_folder_of_one_machine_is_noticed() {
        let bad = format!("see /{}/somebody/notes.txt", "home");
        assert_eq!(machine_paths(&source("a.md", &bad)).len(), 1);
        let address = format!("https://example.org/{}/page", "home");
        assert!(machine_paths(&source("a.md", &address)).is_empty());
    }

    #[test]
    fn a_folder_missing_from_the_architecture_page_is_noticed() {
        let folders = ["crates/a/src".to_owned(), "crates/a/src/b".to_owned()];
        let found = unmentioned_folders("- `crates/a/src/`: a", &folders);
        assert_eq!(found.len(), 1);
        assert!(found[0].complaint.contains("crates/a/src/b/"));
    }
}
