//! The densest set of pairs that all agree.

use super::graph::AgreementGraph;

/// Steps of the power iteration.
const STEPS: usize = 40;
/// Change of the vector below which it has come to rest.
const AT_REST: f32 = 1e-4;

impl AgreementGraph {
    /// A set of pairs each of which agrees with every other, the densest as far as the principal eigenvector of the
    /// graph tells; pairs that `is_left` denies are left out.
    ///
    /// The vector that a power iteration converges to is large at the pairs of the densest part (CLIPPER of Lusk and How
    /// 2021, without its penalty: the rounding sees to it that all of the set agree).
    pub fn densest(&self, is_left: &[bool]) -> Vec<usize> {
        let count = self.neighbours.len();
        let mut weights: Vec<f32> = is_left
            .iter()
            .map(|left| f32::from(u8::from(*left)))
            .collect();
        for _ in 0..STEPS {
            let mut next = vec![0.0; count];
            for (index, own) in self.neighbours.iter().enumerate() {
                if is_left[index] {
                    let others: f32 = own.iter().map(|(k, a)| a * weights[*k as usize]).sum();
                    next[index] = weights[index] + others;
                }
            }
            let length = next.iter().map(|w| w * w).sum::<f32>().sqrt();
            if length <= 0.0 {
                return Vec::new();
            }
            let mut change = 0.0_f32;
            for (next, before) in next.iter_mut().zip(&weights) {
                *next /= length;
                change = change.max((*next - before).abs());
            }
            weights = next;
            if change < AT_REST {
                break;
            }
        }
        let mut order: Vec<usize> = (0..count).filter(|k| is_left[*k]).collect();
        order.sort_by(|a, b| weights[*b].total_cmp(&weights[*a]).then(a.cmp(b)));
        let mut agreeing = vec![0_usize; count];
        let mut chosen = Vec::new();
        for index in order {
            if agreeing[index] == chosen.len() {
                chosen.push(index);
                for (other, _) in &self.neighbours[index] {
                    agreeing[*other as usize] += 1;
                }
            }
        }
        chosen
    }
}
