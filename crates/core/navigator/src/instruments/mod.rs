//! Readings of the instruments of a real flight, and its position by them when satellite navigation fails.
//!
//! A flight becomes [`Instruments`]: readings cleaned of what cannot be, with what was refused in words. From the
//! flight up to an outage, and from nothing later, [`Instruments::calibrate`] finds how late airspeed and satellite
//! navigation come, by what factor the airspeed reads wrong, which heading to believe and by what angle to turn
//! it, and how the airplane slips sideways. [`reckon`] flies through one outage in several ways side by side,
//! [`study_outages`] through outages all along.

mod airborne;
mod blend;
mod calibration;
#[cfg(test)]
mod consistency;
mod fit;
mod fit_refusal;
#[cfg(test)]
mod fit_tests;
mod follow;
#[cfg(test)]
mod generated;
mod gps_wind;
mod heading;
mod heading_choice;
mod health;
mod models;
mod nose;
mod outlook;
mod prepared;
mod problem;
mod readings;
mod reckon;
mod refusal;
mod rows;
mod series;
mod settings;
mod slip;
mod statistics;
mod study;
mod track;
mod track_noise;
mod tuning;
mod walker;

pub use airborne::airborne;
pub use blend::Blend;
pub use calibration::{Calibration, CalibrationSettings, Delays, HeadingSource};
pub use fit::AirFit;
pub use fit_refusal::FitRefusal;
pub use follow::PositionFix;
pub use gps_wind::{GpsWindSettings, WindAt, WindComparison, compare_winds, gps_wind};
pub use heading::HeadingCheck;
pub use health::{StuckStretch, stuck, stuck_stretches};
pub use models::Airplane;
pub use prepared::{Instruments, ReckonError};
pub use problem::FitPrior;
pub use readings::Readings;
pub use reckon::{Reckoning, ReckoningWay, reckon, rolling_track};
pub use refusal::{RefusedKind, RefusedStretch};
pub use series::{Series, SeriesValue};
pub use settings::{HeadingChoice, Method, ReckonSettings};
pub use statistics::{quantile, quantile_of_others};
pub use study::{OutageOutcome, OutagePlan, OutageStudy, study_outages};
pub use track::{BeliefPoint, BeliefTrack, Growth};
pub use track_noise::TrackNoise;
pub use tuning::likeliest;
