//! Flights of a rehearsal: asked for, and what came of them.

use pilotage_core::plan::{PlanComparison, Verification};
use serde::{Deserialize, Serialize};

use super::drawn::{DrawnFlights, FlightsKey};
use crate::feature::FeatureContext;
use crate::plan::forecast::{Forecast, ShownPrediction};
use pilotage_jobs::{Job, JobEvent, JobId, MapSource, PredictionOrder, RehearseOrder, Rehearsed};

/// Most flights of a rehearsal.
pub const MOST_FLIGHTS: usize = 200;

/// Preferences of rehearsals.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RehearsalPreferences {
    /// Number of flights.
    pub flights: usize,
    /// Whether the camera takes pictures; otherwise landmarks are found as often and as well as predicted.
    pub pictures: bool,
}

impl Default for RehearsalPreferences {
    fn default() -> Self {
        Self {
            flights: 20,
            pictures: true,
        }
    }
}

/// A flight of a rehearsal, beside what was predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct RehearsedRoute {
    /// Seed of wind, day and sensors.
    pub seed: u64,
    /// Every frame beside the plan.
    pub frames: Vec<PlanComparison>,
    /// Largest error, metres, and its distance along the path, metres.
    pub worst: (f64, f64),
    /// Largest error across the course, to either side, metres.
    pub farthest: f64,
}

impl RehearsedRoute {
    fn new(seed: u64, flown: Rehearsed) -> Self {
        let frames = flown.frames;
        let worst = PlanComparison::worst(&frames);
        let worst = worst.map_or((0.0, 0.0), |it| (it.error(), it.distance));
        let across = frames.iter().map(|it| it.across.abs());
        Self {
            seed,
            worst,
            farthest: across.fold(0.0, f64::max),
            frames,
        }
    }
}

/// Plan that is rehearsed.
#[derive(Debug)]
struct RehearsedPlan {
    plan: PredictionOrder,
    map: MapSource,
    preferences: RehearsalPreferences,
}

/// A flight under way.
#[derive(Debug)]
struct UnderWay {
    job: JobId,
    seed: u64,
    progress: f32,
}

/// Rehearsal of the selected route.
#[derive(Debug, Default)]
pub struct RouteRehearsal {
    of: Option<RehearsedPlan>,
    under_way: Vec<UnderWay>,
    flown: Vec<RehearsedRoute>,
    /// All of `flown` together.
    summary: Verification,
    trouble: Option<String>,
    /// Id of the route whose flights are to begin as soon as it is predicted.
    wanted: Option<u32>,
    /// Number of a prediction, and whether it is of the plan that was flown.
    seen: Option<(u64, bool)>,
    /// Version of what was flown.
    version: u64,
    drawn: DrawnFlights,
}

impl RouteRehearsal {
    /// Asks for a rehearsal of a route, which begins once that is predicted.
    pub fn want(&mut self, route: u32) {
        self.wanted = Some(route);
    }

    /// Stops; what was flown stays.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) {
        self.wanted = None;
        for flight in self.under_way.drain(..) {
            context.cancel(flight.job);
        }
    }

    /// Stops, and forgets what was flown.
    pub fn forget(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        *self = Self {
            version: self.version + 1,
            ..Self::default()
        };
    }

    /// Begins what is wanted, stops flights of a plan that is another by now, and forgets those over another map; true if
    /// time must pass first.
    pub fn work(
        &mut self,
        forecast: &Forecast,
        preferences: &RehearsalPreferences,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        self.keep_to(context);
        self.look_at(forecast);
        if !self.is_of_now() && !self.under_way.is_empty() {
            self.stop(context);
        }
        let shown = forecast.shown().filter(|_| forecast.is_fine());
        let is_wanted = self.wanted.is_some();
        let Some(shown) = shown.filter(|_| is_wanted) else {
            return is_wanted && forecast.trouble().is_none();
        };
        self.begin(shown, preferences.clone(), context);
        self.look_at(forecast);
        false
    }

    /// Forgets what was flown over another map, and gives up what is wanted of a route that is selected no more.
    fn keep_to(&mut self, context: &mut FeatureContext<'_>) {
        let map = &context.documents.map.source;
        if self.of.as_ref().is_some_and(|of| of.map != *map) {
            let wanted = self.wanted;
            self.forget(context);
            self.wanted = wanted;
        }
        let selected = context.documents.mission.selected_route();
        let selected = selected.map(|route| route.id);
        if self.wanted.is_some() && self.wanted != selected {
            self.wanted = None;
            let text = "Another route was selected before it was predicted. Rehearse it again.";
            context.note("The route is not rehearsed", text);
        }
    }

    fn begin(
        &mut self,
        shown: &ShownPrediction,
        preferences: RehearsalPreferences,
        context: &mut FeatureContext<'_>,
    ) {
        self.forget(context);
        let map = context.documents.map.source.clone();
        let order = RehearseOrder {
            plan: shown.order.clone(),
            prediction: shown.prediction.clone(),
            map: map.clone(),
            as_stated: !preferences.pictures,
            seed: 0,
        };
        for seed in 1..=preferences.flights as u64 {
            let order = Box::new(RehearseOrder {
                seed,
                ..order.clone()
            });
            self.under_way.push(UnderWay {
                job: context.start(Job::Rehearse(order)),
                seed,
                progress: 0.0,
            });
        }
        self.of = Some(RehearsedPlan {
            plan: order.plan,
            map,
            preferences,
        });
    }

    /// Looks whether what was flown is the plan as it is predicted.
    fn look_at(&mut self, forecast: &Forecast) {
        let Some(of) = &self.of else { return };
        let number = forecast.number();
        if self.seen.is_some_and(|(seen, _)| seen == number) {
            return;
        }
        let is_same = |shown: &ShownPrediction| {
            let order = PredictionOrder {
                worlds: of.plan.worlds,
                ..shown.order.clone()
            };
            order == of.plan
        };
        let is_same = forecast.shown().is_some_and(is_same);
        self.seen = Some((number, is_same));
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        let Some(at) = self.under_way.iter().position(|it| it.job == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(share, _) => self.under_way[at].progress = *share,
            JobEvent::Figures(_) => match event.read_figures() {
                Ok(flown) => {
                    let seed = self.under_way[at].seed;
                    self.flown.push(RehearsedRoute::new(seed, flown));
                    self.version += 1;
                    let frames: Vec<_> = self.flown.iter().map(|it| &it.frames[..]).collect();
                    self.summary = Verification::of(&frames);
                }
                Err(why) => self.trouble = Some(why),
            },
            JobEvent::Failed(why) => self.trouble = Some(why.clone()),
            JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if event.is_last() {
            self.under_way.remove(at);
        }
        true
    }

    /// Whether what was flown is the plan as it is.
    pub fn is_of_now(&self) -> bool {
        self.seen.is_some_and(|(_, is_same)| is_same)
    }

    /// Flights that were flown.
    pub fn flown(&self) -> &[RehearsedRoute] {
        &self.flown
    }

    /// Version of the flights and number of the prediction beside which they are, and their drawings.
    pub(super) fn drawn(&self) -> (FlightsKey, &DrawnFlights) {
        let number = self.seen.map_or(0, |(number, _)| number);
        ((self.version, number), &self.drawn)
    }

    /// All flights together beside the prediction.
    pub fn summary(&self) -> &Verification {
        &self.summary
    }

    /// The flight that erred most.
    pub fn worst(&self) -> Option<&RehearsedRoute> {
        let flown = self.flown.iter();
        flown.max_by(|a, b| a.worst.0.total_cmp(&b.worst.0))
    }

    /// Preferences with which it is flown.
    pub fn preferences(&self) -> Option<&RehearsalPreferences> {
        self.of.as_ref().map(|of| &of.preferences)
    }

    /// Share that is flown, while flights are under way or awaited.
    pub fn progress(&self) -> Option<f32> {
        if self.wanted.is_some() {
            return Some(0.0);
        }
        let count = self.flown.len() + self.under_way.len();
        let under_way = self.under_way.iter().map(|it| it.progress).sum::<f32>();
        let share = (self.flown.len() as f32 + under_way) / count.max(1) as f32;
        (!self.under_way.is_empty()).then_some(share)
    }

    /// Why a flight failed.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }
}
