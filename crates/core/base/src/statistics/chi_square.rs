//! The chi-square distribution and its inverse, for any number of degrees of freedom, and the normal one.

use std::cell::RefCell;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Rounds of the series and of the continued fraction; both need a few times √dof.
const MOST_ROUNDS: usize = 100_000;

/// Probability that a standard normal variable is at most `z`.
pub fn normal_probability(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Probability that a chi-square variable with `dof` degrees of freedom is at most `value`.
///
/// The regularised lower incomplete gamma function P(dof/2, value/2).
pub fn chi_square_probability(value: f64, dof: f64) -> f64 {
    if value <= 0.0 {
        return 0.0;
    }
    if value.is_infinite() {
        return 1.0;
    }
    let (lower, upper) = incomplete_gamma(0.5 * dof, 0.5 * value);
    if lower <= upper { lower } else { 1.0 - upper }
}

/// Most quantiles that are remembered.
const MOST_KNOWN: usize = 32;

/// Questions, as bits, and their answers.
type KnownQuantiles = Vec<((u64, u64), f64)>;

thread_local! {
    /// Quantiles that were asked for: gates ask for the same few again and again.
    static KNOWN: RefCell<KnownQuantiles> = const { RefCell::new(Vec::new()) };
}

/// Value that a chi-square variable with `dof` degrees of freedom stays below with `probability`.
///
/// `probability` in [0, 1]; 1 gives infinity. NaN outside, and for `dof` that is not positive.
///
/// ```
/// use pilotage_base::statistics::chi_square_quantile;
///
/// // Printed tables: 95 % of the squared errors of two components stay below 5.991.
/// assert!((chi_square_quantile(0.95, 2.0) - 5.991).abs() < 6e-4);
/// ```
pub fn chi_square_quantile(probability: f64, dof: f64) -> f64 {
    if !(dof > 0.0 && dof.is_finite() && (0.0..=1.0).contains(&probability)) {
        return f64::NAN;
    }
    if probability == 0.0 {
        return 0.0;
    }
    if probability == 1.0 {
        return f64::INFINITY;
    }
    KNOWN.with_borrow_mut(|known| {
        let asked = (probability.to_bits(), dof.to_bits());
        if let Some((_, value)) = known.iter().find(|(before, _)| *before == asked) {
            return *value;
        }
        let value = searched_quantile(probability, dof);
        if known.len() == MOST_KNOWN {
            known.clear();
        }
        known.push((asked, value));
        value
    })
}

/// The quantile by a search, for a probability within (0, 1).
fn searched_quantile(probability: f64, dof: f64) -> f64 {
    let a = 0.5 * dof;
    let upper_probability = 1.0 - probability;
    // Bracket, then Newton steps on the smaller tail, halving whenever one leaves the bracket.
    let (mut low, mut high) = (0.0, a.max(1.0));
    while incomplete_gamma(a, high).1 > upper_probability {
        low = high;
        high *= 2.0;
    }
    let mut x = 0.5 * (low + high);
    let log_norm = ln_gamma(a);
    for _ in 0..200 {
        let (lower, upper) = incomplete_gamma(a, x);
        let excess = if probability < 0.5 {
            lower - probability
        } else {
            upper_probability - upper
        };
        if excess > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let density = ((a - 1.0) * x.ln() - x - log_norm).exp();
        let newton = x - excess / density;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        let step = (next - x).abs();
        x = next;
        if step <= 1e-15 * x {
            break;
        }
    }
    2.0 * x
}

/// Regularised incomplete gamma functions P(a, x) and Q(a, x) = 1 - P, each accurate where small.
///
/// Series for x < a + 1, Lentz's continued fraction above (Abramowitz and Stegun 6.5.29, 6.5.31).
fn incomplete_gamma(a: f64, x: f64) -> (f64, f64) {
    if x <= 0.0 {
        return (0.0, 1.0);
    }
    let front = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let mut term = 1.0 / a;
        let mut sum = term;
        for n in 1..MOST_ROUNDS {
            term *= x / (a + n as f64);
            sum += term;
            if term < sum * 1e-17 {
                break;
            }
        }
        let lower = (front * sum).min(1.0);
        return (lower, 1.0 - lower);
    }
    let tiny = 1e-300;
    let mut b = x + 1.0 - a;
    let mut c = 1.0 / tiny;
    let mut d = 1.0 / b;
    let mut fraction = d;
    for n in 1..MOST_ROUNDS {
        let n = n as f64;
        let numerator = -n * (n - a);
        b += 2.0;
        d = numerator * d + b;
        if d.abs() < tiny {
            d = tiny;
        }
        c = b + numerator / c;
        if c.abs() < tiny {
            c = tiny;
        }
        d = 1.0 / d;
        let change = d * c;
        fraction *= change;
        if (change - 1.0).abs() < 1e-16 {
            break;
        }
    }
    let upper = (front * fraction).clamp(0.0, 1.0);
    (1.0 - upper, upper)
}

/// Logarithm of the gamma function for positive arguments.
///
/// Stirling's series above 15, reached by the recurrence Γ(x + 1) = x Γ(x).
fn ln_gamma(x: f64) -> f64 {
    let mut x = x;
    let mut product = 1.0;
    while x < 15.0 {
        product *= x;
        x += 1.0;
    }
    let inverse = 1.0 / x;
    let square = inverse * inverse;
    let series = inverse
        * (1.0 / 12.0
            - square
                * (1.0 / 360.0
                    - square
                        * (1.0 / 1260.0
                            - square
                                * (1.0 / 1680.0
                                    - square * (1.0 / 1188.0 - square * (691.0 / 360_360.0))))));
    (x - 0.5) * x.ln() - x + 0.5 * (2.0 * PI).ln() + series - product.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_equal_the_printed_tables() {
        // Probability, degrees of freedom, value (NIST/SEMATECH e-Handbook, table 1.3.6.7.4).
        for (p, dof, value) in [
            (0.90, 1.0, 2.706),
            (0.95, 1.0, 3.841),
            (0.95, 2.0, 5.991),
            (0.99, 2.0, 9.210),
            (0.999, 2.0, 13.816),
            (0.95, 4.0, 9.488),
            (0.975, 10.0, 20.483),
            (0.025, 10.0, 3.247),
            (0.05, 100.0, 77.929),
            (0.95, 100.0, 124.342),
        ] {
            let got = chi_square_quantile(p, dof);
            assert!(
                (got - value).abs() < 6e-4,
                "p {p} dof {dof}: {got} not {value}"
            );
        }
    }

    #[test]
    fn two_degrees_of_freedom_are_an_exponential() {
        for p in [1e-6, 0.1, 0.5, 0.9, 0.997, 1.0 - 1e-9] {
            let exact = -2.0 * f64::ln_1p(-p);
            let got = chi_square_quantile(p, 2.0);
            assert!((got / exact - 1.0).abs() < 1e-13, "{p}: {got} {exact}");
        }
    }

    #[test]
    fn the_quantile_undoes_the_probability_for_any_size() {
        for dof in [0.5, 1.0, 3.0, 8.0, 37.0, 1000.0, 120_000.0] {
            for p in [1e-4, 0.025, 0.5, 0.7, 0.975, 0.9999] {
                let back = chi_square_probability(chi_square_quantile(p, dof), dof);
                assert!((back - p).abs() < 1e-9, "dof {dof} p {p} back {back}");
            }
        }
    }

    #[test]
    fn impossible_questions_have_no_number_for_an_answer() {
        assert!(chi_square_quantile(0.5, 0.0).is_nan());
        assert!(chi_square_quantile(1.5, 2.0).is_nan());
        assert_eq!(chi_square_quantile(0.0, 2.0), 0.0);
        assert_eq!(chi_square_quantile(1.0, 2.0), f64::INFINITY);
        assert_eq!(chi_square_probability(-1.0, 2.0), 0.0);
    }

    #[test]
    fn the_normal_distribution_has_its_known_quantiles() {
        for (z, p) in [(-1.959_963_985, 0.025), (0.0, 0.5), (1.0, 0.841_344_746)] {
            assert!((normal_probability(z) - p).abs() < 1e-8, "{z}");
        }
    }
}
