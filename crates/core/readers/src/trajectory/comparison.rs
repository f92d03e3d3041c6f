//! Several trajectories against one of them.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{
    Delta, ErrorStatistics, Trajectory, TrajectoryAlignment, absolute_errors, associate,
    relative_errors,
};

/// Relation between the times of two trajectories.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ClockRelation {
    /// Both run by one clock: by UTC where both know it, else their times are alike.
    #[default]
    Shared,
    /// Both take off at the same time.
    TakeOff,
}

/// Settings of the comparison of trajectories.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparisonSettings {
    /// The clock.
    pub clock: ClockRelation,
    /// Alignment of one with the other for the absolute error.
    pub alignment: TrajectoryAlignment,
    /// Between which places relative errors are taken.
    pub delta: Delta,
    /// Longest time between two places of the reference between which it is interpolated, seconds.
    pub longest_gap: f64,
}

impl Default for ComparisonSettings {
    fn default() -> Self {
        Self {
            clock: ClockRelation::default(),
            alignment: TrajectoryAlignment::default(),
            delta: Delta::Seconds(10.0),
            longest_gap: 2.0,
        }
    }
}

/// Comparison of one trajectory with the reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrajectoryComparison {
    /// Seconds that were added to its times.
    pub shift: f64,
    /// Whether heights were compared as well.
    pub in_space: bool,
    /// Absolute error (metres) at times of the reference (seconds).
    pub absolute: Vec<(f64, f64)>,
    /// Their statistics.
    pub absolute_statistics: ErrorStatistics,
    /// Relative error (metres) beside the time at which its way ends.
    pub relative: Vec<(f64, f64)>,
    /// Their statistics, where there is a way as long as asked.
    pub relative_statistics: Option<ErrorStatistics>,
}

/// Why two trajectories cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NotComparable {
    /// No take-off to align at.
    #[error("{0} never takes off, so that it cannot be aligned there")]
    NoTakeOff(String),
    /// They were not at the same time.
    #[error("{0} and {1} have no time in common; align them at take-off")]
    NoCommonTime(String, String),
    /// They do not say how to lay one over the other.
    #[error("{0} does not move, so that it cannot be turned to fit")]
    NoAlignment(String),
}

/// Seconds to add to the times of `track` to have those of `reference`.
pub fn shift_to(
    reference: &Trajectory,
    track: &Trajectory,
    clock: ClockRelation,
) -> Result<f64, NotComparable> {
    let take_off = |track: &Trajectory| {
        let found = track.take_off();
        found.ok_or_else(|| NotComparable::NoTakeOff(track.name.clone()))
    };
    match clock {
        ClockRelation::TakeOff => Ok(take_off(reference)? - take_off(track)?),
        ClockRelation::Shared => Ok(match (track.utc_at_zero, reference.utc_at_zero) {
            (Some(own), Some(other)) => own - other,
            _ => 0.0,
        }),
    }
}

/// `track` against `reference`, in the reference's time and world.
///
/// ```
/// use pilotage_readers::trajectory::{ComparisonSettings, Trajectory, compare};
///
/// // Northward at 20 m/s, and the same 3 m to the north and 4 m to the east.
/// let straight = |north: f64, east: f64| {
///     let places = (0..60).map(move |t| (f64::from(t), 20.0 * f64::from(t) + north, east));
///     Trajectory::on_the_ground("run".to_owned(), None, places)
/// };
/// let found = compare(&straight(0.0, 0.0), &straight(3.0, 4.0), &ComparisonSettings::default())?;
/// assert!((found.absolute_statistics.rmse - 5.0).abs() < 1e-9);
/// // What stays the same is no error of the way.
/// assert!(found.relative_statistics.is_some_and(|relative| relative.rmse < 1e-9));
/// # Ok::<(), pilotage_readers::trajectory::NotComparable>(())
/// ```
pub fn compare(
    reference: &Trajectory,
    track: &Trajectory,
    settings: &ComparisonSettings,
) -> Result<TrajectoryComparison, NotComparable> {
    let shift = shift_to(reference, track, settings.clock)?;
    let mut moved = track.in_frame(reference.frame).later(shift);
    let mut fixed = reference.clone();
    let in_space = track.has_height && reference.has_height;
    if !in_space {
        for place in moved.places.iter_mut().chain(&mut fixed.places) {
            place.place.z = 0.0;
        }
    }
    let pairs = associate(&moved.places, &fixed.places, settings.longest_gap);
    if pairs.is_empty() {
        let names = (track.name.clone(), reference.name.clone());
        return Err(NotComparable::NoCommonTime(names.0, names.1));
    }
    let absolute = absolute_errors(&pairs, settings.alignment);
    let errors = absolute.iter().map(|e| e.1);
    let absolute_statistics = ErrorStatistics::of(errors)
        .ok_or_else(|| NotComparable::NoAlignment(track.name.clone()))?;
    let relative = relative_errors(&pairs, settings.delta);
    Ok(TrajectoryComparison {
        shift,
        in_space,
        absolute,
        absolute_statistics,
        relative_statistics: ErrorStatistics::of(relative.iter().map(|e| e.1)),
        relative,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stands for `wait` seconds, then runs east at 20 m/s for a minute, `north` metres off.
    fn run(name: &str, wait: f64, north: f64) -> Trajectory {
        let places = (0..=10 * (wait as u32 + 60)).map(|i| {
            let time = 0.1 * f64::from(i);
            (time, north, 20.0 * (time - wait).max(0.0))
        });
        Trajectory::on_the_ground(name.into(), None, places)
    }

    #[test]
    fn runs_that_began_at_different_times_are_alike_from_take_off_on() {
        let (first, second) = (run("first", 10.0, 0.0), run("second", 25.0, 3.0));
        let shared = compare(&first, &second, &ComparisonSettings::default()).unwrap();
        assert!(shared.absolute_statistics.greatest > 290.0);
        let settings = ComparisonSettings {
            clock: ClockRelation::TakeOff,
            ..ComparisonSettings::default()
        };
        let aligned = compare(&first, &second, &settings).unwrap();
        assert!((aligned.shift + 15.0).abs() < 0.11, "{}", aligned.shift);
        assert!((aligned.absolute_statistics.median - 3.0).abs() < 0.5);
        assert!(aligned.relative_statistics.unwrap().greatest < 2.1);
    }

    #[test]
    fn clocks_that_know_the_time_of_day_agree() {
        let (mut first, mut second) = (run("first", 10.0, 0.0), run("second", 10.0, 0.0));
        first.utc_at_zero = Some(1000.0);
        second.utc_at_zero = Some(1005.0);
        let found = compare(&first, &second, &ComparisonSettings::default()).unwrap();
        assert_eq!(found.shift, 5.0);
        second.utc_at_zero = Some(1e6);
        let far = compare(&first, &second, &ComparisonSettings::default());
        assert_eq!(
            far,
            Err(NotComparable::NoCommonTime("second".into(), "first".into()))
        );
    }

    #[test]
    fn a_height_counts_where_both_have_one() {
        let mut high = run("high", 0.0, 0.0);
        for place in &mut high.places {
            place.place.z = -50.0;
        }
        high.has_height = true;
        let flat = run("flat", 0.0, 4.0);
        let settings = ComparisonSettings::default();
        let found = compare(&high, &flat, &settings).unwrap();
        assert!(!found.in_space);
        assert!((found.absolute_statistics.mean - 4.0).abs() < 1e-9);
        let mut low = high.clone();
        for place in &mut low.places {
            place.place.z = -45.0;
        }
        let found = compare(&high, &low, &settings).unwrap();
        assert!(found.in_space && (found.absolute_statistics.mean - 5.0).abs() < 1e-9);
    }

    #[test]
    fn what_stands_cannot_be_turned_to_fit_nor_aligned_at_take_off() {
        let moving = run("moving", 0.0, 0.0);
        let standing = Trajectory::on_the_ground(
            "standing".into(),
            None,
            moving.places.iter().map(|p| (p.time, 0.0, 0.0)),
        );
        let with = |clock, alignment| ComparisonSettings {
            clock,
            alignment,
            ..ComparisonSettings::default()
        };
        let turned = compare(
            &moving,
            &standing,
            &with(ClockRelation::Shared, TrajectoryAlignment::Rigid),
        );
        assert_eq!(turned, Err(NotComparable::NoAlignment("standing".into())));
        let begun = compare(
            &moving,
            &standing,
            &with(ClockRelation::TakeOff, TrajectoryAlignment::None),
        );
        assert_eq!(begun, Err(NotComparable::NoTakeOff("standing".into())));
    }
}
