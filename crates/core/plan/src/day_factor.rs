//! Correlation of the landmarks of a map in their good and bad days.
//!
//! A low sun or snow makes all of them hard to recognise together. Were they taken for independent, a
//! day on which most of them fail would hardly ever be met in a prediction. One standard normal number
//! a day stands for what they share: a landmark that is recognised with probability r is so on a day if
//! `√ρ q + √(1-ρ) ε < Φ⁻¹(r)`, where q is the day's and ε its own (the one-factor model of Vasicek 1987,
//! "Probability of loss on loan portfolio"). ρ follows from how the rehearsals of the same days went.

use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

use super::draws::PredictionDraws;
use super::{ExpectedDetection, LookTally};
use pilotage_base::statistics::normal_probability;

/// Values of ρ that are weighed, evenly from zero.
const STEPS: usize = 20;
/// Values of q over which a day is averaged, and the outermost.
const NODES: (usize, f64) = (25, 4.0);

/// Detection that was stated of a landmark, and tallies of its rehearsals, day by day.
pub(super) type RehearsedLandmark<'a> = (ExpectedDetection, &'a [LookTally]);

/// Mean of ρ after those rehearsals, where any value was as likely before; zero where not two landmarks
/// were rehearsed on the same days.
pub(super) fn shared(landmarks: &[RehearsedLandmark<'_>]) -> f64 {
    let days = landmarks.iter().map(|(_, days)| days.len()).max();
    let days = days.unwrap_or(0);
    let rehearsed: Vec<&RehearsedLandmark<'_>> = landmarks
        .iter()
        .filter(|(_, tallies)| tallies.len() == days)
        .collect();
    if days == 0 || rehearsed.len() < 2 {
        return 0.0;
    }
    let thresholds: Vec<f64> = rehearsed
        .iter()
        .map(|(e, _)| quantile(e.recognised))
        .collect();
    let rhos: Vec<f64> = (0..STEPS).map(|i| i as f64 / STEPS as f64).collect();
    let logs: Vec<f64> = rhos
        .iter()
        .map(|rho| {
            let day = |day: usize| likelihood(&rehearsed, &thresholds, day, *rho).ln();
            (0..days).map(day).sum()
        })
        .collect();
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let weights: Vec<f64> = logs.iter().map(|l| (l - most).exp()).collect();
    let mean: f64 = rhos.iter().zip(&weights).map(|(rho, w)| rho * w).sum();
    mean / weights.iter().sum::<f64>()
}

/// Probability of what was seen of all landmarks on a day.
fn likelihood(
    landmarks: &[&RehearsedLandmark<'_>],
    thresholds: &[f64],
    day: usize,
    rho: f64,
) -> f64 {
    let (nodes, outermost) = NODES;
    let (mut sum, mut whole) = (0.0, 0.0);
    for node in 0..nodes {
        let q = outermost * (2.0 * node as f64 / (nodes - 1) as f64 - 1.0);
        let weight = (-0.5 * q * q).exp();
        let all = landmarks.iter().zip(thresholds).map(|((e, days), t)| {
            let recognised = normal_probability((t - rho.sqrt() * q) / (1.0 - rho).sqrt());
            let LookTally { looks, found, .. } = days[day];
            let hits = e.per_frame.powi(found as i32);
            let misses = (1.0 - e.per_frame).powi(looks.saturating_sub(found) as i32);
            let not = if found == 0 { 1.0 - recognised } else { 0.0 };
            recognised * hits * misses + not
        });
        sum += weight * all.product::<f64>();
        whole += weight;
    }
    (sum / whole).max(f64::MIN_POSITIVE)
}

/// The number that a standard normal variable is below with probability `p`.
fn quantile(p: f64) -> f64 {
    let (mut low, mut high) = (-8.0, 8.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if normal_probability(middle) < p {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// For each world of these weights and each of `landmarks` a number from 0 to 1: it is recognised where
/// that is more probable. All of them lie evenly for every landmark, whose probability is met as well as
/// so many worlds can, and they go together as `rho` says.
pub(super) fn worlds(weights: &[f64], landmarks: &[u32], rho: f64, seed: u64) -> Vec<Vec<f64>> {
    let mut draws = PredictionDraws::new(!seed); // not those of the flights
    let worlds = weights.len();
    let whole: f64 = weights.iter().sum();
    let days: Vec<f64> = (0..worlds)
        .map(|world| StandardNormal.sample(draws.of_all(world, 0)))
        .collect();
    let mut all = vec![Vec::with_capacity(landmarks.len()); worlds];
    for id in landmarks {
        let drawn: Vec<(f64, f64)> = (days.iter().enumerate())
            .map(|(world, q)| {
                let random = draws.of_landmark(world, *id, 0);
                let own: f64 = StandardNormal.sample(random);
                (rho.sqrt() * q + (1.0 - rho).sqrt() * own, random.random())
            })
            .collect();
        let mut order: Vec<usize> = (0..worlds).collect();
        order.sort_by(|a, b| drawn[*a].0.total_cmp(&drawn[*b].0));
        let mut before = 0.0;
        for world in order {
            let within = drawn[world].1;
            all[world].push((before + weights[world] * within) / whole);
            before += weights[world];
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix4;

    fn expected(recognised: f64) -> ExpectedDetection {
        ExpectedDetection {
            recognised,
            per_frame: 0.9,
            covariance: Matrix4::identity(),
        }
    }

    #[test]
    fn the_share_of_the_day_is_found_again_from_rehearsals() {
        for rho in [0.0, 0.3, 0.7] {
            let chances = [0.4, 0.5, 0.6, 0.7, 0.8, 0.6, 0.5, 0.7];
            let drawn = worlds(&[1.0; 60], &[1, 2, 3, 4, 5, 6, 7, 8], rho, 8);
            let tallies: Vec<Vec<LookTally>> = (0..chances.len())
                .map(|i| {
                    let found = |u: f64| usize::from(u < chances[i]) * 2;
                    let tally = |w: &Vec<f64>| LookTally {
                        looks: 2,
                        found: found(w[i]),
                        ..LookTally::default()
                    };
                    drawn.iter().map(tally).collect()
                })
                .collect();
            let landmarks: Vec<_> = chances
                .iter()
                .zip(&tallies)
                .map(|(p, t)| (expected(*p), t.as_slice()))
                .collect();
            let said = shared(&landmarks);
            assert!((said - rho).abs() < 0.15, "{rho}: {said}");
        }
    }

    #[test]
    fn every_landmark_is_recognised_in_its_share_of_the_worlds_however_they_go_together() {
        for rho in [0.0, 0.8] {
            let drawn = worlds(&[0.02; 50], &[1, 2, 3], rho, 9);
            for landmark in 0..3 {
                let known = drawn.iter().filter(|w| w[landmark] < 0.7).count();
                assert_eq!(known, 35, "{rho}");
            }
        }
        let together = worlds(&[1.0; 2000], &[1, 2], 0.8, 9);
        let neither = together.iter().filter(|w| w[0] > 0.9 && w[1] > 0.9).count();
        assert!(
            (60..160).contains(&neither),
            "0.01 if independent: {neither}"
        );
    }

    #[test]
    fn landmarks_of_which_no_day_is_known_are_taken_for_independent() {
        assert_eq!(shared(&[(expected(0.5), &[]), (expected(0.6), &[])]), 0.0);
    }
}
