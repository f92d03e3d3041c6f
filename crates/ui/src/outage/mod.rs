//! Satellite navigation cut out of a flight: what would have been known of its position all the same.

mod chart;
mod panel;
mod wind;

pub(crate) use chart::colour;
pub use panel::{OutageScene, cut_panel};

use pilotage_jobs::{OutageReport, StudyReport};

/// Something to do about a cut.
#[derive(Clone, Debug, PartialEq)]
pub enum OutageCommand {
    /// Show it.
    Show,
    /// Cut satellite navigation out of the selected stretch of time.
    Selected,
    /// Cut it out of this stretch, seconds in the flight's time base.
    Of(f64, f64),
    /// Cut it again and again, for so many seconds each.
    Study(f64),
    /// Let go of the cut.
    Clear,
}

/// Results of cuts, until another flight is opened.
#[derive(Clone, Debug, Default)]
pub struct Outages {
    /// The cut that is shown.
    pub report: Option<OutageReport>,
    /// Outages all along the flight.
    pub study: Option<StudyReport>,
    /// Why there is none.
    pub trouble: Option<String>,
    /// Computation under way, in words.
    pub at_work: Option<String>,
}
