//! Files that stay on the user's disk: the page holds the browser's handle of each and lends it to
//! the workers, which read pieces.

use std::cell::RefCell;

use pilotage_jobs::FileContent;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// A file of the browser, or a part of one.
    pub type Blob;

    /// Its length, bytes.
    #[wasm_bindgen(method, getter)]
    pub fn size(this: &Blob) -> f64;
}

thread_local! {
    static FILES: RefCell<Vec<JsValue>> = const { RefCell::new(Vec::new()) };
}

/// Keeps the handle of a file; what to hand to the app for it.
pub fn lend(file: &Blob) -> FileContent {
    let length = file.size() as u64;
    let handle: &JsValue = file.as_ref();
    FILES.with_borrow_mut(|files| {
        files.push(handle.clone());
        FileContent::Lent {
            number: files.len() as u32,
            length,
        }
    })
}

/// The handle lent under a number; `undefined` if there is none.
pub fn file(number: u32) -> JsValue {
    FILES.with_borrow(|files| {
        let at = (number as usize).wrapping_sub(1);
        files.get(at).cloned().unwrap_or(JsValue::UNDEFINED)
    })
}
