//! Data about the page that it needs to work without a network.
//!
//! The service worker `sw.js` keeps every file of one build. It is told which ones, relative to
//! itself, so that the page works under any path: `__BUILD_ID__` becomes a name for the content of
//! the whole page, `__FILES__` the list of its files. Quotes around the list are taken away.

use std::{fs, path::Path};

use serde_json::json;

use super::files;
use crate::failure::Failure;

const WORKER: &str = "sw.js";

/// Writes `build.json` and fills in `sw.js`, if the page has one.
pub fn stamp(dist: &Path) -> Result<(), Failure> {
    let mut whole = Fingerprint::default();
    let mut listed = Vec::new();
    for file in files::below(dist)? {
        let place = dist.join(&file);
        let content = fs::read(&place).map_err(Failure::file(&place))?;
        let address = files::address(&file);
        whole.add(address.as_bytes());
        whole.add(&content);
        let mut own = Fingerprint::default();
        own.add(&content);
        listed.push((address, content.len(), own.text()));
    }
    let build_id = whole.text();
    let addresses: Vec<_> = listed
        .iter()
        .map(|(address, ..)| address.as_str())
        .filter(|it| *it != WORKER)
        .collect();
    let worker = dist.join(WORKER);
    if worker.is_file() {
        let text = fs::read_to_string(&worker).map_err(Failure::file(&worker))?;
        fs::write(&worker, filled(&text, &build_id, &addresses)).map_err(Failure::file(&worker))?;
    }
    let files: Vec<_> = listed
        .iter()
        .map(|(path, bytes, hash)| json!({ "path": path, "bytes": bytes, "hash": hash }))
        .collect();
    let place = dist.join("build.json");
    let text = format!("{:#}\n", json!({ "build_id": build_id, "files": files }));
    fs::write(&place, text).map_err(Failure::file(&place))
}

/// The worker's text with the placeholders filled in.
fn filled(text: &str, build_id: &str, addresses: &[&str]) -> String {
    let list = json!(addresses).to_string();
    text.replace("\"__FILES__\"", &list)
        .replace("'__FILES__'", &list)
        .replace("__FILES__", &list)
        .replace("__BUILD_ID__", build_id)
}

/// FNV-1a of 64 bits: tells builds apart, and is the same everywhere. Not against an attacker.
struct Fingerprint(u64);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fingerprint {
    fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn text(&self) -> String {
        format!("{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worker_learns_its_build_and_its_files() {
        let text = "const BUILD = \"__BUILD_ID__\";\nconst FILES = __FILES__;\n";
        let wanted = "const BUILD = \"b1\";\nconst FILES = [\"index.html\",\"pkg/a.js\"];\n";
        assert_eq!(filled(text, "b1", &["index.html", "pkg/a.js"]), wanted);
        assert_eq!(filled("f('__FILES__')", "b1", &["a"]), "f([\"a\"])");
    }

    #[test]
    fn fingerprints_agree_with_the_published_vectors() {
        // From the reference list of FNV-1a, 64 bits.
        for (text, wanted) in [("", "cbf29ce484222325"), ("a", "af63dc4c8601ec8c")] {
            let mut fingerprint = Fingerprint::default();
            fingerprint.add(text.as_bytes());
            assert_eq!(fingerprint.text(), wanted);
        }
    }
}
