//! Weight of a program by crate, from its code and the names in it.

use std::{collections::BTreeMap, fs, path::Path};

use super::functions::Functions;
use crate::failure::Failure;

/// Bytes of code by crate in the module at `place` (with its names), the heaviest first. Code made from a
/// generic function counts for the crate that wrote the function.
pub fn by_crate(place: &Path) -> Result<Vec<(String, u64)>, Failure> {
    let module = fs::read(place).map_err(Failure::file(place))?;
    of_module(&module).map_err(|reason| Failure::Content {
        path: place.to_owned(),
        reason,
    })
}

fn of_module(module: &[u8]) -> Result<Vec<(String, u64)>, String> {
    let mut sums: BTreeMap<String, u64> = BTreeMap::new();
    for (name, body) in Functions::of(module)?.own() {
        *sums.entry(crate_of(&name)).or_default() += body.len() as u64;
    }
    let mut sums: Vec<_> = sums.into_iter().collect();
    sums.sort_by(|one, other| other.1.cmp(&one.1).then(one.0.cmp(&other.0)));
    Ok(sums)
}

/// The crate that a function comes from: `egui` of `egui::context::Context::run`.
fn crate_of(name: &str) -> String {
    let end = name.find(|c: char| !(c.is_alphanumeric() || c == '_'));
    match end {
        Some(end) if end > 0 && name[end..].starts_with("::") => name[..end].to_owned(),
        _ => "(no crate)".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::functions::made;

    #[test]
    fn code_is_summed_by_the_crate_that_wrote_it() {
        assert_eq!(
            of_module(&made::module()),
            Ok(vec![("egui".to_owned(), 10)])
        );
    }

    #[test]
    fn a_crate_is_read_from_the_names_of_functions() {
        assert_eq!(crate_of("core::fmt::write"), "core");
        assert_eq!(crate_of("__wbindgen_malloc"), "(no crate)");
    }
}
