//! Views and features, and which of them has what part of the window.

use super::side_tab::SideTab;
use crate::command::Workspace;
use crate::documents::Documents;
use crate::feature::{Feature, FeaturePlace};
use crate::map::MapView;
use crate::timeline::Timeline;
use crate::views::{CameraView, InspectorView, LandmarkList, PlotsView};

/// The views that show the run at the time cursor.
#[derive(Default)]
pub(super) struct Views {
    pub(super) map: MapView,
    pub(super) timeline: Timeline,
    pub(super) camera: CameraView,
    pub(super) plots: PlotsView,
    pub(super) inspector: InspectorView,
    pub(super) landmarks: LandmarkList,
    /// Features, in the order of their tabs.
    pub(super) features: Vec<Box<dyn Feature>>,
}

impl Views {
    /// Feature to which a workspace belongs.
    pub(super) fn owner(&self, workspace: Workspace) -> Option<&dyn Feature> {
        let mut features = self.features.iter();
        let owner = features.find(|it| it.info().place == FeaturePlace::Workspace(workspace));
        owner.map(AsRef::as_ref)
    }

    /// Whether a workspace is about something else than the flight.
    pub(super) fn hide_flight(&self, workspace: Workspace) -> bool {
        self.owner(workspace).is_some_and(Feature::hides_flight)
    }

    /// Whether the feature of a workspace has something to show below its map.
    pub(super) fn fills_strip(&self, workspace: Workspace, documents: &Documents) -> bool {
        let owner = self.owner(workspace);
        owner.is_some_and(|it| it.fills_strip(documents))
    }

    /// Tab that is shown where nothing else was chosen.
    pub(super) fn usual_tab(&self) -> SideTab {
        let mut features = self.features.iter().map(|it| it.info());
        let first = features.find(|info| info.place == FeaturePlace::PictureTab);
        first.map_or(SideTab::Filter, |info| SideTab::Feature(info.id))
    }

    /// Place in the list of the feature that fills the window, if one does in a workspace.
    pub(super) fn fills_window(&self, workspace: Workspace) -> Option<usize> {
        let place = FeaturePlace::Window(workspace);
        let mut features = self.features.iter();
        features.position(|it| it.info().place == place && it.takes_window())
    }

    /// Place in the list of the feature that has the window for itself and the map, if one has.
    pub(super) fn beside_map(&self) -> Option<usize> {
        let mut features = self.features.iter();
        features.position(|it| it.info().place == FeaturePlace::BesideMap && it.takes_window())
    }

    /// Feature to which a workspace belongs, to be drawn.
    pub(super) fn owner_mut(&mut self, workspace: Workspace) -> Option<&mut Box<dyn Feature>> {
        let mut features = self.features.iter_mut();
        features.find(|it| it.info().place == FeaturePlace::Workspace(workspace))
    }
}
