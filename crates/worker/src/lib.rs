//! The page's workers: programs of their own, with the method and without a screen, so that the page
//! downloads and every worker holds only what it runs. The crates below this one are the programs, which
//! differ in what they can do and in nothing else.
//!
//! `www/worker.js` drives a `WorkerHandle` in each worker.
#![cfg(target_arch = "wasm32")]

mod address;
mod blob;
mod handle;

pub use handle::WorkerHandle;
