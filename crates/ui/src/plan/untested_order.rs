//! Landmarks of the plan that nobody tested, and the question what they are worth.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;
use pilotage_core::plan::ExpectedDetection;
use pilotage_core::sorting::sort;

use super::planner::Planner;
use crate::documents::Documents;
use pilotage_jobs::UntestedOrder;

/// Tested landmarks from which on they tell what another one would be worth.
const LEAST_TESTED: usize = 3;
/// Side of a box where no landmark tells the usual size, metres.
const USUAL_SIDE: f64 = 30.0;

fn middle(mut values: Vec<f64>) -> Option<f64> {
    sort(&mut values, &|a, b| a.total_cmp(b));
    values.get(values.len() / 2).copied()
}

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
        let sides = mission.landmarks.iter().map(|it| it.bounds);
        let side = middle(sides.map(|b| (b.width() * b.height()).sqrt()).collect());
        let side = side.unwrap_or(USUAL_SIDE);
        let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), side, side);
        let like = self.assessment(&Landmark::new(0, "a box", bounds), documents);
        let landmarks = mission.landmarks.iter().map(|it| it.bounds.center());
        let way_points = documents
            .mission
            .selected_route()
            .map_or(&[][..], |r| &r.way_points);
        let places = landmarks.chain(way_points.iter().map(|w| w.position));
        Some(UntestedOrder::around(like, &map.bounds, places))
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
