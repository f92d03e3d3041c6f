//! A pose that may be right, and when two are one.

use super::evidence::Evidence;
use super::look::MapPose;
use pilotage_base::frames::wrap_pi;

/// Distance, against the height, and turn, radians, within which refinement finds one pose from the other.
pub(super) const BESIDE: (f64, f64) = (0.15, 0.2);

/// Probability from which a frame is believed as a whole.
pub(super) const BELIEVED: f64 = 0.95;

/// A pose at which the frame looks like the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseGuess {
    /// The pose over the map.
    pub at: MapPose,
    /// Index of the turn of the stored picture among the possible ones.
    pub turn: usize,
    /// Correlation of the whole frame with the map.
    pub score: f64,
    /// Natural logarithm of likelihood and prior.
    pub log_weight: f64,
    /// Probability of the poses beside this one, all that the prior allows and that the frame shows none
    /// of them taken into account.
    pub probability: f64,
    /// Logarithm (base 10) of the probability that it is none of these, however small.
    pub log_doubt: f64,
    /// Evidence that correlations of the frame give at this height.
    pub evidence: Evidence,
}

/// Whether two poses over ground at `ground_down` are so near that refinement finds each from the other.
pub fn are_beside(a: &MapPose, b: &MapPose, ground_down: f64) -> bool {
    let (distance, turn) = BESIDE;
    are_within(
        a,
        b,
        distance * (ground_down - a.pose.position_in_world.z),
        turn,
    )
}

/// Whether two poses differ by less than a distance, metres, and a turn, radians.
pub(super) fn are_within(a: &MapPose, b: &MapPose, distance: f64, turn: f64) -> bool {
    let (p, q) = (a.pose.position_in_world, b.pose.position_in_world);
    let apart = (p.x - q.x).hypot(p.y - q.y);
    let turned = wrap_pi(a.pose.attitude.yaw - b.pose.attitude.yaw).abs();
    apart < distance && turned < turn
}
