//! The text files of the repository.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// Folders that are made by tools and belong to nobody's sources.
const MADE: [&str; 5] = [".git", "target", "dist", "node_modules", "__pycache__"];

/// A text file of the repository.
#[derive(Debug, Clone)]
pub struct Source {
    /// Path relative to the folder that was searched, with `/` between the parts.
    pub path: String,
    /// Its text.
    pub text: String,
}

impl Source {
    /// Whether the file name ends in `.extension`.
    pub fn is(&self, extension: &str) -> bool {
        Path::new(&self.path)
            .extension()
            .is_some_and(|found| found == extension)
    }
}

/// Sources made of paths and texts.
#[cfg(test)]
pub fn made_of(files: &[(&str, &str)]) -> Vec<Source> {
    let source = |(path, text): &(&str, &str)| Source {
        path: (*path).to_owned(),
        text: (*text).to_owned(),
    };
    files.iter().map(source).collect()
}

/// Root of the repository.
pub fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Every text file below `folder` (relative to the root of the repository), sorted by path.
///
/// # Panics
/// If a folder of the repository cannot be read.
pub fn below(folder: &str) -> Vec<Source> {
    let root = repository().join(folder);
    let mut sources: Vec<_> = files(&root)
        .into_iter()
        .filter_map(|place| {
            let text = fs::read_to_string(&place).ok()?;
            Some(Source {
                path: relative(&root, &place),
                text,
            })
        })
        .collect();
    sources.sort_by(|one, other| one.path.cmp(&other.path));
    sources
}

/// Every folder below `folder` and itself, relative to the root of the repository, that holds
/// at least one Rust file.
pub fn folders_with_rust(folder: &str) -> Vec<String> {
    let mut folders: Vec<_> = below(folder)
        .into_iter()
        .filter(|source| source.is("rs"))
        .map(|source| match source.path.rsplit_once('/') {
            Some((parent, _)) => format!("{folder}/{parent}"),
            None => folder.to_owned(),
        })
        .collect();
    folders.sort();
    folders.dedup();
    folders
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .map(|entry| entry.expect("a folder can be read to its end"));
    let mut found = Vec::new();
    for entry in entries {
        let name = entry.file_name();
        if MADE.iter().any(|made| name == *made) {
            continue;
        }
        let place = entry.path();
        if place.is_dir() {
            found.extend(files(&place));
        } else {
            found.push(place);
        }
    }
    found
}

fn relative(root: &Path, place: &Path) -> String {
    let parts = place
        .strip_prefix(root)
        .expect("the file was found below the root")
        .components();
    let parts: Vec<_> = parts
        .map(|part| part.as_os_str().to_string_lossy())
        .collect();
    parts.join("/")
}
