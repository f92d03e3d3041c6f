//! Sobol's points, scrambled after Owen.
//!
//! Direction numbers by Joe and Kuo (2008, new-joe-kuo-6.21201). The scramble is Owen's nested one (1995): every bit is
//! turned, or not, by a random bit of its own for each way that leads to it, so that each point is uniform by itself and
//! all of them together keep their even spread. Independent scrambles of the same points tell how far their mean errs.

use super::philox::{Philox, Stream};

/// Bits of a coordinate, and so the logarithm of the most points.
const BITS: usize = 32;

/// Primitive polynomials with all their coefficients, and first direction numbers, by dimension.
const DIRECTIONS: [(u32, &[u32]); 21] = [
    (1, &[1]),
    (3, &[1]),
    (7, &[1, 3]),
    (11, &[1, 3, 1]),
    (13, &[1, 1, 1]),
    (19, &[1, 1, 3, 3]),
    (25, &[1, 3, 5, 13]),
    (37, &[1, 1, 5, 5, 17]),
    (41, &[1, 1, 5, 5, 5]),
    (47, &[1, 1, 7, 11, 19]),
    (55, &[1, 1, 5, 1, 1]),
    (59, &[1, 1, 1, 3, 11]),
    (61, &[1, 3, 5, 5, 31]),
    (67, &[1, 3, 3, 9, 7, 49]),
    (91, &[1, 1, 1, 15, 21, 21]),
    (97, &[1, 3, 1, 13, 27, 49]),
    (103, &[1, 1, 1, 15, 7, 5]),
    (109, &[1, 3, 1, 15, 13, 25]),
    (115, &[1, 1, 5, 5, 19, 61]),
    (131, &[1, 3, 7, 11, 23, 15, 103]),
    (137, &[1, 3, 7, 13, 13, 15, 69]),
];

/// Sobol's points of some dimensions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SobolPoints {
    /// For each dimension what each bit of a point's number turns.
    turned: Vec<[u32; BITS]>,
}

impl SobolPoints {
    /// Most dimensions that there are direction numbers for.
    pub const MOST_DIMENSIONS: usize = DIRECTIONS.len();

    /// Points of `dimensions` dimensions, or of the most that there are.
    pub fn new(dimensions: usize) -> Self {
        let directions = DIRECTIONS.iter().take(dimensions).enumerate();
        Self {
            turned: directions
                .map(|(dimension, (polynomial, first))| turned(dimension, *polynomial, first))
                .collect(),
        }
    }

    /// Coordinate of point number `number` before any scramble, in units of 2⁻³².
    ///
    /// ```
    /// use pilotage_study::SobolPoints;
    ///
    /// let points = SobolPoints::new(2);
    /// // The second point halves every coordinate, the first lies at zero.
    /// assert_eq!([0, 1].map(|number| points.bits(number, 1)), [0, 1 << 31]);
    /// ```
    pub fn bits(&self, number: u32, dimension: usize) -> u32 {
        let turned = self.turned[dimension].iter().enumerate();
        turned
            .filter(|(bit, _)| number >> bit & 1 == 1)
            .fold(0, |all, (_, turned)| all ^ turned)
    }

    /// Coordinate in (0, 1) of point number `number` after the scramble with this key.
    ///
    /// ```
    /// use pilotage_study::SobolPoints;
    ///
    /// // Of four points one lies in each quarter, whatever the scramble.
    /// let points = SobolPoints::new(2);
    /// let mut quarters = [0, 1, 2, 3].map(|number| (4.0 * points.scrambled(number, 1, 99)) as u8);
    /// quarters.sort_unstable();
    /// assert_eq!(quarters, [0, 1, 2, 3]);
    /// ```
    pub fn scrambled(&self, number: u32, dimension: usize, key: u64) -> f64 {
        let bits = scramble(self.bits(number, dimension), dimension as u32, key);
        (f64::from(bits) + 0.5) / 2.0_f64.powi(BITS as i32)
    }
}

/// The numbers that the bits of a point's number turn, in one dimension.
fn turned(dimension: usize, polynomial: u32, first: &[u32]) -> [u32; BITS] {
    let mut turned = [0_u32; BITS];
    if dimension == 0 {
        // Van der Corput's sequence.
        for (bit, turned) in turned.iter_mut().enumerate() {
            *turned = 1 << (BITS - 1 - bit);
        }
        return turned;
    }
    let degree = polynomial.ilog2() as usize;
    for bit in 0..BITS {
        turned[bit] = if let Some(first) = first.get(bit) {
            first << (BITS - 1 - bit)
        } else {
            let before = turned[bit - degree];
            (1..degree)
                .filter(|step| polynomial >> (degree - step) & 1 == 1)
                .fold(before ^ before >> degree, |all, step| {
                    all ^ turned[bit - step]
                })
        };
    }
    turned
}

/// `bits` after Owen's scramble of that dimension.
fn scramble(bits: u32, dimension: u32, key: u64) -> u32 {
    let random = Philox::new(key);
    let mut scrambled = 0;
    for bit in 0..BITS as u32 {
        // The way to this bit: all higher ones, as they were.
        let way = u64::from(bits) >> (BITS as u32 - bit);
        let number = way | u64::from(bit) << 32;
        let turn = random.of(Stream::Bit, number, dimension)[0] & 1;
        let place = BITS as u32 - 1 - bit;
        scrambled |= (bits >> place & 1 ^ turn) << place;
    }
    scrambled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_dimension_has_one_point_in_each_part_of_an_even_division_before_and_after_the_scramble()
     {
        let points = SobolPoints::new(SobolPoints::MOST_DIMENSIONS);
        for dimension in 0..SobolPoints::MOST_DIMENSIONS {
            for key in [1, 99] {
                let mut parts: Vec<u64> = (0..256)
                    .map(|n| (points.scrambled(n, dimension, key) * 256.0) as u64)
                    .collect();
                parts.sort_unstable();
                assert_eq!(parts, (0..256).collect::<Vec<_>>(), "{dimension}");
            }
        }
    }

    #[test]
    fn scrambles_keep_the_net_in_two_dimensions_and_differ_from_each_other() {
        let points = SobolPoints::new(2);
        // 64 points: one in each of 8 × 8, of 4 × 16, of 16 × 4 boxes.
        for (across, up) in [(8.0, 8.0), (4.0, 16.0), (16.0, 4.0)] {
            let mut boxes: Vec<(u64, u64)> = (0..64)
                .map(|n| {
                    let of = |d, parts: f64| (points.scrambled(n, d, 5) * parts) as u64;
                    (of(0, across), of(1, up))
                })
                .collect();
            boxes.sort_unstable();
            boxes.dedup();
            assert_eq!(boxes.len(), 64, "{across} × {up}");
        }
        assert_ne!(points.scrambled(3, 0, 1), points.scrambled(3, 0, 2));
    }

    #[test]
    fn a_scrambled_point_is_uniform_by_itself() {
        let points = SobolPoints::new(3);
        let count = 4000;
        let mean = (0..count)
            .map(|key| points.scrambled(5, 2, key))
            .sum::<f64>()
            / count as f64;
        assert!(
            (mean - 0.5).abs() < 3.0 / (12.0 * count as f64).sqrt(),
            "{mean}"
        );
    }

    #[test]
    fn the_mean_of_a_smooth_function_errs_far_less_than_by_random_points() {
        // ∫ (x + y²) over the unit square: 5/6. 256 random points err by √(1/12 + 4/45) / 16 = 0.026.
        let points = SobolPoints::new(2);
        let square = (0..20)
            .map(|key| {
                let sum: f64 = (0..256)
                    .map(|n| points.scrambled(n, 0, key) + points.scrambled(n, 1, key).powi(2))
                    .sum();
                (sum / 256.0 - 5.0 / 6.0).powi(2)
            })
            .sum::<f64>();
        let error = (square / 20.0).sqrt();
        assert!(error < 0.026 / 50.0, "{error}");
    }
}
