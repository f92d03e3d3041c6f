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
            _ => {}
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
