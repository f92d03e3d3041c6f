//! The workers' program that does every job; `www/worker-whole.js` loads it.
#![cfg(target_arch = "wasm32")]

use js_sys::Function;
use pilotage_jobs::Abilities;
use pilotage_worker::WorkerHandle;
use wasm_bindgen::prelude::*;

/// A worker that says things by calling `post` with a byte array that may be transferred.
#[wasm_bindgen]
pub fn worker(post: Function) -> WorkerHandle {
    WorkerHandle::new(Abilities::WHOLE, post).with_addresses()
}
