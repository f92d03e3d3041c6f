//! The search for a route: its two ends, how far it is, and what was found.

use pilotage_core::frames::{Geodetic, GroundPoint};
use pilotage_core::mission::NoFlyZone;

use super::find_command::FindPick;
use crate::feature::FeatureContext;
use pilotage_jobs::{FindOrder, FoundPlan, Job, JobEvent, JobId};

/// Places between which, and areas around which, a route is searched.
#[derive(Clone, Debug, PartialEq)]
struct Ends {
    from: Option<GroundPoint>,
    to: Option<GroundPoint>,
    no_fly: Vec<NoFlyZone>,
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
    /// Ends and areas that it was asked about, and those of what was found.
    about: Option<Ends>,
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

    /// Forgets what was chosen in another world, and what is found or searched between other ends or around other areas
    /// than those of now.
    pub fn keep_to_mission(&mut self, context: &mut FeatureContext<'_>) {
        let mission = &context.documents.mission;
        let origin = Some(mission.origin);
        if std::mem::replace(&mut self.origin, origin).is_some_and(|old| Some(old) != origin) {
            (self.from, self.to) = (None, None);
        }
        let (from, to) = (self.from, self.to);
        let is_same =
            |about: &Ends| (about.from, about.to) == (from, to) && about.no_fly == mission.no_fly;
        if self.about.take_if(|about| !is_same(about)).is_some() {
            self.found = None;
            if let Some(id) = self.asked.take() {
                context.cancel(id);
            }
        }
    }

    /// Starts or stops what is wanted.
    pub fn work(&mut self, order: Option<FindOrder>, context: &mut FeatureContext<'_>) {
        let Some(start) = self.wants.take() else {
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
        if let Some(order) = order {
            self.progress = (0.0, "Waiting for a worker".to_owned());
            self.about = Some(Ends {
                from: self.from,
                to: self.to,
                no_fly: order.no_fly.clone(),
            });
            self.asked = Some(context.start(Job::Find(Box::new(order))));
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
            _ => {}
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
