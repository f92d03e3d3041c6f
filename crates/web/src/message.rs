//! Messages of the page to a worker; `crates/worker` takes them apart.

use js_sys::{Array, Object, Reflect, Uint8Array};
use pilotage_jobs::{FileContent, Job, ProvideOrder, Request};
use wasm_bindgen::prelude::*;

use crate::lent;

/// Makes the message for a request. Files travel beside the rest as byte arrays, because encoding
/// megabytes would hold up the page, and large ones as something to read them from.
pub fn encode(request: &Request) -> Result<JsValue, JsError> {
    if let Request::Start(_, Job::Provide(ProvideOrder { key, files })) = request {
        let (paths, contents) = (Array::new(), Array::new());
        // Numbers of lent files; zero for others.
        let numbers = Array::new();
        for (path, content) in files {
            paths.push(&path.into());
            let (number, content) = match content {
                FileContent::Bytes(bytes) => (0, Uint8Array::from(&**bytes).into()),
                FileContent::Lent { number, .. } => (*number, lent::file(*number)),
                FileContent::Address(address) => (0, address.into()),
            };
            contents.push(&content);
            numbers.push(&number.into());
        }
        let message = Object::new();
        for (name, value) in [
            ("provide", JsValue::from(key.as_str())),
            ("paths", paths.into()),
            ("contents", contents.into()),
            ("numbers", numbers.into()),
        ] {
            Reflect::set(&message, &name.into(), &value)
                .map_err(|_| JsError::new("cannot build a message"))?;
        }
        return Ok(message.into());
    }
    Ok(Uint8Array::from(request.to_bytes()?.as_slice()).into())
}
