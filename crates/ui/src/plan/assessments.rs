//! Detection statistics of landmarks that were measured.

use pilotage_core::sorting::sort;
use std::collections::VecDeque;

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{DetectionStatistics, Envelope};

use super::kept::{MEASURED_KEY, basis_of, use_what_is_true};
use crate::documents::Documents;
use crate::feature::FeatureContext;
use crate::host::Host;
use crate::short_map::ShortMap;
use pilotage_jobs::{
    AssessAheadOrder, Assessment, AssessmentOrder, EnvelopeOrder, FirstSeconds, Job, JobEvent,
    JobId, KeptMeasurement, MapSource, MeasuredLandmark, MeasurementBasis,
};

/// Landmark ids being measured, and what came of it.
#[derive(Debug, Default)]
pub struct Assessments {
    measured: ShortMap<u32, MeasuredLandmark>,
    /// The height around which landmarks were looked at, and the envelopes.
    envelopes: ShortMap<u32, (Landmark, f64, Envelope)>,
    wants_envelope: Option<AssessmentOrder>,
    surveyed: Option<(JobId, AssessmentOrder)>,
    /// Why a landmark could not be measured.
    failed: ShortMap<u32, FailedMeasurement>,
    waiting: VecDeque<AssessmentOrder>,
    asked: Option<(JobId, u32)>,
    /// Failure of the measurement under way should the landmark not fit into a picture.
    misfit: String,
    /// Whether nobody asked for the measurement under way.
    is_ahead: bool,
    /// Progress of the measurement under way, 0 to 1, and its words.
    progress: (f32, String),
    /// Progress of the looks from other heights, 0 to 1.
    pub survey_progress: f32,
    /// Number of measurements that were asked for in one go.
    batch: usize,
    /// The map that all of it is about.
    map: Option<MapSource>,
    /// Basis of the measurements of a landmark.
    bases: ShortMap<u32, MeasurementBasis>,
    /// Measurements of an earlier visit or out of a mission file that are not true of what is open.
    recalled: Vec<KeptMeasurement>,
    /// Whether there is something new to be stored.
    changed: bool,
    /// Whether to stop as soon as a host is at hand.
    pub wants_stop: bool,
}

/// A landmark that could not be measured.
#[derive(Debug)]
struct FailedMeasurement {
    landmark: Landmark,
    why: String,
    /// Whether it does not fit into a picture.
    is_misfit: bool,
}

impl FailedMeasurement {
    /// Failure of a measurement, which is `misfit` should the landmark not fit into a picture.
    fn new(landmark: &Landmark, why: &str, misfit: &str) -> Self {
        Self {
            landmark: landmark.clone(),
            why: why.to_owned(),
            is_misfit: why == misfit,
        }
    }
}

/// Whether both are the same patch, looked at in the same way by the same detector.
pub fn same(a: &Landmark, b: &Landmark) -> bool {
    (a.bounds, a.reference, a.height) == (b.bounds, b.reference, b.height)
        && a.detector_in_use() == b.detector_in_use()
}

impl Assessments {
    /// Measurement of a landmark, while its box is still the same.
    pub fn of(&self, landmark: &Landmark) -> Option<&MeasuredLandmark> {
        let known = self.measured.get(&landmark.id);
        known.filter(|m| same(&m.last.landmark, landmark))
    }

    /// Why it could not be measured.
    pub fn trouble(&self, landmark: &Landmark) -> Option<&str> {
        let known = self.failed.get(&landmark.id);
        known
            .filter(|it| same(&it.landmark, landmark))
            .map(|it| it.why.as_str())
    }

    /// Expected detections of a landmark as it was measured: one that does not fit into a picture is never found; `None`
    /// of one that nobody measured.
    pub fn expected(&self, landmark: &Landmark) -> Option<DetectionStatistics> {
        if let Some(measured) = self.of(landmark) {
            return Some(measured.statistics.clone());
        }
        let failed = self.failed.get(&landmark.id)?;
        (failed.is_misfit && same(&failed.landmark, landmark)).then(DetectionStatistics::default)
    }

    /// The height that was planned with when it was looked at from others, metres, and from where it is
    /// found, as far as that is known.
    pub fn envelope(&self, landmark: &Landmark) -> Option<(f64, &Envelope)> {
        let known = self.envelopes.get(&landmark.id);
        let (_, height, envelope) = known.filter(|(of, ..)| same(of, landmark))?;
        Some((*height, envelope))
    }

    /// The landmark that is being looked at from other heights.
    pub fn surveyed(&self) -> Option<u32> {
        self.surveyed.as_ref().map(|(_, order)| order.landmark.id)
    }

    /// Looks at a landmark from other heights and with other tilts.
    pub fn survey(&mut self, order: Option<AssessmentOrder>) {
        self.wants_envelope = order;
    }

    /// The landmark being measured, and how far that is.
    pub fn under_way(&self) -> Option<(u32, f32, &str)> {
        let (_, landmark) = self.asked?;
        Some((landmark, self.progress.0, self.progress.1.as_str()))
    }

    /// Numbers of landmarks that are done and of all, while several are measured.
    pub fn batch(&self) -> Option<(usize, usize)> {
        let left = self.waiting.len() + usize::from(self.asked.is_some() && !self.is_ahead);
        (left > 0).then(|| (self.batch.saturating_sub(left), self.batch))
    }

    /// Number of landmarks that were measured and still are as they were.
    pub fn count(&self, landmarks: &[Landmark]) -> usize {
        landmarks.iter().filter(|l| self.of(l).is_some()).count()
    }

    /// Measures these, after those already asked for.
    pub fn ask(&mut self, orders: Vec<AssessmentOrder>) {
        if self.batch().is_none() {
            self.batch = 0;
        }
        for order in orders {
            let id = order.landmark.id;
            self.failed.remove(&id);
            let asked = !self.is_ahead && self.asked.is_some_and(|(_, of)| of == id);
            if !asked && self.waiting.iter().all(|o| o.landmark.id != id) {
                self.waiting.push_back(order);
                self.batch += 1;
            }
        }
    }

    /// Whether nothing is being measured.
    pub fn is_idle(&self) -> bool {
        self.asked.is_none() && self.waiting.is_empty()
    }

    /// Measures a landmark for which nobody asked; whatever people ask for takes its place.
    pub fn measure_ahead(&mut self, order: AssessmentOrder, context: &mut FeatureContext<'_>) {
        self.is_ahead = true;
        self.begin(order, context);
    }

    fn begin(&mut self, order: AssessmentOrder, context: &mut FeatureContext<'_>) {
        let landmark = order.landmark.id;
        self.progress = (0.0, "Waiting for a worker".to_owned());
        self.note_basis(context.documents, &order);
        self.misfit = order.misfit();
        let order = Box::new(order);
        let id = context.start(if self.is_ahead {
            Job::AssessAhead(AssessAheadOrder(order))
        } else {
            Job::Assess(order)
        });
        self.asked = Some((id, landmark));
    }

    /// Stops measuring; what is known stays.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) {
        self.waiting.clear();
        self.wants_envelope = None;
        let asked = self.asked.take().map(|(id, _)| id);
        let surveyed = self.surveyed.take().map(|(id, _)| id);
        for id in asked.into_iter().chain(surveyed) {
            context.cancel(id);
        }
    }

    /// Forgets everything: another map is shown.
    pub fn clear(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        self.measured.clear();
        self.envelopes.clear();
        self.bases.clear();
        self.failed.clear();
    }

    /// Takes what was stored at an earlier visit or is shipped with the page, for use where it is true.
    pub fn recall(&mut self, host: &dyn Host) {
        let keys = [MEASURED_KEY, FirstSeconds::MEASURED_KEY];
        let stored = keys.into_iter().filter_map(|key| host.recall(key));
        self.recalled = stored
            .flat_map(|bytes| KeptMeasurement::decode_all(&bytes))
            .collect();
    }

    /// Takes what came in a mission file, for use where it is true.
    pub fn adopt(&mut self, kept: Vec<KeptMeasurement>) {
        self.recalled = kept;
    }

    /// Measurements of these landmarks, to be kept.
    pub fn to_keep(&self, landmarks: &[Landmark]) -> Vec<KeptMeasurement> {
        let known = landmarks.iter().filter_map(|landmark| {
            Some(KeptMeasurement {
                basis: self.bases.get(&landmark.id).cloned()?,
                landmark: landmark.clone(),
                measured: self.of(landmark).cloned(),
                envelope: self.envelope(landmark).map(|(h, e)| (h, e.clone())),
            })
        });
        known
            .filter(|one| one.measured.is_some() || one.envelope.is_some())
            .collect()
    }

    /// Uses what was recalled and is true, and stores what is new.
    fn remember(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        if !self.recalled.is_empty() {
            let mut recalled = std::mem::take(&mut self.recalled);
            use_what_is_true(&mut recalled, documents, |one, landmark| {
                self.take_back(one, landmark);
            });
            self.recalled = recalled;
        }
        if std::mem::take(&mut self.changed) {
            context.host.store(
                MEASURED_KEY,
                &KeptMeasurement::encode_all(&self.to_keep(&documents.mission.landmarks)),
            );
        }
    }

    fn take_back(&mut self, one: KeptMeasurement, landmark: &Landmark) {
        let id = landmark.id;
        // What was measured since is newer.
        if self.of(landmark).is_some() || self.envelope(landmark).is_some() {
            return;
        }
        if let Some(mut measured) = one.measured {
            measured.last.landmark = landmark.clone();
            self.measured.insert(id, measured);
        }
        if let Some((height, envelope)) = one.envelope {
            let known = (landmark.clone(), height, envelope);
            self.envelopes.insert(id, known);
        }
        self.bases.insert(id, one.basis);
        self.changed = true;
    }

    /// Notes the basis of measurements on `order`; of measurements on another basis nothing stays.
    fn note_basis(&mut self, documents: &Documents, order: &AssessmentOrder) {
        let id = order.landmark.id;
        let basis = basis_of(documents, order);
        let before = self.bases.remove(&id);
        let is_like = |basis: &MeasurementBasis| before.as_ref().is_some_and(|b| b.is_like(basis));
        if !basis.as_ref().is_some_and(is_like) {
            self.measured.remove(&id);
            self.envelopes.remove(&id);
        }
        if let Some(basis) = basis {
            self.bases.insert(id, basis);
        }
    }

    /// Begins the next one.
    pub fn work(&mut self, context: &mut FeatureContext<'_>) {
        if self.map.as_ref() != Some(&context.documents.map.source) {
            self.clear(context);
            self.map = Some(context.documents.map.source.clone());
        }
        self.remember(context);
        if std::mem::take(&mut self.wants_stop) {
            self.stop(context);
        }
        if let Some(order) = self.wants_envelope.take() {
            if let Some((id, _)) = self.surveyed.take() {
                context.cancel(id);
            }
            self.failed.remove(&order.landmark.id);
            self.survey_progress = 0.0;
            self.note_basis(context.documents, &order);
            let id = context.start(Job::Envelope(EnvelopeOrder(Box::new(order.clone()))));
            self.surveyed = Some((id, order));
        }
        let gives_way = self.is_ahead && !self.waiting.is_empty();
        if let Some((id, _)) = self.asked.take_if(|_| gives_way) {
            context.cancel(id);
        }
        if self.asked.is_none()
            && let Some(order) = self.waiting.pop_front()
        {
            self.is_ahead = false;
            self.begin(order, context);
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent, landmarks: &[Landmark]) -> bool {
        if let Some((_, order)) = self.surveyed.take_if(|(asked, _)| *asked == id) {
            self.survey_event(order, id, event);
            return true;
        }
        let Some((_, landmark)) = self.asked.filter(|(asked, _)| *asked == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(fraction, words) => self.progress = (*fraction, words.clone()),
            JobEvent::Assessment(found) => self.keep(found),
            JobEvent::Failed(why) => {
                if let Some(of) = landmarks.iter().find(|l| l.id == landmark) {
                    let failed = FailedMeasurement::new(of, why, &self.misfit);
                    self.failed.insert(landmark, failed);
                }
                self.asked = None;
            }
            JobEvent::Finished | JobEvent::Cancelled => self.asked = None,
            _ => {}
        }
        true
    }

    fn survey_event(&mut self, order: AssessmentOrder, id: JobId, event: &JobEvent) {
        let landmark = order.landmark.clone();
        match event {
            JobEvent::Progress(share, _) => self.survey_progress = *share,
            JobEvent::Envelope(envelope) => {
                let known = (landmark.clone(), order.height, envelope.as_ref().clone());
                self.envelopes.insert(landmark.id, known);
            }
            JobEvent::Failed(why) => {
                let failed = FailedMeasurement::new(&landmark, why, &order.misfit());
                self.failed.insert(landmark.id, failed);
                return;
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.changed = true;
                return;
            }
            _ => {}
        }
        self.surveyed = Some((id, order));
    }

    fn keep(&mut self, found: &Assessment) {
        let id = found.landmark.id;
        let before = self.measured.remove(&id);
        let mut by_height = before
            .filter(|m| same(&m.last.landmark, &found.landmark))
            .map_or_else(Vec::new, |m| m.statistics.by_height);
        by_height.retain(|(height, _)| (height - found.height).abs() > 1.0);
        by_height.push((found.height, found.expected));
        sort(&mut by_height, &|a, b| a.0.total_cmp(&b.0));
        let measured = MeasuredLandmark {
            last: found.clone(),
            statistics: DetectionStatistics {
                by_height,
                ..found.statistics()
            },
        };
        self.measured.insert(id, measured);
        self.changed = true;
    }
}
