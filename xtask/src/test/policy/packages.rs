//! The packages that the lock file names, for all platforms together.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::{failure::Failure, metadata};

/// Data about a package that the rules ask for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Package {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its licence expression, if it states one.
    pub license: Option<String>,
    /// Source that it comes from; `None` for packages of this repository.
    pub source: Option<String>,
    /// Libraries that a package of this repository asks for in any version.
    pub any_version: Vec<String>,
}

/// Every package of the dependency graph.
pub fn all() -> Result<Vec<Package>, Failure> {
    Ok(metadata::packages(true)?.iter().map(package).collect())
}

fn package(entry: &Value) -> Package {
    let text = |value: &Value| value.as_str().map(str::to_owned);
    let source = text(&entry["source"]);
    let wildcards = entry["dependencies"]
        .as_array()
        .into_iter()
        .flatten()
        .filter(|dependency| {
            dependency["req"] == "*" && dependency["path"].is_null() && source.is_none()
        });
    Package {
        name: text(&entry["name"]).unwrap_or_default(),
        version: text(&entry["version"]).unwrap_or_default(),
        license: text(&entry["license"]),
        any_version: wildcards
            .filter_map(|dependency| text(&dependency["name"]))
            .collect(),
        source,
    }
}

/// `name 1.0 2.0` for every library that is there more than once.
pub fn in_several_versions(packages: &[Package]) -> Vec<String> {
    let mut versions: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for package in packages {
        versions
            .entry(&package.name)
            .or_default()
            .push(&package.version);
    }
    versions
        .iter()
        .filter(|(_, versions)| versions.len() > 1)
        .map(|(name, versions)| format!("{name} {}", versions.join(" ")))
        .collect()
}
