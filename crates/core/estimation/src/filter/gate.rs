//! Gate that decides whether a measurement is to be believed.

use std::fmt;

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OVector};
use serde::{Deserialize, Serialize};

use super::PredictedMeasurement;
use pilotage_base::statistics::chi_square_quantile;

/// Gate on the normalised innovation squared (NIS).
///
/// For an honest filter the NIS is chi-square distributed with as many degrees of freedom as the
/// measurement has components, so that the gate refuses the share 1 - `confidence` of the good
/// measurements and most of the bad ones.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gate {
    /// Share of good measurements that pass, in (0, 1); 1 lets everything pass.
    pub confidence: f64,
}

impl Default for Gate {
    fn default() -> Self {
        Self { confidence: 0.99 }
    }
}

/// Why a gate accepted or refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum GateReason {
    /// The innovation is as large as the uncertainties let expect.
    WithinExpectation,
    /// The innovation is too large for the uncertainties.
    TooFarFromExpectation,
    /// The innovation is not a finite number.
    NotFinite,
    /// The gate's confidence lies outside [0, 1], or the measurement has no component.
    NoThreshold,
}

impl fmt::Display for GateReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::WithinExpectation => "within the gate",
            Self::TooFarFromExpectation => "too far from where it was expected",
            Self::NotFinite => "not a finite number",
            Self::NoThreshold => "the gate's confidence gives no threshold",
        })
    }
}

/// A gate's answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Whether to use the measurement.
    pub accepted: bool,
    /// Normalised innovation squared.
    pub nis: f64,
    /// The largest NIS that passes.
    pub threshold: f64,
    /// Degrees of freedom: components of the measurement.
    pub dof: usize,
    /// Why.
    pub reason: GateReason,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, sign) = if self.accepted {
            ("accepted", "≤")
        } else {
            ("refused", "against")
        };
        write!(
            f,
            "{name}: {} (NIS {:.2} {sign} {:.2})",
            self.reason, self.nis, self.threshold
        )
    }
}

impl Gate {
    /// Largest NIS that passes for a measurement with `dof` components.
    pub fn threshold(&self, dof: usize) -> f64 {
        chi_square_quantile(self.confidence, dof as f64)
    }

    /// Judges a normalised innovation squared.
    ///
    /// ```
    /// use pilotage_estimation::filter::Gate;
    ///
    /// // Two components stay below 5.991 in 95 % of all cases.
    /// let gate = Gate { confidence: 0.95 };
    /// assert!(gate.verdict(5.9, 2).accepted);
    /// assert!(!gate.verdict(6.1, 2).accepted);
    /// assert!((gate.threshold(2) - 5.991).abs() < 1e-3);
    /// ```
    pub fn verdict(&self, nis: f64, dof: usize) -> Verdict {
        let threshold = self.threshold(dof);
        let reason = if !nis.is_finite() {
            GateReason::NotFinite
        } else if threshold.is_nan() {
            GateReason::NoThreshold
        } else if nis <= threshold {
            GateReason::WithinExpectation
        } else {
            GateReason::TooFarFromExpectation
        };
        let accepted = reason == GateReason::WithinExpectation;
        Verdict {
            accepted,
            nis,
            threshold,
            dof,
            reason,
        }
    }

    /// Judges a measurement against its prediction.
    pub fn judge<const N: usize, M: Dim>(
        &self,
        predicted: &PredictedMeasurement<N, M>,
        measurement: &OVector<f64, M>,
    ) -> Verdict
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        self.verdict(
            predicted.nis(&predicted.innovation(measurement)),
            predicted.dof(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gate_lets_pass_what_its_confidence_says() {
        let gate = Gate { confidence: 0.95 };
        assert!(gate.verdict(5.99, 2).accepted);
        let refused = gate.verdict(6.0, 2);
        assert!(!refused.accepted);
        assert_eq!(refused.reason, GateReason::TooFarFromExpectation);
        assert_eq!(
            refused.to_string(),
            "refused: too far from where it was expected (NIS 6.00 against 5.99)"
        );
    }

    #[test]
    fn a_gate_of_full_confidence_lets_everything_finite_pass() {
        let gate = Gate { confidence: 1.0 };
        assert!(gate.verdict(1e12, 2).accepted);
        assert_eq!(gate.verdict(f64::NAN, 2).reason, GateReason::NotFinite);
    }
}
