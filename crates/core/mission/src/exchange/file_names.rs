//! Names of files that are written beside each other.

use std::collections::BTreeSet;

/// Names that differ, also where capitals do not count, as for files: one that is there already has a number behind it.
///
/// ```
/// use pilotage_mission::exchange::told_apart;
///
/// let names = ["Mill", "mill", "Barn", "Mill"].map(str::to_owned);
/// assert_eq!(told_apart(names), ["Mill", "mill-2", "Barn", "Mill-3"]);
/// ```
pub fn told_apart(names: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let mut other = |name: String| {
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let mut all = std::iter::once(name.clone()).chain(numbered);
        let free = all.find(|name| taken.insert(name.to_lowercase()));
        free.unwrap_or(name)
    };
    names.into_iter().map(&mut other).collect()
}
