//! A folder in which the program is called, as a user calls it in theirs.

use std::path::PathBuf;
use std::process::{Command, Output};

/// A folder of one test, removed when the test is over.
pub struct Folder(pub PathBuf);

impl Folder {
    /// An empty folder; `name` tells it from those of other tests.
    pub fn new(name: &str) -> Self {
        let folder = format!("pilotage-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(folder);
        std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
        Self(folder)
    }

    /// Puts a file into the folder.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.0.join(name), bytes).expect("the folder can be written");
    }

    /// Calls the program with these words.
    pub fn call(&self, words: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_pilotage"))
            .current_dir(&self.0)
            .args(words)
            .output()
            .expect("the program starts")
    }

    /// The words of the program, or those with which it fails.
    pub fn run(&self, words: &[&str]) -> Result<String, String> {
        let output = self.call(words);
        let words = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        if output.status.success() {
            Ok(words(&output.stdout))
        } else {
            Err(words(&output.stderr))
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}
