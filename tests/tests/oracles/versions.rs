//! The oracles are the pinned ones.

use std::collections::BTreeMap;

use pilotage_tests::{data::repository, oracle};

#[test]
fn the_oracles_have_the_pinned_versions() {
    let text = std::fs::read_to_string(repository().join("tests/oracles/requirements.txt"))
        .expect("the list of oracles is part of the repository");
    let pinned: BTreeMap<String, String> = text
        .lines()
        .filter(|line| !line.starts_with('#') && !line.is_empty())
        .map(|line| {
            line.split_once("==")
                .expect("every version is pinned with ==")
        })
        .map(|(name, version)| (name.to_owned(), version.to_owned()))
        .collect();
    let names: Vec<_> = pinned.keys().collect();
    let Some(installed) = oracle::ask::<_, BTreeMap<String, String>>("versions.py", &names) else {
        return;
    };
    assert_eq!(installed, pinned);
}
