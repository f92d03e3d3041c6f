//! Values of every feature on every sample, in few bits.

/// Bins of a feature that is a number; a pattern has 256 codes.
pub(super) const BINS: usize = 64;
/// Samples from which the edges of the bins are taken.
const RANKED: usize = 640;

/// For each feature, the bin of each sample.
pub(super) struct BinTable {
    samples: usize,
    /// Feature after feature.
    bins: Vec<u8>,
    /// For each feature that is a number the edges between its bins, ascending; none for a pattern.
    edges: Vec<Vec<f32>>,
}

impl BinTable {
    /// Of numbers: `fill` writes those of a sample, one for each feature. It is asked twice for some.
    pub fn of_numbers(
        samples: usize,
        features: usize,
        mut fill: impl FnMut(usize, &mut [f32]),
    ) -> Self {
        let step = samples.div_ceil(RANKED).max(1);
        let ranked: Vec<usize> = (0..samples).step_by(step).collect();
        let mut values = vec![0.0; ranked.len() * features];
        for (sample, row) in ranked.iter().zip(values.chunks_exact_mut(features.max(1))) {
            fill(*sample, row);
        }
        let mut column = vec![0.0; ranked.len()];
        let edges: Vec<Vec<f32>> = (0..features)
            .map(|feature| {
                for (i, value) in column.iter_mut().enumerate() {
                    *value = values[i * features + feature];
                }
                edges_of(&mut column)
            })
            .collect();
        let mut bins = vec![0; samples * features];
        let mut row = vec![0.0; features];
        for sample in 0..samples {
            fill(sample, &mut row);
            for (feature, (value, edges)) in row.iter().zip(&edges).enumerate() {
                let bin = edges.partition_point(|edge| edge <= value);
                bins[feature * samples + sample] = bin as u8;
            }
        }
        Self {
            samples,
            bins,
            edges,
        }
    }

    /// Of patterns, sample after sample, `features` each.
    pub fn of_codes(codes: &[u8], features: usize) -> Self {
        let samples = codes.len() / features.max(1);
        let mut bins = vec![0; codes.len()];
        for (sample, row) in codes.chunks_exact(features.max(1)).enumerate() {
            for (feature, code) in row.iter().enumerate() {
                bins[feature * samples + sample] = *code;
            }
        }
        Self {
            samples,
            bins,
            edges: Vec::new(),
        }
    }

    /// Number of features.
    pub fn features(&self) -> usize {
        self.bins.len() / self.samples.max(1)
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Whether features are codes without an order.
    pub fn is_of_codes(&self) -> bool {
        self.edges.is_empty()
    }

    /// Bins of all samples for a feature.
    pub fn row(&self, feature: usize) -> &[u8] {
        &self.bins[feature * self.samples..(feature + 1) * self.samples]
    }

    /// The edge above a bin.
    pub fn edge(&self, feature: usize, bin: usize) -> Option<f32> {
        self.edges.get(feature)?.get(bin).copied()
    }
}

/// At most [`BINS`] - 1 numbers between those of `ranked`, which part it into shares of like size.
fn edges_of(ranked: &mut [f32]) -> Vec<f32> {
    ranked.sort_unstable_by(f32::total_cmp);
    let mut edges: Vec<f32> = Vec::with_capacity(BINS - 1);
    for i in 1..BINS {
        let at = (i * ranked.len() / BINS).min(ranked.len().saturating_sub(1));
        if at == 0 {
            continue;
        }
        let edge = 0.5 * (ranked[at - 1] + ranked[at]);
        // Between two that are equal there is no edge.
        if ranked[at - 1] < edge && edges.last().is_none_or(|last| *last < edge) {
            edges.push(edge);
        }
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_keep_the_order_of_the_numbers_and_part_them_at_their_edges() {
        let values: Vec<f32> = (0..300).map(|i| ((i * 37) % 300) as f32).collect();
        let table = BinTable::of_numbers(300, 1, |i, row| row[0] = values[i]);
        let row = table.row(0);
        assert!(row.iter().any(|b| usize::from(*b) == BINS - 1));
        for i in 0..300 {
            for bin in 0..BINS - 1 {
                let Some(edge) = table.edge(0, bin) else {
                    continue;
                };
                assert_eq!(values[i] < edge, usize::from(row[i]) <= bin);
            }
        }
    }

    #[test]
    fn a_feature_that_is_always_the_same_has_no_edge() {
        let table = BinTable::of_numbers(40, 1, |_, row| row[0] = 2.0);
        assert_eq!(table.edge(0, 0), None);
        assert!(table.row(0).iter().all(|b| *b == 0));
    }
}
