//! Dialogs over everything, open or not.

use crate::shell::Palette;

/// Open state of the dialogs.
#[derive(Debug, Default)]
pub(super) struct Dialogs {
    pub(super) palette: Palette,
    pub(super) help: bool,
    pub(super) notices: bool,
    pub(super) settings: bool,
}
