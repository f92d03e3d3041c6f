//! The sizes of the page, as it is stored and as it travels.

use std::{fs, path::Path};

use super::{
    compress::beside,
    files, machine_paths,
    profile::{PROGRAMS, Profile, module_name},
    wasm, weights,
};
use crate::{failure::Failure, places};

/// Crates that are printed of a program that is over its budget.
const MOST_CRATES: usize = 40;

/// Prints a table of the files of `dist`.
pub fn print(dist: &Path) -> Result<(), Failure> {
    println!(
        "{:<28}{:>12}{:>12}{:>12}",
        "file", "bytes", "gzip", "brotli"
    );
    let mut sums = [0; 3];
    for file in files::below(dist)? {
        let ending = file.extension().and_then(|ending| ending.to_str());
        if matches!(ending, Some("br" | "gz")) {
            continue;
        }
        let place = dist.join(&file);
        let raw = size(&place)?;
        let gzip = size(&beside(&place, "gz")).unwrap_or(raw);
        let brotli = size(&beside(&place, "br")).unwrap_or(raw);
        println!(
            "{:<28}{raw:>12}{gzip:>12}{brotli:>12}",
            files::address(&file)
        );
        for (sum, one) in sums.iter_mut().zip([raw, gzip, brotli]) {
            *sum += one;
        }
    }
    println!(
        "{:<28}{:>12}{:>12}{:>12}",
        "together", sums[0], sums[1], sums[2]
    );
    Ok(())
}

/// Fails if a program of `dist`, built in `profile`, is over its budget (`xtask/budgets.toml`), and prints then
/// which crates make it up; or if it has paths of this machine in it.
pub fn check(profile: Profile, dist: &Path) -> Result<(), Failure> {
    let file = places::root().join("xtask/budgets.toml");
    let text = fs::read_to_string(&file).map_err(Failure::file(&file))?;
    let budgets =
        budgets(&text, profile).map_err(|reason| Failure::Content { path: file, reason })?;
    let mut over = Vec::new();
    for (name, budget) in &budgets {
        let file = format!("{}_bg.wasm.br", module_name(name));
        let weight = size(&dist.join("pkg").join(file))?;
        println!("{name}: {weight} bytes with brotli, of {budget}");
        if weight <= *budget {
            continue;
        }
        over.push(format!(
            "{name} has {weight} bytes with brotli, over its budget of {budget}"
        ));
        println!("\n{name}, bytes of code by crate before compression:");
        for (of_crate, bytes) in weights::by_crate(&wasm::module(profile, name))?
            .iter()
            .take(MOST_CRATES)
        {
            println!("{bytes:>12}  {of_crate}");
        }
    }
    if over.is_empty() {
        return machine_paths::check(dist);
    }
    Err(Failure::Check(format!(
        "{}; look for what came in lately: a library, a font, code made for many types",
        over.join("; ")
    )))
}

/// The programs of `profile` and what each may weigh, bytes, or in words what is wrong with `text`.
fn budgets(text: &str, profile: Profile) -> Result<Vec<(String, u64)>, String> {
    let table: toml::Table = text.parse().map_err(|error| format!("{error}"))?;
    let own = table.get(profile.name()).and_then(toml::Value::as_table);
    let own = own.ok_or_else(|| format!("no budgets for the profile {}", profile.name()))?;
    PROGRAMS
        .into_iter()
        .map(|name| {
            let budget = own.get(name).and_then(toml::Value::as_integer);
            let budget = budget.and_then(|bytes| u64::try_from(bytes).ok());
            let budget = budget.ok_or_else(|| format!("no budget for {name}"))?;
            Ok((name.to_owned(), budget))
        })
        .collect()
}

fn size(place: &Path) -> Result<u64, Failure> {
    Ok(fs::metadata(place).map_err(Failure::file(place))?.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_program_has_a_budget_in_both_profiles() {
        let text = include_str!("../../budgets.toml");
        for profile in [Profile::Quick, Profile::Shipped] {
            let budgets = budgets(text, profile).unwrap();
            assert_eq!(budgets.len(), PROGRAMS.len());
            assert!(budgets.iter().all(|(_, bytes)| *bytes > 100_000));
        }
        assert!(budgets("[web]\npilotage_web = 1", Profile::Shipped).is_err());
        assert!(budgets("", Profile::Quick).is_err());
    }
}
