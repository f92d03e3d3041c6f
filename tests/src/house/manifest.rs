//! What the manifests of the crates may depend on.

use toml::{Table, Value};

/// Libraries that would give `core` a screen, a clock, files, threads or a browser.
pub const FORBIDDEN_FOR_CORE: [&str; 19] = [
    "crossbeam",
    "eframe",
    "egui",
    "egui_plot",
    "getrandom",
    "js-sys",
    "memmap2",
    "pilotage-cli",
    "pilotage-ui",
    "pilotage-web",
    "pilotage-worker",
    "rayon",
    "tokio",
    "walkers",
    "wasm-bindgen",
    "web-sys",
    "web-time",
    "wgpu",
    "winit",
];

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
