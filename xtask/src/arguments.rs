//! The command line, taken apart piece by piece.

use std::path::PathBuf;

use crate::failure::Failure;

/// Rest of the command line.
#[derive(Debug)]
pub struct Arguments {
    rest: Vec<String>,
}

impl Arguments {
    /// The arguments after the program's name.
    pub fn new(arguments: impl Iterator<Item = String>) -> Self {
        Self {
            rest: arguments.collect(),
        }
    }

    /// Takes the command, which comes first.
    pub fn command(&mut self) -> Option<String> {
        if self.rest.is_empty() {
            None
        } else {
            Some(self.rest.remove(0))
        }
    }

    /// Takes `name` and says whether it was there.
    pub fn flag(&mut self, name: &str) -> bool {
        let place = self.rest.iter().position(|argument| argument == name);
        place.map(|index| self.rest.remove(index)).is_some()
    }

    /// Takes `name VALUE` or `name=VALUE`.
    pub fn value(&mut self, name: &str) -> Result<Option<String>, Failure> {
        let prefix = format!("{name}=");
        if let Some(index) = self
            .rest
            .iter()
            .position(|argument| argument.starts_with(&prefix))
        {
            return Ok(Some(self.rest.remove(index)[prefix.len()..].to_owned()));
        }
        let Some(index) = self.rest.iter().position(|argument| argument == name) else {
            return Ok(None);
        };
        if index + 1 >= self.rest.len() {
            return Err(Failure::Usage(format!("{name} needs a value")));
        }
        let value = self.rest.remove(index + 1);
        self.rest.remove(index);
        Ok(Some(value))
    }

    /// Takes `name FOLDER`; a relative folder is meant from where the command was typed.
    pub fn folder(&mut self, name: &str) -> Result<Option<PathBuf>, Failure> {
        Ok(self.value(name)?.map(PathBuf::from))
    }

    /// Complains about whatever nobody took.
    pub fn finish(&self) -> Result<(), Failure> {
        match self.rest.first() {
            None => Ok(()),
            Some(argument) => Err(Failure::Usage(format!(
                "`{argument}` is unknown here; `cargo xtask help` lists what there is"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arguments(words: &[&str]) -> Arguments {
        Arguments::new(words.iter().map(|word| (*word).to_owned()))
    }

    #[test]
    fn a_value_may_follow_its_name_or_an_equals_sign() {
        let mut line = arguments(&["serve", "--port", "0", "--profile=web"]);
        assert_eq!(line.command().as_deref(), Some("serve"));
        assert_eq!(line.value("--port").unwrap().as_deref(), Some("0"));
        assert_eq!(line.value("--profile").unwrap().as_deref(), Some("web"));
        assert!(line.finish().is_ok());
    }

    #[test]
    fn an_unknown_argument_and_a_missing_value_are_refused() {
        assert!(arguments(&["--fast"]).finish().is_err());
        assert!(arguments(&["--port"]).value("--port").is_err());
    }
}
