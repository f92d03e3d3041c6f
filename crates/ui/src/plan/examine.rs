//! The selected landmark compared with the map around it, as far as a detector will look for it.

use pilotage_core::frames::GroundRect;

use super::planner::Planner;
use crate::documents::Documents;
use crate::feature::FeatureContext;
use pilotage_jobs::{DistinctnessOrder, Job, JobEvent, JobId};

/// Time for which a landmark must rest before it is examined, milliseconds.
const EXAMINE_AFTER: f64 = 120.0;
/// Change of the distance within which look-alikes count that is worth another look, metres.
const OTHER_RADIUS: f64 = 0.5;

impl Planner {
    /// Distance around a landmark within which the detector will look for it: that far look-alikes count,
    /// metres.
    pub(super) fn look_alike_radius(&self, documents: &Documents, bounds: &GroundRect) -> f64 {
        self.planned_with(documents).searched(bounds)
    }

    /// Whether a landmark was compared for another uncertainty of the position.
    fn is_examined_otherwise(&self, documents: &Documents, id: u32) -> bool {
        let is_in_vain = self.examination.trouble(id).is_some();
        let known = self.examination.distinctness(id, documents);
        let known = known.filter(|_| !is_in_vain);
        known.is_some_and(|d| {
            let radius = self.look_alike_radius(documents, &d.bounds);
            (d.radius - radius).abs() >= OTHER_RADIUS
        })
    }

    /// Examines the selected landmark once it rests; true if time must pass first.
    pub(super) fn examine(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let now = context.host.now();
        let documents = &*context.documents;
        let selected = context
            .selection
            .and_then(|id| documents.mission.landmark(id));
        let seen = selected.map(|landmark| (landmark.id, landmark.bounds));
        let is_other = self.examination.seen != seen;
        self.examination.seen = seen;
        let Some((id, bounds)) = seen else {
            self.examination.at = None;
            return false;
        };
        let waits = self.examination.job.is_some() || self.examination.at.is_some();
        if is_other || !waits && self.is_examined_otherwise(documents, id) {
            self.examination.at = Some(now + EXAMINE_AFTER);
        }
        if self.examination.at.is_none_or(|at| at > now) {
            return self.examination.at.is_some();
        }
        self.examination.at = None;
        let is_known = self.examination.distinctness(id, documents).is_some();
        let is_new = !is_known || self.is_examined_otherwise(documents, id);
        let radius = self.look_alike_radius(documents, &bounds);
        self.examination.try_again();
        if is_new {
            self.stop_examining(context);
            let map = context.documents.map.source.clone();
            let order = DistinctnessOrder {
                map: map.clone(),
                bounds,
                radius,
            };
            let job = context.start(Job::Distinctness(order));
            self.examination.begin(job, id, &map);
        }
        false
    }

    /// Stops the comparison under way.
    pub(super) fn stop_examining(&mut self, context: &mut FeatureContext<'_>) {
        if let Some((job, _)) = self.examination.job.take() {
            context.cancel(job);
        }
    }

    /// Takes what a worker says of the comparison; false if it is about something else.
    pub(super) fn examined(&mut self, id: JobId, event: &JobEvent) -> bool {
        let Some((_, landmark)) = self.examination.job.filter(|(job, _)| *job == id) else {
            return false;
        };
        match event {
            JobEvent::Distinctness(found) => self.examination.take(landmark, Ok((**found).clone())),
            JobEvent::Failed(why) => self.examination.take(landmark, Err(why.clone())),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if event.is_last() {
            self.examination.job = None;
        }
        true
    }
}
