//! Association by agreement: cliques of pairs, weighed against each other and against chance.

use nalgebra::{Matrix2, Vector2};
use std::f64::consts::{PI, TAU};

use super::candidates::{Candidate, candidates};
use super::fix::{JointFix, SharedErrorFit};
use super::graph::AgreementGraph;
use super::{AssociationProblem, AssociationSettings};
use pilotage_base::statistics::chi_square_quantile;

/// Places of the aircraft that are weighed against each other.
const HYPOTHESES: usize = 4;
/// Rounds in which pairs are gathered around a place and the place is fitted to them.
const ROUNDS: usize = 3;

/// Neighbours by which it is told how densely landmarks stand about one.
const NEIGHBOURS: usize = 4;

/// A pair that fits the likeliest place, accepted or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssociatedPair {
    /// Index of the observed landmark.
    pub observed: usize,
    /// Index of the possible one.
    pub possible: usize,
    /// Probability that the two are the same thing.
    pub probability: f64,
    /// Squared distance of the two in standard deviations.
    pub distance_squared: f64,
    /// Whether it is believed.
    pub accepted: bool,
}

/// Association of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Association {
    /// Pairs that fit the likeliest place, by observed landmark.
    pub pairs: Vec<AssociatedPair>,
    /// Probability that the likeliest place is right, against the others and against chance.
    pub probability: f64,
    /// Fix by the accepted pairs, if they are enough and fit together.
    pub fix: Option<JointFix>,
    /// Number of possible landmarks that each observed one may be by class, size and place.
    pub similar: Vec<usize>,
}

/// A place of the aircraft, with what speaks for it.
struct Hypothesis {
    pairs: Vec<(Candidate, AssociatedPair)>,
    /// Logarithm of its likelihood times its prior, over that of chance.
    log_odds: f64,
}

/// Associates what was observed with what is possible.
///
/// ```
/// use nalgebra::{Matrix2, Matrix2x4, Matrix4, Vector2};
/// use pilotage_reference::association::*;
/// use pilotage_reference::GenericClass::Building;
///
/// // Five houses, and the aircraft 30 m north and 10 m west of where it is believed to be.
/// let offset = Vector2::new(30.0, -10.0);
/// let places = [[0.0, 0.0], [60.0, 5.0], [-20.0, 70.0], [45.0, -80.0], [-90.0, -30.0]].map(Vector2::from);
/// let (class, covariance, size, by_pose) = (Building, Matrix2::identity(), 12.0, Matrix2x4::zeros());
/// let possible = places.map(|place| PossibleLandmark { class, place, covariance, size, detection: 0.9 });
/// let seen = places.map(|place| ObservedLandmark { class, place: place - offset, covariance, size, by_pose });
/// let view = [[-150.0, -150.0], [-150.0, 150.0], [150.0, 150.0], [150.0, -150.0]].map(Vector2::from);
/// let common = CommonError { position: covariance * 900.0, pose: Matrix4::identity() * 1e-4 };
/// let problem = AssociationProblem { observed: &seen, possible: &possible, common, view: &view };
/// let fix = associate(&problem, &AssociationSettings::default()).fix.ok_or("no fix")?;
/// assert!((fix.offset - offset).norm() < 1e-6);
/// # Ok::<(), &str>(())
/// ```
///
/// The densest clique of the agreement graph gives a place; pairs are gathered around it, one to one; the next clique
/// is sought among the pairs that do not lie there. Each place is weighed by the pairs that it explains and its
/// distance from the belief. A pair is believed if its probability is, and the pairs together if their joint
/// chi-square is inside its gate.
pub fn associate(problem: &AssociationProblem<'_>, settings: &AssociationSettings) -> Association {
    let all = candidates(problem, settings);
    let mut similar = vec![0; problem.observed.len()];
    for pair in &all {
        similar[pair.observed] += 1;
    }
    let graph = AgreementGraph::of(problem, &all, settings);
    let mut is_left = vec![true; all.len()];
    let mut places = Vec::new();
    for _ in 0..HYPOTHESES {
        let clique = graph.densest(&is_left);
        if clique.len() < 2 {
            break;
        }
        for index in &clique {
            is_left[*index] = false;
        }
        let start = clique.iter().map(|index| &all[*index]);
        let Some((hypothesis, around)) = gathered(problem, &all, start, settings) else {
            continue;
        };
        for index in around {
            is_left[index] = false;
        }
        places.push(hypothesis);
    }
    let best = places
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.log_odds.total_cmp(&b.1.log_odds));
    let Some((best, top)) = best.map(|(index, place)| (index, place.log_odds.max(0.0))) else {
        return Association {
            similar,
            ..Association::default()
        };
    };
    // Chance has the odds of one.
    let others: f64 = places.iter().map(|p| (p.log_odds - top).exp()).sum();
    let likeliest = places.swap_remove(best);
    let probability = (likeliest.log_odds - top).exp() / (others + (-top).exp());
    Association {
        similar,
        ..accepted(problem, likeliest, probability, settings)
    }
}

/// The pairs around the place of `start`, and the indices of all candidates that would fit there.
fn gathered<'a>(
    problem: &AssociationProblem<'_>,
    all: &[Candidate],
    start: impl Iterator<Item = &'a Candidate>,
    settings: &AssociationSettings,
) -> Option<(Hypothesis, Vec<usize>)> {
    let gate = chi_square_quantile(settings.gate, 2.0);
    let mut fit = SharedErrorFit::to(problem, start, true)?;
    let mut around: Vec<(usize, f64, f64)> = Vec::new();
    let mut chosen: Vec<usize> = Vec::new();
    for _ in 0..ROUNDS {
        around.clear();
        for (index, pair) in all.iter().enumerate() {
            let residual = fit.residual(problem, pair);
            let covariance: Matrix2<f64> = pair.covariance + fit.spread(problem, pair);
            let squared = (covariance.try_inverse()? * residual).dot(&residual);
            if squared <= gate {
                let density = (-0.5 * squared).exp() / (TAU * covariance.determinant().sqrt());
                around.push((index, squared, density * pair.size_ratio));
            }
        }
        around.sort_by(|a, b| b.2.total_cmp(&a.2));
        let mut observed = vec![false; problem.observed.len()];
        let mut possible = vec![false; problem.possible.len()];
        let before = std::mem::take(&mut chosen);
        for (place, (index, ..)) in around.iter().enumerate() {
            let pair = &all[*index];
            if !observed[pair.observed] && !possible[pair.possible] {
                (observed[pair.observed], possible[pair.possible]) = (true, true);
                chosen.push(place);
            }
        }
        let pairs = chosen.iter().map(|place| &all[around[*place].0]);
        fit = SharedErrorFit::to(problem, pairs, true)?;
        if chosen == before {
            break;
        }
    }
    let pairs = weighed(problem, all, &around, &chosen, settings);
    let mut log_odds =
        log_prior(problem, &fit)? + log_unmatched(problem, &fit, chosen.len(), settings);
    for place in &chosen {
        let (index, _, weight) = around[*place];
        let missed = 1.0 / problem.possible[all[index].possible].detection - 1.0;
        log_odds += (weight / (missed * density(problem, &all[index]))).ln();
    }
    let indices = around.iter().map(|(index, ..)| *index).collect();
    Some((Hypothesis { pairs, log_odds }, indices))
}

/// Number of observed landmarks of the class of a pair per square metre around it, by the distance of its neighbours, at
/// least that of the whole picture.
///
/// Trees stand by trees and houses by houses: beside a landmark, something else of its class is likelier than anywhere.
fn density(problem: &AssociationProblem<'_>, pair: &Candidate) -> f64 {
    let own = &problem.observed[pair.observed];
    let others = problem.observed.iter().filter(|o| o.class == own.class);
    let mut squares: Vec<f64> = others
        .map(|other| (other.place - own.place).norm_squared())
        .collect();
    let overall = squares.len() as f64 / problem.area();
    if squares.len() <= NEIGHBOURS {
        return overall;
    }
    // The landmark itself is the nearest.
    let (_, farthest, _) = squares.select_nth_unstable_by(NEIGHBOURS, f64::total_cmp);
    // Of a Poisson process the last of k neighbours has k - 1 others in its circle, without bias.
    let around = (NEIGHBOURS - 1) as f64 / (PI * *farthest);
    around.max(overall)
}

/// Logarithm of the likelihood of what has no partner at the fitted place, over that where all that is observed is
/// chance: landmarks in view that were missed, and observed ones that the table lacks, a Poisson process of a known
/// share of what it would be by chance.
fn log_unmatched(
    problem: &AssociationProblem<'_>,
    fit: &SharedErrorFit,
    matched: usize,
    settings: &AssociationSettings,
) -> f64 {
    let offset: Vector2<f64> = fit.state.fixed_rows::<2>(0).into();
    let in_view = problem
        .possible
        .iter()
        .filter(|possible| problem.is_in_view(possible.place - offset));
    let missed: f64 = in_view
        .map(|possible| (1.0 - possible.detection).ln())
        .sum();
    let count = problem.observed.len();
    let fewer = (1.0 - settings.clutter) * count as f64;
    missed + fewer + (count - matched) as f64 * settings.clutter.ln()
}

/// Logarithm of the probability of the fitted place before anything was observed: the belief there, over the area that
/// the fit leaves open.
fn log_prior(problem: &AssociationProblem<'_>, fit: &SharedErrorFit) -> Option<f64> {
    let offset = fit.state.fixed_rows::<2>(0);
    let shared = fit.state.fixed_rows::<4>(2);
    let known = problem.common.position.try_inverse()?;
    let pose = problem.common.pose.try_inverse()?;
    let squared = (known * offset).dot(&offset) + (pose * shared).dot(&shared);
    let determinants = fit.position().determinant() / problem.common.position.determinant();
    Some(0.5 * determinants.ln() - 0.5 * squared)
}

/// The chosen pairs with their probabilities if the place is right: each against all that compete for its two
/// landmarks, and against clutter.
fn weighed(
    problem: &AssociationProblem<'_>,
    all: &[Candidate],
    around: &[(usize, f64, f64)],
    chosen: &[usize],
    settings: &AssociationSettings,
) -> Vec<(Candidate, AssociatedPair)> {
    let mut by_observed = vec![0.0; problem.observed.len()];
    let mut by_possible = vec![0.0; problem.possible.len()];
    let detected =
        |index: usize, weight: f64| weight * problem.possible[all[index].possible].detection;
    for (index, _, weight) in around {
        by_observed[all[*index].observed] += detected(*index, *weight);
        by_possible[all[*index].possible] += detected(*index, *weight);
    }
    let mut pairs: Vec<(Candidate, AssociatedPair)> = chosen
        .iter()
        .map(|place| {
            let (index, distance_squared, weight) = around[*place];
            let pair = all[index];
            let own = detected(index, weight);
            let rivals = by_observed[pair.observed] + by_possible[pair.possible] - own;
            // A wrong pair needs an observed landmark that the table lacks, and a possible one that was missed.
            let missed = 1.0 - problem.possible[pair.possible].detection;
            let chance = missed * settings.clutter * density(problem, &pair);
            let told = AssociatedPair {
                observed: pair.observed,
                possible: pair.possible,
                probability: own / (rivals + chance),
                distance_squared,
                accepted: false,
            };
            (pair, told)
        })
        .collect();
    pairs.sort_by_key(|(_, told)| told.observed);
    pairs
}

/// Accepts the pairs that are likely enough, if they are enough and fit together.
fn accepted(
    problem: &AssociationProblem<'_>,
    mut likeliest: Hypothesis,
    probability: f64,
    settings: &AssociationSettings,
) -> Association {
    for (_, told) in &mut likeliest.pairs {
        told.probability *= probability;
        told.accepted = told.probability >= settings.least_probability;
    }
    let believed = likeliest.pairs.iter().filter(|(_, told)| told.accepted);
    let believed = believed.map(|(pair, _)| pair);
    let is_enough = believed.clone().count() >= settings.least_pairs;
    let fix = JointFix::of(problem, believed).filter(|fix| {
        let most = chi_square_quantile(settings.gate, fix.degrees.max(1) as f64);
        is_enough && fix.chi_square <= most
    });
    if fix.is_none() {
        for (_, told) in &mut likeliest.pairs {
            told.accepted = false;
        }
    }
    Association {
        pairs: likeliest.pairs.into_iter().map(|(_, told)| told).collect(),
        probability,
        fix,
        similar: Vec::new(),
    }
}
