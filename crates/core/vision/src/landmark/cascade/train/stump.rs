//! The regression stump that fits weighted targets best.

use super::table::BinTable;

/// Share of the weight that is looked at before a feature is given up.
const LOOKED_AT: f64 = 0.3;
/// Codes of a pattern.
const CODES: usize = 256;

/// Vote of a cascade: one of two numbers, by one feature.
#[derive(Clone, Debug, PartialEq)]
pub struct Stump {
    /// Number of the feature.
    pub feature: usize,
    /// Decision which samples go left.
    pub split: SampleSplit,
    /// Votes for the samples that go left and for the others.
    pub leaves: [f32; 2],
}

/// Decision which samples go left.
#[derive(Clone, Debug, PartialEq)]
pub enum SampleSplit {
    /// Those less than this.
    Below(f32),
    /// Those with one of these codes, a bit each.
    Among([u32; 8]),
}

/// A stump in the terms of a table.
struct StumpFit {
    feature: usize,
    /// For each bin whether it goes left.
    left: [bool; CODES],
    /// The last bin that goes left, where bins have an order.
    last: usize,
    leaves: [f64; 2],
    /// Part of the weighted squares of the targets that it explains.
    gain: f64,
}

/// Sums over the samples of a bin.
#[derive(Clone, Copy, Default)]
struct Bin {
    weight: f64,
    /// Weight times target.
    sum: f64,
}

/// The stump with the least weighted squared error (`GentleBoost`, Friedman, Hastie and Tibshirani 2000),
/// and what it says of each sample. `None` if no feature parts the samples.
///
/// `offered` lists the features to choose among, `order` the samples that count, the weightiest first; targets are -1 or 1. The error on the
/// weightiest few can only grow with further samples: a feature that is worse on them than another on all
/// is not looked at further (Appel, Fuchs, Dollár and Perona 2013), which changes nothing.
pub(super) fn best_stump(
    table: &BinTable,
    offered: &[usize],
    order: &[u32],
    weights: &[f64],
    targets: &[i8],
) -> Option<(Stump, Vec<f32>)> {
    let total: f64 = order.iter().map(|i| weights[*i as usize]).sum();
    let mut sum = 0.0;
    let mut few = 0;
    while few < order.len() && sum < LOOKED_AT * total {
        sum += weights[order[few] as usize];
        few += 1;
    }
    let weighted: Vec<(u32, f64, f64)> = order
        .iter()
        .map(|&i| {
            let w = weights[i as usize];
            (i, w, w * f64::from(targets[i as usize]))
        })
        .collect();
    let (first, rest) = weighted.split_at(few);
    let fitted = |feature: usize, bins: &[Bin; CODES]| {
        if table.is_of_codes() {
            by_codes(feature, bins)
        } else {
            by_order(feature, bins)
        }
    };
    // Least error that each can have on all.
    let mut bounds: Vec<(f64, usize)> = offered
        .iter()
        .map(|&feature| {
            let mut bins = [Bin::default(); CODES];
            count(table.row(feature), first, &mut bins);
            (sum - fitted(feature, &bins).gain, feature)
        })
        .collect();
    bounds.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut best: Option<StumpFit> = None;
    for (bound, feature) in bounds {
        if best.as_ref().is_some_and(|b| bound > total - b.gain) {
            break;
        }
        let mut bins = [Bin::default(); CODES];
        count(table.row(feature), first, &mut bins);
        count(table.row(feature), rest, &mut bins);
        let fit = fitted(feature, &bins);
        let is_better = |b: &StumpFit| (fit.gain, b.feature) > (b.gain, feature);
        if fit.leaves[0] != fit.leaves[1] && best.as_ref().is_none_or(is_better) {
            best = Some(fit);
        }
    }
    let fit = best?;
    let split = if table.is_of_codes() {
        let mut words = [0_u32; 8];
        for code in (0..CODES).filter(|c| fit.left[*c]) {
            words[code >> 5] |= 1 << (code & 31);
        }
        SampleSplit::Among(words)
    } else {
        SampleSplit::Below(table.edge(fit.feature, fit.last)?)
    };
    let leaves = fit.leaves.map(|leaf| leaf as f32);
    let row = table.row(fit.feature).iter();
    let says = row.map(|bin| leaves[usize::from(!fit.left[usize::from(*bin)])]);
    let says = says.collect();
    let stump = Stump {
        feature: fit.feature,
        split,
        leaves,
    };
    Some((stump, says))
}

fn count(row: &[u8], samples: &[(u32, f64, f64)], bins: &mut [Bin; CODES]) {
    for (i, weight, sum) in samples {
        let bin = &mut bins[usize::from(row[*i as usize])];
        bin.weight += weight;
        bin.sum += sum;
    }
}

fn explained(bin: Bin) -> f64 {
    if bin.weight > 0.0 {
        bin.sum * bin.sum / bin.weight
    } else {
        0.0
    }
}

/// The best split of bins that are walked through in `order`; after how many, and what it explains.
fn best_cut(
    bins: &[Bin; CODES],
    order: impl Iterator<Item = usize> + Clone,
) -> (usize, f64, [f64; 2]) {
    let mut all = Bin::default();
    for bin in order.clone() {
        all.weight += bins[bin].weight;
        all.sum += bins[bin].sum;
    }
    let mean = |b: Bin| {
        if b.weight > 0.0 {
            b.sum / b.weight
        } else {
            0.0
        }
    };
    let mut best = (0, explained(all), [mean(all); 2]);
    let mut left = Bin::default();
    for (number, bin) in order.enumerate() {
        left.weight += bins[bin].weight;
        left.sum += bins[bin].sum;
        let right = Bin {
            weight: all.weight - left.weight,
            sum: all.sum - left.sum,
        };
        if left.weight <= 0.0 || right.weight <= 1e-12 * all.weight {
            continue;
        }
        let gain = explained(left) + explained(right);
        if gain > best.1 {
            best = (number + 1, gain, [mean(left), mean(right)]);
        }
    }
    best
}

fn by_order(feature: usize, bins: &[Bin; CODES]) -> StumpFit {
    let (count, gain, leaves) = best_cut(bins, 0..super::table::BINS);
    StumpFit {
        feature,
        left: std::array::from_fn(|bin| bin < count),
        last: count.saturating_sub(1),
        leaves,
        gain,
    }
}

/// Codes are put in the order of their mean targets: one of the cuts is then the best of all subsets
/// (Fisher 1958).
fn by_codes(feature: usize, bins: &[Bin; CODES]) -> StumpFit {
    let mut order = [0_usize; CODES];
    let mut used = 0;
    for (code, bin) in bins.iter().enumerate() {
        if bin.weight > 0.0 {
            order[used] = code;
            used += 1;
        }
    }
    let order = &mut order[..used];
    let mean = |code: usize| bins[code].sum / bins[code].weight;
    order.sort_unstable_by(|a, b| mean(*a).total_cmp(&mean(*b)).then(a.cmp(b)));
    let (count, gain, leaves) = best_cut(bins, order.iter().copied());
    // What was never seen goes where the next code of like bits would: to the right, with most of them.
    let mut left = [false; CODES];
    for code in &order[..count] {
        left[*code] = true;
    }
    StumpFit {
        feature,
        left,
        last: 0,
        leaves,
        gain,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt as _, SeedableRng as _};
    use rand_chacha::ChaCha8Rng;

    /// Weighted squared error of a stump.
    fn error(says: &[f32], weights: &[f64], targets: &[i8]) -> f64 {
        let of = |i: usize| weights[i] * (f64::from(targets[i]) - f64::from(says[i])).powi(2);
        (0..says.len()).map(of).sum()
    }

    fn samples(seed: u64, count: usize) -> (Vec<f64>, Vec<i8>, Vec<u32>) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let weights: Vec<f64> = (0..count).map(|_| random.random::<f64>().powi(4)).collect();
        let targets: Vec<i8> = (0..count)
            .map(|_| if random.random() { 1 } else { -1 })
            .collect();
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.sort_by(|a, b| weights[*b as usize].total_cmp(&weights[*a as usize]));
        (weights, targets, order)
    }

    #[test]
    fn no_stump_on_any_feature_is_better_though_most_are_not_looked_at() {
        let (count, features) = (200, 40);
        for seed in 0..5 {
            let (weights, targets, order) = samples(seed, count);
            let mut random = ChaCha8Rng::seed_from_u64(seed + 100);
            let values: Vec<f32> = (0..count * features)
                .map(|i| {
                    let helps = f32::from(targets[i / features]) * (i % features) as f32 * 0.01;
                    helps + random.random::<f32>()
                })
                .collect();
            let table = BinTable::of_numbers(count, features, |i, row| {
                row.copy_from_slice(&values[i * features..(i + 1) * features]);
            });
            let (stump, says) = best_stump(
                &table,
                &(0..table.features()).collect::<Vec<_>>(),
                &order,
                &weights,
                &targets,
            )
            .unwrap();
            let found = error(&says, &weights, &targets);
            for feature in 0..features {
                let column: Vec<f32> = (0..count).map(|s| values[s * features + feature]).collect();
                for bin in 0..super::super::table::BINS {
                    let Some(edge) = table.edge(feature, bin) else {
                        continue;
                    };
                    let mean = |left: bool| {
                        let own = (0..count).filter(|s| (column[*s] < edge) == left);
                        let (w, wy) = own.fold((0.0, 0.0), |(w, wy), s| {
                            (w + weights[s], wy + weights[s] * f64::from(targets[s]))
                        });
                        (wy / w) as f32
                    };
                    let means = [mean(true), mean(false)];
                    let says: Vec<f32> = column
                        .iter()
                        .map(|v| means[usize::from(*v >= edge)])
                        .collect();
                    let other = error(&says, &weights, &targets);
                    assert!(
                        found <= other + 1e-6,
                        "{stump:?}: {found} {other} at {feature} {edge}"
                    );
                }
            }
        }
    }

    #[test]
    fn codes_are_parted_as_well_as_any_subset_of_them_can() {
        let (weights, targets, order) = samples(7, 120);
        let mut random = ChaCha8Rng::seed_from_u64(8);
        let names = [3_u8, 70, 131, 200, 255];
        let codes: Vec<u8> = (0..120).map(|_| names[random.random_range(0..5)]).collect();
        let table = BinTable::of_codes(&codes, 1);
        let (stump, says) = best_stump(
            &table,
            &(0..table.features()).collect::<Vec<_>>(),
            &order,
            &weights,
            &targets,
        )
        .unwrap();
        let found = error(&says, &weights, &targets);
        for subset in 1..31_u32 {
            let goes_left = |code: u8| {
                let at = names.iter().position(|n| *n == code).unwrap();
                subset >> at & 1 == 1
            };
            let mean = |left: bool| {
                let own = (0..120).filter(|s| goes_left(codes[*s]) == left);
                let (w, wy) = own.fold((0.0, 0.0), |(w, wy), s| {
                    (w + weights[s], wy + weights[s] * f64::from(targets[s]))
                });
                (wy / w) as f32
            };
            let means = [mean(true), mean(false)];
            let says: Vec<f32> = codes
                .iter()
                .map(|c| means[usize::from(!goes_left(*c))])
                .collect();
            assert!(
                found <= error(&says, &weights, &targets) + 1e-6,
                "{stump:?}"
            );
        }
        assert!(matches!(stump.split, SampleSplit::Among(_)));
    }

    #[test]
    fn samples_that_no_feature_parts_have_no_stump() {
        let table = BinTable::of_numbers(10, 3, |_, row| row.fill(1.0));
        let targets = [1, -1, 1, -1, 1, -1, 1, -1, 1, -1];
        let order: Vec<u32> = (0..10).collect();
        assert_eq!(
            best_stump(
                &table,
                &(0..table.features()).collect::<Vec<_>>(),
                &order,
                &[0.1; 10],
                &targets
            ),
            None
        );
    }
}
