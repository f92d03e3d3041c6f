//! Folders of the disk as file sets.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use pilotage_core::flight::files::{FileSet, FileSink};
use pilotage_core::imagery::ByteSource;

/// A file of the disk, read by pieces.
pub struct DiskFile {
    name: String,
    length: u64,
    file: Mutex<File>,
}

impl DiskFile {
    /// Opens the file at `path`; messages call it `name`.
    ///
    /// ```
    /// use pilotage_core::imagery::ByteSource;
    /// use pilotage_disk::files::DiskFile;
    ///
    /// let path = std::env::temp_dir().join(format!("pilotage-pieces-{}", std::process::id()));
    /// std::fs::write(&path, "0123456789")?;
    /// let file = DiskFile::open(&path, "digits")?;
    /// assert_eq!((file.length(), file.read(3, 4)?), (10, b"3456".to_vec()));
    /// assert!(file.read(8, 4).is_err()); // two bytes are left
    /// std::fs::remove_file(&path)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn open(path: &Path, name: &str) -> std::io::Result<Self> {
        let file = File::open(path)?;
        Ok(Self {
            name: name.to_owned(),
            length: file.metadata()?.len(),
            file: Mutex::new(file),
        })
    }
}

impl ByteSource for DiskFile {
    fn name(&self) -> &str {
        &self.name
    }

    fn length(&self) -> u64 {
        self.length
    }

    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let mut bytes = vec![0; length];
        file.seek(SeekFrom::Start(offset))
            .and_then(|_| file.read_exact(&mut bytes))
            .map_err(|e| e.to_string())?;
        Ok(bytes)
    }
}

/// The files of a directory and its sub-directories.
pub struct DirectoryFiles {
    root: PathBuf,
    names: Vec<String>,
}

impl DirectoryFiles {
    /// The folder in which `file` lies, without a list of what else is there: what lies beside a
    /// file is asked for by name.
    pub fn around(file: &Path) -> Result<Self, String> {
        if !file.is_file() {
            return Err(format!("{}: there is no such file", file.display()));
        }
        Ok(Self {
            root: file.parent().unwrap_or(file).to_owned(),
            names: Vec::new(),
        })
    }

    /// The files of the whole disk, without a list of them, by paths as people write them.
    pub fn anywhere() -> Self {
        Self {
            root: PathBuf::new(),
            names: Vec::new(),
        }
    }

    /// Lists the files below `root`; a file stands for the directory it lies in.
    ///
    /// ```
    /// use pilotage_core::flight::files::FileSet;
    /// use pilotage_disk::files::DirectoryFiles;
    ///
    /// let folder = std::env::temp_dir().join(format!("pilotage-folder-{}", std::process::id()));
    /// std::fs::create_dir_all(folder.join("maps"))?;
    /// std::fs::write(folder.join("flight.json"), "{}")?;
    /// std::fs::write(folder.join("maps/town.png"), "a picture")?;
    /// // A file stands for its folder.
    /// let files = DirectoryFiles::open(&folder.join("flight.json"))?;
    /// assert_eq!(files.names(), ["flight.json", "maps/town.png"]);
    /// assert_eq!(files.read("maps/town.png").as_deref(), Some(&b"a picture"[..]));
    /// std::fs::remove_dir_all(&folder)?;
    /// # Ok::<(), std::io::Error>(())
    /// ```
    pub fn open(root: &Path) -> std::io::Result<Self> {
        let root = if root.is_file() {
            root.parent().unwrap_or(root)
        } else {
            root
        };
        let mut names = BTreeSet::new();
        list(root, "", &mut names)?;
        Ok(Self {
            root: root.to_owned(),
            names: names.into_iter().collect(),
        })
    }

    /// Lists the files in `folder`, without those of folders in it.
    ///
    /// # Errors
    /// A folder that cannot be listed.
    pub fn in_folder(folder: &Path) -> std::io::Result<Self> {
        let mut names = BTreeSet::new();
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            if entry.path().is_file() {
                names.insert(entry.file_name().to_string_lossy().into_owned());
            }
        }
        Ok(Self {
            root: folder.to_owned(),
            names: names.into_iter().collect(),
        })
    }

    /// Path of the file of that name.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.root.join(name)
    }
}

fn list(directory: &Path, prefix: &str, names: &mut BTreeSet<String>) -> std::io::Result<()> {
    for entry in fs::read_dir(directory)? {
        let entry = entry?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            list(&entry.path(), &format!("{name}/"), names)?;
        } else {
            names.insert(name);
        }
    }
    Ok(())
}

impl FileSet for DirectoryFiles {
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.root.join(name)).ok()
    }

    fn source(&self, name: &str) -> Option<Arc<dyn ByteSource>> {
        let file = DiskFile::open(&self.root.join(name), name).ok()?;
        Some(Arc::new(file))
    }
}

impl FileSink for DirectoryFiles {
    fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let path = self.root.join(name);
        let parent = path.parent().unwrap_or(&self.root);
        fs::create_dir_all(parent).map_err(|e| format!("{}: {e}", parent.display()))?;
        write_whole(&path, bytes)
    }
}

/// Writes a file whole or not at all.
///
/// ```
/// use pilotage_disk::files::write_whole;
///
/// let file = std::env::temp_dir().join(format!("pilotage-whole-{}", std::process::id()));
/// write_whole(&file, "first")?;
/// write_whole(&file, "second")?;
/// assert_eq!(std::fs::read_to_string(&file).ok().as_deref(), Some("second"));
/// std::fs::remove_file(&file).ok();
/// # Ok::<(), String>(())
/// ```
///
/// It is written beside the old one, whose place it then takes.
pub fn write_whole(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    let blame = |e: std::io::Error| format!("{}: {e}", path.display());
    // What is no plain file, such as /dev/stdout, cannot be replaced.
    if fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        return fs::write(path, bytes).map_err(blame);
    }
    let fresh = unfinished_beside(path);
    let write = || {
        let mut file = File::create(&fresh)?;
        file.write_all(bytes.as_ref())?;
        file.sync_all()?;
        fs::rename(&fresh, path)
    };
    write().map_err(|e| {
        fs::remove_file(&fresh).ok();
        blame(e)
    })
}

/// Name for what is not whole yet of the file at `path`, beside it: another at each call, for any number of programs may
/// write the same file, and those in containers have the same process number.
///
/// ```
/// use std::path::Path;
///
/// use pilotage_disk::files::unfinished_beside;
///
/// let file = Path::new("out/rows.parquet");
/// let fresh = unfinished_beside(file);
/// assert_eq!(fresh.parent(), file.parent());
/// assert!(fresh != unfinished_beside(file));
/// ```
pub fn unfinished_beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let chance = RandomState::new().build_hasher().finish();
    path.with_file_name(format!(".{name}.{chance:016x}.unfinished"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn writers_of_one_file_with_one_process_number_do_not_disturb_each_other() {
        let folder = std::env::temp_dir().join(format!("pilotage-writers-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("the folder can be made");
        let path = folder.join("shard");
        let written: Vec<Result<(), String>> = std::thread::scope(|scope| {
            let write = || (0..40).try_for_each(|_| write_whole(&path, vec![7; 100_000]));
            let writers: Vec<_> = (0..6).map(|_| scope.spawn(write)).collect();
            let ended = writers.into_iter().map(|it| it.join().expect("it ends"));
            ended.collect()
        });
        assert_eq!(written, vec![Ok(()); 6]);
        assert_eq!(fs::read(&path).expect("it is there"), vec![7; 100_000]);
        assert_eq!(fs::read_dir(&folder).expect("it is there").count(), 1);
        fs::remove_dir_all(&folder).ok();
    }
}
