//! Commands of features, which everybody passes on and only their owner knows.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// Identity of a feature: a short word that no other has.
pub type FeatureId = &'static str;

/// Identity of the feature that flies studies, which dialogs offer.
pub const STUDIES: FeatureId = "study";

/// Identity of the feature that finds pictures among roads, which the sheet of photos offers.
pub const AMONG_ROADS: FeatureId = "among_roads";

/// Words by which that is offered.
pub const FIND_AMONG_ROADS: &str = "Find this place among the roads";

/// Action of a feature, which the app passes on without knowing it.
pub trait FeatureAction: Any + Send + Sync {
    /// Whether it is the same as `other`.
    fn is_same(&self, other: &dyn FeatureAction) -> bool;
}

impl<T: Any + PartialEq + Send + Sync> FeatureAction for T {
    fn is_same(&self, other: &dyn FeatureAction) -> bool {
        (other as &dyn Any).downcast_ref::<T>() == Some(self)
    }
}

/// Action that every feature has: to show its panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Show;

/// Command of a feature, addressed to it.
#[derive(Clone)]
pub struct FeatureCommand {
    to: FeatureId,
    action: Arc<dyn FeatureAction>,
}

impl FeatureCommand {
    /// Command for the feature `to`. Over a hundred places make one: it is code of its own, lest each has a copy.
    #[inline(never)]
    pub fn new(to: FeatureId, action: impl FeatureAction) -> Self {
        let action = Arc::new(action);
        Self { to, action }
    }

    /// Command that shows the panel of the feature `of`.
    pub fn show(of: FeatureId) -> Self {
        Self::new(of, Show)
    }

    /// Feature that carries it out.
    pub fn to(&self) -> FeatureId {
        self.to
    }

    /// Its action, if that is an `A`.
    pub fn action<A: FeatureAction>(&self) -> Option<&A> {
        let action: &dyn Any = self.action.as_ref();
        action.downcast_ref()
    }
}

impl fmt::Debug for FeatureCommand {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "command of {}", self.to)
    }
}

impl PartialEq for FeatureCommand {
    fn eq(&self, other: &Self) -> bool {
        self.to == other.to && self.action.is_same(other.action.as_ref())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_equal_if_owner_and_action_are() {
        let go = |to, steps: i32| FeatureCommand::new(to, steps);
        assert_eq!(go("a", 1), go("a", 1));
        assert_ne!(go("a", 1), go("a", 2));
        assert_ne!(go("a", 1), go("b", 1));
        assert_ne!(go("a", 1), FeatureCommand::new("a", "1"));
        assert_eq!(go("a", 3).action::<i32>(), Some(&3));
        assert_eq!(go("a", 3).action::<u8>(), None);
    }
}
