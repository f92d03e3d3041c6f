//! Panels of the window as people left them.

use serde::{Deserialize, Serialize};

/// Panels as people left them in one kind of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PanelLayout {
    /// Whether the column at the right is open; by the window's size if the user never said.
    pub side_open: Option<bool>,
    /// Whether the plots are open, if people said so.
    pub plots_open: Option<bool>,
    /// Width of the column, points, if people changed it.
    pub side_width: Option<f32>,
    /// Height of the plots, points, if people changed it.
    pub plots_height: Option<f32>,
    /// Height of the prediction's strip, points, if people changed it.
    pub strip_height: Option<f32>,
}
