//! The page's workers: a program of its own, with the method and without a screen, so that the page
//! downloads and every worker holds only what it runs.
//!
//! `www/worker.js` makes a `WorkerHandle` in each worker.
#![cfg(target_arch = "wasm32")]

mod address;
mod blob;
mod handle;

pub use handle::WorkerHandle;
