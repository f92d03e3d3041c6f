//! Opened files in the browser's storage, so that a session over them survives a reload: each file
//! under a key of its own, and one list of their paths, written last, so that a set is whole or none.

use crate::host::{Host, OpenedFile};
use crate::job_owners::JobOwner;
use pilotage_jobs::{FileContent, Job, ProvideOrder};

/// Most bytes of one set of files that are kept between visits.
pub const MOST_KEPT: u64 = 64 << 20;
/// The same for files that the browser copies by itself, without their passing through the page.
pub const MOST_LENT_KEPT: u64 = 1 << 30;

/// Key of the list of paths of a set of files.
pub fn list_key(set: &str) -> String {
    format!("files of {set}")
}

/// Key of one file of a set.
pub fn file_key(set: &str, number: usize) -> String {
    format!("file {number} of {set}")
}

/// Key of the address of a file of the web, in place of its contents.
pub fn address_key(file: &str) -> String {
    format!("address of {file}")
}

/// The list of paths as bytes.
pub fn encode_list(paths: &[String]) -> Vec<u8> {
    postcard::to_extend(paths, vec![1]).unwrap_or_default()
}

/// Paths and contents of a set that an earlier visit kept; unless all of it is there, how many
/// files it had.
pub fn recall_files(host: &dyn Host, set: &str) -> Result<Vec<(String, FileContent)>, usize> {
    let list = host.recall(&list_key(set)).unwrap_or_default();
    let paths = list.strip_prefix(&[1]).ok_or(0_usize)?;
    let paths: Vec<String> = postcard::from_bytes(paths).map_err(|_| 0_usize)?;
    let count = paths.len();
    let file = |(number, path)| {
        let key = file_key(set, number);
        let whole = || host.recall(&key).map(FileContent::from);
        let address = host.recall(&address_key(&key));
        let address = address.and_then(|bytes| String::from_utf8(bytes).ok());
        let lent = || host.recall_lent(&key);
        let content = address.map(FileContent::Address).or_else(lent);
        Some((path, content.or_else(whole)?))
    };
    let files: Option<_> = paths.into_iter().enumerate().map(file).collect();
    files.ok_or(count)
}

/// Gives the workers files under a key.
pub fn provide(host: &mut dyn Host, key: &str, files: &[OpenedFile]) {
    let files = files.iter();
    let order = ProvideOrder {
        key: key.to_owned(),
        files: files.map(|f| (f.path.clone(), f.content.clone())).collect(),
    };
    host.start(JobOwner::Files, Job::Provide(order));
}

/// Puts what people said of files beside them, in place of what they said before.
pub fn put_beside(files: &mut Vec<OpenedFile>, path: &str, said: Vec<u8>) {
    files.retain(|file| file.path != path);
    files.push(OpenedFile {
        path: path.to_owned(),
        content: said.into(),
    });
}
