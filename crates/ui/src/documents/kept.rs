//! Opened files in the browser's storage, so that a session over them survives a reload: each file
//! under a key of its own, and one list of their paths, written last, so that a set is whole or none.

use crate::host::Host;

/// Most bytes of one set of files that are kept between visits.
pub const MOST_KEPT: usize = 64 << 20;

/// Key of the list of paths of a set of files.
pub fn list_key(set: &str) -> String {
    format!("files of {set}")
}

/// Key of one file of a set.
pub fn file_key(set: &str, number: usize) -> String {
    format!("file {number} of {set}")
}

/// The list of paths as bytes.
pub fn encode_list(paths: &[String]) -> Vec<u8> {
    postcard::to_extend(paths, vec![1]).unwrap_or_default()
}

/// Paths and bytes of a set that an earlier visit kept; `None` unless all of it is there.
pub fn recall_files(host: &dyn Host, set: &str) -> Option<Vec<(String, Vec<u8>)>> {
    let list = host.recall(&list_key(set))?;
    let paths: Vec<String> = postcard::from_bytes(list.strip_prefix(&[1])?).ok()?;
    let file = |(number, path)| Some((path, host.recall(&file_key(set, number))?));
    paths.into_iter().enumerate().map(file).collect()
}
