//! The mission that is open, and how people came to it.

use std::ops::{Deref, DerefMut};

use pilotage_core::mission::{Mission, Route};

use super::History;
use crate::context::route_of;

/// Mission that people author; it is read and changed as a [`Mission`] is.
#[derive(Debug)]
pub struct MissionDocument {
    /// The mission itself.
    pub content: Mission,
    /// Whether it differs from the scenario's own.
    pub is_edited: bool,
    /// The selected route's id.
    pub route: Option<u32>,
    /// Its undo steps.
    pub history: History,
}

impl MissionDocument {
    /// A mission without undo steps.
    pub fn new(content: Mission, is_edited: bool) -> Self {
        Self {
            content,
            is_edited,
            route: None,
            history: History::default(),
        }
    }

    /// Remembers it as it is now, one undo step away.
    pub fn remember(&mut self) {
        self.history.remember(&self.content);
    }

    /// The selected route.
    pub fn selected_route(&self) -> Option<&Route> {
        route_of(&self.content, self.route?)
    }
}

impl Deref for MissionDocument {
    type Target = Mission;

    fn deref(&self) -> &Mission {
        &self.content
    }
}

impl DerefMut for MissionDocument {
    fn deref_mut(&mut self) -> &mut Mission {
        &mut self.content
    }
}
