//! How well a landmark is found on other days, a view after the other.

use std::sync::Arc;

use pilotage_core::camera::CameraModel;
use pilotage_core::imagery::Imagery;
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::plan::{Assessor, Breakdown, Circumstances, ExpectedDetection, Rehearsal, View};
use serde::{Deserialize, Serialize};

use super::running::SLICE;
use super::{Advance, JobEvent, MapSource, RunningJob, Workshop};

const SEED: u64 = 11;

/// Which landmark to measure, and how it will be looked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AssessmentOrder {
    /// The map.
    pub map: MapSource,
    /// The landmark.
    pub landmark: Landmark,
    /// The camera.
    pub camera: CameraModel,
    /// Height of the camera above ground, metres.
    pub height: f64,
    /// How it will be navigated.
    pub navigator: NavigatorSettings,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
}

impl AssessmentOrder {
    /// Prepares to look at the landmark on `days`.
    pub(super) fn assessor(
        &self,
        workshop: &mut Workshop,
        days: &[Arc<dyn Imagery>],
    ) -> Result<Assessor, String> {
        let map = workshop.cached_map(&self.map)?;
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
            SEED,
        ))
    }
}

/// One look at a landmark.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Glance {
    /// Heading of the camera, radians.
    pub heading: f64,
    /// Distance from the middle of the picture, pixels.
    pub off_centre: f64,
    /// Which of the days it was on.
    pub day: usize,
    /// Whether it was accepted and right.
    pub found: bool,
    /// Whether a wrong place was accepted.
    pub wrong: bool,
}

/// How well a landmark is found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// The landmark as it was measured.
    pub landmark: Landmark,
    /// Height above ground, metres.
    pub height: f64,
    /// What is to be expected.
    pub expected: ExpectedDetection,
    /// Share of the views in which a wrong place was accepted.
    pub false_matches: f64,
    /// Every view.
    pub views: Vec<Glance>,
    /// What they depend on.
    pub breakdown: Breakdown,
}

/// A share of the looks at a landmark: those on every `of`-th day, so that several workers draw the
/// ground of one day each.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// Which of them, from 0.
    pub part: usize,
    /// How many there are.
    pub of: usize,
}

impl Share {
    /// Everything.
    pub const WHOLE: Self = Self { part: 0, of: 1 };

    /// Whether a look is of this share.
    fn has(&self, look: usize) -> bool {
        look % Rehearsal::DAYS % self.of == self.part
    }

    /// How many looks there are in it.
    fn count(&self) -> usize {
        (0..Rehearsal::VIEWS).filter(|look| self.has(*look)).count()
    }
}

/// What views come to, all of them in the order of their looks.
pub fn sum_up(order: &AssessmentOrder, views: &[View]) -> Result<Assessment, String> {
    let expected = Rehearsal::expected(views).ok_or("there was nothing to look at")?;
    let glance = |view: &View| Glance {
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
        breakdown: Breakdown::of(views, &order.navigator.sensors, Rehearsal::DAYS),
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

    fn begin(&self, workshop: &mut Workshop) -> Result<Assessor, String> {
        let days = workshop.rehearsal_days(&self.order.map)?;
        self.order.assessor(workshop, &days)
    }
}

impl RunningJob for Assess {
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if self.assessor.is_none() {
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            self.assessor = Some(self.begin(workshop)?);
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
                return Err(format!(
                    "{} does not fit into a picture from {:.0} m; make its box smaller or fly higher",
                    self.order.landmark.name, self.order.height
                ));
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
