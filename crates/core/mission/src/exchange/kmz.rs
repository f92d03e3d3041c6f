//! KMZ: a zip of KML documents, and of further KMZ that links lead to.

use super::kml_links::main_document;
use pilotage_base::files::{FileSet, ZipFiles};

/// Most archives within an archive that are looked into.
const MOST_WITHIN: usize = 100;

/// Files of a KMZ and, behind the names of those within it (`files/part.kmz/doc.kml`), of these.
pub(super) struct KmzFiles {
    outer: ZipFiles,
    within: Vec<(String, ZipFiles)>,
}

impl KmzFiles {
    /// Opens a KMZ; archives within it that cannot be opened are files as any others.
    pub fn open(bytes: &[u8]) -> Result<Self, String> {
        let outer = ZipFiles::open(bytes)?;
        let names = outer.names().into_iter().filter(|name| is_kmz(name));
        let within = names.take(MOST_WITHIN).filter_map(|name| {
            let files = ZipFiles::open(&outer.read(&name)?).ok()?;
            Some((name, files))
        });
        let within = within.collect();
        Ok(Self { outer, within })
    }
}

impl FileSet for KmzFiles {
    fn names(&self) -> Vec<String> {
        let mut names = self.outer.names();
        for (kmz, files) in &self.within {
            names.extend(files.names().iter().map(|name| format!("{kmz}/{name}")));
        }
        names
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.outer.read(name).or_else(|| {
            let mut within = self.within.iter();
            within.find_map(|(kmz, files)| {
                files.read(name.strip_prefix(kmz.as_str())?.strip_prefix('/')?)
            })
        })
    }
}

fn is_kmz(name: &str) -> bool {
    name.to_ascii_lowercase().ends_with(".kmz")
}

/// The document to which a link to a file among `names` leads: a KML itself, of a KMZ its main one.
pub(super) fn document_of(names: &[String], file: String) -> Option<String> {
    if file.to_ascii_lowercase().ends_with(".kml") {
        return Some(file);
    }
    let inner = names
        .iter()
        .filter_map(|name| name.strip_prefix(&file)?.strip_prefix('/'));
    let inner: Vec<String> = inner.map(str::to_owned).collect();
    Some(format!(
        "{file}/{}",
        main_document(&inner).filter(|_| is_kmz(&file))?
    ))
}
