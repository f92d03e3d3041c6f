//! The choice of an estimator, and what is asked of the table of them in `mod.rs`.

use serde::{Deserialize, Serialize};

use super::EstimatorChoice;
use crate::filter::ParticleSettings;

/// Declares the files of the estimators, makes their enum, and passes every question about a choice on to its file.
macro_rules! estimators {
    ($($(#[$about:meta])* $name:ident($file:ident, $($estimator:ident)::+),)*) => {
        $(mod $file;)*

        /// The estimators that work on the vehicle models.
        #[derive(
            Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize,
        )]
        pub enum EstimatorChoice {
            $(
                $(#[$about])*
                #[doc = concat!("See `", stringify!($file), "`.")]
                $name,
            )*
        }

        impl EstimatorChoice {
            /// Every choice, in the order in which people read them.
            pub const ALL: [Self; [$($file::INFO,)*].len()] = [$(Self::$name,)*];

            fn info(self) -> &'static EstimatorInfo {
                match self {
                    $(Self::$name => &$file::INFO,)*
                }
            }

            /// Begins with the belief `prior`, and lets `visitor` work with the estimator.
            pub fn begin<const N: usize, V: EstimatorVisitor<N>>(
                self,
                prior: &crate::filter::Gaussian<N>,
                settings: &FilterSettings,
                visitor: V,
            ) -> Result<V::Output, crate::filter::FilterError> {
                Ok(match self {
                    $(Self::$name => visitor.visit($($estimator)::+::begin(prior, settings)?),)*
                })
            }
        }
    };
}

impl EstimatorChoice {
    /// Name in files and on the command line.
    pub fn key(self) -> &'static str {
        self.info().key
    }

    /// The choice with this key.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.key() == key)
    }

    /// Name for people.
    pub fn label(self) -> &'static str {
        self.info().label
    }

    /// Description of the estimator, in a sentence.
    pub fn description(self) -> &'static str {
        self.info().description
    }
}

/// The estimator and its settings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct EstimatorSettings {
    /// Kind of estimator.
    pub choice: EstimatorChoice,
    /// Settings of the particle filter; the others have theirs in the navigator's settings.
    pub particles: ParticleSettings,
}
