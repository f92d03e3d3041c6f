//! `cargo xtask test`: every check, from the quick ones to the slow ones.
//!
//! A failing check does not stop the others; the last line counts them.

mod browser;
mod changed;
mod cores;
mod documented;
mod extension;
mod fingerprint;
mod install;
mod linted;
mod native;
mod oracles;
mod passed;
mod policy;
mod program;
mod programs;
mod python;
mod table;

use std::{path::Path, process::ExitCode, thread::JoinHandle};

use crate::{
    built,
    failure::Failure,
    page::{self, Profile},
    places,
    process::is_automatic,
};
pub use changed::{Reach, reach};
use native::{Extent, Packages};
pub use native::{format_all, store_first_seconds};
use program::CheckProgram;
use table::Table;

/// Choice of the checks that are run, and of the packages that they are run on.
#[derive(Debug)]
pub struct CheckChoice {
    /// Without documentation, oracles and browser.
    pub quick: bool,
    /// Only checks with this word in their name.
    pub only: Option<String>,
    /// Questions over many seeds are asked in full.
    pub studies: bool,
    /// Only what a change can reach.
    pub reach: Option<Reach>,
}

/// Checks of the page that was built.
const SIZES: &str = "sizes of the page";
const JOURNEYS: &str = "journeys through the page";

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

/// Checks of lines of their own that ran among the native tests.
#[derive(Default)]
struct Ran {
    /// Outcome of those that ask other people's programs, if they did.
    oracles: Option<Result<(), Failure>>,
    /// Outcome of the tests of the package for Python, if they were run.
    package: Option<Result<(), Failure>>,
    /// Whether the demo was flown.
    demo: bool,
}

impl Ran {
    /// Runs the native tests. Those of a full run ask other people's programs; the package for Python is tested and the
    /// demo flown for the journeys among them: none keeps more than one core busy.
    fn tests(
        &mut self,
        packages: &Packages,
        choice: &CheckChoice,
        page: bool,
    ) -> Result<(), Failure> {
        let is_full = !choice.quick && choice.only.is_none();
        let python = (is_full && packages.hold("pilotage-tests")).then(oracles::interpreter);
        let python = python.and_then(Result::ok);
        let flies = is_full && page && packages.hold("pilotage-cli");
        let package = python
            .as_deref()
            .filter(|_| packages.hold(extension::PACKAGE));
        let beside = |told: &str| {
            let Some(terminal) = program::terminal(told) else {
                return Vec::new();
            };
            // Where it cannot be built its own check tries again, and tells why.
            let package =
                package.and_then(|python| python::tests(&terminal.executable, python).ok());
            let demo = flies.then(|| CheckProgram {
                arguments: browser::words_for_demo(),
                ..terminal
            });
            demo.into_iter().chain(package).collect()
        };
        let asked = python.as_deref().map(Path::to_string_lossy);
        let extent = Extent {
            studies: choice.studies,
            quick: choice.quick,
            python: asked.as_deref(),
            beside: &beside,
        };
        let outcomes = native::tests(packages, &extent)?;
        let tested = outcomes
            .judge(|one| !python::are_tests(one) && (python.is_none() || !one.asks_oracles()));
        self.demo = outcomes.has_passed(|one| !one.arguments.is_empty() && !python::are_tests(one));
        self.package = outcomes.judged(python::are_tests);
        self.oracles = python.and_then(|_| outcomes.judged(CheckProgram::asks_oracles));
        if choice.quick {
            return tested;
        }
        tested.and(native::examples(packages))
    }
}

/// Runs the checks and prints the table.
pub fn run(choice: &CheckChoice) -> Result<ExitCode, Failure> {
    let mut table = Table::new(choice.only.clone());
    let packages = Packages::of(choice.reach.as_ref());
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
    if !packages.are_not_linted() {
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
    if let Some(fetched) = fetched {
        // What it failed at is tried again by the check that needs it, which tells why.
        let _ = fetched.join();
    }
    let mut ran = Ran::default();
    if !packages.are_none() {
        table.check("tests, native", || {
            ran.tests(&packages, choice, page_is_reached)
        });
    }
    if !choice.quick {
        if !packages.are_none() {
            table.check("documentation", || native::documentation(&packages));
        }
        if packages.hold("pilotage-tests") {
            table.check("oracles", || {
                ran.oracles.take().unwrap_or_else(oracles::check)
            });
        }
        if packages.hold(extension::PACKAGE) {
            table.check("package for Python", || {
                ran.package.take().unwrap_or_else(python::check)
            });
        }
    }
    if !choice.quick && page_is_reached {
        let page = built::page_under_test();
        let tags = choice.reach.as_ref().and_then(|reach| reach.tags.clone());
        // What looks at the page looks at that of today, also where only it was asked for.
        let is_asked = ["page", SIZES, JOURNEYS].map(|name| table.asks_for(name));
        let is_built =
            is_asked.contains(&true) && table.run("page", || page::build(Profile::Quick, &page));
        if is_built {
            let quick = Profile::Quick;
            table.check(SIZES, || page::check_sizes(quick, &page));
            table.check(JOURNEYS, || {
                browser::check(&page, tags.as_deref(), ran.demo)
            });
        } else if table.asks_for(JOURNEYS) {
            table.blocked(JOURNEYS, "there is no page to walk through");
        }
    }
    if table.is_empty() {
        return Err(Failure::Usage(
            "no check has that word in its name".to_owned(),
        ));
    }
    if !places::recorded_data().is_dir() {
        table.note(
            "the recorded data are not there (shared/data beside the repository): tests of recorded flights, maps of \
            other dates and other programs' vectors did nothing",
        );
    }
    Ok(table.finish())
}
