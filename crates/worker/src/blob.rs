//! Files of the browser read by pieces, where they lie.

use std::cell::RefCell;
use std::collections::BTreeMap;

use js_sys::{ArrayBuffer, Uint8Array};
use pilotage_core::imagery::ByteSource;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// A file of the browser, or a part of one.
    #[derive(Clone)]
    pub type Blob;

    #[wasm_bindgen(method, getter)]
    fn size(this: &Blob) -> f64;

    #[wasm_bindgen(method)]
    fn slice(this: &Blob, start: f64, end: f64) -> Blob;

    /// Reads and waits, which only workers may.
    type FileReaderSync;

    #[wasm_bindgen(constructor)]
    fn new() -> FileReaderSync;

    #[wasm_bindgen(method, catch, js_name = readAsArrayBuffer)]
    fn read(this: &FileReaderSync, blob: &Blob) -> Result<ArrayBuffer, JsValue>;
}

thread_local! {
    /// Handles by number; they cannot leave the worker, numbers can.
    static BLOBS: RefCell<BTreeMap<u32, Blob>> = const { RefCell::new(BTreeMap::new()) };
}

/// A file of the browser.
pub struct BlobBytes {
    number: u32,
    length: u64,
}

impl BlobBytes {
    /// The file that the page lends under a number.
    pub fn new(number: u32, blob: &Blob) -> Self {
        BLOBS.with_borrow_mut(|blobs| blobs.insert(number, blob.clone()));
        Self {
            number,
            length: blob.size() as u64,
        }
    }
}

impl ByteSource for BlobBytes {
    fn name(&self) -> &'static str {
        "a file"
    }

    fn length(&self) -> u64 {
        self.length
    }

    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        let blob = BLOBS.with_borrow(|blobs| blobs.get(&self.number).cloned());
        let blob = blob.ok_or("the file is not here any more; open it again")?;
        let piece = blob.slice(offset as f64, offset as f64 + length as f64);
        let bytes = FileReaderSync::new().read(&piece).map_err(
            |_| "the browser cannot read it any more; it was changed or moved, open it again",
        )?;
        Ok(Uint8Array::new(&bytes).to_vec())
    }
}
