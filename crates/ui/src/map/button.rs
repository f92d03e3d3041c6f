//! Buttons that others put among the controls of the map.

use crate::command::Command;
use crate::shell::icons::Icon;

/// Button of a feature among the controls.
#[derive(Clone, Debug)]
pub struct MapButton {
    /// Sign.
    pub icon: Icon,
    /// Action in words.
    pub label: &'static str,
    /// Command that it gives.
    pub command: Command,
    /// Whether it is on.
    pub is_on: bool,
}
