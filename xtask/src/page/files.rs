//! The folder of the page: emptied, filled, listed.

use std::{
    fs,
    path::{Path, PathBuf},
};

use super::profile::{PROGRAMS, module_name};
use crate::{failure::Failure, places};

/// Empty file in a page that is being put together.
const UNFINISHED: &str = ".unfinished-page";

/// Refuses `dist` if it holds something else than a page.
pub fn refuse_others(dist: &Path) -> Result<(), Failure> {
    if !dist.exists() {
        return Ok(());
    }
    let mut entries = fs::read_dir(dist).map_err(Failure::file(dist))?;
    // One that was not finished has some of the programs.
    let is_page = PROGRAMS.iter().any(|program| {
        let glue = format!("{}.js", module_name(program));
        dist.join("pkg").join(glue).is_file()
    });
    if entries.next().is_some() && !is_page && !dist.join(UNFINISHED).is_file() {
        return Err(Failure::ForeignFolder(dist.to_owned()));
    }
    Ok(())
}

/// Makes `dist` an empty folder, but for a mark that a page is put together there (`finish` takes it away). Refuses one
/// that holds something else than a page.
pub fn clear(dist: &Path) -> Result<(), Failure> {
    refuse_others(dist)?;
    if dist.exists() {
        fs::remove_dir_all(dist).map_err(Failure::file(dist))?;
    }
    fs::create_dir_all(dist).map_err(Failure::file(dist))?;
    let mark = dist.join(UNFINISHED);
    fs::write(&mark, "").map_err(Failure::file(&mark))
}

/// Takes the mark away of a page that is put together.
pub fn finish(dist: &Path) -> Result<(), Failure> {
    let mark = dist.join(UNFINISHED);
    fs::remove_file(&mark).map_err(Failure::file(&mark))
}

/// Copies `index.html` and the content of `www/` to the root of `dist`.
pub fn copy_shell(dist: &Path) -> Result<(), Failure> {
    copy(&places::root().join("index.html"), &dist.join("index.html"))?;
    let www = places::root().join("www");
    for file in below(&www)? {
        copy(&www.join(&file), &dist.join(&file))?;
    }
    Ok(())
}

/// Every file below `folder`, relative to it, sorted.
pub fn below(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    let mut open = vec![PathBuf::new()];
    while let Some(inner) = open.pop() {
        let place = folder.join(&inner);
        for entry in fs::read_dir(&place).map_err(Failure::file(&place))? {
            let name = entry.map_err(Failure::file(&place))?.file_name();
            let path = inner.join(name);
            if folder.join(&path).is_dir() {
                open.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

/// The path of a file in an address: its parts with `/` between them.
pub fn address(file: &Path) -> String {
    let parts: Vec<_> = file
        .components()
        .map(|part| part.as_os_str().to_string_lossy())
        .collect();
    parts.join("/")
}

fn copy(from: &Path, to: &Path) -> Result<(), Failure> {
    if let Some(parent) = to.parent() {
        fs::create_dir_all(parent).map_err(Failure::file(parent))?;
    }
    fs::copy(from, to).map_err(Failure::file(from))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("pilotage-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn a_folder_with_somebody_s_files_is_not_cleared() {
        let folder = scratch("foreign");
        fs::write(folder.join("letter.txt"), "dear").unwrap();
        assert!(matches!(clear(&folder), Err(Failure::ForeignFolder(_))));
        assert!(folder.join("letter.txt").is_file());
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_page_built_earlier_is_cleared() {
        let folder = scratch("page");
        fs::create_dir(folder.join("pkg")).unwrap();
        fs::write(folder.join("pkg/pilotage_web.js"), "").unwrap();
        fs::write(folder.join("old.js"), "").unwrap();
        clear(&folder).unwrap();
        finish(&folder).unwrap();
        assert!(below(&folder).unwrap().is_empty());
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_page_that_was_not_finished_is_cleared() {
        let folder = scratch("unfinished");
        clear(&folder).unwrap();
        fs::write(folder.join("half.js"), "").unwrap();
        clear(&folder).unwrap();
        finish(&folder).unwrap();
        fs::create_dir(folder.join("pkg")).unwrap();
        fs::write(folder.join("pkg/pilotage_worker_flying.js"), "").unwrap();
        refuse_others(&folder).unwrap();
        fs::remove_dir_all(&folder).unwrap();
    }
}
