//! Photos laid on the map that is open, each by itself: what was asked, what came of each, which one is looked at.

mod state;

pub use state::{Photos, Shown, Sought};

use pilotage_core::flight::photo::PhotoSearch;

/// Something to do about photos on the map.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotosCommand {
    /// Show them.
    Show,
    /// Show something else.
    Close,
    /// Lay all of them on the map.
    Lay,
    /// Stop that; those that were laid stay.
    Stop,
    /// Look for them so from now on.
    Search(Box<PhotoSearch>),
    /// Look for them around the middle of what the map shows.
    AroundView,
    /// Look at one of them, by its number.
    Choose(usize),
    /// Show the chosen one on the map so.
    Display(Shown),
}
