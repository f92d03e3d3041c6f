//! The identity of a program: its code and data.

use std::{
    collections::hash_map::DefaultHasher,
    fs,
    hash::{Hash as _, Hasher as _},
    path::Path,
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
            for section in program.sections().filter(|s| is_run_or_read(s.kind())) {
                let name = section.name_bytes().ok()?;
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

/// Tells the files below `folder` from what they were, by their names and contents. `None` if one cannot be read.
pub fn of_folder(folder: &Path) -> Option<String> {
    fn hash_all(folder: &Path, hasher: &mut DefaultHasher) -> Option<()> {
        let entries = fs::read_dir(folder).ok()?;
        let mut entries: Vec<_> = entries.collect::<Result<_, _>>().ok()?;
        entries.sort_by_key(fs::DirEntry::file_name);
        for entry in entries {
            entry.file_name().hash(hasher);
            let place = entry.path();
            if entry.file_type().ok()?.is_dir() {
                hash_all(&place, hasher)?;
            } else {
                fs::read(&place).ok()?.hash(hasher);
            }
        }
        Some(())
    }
    let mut hasher = DefaultHasher::new();
    hash_all(folder, &mut hasher)?;
    Some(format!("{:016x}", hasher.finish()))
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
    fn a_program_is_known_by_its_code_and_not_by_what_stands_behind_it() {
        let own = std::env::current_exe().unwrap();
        let copy = std::env::temp_dir().join(format!("pilotage-print-{}", std::process::id()));
        let mut bytes = fs::read(&own).unwrap();
        let (code, size) = {
            let program = object::File::parse(bytes.as_slice()).unwrap();
            let mut sections = program.sections();
            let code = sections.find(|s| s.kind() == SectionKind::Text && s.size() > 1000);
            let (at, size) = code.unwrap().file_range().unwrap();
            (usize::try_from(at).unwrap(), usize::try_from(size).unwrap())
        };
        fs::write(&copy, &bytes).unwrap();
        let first = of(&copy).unwrap();
        bytes.extend_from_slice(b"what a debugger may want to know");
        fs::write(&copy, &bytes).unwrap();
        assert_eq!(of(&copy).unwrap(), first);
        bytes[code + size / 2] ^= 1;
        fs::write(&copy, &bytes).unwrap();
        assert_ne!(of(&copy).unwrap(), first);
        fs::remove_file(&copy).unwrap();
        assert_eq!(of(&copy), None);
    }
}
