//! Worth of landmarks that nobody tested: that of boxes at random on the map that is open.

use pilotage_core::plan::{ExpectedDetection, UntestedDetection};

use crate::feature::FeatureContext;
use pilotage_jobs::{Job, JobEvent, JobId, UntestedOrder};

/// Share by which a height or a size may be another before boxes and landmarks are looked at again.
const ALIKE: f64 = 0.25;

/// Whether what was found at a height or of a size is told of another one.
pub fn is_about(found: f64, planned: f64) -> bool {
    (found / planned - 1.0).abs() < ALIKE
}

/// Statement about the map that is open, and the question being asked.
#[derive(Debug)]
pub struct Untested {
    stated: UntestedDetection,
    of: Option<UntestedOrder>,
    asked: Option<JobId>,
}

impl Default for Untested {
    fn default() -> Self {
        Self {
            stated: UntestedDetection::of_any_map(),
            of: None,
            asked: None,
        }
    }
}

/// Whether a statement about `a` holds for `b`, too.
fn holds(a: &UntestedOrder, b: &UntestedOrder) -> bool {
    let (of, like) = (&a.like, &b.like);
    of.map == like.map
        && of.camera == like.camera
        && of.navigator.detector == like.navigator.detector
        && of.navigator.sensors == like.navigator.sensors
        && is_about(of.height, like.height)
        && is_about(of.landmark.bounds.width(), like.landmark.bounds.width())
        && a.within.overlaps(&b.within)
}

impl Untested {
    /// Expected detection of a landmark that nobody tested.
    pub fn expected(&self) -> ExpectedDetection {
        self.stated.expected
    }

    /// Statement in words that go on behind "counted like".
    pub fn words(&self) -> String {
        let found = 100.0 * self.stated.expected.probability();
        match self.stated.boxes {
            0 => format!("a box at random on fields, found in {found:.0} % of pictures"),
            boxes => format!(
                "a box at random on this map, found in {found:.0} % of pictures ({boxes} were tried)"
            ),
        }
    }

    /// Whether something is known that may be of another plan.
    pub fn is_known(&self) -> bool {
        self.asked.is_none() && self.of.is_some()
    }

    /// Forgets what is of another plan than `order`, where nobody may ask anew.
    pub fn keep_to(&mut self, order: &UntestedOrder) {
        let is_other = |of: &UntestedOrder| !holds(of, order);
        if self.asked.is_none() && self.of.as_ref().is_some_and(is_other) {
            *self = Self::default();
        }
    }

    /// Asks about a map once it must be known.
    pub fn work(&mut self, order: Option<UntestedOrder>, context: &mut FeatureContext<'_>) {
        let of = self.of.as_ref();
        let is_of_another = of.is_some_and(|of| of.like.map != context.documents.map.source);
        if is_of_another {
            if let Some(id) = self.asked.take() {
                context.cancel(id);
            }
            *self = Self::default();
        }
        let Some(order) = order.filter(|_| self.asked.is_none()) else {
            return;
        };
        if self.of.as_ref().is_none_or(|of| !holds(of, &order)) {
            self.asked = Some(context.start(Job::Untested(order.clone())));
            self.of = Some(order);
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        if self.asked != Some(id) {
            return false;
        }
        match event {
            JobEvent::Untested(stated) => self.stated = **stated,
            // Of a map on which nothing can be tried nothing better is known.
            JobEvent::Failed(_) => self.stated = UntestedDetection::of_any_map(),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if event.is_last() {
            self.asked = None;
        }
        true
    }

    /// Statement for journeys: the probability of being found in a picture, and the boxes on which it rests.
    pub fn json(&self) -> serde_json::Value {
        serde_json::json!([self.stated.expected.probability(), self.stated.boxes])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::camera::CameraModel;
    use pilotage_core::frames::{GroundPoint, GroundRect};
    use pilotage_core::navigator::NavigatorSettings;
    use pilotage_jobs::{AssessmentOrder, MapSource};

    fn order(change: impl FnOnce(&mut AssessmentOrder)) -> UntestedOrder {
        let mut like = AssessmentOrder {
            map: MapSource::world("countryside"),
            landmark: UntestedOrder::usual_box(30.0),
            camera: CameraModel::pinhole(640, 480, 1.0),
            height: 120.0,
            navigator: NavigatorSettings::default(),
            ground_down: 0.0,
            seed: AssessmentOrder::SEED,
        };
        change(&mut like);
        let map = GroundRect::centered(GroundPoint::default(), 3000.0, 3000.0);
        UntestedOrder::around(like, &map, [])
    }

    #[test]
    fn boxes_tell_of_plans_that_look_at_the_ground_like_that() {
        let of = order(|_| ());
        assert!(holds(&of, &order(|like| like.height = 140.0)));
        assert!(!holds(&of, &order(|like| like.height = 200.0)));
        let shakier = order(|like| like.navigator.sensors.roll *= 2.0);
        assert!(!holds(&of, &shakier));
        let stricter = order(|like| like.navigator.detector.least_score += 0.1);
        assert!(!holds(&of, &stricter));
        // Where nobody asks anew, what is of another plan is forgotten.
        let mut untested = Untested {
            of: Some(of.clone()),
            ..Untested::default()
        };
        untested.stated.boxes = 24;
        untested.keep_to(&of);
        assert_eq!(untested.stated.boxes, 24);
        untested.keep_to(&shakier);
        assert_eq!(untested.stated.boxes, 0);
    }
}
