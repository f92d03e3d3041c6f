//! Detection statistics of landmarks that were measured.
//!
//! A measurement is told only while the plan is flown as it was measured: over that map, with that camera and those
//! settings, from about that height. Those of other heights and settings stay until another takes their place.

use pilotage_core::sorting::sort;
use std::collections::VecDeque;

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{DetectionStatistics, Envelope, ExpectedDetection};

use super::kept::{MEASURED_KEY, basis_now, basis_of, use_what_is_true};
use super::untested::is_about;
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
    /// Measurements of a landmark from one height each, all on its basis.
    measured: ShortMap<u32, Vec<MeasuredLandmark>>,
    /// The height around which landmarks were looked at, and the envelopes.
    envelopes: ShortMap<u32, (Landmark, f64, Envelope)>,
    wants_envelope: Option<AssessmentOrder>,
    surveyed: Option<(JobId, AssessmentOrder)>,
    /// Why a landmark could not be measured.
    failed: ShortMap<u32, FailedMeasurement>,
    waiting: VecDeque<AssessmentOrder>,
    asked: Option<(JobId, AssessmentOrder)>,
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
    /// Basis of the measurements of a landmark, and whether it is that of the plan.
    bases: ShortMap<u32, (MeasurementBasis, bool)>,
    /// Basis of measurements that would be made now, and the height that is planned with, metres.
    planned: Option<(MeasurementBasis, f64)>,
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
    /// The height from which it does not fit into a picture, metres, if that is why.
    misfit: Option<f64>,
}

impl FailedMeasurement {
    /// Failure of what was ordered.
    fn new(order: &AssessmentOrder, why: &str, misfit: Option<f64>) -> Self {
        Self {
            landmark: order.landmark.clone(),
            why: why.to_owned(),
            misfit,
        }
    }
}

/// Whether both are the same patch, looked at in the same way by the same detector.
pub fn same(a: &Landmark, b: &Landmark) -> bool {
    (a.bounds, a.reference, a.height) == (b.bounds, b.reference, b.height)
        && a.detector_in_use() == b.detector_in_use()
}

/// Difference of heights from which on they are two, metres.
const OTHER_HEIGHT: f64 = 1.0;

/// Has measurements of one landmark tell all heights.
fn join(measured: &mut [MeasuredLandmark]) {
    let lasts = measured.iter().map(|m| (m.last.height, m.last.expected));
    let mut by_height: Vec<(f64, ExpectedDetection)> = lasts.collect();
    for known in measured.iter().flat_map(|m| &m.statistics.by_height) {
        let is_another = |(height, _): &(f64, _)| (height - known.0).abs() > OTHER_HEIGHT;
        if by_height.iter().all(is_another) {
            by_height.push(*known);
        }
    }
    sort(&mut by_height, &|a, b| a.0.total_cmp(&b.0));
    for one in measured {
        one.statistics.by_height.clone_from(&by_height);
    }
}

impl Assessments {
    /// Measurement of a landmark that is true of the plan: of that box, with the camera and the settings of now, and from
    /// the height nearest to the planned one, which is about that.
    pub fn of(&self, landmark: &Landmark) -> Option<&MeasuredLandmark> {
        let planned = self.planned_height(landmark.id)?;
        let off = |m: &MeasuredLandmark| (m.last.height - planned).abs();
        let all = self.measured.get(&landmark.id)?.iter();
        let near =
            all.filter(|m| same(&m.last.landmark, landmark) && is_about(m.last.height, planned));
        near.min_by(|a, b| off(a).total_cmp(&off(b)))
    }

    /// Whether there are measurements of a landmark, of now or from other heights or by other settings.
    pub fn has_any(&self, landmark: &Landmark) -> bool {
        self.all_of(landmark).next().is_some()
    }

    fn all_of(&self, landmark: &Landmark) -> impl Iterator<Item = &MeasuredLandmark> {
        let known = self.measured.get(&landmark.id).into_iter().flatten();
        known.filter(|m| same(&m.last.landmark, landmark))
    }

    /// The height that is planned with, metres, if measurements of a landmark were made as they would be now.
    fn planned_height(&self, landmark: u32) -> Option<f64> {
        let (_, is_of_now) = self.bases.get(&landmark)?;
        let (_, height) = self.planned.as_ref()?;
        is_of_now.then_some(*height)
    }

    /// Tells only what is true of the plan as it is now, which is flown at `height` metres above ground.
    pub fn keep_to(&mut self, documents: &Documents, height: f64) {
        let now = basis_now(documents);
        let before = self.planned.as_ref().map(|(basis, _)| basis);
        if now.as_ref() != before {
            self.bases.retain(|(basis, is_of_now)| {
                *is_of_now = now.as_ref().is_some_and(|now| basis.is_like(now));
                true
            });
        }
        self.planned = now.map(|basis| (basis, height));
    }

    /// Failure of the measurement of a landmark that is true of the plan: from higher up it may fit into a picture.
    fn failure(&self, landmark: &Landmark) -> Option<&FailedMeasurement> {
        let planned = self.planned_height(landmark.id)?;
        let known = self.failed.get(&landmark.id);
        known.filter(|it| {
            same(&it.landmark, landmark) && it.misfit.is_none_or(|height| planned <= height)
        })
    }

    /// Why it could not be measured.
    pub fn trouble(&self, landmark: &Landmark) -> Option<&str> {
        self.failure(landmark).map(|it| it.why.as_str())
    }

    /// Whether a landmark is not measured as it does not fit into a picture from the planned height.
    pub fn is_misfit(&self, landmark: &Landmark) -> bool {
        let failure = self.failure(landmark);
        self.of(landmark).is_none() && failure.is_some_and(|it| it.misfit.is_some())
    }

    /// Expected detections of a landmark as it was measured: one that does not fit into a picture is never found; `None`
    /// of one that nobody measured.
    pub fn expected(&self, landmark: &Landmark) -> Option<DetectionStatistics> {
        let measured = self.of(landmark).map(|it| it.statistics.clone());
        let misfit = || self.is_misfit(landmark).then(DetectionStatistics::default);
        measured.or_else(misfit)
    }

    /// The height that was planned with when it was looked at from others, metres, and from where it is
    /// found, as far as that is known.
    pub fn envelope(&self, landmark: &Landmark) -> Option<(f64, &Envelope)> {
        self.planned_height(landmark.id)?;
        self.envelope_of(landmark)
    }

    fn envelope_of(&self, landmark: &Landmark) -> Option<(f64, &Envelope)> {
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
        let (_, order) = self.asked.as_ref()?;
        Some((order.landmark.id, self.progress.0, self.progress.1.as_str()))
    }

    /// Numbers of landmarks that are done and of all, while several are measured.
    pub fn batch(&self) -> Option<(usize, usize)> {
        let left = self.waiting.len() + usize::from(self.asked.is_some() && !self.is_ahead);
        (left > 0).then(|| (self.batch.saturating_sub(left), self.batch))
    }

    /// Number of landmarks of which a measurement is true of the plan.
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
            let is_it = |(_, of): &(_, AssessmentOrder)| of.landmark.id == id;
            let asked = !self.is_ahead && self.asked.as_ref().is_some_and(is_it);
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
        self.base_on(landmark, basis_of(context.documents, &order));
        self.failed.remove(&landmark);
        let boxed = Box::new(order.clone());
        let id = context.start(if self.is_ahead {
            Job::AssessAhead(AssessAheadOrder(boxed))
        } else {
            Job::Assess(boxed)
        });
        self.asked = Some((id, order));
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

    /// Measurements of these landmarks, to be kept: one for each height.
    pub fn to_keep(&self, landmarks: &[Landmark]) -> Vec<KeptMeasurement> {
        let mut all = Vec::new();
        for landmark in landmarks {
            let Some((basis, _)) = self.bases.get(&landmark.id) else {
                continue;
            };
            let one = |measured, envelope| KeptMeasurement {
                basis: basis.clone(),
                landmark: landmark.clone(),
                measured,
                envelope,
            };
            let envelope = self.envelope_of(landmark);
            let mut envelope = envelope.map(|(height, of)| (height, of.clone()));
            for measured in self.all_of(landmark) {
                all.push(one(Some(measured.clone()), envelope.take()));
            }
            if envelope.is_some() {
                all.push(one(None, envelope));
            }
        }
        all
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
        self.base_on(id, Some(one.basis));
        // What was measured since is newer.
        if let Some(mut measured) = one.measured {
            measured.last.landmark = landmark.clone();
            let height = measured.last.height;
            let is_there = |m: &MeasuredLandmark| (m.last.height - height).abs() <= OTHER_HEIGHT;
            if !self.all_of(landmark).any(is_there) {
                self.put(measured);
            }
        }
        if let Some((height, envelope)) = one.envelope
            && self.envelope_of(landmark).is_none()
        {
            let known = (landmark.clone(), height, envelope);
            self.envelopes.insert(id, known);
        }
        self.changed = true;
    }

    /// Puts a measurement beside those from other heights.
    fn put(&mut self, measured: MeasuredLandmark) {
        let landmark = &measured.last.landmark;
        let id = landmark.id;
        let mut all = self.measured.remove(&id).unwrap_or_default();
        all.retain(|m| {
            let is_another = (m.last.height - measured.last.height).abs() > OTHER_HEIGHT;
            same(&m.last.landmark, landmark) && is_another
        });
        all.push(measured);
        join(&mut all);
        self.measured.insert(id, all);
        self.changed = true;
    }

    /// Notes the basis of the measurements of a landmark; of measurements on another basis nothing stays.
    fn base_on(&mut self, landmark: u32, basis: Option<MeasurementBasis>) {
        let before = self.bases.remove(&landmark);
        let is_like =
            |basis: &MeasurementBasis| before.as_ref().is_some_and(|b| b.0.is_like(basis));
        if !basis.as_ref().is_some_and(is_like) {
            self.measured.remove(&landmark);
            self.envelopes.remove(&landmark);
        }
        if let Some(basis) = basis {
            let now = self.planned.as_ref();
            let is_of_now = now.is_some_and(|(now, _)| basis.is_like(now));
            self.bases.insert(landmark, (basis, is_of_now));
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
            let basis = basis_of(context.documents, &order);
            self.base_on(order.landmark.id, basis);
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
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        if let Some((_, order)) = self.surveyed.take_if(|(asked, _)| *asked == id) {
            return self.survey_event(order, id, event);
        }
        let Some((_, order)) = self.asked.take_if(|(asked, _)| *asked == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(fraction, words) => self.progress = (*fraction, words.clone()),
            JobEvent::Assessment(found) => self.keep(found),
            JobEvent::Misfit => {
                let failed = FailedMeasurement::new(&order, &order.misfit(), Some(order.height));
                self.failed.insert(order.landmark.id, failed);
            }
            JobEvent::Failed(why) => {
                let id = order.landmark.id;
                let misfit = self.failed.get(&id).and_then(|it| it.misfit);
                let failed = FailedMeasurement::new(&order, why, misfit);
                self.failed.insert(id, failed);
                return true;
            }
            JobEvent::Finished | JobEvent::Cancelled => return true,
            _ => {
                self.asked = Some((id, order));
                return false;
            }
        }
        self.asked = Some((id, order));
        true
    }

    fn survey_event(&mut self, order: AssessmentOrder, id: JobId, event: &JobEvent) -> bool {
        let landmark = order.landmark.clone();
        match event {
            JobEvent::Progress(share, _) => self.survey_progress = *share,
            JobEvent::Envelope(envelope) => {
                let known = (landmark.clone(), order.height, envelope.as_ref().clone());
                self.envelopes.insert(landmark.id, known);
            }
            JobEvent::Failed(why) => {
                let failed = FailedMeasurement::new(&order, why, None);
                self.failed.insert(landmark.id, failed);
                return true;
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.changed = true;
                return true;
            }
            _ => {
                self.surveyed = Some((id, order));
                return false;
            }
        }
        self.surveyed = Some((id, order));
        true
    }

    fn keep(&mut self, found: &Assessment) {
        self.put(MeasuredLandmark {
            last: found.clone(),
            statistics: found.statistics(),
        });
    }
}
