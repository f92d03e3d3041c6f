//! Routes, landmarks, areas and roads from the files of other programs.

use super::planner::Planner;
use super::tab::PlanTab;
use crate::documents::Brought;
use crate::feature::FeatureContext;
use crate::shell::{counted, sentences};
use pilotage_jobs::ImportedFile;

impl Planner {
    /// Adds what files of other programs brought to the mission, as one step, and says what was
    /// assumed, kept aside or left out.
    pub(super) fn add_imports(
        &mut self,
        files: Vec<ImportedFile>,
        context: &mut FeatureContext<'_>,
    ) {
        if files.is_empty() {
            return;
        }
        let routes: usize = files.iter().map(|f| f.routes.len()).sum();
        let landmarks: usize = files.iter().map(|f| f.landmarks.len()).sum();
        let no_fly: usize = files.iter().map(|f| f.no_fly.len()).sum();
        let rally: usize = files.iter().map(|f| f.rally.len()).sum();
        let roads: usize = files.iter().map(|f| f.roads.len()).sum();
        let adds_plan = routes + landmarks + no_fly + rally > 0;
        let names: Vec<String> = files
            .iter()
            .map(|f| format!("{} ({})", f.name, f.format))
            .collect();
        let several = files.len() > 1;
        let mut notes: Vec<String> = files
            .iter()
            .flat_map(|f| {
                let name = f.name.clone();
                let of = move |note: &String| {
                    if several {
                        format!("{name}: {note}")
                    } else {
                        note.clone()
                    }
                };
                f.notes.iter().map(of)
            })
            .collect();
        let documents = &mut *context.documents;
        let added = documents.add_all(files.into_iter().map(Brought::from).collect());
        let roads = roads - added.known_roads;
        if added.known_roads > 0 {
            let known = counted(added.known_roads, "road", "roads");
            notes.push(format!("{known} left out that the mission has"));
        }
        let what = [
            (routes, "route", "routes"),
            (landmarks, "landmark", "landmarks"),
            (no_fly, "no-fly area", "no-fly areas"),
            (rally, "rally point", "rally points"),
            (roads, "road", "roads"),
        ];
        let what = what.into_iter().filter(|(count, ..)| *count > 0);
        let what = what.map(|(count, one, several)| counted(count, one, several));
        let what: Vec<String> = what.collect();
        // Roads are seen in any workspace.
        if adds_plan {
            self.drawing = false;
            self.fitted = false;
            self.way_point = None;
            self.tab = match (added.routes.is_empty(), added.landmarks.is_empty()) {
                (false, _) => PlanTab::Route,
                (true, false) => PlanTab::Landmarks,
                (true, true) => PlanTab::Ground,
            };
            documents.mission.route = added.routes.first().copied().or(documents.mission.route);
            context.show();
        }
        context.document_changed();
        if !added.landmarks.is_empty() || roads > 0 && context.documents.uses_roads() {
            context.run_is_stale();
        }
        let what = if what.is_empty() {
            "nothing".to_owned()
        } else {
            what.join(" and ")
        };
        let title = format!("Added {what} from {}", names.join(", "));
        context.note(&title, sentences(&notes));
    }
}
