//! The scene of the sheet of photos: its data, and the list that takes its commands.

use super::PhotosCommand;
use super::state::PhotosState;
use crate::command::Command;
use crate::context::ViewContext;

/// Data that the sheet is drawn from.
pub(super) struct PhotosScene<'a> {
    /// Photos on the map.
    pub photos: &'a PhotosState,
    /// World frame of the map, if it has a place on the globe.
    pub frame: Option<pilotage_core::frames::LocalFrame>,
    /// Whether there is a map.
    pub has_map: bool,
    /// Whether the photos were laid on another one than that.
    pub are_of_another_map: bool,
}

/// Asks for something about photos.
pub(super) fn send(context: &mut ViewContext<'_>, what: PhotosCommand) {
    context.commands.push(Command::from(what));
}
