//! `cargo xtask test`: every check, from the quick ones to the slow ones.
//!
//! A failing check does not stop the others; the last line counts them.

mod browser;
mod changed;
mod documented;
mod fingerprint;
mod install;
mod linted;
mod native;
mod oracles;
mod passed;
mod policy;
mod program;
mod programs;
mod table;

use std::{process::ExitCode, thread::JoinHandle};

use crate::{
    failure::Failure,
    page::{self, Profile},
    places,
    process::is_automatic,
};
pub use changed::{Reach, reach};
pub use native::store_first_seconds;
use table::Table;

/// Choice of the checks that are run, and of the packages that they are run on.
#[derive(Debug)]
pub struct Choice {
    /// Without documentation, oracles and browser.
    pub quick: bool,
    /// Only checks with this word in their name.
    pub only: Option<String>,
    /// Questions over many seeds are asked in full.
    pub studies: bool,
    /// Only what a change can reach.
    pub reach: Option<Reach>,
}

/// Brings what later checks need of other places, beside those that compute.
fn fetch(oracles: bool, browser: bool) -> JoinHandle<()> {
    std::thread::spawn(move || {
        if browser {
            let _ = browser::prepare();
        }
        if oracles {
            let _ = oracles::interpreter();
        }
    })
}

/// Runs the checks and prints the table.
pub fn run(choice: &Choice) -> Result<ExitCode, Failure> {
    let mut table = Table::new(choice.only.clone());
    let packages = native::Packages::of(choice.reach.as_ref());
    let page_is_reached = choice.reach.as_ref().is_none_or(|reach| reach.page);
    let fetched = (!choice.quick && choice.only.is_none())
        .then(|| fetch(packages.hold("pilotage-tests"), page_is_reached));
    // Either kind of lint waits for one crate after the other, which leaves cores idle. Where nobody sits at the
    // terminal they are told by the compiler, which does not.
    let page_lints = (page_is_reached && choice.only.is_none() && !is_automatic())
        .then(|| std::thread::spawn(native::page_lints));
    table.check("format", native::format);
    table.check("dependencies: licences, bans, sources", policy::check);
    table.check("house rules", native::house_rules);
    if !packages.are_none() {
        table.check("lints, native", || native::lints(&packages));
    }
    if page_is_reached {
        table.check("lints, page", || match page_lints {
            Some(begun) => begun
                .join()
                .unwrap_or_else(|cause| std::panic::resume_unwind(cause)),
            None => native::page_lints(),
        });
    }
    table.check("tests of the build program", native::build_program);
    if !packages.are_none() {
        table.check("tests, native", || {
            native::tests(&packages, choice.studies, choice.quick)
        });
    }
    if !choice.quick {
        if !packages.are_none() {
            table.check("documentation", || native::documentation(&packages));
        }
        if let Some(fetched) = fetched {
            // What it failed at is tried again by the check that needs it, which tells why.
            let _ = fetched.join();
        }
        if packages.hold("pilotage-tests") {
            table.check("oracles", oracles::check);
        }
    }
    if !choice.quick && page_is_reached {
        let page = places::page_under_test();
        let tags = choice.reach.as_ref().and_then(|reach| reach.tags.clone());
        let is_built = table.check("page", || page::build(Profile::Quick, &page));
        if is_built {
            let quick = Profile::Quick;
            table.check("sizes of the page", || page::check_sizes(quick, &page));
            table.check("journeys through the page", || {
                browser::check(&page, tags.as_deref())
            });
        } else {
            table.blocked(
                "journeys through the page",
                "there is no page to walk through",
            );
        }
    }
    if table.is_empty() {
        return Err(Failure::Usage(
            "no check has that word in its name".to_owned(),
        ));
    }
    Ok(table.finish())
}
