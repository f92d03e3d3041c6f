//! Association of observed landmarks with possible ones: of what the camera saw with what the table has there.
//!
//! [`associate`] finds the largest set of pairs that agree with each other; [`Scoreboard`] is the thesis' way, for
//! comparison.

mod candidates;
mod clique;
mod consistent;
mod fix;
mod graph;
mod problem;
mod scoreboard;
#[cfg(test)]
mod tests;

pub use consistent::{AssociatedPair, Association, associate};
pub use fix::JointFix;
pub use problem::{
    AssociationProblem, AssociationSettings, CommonError, ObservedLandmark, PossibleLandmark,
};
pub use scoreboard::{NearestRoad, Scoreboard, ScoreboardRow, ScoreboardSettings, ScoreboardTerms};
