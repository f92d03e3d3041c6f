//! The search for a route: its two ends, how far it is, and what was found.

use std::sync::Arc;

use pilotage_core::frames::{Altitude, Geodetic, GroundPoint};
use pilotage_core::imagery::terrain::HeightGrid;

use super::find_command::FindPick;
use crate::feature::FeatureContext;
use pilotage_jobs::{FieldFrom, FindOrder, FoundPlan, HighGround, Job, JobEvent, JobId};

/// Plan for which a route is searched.
#[derive(Clone, Debug)]
pub struct FindQuestion {
    /// Order without the high ground.
    pub order: FindOrder,
    /// Greatest height of ground that may be flown over, metres, and the heights.
    pub high_ground: Option<(f64, Arc<HeightGrid>)>,
    /// Altitude at which the route is flown.
    pub altitude: Altitude,
}

impl PartialEq for FindQuestion {
    /// Whether both are of one plan; heights are the same only as long as nobody read them anew.
    fn eq(&self, other: &Self) -> bool {
        let is_high = match (&self.high_ground, &other.high_ground) {
            (None, None) => true,
            (Some((a, of)), Some((b, like))) => a == b && Arc::ptr_eq(of, like),
            _ => false,
        };
        is_high && self.altitude == other.altitude && self.order == other.order
    }
}

impl FindQuestion {
    fn order(&self) -> FindOrder {
        let high_ground = self.high_ground.as_ref();
        FindOrder {
            high_ground: high_ground.map(|(highest, heights)| HighGround {
                heights: heights.as_ref().clone(),
                highest: *highest,
            }),
            ..self.order.clone()
        }
    }
}

/// The search.
#[derive(Debug, Default)]
pub struct Finder {
    /// Start of the route.
    pub from: Option<GroundPoint>,
    /// End of the route.
    pub to: Option<GroundPoint>,
    /// Meaning of the next click.
    pub pick: FindPick,
    /// Routes that were found.
    pub found: Option<Box<FoundPlan>>,
    /// Why nothing was found.
    pub trouble: Option<String>,
    asked: Option<JobId>,
    /// Plan that it was asked about, and that of what was found.
    about: Option<FindQuestion>,
    /// Whether the plan is another one since.
    pub(super) is_outdated: bool,
    /// Origin of the world in which the ends were chosen.
    origin: Option<Geodetic>,
    progress: (f32, String),
    /// Whether to start or to stop it.
    pub(super) wants: Option<bool>,
}

impl Finder {
    /// Progress of the search, 0 to 1, and its words.
    pub fn under_way(&self) -> Option<(f32, &str)> {
        self.asked?;
        Some((self.progress.0, self.progress.1.as_str()))
    }

    /// Forgets what was chosen in another world, and what is found or searched over another map, between other ends or
    /// around other areas than those of now.
    pub fn keep_to_mission(&mut self, context: &mut FeatureContext<'_>) {
        let mission = &context.documents.mission;
        let origin = Some(mission.origin);
        if std::mem::replace(&mut self.origin, origin).is_some_and(|old| Some(old) != origin) {
            (self.from, self.to) = (None, None);
        }
        let ends = (self.from, self.to);
        let is_same = |about: &FindQuestion| {
            let about = &about.order;
            let is_here = about.field.map == context.documents.map.source;
            is_here && (Some(about.from), Some(about.to)) == ends && about.no_fly == mission.no_fly
        };
        if self.about.take_if(|about| !is_same(about)).is_some() {
            (self.found, self.trouble) = (None, None);
            if let Some(id) = self.asked.take() {
                context.cancel(id);
            }
        }
    }

    /// Whether the plan of now is asked for: to search for a route, or to be compared with that of what is found.
    pub fn asks(&self) -> bool {
        self.wants.is_some() || self.found.is_some()
    }

    /// Altitude at which what is found was searched.
    pub fn altitude(&self) -> Option<Altitude> {
        self.about.as_ref().map(|about| about.altitude)
    }

    /// Whether what is found leads over the places that the map alone offers.
    pub fn is_over_map(&self) -> bool {
        let of = self.about.as_ref().map(|about| &about.order.field.from);
        matches!(of, Some(FieldFrom::Map { .. }))
    }

    /// Starts or stops what is wanted.
    pub fn work(&mut self, question: Option<FindQuestion>, context: &mut FeatureContext<'_>) {
        let Some(start) = self.wants.take() else {
            self.is_outdated = self.found.is_some() && self.about != question;
            return;
        };
        if let Some(id) = self.asked.take() {
            context.cancel(id);
        }
        if !start {
            return;
        }
        self.trouble = None;
        self.found = None;
        if let Some(question) = question {
            self.progress = (0.0, "Waiting for a worker".to_owned());
            self.asked = Some(context.start(Job::Find(Box::new(question.order()))));
            self.about = Some(question);
        } else {
            let why = "choose A and B on the map first, and wait until the map is there.";
            self.trouble = Some(why.to_owned());
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        if self.asked != Some(id) {
            return false;
        }
        match event {
            JobEvent::Progress(fraction, words) => self.progress = (*fraction, words.clone()),
            JobEvent::FoundPlan(plan) => self.found = Some(plan.clone()),
            JobEvent::Failed(why) => {
                self.trouble = Some(why.clone());
                self.asked = None;
            }
            JobEvent::Finished | JobEvent::Cancelled => self.asked = None,
            _ => return false,
        }
        true
    }

    /// Takes a click on the map.
    pub(super) fn click(&mut self, at: GroundPoint) {
        match self.pick {
            FindPick::Nothing => {}
            FindPick::From => {
                self.from = Some(at);
                self.pick = if self.to.is_none() {
                    FindPick::To
                } else {
                    FindPick::Nothing
                };
            }
            FindPick::To => {
                self.to = Some(at);
                self.pick = FindPick::Nothing;
            }
        }
    }
}
