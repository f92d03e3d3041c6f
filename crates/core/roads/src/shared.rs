//! Roads shared by all who hold the same ones, so that a copy costs nothing until it is changed.

use std::ops::Deref;
use std::sync::{Arc, Weak};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::RoadLine;

/// List of roads whose copies share what they hold until one of them is changed. Written and read as the list that it is.
///
/// ```
/// use pilotage_roads::{RoadLine, SharedRoads};
///
/// let before = SharedRoads::from(vec![RoadLine::default()]);
/// let mut after = before.clone();
/// assert!(after.is_shared_with(&before));
/// after.make_mut().clear();
/// assert_eq!((before.len(), after.len()), (1, 0));
/// ```
#[derive(Clone, Debug, Default)]
pub struct SharedRoads(Arc<Vec<RoadLine>>);

/// Mark of a list of roads as it was: tells whether another is that same list, unchanged, without comparing or keeping
/// the roads.
#[derive(Clone, Debug, Default)]
pub struct RoadsMark(Weak<Vec<RoadLine>>);

impl SharedRoads {
    /// The roads to be changed; they are copied first if somebody else holds them, too.
    pub fn make_mut(&mut self) -> &mut Vec<RoadLine> {
        Arc::make_mut(&mut self.0)
    }

    /// Whether both hold one and the same list.
    #[must_use]
    pub fn is_shared_with(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// A mark of the list as it is.
    #[must_use]
    pub fn mark(&self) -> RoadsMark {
        RoadsMark(Arc::downgrade(&self.0))
    }
}

impl RoadsMark {
    /// Whether it is of that list, which nobody has changed since.
    #[must_use]
    pub fn is_of(&self, roads: &SharedRoads) -> bool {
        // The mark keeps the place in memory from being given to another list, and a list that is changed moves.
        std::ptr::eq(self.0.as_ptr(), Arc::as_ptr(&roads.0))
    }
}

impl Deref for SharedRoads {
    type Target = [RoadLine];

    fn deref(&self) -> &[RoadLine] {
        &self.0
    }
}

impl From<Vec<RoadLine>> for SharedRoads {
    fn from(roads: Vec<RoadLine>) -> Self {
        Self(Arc::new(roads))
    }
}

impl FromIterator<RoadLine> for SharedRoads {
    fn from_iter<T: IntoIterator<Item = RoadLine>>(roads: T) -> Self {
        Self::from(Vec::from_iter(roads))
    }
}

impl<'a> IntoIterator for &'a SharedRoads {
    type Item = &'a RoadLine;
    type IntoIter = std::slice::Iter<'a, RoadLine>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl PartialEq for SharedRoads {
    fn eq(&self, other: &Self) -> bool {
        self.is_shared_with(other) || self.0 == other.0
    }
}

impl Serialize for SharedRoads {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.as_slice().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for SharedRoads {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(Self::from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_tells_a_list_from_every_other_and_from_itself_once_it_is_changed() {
        let mut roads = SharedRoads::from(vec![RoadLine::default()]);
        let mark = roads.mark();
        assert!(mark.is_of(&roads) && mark.is_of(&roads.clone()));
        assert!(!mark.is_of(&SharedRoads::from(vec![RoadLine::default()])));
        // Held by nobody else, so that it is changed where it is.
        roads.make_mut()[0].width = 3.0;
        assert!(!mark.is_of(&roads));
        assert!(!RoadsMark::default().is_of(&roads));
    }

    #[test]
    fn a_change_leaves_those_who_share_the_list_alone() {
        let before = SharedRoads::from(vec![RoadLine::default()]);
        let mut after = before.clone();
        assert_eq!(before, after);
        after.make_mut()[0].width = 3.0;
        assert_ne!(before, after);
        assert_eq!(before, SharedRoads::from(vec![RoadLine::default()]));
    }
}
