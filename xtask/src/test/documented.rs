//! Documentation that was made while compiling (`compiler.rs`).

use crate::{compiler::CompilerPass, failure::Failure, metadata};

/// Checks that everything that was compiled of the packages that `are_asked_for` is documented without a word.
pub fn check(are_asked_for: impl Fn(&str) -> bool) -> Result<(), Failure> {
    let mut wrong = Vec::new();
    for package in metadata::packages(false)? {
        if !package["name"].as_str().is_some_and(&are_asked_for) {
            continue;
        }
        let targets = package["targets"].as_array().into_iter().flatten();
        for target in targets.filter(|target| is_documented(&target["kind"])) {
            let name = target["name"]
                .as_str()
                .unwrap_or_default()
                .replace('-', "_");
            match CompilerPass::Documentation.said(&name) {
                Some(said) if said.is_empty() => {}
                Some(said) => {
                    eprintln!("{said}");
                    wrong.push(name);
                }
                None => wrong.push(format!("{name} (was not compiled)")),
            }
        }
    }
    if wrong.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!(
            "documentation of {}",
            wrong.join(", ")
        )))
    }
}

fn is_documented(kinds: &serde_json::Value) -> bool {
    let kinds = kinds.as_array().into_iter().flatten();
    let documented = ["lib", "rlib", "cdylib", "bin"];
    kinds
        .filter_map(|kind| kind.as_str())
        .any(|kind| documented.contains(&kind))
}
