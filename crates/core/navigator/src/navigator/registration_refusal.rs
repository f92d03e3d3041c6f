//! Why whole frames do not correct the estimate, by kind.

use serde::{Deserialize, Serialize};

use pilotage_vision::registration::NotRegistered;

/// Kind of reason for which a whole frame did not correct the estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum RegistrationRefusal {
    /// There is no map where the picture may be.
    NothingAlike,
    /// The likeliest place is not likely enough.
    Doubtful,
    /// Another place explains the picture about as well.
    Ambiguous,
    /// Its place is not where the filter expects it, and may be chance.
    OutsideGate,
    /// Other places that earlier frames left are as possible.
    Open,
}

impl RegistrationRefusal {
    /// Every kind, in the order in which people read them.
    pub const ALL: [Self; 5] = [
        Self::NothingAlike,
        Self::Doubtful,
        Self::Ambiguous,
        Self::OutsideGate,
        Self::Open,
    ];

    /// Short name in files and tables.
    pub fn key(self) -> &'static str {
        match self {
            Self::NothingAlike => "nothing_alike",
            Self::Doubtful => "doubtful",
            Self::Ambiguous => "ambiguous",
            Self::OutsideGate => "outside_gate",
            Self::Open => "open",
        }
    }

    /// The reason in words.
    pub fn reason(self) -> &'static str {
        match self {
            Self::NothingAlike => {
                "there is no map within reach, or nothing in the picture to compare"
            }
            Self::Doubtful => "the likeliest place is not likely enough",
            Self::Ambiguous => "two places explain the picture",
            Self::OutsideGate => "its place is not where it was expected, and may be chance",
            Self::Open => "other places are as possible; later frames tell",
        }
    }
}

impl From<&NotRegistered> for RegistrationRefusal {
    fn from(cause: &NotRegistered) -> Self {
        match cause {
            NotRegistered::NothingAlike => Self::NothingAlike,
            NotRegistered::Doubtful { .. } => Self::Doubtful,
            NotRegistered::Ambiguous { .. } => Self::Ambiguous,
        }
    }
}
