//! The rules of the house, applied to this repository.

use pilotage_tests::{
    data::repository,
    house::{
        assert_none, layers, manifest, reach, shape,
        sources::{below, folders_with_rust},
    },
};

fn text(path: &str) -> String {
    std::fs::read_to_string(repository().join(path))
        .unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn no_folder_of_core_imports_upward() {
    let sources = below("crates/core/src");
    assert!(!sources.is_empty());
    let found: Vec<_> = sources.iter().flat_map(layers::upward_imports).collect();
    assert_none(&found);
}

#[test]
fn core_reaches_no_screen_clock_file_or_thread() {
    let found: Vec<_> = reach::without_test_files(below("crates/core/src"))
        .iter()
        .flat_map(|source| reach::forbidden_paths(source, &reach::FORBIDDEN_IN_CORE))
        .collect();
    assert_none(&found);
    let manifest = text("crates/core/Cargo.toml");
    let none: [&str; 0] = [];
    assert_eq!(
        manifest::forbidden_dependencies(&manifest, &manifest::FORBIDDEN_FOR_CORE),
        none
    );
}

#[test]
fn ui_reaches_no_page_and_no_window() {
    let found: Vec<_> = reach::without_test_files(below("crates/ui/src"))
        .iter()
        .flat_map(|source| reach::forbidden_paths(source, &reach::FORBIDDEN_IN_UI))
        .collect();
    assert_none(&found);
    let manifest = text("crates/ui/Cargo.toml");
    let none: [&str; 0] = [];
    assert_eq!(
        manifest::forbidden_dependencies(&manifest, &manifest::FORBIDDEN_FOR_UI),
        none
    );
}

#[test]
fn files_are_short() {
    let sources = below(".");
    assert_none(&shape::too_long(&sources));
    let median = shape::median_length(&sources);
    assert!(
        median < shape::MEDIAN_BELOW,
        "the median Rust file has {median} lines"
    );
}

#[test]
fn unsafe_code_stands_in_simd_modules_only() {
    let found: Vec<_> = below(".")
        .iter()
        .flat_map(shape::misplaced_unsafe)
        .collect();
    assert_none(&found);
}

#[test]
fn no_file_names_a_folder_of_one_machine() {
    let found: Vec<_> = below(".").iter().flat_map(shape::machine_paths).collect();
    assert_none(&found);
}

#[test]
fn the_architecture_page_names_every_folder() {
    let folders: Vec<_> = std::fs::read_dir(repository().join("crates"))
        .expect("the crates lie in crates/")
        .map(|entry| entry.expect("the folder can be read").file_name())
        .flat_map(|name| folders_with_rust(&format!("crates/{}/src", name.to_string_lossy())))
        .collect();
    assert!(folders.len() > 3, "{folders:?}");
    assert_none(&shape::unmentioned_folders(
        &text("ARCHITECTURE.md"),
        &folders,
    ));
}
