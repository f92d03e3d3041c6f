//! The page: a folder of plain files made from the wasm crates, `index.html` and `www/`.
//!
//! Layout: `index.html` and the content of `www/` at the root, the programs of the page and of its
//! workers with their glue in `pkg/`,
//! beside each text and module a `.br` and a `.gz`, and `build.json` with what was built.

mod compress;
mod files;
mod functions;
mod machine_paths;
mod never_called;
mod offline;
mod profile;
mod references;
mod side_by_side;
mod sizes;
mod wasm;
mod weights;

use std::path::Path;

pub use profile::{PROGRAMS, Profile, TARGET};
pub use sizes::check as check_sizes;
pub use wasm::{compile, ensure_target, without_flags};

use side_by_side::side_by_side;

use crate::{failure::Failure, progress::step};

/// Builds the page into `dist`, replacing a page that is there.
pub fn build(profile: Profile, dist: &Path) -> Result<(), Failure> {
    files::refuse_others(dist)?;
    wasm::ensure_target()?;
    step(&format!("compiling the page ({})", profile.name()), || {
        wasm::compile(profile)
    })?;
    step("putting the page together", || {
        files::clear(dist)?;
        side_by_side(&PROGRAMS, |package| wasm::bind(profile, package, dist))?;
        files::copy_shell(dist)?;
        files::finish(dist)?;
        offline::stamp(dist)
    })?;
    step("compressing", || {
        compress::folder(dist, profile.brotli_quality())
    })
}

/// Builds the page for shipping and prints its sizes.
pub fn pack(dist: &Path) -> Result<(), Failure> {
    build(Profile::Shipped, dist)?;
    println!();
    sizes::print(dist)?;
    println!();
    sizes::check(Profile::Shipped, dist)?;
    println!(
        "\n{} can be put under any path of any file server.",
        dist.display()
    );
    Ok(())
}
