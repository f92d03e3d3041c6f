//! Tabs of the column at the right.

use crate::feature::{Feature, FeatureId, FeaturePlace};

/// Content of the column at the right below the camera picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SideTab {
    /// Work of the filter.
    Filter,
    /// The list of landmarks.
    Landmarks,
    /// Panel of a feature.
    Feature(FeatureId),
    /// The camera picture (narrow windows only).
    #[default]
    Camera,
    /// The plots (narrow windows only).
    Plots,
}

impl SideTab {
    /// Name for journeys: of a feature, its identity.
    pub(super) fn name(self) -> String {
        match self {
            Self::Feature(id) => id.to_owned(),
            other => format!("{other:?}"),
        }
    }

    /// Name on the tab; of a feature, as it says itself.
    pub(super) fn label(self, features: &[Box<dyn Feature>]) -> &'static str {
        match self {
            Self::Filter => "Filter",
            Self::Landmarks => "Landmarks",
            Self::Camera => "Camera",
            Self::Plots => "Plots",
            Self::Feature(id) => {
                let info = features
                    .iter()
                    .map(|it| it.info())
                    .find(|info| info.id == id);
                info.map_or("", |info| info.tab)
            }
        }
    }
}

/// Whether a tab takes the whole column, without a picture and tabs.
pub(super) fn is_sheet(tab: SideTab, features: &[Box<dyn Feature>]) -> bool {
    match tab {
        SideTab::Feature(id) => {
            let mut infos = features.iter().map(|it| it.info());
            infos.any(|info| info.id == id && info.place == FeaturePlace::Sheet)
        }
        _ => false,
    }
}
