//! Routes and landmarks as files of other programs.

use pilotage_core::exchange::Format;
use pilotage_jobs::ExportOrder;

use crate::export_command::ExportedFile;
use crate::feature::FeatureContext;
use crate::host::stem;

/// File of the selected route, and how it is made; none without a route.
pub(super) fn route_file(
    format: Format,
    context: &FeatureContext<'_>,
) -> Option<(ExportedFile, ExportOrder)> {
    let route = context.documents.mission.selected_route()?;
    let mission = &context.documents.mission;
    let file = ExportedFile {
        what: "Route".to_owned(),
        format: format.name(),
        name: format!("{}.{}", stem(&route.name), format.extensions()[0]),
    };
    let order = ExportOrder::Places {
        format,
        no_fly: mission.no_fly.clone(),
        rally: mission.rally.clone(),
        routes: vec![route.clone()],
        landmarks: Vec::new(),
        origin: mission.origin,
    };
    Some((file, order))
}

/// File of all landmarks, and how it is made.
pub(super) fn landmarks_file(
    format: Format,
    context: &FeatureContext<'_>,
) -> (ExportedFile, ExportOrder) {
    let mission = &context.documents.mission;
    let (name, extension) = (stem(&mission.name), format.extensions()[0]);
    let file = ExportedFile {
        what: "Landmarks".to_owned(),
        format: format.name(),
        name: format!("{name}-landmarks.{extension}"),
    };
    let order = ExportOrder::Places {
        format,
        no_fly: Vec::new(),
        rally: Vec::new(),
        routes: Vec::new(),
        landmarks: mission.landmarks.clone(),
        origin: mission.origin,
    };
    (file, order)
}

/// File of all rally points, and how it is made.
pub(super) fn rally_file(context: &FeatureContext<'_>) -> Option<(ExportedFile, ExportOrder)> {
    let mission = &context.documents.mission;
    let format = Format::of_rally_alone()?;
    let (name, extension) = (stem(&mission.name), format.extensions()[0]);
    let file = ExportedFile {
        what: "Rally points".to_owned(),
        format: format.name(),
        name: format!("{name}-rally.{extension}"),
    };
    let order = ExportOrder::Places {
        format,
        no_fly: Vec::new(),
        rally: mission.rally.clone(),
        routes: Vec::new(),
        landmarks: Vec::new(),
        origin: mission.origin,
    };
    Some((file, order))
}
