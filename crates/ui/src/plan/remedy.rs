//! Remedies of the worst stretch of a route: a landmark, more height, another line; by their figures.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{DetectionStatistics, ExpectedDetection, RoutePrediction, Stretch};
use pilotage_core::simulate::Target;

use super::chart::sample_at;
use super::forecast::Forecast;
use super::words::distance_text;
use crate::documents::landmarks::POINT_SIDE;
use crate::feature::FeatureContext;
use crate::units::Units;
use pilotage_jobs::{Job, JobEvent, JobId, PredictionOrder};

/// Worlds of each comparison: the same ones for each, so that few tell.
const WORLDS: usize = 16;
/// Factor on the height that is tried.
const HIGHER: f64 = 1.25;
/// Share of the uncertainty that must go for a remedy to be called one.
const HELPS: f64 = 0.9;

/// The worst stretch, and what it would be with each remedy.
#[derive(Debug, Default)]
pub struct Remedies {
    /// The plan and the limit that it is about.
    of: Option<(PredictionOrder, f64)>,
    pub(super) worst: Option<Worst>,
    asked: Option<JobId>,
    /// Landmarks like which another one is expected to be found, in words.
    like: &'static str,
    /// Largest standard deviation on the stretch as planned, with a landmark, and higher, metres.
    sigmas: Vec<f64>,
}

/// A stretch and where it lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Worst {
    stretch: Stretch,
    /// Begin of the stretch: a fix there is of most use.
    pub(super) begin: GroundPoint,
    pub(super) end: GroundPoint,
}

impl Worst {
    fn of(prediction: &RoutePrediction) -> Option<Self> {
        let over = !prediction.over_limit.is_empty();
        let stretch = prediction.worst_stretch().filter(|_| over)?;
        let at = |distance| sample_at(&prediction.samples, distance).map(|s| s.position);
        Some(Self {
            begin: at(stretch.begin)?,
            end: at(stretch.end)?,
            stretch,
        })
    }

    /// Largest standard deviation of the longer axis on this stretch, metres.
    fn sigma(&self, prediction: &RoutePrediction) -> f64 {
        let s = &self.stretch;
        let on = prediction.samples.iter();
        let on = on.filter(|p| (s.begin - 1.0..=s.end + 1.0).contains(&p.distance));
        on.map(|p| p.corridor.sigma_major).fold(0.0, f64::max)
    }
}

impl Remedies {
    /// Asks for what is not known yet of the prediction on screen.
    ///
    /// `hoped` is what is expected of another landmark, and of whom that is known.
    pub fn work(
        &mut self,
        forecast: &Forecast,
        limit: f64,
        hoped: (ExpectedDetection, &'static str),
        context: &mut FeatureContext<'_>,
    ) {
        let Some(shown) = forecast.shown().filter(|_| forecast.is_fine()) else {
            self.forget(context);
            return;
        };
        let known = self.of.as_ref();
        if known.is_none_or(|(order, l)| *order != shown.order || *l != limit) {
            self.forget(context);
            self.of = Some((shown.order.clone(), limit));
            self.worst = Worst::of(&shown.prediction);
        }
        let Some(worst) = self.worst.filter(|_| self.asked.is_none()) else {
            return;
        };
        let mut order = PredictionOrder {
            worlds: WORLDS,
            ..shown.order.clone()
        };
        match self.sigmas.len() {
            0 => {}
            1 => {
                order.landmarks.push(imagined(worst.begin, hoped.0));
                self.like = hoped.1;
            }
            2 => {
                order.path.height *= HIGHER;
                let higher = |t: &Target| Target {
                    height: HIGHER * t.height,
                    ..*t
                };
                order.path.targets = order.path.targets.iter().map(higher).collect();
            }
            _ => return,
        }
        self.asked = Some(context.start(Job::Predict(Box::new(order))));
    }

    fn forget(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(id) = self.asked.take() {
            context.cancel(id);
        }
        (self.of, self.worst) = (None, None);
        self.sigmas.clear();
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        if self.asked != Some(id) {
            return false;
        }
        match (event, &self.worst) {
            (JobEvent::Prediction { prediction, .. }, Some(worst)) => {
                self.sigmas.push(worst.sigma(prediction));
            }
            (JobEvent::Failed(_), _) => {
                self.sigmas.push(f64::NAN);
                self.asked = None;
            }
            (JobEvent::Finished | JobEvent::Cancelled, _) => self.asked = None,
            (JobEvent::Progress(..), _) => {}
            _ => return false,
        }
        true
    }

    /// Largest standard deviation on the stretch with the landmark (1) or higher (2), metres.
    fn would_be(&self, which: usize) -> Option<f64> {
        let share = self.sigmas.get(which)? / self.sigmas.first()?;
        let sigma = share * self.worst?.stretch.sigma;
        sigma.is_finite().then_some(sigma)
    }

    /// Whether a landmark where the worst stretch begins was tried and mends it.
    pub(super) fn landmark_helps(&self) -> bool {
        let worst = self.worst.map(|worst| worst.stretch.sigma);
        let with = self.would_be(1);
        with.zip(worst)
            .is_some_and(|(with, worst)| with < HELPS * worst)
    }

    /// Remedies in sentences; none where nothing is to be mended.
    pub fn sentences(&self, units: Units) -> Vec<String> {
        let Some((worst, (order, _))) = self.worst.zip(self.of.as_ref()) else {
            return Vec::new();
        };
        let (factor, unit) = units.length();
        let short = |metres: f64| units.short(metres);
        let begin = distance_text(worst.stretch.begin, units);
        let mut list = Vec::new();
        if let Some(sigma) = self.would_be(1) {
            let like = self.like;
            list.push(if self.landmark_helps() {
                format!(
                    "To fix the worst stretch, add a landmark {begin} along the route, or before. Found like {like}, it \
                     makes the largest error there {} instead of {} (1σ).",
                    short(sigma),
                    short(worst.stretch.sigma)
                )
            } else {
                format!(
                    "A landmark {begin} along the route that is found like {like} would not mend the worst stretch."
                )
            });
        }
        if let Some(sigma) = self.would_be(2) {
            let height = format!("{:.0} {unit}", HIGHER * order.path.height * factor);
            list.push(if sigma < HELPS * worst.stretch.sigma {
                format!(
                    "At {height} above ground its largest error is {} (1σ), if landmarks are found as well from there.",
                    short(sigma)
                )
            } else {
                format!(
                    "Flying higher does not mend it: at {height} above ground its largest error is {} (1σ).",
                    short(sigma)
                )
            });
        }
        list
    }

    /// Result for journeys: the place, and the figures as planned, with a landmark, higher.
    pub fn json(&self) -> serde_json::Value {
        let place = self.worst.map(|w| [w.begin.north, w.begin.east]);
        serde_json::json!({"place": place, "sigmas": self.sigmas})
    }
}

/// A landmark that is not there, and what would be expected of it.
fn imagined(at: GroundPoint, expected: ExpectedDetection) -> (Landmark, DetectionStatistics) {
    let bounds = GroundRect::centered(at, POINT_SIDE, POINT_SIDE);
    let landmark = Landmark::new(u32::MAX, "a landmark here", bounds);
    (landmark, DetectionStatistics::everywhere(expected))
}
