//! The prediction on screen: a coarse one at once, a fine one as soon as the plan rests.

use pilotage_core::plan::RoutePrediction;

use crate::feature::FeatureContext;
use pilotage_jobs::{COARSE, FINE, Job, JobEvent, JobId, PredictionOrder};

/// Time for which a plan must rest before it is predicted finely, milliseconds.
const REST: f64 = 250.0;

/// A prediction under way.
#[derive(Debug)]
struct AskedPrediction {
    id: JobId,
    order: PredictionOrder,
    since: f64,
}

/// A prediction, and what it is of.
#[derive(Debug)]
pub struct ShownPrediction {
    /// The prediction, marked by the user's limit.
    pub prediction: RoutePrediction,
    /// Order of the prediction.
    pub order: PredictionOrder,
    /// Time until the prediction was here, milliseconds.
    pub took: f64,
}

/// Prediction that is shown, and the prediction under way.
#[derive(Debug, Default)]
pub struct Forecast {
    shown: Option<ShownPrediction>,
    /// Number of predictions that were shown or taken away so far.
    number: u64,
    /// Why nothing can be predicted.
    trouble: Option<String>,
    asked: Option<AskedPrediction>,
    /// The plan as it was last, and since when, milliseconds.
    plan: Option<(PredictionOrder, f64)>,
    limit: f64,
    /// Time until the last coarse prediction was here, and its computing time, milliseconds.
    coarse: Option<(f64, f64)>,
}

impl Forecast {
    /// The prediction on screen.
    pub fn shown(&self) -> Option<&ShownPrediction> {
        self.shown.as_ref()
    }

    /// Number of the prediction on screen, another one for each and for none.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Why nothing can be predicted.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Whether it is of the plan as it is now, with all worlds.
    pub fn is_fine(&self) -> bool {
        let fine = |s: &ShownPrediction| s.order.worlds == FINE && self.is_of_now(&s.order);
        self.shown.as_ref().is_some_and(fine)
    }

    /// Time until the last coarse prediction was here, and its computing time in the worker, milliseconds.
    pub fn coarse_took(&self) -> Option<(f64, f64)> {
        self.coarse
    }

    fn is_of_now(&self, order: &PredictionOrder) -> bool {
        self.plan.as_ref().is_some_and(|(plan, _)| {
            PredictionOrder {
                worlds: plan.worlds,
                ..order.clone()
            } == *plan
        })
    }

    /// Asks for what is missing; true if time must pass first.
    pub fn work(
        &mut self,
        plan: Option<PredictionOrder>,
        limit: f64,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let now = context.host.now();
        if self.limit != limit {
            self.limit = limit;
            if let Some(shown) = &mut self.shown {
                shown.prediction.mark(limit);
            }
        }
        let Some(plan) = plan else {
            self.forget(context);
            return false;
        };
        if self.plan.as_ref().is_none_or(|(before, _)| *before != plan) {
            self.plan = Some((plan.clone(), now));
            self.trouble = None;
        }
        let rested = self
            .plan
            .as_ref()
            .is_some_and(|(_, since)| now - since >= REST);
        if let Some(asked) = &self.asked {
            // A fine one that has become old is in the way of the next coarse one.
            if asked.order.worlds == FINE && !self.is_of_now(&asked.order) {
                context.cancel(asked.id);
                self.asked = None;
            } else {
                return false;
            }
        }
        let known = |worlds: usize| {
            let of_now = |s: &ShownPrediction| s.order.worlds >= worlds && self.is_of_now(&s.order);
            self.shown.as_ref().is_some_and(of_now)
        };
        if self.trouble.is_some() || known(FINE) {
            return false;
        }
        let worlds = if !known(COARSE) {
            COARSE
        } else if rested {
            FINE
        } else {
            return true;
        };
        let order = PredictionOrder { worlds, ..plan };
        let id = context.start(Job::Predict(Box::new(order.clone())));
        self.asked = Some(AskedPrediction {
            id,
            order,
            since: now,
        });
        false
    }

    fn forget(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(asked) = self.asked.take() {
            context.cancel(asked.id);
        }
        self.number += 1;
        self.shown = None;
        self.plan = None;
        self.trouble = None;
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(
        &mut self,
        id: JobId,
        event: &JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let Some(asked) = self.asked.take_if(|asked| asked.id == id) else {
            return false;
        };
        match event {
            JobEvent::Prediction {
                prediction,
                computed,
            } => {
                let mut prediction = prediction.as_ref().clone();
                prediction.mark(self.limit);
                context.wait_no_more(id);
                let took = context.host.now() - asked.since;
                if asked.order.worlds == COARSE {
                    self.coarse = Some((took, *computed));
                }
                self.number += 1;
                self.shown = Some(ShownPrediction {
                    prediction,
                    order: asked.order,
                    took,
                });
            }
            JobEvent::Failed(why) => {
                self.trouble = Some(why.clone());
                self.number += 1;
                self.shown = None;
            }
            JobEvent::Finished | JobEvent::Cancelled => {}
            JobEvent::Progress(..) => self.asked = Some(asked),
            _ => {
                self.asked = Some(asked);
                return false;
            }
        }
        true
    }
}
