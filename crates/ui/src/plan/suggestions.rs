//! Landmarks that a worker proposes for the route: asked for, and what came of it.

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::Suggestion;

use crate::feature::FeatureContext;
use pilotage_jobs::{Job, JobEvent, JobId, MapSource, SuggestOrder};

/// Proposed landmarks.
#[derive(Debug, Default)]
pub struct Suggestions {
    /// Order and its proposals.
    pub(super) found: Option<(SuggestOrder, Vec<Suggestion>)>,
    pub(super) trouble: Option<String>,
    /// Map that was open last.
    over: Option<MapSource>,
    pub(super) asked: Option<(JobId, SuggestOrder)>,
    pub(super) progress: (f32, String),
    pub(super) wants: Option<bool>,
    /// Whether the plan is another one since.
    pub(super) is_outdated: bool,
    /// The one below the pointer in the list.
    pub(super) hovered: Option<usize>,
}

impl Suggestions {
    /// Forgets what is of another map than the one that is open.
    pub fn keep_to(&mut self, map: &MapSource, context: &mut FeatureContext<'_>) {
        if self.over.as_ref() != Some(map) {
            self.over = Some(map.clone());
            self.trouble = None;
        }
        if self.found.as_ref().is_some_and(|(of, _)| of.map != *map) {
            (self.found, self.hovered) = (None, None);
        }
        if let Some((id, _)) = self.asked.take_if(|(_, of)| of.map != *map) {
            context.cancel(id);
        }
    }

    /// Whether an order of now is asked for: to look for landmarks, or to be compared with that of what is found.
    pub fn asks(&self) -> bool {
        self.wants.is_some() || self.found.is_some()
    }

    /// Starts or stops what is wanted.
    pub fn work(&mut self, order: Option<SuggestOrder>, context: &mut FeatureContext<'_>) {
        let Some(start) = self.wants.take() else {
            self.is_outdated = self.found.as_ref().is_some_and(|(of, _)| {
                // Landmarks that are added are proposed no more, and how many are wanted changes none of them.
                let now = order.map(|now| SuggestOrder {
                    taken: of.taken.clone(),
                    count: of.count,
                    ..now
                });
                now.as_ref() != Some(of)
            });
            return;
        };
        if let Some((id, _)) = self.asked.take() {
            context.cancel(id);
        }
        if !start {
            return;
        }
        (self.trouble, self.found) = (None, None);
        if let Some(order) = order {
            self.progress = (0.0, "Waiting for a worker".to_owned());
            let id = context.start(Job::Suggest(Box::new(order.clone())));
            self.asked = Some((id, order));
        } else {
            self.trouble = Some("wait until the map is there.".to_owned());
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        let Some((_, order)) = self.asked.as_ref().filter(|(asked, _)| *asked == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(share, words) => self.progress = (*share, words.clone()),
            JobEvent::Suggestions(found) => {
                if found.is_empty() {
                    let why = "no other place that the camera sees is distinct enough. Fly higher, \
                               or draw landmarks by eye.";
                    self.trouble = Some(why.to_owned());
                }
                self.found = Some((order.clone(), found.clone()));
            }
            JobEvent::Failed(why) => {
                self.trouble = Some(why.clone());
                self.asked = None;
            }
            JobEvent::Finished | JobEvent::Cancelled => self.asked = None,
            _ => return false,
        }
        true
    }

    /// All of them.
    pub(super) fn list(&self) -> &[Suggestion] {
        self.found.as_ref().map_or(&[], |(_, list)| list)
    }
}

/// Whether a landmark was made of it.
pub(super) fn is_added(suggestion: &Suggestion, landmarks: &[Landmark]) -> bool {
    let bounds = suggestion.candidate.bounds;
    landmarks.iter().any(|l| l.bounds == bounds)
}
