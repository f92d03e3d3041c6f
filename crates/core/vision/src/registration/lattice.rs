//! Prior of places on the lattice on which a sweep looks.
//!
//! A prior is weighed against the sum of it over all places that are looked at, one in each cell of the lattice. Where it
//! is sharper than a cell, that sum depends on where the lattice lies: places half a cell beside the middle are then
//! weighed as if the middle were far away, or the other way round. The bell is therefore never taken for narrower than
//! half a cell, and as much lower as it is wider: its sum over the lattice is that of the prior to within 4 %,
//! wherever the lattice lies (Poisson's summation formula: 2 exp(-2π² / 4) on each axis).

use super::limits::REACH;
use super::prior::PosePrior;
use pilotage_base::frames::{GroundPoint, GroundRect};

/// Least standard deviation, cells.
const LEAST: f64 = 0.5;

/// Prior of the place below the camera on a lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct LatticePrior {
    around: GroundPoint,
    /// Metres.
    deviation: f64,
    /// Natural logarithm of the height of the bell against the prior's.
    log_height: f64,
    /// All places alike, if there is no bell.
    anywhere_on: Option<GroundRect>,
}

impl LatticePrior {
    /// On places `gsd` metres apart.
    pub fn new(prior: &PosePrior, gsd: f64) -> Self {
        let own = prior.place_deviation();
        let deviation = own.max(LEAST * gsd);
        Self {
            around: prior.position,
            deviation,
            log_height: 2.0 * (own / deviation).ln(),
            anywhere_on: prior.anywhere_on,
        }
    }

    /// The sum of a prior over all places, against its density at its mean, m².
    pub fn sum(prior: &PosePrior) -> f64 {
        let of_bell = std::f64::consts::TAU * prior.place_deviation().powi(2);
        let area = |ground: GroundRect| ground.width() * ground.height();
        prior.anywhere_on.map_or(of_bell, area)
    }

    /// Natural logarithm of the density of a place, against the prior's at its mean.
    pub fn log_density(&self, place: &GroundPoint) -> f64 {
        if let Some(ground) = &self.anywhere_on {
            return if ground.contains(place) {
                0.0
            } else {
                f64::NEG_INFINITY
            };
        }
        let off = place.distance(&self.around) / self.deviation;
        self.log_height - 0.5 * off * off
    }
}

/// Distance to each side that is looked at, metres, where `reach` is searched on places `gsd` apart: as far as the bell has
/// weight, and a cell more.
pub(super) fn reach_on(reach: f64, gsd: f64) -> f64 {
    reach.max(REACH * LEAST * gsd) + gsd
}
