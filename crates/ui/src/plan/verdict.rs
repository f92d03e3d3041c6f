//! Verdict on a landmark that was tested.

use pilotage_jobs::Assessment;

/// Probability of being found in a picture from which a landmark is good, and from which it is of use: what is rather
/// missed than found on the day of the flight helps nobody to plan.
const ENOUGH: (f64, f64) = (0.75, 0.5);
/// Share of views in which another place may be taken for it.
const MOST_WRONG: f64 = 0.05;

/// Verdict on a landmark that was tested; there is none of one that was not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LandmarkVerdict {
    /// It is found in most pictures, and nothing else for it.
    Good,
    /// It is found often enough to help.
    Usable,
    /// It is hardly ever found, or something else is.
    Weak,
}

impl LandmarkVerdict {
    /// Verdict by a test.
    pub fn of(tested: &Assessment) -> Self {
        Self::by(tested.expected.probability(), tested.false_matches)
    }

    /// Whether something else is often taken for a landmark that was tested.
    pub fn misleads(tested: &Assessment) -> bool {
        tested.false_matches > MOST_WRONG
    }

    fn by(probability: f64, wrong: f64) -> Self {
        let (good, usable) = ENOUGH;
        if probability < usable || wrong > MOST_WRONG {
            Self::Weak
        } else if probability < good || wrong > 0.0 {
            Self::Usable
        } else {
            Self::Good
        }
    }

    /// Word for people.
    pub fn word(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Usable => "usable",
            Self::Weak => "weak",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seldom_found_or_taken_for_something_else_is_weak() {
        assert_eq!(LandmarkVerdict::by(0.8, 0.0), LandmarkVerdict::Good);
        assert_eq!(LandmarkVerdict::by(0.8, 0.04), LandmarkVerdict::Usable);
        assert_eq!(LandmarkVerdict::by(0.6, 0.0), LandmarkVerdict::Usable);
        assert_eq!(LandmarkVerdict::by(0.9, 0.06), LandmarkVerdict::Weak);
        assert_eq!(LandmarkVerdict::by(0.49, 0.0), LandmarkVerdict::Weak);
    }
}
