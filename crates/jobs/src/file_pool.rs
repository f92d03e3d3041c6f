//! Files as they were dropped: plain ones, zips and MATLAB files, looked through as one set.

use std::collections::BTreeMap;
use std::sync::Arc;

use pilotage_core::flight::files::{FileSet, ZipFiles, has_ending};
use pilotage_core::flight::mat::{self, MatFiles};
use pilotage_core::imagery::ByteSource;

use super::{FileContent, LentFiles};

/// Largest file that is read whole, bytes; `WHOLE` of `www/files.js`, which refuses larger ones before they are read.
const LARGEST_WHOLE: u64 = 1 << 30;

/// Files of one drop.
pub struct FilePool {
    plain: BTreeMap<String, Arc<dyn ByteSource>>,
    /// Files inside zips and MATLAB files.
    inner: Vec<Box<dyn FileSet>>,
}

impl FilePool {
    /// Takes the files; zips and MATLAB files are looked into, and one that cannot be read is named.
    pub fn new(files: &[(String, FileContent)], lent: &LentFiles) -> Result<Self, String> {
        let mut pool = Self {
            plain: BTreeMap::new(),
            inner: Vec::new(),
        };
        for (path, content) in files {
            let blame = |cause: String| format!("{path}: {cause}");
            let source = content.source(path, lent).map_err(blame)?;
            if has_ending(path, &["zip"]) {
                let bytes = whole(source.as_ref()).map_err(blame)?;
                pool.inner
                    .push(Box::new(ZipFiles::open(&bytes).map_err(blame)?));
            } else if has_ending(path, &[mat::ENDING]) {
                let bytes = whole(source.as_ref()).map_err(blame)?;
                let tables = MatFiles::open(path, &bytes).map_err(|cause| cause.to_string())?;
                pool.inner.push(Box::new(tables));
            } else {
                pool.plain.insert(path.clone(), source);
            }
        }
        Ok(pool)
    }
}

/// All bytes of a file; the error says in words why not.
fn whole(source: &dyn ByteSource) -> Result<Vec<u8>, String> {
    let length = source.length();
    if length > LARGEST_WHOLE {
        let gigabytes = length as f64 / f64::from(1 << 30);
        return Err(format!(
            "{gigabytes:.1} GiB are too many to be read at once"
        ));
    }
    source.read(0, length as usize)
}

/// All bytes of a file of a set; the error says in words why not.
pub fn read_or_say(files: &dyn FileSet, name: &str) -> Result<Vec<u8>, String> {
    if let Some(bytes) = files.read(name) {
        return Ok(bytes);
    }
    let source = files.source(name);
    let source = source.ok_or_else(|| "it cannot be read; open it again".to_owned())?;
    whole(source.as_ref())
}

/// Whether bytes have these words somewhere.
pub fn contains(bytes: &[u8], words: &[u8]) -> bool {
    bytes.windows(words.len()).any(|w| w == words)
}

impl FileSet for FilePool {
    fn names(&self) -> Vec<String> {
        let inner = self.inner.iter().flat_map(|files| files.names());
        self.plain.keys().cloned().chain(inner).collect()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        if let Some(source) = self.plain.get(name) {
            return whole(source.as_ref()).ok();
        }
        self.inner.iter().find_map(|files| files.read(name))
    }

    fn left_out(&self) -> Vec<String> {
        let inner = self.inner.iter();
        inner.flat_map(|files| files.left_out()).collect()
    }

    fn source(&self, name: &str) -> Option<Arc<dyn ByteSource>> {
        let plain = self.plain.get(name).cloned();
        plain.or_else(|| self.inner.iter().find_map(|files| files.source(name)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::flight::files::{FileSink as _, ZipSink, names_ending_in};

    #[test]
    fn files_in_a_zip_stand_beside_plain_ones() {
        let mut sink = ZipSink::default();
        sink.write("flight/flight.json", b"{}").unwrap();
        let files = [
            ("ortho.JPG".to_owned(), vec![1].into()),
            ("flight.zip".to_owned(), sink.finish().unwrap().into()),
        ];
        let pool = FilePool::new(&files, &LentFiles::default()).unwrap();
        assert_eq!(pool.read("flight/flight.json"), Some(b"{}".to_vec()));
        assert_eq!(names_ending_in(&pool, &["jpg"]), ["ortho.JPG"]);
    }

    #[test]
    fn the_page_refuses_what_is_too_large_here() {
        let page = include_str!("../../../www/files.js");
        assert!(page.contains("const WHOLE = 1 << 30;"));
        assert_eq!(LARGEST_WHOLE, 1 << 30);
    }

    #[test]
    fn a_broken_zip_is_named() {
        let files = [("flight.zip".to_owned(), vec![7; 100].into())];
        let cause = FilePool::new(&files, &LentFiles::default()).err().unwrap();
        assert!(cause.starts_with("flight.zip: "), "{cause}");
    }

    #[test]
    fn a_lent_file_is_read_where_it_is_and_one_that_is_gone_is_named() {
        let mut lent = LentFiles::default();
        let map = pilotage_core::imagery::MemoryBytes::new("", vec![5, 6, 7, 8]);
        lent.files.insert(3, Arc::new(map));
        let content = FileContent::Lent {
            number: 3,
            length: 4,
        };
        let files = [("big/map.tif".to_owned(), content)];
        let pool = FilePool::new(&files, &lent).unwrap();
        let source = pool.source("big/map.tif").unwrap();
        assert_eq!((source.name(), source.length()), ("big/map.tif", 4));
        assert_eq!(source.read(1, 2), Ok(vec![6, 7]));
        let gone = FilePool::new(&files, &LentFiles::default());
        let cause = gone.err().unwrap();
        assert!(cause.starts_with("big/map.tif: ") && cause.contains("open it again"));
    }
}
