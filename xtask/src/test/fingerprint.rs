//! The identity of a program: its code and data.

use std::{
    collections::hash_map::DefaultHasher,
    fs,
    hash::{Hash as _, Hasher as _},
    path::{Path, PathBuf},
};

use object::{Object as _, ObjectSection as _, SectionKind};

/// Tells the program in `file` from others by its code and data. Names, lines and all else for debuggers do not count:
/// a program that was linked anew since a library changed of which it uses nothing that changed is the same.
/// `None` if it cannot be read.
pub fn of(file: &Path) -> Option<String> {
    let bytes = fs::read(file).ok()?;
    let mut hasher = DefaultHasher::new();
    match object::File::parse(bytes.as_slice()) {
        Ok(program) => {
            for section in program.sections() {
                let name = section.name_bytes().ok()?;
                if !is_run_or_read(section.kind()) && !ADDRESSES.contains(&name) {
                    continue;
                }
                // It follows from the code, and the linker fills its gaps with whatever lay there.
                if name == b".gcc_except_table" {
                    continue;
                }
                name.hash(&mut hasher);
                section.size().hash(&mut hasher);
                section.data().ok()?.hash(&mut hasher);
            }
        }
        Err(_) => bytes.hash(&mut hasher),
    }
    Some(format!("{} {:016x}", file.display(), hasher.finish()))
}

/// Sections that the loader fills tables of addresses from: a program that may lie anywhere has zeros in such a table
/// until it is loaded, so that two entries that change places are seen here alone.
const ADDRESSES: [&[u8]; 2] = [b".rela.dyn", b".relr.dyn"];

/// Folders that programs fill.
const MADE: [&str; 3] = ["node_modules", "__pycache__", "target"];

/// Tells what lies in `places`, files and folders with all below them, from what it was: those files whose path `counts`,
/// by their names and contents. Folders of other packages (with a manifest of their own) do not count. `None` if one
/// cannot be read.
pub fn of_files(places: &[PathBuf], counts: &dyn Fn(&Path) -> bool) -> Option<String> {
    let mut hasher = DefaultHasher::new();
    for place in places {
        hash_all(place, &mut hasher, &mut |file, hasher| {
            if counts(file) {
                file.file_name()?.hash(hasher);
                fs::read(file).ok()?.hash(hasher);
            }
            Some(())
        })?;
    }
    Some(format!("{:016x}", hasher.finish()))
}

/// Tells which files lie below `folder`, and of how many bytes each is and when it was written, from what it was. Nothing of
/// a folder that is not there.
pub fn of_listing(folder: &Path) -> String {
    let mut hasher = DefaultHasher::new();
    let told = hash_all(folder, &mut hasher, &mut |file, hasher| {
        // A link that leads nowhere hides none of the others.
        if let Ok(told) = fs::metadata(file) {
            (told.len(), told.modified().ok()).hash(hasher);
        }
        Some(())
    });
    format!("{:016x} {}", hasher.finish(), told.is_some())
}

/// Brings all files below a place, in the order of their names, to `of_file`; `None` if it or the system gives up.
fn hash_all(
    place: &Path,
    hasher: &mut DefaultHasher,
    of_file: &mut dyn FnMut(&Path, &mut DefaultHasher) -> Option<()>,
) -> Option<()> {
    if !place.is_dir() {
        return of_file(place, hasher);
    }
    let entries = fs::read_dir(place).ok()?;
    let mut entries: Vec<_> = entries.collect::<Result<_, _>>().ok()?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let inner = entry.path();
        let is_made = MADE.iter().any(|made| entry.file_name() == **made);
        if !is_made && !inner.join("Cargo.toml").is_file() {
            entry.file_name().hash(hasher);
            hash_all(&inner, hasher, of_file)?;
        }
    }
    Some(())
}

fn is_run_or_read(kind: SectionKind) -> bool {
    matches!(
        kind,
        SectionKind::Text
            | SectionKind::Data
            | SectionKind::ReadOnlyData
            | SectionKind::ReadOnlyDataWithRel
            | SectionKind::ReadOnlyString
            | SectionKind::UninitializedData
            | SectionKind::Tls
            | SectionKind::UninitializedTls
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_listing_is_known_by_its_files() {
        let folder = std::env::temp_dir().join(format!("pilotage-listing-{}", std::process::id()));
        let none = of_listing(&folder);
        fs::create_dir_all(folder.join("site")).unwrap();
        fs::write(folder.join("site/flight.csv"), "t").unwrap();
        let one = of_listing(&folder);
        assert_ne!(one, none);
        assert_eq!(of_listing(&folder), one);
        fs::write(folder.join("site/other.csv"), "t").unwrap();
        assert_ne!(of_listing(&folder), one);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_program_is_known_by_its_code_and_not_by_what_stands_behind_it() {
        let own = std::env::current_exe().unwrap();
        let copy = std::env::temp_dir().join(format!("pilotage-print-{}", std::process::id()));
        let mut bytes = fs::read(&own).unwrap();
        let (code, addresses) = {
            let program = object::File::parse(bytes.as_slice()).unwrap();
            let middle = |section: Option<object::Section<'_, '_>>| {
                let (at, size) = section?.file_range()?;
                usize::try_from(at + size / 2).ok()
            };
            let mut sections = program.sections();
            let code = sections.find(|s| s.kind() == SectionKind::Text && s.size() > 1000);
            (
                middle(code).unwrap(),
                middle(program.section_by_name(".rela.dyn")),
            )
        };
        fs::write(&copy, &bytes).unwrap();
        let first = of(&copy).unwrap();
        bytes.extend_from_slice(b"what a debugger may want to know");
        fs::write(&copy, &bytes).unwrap();
        assert_eq!(of(&copy).unwrap(), first);
        for place in [Some(code), addresses].into_iter().flatten() {
            bytes[place] ^= 1;
            fs::write(&copy, &bytes).unwrap();
            assert_ne!(of(&copy).unwrap(), first, "at {place}");
            bytes[place] ^= 1;
        }
        fs::remove_file(&copy).unwrap();
        assert_eq!(of(&copy), None);
    }
}
