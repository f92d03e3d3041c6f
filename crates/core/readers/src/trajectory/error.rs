//! Absolute and relative errors of a trajectory.

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use super::{TimedPlace, TrajectoryAlignment, align};

/// Between which places relative errors are taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Delta {
    /// So many samples apart.
    Samples(usize),
    /// So many seconds apart, at least.
    Seconds(f64),
    /// So many metres of the reference's way apart, at least.
    Metres(f64),
}

/// An estimated place, and where the reference was at that time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacePair {
    /// Seconds.
    pub time: f64,
    /// The estimate.
    pub estimate: Point3<f64>,
    /// The reference.
    pub reference: Point3<f64>,
}

/// Place at `time`, interpolated between places that are at most `longest_gap` seconds apart; `None` before,
/// after and in longer gaps. In order of time.
pub fn place_at(places: &[TimedPlace], time: f64, longest_gap: f64) -> Option<Point3<f64>> {
    let after = places.partition_point(|p| p.time <= time);
    let before = places.get(after.checked_sub(1)?)?;
    if before.time == time {
        return Some(before.place);
    }
    let next = places.get(after)?;
    let gap = next.time - before.time;
    let share = (time - before.time) / gap;
    (gap <= longest_gap).then(|| before.place + share * (next.place - before.place))
}

/// Pairs every estimate with the reference at its time, interpolated between samples that are at most
/// `longest_gap` seconds apart. Both in order of time; what has no reference is left out.
pub fn associate(
    estimate: &[TimedPlace],
    reference: &[TimedPlace],
    longest_gap: f64,
) -> Vec<PlacePair> {
    let pair = |e: &TimedPlace| {
        Some(PlacePair {
            time: e.time,
            estimate: e.place,
            reference: place_at(reference, e.time, longest_gap)?,
        })
    };
    estimate.iter().filter_map(pair).collect()
}

/// Distance of every estimate from its reference (the translation part of evo's APE), metres, beside its
/// time; empty where the trajectories cannot be laid over each other.
pub fn absolute_errors(pairs: &[PlacePair], alignment: TrajectoryAlignment) -> Vec<(f64, f64)> {
    let places: Vec<_> = pairs.iter().map(|p| (p.estimate, p.reference)).collect();
    let Some(over) = align(&places, alignment) else {
        return Vec::new();
    };
    let error = |p: &PlacePair| (p.time, (over.apply(&p.estimate) - p.reference).norm());
    pairs.iter().map(error).collect()
}

/// Difference between the way that the estimate went and the way of the reference (evo's RPE for places
/// without attitude: the difference of both displacements), metres, beside the time of its end. Every
/// sample begins a way that ends `delta` later, so that ways overlap.
pub fn relative_errors(pairs: &[PlacePair], delta: Delta) -> Vec<(f64, f64)> {
    let mut travelled = Vec::with_capacity(pairs.len());
    let mut way = 0.0;
    for (i, pair) in pairs.iter().enumerate() {
        if let Some(before) = i.checked_sub(1) {
            way += (pair.reference - pairs[before].reference).norm();
        }
        travelled.push(way);
    }
    let end_of = |i: usize| match delta {
        Delta::Samples(count) => i + count,
        Delta::Seconds(seconds) => {
            let until = pairs[i].time + seconds - 1e-9;
            pairs.partition_point(|p| p.time < until)
        }
        Delta::Metres(metres) => travelled.partition_point(|w| *w < travelled[i] + metres),
    };
    (0..pairs.len())
        .filter_map(|i| {
            let end = pairs.get(end_of(i).max(i + 1))?;
            let went = end.estimate - pairs[i].estimate;
            let really = end.reference - pairs[i].reference;
            Some((end.time, (went - really).norm()))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::ErrorStatistics;
    use super::*;

    /// Eastward at 10 m/s, ten samples a second.
    fn straight(seconds: usize) -> Vec<TimedPlace> {
        let place = |i: usize| TimedPlace {
            time: 0.1 * i as f64,
            place: Point3::new(0.0, i as f64, 0.0),
        };
        (0..=10 * seconds).map(place).collect()
    }

    /// The same, a metre to the north and 2 % too fast.
    fn drifting(seconds: usize) -> Vec<TimedPlace> {
        let drift = |p: &TimedPlace| TimedPlace {
            place: Point3::new(1.0, 1.02 * p.place.y, 0.0),
            ..*p
        };
        straight(seconds).iter().map(drift).collect()
    }

    #[test]
    fn the_absolute_error_is_the_distance_and_alignment_takes_its_share() {
        let pairs = associate(&drifting(10), &straight(10), 1.0);
        let plain = absolute_errors(&pairs, TrajectoryAlignment::None);
        assert!((plain[0].1 - 1.0).abs() < 1e-12);
        assert!((plain[100].1 - 5.0_f64.sqrt()).abs() < 1e-9);
        let from_start = absolute_errors(&pairs, TrajectoryAlignment::Origin);
        assert!((from_start[100].1 - 2.0).abs() < 1e-9);
        let scaled = absolute_errors(&pairs, TrajectoryAlignment::Similarity);
        let scaled = ErrorStatistics::of(scaled.iter().map(|e| e.1)).unwrap();
        assert!(scaled.greatest < 1e-9, "{scaled:?}");
    }

    #[test]
    fn the_relative_error_is_that_of_the_way_whatever_came_before() {
        let pairs = associate(&drifting(10), &straight(10), 1.0);
        for delta in [Delta::Samples(20), Delta::Seconds(2.0), Delta::Metres(20.0)] {
            let errors = relative_errors(&pairs, delta);
            assert_eq!(errors.len(), 81, "{delta:?}");
            assert!(errors.iter().all(|e| (e.1 - 0.4).abs() < 1e-9), "{delta:?}");
        }
    }

    #[test]
    fn a_gap_of_the_reference_has_no_errors() {
        let mut reference = straight(10);
        reference.retain(|r| !(3.0..6.0).contains(&r.time));
        let pairs = associate(&straight(10), &reference, 0.5);
        assert!(pairs.iter().all(|p| !(3.05..5.95).contains(&p.time)));
        assert!(pairs.len() >= 70);
    }
}
