//! Dependencies that the manifests of the crates may have.

use toml::{Table, Value};

/// Libraries that would give `core` a screen, a clock, files, threads or a browser.
pub const FORBIDDEN_FOR_CORE: [&str; 24] = [
    "crossbeam",
    "eframe",
    "egui",
    "egui_plot",
    "getrandom",
    "js-sys",
    "memmap2",
    "numpy",
    "pilotage-cli",
    "pilotage-disk",
    "pilotage-jobs",
    "pilotage-python",
    "pilotage-ui",
    "pilotage-web",
    "pilotage-worker",
    "pyo3",
    "rayon",
    "tokio",
    "walkers",
    "wasm-bindgen",
    "web-sys",
    "web-time",
    "wgpu",
    "winit",
];

/// Libraries that would give jobs, or the programs of the page's workers, a screen.
pub const FORBIDDEN_WITHOUT_SCREEN: [&str; 7] = [
    "eframe",
    "egui",
    "egui_plot",
    "epaint",
    "epaint_default_fonts",
    "pilotage-ui",
    "pilotage-web",
];

/// Libraries that belong to Python, which only the package for it may know.
pub const OF_PYTHON: [&str; 4] = ["numpy", "pilotage-python", "pyo3", "pyo3-build-config"];

/// Packages that the one for Python stands on: it hands over what they do and does nothing itself.
pub const BELOW_PYTHON: [&str; 5] = ["core", "disk", "estimation", "jobs", "libraries"];

/// Packages of this workspace that the manifest `text` of the package for Python must not depend on.
///
/// # Panics
/// If `text` is not TOML.
pub fn dependencies_beside_python(text: &str) -> Vec<String> {
    let manifest: Table = text
        .parse()
        .unwrap_or_else(|error| panic!("not TOML: {error}"));
    let dependencies = manifest.get("dependencies").and_then(Value::as_table);
    let keys = dependencies.into_iter().flat_map(Table::keys);
    keys.filter(|key| {
        let package = key.strip_prefix("pilotage-");
        package.is_some_and(|package| !BELOW_PYTHON.contains(&package))
    })
    .cloned()
    .collect()
}

/// Libraries that would tie `ui` to a page or a window.
pub const FORBIDDEN_FOR_UI: [&str; 7] = [
    "eframe",
    "js-sys",
    "pilotage-web",
    "pilotage-worker",
    "wasm-bindgen",
    "web-sys",
    "winit",
];

/// Names from `forbidden` that the manifest `text` depends on, for any target. Libraries that
/// only its tests use do not count.
///
/// # Panics
/// If `text` is not TOML.
pub fn forbidden_dependencies<'a>(text: &str, forbidden: &[&'a str]) -> Vec<&'a str> {
    let manifest: Table = text
        .parse()
        .unwrap_or_else(|error| panic!("not TOML: {error}"));
    let mut lists: Vec<&Table> = Vec::new();
    lists.extend(manifest.get("dependencies").and_then(Value::as_table));
    let targets = manifest.get("target").and_then(Value::as_table);
    for target in targets.iter().flat_map(|targets| targets.values()) {
        lists.extend(target.get("dependencies").and_then(Value::as_table));
    }
    let named = |name: &str| {
        let is_it = |(key, value): (&String, &Value)| {
            key == name || value.get("package").and_then(Value::as_str) == Some(name)
        };
        lists.iter().any(|list| list.iter().any(is_it))
    };
    forbidden
        .iter()
        .copied()
        .filter(|name| named(name))
        .collect()
}

/// The crates of the method from the bottom up: each may depend on those before it.
pub const CORE: [&str; 16] = [
    "libraries",
    "fourier",
    "base",
    "estimation",
    "raster",
    "flight",
    "vision",
    "roads",
    "reference",
    "mission",
    "readers",
    "maps",
    "navigator",
    "simulate",
    "plan",
    "training",
];

/// Crates of the method that nothing of the method stands on, so that others can use them and an edit rebuilds
/// little.
pub const LEAVES: [&str; 4] = ["readers", "maps", "plan", "training"];

/// Packages of this workspace that the manifest `text` of the method's crate `name` must not depend on, not
/// even in its tests: those above it, and leaves.
///
/// # Panics
/// If `text` is not TOML or the crate has no place in the order.
pub fn dependencies_upward(name: &str, text: &str) -> Vec<String> {
    let own = CORE.iter().position(|other| *other == name);
    let own = own.unwrap_or_else(|| panic!("`{name}` has no place in the order {CORE:?}"));
    let allowed = |package: &str| {
        CORE[..own]
            .iter()
            .any(|lower| *lower == package && !LEAVES.contains(lower))
    };
    let manifest: Table = text
        .parse()
        .unwrap_or_else(|error| panic!("not TOML: {error}"));
    let lists = ["dependencies", "dev-dependencies", "build-dependencies"];
    let lists = lists
        .iter()
        .filter_map(|list| manifest.get(*list)?.as_table());
    lists
        .flat_map(Table::keys)
        .filter(|key| {
            let package = key.strip_prefix("pilotage-");
            package.is_some_and(|package| !allowed(package))
        })
        .cloned()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_package_for_python_stands_on_what_it_hands_over_only() {
        let manifest = "[dependencies]\npilotage-jobs.workspace = true\npilotage-cli.workspace = true\npyo3 = \"1\"\n";
        assert_eq!(dependencies_beside_python(manifest), ["pilotage-cli"]);
        assert_eq!(
            forbidden_dependencies(manifest, &OF_PYTHON),
            ["pyo3"],
            "elsewhere"
        );
    }

    #[test]
    fn a_forbidden_dependency_is_noticed_under_each_of_its_spellings() {
        let plain = "[dependencies]\negui.workspace = true\n";
        assert_eq!(forbidden_dependencies(plain, &FORBIDDEN_FOR_CORE), ["egui"]);
        let renamed = "[dependencies]\nthreads = { package = \"rayon\", version = \"1\" }\n";
        assert_eq!(
            forbidden_dependencies(renamed, &FORBIDDEN_FOR_CORE),
            ["rayon"]
        );
        let on_one_target = "[target.'cfg(unix)'.dependencies]\ntokio = \"1\"\n";
        assert_eq!(
            forbidden_dependencies(on_one_target, &FORBIDDEN_FOR_CORE),
            ["tokio"]
        );
    }

    #[test]
    fn libraries_of_the_tests_do_not_count() {
        let manifest = "[dependencies]\nnalgebra = \"1\"\n[dev-dependencies]\nrayon = \"1\"\n";
        assert!(forbidden_dependencies(manifest, &FORBIDDEN_FOR_CORE).is_empty());
    }

    #[test]
    fn a_dependency_on_a_crate_above_or_on_a_leaf_is_noticed() {
        let up =
            "[dependencies]\npilotage-base.workspace = true\npilotage-navigator.workspace = true\n";
        assert_eq!(dependencies_upward("vision", up), ["pilotage-navigator"]);
        let leaf = "[dev-dependencies]\npilotage-readers.workspace = true\n";
        assert_eq!(dependencies_upward("navigator", leaf), ["pilotage-readers"]);
        let facade = "[dependencies]\npilotage-core.workspace = true\n";
        assert_eq!(dependencies_upward("plan", facade), ["pilotage-core"]);
        let down = "[dependencies]\npilotage-raster.workspace = true\nnalgebra.workspace = true\n";
        assert!(dependencies_upward("vision", down).is_empty());
    }
}
