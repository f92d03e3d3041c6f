//! The page and its workers: the only crate that knows the browser.
//!
//! The page and every worker are instances of this one module. `www/main.js` makes a `WebHandle`
//! on the page; `www/worker.js` makes a `WorkerHandle` in each worker.
#![cfg(target_arch = "wasm32")]

mod accessibility;
mod app;
mod browser;
mod frame_times;
mod handle;
mod host;
mod port;
mod worker;

pub use handle::WebHandle;
pub use worker::WorkerHandle;
