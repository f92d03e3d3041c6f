//! Build, serve, pack and test, without a tool to install: `cargo xtask COMMAND`.

mod arguments;
mod built;
mod compiler;
mod failure;
mod metadata;
mod page;
mod page_form;
mod places;
mod process;
mod progress;
mod serve;
mod test;

use std::process::ExitCode;

use arguments::Arguments;
use failure::Failure;

const USAGE: &str = "\
cargo xtask serve [--port N] [--profile web-quick|web] [--no-build] [--dist FOLDER]
    builds the page and serves it on this machine (port 8080; 0 takes a free one)
cargo xtask dist [--dist FOLDER]
    packs the page into a folder that any file server can host, and prints its sizes
cargo xtask format
    formats every Rust file, also those that `cargo fmt` does not find because a table declares them
cargo xtask first-seconds
    stores anew what the page shows first, once the program computes something else
cargo xtask test [--quick] [--studies] [--changed] [--base REV] [--only WORD]
    runs every check; --quick leaves out the documentation with its examples, the oracles, the
    package for Python, the browser, the longest tests, and those that passed as they are;
    --only all but the checks that have WORD in their name, such as journeys;
    --changed checks what the changes since the last commit (or since REV) can reach;
    --studies asks over all seeds what the everyday run asks over a few";

fn main() -> ExitCode {
    if let Some(linter) = std::env::var_os(compiler::LINTER) {
        let arguments: Vec<_> = std::env::args_os().skip(1).collect();
        return compiler::compile(&linter, &arguments);
    }
    let arguments = std::env::args().skip(1);
    match run(Arguments::new(arguments)) {
        Ok(code) => code,
        Err(failure) => {
            eprintln!("xtask: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(mut arguments: Arguments) -> Result<ExitCode, Failure> {
    match arguments.command().as_deref() {
        Some("serve") => {
            let options = serve::Options::read(&mut arguments)?;
            arguments.finish()?;
            serve::build_and_serve(&options)?;
            Ok(ExitCode::SUCCESS)
        }
        Some("dist") => {
            let dist = arguments.folder("--dist")?.unwrap_or_else(places::dist);
            arguments.finish()?;
            page::pack(&dist)?;
            Ok(ExitCode::SUCCESS)
        }
        Some("test") => {
            let quick = arguments.flag("--quick");
            let only = arguments.value("--only")?;
            let studies = arguments.flag("--studies");
            let base = arguments.value("--base")?;
            let changed = arguments.flag("--changed") || base.is_some();
            arguments.finish()?;
            let reach = changed.then(|| test::reach(base.as_deref())).transpose()?;
            test::run(&test::CheckChoice {
                quick,
                only,
                studies,
                reach,
            })
        }
        Some("format") => {
            arguments.finish()?;
            test::format_all()?;
            Ok(ExitCode::SUCCESS)
        }
        Some("first-seconds") => {
            arguments.finish()?;
            let dist = built::page_under_test();
            page::build(page::Profile::Quick, &dist)?;
            test::store_first_seconds(&dist)?;
            Ok(ExitCode::SUCCESS)
        }
        Some("help" | "--help" | "-h") => {
            println!("{USAGE}");
            Ok(ExitCode::SUCCESS)
        }
        Some(other) => Err(Failure::Usage(format!("`{other}` is no command\n{USAGE}"))),
        None => Err(Failure::Usage(format!("which command?\n{USAGE}"))),
    }
}
