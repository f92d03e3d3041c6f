//! Rehearsal of a landmark on other days, a view after the other.

use std::sync::Arc;

use pilotage_core::imagery::Imagery;
use pilotage_core::plan::{Assessor, Circumstances, Rehearsal, ViewBreakdown, ViewResult};

use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole, around, keys_of};
use super::running::{SLICE, once};
use super::share::Shareable;
use super::{
    Advance, Assessment, AssessmentOrder, Glance, JobEvent, MapSource, RunningJob, Share,
    WorkerState,
};

impl AssessmentOrder {
    /// Words for the failure of a landmark that does not fit into a picture, which is therefore never found; the event
    /// `Misfit` goes before them.
    pub fn misfit(&self) -> String {
        format!(
            "{} does not fit into a picture from {:.0} m; make its box smaller or fly higher",
            self.landmark.name, self.height
        )
    }

    /// Prepares to look at the landmark on `days`.
    pub(super) fn assessor(
        &self,
        worker: &mut WorkerState,
        days: &[Arc<dyn Imagery>],
    ) -> Result<Assessor, String> {
        let map = worker.cached_map(&self.map)?;
        let circumstances = Circumstances {
            camera: self.camera.clone(),
            height: self.height,
            position: Rehearsal::POSITION,
            sensors: self.navigator.sensors,
            detector: self.navigator.detector,
            ground_down: self.ground_down,
            tilt: 0.0,
        };
        Ok(Assessor::new(
            &self.landmark,
            map,
            days,
            circumstances,
            self.seed,
        ))
    }
}

/// Assessment of a landmark by all its views, which are in the order of their looks.
pub fn sum_up(order: &AssessmentOrder, views: &[ViewResult]) -> Result<Assessment, String> {
    let expected = Rehearsal::expected(views).ok_or("there was nothing to look at")?;
    let glance = |view: &ViewResult| Glance {
        heading: view.heading,
        off_centre: view.off_centre,
        day: view.day,
        found: view.found(),
        wrong: view.wrong,
    };
    Ok(Assessment {
        landmark: order.landmark.clone(),
        height: order.height,
        expected,
        false_matches: Rehearsal::false_matches(views),
        views: views.iter().map(glance).collect(),
        breakdown: ViewBreakdown::of(views, &order.navigator.sensors, Rehearsal::DAYS),
    })
}

/// A landmark being measured.
pub struct Assess {
    order: AssessmentOrder,
    share: Share,
    assessor: Option<Assessor>,
    /// Looks taken and passed over.
    looks: usize,
}

impl Assess {
    /// Nothing looked at yet.
    pub fn new(order: AssessmentOrder, share: Share) -> Self {
        Self {
            order,
            share,
            assessor: None,
            looks: 0,
        }
    }

    fn begin(&self, worker: &mut WorkerState) -> Result<Assessor, String> {
        let days = worker.rehearsal_days(&self.order.map, self.order.seed)?;
        self.order.assessor(worker, &days)
    }
}

impl RunningJob for Assess {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if self.assessor.is_none() {
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            self.assessor = Some(self.begin(worker)?);
            return Ok(Advance::More);
        }
        let Some(assessor) = &mut self.assessor else {
            return Ok(Advance::Done);
        };
        let begun = clock();
        while self.looks < Rehearsal::VIEWS {
            let fits = if self.share.has(self.looks) {
                assessor.look().is_some()
            } else {
                assessor.pass_over()
            };
            if !fits {
                emit(JobEvent::Misfit);
                return Err(self.order.misfit());
            }
            self.looks += 1;
            if clock() - begun > SLICE {
                break;
            }
        }
        let (done, all) = (assessor.views().len(), self.share.count());
        emit(JobEvent::Progress(
            done as f32 / all as f32,
            format!("View {done} of {all}"),
        ));
        if self.looks < Rehearsal::VIEWS {
            return Ok(Advance::More);
        }
        if self.share == Share::WHOLE {
            let found = sum_up(&self.order, assessor.views())?;
            emit(JobEvent::Assessment(Box::new(found)));
        } else {
            let looks = (0..Rehearsal::VIEWS).filter(|look| self.share.has(*look));
            let views = looks.zip(assessor.views().iter().copied()).collect();
            emit(JobEvent::Views(views));
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for AssessmentOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        Some((&self.map, Reads::Areas(vec![around(&self.landmark.bounds)])))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        self.begin_share(Share::WHOLE)
    }
}

impl Shareable for AssessmentOrder {
    /// Its events are `Views`.
    fn begin_share(self, share: Share) -> Box<dyn RunningJob> {
        Box::new(Assess::new(self, share))
    }
}

/// Sum of all looks at a landmark: event `Assessment`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SumUpOrder(pub Box<AssessmentOrder>, pub Vec<ViewResult>);

impl Order for SumUpOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            let found = sum_up(&self.0, &self.1)?;
            emit(JobEvent::Assessment(Box::new(found)));
            Ok(())
        })
    }
}
