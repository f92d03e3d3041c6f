//! Files that stay where they are, lent to a worker and read by pieces.

use std::collections::BTreeMap;
use std::sync::Arc;

use pilotage_core::imagery::{ByteSource, MemoryBytes};

use super::FileContent;

/// Opens the file at an address; the error says in words why it cannot be had.
pub type OpenAddress = Box<dyn Fn(&str) -> Result<Arc<dyn ByteSource>, String>>;

/// Files outside the program that are read by pieces.
#[derive(Default)]
pub struct LentFiles {
    /// The files that a shell lends, by number.
    pub files: BTreeMap<u32, Arc<dyn ByteSource>>,
    /// Opener of files of the web, where there is a way.
    pub web: Option<OpenAddress>,
}

/// A file under the name that it has among its like.
struct NamedFile {
    name: String,
    source: Arc<dyn ByteSource>,
}

impl ByteSource for NamedFile {
    fn name(&self) -> &str {
        &self.name
    }

    fn length(&self) -> u64 {
        self.source.length()
    }

    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        self.source.read(offset, length)
    }
}

impl FileContent {
    /// Something to read the file `name` from; the error says in words why there is none.
    pub(super) fn source(
        &self,
        name: &str,
        lent: &LentFiles,
    ) -> Result<Arc<dyn ByteSource>, String> {
        match self {
            Self::Bytes(bytes) => Ok(Arc::new(MemoryBytes::new(name, bytes.clone()))),
            Self::Address(address) => {
                let open = lent
                    .web
                    .as_ref()
                    .ok_or("files of the web are not read here")?;
                open(address)
            }
            Self::Lent { number, .. } => {
                let source = lent.files.get(number).cloned();
                let source = source.ok_or("the file is not here any more; open it again")?;
                Ok(Arc::new(NamedFile {
                    name: name.to_owned(),
                    source,
                }))
            }
        }
    }
}
