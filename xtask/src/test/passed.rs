//! The memory of `--quick`: what passed in runs before.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    slice,
};

use super::{fingerprint, program::CheckProgram};
use crate::{built, failure::Failure, places};

/// Files and folders outside of the packages that their tests read while they run, by the end of a package's name.
const READ: [(&str, &[&str]); 13] = [
    ("tests/flights", &["cli"]),
    ("tests/data", &["vision", "training"]),
    ("tests/oracles", &["cli"]),
    ("www/places.bin", &["base", "ui"]),
    ("www/first", &["jobs"]),
    ("www/files.js", &["jobs", "readers"]),
    ("www/video.js", &["readers"]),
    ("www/learn", &["lessons"]),
    ("www/learn.html", &["lessons"]),
    ("docs/results.md", &["cli"]),
    ("studies", &["cli", "study"]),
    ("python/pilotage_study", &["cli"]),
    ("tests/browser/first-seconds.mjs", &["jobs"]),
];

/// Packages whose tests read `file`, a path below the root, or something in that folder.
pub fn readers_of(file: &str) -> impl Iterator<Item = String> {
    let holds = move |place: &str| {
        let rest = file.strip_prefix(place);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    let of_places = READ.iter().filter(move |(place, _)| holds(place));
    let packages = of_places.flat_map(|(_, packages)| packages.iter());
    packages.map(|package| format!("pilotage-{package}"))
}

/// Print of a program: of its code and of all that it reads, when it is looked at.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Print {
    /// Its code and data, and the files that it reads.
    program: Option<String>,
    /// The sources of its package and the files that it reads, where they are enough to know it.
    sources: Option<String>,
}

/// The sources of the packages that link all others, by their folders, taken before anything is built of them: what is
/// edited meanwhile was not tested.
pub struct Sources {
    folders: BTreeMap<PathBuf, Option<String>>,
    /// Print of the recorded data, without which many tests do nothing, and pass.
    recorded: String,
}

impl Sources {
    /// Sources as they are, of the packages in `folders`.
    pub fn of(folders: impl IntoIterator<Item = PathBuf>) -> Self {
        let print = |folder: &PathBuf| fingerprint::of_files(slice::from_ref(folder), &|_| true);
        let folders = folders.into_iter();
        Self {
            folders: folders
                .map(|folder| (folder.clone(), print(&folder)))
                .collect(),
            recorded: fingerprint::of_listing(&places::recorded_data()),
        }
    }

    /// The print of `one`, which was built just now.
    pub fn print(&self, one: &CheckProgram) -> Print {
        let read = READ.iter().filter(|(place, _)| {
            let package = one.name.split('/').next().unwrap_or_default();
            readers_of(place).any(|reader| reader == package)
        });
        let root = places::root();
        let read: Vec<PathBuf> = read.map(|(place, _)| root.join(place)).collect();
        let read = fingerprint::of_files(&read, &|_| true);
        // What a test reads of its own package is no code, and no journey through the page.
        let journeys = root.join("tests/browser");
        let is_data = |file: &Path| {
            file.extension().is_none_or(|ending| ending != "rs") && !file.starts_with(&journeys)
        };
        let own = fingerprint::of_files(slice::from_ref(&one.folder), &is_data);
        let with = |print: Option<String>| {
            let (own, read) = (own.as_ref()?, read.as_ref()?);
            Some(format!("{} {own} {read} {}", print?, self.recorded))
        };
        let sources = self.folders.get(&one.folder).cloned().flatten();
        Print {
            program: with(fingerprint::of(&one.executable)),
            sources: with(sources),
        }
    }
}

/// Programs that passed, by what they were.
pub struct Passed {
    file: PathBuf,
    /// The print of each when it passed, and the one by its sources where they are asked for.
    programs: BTreeMap<String, (String, Option<String>)>,
}

impl Passed {
    /// Programs that passed in runs before.
    pub fn read() -> Self {
        let file = built::target().join("passed-tests.json");
        let bytes = fs::read(&file).unwrap_or_default();
        let programs = serde_json::from_slice(&bytes).unwrap_or_default();
        Self { file, programs }
    }

    /// Keeps the programs for later runs.
    pub fn write(&self) -> Result<(), Failure> {
        let text = serde_json::json!(self.programs).to_string();
        fs::write(&self.file, text).map_err(Failure::file(&self.file))
    }

    /// Whether the program `name` passed as it is.
    pub fn has(&self, name: &str, print: &Print) -> bool {
        let passed = self.programs.get(name).map(|(program, _)| program);
        passed.is_some() && passed == print.program.as_ref()
    }

    /// Whether the program `name`, of a package that links all others, passed with the sources that its package has,
    /// whatever it links.
    pub fn has_sources(&self, name: &str, print: &Print) -> bool {
        let passed = self.programs.get(name);
        let passed = passed.and_then(|(_, sources)| sources.as_ref());
        passed.is_some() && passed == print.sources.as_ref()
    }

    /// Notes how the program `name` ended, as it was.
    pub fn note(&mut self, name: &str, print: Print, has_passed: bool) {
        self.programs.remove(name);
        if let Some(program) = print.program.filter(|_| has_passed) {
            let print = (program, print.sources);
            self.programs.insert(name.to_owned(), print);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder with a program of a package that links all others, its sources and a file that it reads.
    fn built(name: &str) -> (PathBuf, CheckProgram) {
        let folder = std::env::temp_dir().join(format!("pilotage-{name}-{}", std::process::id()));
        let sources = folder.join("sources");
        fs::create_dir_all(sources.join("deep")).unwrap();
        fs::write(sources.join("deep/lib.rs"), "fn main() {}").unwrap();
        fs::write(sources.join("deep/flight.csv"), "t,lat").unwrap();
        fs::write(folder.join("b"), "first").unwrap();
        let one = CheckProgram {
            name: "pilotage-ui/b".to_owned(),
            executable: folder.join("b"),
            folder: sources,
            arguments: Vec::new(),
            environment: Vec::new(),
        };
        (folder, one)
    }

    fn nothing_passed(folder: &Path) -> Passed {
        Passed {
            file: folder.join("passed"),
            programs: BTreeMap::new(),
        }
    }

    #[test]
    fn what_fails_has_not_passed_and_what_is_built_anew_has_not_either() {
        let (folder, one) = built("passed");
        let now = || Sources::of([one.folder.clone()]).print(&one);
        let mut passed = nothing_passed(&folder);
        assert!(!passed.has(&one.name, &now()));
        passed.note(&one.name, now(), true);
        assert!(passed.has(&one.name, &now()));
        fs::write(&one.executable, "another").unwrap();
        assert!(!passed.has(&one.name, &now()));
        assert!(
            passed.has_sources(&one.name, &now()),
            "what it links changed alone"
        );
        let below = Sources::of([]).print(&one);
        passed.note("a/b", below.clone(), true);
        assert!(passed.has("a/b", &below) && !passed.has_sources("a/b", &below));
        fs::write(one.folder.join("deep/lib.rs"), "fn main() { panic!() }").unwrap();
        assert!(!passed.has_sources(&one.name, &now()));
        passed.note(&one.name, now(), true);
        assert!(passed.has_sources(&one.name, &now()));
        passed.note(&one.name, now(), false);
        assert!(!passed.has(&one.name, &now()) && !passed.has_sources(&one.name, &now()));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn what_is_edited_while_the_tests_run_has_not_passed() {
        let (folder, one) = built("edited");
        let before = Sources::of([one.folder.clone()]);
        fs::write(one.folder.join("deep/lib.rs"), "fn main() { panic!() }").unwrap();
        let print = before.print(&one);
        fs::write(&one.executable, "built by another cargo meanwhile").unwrap();
        let mut passed = nothing_passed(&folder);
        passed.note(&one.name, print, true);
        let now = Sources::of([one.folder.clone()]).print(&one);
        assert!(!passed.has_sources(&one.name, &now) && !passed.has(&one.name, &now));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn what_a_test_reads_counts_as_what_it_is() {
        let (folder, one) = built("read");
        let now = || Sources::of([]).print(&one);
        let mut passed = nothing_passed(&folder);
        passed.note(&one.name, now(), true);
        fs::write(one.folder.join("deep/lib.rs"), "// a word").unwrap();
        assert!(passed.has(&one.name, &now()), "the program is the same");
        fs::write(one.folder.join("deep/flight.csv"), "t,lat,lon").unwrap();
        assert!(!passed.has(&one.name, &now()));
        fs::remove_dir_all(&folder).unwrap();
        for (place, _) in READ {
            assert!(places::root().join(place).exists(), "{place}");
        }
    }
}
