//! Prior of places on the lattice on which a sweep looks.
//!
//! A prior is weighed against the sum of it over all places that are looked at, one in each cell of the lattice. Where it
//! is sharper than a cell, that sum depends on where the lattice lies: places half a cell beside the middle are then
//! weighed as if the middle were far away, or the other way round. The bell is therefore never taken for narrower than
//! half a cell, and as much lower as it is wider: its sum over the lattice is that of the prior to within 4 %,
//! wherever the lattice lies (Poisson's summation formula: 2 exp(-2π² / 4) on each axis).

use super::limits::REACH;
use super::prior::PosePrior;
use pilotage_base::frames::GroundPoint;

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
        }
    }

    /// Natural logarithm of the density of a place, against the prior's at its mean.
    pub fn log_density(&self, place: &GroundPoint) -> f64 {
        let off = place.distance(&self.around) / self.deviation;
        self.log_height - 0.5 * off * off
    }
}

/// Distance to each side that is looked at, metres, where `reach` is searched on places `gsd` apart: as far as the bell has
/// weight, and a cell more.
pub(super) fn reach_on(reach: f64, gsd: f64) -> f64 {
    reach.max(REACH * LEAST * gsd) + gsd
}
