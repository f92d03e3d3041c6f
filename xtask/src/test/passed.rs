//! The memory of `--quick`: what passed in runs before.

use std::{collections::BTreeMap, fs, path::PathBuf};

use super::{fingerprint, program::Program};
use crate::{failure::Failure, places};

/// Programs that passed, by what they were.
pub struct Passed {
    file: PathBuf,
    /// The code and data of each when it passed, and the sources of its package then where they are asked for.
    programs: BTreeMap<String, (String, Option<String>)>,
}

impl Passed {
    /// Programs that passed in runs before.
    pub fn read() -> Self {
        let file = places::target().join("passed-tests.json");
        let bytes = fs::read(&file).unwrap_or_default();
        let programs = serde_json::from_slice(&bytes).unwrap_or_default();
        Self { file, programs }
    }

    /// Keeps the programs for later runs.
    pub fn write(&self) -> Result<(), Failure> {
        let text = serde_json::json!(self.programs).to_string();
        fs::write(&self.file, text).map_err(Failure::file(&self.file))
    }

    /// Whether `one` passed as it is.
    pub fn has(&self, one: &Program) -> bool {
        let print = self.programs.get(&one.name).map(|(program, _)| program);
        print.is_some() && print == fingerprint::of(&one.executable).as_ref()
    }

    /// Whether `one`, of a package that links all others, passed with the sources that its package has, whatever it
    /// links.
    pub fn has_sources(&self, one: &Program) -> bool {
        let print = self.programs.get(&one.name);
        let print = print.and_then(|(_, sources)| sources.as_ref());
        print.is_some() && print == sources(one).as_ref()
    }

    /// Notes how `one` ended.
    pub fn note(&mut self, one: &Program, has_passed: bool) {
        self.programs.remove(&one.name);
        let program = fingerprint::of(&one.executable).filter(|_| has_passed);
        if let Some(program) = program {
            let print = (program, sources(one));
            self.programs.insert(one.name.clone(), print);
        }
    }
}

/// The sources of the package of `one`, if it links all others: nobody asks for those of other packages.
fn sources(one: &Program) -> Option<String> {
    one.is_of_surface()
        .then(|| fingerprint::of_folder(&one.folder))?
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_has_not_passed_and_what_is_built_anew_has_not_either() {
        let folder = std::env::temp_dir().join(format!("pilotage-passed-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let one = Program {
            name: "pilotage-ui/b".to_owned(),
            executable: folder.join("b"),
            folder: folder.join("sources"),
            arguments: Vec::new(),
        };
        let below = Program {
            name: "a/b".to_owned(),
            ..one.clone()
        };
        let sources = folder.join("sources");
        fs::create_dir_all(sources.join("deep")).unwrap();
        fs::write(sources.join("deep/lib.rs"), "fn main() {}").unwrap();
        fs::write(&one.executable, "first").unwrap();
        let mut passed = Passed {
            file: folder.join("passed"),
            programs: BTreeMap::new(),
        };
        assert!(!passed.has(&one));
        passed.note(&one, true);
        assert!(passed.has(&one));
        fs::write(&one.executable, "another").unwrap();
        assert!(!passed.has(&one));
        assert!(passed.has_sources(&one), "what it links changed alone");
        passed.note(&below, true);
        assert!(passed.has(&below) && !passed.has_sources(&below));
        fs::write(sources.join("deep/lib.rs"), "fn main() { panic!() }").unwrap();
        assert!(!passed.has_sources(&one));
        passed.note(&one, true);
        assert!(passed.has_sources(&one));
        passed.note(&one, false);
        assert!(!passed.has(&one) && !passed.has_sources(&one));
        fs::remove_dir_all(&folder).unwrap();
    }
}
