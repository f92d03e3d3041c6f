//! Finding a route, as a job: the field, the search, and what is predicted of both routes.

use std::sync::Arc;

use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::terrain::Terrain as _;
use pilotage_core::plan::{
    Aim, Forbidden, FoundRoute, Localizability, OfferedField, RouteQuestion, RouteSearch, cruise,
    growth_before_first_fix,
};

use super::field::LOOKS_AWAY;
use super::order::{Order, Reads, Urgency, WorkerRole};
use super::running::slice;
use super::{
    Advance, FieldFrom, FindOrder, Foreseen, FoundPlan, HighGround, JobEvent, MapSource,
    RunningJob, WorkerState,
};

/// Cells along the longer side of the ground that is searched, at most.
const MOST_CELLS: f64 = 700.0;
/// Worlds of the two predictions.
const WORLDS: usize = 32;

impl Foreseen {
    /// Uncertainty that was to be least: the standard deviation (longer axis) at the worst place or in the
    /// mean, metres.
    fn uncertainty(&self, aim: Aim) -> f64 {
        match aim {
            Aim::Worst => self.worst_sigma(),
            Aim::Mean => self.mean_sigma(),
        }
    }
}

impl HighGround {
    fn forbidden(self) -> Forbidden {
        let is_too_high = move |place: &GroundPoint| {
            let height = self.heights.height_at(place);
            height.is_some_and(|height| height > self.highest)
        };
        Arc::new(is_too_high)
    }
}

enum FindStage {
    Field,
    Offer(Box<OfferedField>),
    Search(Box<RouteSearch>),
    Predict(Vec<FoundRoute>, Vec<Foreseen>),
}

/// A search under way.
pub struct FindRoute {
    order: FindOrder,
    stage: FindStage,
}

impl FindRoute {
    /// Nothing searched yet.
    pub fn new(order: FindOrder) -> Self {
        Self {
            order,
            stage: FindStage::Field,
        }
    }

    /// The field of the landmarks, or what the map offers as work to be done.
    fn begin(&self, worker: &mut WorkerState) -> Result<FindStage, String> {
        let field = &self.order.field;
        let pass = field.view.across().ok_or(LOOKS_AWAY)?;
        let sources = match &field.from {
            FieldFrom::Landmarks(sources) => sources.clone(),
            FieldFrom::Map {
                search_sigmas,
                days,
            } => {
                let offered = field.offered((*search_sigmas, *days), worker)?;
                return Ok(FindStage::Offer(Box::new(offered)));
            }
        };
        if sources.is_empty() {
            return Err(
                "no landmark is switched on that would be found from this height; draw some first"
                    .to_owned(),
            );
        }
        let region = field.region;
        let step = (pass / 6.0).max(region.width().max(region.height()) / MOST_CELLS);
        self.search(field.of_landmarks(sources, step))
    }

    fn search(&self, field: Localizability) -> Result<FindStage, String> {
        let order = &self.order;
        let pass = order.field.view.across().ok_or(LOOKS_AWAY)?;
        let usual = cruise();
        RouteSearch::new(RouteQuestion {
            from: order.from,
            to: order.to,
            field: Arc::new(field),
            pass,
            no_fly: order.no_fly.clone(),
            clearance: order.clearance,
            forbidden: order.high_ground.clone().map(HighGround::forbidden),
            airspeed: order.flight.path.airspeed.unwrap_or(usual),
            wind: order.flight.path.wind.velocity(),
            before_first_fix: growth_before_first_fix(&order.flight.navigator),
            turns: order.turns,
            budget: order.budget,
            budget_of: order.budget_of,
            aim: order.aim,
        })
        .map(|search| FindStage::Search(Box::new(search)))
        .map_err(|e| e.to_string())
    }
}

impl RunningJob for FindRoute {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        match &mut self.stage {
            FindStage::Field => {
                let words = "Where landmarks can be recognised".to_owned();
                emit(JobEvent::Progress(0.02, words));
                self.stage = self.begin(worker)?;
            }
            FindStage::Offer(offered) => {
                let more = slice(clock, || offered.advance());
                let (done, of) = offered.progress();
                let share = 0.7 * done as f32 / of.max(1) as f32;
                let words = format!("What the map offers: place {done} of {of}");
                emit(JobEvent::Progress(share, words));
                if !more {
                    let field = offered.field().clone();
                    self.stage = self.search(field)?;
                }
            }
            FindStage::Search(search) => {
                let more = slice(clock, || search.advance());
                let by_map = matches!(self.order.field.from, FieldFrom::Map { .. });
                let begin = if by_map { 0.7 } else { 0.05 };
                let share = begin + (0.75 - begin) * search.progress();
                let words = "Comparing ways from fix to fix".to_owned();
                emit(JobEvent::Progress(share, words));
                if !more {
                    let stage = std::mem::replace(&mut self.stage, FindStage::Field);
                    if let FindStage::Search(search) = stage {
                        let found = search.found().map_err(|e| e.to_string())?;
                        let both = vec![found.surest, found.shortest];
                        self.stage = FindStage::Predict(both, Vec::new());
                    }
                }
            }
            FindStage::Predict(left, done) => {
                if let Some(route) = left.pop() {
                    let share = 0.75 + 0.12 * done.len() as f32;
                    emit(JobEvent::Progress(share, "Predicting both".to_owned()));
                    let mut order = self.order.flight.clone();
                    order.path.way_points.clone_from(&route.way_points);
                    order.worlds = WORLDS;
                    let prediction = order.predict()?;
                    done.push(Foreseen { route, prediction });
                } else if let (Some(surest), Some(shortest)) = (done.pop(), done.pop()) {
                    // What the field promised is not always what is foreseen along the way.
                    let aim = self.order.aim;
                    // Of what the map offers, nothing is predicted before it is a landmark.
                    let by_map = matches!(self.order.field.from, FieldFrom::Map { .. });
                    let is_better = by_map || surest.uncertainty(aim) <= shortest.uncertainty(aim);
                    let surest = if is_better { surest } else { shortest.clone() };
                    let plan = FoundPlan { shortest, surest };
                    emit(JobEvent::FoundPlan(Box::new(plan)));
                    emit(JobEvent::Finished);
                    return Ok(Advance::Done);
                }
            }
        }
        Ok(Advance::More)
    }
}

impl Order for FindOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        self.field.files()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        self.field.reads()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(FindRoute::new(self))
    }
}
