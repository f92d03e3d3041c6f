//! The shards of a folder: each is there whole or not at all, and the same to the bit whoever wrote it. Who is killed runs
//! the same command again, and any number of programs may work on one folder.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::files::write_whole;

/// File with which a folder is begun.
const BEGINNING: &str = "study.json";

/// Beginning of a folder, which all who work on it must have in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Begun<T> {
    /// Version of the program: another may do otherwise.
    program: String,
    #[serde(flatten)]
    of: T,
}

/// State of a folder, for other programs.
#[derive(Serialize)]
struct Description<'a> {
    name: &'a str,
    /// Number of things that the shards are made of: flights, or pieces of work on a map.
    flights: u64,
    runs_per_shard: u64,
    shards: u64,
    /// Numbers of the shards that are not there, of those that are needed as far as is known.
    missing: Vec<u64>,
    /// Whether the shards that are there are enough.
    is_complete: bool,
    /// Text of the file `study.json` with which the folder is begun, for who fills it with shards that others made.
    begun: &'a str,
}

/// Shards of a folder.
pub struct Shards {
    /// The folder.
    pub root: PathBuf,
    /// Number of them.
    pub count: u64,
    /// Ending of their files.
    ending: &'static str,
    /// Text of the file with which the folder is begun.
    begun: String,
}

impl Shards {
    /// The shards of a folder that all who work on it began with the same `of`; begun if it is not there, unless it is only
    /// looked at: then nothing is written, and a folder that is not there has no shards.
    ///
    /// # Errors
    /// A folder that was begun with something else, in words.
    pub fn open<T>(
        root: &Path,
        count: u64,
        ending: &'static str,
        of: T,
        only_looks: bool,
    ) -> Result<Self, String>
    where
        T: Clone + PartialEq + Serialize + DeserializeOwned,
    {
        if only_looks {
            return Self::look(root, count, ending, of);
        }
        let shards = root.join("shards");
        fs::create_dir_all(&shards).map_err(|why| format!("{}: {why}", shards.display()))?;
        let looked = Self::look(root, count, ending, of)?;
        let path = root.join(BEGINNING);
        if !path.exists() {
            write_whole(&path, &looked.begun)?;
        }
        Ok(looked)
    }

    fn look<T>(root: &Path, count: u64, ending: &'static str, of: T) -> Result<Self, String>
    where
        T: Clone + PartialEq + Serialize + DeserializeOwned,
    {
        let program = env!("CARGO_PKG_VERSION").to_owned();
        let begun = Begun { program, of };
        let path = root.join(BEGINNING);
        // Looked at first: whoever begins it at this moment writes shards after that file.
        let has_shards = has_files(&root.join("shards"), ending)?;
        let other = "give another folder with --out, or remove that folder";
        match fs::read_to_string(&path) {
            Ok(text) => {
                let there: Option<Begun<T>> = serde_json::from_str(&text).ok();
                if there.as_ref() != Some(&begun) {
                    return Err(format!(
                        "{} was begun with another plan, size of shards, file that it names or program; {other}",
                        root.display()
                    ));
                }
            }
            Err(why) if why.kind() != ErrorKind::NotFound => {
                return Err(format!("{}: {why}", path.display()));
            }
            // Nothing tells of what plan shards are that lie there without it.
            Err(_) if has_shards => {
                return Err(format!(
                    "{} has shards, and no study.json that says of what; {other}",
                    root.display()
                ));
            }
            Err(_) => {}
        }
        Ok(Self {
            root: root.to_owned(),
            count,
            ending,
            begun: serde_json::to_string_pretty(&begun).map_err(|why| why.to_string())?,
        })
    }

    fn path(&self, shard: u64) -> PathBuf {
        let name = format!("{shard:06}.{}", self.ending);
        self.root.join("shards").join(name)
    }

    /// Whether a shard is there.
    pub fn has(&self, shard: u64) -> bool {
        self.path(shard).is_file()
    }

    /// Keeps a shard.
    pub fn keep(&self, shard: u64, bytes: Vec<u8>) -> Result<(), String> {
        write_whole(&self.path(shard), bytes)
    }

    /// A shard as `read` reads it.
    ///
    /// # Errors
    /// Where it is not there or `read` says why it is none, with what to do.
    pub fn read<T>(
        &self,
        shard: u64,
        read: impl FnOnce(Vec<u8>) -> Result<T, String>,
    ) -> Result<T, String> {
        let path = self.path(shard);
        let bytes = fs::read(&path).map_err(|why| why.to_string());
        bytes.and_then(read).map_err(|why| {
            format!(
                "{}: {why}; remove it, and run the study again",
                path.display()
            )
        })
    }

    /// Numbers of those that are not there.
    fn missing(&self) -> impl Iterator<Item = u64> {
        (0..self.count).filter(|shard| !self.has(*shard))
    }

    /// Words on how many are missing, and what to do.
    pub fn lacking(&self) -> String {
        format!(
            "{} of {} shards are missing in {}; run the study without --merge, or the shares that are left",
            self.missing().count(),
            self.count,
            self.root.display()
        )
    }

    /// Whether all are there.
    pub fn are_all_there(&self) -> bool {
        self.missing().next().is_none()
    }

    /// Prints how far it is, as JSON, for other programs.
    pub fn describe(
        &self,
        name: &str,
        flights: u64,
        runs_per_shard: u64,
        is_complete: bool,
    ) -> Result<(), String> {
        let missing = self.missing().filter(|_| !is_complete);
        let description = Description {
            name,
            flights,
            runs_per_shard,
            shards: self.count,
            missing: missing.collect(),
            is_complete,
            begun: &self.begun,
        };
        let text = serde_json::to_string_pretty(&description).map_err(|why| why.to_string())?;
        println!("{text}");
        Ok(())
    }
}

/// Whether a folder is there and has files of that ending.
fn has_files(folder: &Path, ending: &str) -> Result<bool, String> {
    let told = |why: std::io::Error| format!("{}: {why}", folder.display());
    let entries = match fs::read_dir(folder) {
        Err(why) if why.kind() == ErrorKind::NotFound => return Ok(false),
        entries => entries.map_err(told)?,
    };
    for entry in entries {
        if entry.map_err(told)?.path().extension() == Some(ending.as_ref()) {
            return Ok(true);
        }
    }
    Ok(false)
}
