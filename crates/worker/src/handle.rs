//! The worker's end: a job runner behind messages.

use std::sync::Arc;

use js_sys::{Array, Function, Reflect, Uint8Array};
use pilotage_core::imagery::ByteSource;
use pilotage_jobs::{
    Abilities, FileContent, Job, JobRunner, OpenAddress, ProvideOrder, Reply, Request,
};
use wasm_bindgen::prelude::*;

use crate::address::AddressBytes;
use crate::blob::BlobBytes;

#[wasm_bindgen]
extern "C" {
    /// Milliseconds since the worker began, never going back.
    #[wasm_bindgen(js_namespace = performance, js_name = now)]
    fn now() -> f64;
}

/// Handle of a worker that `www/worker.js` drives: it passes messages in, calls [`WorkerHandle::turn`] as
/// long as that says there is more, and posts what comes out.
#[wasm_bindgen]
pub struct WorkerHandle {
    runner: JobRunner,
    post: Function,
    last_word: f64,
}

#[wasm_bindgen]
impl WorkerHandle {
    /// Takes a message of the page.
    pub fn receive(&mut self, message: &JsValue) -> Result<(), JsError> {
        let request = self.decode(message)?;
        let post = &self.post;
        self.runner.receive(request, &mut |reply| say(post, &reply));
        Ok(())
    }

    /// Works for a slice; true if there is more to do.
    pub fn turn(&mut self) -> bool {
        let post = &self.post;
        self.runner.turn(&now, &mut |reply| say(post, &reply));
        self.runner.busy()
    }

    /// Dies as a fault in the program would; for tests.
    ///
    /// # Panics
    ///
    /// Always: that is what it is for.
    pub fn crash(&self) {
        panic!("asked to crash after {:.0} ms", now() - self.last_word);
    }
}

impl WorkerHandle {
    /// A worker with these abilities that says things by calling `post` with a byte array that may be
    /// transferred.
    pub fn new(abilities: Abilities, post: Function) -> Self {
        console_error_panic_hook::set_once();
        Self {
            runner: JobRunner::new(abilities),
            post,
            last_word: now(),
        }
    }

    /// Has it read files of the web at their addresses.
    #[must_use]
    pub fn with_addresses(mut self) -> Self {
        let open: OpenAddress = Box::new(|address| {
            AddressBytes::open(address).map(|file| Arc::new(file) as Arc<dyn ByteSource>)
        });
        self.runner.state_mut().open_addresses_by(open);
        self
    }
}

fn say(post: &Function, reply: &Reply) {
    // A page that is gone hears nothing; there is nobody to tell.
    let _ = post.call1(
        &JsValue::NULL,
        &Uint8Array::from(reply.to_bytes().as_slice()),
    );
}

impl WorkerHandle {
    /// Takes a message of the page apart: bytes, or an object with files beside their key.
    fn decode(&mut self, message: &JsValue) -> Result<Request, JsError> {
        if let Some(bytes) = message.dyn_ref::<Uint8Array>() {
            return Ok(Request::from_bytes(&bytes.to_vec())?);
        }
        let field = |name: &str| {
            Reflect::get(message, &name.into())
                .map_err(|_| JsError::new("a message without its fields"))
        };
        let key = field("provide")?
            .as_string()
            .ok_or_else(|| JsError::new("a message of an unknown kind"))?;
        let (paths, contents, numbers) = (
            Array::from(&field("paths")?),
            Array::from(&field("contents")?),
            Array::from(&field("numbers")?),
        );
        let mut files = Vec::new();
        for ((path, content), number) in paths.iter().zip(contents.iter()).zip(numbers.iter()) {
            let content = match content.dyn_ref::<Uint8Array>() {
                Some(bytes) => bytes.to_vec().into(),
                None if content.is_string() => {
                    FileContent::Address(content.as_string().unwrap_or_default())
                }
                None => self.lend(&content, number.as_f64().unwrap_or_default() as u32),
            };
            files.push((path.as_string().unwrap_or_default(), content));
        }
        Ok(Request::Start(0, Job::Provide(ProvideOrder { key, files })))
    }

    /// Takes a file that the page lends.
    fn lend(&mut self, content: &JsValue, number: u32) -> FileContent {
        let mut length = 0;
        if content.is_object() {
            let source = Arc::new(BlobBytes::new(number, content.unchecked_ref()));
            length = source.length();
            self.runner.state_mut().lend(number, source);
        }
        FileContent::Lent { number, length }
    }
}
