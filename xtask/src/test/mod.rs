//! `cargo xtask test`: every check, from the quick ones to the slow ones.
//!
//! A failing check does not stop the others; the last line counts them.

mod browser;
mod install;
mod native;
mod oracles;
mod policy;
mod table;

use std::process::ExitCode;

use crate::{
    failure::Failure,
    page::{self, Profile},
    places,
};
use table::Table;

/// Runs the checks and prints the table. `quick` leaves out documentation, oracles and browser,
/// `only` everything without that word in its name.
pub fn run(quick: bool, only: Option<String>) -> Result<ExitCode, Failure> {
    let mut table = Table::new(only);
    table.check("format", native::format);
    table.check("dependencies: licences, bans, sources", policy::check);
    table.check("house rules", native::house_rules);
    table.check("lints, native", native::lints);
    table.check("lints, page", native::page_lints);
    table.check("tests of the build program", native::build_program);
    table.check("tests, native", native::tests);
    if !quick {
        table.check("documentation", native::documentation);
        table.check("oracles", oracles::check);
        let page = places::page_under_test();
        let is_built = table.check("page", || page::build(Profile::Quick, &page));
        if is_built {
            table.check("journeys through the page", || browser::check(&page));
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
