//! All features of the app, in the order of their tabs: a new one is a folder, and a line here.

use crate::camera_log::CameraLogFeature;
use crate::columns::ColumnsFeature;
use crate::compare::Compare;
use crate::detector::DetectorFeature;
use crate::exports::ExportsFeature;
use crate::feature::Feature;
use crate::film::Films;
use crate::georeference::GeoreferencerFeature;
use crate::go_to::GoTo;
use crate::labelling::Labelling;
use crate::learn::LearnFeature;
use crate::link::LinkFeature;
use crate::log::LogFeature;
use crate::matches::MatchFeature;
use crate::measure::Measure;
use crate::outage::Outages;
use crate::photos::PhotosFeature;
use crate::plan::Planner;
use crate::roads::Roads;
use crate::screenshot::Screenshot;
use crate::shell::catalog::{self, CommandEntry};
use crate::simulate::SimulateFeature;
use crate::study::StudyFeature;
use crate::web_map::WebMapFeature;

/// Every feature, as it is when the app starts.
pub fn all() -> Vec<Box<dyn Feature>> {
    vec![
        // As those of the app that open something, its command comes before all that save.
        Box::new(SimulateFeature::default()),
        // Its commands stand behind those of the app that open files.
        Box::new(ExportsFeature::default()),
        // Before whatever else draws on the map, for what the others draw lies over photos.
        Box::new(PhotosFeature::default()),
        // Behind photos, which may want a picture that it would put on the ground.
        Box::new(GeoreferencerFeature::default()),
        Box::new(Labelling::default()),
        Box::new(MatchFeature::default()),
        Box::new(DetectorFeature::default()),
        // Before the plan, which fits the map to itself unless the map lies somewhere.
        Box::new(LinkFeature::default()),
        Box::<Planner>::default(),
        Box::new(LearnFeature::default()),
        Box::new(LogFeature::default()),
        Box::new(Compare::default()),
        Box::new(Outages::default()),
        Box::new(StudyFeature::default()),
        Box::new(CameraLogFeature::default()),
        Box::new(WebMapFeature::default()),
        Box::<GoTo>::default(),
        Box::new(ColumnsFeature::default()),
        Box::<Measure>::default(),
        Box::<Roads>::default(),
        Box::<Screenshot>::default(),
        Box::<Films>::default(),
    ]
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
        let features = all();
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
        let entries = catalog(&all());
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
        let entries = catalog(&all());
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
