//! The views and commands of Pilotage, without a window system, so that tests drive them natively.

#[macro_use]
pub mod features;

pub mod app;
pub mod command;
pub mod context;
pub mod dialogs;
pub mod documents;
pub mod explanations;
pub mod export_command;
pub mod feature;
pub mod feature_command;
pub mod feature_wishes;
pub mod feature_work;
pub mod host;
pub mod job_owners;
pub mod kept_mesh;
pub mod kept_tree;
pub mod map;
pub mod shell;
pub mod short_map;
mod state_json;
pub mod still;
#[cfg(test)]
mod testing;
pub mod timeline;
pub mod tokens;
pub mod units;
pub mod views;

// All features, in the order of their tabs: another one is a folder, and a line here.
features! {
    // As those of the app that open something, its command comes before all that save.
    pub simulate::SimulateFeature,
    // Its commands stand behind those of the app that open files.
    pub exports::ExportsFeature,
    // Before whatever else draws on the map, for what the others draw lies over photos.
    pub photos::PhotosFeature,
    // Behind photos, which may want a picture that it would put on the ground.
    pub georeference::GeoreferencerFeature,
    pub labelling::Labelling,
    pub matches::MatchFeature,
    pub detector::DetectorFeature,
    // Before the plan, which fits the map to itself unless the map lies somewhere.
    pub link::LinkFeature,
    pub plan::Planner,
    pub learn::LearnFeature,
    pub log::LogFeature,
    pub compare::Compare,
    pub outage::Outages,
    pub study::StudyFeature,
    pub camera_log::CameraLogFeature,
    pub web_map::WebMapFeature,
    pub go_to::GoTo,
    pub columns::ColumnsFeature,
    pub measure::Measure,
    pub roads::Roads,
    pub among_roads::AmongRoads,
    pub screenshot::Screenshot,
    film::Films,
}
