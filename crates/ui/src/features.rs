//! The table of all features of the app, made from the list in `lib.rs`, and that of their commands.

use crate::feature::Feature;
use crate::shell::catalog::{self, CommandEntry};

/// All features of the app, in the order of their tabs.
pub struct FeatureTable;

/// Declares the folders of the features, and makes their list.
macro_rules! features {
    ($($visibility:vis $folder:ident::$feature:ident,)*) => {
        $($visibility mod $folder;)*

        impl features::FeatureTable {
            /// Every feature, as it is when the app starts.
            pub fn all() -> Vec<Box<dyn feature::Feature>> {
                vec![$(Box::<$folder::$feature>::default(),)*]
            }
        }
    };
}

/// Table of all commands: the app's own, then those of its parts.
pub fn catalog(features: &[Box<dyn Feature>]) -> Vec<CommandEntry> {
    let mut entries = catalog::catalog();
    entries.extend(features.iter().flat_map(|it| (it.info().commands)()));
    entries
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use egui::KeyboardShortcut;

    use super::*;
    use crate::command::Command;
    use crate::shell::catalog::describe;

    #[test]
    fn no_two_features_share_an_identity_and_each_lists_commands_for_itself_alone() {
        let features = FeatureTable::all();
        let names: BTreeSet<_> = features.iter().map(|it| it.info().id).collect();
        assert_eq!(names.len(), features.len());
        for info in features.iter().map(|it| it.info()) {
            for entry in (info.commands)() {
                let Command::Feature(command) = &entry.command else {
                    panic!("{} is no command of a feature", entry.label);
                };
                assert_eq!(command.to(), info.id, "{}", entry.label);
            }
        }
    }

    #[test]
    fn no_two_commands_share_a_shortcut() {
        let entries = catalog(&FeatureTable::all());
        let mut seen: Vec<(KeyboardShortcut, &str)> = Vec::new();
        for entry in &entries {
            for shortcut in &entry.shortcuts {
                if let Some((_, other)) = seen.iter().find(|(s, _)| s == shortcut) {
                    panic!("{} and {other} share {}", entry.label, describe(shortcut));
                }
                seen.push((*shortcut, &entry.label));
            }
        }
    }

    #[test]
    fn the_words_of_people_find_what_they_mean() {
        let entries = catalog(&FeatureTable::all());
        for (query, wanted) in [
            ("help", "Show all shortcuts"),
            ("tutorial", "Show Learn: the guided tour"),
            ("zoom", "Show the whole flight"),
            ("measure distance", "Measure distance and area"),
            ("screenshot", "Save a picture of the view (PNG)"),
            (
                "simulate my route",
                "Rehearse the route: fly it in the simulation",
            ),
            ("undo", "Undo"),
            ("waypoint", "Way-point in the middle of the map"),
            ("kalman", "Filter settings"),
            ("rehersal", "Stop the rehearsal"),
            ("monte carlo", "Fly a study: many flights…"),
        ] {
            let scores = entries.iter().filter_map(|it| {
                let score = crate::shell::search::by_words(query, &it.label, it.also)?;
                Some((score, it.label.as_ref()))
            });
            let mut scores: Vec<(i32, &str)> = scores.collect();
            scores.sort_by_key(|it| std::cmp::Reverse(it.0));
            let first: Vec<&str> = scores.iter().take(3).map(|it| it.1).collect();
            assert!(first.contains(&wanted), "{query}: {first:?}");
        }
    }
}
