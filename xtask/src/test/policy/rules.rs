//! The rules of `deny.toml` that do not need a network.

use spdx::{Expression, Licensee, ParseMode};
use toml::{Table, Value};

use super::packages::Package;

/// The rules, read.
#[derive(Debug)]
pub struct Rules {
    allowed: Vec<Licensee>,
    /// Further licences for single crates.
    exceptions: Vec<(String, Vec<Licensee>)>,
    banned: Vec<String>,
    registries: Vec<String>,
    repositories: Vec<String>,
}

impl Rules {
    /// Reads the text of `deny.toml`; the error says what is wrong with it.
    pub fn read(text: &str) -> Result<Self, String> {
        let table: Table = text
            .parse()
            .map_err(|error: toml::de::Error| error.to_string())?;
        let list = |section: &str, key: &str| {
            let entries = table
                .get(section)
                .and_then(|it| it.get(key))
                .and_then(Value::as_array);
            entries.cloned().unwrap_or_default()
        };
        let exceptions = list("licenses", "exceptions");
        let exceptions = exceptions.iter().map(|entry| {
            let licences = entry.get("allow").and_then(Value::as_array).cloned();
            Ok((
                crate_name(entry)?,
                licensees(&licences.unwrap_or_default())?,
            ))
        });
        Ok(Self {
            allowed: licensees(&list("licenses", "allow"))?,
            exceptions: exceptions.collect::<Result<_, String>>()?,
            banned: list("bans", "deny")
                .iter()
                .map(crate_name)
                .collect::<Result<_, _>>()?,
            registries: texts(&list("sources", "allow-registry"))?,
            repositories: texts(&list("sources", "allow-git"))?,
        })
    }

    /// Complaints about `package`, in words.
    pub fn complaints(&self, package: &Package) -> Vec<String> {
        let problems = [self.licence_problem(package), self.source_problem(package)];
        let wildcards = package
            .any_version
            .iter()
            .map(|name| format!("asks for `{name}` in any version: state one"));
        let ban = self
            .banned
            .contains(&package.name)
            .then(|| "is banned by deny.toml".to_owned());
        problems
            .into_iter()
            .flatten()
            .chain(ban)
            .chain(wildcards)
            .map(|problem| format!("{} {}: {problem}", package.name, package.version))
            .collect()
    }

    fn licence_problem(&self, package: &Package) -> Option<String> {
        let Some(stated) = &package.license else {
            return Some("states no licence".to_owned());
        };
        let expression = match Expression::parse_mode(stated, ParseMode::LAX) {
            Ok(expression) => expression,
            Err(error) => {
                return Some(format!(
                    "`{stated}` is no licence expression: {}",
                    error.reason
                ));
            }
        };
        let own = self
            .exceptions
            .iter()
            .filter(|(name, _)| *name == package.name);
        let own: Vec<_> = own.flat_map(|(_, licences)| licences).collect();
        let is_allowed = expression.evaluate(|requirement| {
            self.allowed
                .iter()
                .chain(own.iter().copied())
                .any(|licence| licence.satisfies(requirement))
        });
        (!is_allowed).then(|| format!("`{stated}` is not among the licences of deny.toml"))
    }

    fn source_problem(&self, package: &Package) -> Option<String> {
        let source = package.source.as_deref()?;
        let (kind, address) = source.split_once('+').unwrap_or(("", source));
        let address = address.split(['?', '#']).next().unwrap_or(address);
        let known = match kind {
            "registry" | "sparse" => &self.registries,
            "git" => &self.repositories,
            _ => return Some(format!("comes from {source}, which is no registry")),
        };
        let is_known = known.iter().any(|one| one == address);
        (!is_known).then(|| format!("comes from {source}, which deny.toml does not know"))
    }
}

fn texts(entries: &[Value]) -> Result<Vec<String>, String> {
    let text = |entry: &Value| {
        entry
            .as_str()
            .map(str::to_owned)
            .ok_or_else(|| format!("`{entry}` should be a text"))
    };
    entries.iter().map(text).collect()
}

fn crate_name(entry: &Value) -> Result<String, String> {
    let name = entry
        .get("crate")
        .or_else(|| entry.get("name"))
        .and_then(Value::as_str);
    name.map(str::to_owned)
        .ok_or_else(|| format!("`{entry}` names no crate"))
}

fn licensees(entries: &[Value]) -> Result<Vec<Licensee>, String> {
    let licensee = |text: &String| {
        Licensee::parse(text).map_err(|error| format!("licence `{text}`: {}", error.reason))
    };
    texts(entries)?.iter().map(licensee).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
        [licenses]
        allow = ["MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception"]
        exceptions = [{ crate = "fonts", allow = ["OFL-1.1"] }]
        [bans]
        deny = [{ crate = "openssl-sys" }]
        [sources]
        allow-registry = ["https://example.org/index"]
    "#;

    fn package(name: &str, license: &str) -> Package {
        Package {
            name: name.to_owned(),
            version: "1.0.0".to_owned(),
            license: Some(license.to_owned()),
            source: Some("registry+https://example.org/index".to_owned()),
            any_version: Vec::new(),
        }
    }

    fn complaints(package: &Package) -> usize {
        Rules::read(TEXT).unwrap().complaints(package).len()
    }

    #[test]
    fn a_licence_that_nobody_allowed_is_noticed() {
        assert_eq!(complaints(&package("a", "GPL-3.0-only")), 1);
        assert_eq!(complaints(&package("a", "MIT AND GPL-3.0-only")), 1);
        assert_eq!(complaints(&package("a", "my own")), 1);
        assert_eq!(
            complaints(&Package {
                license: None,
                ..package("a", "")
            }),
            1
        );
    }

    #[test]
    fn one_allowed_licence_of_several_is_enough() {
        assert_eq!(complaints(&package("a", "MIT OR GPL-3.0-only")), 0);
        assert_eq!(complaints(&package("a", "MIT/Apache-2.0")), 0);
        assert_eq!(
            complaints(&package("a", "Apache-2.0 WITH LLVM-exception")),
            0
        );
    }

    #[test]
    fn an_exception_holds_for_its_crate_only() {
        assert_eq!(complaints(&package("fonts", "MIT AND OFL-1.1")), 0);
        assert_eq!(complaints(&package("other", "MIT AND OFL-1.1")), 1);
    }

    #[test]
    fn a_banned_crate_is_noticed() {
        assert_eq!(complaints(&package("openssl-sys", "MIT")), 1);
    }

    #[test]
    fn a_foreign_source_is_noticed_and_our_own_packages_are_fine() {
        let source = |text: &str| Some(text.to_owned());
        let from = |source| Package {
            source,
            ..package("a", "MIT")
        };
        assert_eq!(
            complaints(&from(source("registry+https://example.com/index"))),
            1
        );
        assert_eq!(
            complaints(&from(source("git+https://example.org/index?rev=1#2"))),
            1
        );
        assert_eq!(complaints(&from(None)), 0);
    }

    #[test]
    fn a_dependency_on_any_version_is_noticed() {
        let any_version = vec!["b".to_owned()];
        assert_eq!(
            complaints(&Package {
                any_version,
                ..package("a", "MIT")
            }),
            1
        );
    }
}
