//! The question whether a step was dead reckoning, and by which aids it was not.

use super::{AidInfo, StepReport};

impl StepReport {
    /// Aids that told the place in this step and were believed.
    pub fn placed_by(&self) -> impl Iterator<Item = &'static AidInfo> {
        let accepted = self.updates.iter().filter(|update| update.is_accepted());
        let known = accepted.filter_map(|update| AidInfo::named(&update.aid).ok());
        known.filter(|info| info.tells_place)
    }

    /// Whether anything told the place in this step and was believed; it is dead reckoning otherwise.
    pub fn is_placed(&self) -> bool {
        self.corrected() || self.placed_by().next().is_some()
    }
}
