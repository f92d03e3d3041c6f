//! What the page posts to a worker; `crates/worker` takes it apart.

use js_sys::{Array, Object, Reflect, Uint8Array};
use pilotage_ui::jobs::{Job, Request};
use wasm_bindgen::prelude::*;

/// Makes the message for a request. Files travel as byte arrays beside the rest, because encoding
/// megabytes would hold up the page.
pub fn encode(request: Request) -> Result<JsValue, JsError> {
    if let Request::Start(_, Job::Provide { key, files }) = request {
        let (paths, contents) = (Array::new(), Array::new());
        for (path, bytes) in files {
            paths.push(&path.into());
            contents.push(&Uint8Array::from(bytes.as_slice()));
        }
        let message = Object::new();
        for (name, value) in [
            ("provide", JsValue::from(key)),
            ("paths", paths.into()),
            ("contents", contents.into()),
        ] {
            Reflect::set(&message, &name.into(), &value)
                .map_err(|_| JsError::new("cannot build a message"))?;
        }
        return Ok(message.into());
    }
    Ok(Uint8Array::from(postcard::to_stdvec(&request)?.as_slice()).into())
}
