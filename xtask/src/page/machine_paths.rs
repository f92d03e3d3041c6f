//! Paths of the machine that builds stay there: a program tells by file and line where it failed, and without this by
//! the folder of whoever built it, which nobody else has, and which makes its size another one on each machine.

use std::{
    collections::BTreeSet,
    env, fs,
    io::ErrorKind,
    path::{Path, PathBuf},
};

use super::profile::{PROGRAMS, TARGET, module_name};
use crate::{failure::Failure, places};

/// Words for cargo by which the compiler calls files of libraries by their library alone (`egui-0.33.0/src/ui.rs`), beside
/// what `.cargo/config.toml` has it told.
pub fn left_out() -> Result<[String; 2], Failure> {
    Ok(["--config".to_owned(), told_to_cargo(&library_folders()?)])
}

/// Folders in which cargo keeps the sources of libraries, one for each registry: those of this program are there.
fn library_folders() -> Result<BTreeSet<PathBuf>, Failure> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(env::home_dir()?.join(".cargo")));
    let folder = home.unwrap_or_default().join("registry").join("src");
    let entries = match fs::read_dir(&folder) {
        // They come from elsewhere, as where all are kept beside the repository.
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(BTreeSet::new()),
        entries => entries.map_err(Failure::file(&folder))?,
    };
    Ok(entries.flatten().map(|entry| entry.path()).collect())
}

fn told_to_cargo(folders: &BTreeSet<PathBuf>) -> String {
    let flags = folders
        .iter()
        .map(|folder| format!("'--remap-path-prefix={}='", folder.display()));
    let flags: Vec<String> = flags.collect();
    format!("target.{TARGET}.rustflags=[{}]", flags.join(", "))
}

/// Fails if a program of `dist` has the path of a library's folder or of the repository in it.
pub fn check(dist: &Path) -> Result<(), Failure> {
    let mut paths = library_folders()?;
    paths.insert(places::root().to_owned());
    for package in PROGRAMS {
        let file = dist
            .join("pkg")
            .join(format!("{}_bg.wasm", module_name(package)));
        let bytes = fs::read(&file).map_err(Failure::file(&file))?;
        if let Some(path) = paths.iter().find(|path| has(&bytes, path)) {
            let path = path.display();
            return Err(Failure::Check(format!("{package} has {path} in it")));
        }
    }
    Ok(())
}

fn has(bytes: &[u8], path: &Path) -> bool {
    let path = path.as_os_str().as_encoded_bytes();
    bytes.windows(path.len()).any(|window| window == path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_folder_of_libraries_is_left_out() {
        let folders = ["/cargo/registry/src/index", "/cargo/registry/src/own"];
        let folders = folders.map(PathBuf::from).into_iter().collect();
        assert_eq!(
            told_to_cargo(&folders),
            "target.wasm32-unknown-unknown.rustflags=[\
             '--remap-path-prefix=/cargo/registry/src/index=', \
             '--remap-path-prefix=/cargo/registry/src/own=']"
        );
        assert_eq!(
            told_to_cargo(&BTreeSet::new()),
            "target.wasm32-unknown-unknown.rustflags=[]"
        );
    }

    #[test]
    fn a_path_is_found_in_a_program() {
        let folder = Path::new("/cargo/registry");
        assert!(has(b"\0asm /cargo/registry/src/lib.rs", folder));
        assert!(!has(b"\0asm egui-1/src/lib.rs", folder));
    }
}
