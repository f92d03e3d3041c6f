//! Landmarks of the plan that nobody tested, and the question what they are worth.

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::ExpectedDetection;
use pilotage_core::sorting::sort;

use super::flown::flown_way;
use super::planner::Planner;
use crate::documents::Documents;
use pilotage_jobs::UntestedOrder;

/// Tested landmarks from which on they tell what another one would be worth.
const LEAST_TESTED: usize = 3;

impl Planner {
    /// Landmarks that are switched on and were not tested as they are.
    pub(super) fn untested_landmarks<'a>(
        &'a self,
        documents: &'a Documents,
    ) -> impl Iterator<Item = &'a Landmark> {
        let all = documents.mission.landmarks.iter();
        all.filter(|it| it.enabled && self.assessments.of(it).is_none())
    }

    /// Question about the map around what is planned; `None` while the map is missing or nothing is untested.
    pub(super) fn untested_order(&self, documents: &Documents) -> Option<UntestedOrder> {
        let map = documents.map.info.as_ref()?;
        self.untested_landmarks(documents).next()?;
        let mission = &documents.mission;
        let side = UntestedOrder::usual_side(mission)?;
        let like = self.assessment(&UntestedOrder::usual_box(side), documents);
        let route = mission.selected_route();
        let way = route.map(|route| flown_way(route, documents, self.preferences.bank));
        let places = way.map_or_else(Vec::new, |way| way.places);
        Some(UntestedOrder::of(mission, like, &map.bounds, places))
    }

    /// Expected detection of a landmark that is yet to be drawn: the middle one of those that were tested, for people
    /// choose alike, or else that of a box at random; and in words of whom.
    pub(super) fn hoped(&self, documents: &Documents) -> (ExpectedDetection, &'static str) {
        let landmarks = documents.mission.landmarks.iter();
        let tested = landmarks.filter_map(|it| Some(self.assessments.of(it)?.last.expected));
        let mut tested: Vec<ExpectedDetection> = tested.collect();
        sort(&mut tested, &|a, b| {
            a.probability().total_cmp(&b.probability())
        });
        match tested.get(tested.len() / 2) {
            Some(middle) if tested.len() >= LEAST_TESTED => (*middle, "the tested ones"),
            _ => (self.untested.expected(), "a box at random"),
        }
    }
}
