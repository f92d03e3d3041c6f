//! Files by their content.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use serde::{Deserialize, Serialize};

/// A file that work depends on, by its content: another map under the same name is another work, and the same one in another
/// place is the same.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NamedFile {
    name: String,
    bytes: u64,
    crc32: u32,
}

impl NamedFile {
    /// The file at `path`.
    ///
    /// # Errors
    /// Where it cannot be read, in words.
    pub fn at(path: &Path) -> Result<Self, String> {
        let blame = |why: std::io::Error| format!("{}: {why}", path.display());
        let mut file = File::open(path).map_err(blame)?;
        let (mut sum, mut bytes) = (crc32fast::Hasher::new(), 0);
        let mut part = vec![0; 1 << 20];
        loop {
            let count = file.read(&mut part).map_err(blame)?;
            if count == 0 {
                break;
            }
            sum.update(&part[..count]);
            bytes += count as u64;
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Ok(Self {
            name: name.into_owned(),
            bytes,
            crc32: sum.finalize(),
        })
    }

    /// The file of that name and content.
    pub fn of(name: &str, content: &[u8]) -> Self {
        Self {
            name: name.to_owned(),
            bytes: content.len() as u64,
            crc32: crc32fast::hash(content),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_known_by_its_content_wherever_it_lies() {
        let folder = std::env::temp_dir().join(format!("pilotage-named-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("the folder can be made");
        let path = folder.join("map.pgw");
        std::fs::write(&path, "123456789").expect("it is written");
        let found = NamedFile::at(&path).expect("it is read");
        assert_eq!(found, NamedFile::of("map.pgw", b"123456789"));
        // The check value of CRC-32.
        assert_eq!((found.bytes, found.crc32), (9, 0xCBF4_3926));
        assert!(NamedFile::at(&folder.join("map.prj")).is_err());
        std::fs::remove_dir_all(&folder).ok();
    }
}
