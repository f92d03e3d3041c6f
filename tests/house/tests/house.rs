//! The rules of the house, applied to this repository.

use pilotage_house::{
    additions, assert_none, circles, docstrings, drops, layers, manifest, names, papers, reach,
    shape,
    sources::{below, folders_with_rust, repository},
};

fn text(path: &str) -> String {
    std::fs::read_to_string(repository().join(path))
        .unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn no_folder_imports_upward() {
    for order in layers::ORDERS {
        let sources = below(order.sources);
        assert!(!sources.is_empty(), "{}", order.sources);
        let features = features_of(order.sources);
        let found: Vec<_> = sources
            .iter()
            .flat_map(|source| layers::upward_imports(source, order, &features))
            .collect();
        assert_none(&found);
    }
}

#[test]
fn no_files_of_a_folder_need_each_other_in_a_circle() {
    let mut folders = crates_with_sources();
    folders.extend(["xtask/src", "tests/src"].map(str::to_owned));
    let found: Vec<_> = folders
        .iter()
        .flat_map(|folder| {
            let sources = reach::without_test_files(below(folder));
            let has_order = layers::ORDERS.iter().any(|order| order.sources == folder);
            circles::circles(folder, &sources, !has_order)
        })
        .collect();
    assert_none(&circles::new_circles(&found, &circles::LEFT));
    let opened = circles::opened_circles(&found, &circles::LEFT);
    assert!(
        opened.is_empty(),
        "these circles are open or have other files now: take them off the list, {opened:?}"
    );
}

#[test]
fn no_crate_of_the_method_depends_on_one_above_it_or_on_a_leaf() {
    for name in manifest::CORE {
        let found =
            manifest::dependencies_upward(name, &text(&format!("crates/core/{name}/Cargo.toml")));
        assert!(found.is_empty(), "{name} depends on {found:?}");
    }
    let crates = std::fs::read_dir(repository().join("crates/core"))
        .expect("the method lies in crates/core")
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| {
            repository()
                .join("crates/core")
                .join(name)
                .join("Cargo.toml")
                .exists()
        });
    for name in crates {
        assert!(
            manifest::CORE.contains(&name.as_str()),
            "`{name}` has no place in the order"
        );
    }
}

#[test]
fn core_reaches_no_screen_clock_file_or_thread() {
    let names = manifest::CORE
        .iter()
        .map(|name| format!("crates/core/{name}"));
    for folder in names.chain(["crates/core", "crates/study"].map(str::to_owned)) {
        let sources = below(&format!("{folder}/src"));
        assert!(!sources.is_empty(), "{folder}");
        let found: Vec<_> = reach::without_test_files(sources)
            .iter()
            .flat_map(|source| reach::forbidden_paths(source, &reach::FORBIDDEN_IN_CORE))
            .collect();
        assert_none(&found);
        let manifest = text(&format!("{folder}/Cargo.toml"));
        let found = manifest::forbidden_dependencies(&manifest, &manifest::FORBIDDEN_FOR_CORE);
        assert!(found.is_empty(), "{folder} depends on {found:?}");
    }
}

#[test]
fn jobs_and_workers_link_no_screen_and_jobs_reach_no_page() {
    let none: [&str; 0] = [];
    let without = ["jobs", "disk", "worker", "worker/flying", "worker/whole"];
    let without = without.map(|folder| format!("crates/{folder}"));
    for folder in without.iter().map(String::as_str).chain([PYTHON]) {
        let manifest = text(&format!("{folder}/Cargo.toml"));
        let forbidden = manifest::FORBIDDEN_WITHOUT_SCREEN;
        let found = manifest::forbidden_dependencies(&manifest, &forbidden);
        assert_eq!(found, none, "{folder}");
    }
    let found: Vec<_> = reach::without_test_files(below("crates/jobs/src"))
        .iter()
        .flat_map(|source| reach::forbidden_paths(source, &reach::FORBIDDEN_IN_UI))
        .collect();
    assert_none(&found);
    let manifest = text("crates/jobs/Cargo.toml");
    let found = manifest::forbidden_dependencies(&manifest, &manifest::FORBIDDEN_FOR_UI);
    assert_eq!(found, none);
}

#[test]
fn the_workers_alone_start_threads_and_the_terminal_does_its_work_by_orders() {
    let starts = |source: &pilotage_house::sources::Source| {
        reach::forbidden_paths(source, &reach::FORBIDDEN_BESIDE_WORKERS)
    };
    for folder in ["crates/cli/src", "crates/disk/src", "python/pilotage/src"] {
        let sources = reach::without_test_files(below(folder));
        assert!(!sources.is_empty(), "{folder}");
        let (workers, others): (Vec<_>, Vec<_>) = sources
            .iter()
            .partition(|source| source.path == "workers.rs");
        let of_workers = workers.into_iter().flat_map(starts).count();
        assert_eq!(of_workers > 0, folder == "crates/disk/src", "{folder}");
        assert_none(&others.into_iter().flat_map(starts).collect::<Vec<_>>());
    }
    let flies = |source| reach::forbidden_paths(source, &reach::FORBIDDEN_AT_THE_TERMINAL);
    let of_terminal = reach::without_test_files(below("crates/cli/src"));
    assert_none(&of_terminal.iter().flat_map(flies).collect::<Vec<_>>());
}

#[test]
fn only_the_package_for_python_knows_python_and_it_stands_on_what_it_hands_over() {
    let of_python = text(&format!("{PYTHON}/Cargo.toml"));
    let none: [&str; 0] = [];
    assert_eq!(manifest::dependencies_beside_python(&of_python), none);
    for sources in crates_with_sources() {
        let folder = sources.trim_end_matches("/src");
        if folder != PYTHON {
            let manifest = text(&format!("{folder}/Cargo.toml"));
            let found = manifest::forbidden_dependencies(&manifest, &manifest::OF_PYTHON);
            assert_eq!(found, none, "{folder}");
        }
    }
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
fn a_number_that_is_only_looked_at_stays_what_it_is() {
    let sources = reach::without_test_files(below("crates/ui/src"));
    let (field, others): (Vec<_>, Vec<_>) = sources
        .iter()
        .partition(|source| source.path.ends_with("shell/number_field.rs"));
    let of = |source| reach::forbidden_paths(source, &reach::BEHIND_NUMBER_FIELD);
    assert!(
        !field
            .into_iter()
            .flat_map(of)
            .collect::<Vec<_>>()
            .is_empty()
    );
    let found: Vec<_> = others.into_iter().flat_map(of).collect();
    assert_none(&found);
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
fn documentation_begins_with_the_thing_that_it_is_of() {
    let found: Vec<_> = below(".")
        .iter()
        .flat_map(docstrings::empty_beginnings)
        .collect();
    assert_none(&found);
}

#[test]
fn no_two_types_that_other_files_see_share_a_name() {
    let folders = [
        "crates",
        PYTHON,
        "tests/src",
        "tests/house/src",
        "tests/examples",
        "xtask",
    ];
    let rust = folders.into_iter().flat_map(below);
    let rust = rust.filter(|source| source.is("rs"));
    let sources = reach::without_test_files(rust.collect());
    assert_none(&names::shared_names(&sources, &names::SHARED));
    let once = names::no_longer_shared(&sources, &names::SHARED);
    assert!(
        once.is_empty(),
        "{once:?} stand once: take them off the list"
    );
    let glossary = text("docs/glossary.md");
    for (name, _) in names::SHARED {
        assert!(
            glossary.contains(&format!("| `{name}` |")),
            "docs/glossary.md says nothing of `{name}`"
        );
    }
}

#[test]
fn no_file_names_a_folder_of_one_machine() {
    let found: Vec<_> = below(".").iter().flat_map(shape::machine_paths).collect();
    assert_none(&found);
}

#[test]
fn the_architecture_page_names_every_folder() {
    let mut folders: Vec<_> = crates_with_sources()
        .iter()
        .flat_map(|sources| folders_with_rust(sources))
        .collect();
    assert!(folders.len() > 3, "{folders:?}");
    // The folder of an entry of a table is told by the beginning of its own file.
    for table in &additions::TABLES {
        let entries = table.entries(&below(table.sources)).into_iter();
        for module in entries.filter_map(|entry| entry.module) {
            let folder = [table.sources, table.folder, &module].join("/");
            let folder = folder.replace("//", "/");
            let tells = || text(&format!("{folder}/mod.rs")).starts_with("//! ");
            folders.retain(|other| *other != folder || !tells());
        }
    }
    assert_none(&shape::unmentioned_folders(
        &text("ARCHITECTURE.md"),
        &folders,
    ));
}

#[test]
fn the_papers_that_are_read_at_one_sitting_stay_short() {
    let too_long = |(path, most)| papers::too_long(path, &text(path), most);
    let found: Vec<_> = papers::SHORT_PAPERS
        .into_iter()
        .filter_map(too_long)
        .collect();
    assert_none(&found);
}

#[test]
fn the_method_says_what_each_aid_estimator_and_vehicle_does() {
    let sources = below("crates/core");
    let aids = papers::keys(&sources, "AidInfo");
    assert!(aids.len() > 7, "{aids:?}");
    let estimators = papers::keys(&sources, "EstimatorInfo");
    assert!(estimators.len() > 2, "{estimators:?}");
    // A file that gives its equations and their source is a paper of its own.
    let chosen = aids.into_iter().chain(estimators);
    let elsewhere = chosen.filter(|(source, _)| !papers::gives_equations(&source.text));
    let elsewhere = elsewhere.map(|(_, key)| key).collect();
    let registry = text("crates/core/estimation/src/vehicle/registry.rs");
    let vehicles = papers::listed(&registry, "registry");
    assert!(vehicles.len() > 8, "{vehicles:?}");
    let names = [elsewhere, vehicles].concat();
    let method = text("docs/method.md");
    assert_none(&papers::unwritten("docs/method.md", &method, &names));
}

#[test]
fn the_names_in_the_method_and_the_glossary_are_those_of_the_sources() {
    let sources = [below("crates"), below(PYTHON), below("tests")].concat();
    for path in ["docs/method.md", "docs/glossary.md"] {
        assert_none(&papers::unknown(path, &text(path), &sources));
    }
}

/// Files of the interface in which the app does something itself. Parts of the app become features, which do it for
/// themselves: this number may shrink, never grow.
const OF_THE_APP: usize = 7;

#[test]
fn the_app_does_no_more_by_itself_than_it_did() {
    let sources = below("crates/ui/src");
    let is_of_app = |text: &str| text.lines().any(|line| line == "impl App {");
    let files = sources.iter().filter(|source| is_of_app(&source.text));
    assert_eq!(
        files.count(),
        OF_THE_APP,
        "files with `impl App`: where the number grew, make it a feature; where it shrank, write it down"
    );
}

#[test]
fn an_addition_is_a_file_and_a_line() {
    let rust = |folder: &str| {
        let sources = below(folder).into_iter();
        let sources = sources.filter(|source| source.is("rs"));
        let mut sources = reach::without_test_files(sources.collect());
        sources.retain(|source| !source.path.ends_with("_tests.rs"));
        sources
    };
    let mut all = rust("crates");
    // Tests and examples beside the sources are no part of an addition.
    all.retain(|source| source.path.contains("/src/"));
    for source in &mut all {
        source.path = format!("crates/{}", source.path);
    }
    let mut dear = Vec::new();
    for table in &additions::TABLES {
        let sources = rust(table.sources);
        assert!(!table.entries(&sources).is_empty(), "{table:?}");
        let named = additions::named_elsewhere(table, &sources, &all);
        let cheaper = additions::cheaper_by_now(table, &named, &additions::LEFT);
        assert!(
            cheaper.is_empty(),
            "fewer files name these by now: write the smaller numbers down, {cheaper:?}"
        );
        dear.extend(additions::dear_additions(table, &named, &additions::LEFT));
    }
    assert_none(&dear);
}

#[test]
fn no_part_of_the_page_drops_events_or_commands_in_silence() {
    let found: Vec<_> = reach::without_test_files(below("crates/ui/src"))
        .iter()
        .flat_map(drops::silent_arms)
        .collect();
    assert_none(&found);
}

/// Folders that the table of features in `sources` lists, if it has one.
fn features_of(sources: &str) -> Vec<String> {
    let mut tables = additions::TABLES.iter();
    let table = tables.find(|table| table.sources == sources && table.call == "features");
    let entries = table.map_or(Vec::new(), |table| table.entries(&below(sources)));
    entries
        .into_iter()
        .filter_map(|entry| entry.module)
        .collect()
}

/// Folder of the package for Python.
const PYTHON: &str = "python/pilotage";

/// Folders of sources of the crates, relative to the root of the repository.
fn crates_with_sources() -> Vec<String> {
    let crates = ["crates", "crates/core"].map(|folder| {
        std::fs::read_dir(repository().join(folder))
            .expect("the crates lie in crates/ and crates/core/")
            .map(|entry| entry.expect("the folder can be read").file_name())
            .map(|name| format!("{folder}/{}/src", name.to_string_lossy()))
            .filter(|sources| repository().join(sources).is_dir())
            .collect::<Vec<_>>()
    });
    let mut folders = crates.concat();
    folders.push(format!("{PYTHON}/src"));
    folders
}
