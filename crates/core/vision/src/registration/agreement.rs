//! Agreement of matches with each other, and its likelihood by chance.

use nalgebra::{Matrix2, Vector2};

use super::patches::{PatchMatch, PatchSearch};

/// Triples of matches that are tried.
const TRIPLES: usize = 600;

/// A map of the plane that keeps parallels: from where patches were expected to where they were found.
#[derive(Clone, Copy, Debug)]
struct Shift {
    matrix: Matrix2<f64>,
    offset: Vector2<f64>,
}

impl Shift {
    /// That takes three expected places to where they were found; `None` if they lie nearly on a line.
    fn through(three: [&PatchMatch; 3]) -> Option<Self> {
        let [a, b, c] = three.map(|m| (m.expected.to_vector(), m.ground.to_vector()));
        let from = Matrix2::from_columns(&[b.0 - a.0, c.0 - a.0]);
        let to = Matrix2::from_columns(&[b.1 - a.1, c.1 - a.1]);
        let sides = from.column(0).norm() * from.column(1).norm();
        if from.determinant().abs() < 0.2 * sides {
            return None;
        }
        let matrix = to * from.try_inverse()?;
        Some(Self {
            matrix,
            offset: a.1 - matrix * a.0,
        })
    }

    fn residual(&self, m: &PatchMatch) -> f64 {
        (self.matrix * m.expected.to_vector() + self.offset - m.ground.to_vector()).norm()
    }
}

/// Matches that agree.
#[derive(Clone, Debug)]
pub struct Agreement {
    /// Indices of the matches.
    pub members: Vec<usize>,
    /// Distance within which they agree, metres.
    pub tolerance: f64,
    /// Logarithm (base 10) of the agreements so good that chance is expected to give.
    pub log_false_alarms: f64,
}

/// Logarithm (base 10) of the binomial coefficient.
fn log_choose(n: usize, k: usize) -> f64 {
    let gamma = |x: usize| libm::lgamma(x as f64 + 1.0);
    (gamma(n) - gamma(k) - gamma(n - k)) / std::f64::consts::LN_10
}

/// Number of agreements of `k` among `tried` patches within `radius` that are expected by chance, as a
/// logarithm (base 10), if a patch that does not belong is found anywhere within `reach` to each side.
///
/// A-contrario reasoning (Moisan and Stival 2004): every subset of `k` and every choice of the `fixed`
/// matches that determine the transform is tried; each of the others falls within `radius` with
/// probability πr² / (2 reach)².
fn log_false_alarms(tried: usize, k: usize, radius: f64, reach: f64, fixed: usize) -> f64 {
    if k <= fixed || tried < k {
        return 0.0;
    }
    let chance = (std::f64::consts::PI * radius * radius / (4.0 * reach * reach)).min(1.0);
    ((tried - fixed) as f64).log10()
        + log_choose(tried, k)
        + log_choose(k, fixed)
        + (k - fixed) as f64 * chance.log10()
}

/// The distance within which the residuals are least likely by chance: the logarithm (base 10) of the
/// false alarms, and the distance; `overlap` matches count as one.
pub fn least_likely(
    residuals: &[f64],
    search: &PatchSearch,
    fixed: usize,
    overlap: usize,
) -> (f64, f64) {
    let finest = search.plan.gsd;
    let reach = search.plan.reach as f64 * search.plan.gsd;
    let mut sorted = residuals.to_vec();
    sorted.sort_by(f64::total_cmp);
    let tried = search.tried.div_ceil(overlap);
    let mut best = (0.0, 0.0);
    for (index, radius) in sorted.iter().enumerate() {
        let radius = radius.max(finest);
        let members = (index + 1) / overlap;
        let alarms = log_false_alarms(tried, members, radius, reach, fixed);
        if alarms < best.0 {
            best = (alarms, radius);
        }
    }
    best
}

/// The agreement of the matches on one map of the plane that is least likely by chance.
pub fn agree(search: &PatchSearch) -> Option<Agreement> {
    let matches = &search.matches;
    let mut best: Option<(f64, f64, Shift)> = None;
    for [a, b, c] in triples(matches.len(), TRIPLES) {
        let Some(shift) = Shift::through([&matches[a], &matches[b], &matches[c]]) else {
            continue;
        };
        let size = shift.matrix.determinant();
        if !(0.5..2.0).contains(&size) {
            continue;
        }
        let residuals: Vec<f64> = matches.iter().map(|m| shift.residual(m)).collect();
        let (alarms, radius) = least_likely(&residuals, search, 3, 1);
        if best.as_ref().is_none_or(|(least, ..)| alarms < *least) {
            best = Some((alarms, radius, shift));
        }
    }
    let (log_false_alarms, tolerance, shift) = best?;
    let members = (0..matches.len())
        .filter(|&i| shift.residual(&matches[i]) <= tolerance)
        .collect();
    Some(Agreement {
        members,
        tolerance,
        log_false_alarms,
    })
}

/// About `most` triples of different numbers below `count`, the same every time and spread evenly.
fn triples(count: usize, most: usize) -> impl Iterator<Item = [usize; 3]> {
    // Multiples of the plastic number's powers fill the cube evenly (Roberts 2018).
    const STEPS: [f64; 3] = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_2,
    ];
    (1..=most)
        .map(move |i| STEPS.map(|step| ((i as f64 * step).fract() * count as f64) as usize))
        .filter(|[a, b, c]| a != b && b != c && a != c)
}
