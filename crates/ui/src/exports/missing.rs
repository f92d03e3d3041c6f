//! Files that cannot be saved, since there is nothing to put into them.

use crate::documents::Documents;
use crate::export_command::ExportCommand;
use crate::shell::CommandLack;

/// Lack of `documents` for which a file cannot be saved; none if it can.
pub(super) fn missing(command: &ExportCommand, documents: &Documents) -> Option<CommandLack> {
    let mission = &documents.mission;
    let has_steps = || {
        let run = documents.run.navigated.as_ref();
        run.is_some_and(|run| !run.steps.is_empty())
    };
    let (is_there, what, advice) = match command {
        ExportCommand::Run => (
            has_steps(),
            "No run to save",
            "Simulate or open a flight first.",
        ),
        ExportCommand::Track(_) => (
            has_steps() && documents.flight.measured.is_some(),
            "No flown track to save",
            "Open a flight or simulate one, and let it be navigated.",
        ),
        ExportCommand::Route(_) => (
            documents.mission.selected_route().is_some(),
            "No route to export",
            "Draw one in the Plan workspace, or open a file with one.",
        ),
        ExportCommand::Landmarks(_) => (
            !mission.landmarks.is_empty(),
            "No landmarks to export",
            "Draw one on the map, or open a file with some.",
        ),
        ExportCommand::Rally => (
            !mission.rally.is_empty(),
            "No rally points to export",
            "Mark one on the map in the Plan workspace.",
        ),
        ExportCommand::Mission | ExportCommand::MissionAsGeoJson | ExportCommand::File(_) => {
            return None;
        }
    };
    CommandLack::unless(is_there, what, advice)
}
