//! Files as they were dropped: plain ones and zips, looked through as one set.

use std::collections::BTreeMap;
use std::sync::Arc;

use pilotage_core::flight::files::{FileSet, MemoryFiles, ZipFiles};

/// Files of one drop.
pub struct FilePool {
    parts: Vec<Arc<dyn FileSet>>,
}

impl FilePool {
    /// Takes the files; zips are looked into, and one that cannot be read is named.
    pub fn new(files: &[(String, Vec<u8>)]) -> Result<Self, String> {
        let mut plain = BTreeMap::new();
        let mut parts: Vec<Arc<dyn FileSet>> = Vec::new();
        for (path, bytes) in files {
            if has_ending(path, &["zip"]) {
                let zip = ZipFiles::open(bytes).map_err(|cause| format!("{path}: {cause}"))?;
                parts.push(Arc::new(zip));
            } else {
                plain.insert(path.clone(), bytes.clone());
            }
        }
        parts.insert(0, Arc::new(MemoryFiles(plain)));
        Ok(Self { parts })
    }

    /// Names with one of these endings, in order.
    pub fn ending_in(&self, endings: &[&str]) -> Vec<String> {
        let mut names = self.names();
        names.retain(|name| has_ending(name, endings));
        names.sort();
        names
    }
}

/// Whether a name ends in a dot and one of `endings` (in small letters), in whatever case.
pub fn has_ending(name: &str, endings: &[&str]) -> bool {
    let name = name.to_ascii_lowercase();
    endings.iter().any(|ending| {
        name.strip_suffix(ending)
            .is_some_and(|rest| rest.ends_with('.'))
    })
}

impl FileSet for FilePool {
    fn names(&self) -> Vec<String> {
        self.parts.iter().flat_map(|part| part.names()).collect()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.parts.iter().find_map(|part| part.read(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::flight::files::{FileSink as _, ZipSink};

    #[test]
    fn files_in_a_zip_stand_beside_plain_ones() {
        let mut sink = ZipSink::default();
        sink.write("flight/flight.json", b"{}").unwrap();
        let files = [
            ("ortho.JPG".to_owned(), vec![1]),
            ("flight.zip".to_owned(), sink.finish().unwrap()),
        ];
        let pool = FilePool::new(&files).unwrap();
        assert_eq!(pool.read("flight/flight.json"), Some(b"{}".to_vec()));
        assert_eq!(pool.ending_in(&["jpg"]), ["ortho.JPG"]);
    }

    #[test]
    fn a_broken_zip_is_named() {
        let files = [("flight.zip".to_owned(), vec![7; 100])];
        let cause = FilePool::new(&files).err().unwrap();
        assert!(cause.starts_with("flight.zip: "), "{cause}");
    }
}
