//! Arrangements of plots that people saved, kept for every log.

use serde::{Deserialize, Serialize};

use super::arrangement::PanelContent;
use pilotage_jobs::SeriesName;

/// Key of the arrangements in the browser's storage.
pub const PRESETS_KEY: &str = "plots";

/// An arrangement that somebody saved.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OwnPreset {
    /// Its name.
    pub name: String,
    /// Its panels.
    pub panels: Vec<PanelContent>,
}

/// Commands about saved arrangements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PresetCommand {
    /// Save the plots as they are under a name; one of that name is replaced.
    Save(String),
    /// Show one.
    Show(String),
    /// Give one another name.
    Rename {
        /// The name that it has.
        from: String,
        /// The name that it is to have.
        to: String,
    },
    /// Delete one.
    Delete(String),
    /// Take back what was done last.
    Undo,
}

/// Everything that people saved about plots: arrangements, and the expressions that they plotted last.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct OwnPresets {
    presets: Vec<OwnPreset>,
    /// Expressions that were plotted, the last one first.
    pub expressions: Vec<String>,
    /// Arrangements before the last change.
    #[serde(skip)]
    before: Option<Vec<OwnPreset>>,
}

impl OwnPresets {
    /// From the storage; nothing if there is nothing readable.
    pub fn decode(bytes: &[u8]) -> Self {
        serde_json::from_slice(bytes).unwrap_or_default()
    }

    /// As bytes for the storage.
    pub fn encode(&self) -> Vec<u8> {
        serde_json::to_vec(self).unwrap_or_default()
    }

    /// All of them, in the order in which they were saved.
    pub fn all(&self) -> &[OwnPreset] {
        &self.presets
    }

    /// The one of that name.
    pub fn named(&self, name: &str) -> Option<&OwnPreset> {
        self.presets.iter().find(|preset| preset.name == name)
    }

    /// Whether something can be taken back.
    pub fn can_undo(&self) -> bool {
        self.before.is_some()
    }

    /// Saves, renames, deletes or takes back; `shown` is what is on screen.
    pub fn execute(&mut self, command: PresetCommand, shown: Vec<PanelContent>) {
        let before = self.presets.clone();
        match command {
            PresetCommand::Save(name) => {
                let name = name.trim().to_owned();
                if name.is_empty() || shown.is_empty() {
                    return;
                }
                match self.presets.iter_mut().find(|preset| preset.name == name) {
                    Some(preset) => preset.panels = shown,
                    None => self.presets.push(OwnPreset {
                        name,
                        panels: shown,
                    }),
                }
            }
            PresetCommand::Rename { from, to } => {
                let to = to.trim().to_owned();
                let is_free = !to.is_empty() && self.named(&to).is_none();
                let preset = self.presets.iter_mut().find(|preset| preset.name == from);
                if let Some(preset) = preset.filter(|_| is_free) {
                    preset.name = to;
                }
            }
            PresetCommand::Delete(name) => self.presets.retain(|preset| preset.name != name),
            PresetCommand::Undo => {
                self.presets = self.before.take().unwrap_or(before);
                return;
            }
            PresetCommand::Show(_) => return,
        }
        if self.presets != before {
            self.before = Some(before);
        }
    }

    /// Remembers an expression that was plotted, at most `most`.
    pub fn remember_expression(&mut self, series: &SeriesName, most: usize) {
        self.expressions.retain(|known| *known != series.field);
        self.expressions.insert(0, series.field.clone());
        self.expressions.truncate(most);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> Vec<PanelContent> {
        let fields = vec![SeriesName::expression(text)];
        vec![PanelContent::over_time(fields)]
    }

    fn names(presets: &OwnPresets) -> Vec<&str> {
        let names = presets.all().iter().map(|preset| preset.name.as_str());
        names.collect()
    }

    #[test]
    fn arrangements_are_saved_renamed_deleted_and_brought_back() {
        let mut presets = OwnPresets::default();
        let save = |name: &str| PresetCommand::Save(name.to_owned());
        presets.execute(save(" Mine "), shown("1"));
        presets.execute(save("Other"), shown("2"));
        presets.execute(save("Mine"), shown("3"));
        assert_eq!(names(&presets), ["Mine", "Other"]);
        assert_eq!(presets.named("Mine").map(|p| &p.panels), Some(&shown("3")));
        let rename = |from: &str, to: &str| PresetCommand::Rename {
            from: from.to_owned(),
            to: to.to_owned(),
        };
        presets.execute(rename("Mine", "Other"), Vec::new());
        assert_eq!(names(&presets), ["Mine", "Other"], "two of one name");
        presets.execute(rename("Mine", "Yours"), Vec::new());
        presets.execute(PresetCommand::Delete("Other".to_owned()), Vec::new());
        assert_eq!(names(&presets), ["Yours"]);
        presets.execute(PresetCommand::Undo, Vec::new());
        assert_eq!(names(&presets), ["Yours", "Other"]);
        assert!(!presets.can_undo());
    }

    #[test]
    fn saved_arrangements_survive_the_storage_and_damage_is_no_harm() {
        let mut presets = OwnPresets::default();
        presets.execute(
            PresetCommand::Save("Mine".to_owned()),
            shown("ATT.Roll + 1"),
        );
        presets.remember_expression(&SeriesName::expression("ATT.Roll + 1"), 30);
        let again = OwnPresets::decode(&presets.encode());
        assert_eq!(again.all(), presets.all());
        assert_eq!(again.expressions, ["ATT.Roll + 1"]);
        assert_eq!(
            OwnPresets::decode(b"{\"presets\": 3"),
            OwnPresets::default()
        );
    }

    #[test]
    fn nothing_is_saved_without_a_name_or_without_plots() {
        let mut presets = OwnPresets::default();
        presets.execute(PresetCommand::Save("  ".to_owned()), shown("1"));
        presets.execute(PresetCommand::Save("Empty".to_owned()), Vec::new());
        assert!(presets.all().is_empty() && !presets.can_undo());
    }
}
