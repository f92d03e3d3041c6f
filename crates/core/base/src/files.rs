//! A set of files without a file system: a dropped folder, a zip, or a directory of the caller's.

use std::collections::BTreeMap;
use std::io::{Cursor, Read, Write};
use std::sync::Arc;

use zip::{CompressionMethod, ZipArchive};

use crate::bytes::{ByteSource, MemoryBytes};

/// Largest file that is unpacked from a zip, bytes.
const LARGEST_FILE: u64 = 1 << 30;

/// Files by name, `/` between folders.
pub trait FileSet: Send + Sync {
    /// Names of all files, for matching by their ends. May be incomplete.
    fn names(&self) -> Vec<String>;

    /// Contents of a file, `None` if there is none of that name.
    fn read(&self, name: &str) -> Option<Vec<u8>>;

    /// Sentences about what was left out when the set was opened, each with the name of its file.
    fn left_out(&self) -> Vec<String> {
        Vec::new()
    }

    /// A file for reading by pieces, `None` if there is none of that name. Whoever can read pieces
    /// does not keep large files in memory.
    fn source(&self, name: &str) -> Option<Arc<dyn ByteSource>> {
        Some(Arc::new(MemoryBytes::new(name, self.read(name)?)))
    }
}

/// Destination of files that are written.
pub trait FileSink {
    /// Writes a file; the error says what went wrong, in words.
    fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), String>;
}

/// Files in memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MemoryFiles(pub BTreeMap<String, Vec<u8>>);

impl FileSet for MemoryFiles {
    fn names(&self) -> Vec<String> {
        self.0.keys().cloned().collect()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.0.get(name).cloned()
    }
}

impl FileSink for MemoryFiles {
    fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        self.0.insert(name.to_owned(), bytes.to_vec());
        Ok(())
    }
}

/// Files in a zip; each is unpacked when it is asked for.
#[derive(Clone, Debug)]
pub struct ZipFiles {
    archive: ZipArchive<Cursor<Arc<[u8]>>>,
}

impl ZipFiles {
    /// Opens a zip; the error says in words why it is none.
    pub fn open(bytes: &[u8]) -> Result<Self, String> {
        let archive = ZipArchive::new(Cursor::new(Arc::from(bytes))).map_err(|e| {
            if bytes.starts_with(b"PK\x03\x04") {
                format!("a zip that is cut off or damaged: copy or download it again ({e})")
            } else {
                format!("not a readable zip file: {e}")
            }
        })?;
        let mut files = Self { archive };
        match files.locked() {
            Some(cause) => Err(cause.to_owned()),
            None => Ok(files),
        }
    }

    /// Why none of the files can be unpacked, and what to do, if so.
    fn locked(&mut self) -> Option<&'static str> {
        let (mut encrypted, mut unknown, mut readable) = (0, 0, 0);
        for index in 0..self.archive.len() {
            let Ok(file) = self.archive.by_index_raw(index) else {
                continue;
            };
            let method = file.compression();
            let is_known = [CompressionMethod::Stored, CompressionMethod::Deflated];
            match (file.is_dir(), file.encrypted(), is_known.contains(&method)) {
                (true, ..) => {}
                (_, true, _) => encrypted += 1,
                (_, _, false) => unknown += 1,
                _ => readable += 1,
            }
        }
        match (readable, encrypted, unknown) {
            (0, 1.., _) => Some(
                "a zip that is locked by a password: unpack it with that, and open what is in it",
            ),
            (0, _, 1..) => Some(
                "a zip whose files are packed by a method that is not read (not Deflate): unpack it, and open what is in it",
            ),
            _ => None,
        }
    }
}

impl FileSet for ZipFiles {
    fn names(&self) -> Vec<String> {
        self.archive
            .file_names()
            .flatten()
            .filter(|name| !name.ends_with('/'))
            .map(std::borrow::Cow::into_owned)
            .collect()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        // Cloning shares the bytes and the directory.
        let mut archive = self.archive.clone();
        let file = archive.by_name(name).ok()?;
        let mut bytes = Vec::new();
        file.take(LARGEST_FILE).read_to_end(&mut bytes).ok()?;
        Some(bytes)
    }
}

/// Writes a zip into memory.
pub struct ZipSink {
    writer: zip::ZipWriter<Cursor<Vec<u8>>>,
}

impl Default for ZipSink {
    fn default() -> Self {
        Self {
            writer: zip::ZipWriter::new(Cursor::new(Vec::new())),
        }
    }
}

impl ZipSink {
    /// The bytes of the finished zip.
    pub fn finish(self) -> Result<Vec<u8>, String> {
        self.writer
            .finish()
            .map(Cursor::into_inner)
            .map_err(|e| e.to_string())
    }
}

impl FileSink for ZipSink {
    fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let ending = name.rsplit('.').next().unwrap_or("");
        let packed = ["jpg", "jpeg", "png"].contains(&ending);
        let options = zip::write::SimpleFileOptions::default().compression_method(if packed {
            CompressionMethod::Stored
        } else {
            CompressionMethod::Deflated
        });
        self.writer
            .start_file(name, options)
            .map_err(|e| e.to_string())?;
        self.writer.write_all(bytes).map_err(|e| e.to_string())
    }
}

/// `directory/name` with `.` and `..` resolved as far as possible.
pub fn joined(directory: &str, name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    let separators = ['/', '\\'];
    let rooted = name.starts_with('/') || (directory.starts_with('/') && !name.is_empty());
    let directory = if name.starts_with('/') { "" } else { directory };
    for part in directory.split(separators).chain(name.split(separators)) {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|p| *p != "..") => {
                parts.pop();
            }
            other => parts.push(other),
        }
    }
    let path = parts.join("/");
    if rooted { format!("/{path}") } else { path }
}

/// The folder part of a name, without the last slash.
pub fn folder_of(name: &str) -> &str {
    name.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// The last part of a name, behind its folders.
pub fn file_of(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or(name)
}

/// Whether a name ends in a dot and one of `endings` (in small letters), in whatever case.
///
/// ```
/// use pilotage_base::files::has_ending;
///
/// assert!(has_ending("flight/IMG_1.JPG", &["jpg", "png"]));
/// assert!(!has_ending("jpg", &["jpg"]));
/// ```
pub fn has_ending(name: &str, endings: &[&str]) -> bool {
    let name = name.to_ascii_lowercase();
    endings.iter().any(|ending| {
        name.strip_suffix(ending)
            .is_some_and(|rest| rest.ends_with('.'))
    })
}

/// Names among files with one of these endings, in order.
pub fn names_ending_in(files: &dyn FileSet, endings: &[&str]) -> Vec<String> {
    let mut names = files.names();
    names.retain(|name| has_ending(name, endings));
    names.sort();
    names
}

/// Why a name does not lead to one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unresolved {
    /// No file ends like that.
    Missing,
    /// Several do; two of them.
    Ambiguous(String, String),
}

/// Contents of the file that `name` means: the file at one of `folders`, or else the only one in the
/// set whose path ends with `name`, or else the only one with the same last part. A folder may be a zip.
///
/// Returns its full name beside its contents.
///
/// ```
/// use pilotage_base::files::{FileSink, MemoryFiles, find};
///
/// let mut files = MemoryFiles::default();
/// files.write("brighton/frames/1.jpg", b"a picture")?;
/// // The end of a path is enough where it means one file only.
/// let found = find(&files, &["elsewhere"], "frames/1.jpg");
/// let (name, bytes) = found.map_err(|unresolved| format!("{unresolved:?}"))?;
/// assert_eq!(name, "brighton/frames/1.jpg");
/// assert_eq!(bytes, b"a picture");
/// # Ok::<(), String>(())
/// ```
pub fn find(
    files: &dyn FileSet,
    folders: &[&str],
    name: &str,
) -> Result<(String, Vec<u8>), Unresolved> {
    for folder in folders {
        let path = joined(folder, name);
        if let Some(bytes) = files.read(&path) {
            return Ok((path, bytes));
        }
        if let Some(bytes) = read_in_zip(files, &path) {
            return Ok((path, bytes));
        }
    }
    by_ending(files, name)
}

/// The only file of the set whose path ends with `name`, or else the only one with the same last part.
fn by_ending(files: &dyn FileSet, name: &str) -> Result<(String, Vec<u8>), Unresolved> {
    let names = files.names();
    let plain = joined("", name);
    let plain = plain.trim_start_matches("../").to_owned();
    let last = plain.rsplit('/').next().unwrap_or(&plain).to_owned();
    for ending in [&plain, &last] {
        let mut matching = names.iter().filter(|candidate| {
            candidate
                .strip_suffix(ending.as_str())
                .is_some_and(|rest| rest.is_empty() || rest.ends_with('/'))
        });
        if let Some(first) = matching.next() {
            if let Some(second) = matching.next() {
                return Err(Unresolved::Ambiguous(first.clone(), second.clone()));
            }
            return files
                .read(first)
                .map(|bytes| (first.clone(), bytes))
                .ok_or(Unresolved::Missing);
        }
    }
    Err(Unresolved::Missing)
}

/// Contents of a file whose path leads through a zip of the set.
fn read_in_zip(files: &dyn FileSet, path: &str) -> Option<Vec<u8>> {
    const ENDING: &str = ".zip/";
    let end = path.to_ascii_lowercase().find(ENDING)? + ENDING.len();
    let (archive, inside) = (path.get(..end - 1)?, path.get(end..)?);
    let bytes = files
        .read(archive)
        .or_else(|| by_ending(files, archive).ok().map(|(_, bytes)| bytes))?;
    ZipFiles::open(&bytes).ok()?.read(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(names: &[&str]) -> MemoryFiles {
        MemoryFiles(
            names
                .iter()
                .map(|n| ((*n).to_owned(), n.as_bytes().to_vec()))
                .collect(),
        )
    }

    #[test]
    fn a_file_is_found_by_its_place_before_its_ending() {
        let set = files(&["a/frames.csv", "b/frames.csv"]);
        let (name, _) = find(&set, &["b"], "frames.csv").unwrap();
        assert_eq!(name, "b/frames.csv");
        assert!(matches!(
            find(&set, &[""], "frames.csv"),
            Err(Unresolved::Ambiguous(..))
        ));
        assert_eq!(find(&set, &[""], "other.csv"), Err(Unresolved::Missing));
    }

    #[test]
    fn a_path_out_of_the_dropped_folder_is_matched_by_its_end() {
        let set = files(&["flight.json", "brighton/frames/1.jpg"]);
        let (name, _) = find(&set, &["../../data/brighton"], "frames/1.jpg").unwrap();
        assert_eq!(name, "brighton/frames/1.jpg");
    }

    #[test]
    fn dots_in_a_path_are_resolved() {
        assert_eq!(joined("a/b", "../c/./d.txt"), "a/c/d.txt");
        assert_eq!(joined("a", "../../c"), "../c");
        assert_eq!(joined("/a/b", "../c"), "/a/c");
        assert_eq!(joined("a", "/c"), "/c");
    }

    #[test]
    fn a_zip_gives_back_what_was_written_into_it() {
        let mut sink = ZipSink::default();
        sink.write("x/flight.json", b"{}").unwrap();
        sink.write("x/frames/1.jpg", &[1, 2, 3]).unwrap();
        let bytes = sink.finish().unwrap();
        let zip = ZipFiles::open(&bytes).unwrap();
        assert_eq!(zip.read("x/frames/1.jpg"), Some(vec![1, 2, 3]));
        assert_eq!(zip.read("y"), None);
        assert_eq!(zip.names().len(), 2);
        assert!(ZipFiles::open(&bytes[..bytes.len() / 2]).is_err());
    }

    #[test]
    fn a_zip_that_cannot_be_unpacked_says_why() {
        let mut sink = ZipSink::default();
        sink.write("a.csv", b"a,b\n1,2\n").unwrap();
        let sound = sink.finish().unwrap();
        let list = sound.windows(4).rposition(|w| w == b"PK\x01\x02").unwrap();
        // General purpose bit 0, and method 14 (LZMA): APPNOTE 4.4.4 and 4.4.5.
        for (flags, method, word) in [(1, 8, "password"), (0, 14, "method")] {
            let mut bytes = sound.clone();
            for (flag_at, method_at) in [(6, 8), (list + 8, list + 10)] {
                bytes[flag_at] |= flags;
                bytes[method_at] = method;
            }
            let error = ZipFiles::open(&bytes).unwrap_err();
            assert!(error.contains(word), "{error}");
        }
        let error = ZipFiles::open(&sound[..sound.len() - 10]).unwrap_err();
        assert!(error.contains("cut off"), "{error}");
    }

    #[test]
    fn a_zip_stands_for_a_folder() {
        let mut sink = ZipSink::default();
        sink.write("ATT.txt", b"attitude").unwrap();
        let zip = sink.finish().unwrap();
        let set = MemoryFiles([("data/log.zip".to_owned(), zip)].into());
        for folder in ["data/log.zip", "../elsewhere/log.zip"] {
            let (_, bytes) = find(&set, &[folder], "ATT.txt").unwrap();
            assert_eq!(bytes, b"attitude");
            assert_eq!(find(&set, &[folder], "GPS.txt"), Err(Unresolved::Missing));
        }
    }
}
