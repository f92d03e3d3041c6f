//! Wind, airspeed scale and heading by least squares from what satellite navigation says of the velocity.

use nalgebra::{Matrix2, Rotation2, SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::series::Series;
use super::slip::{SideForce, Slip};

/// Unknowns of the fit: a and b of the factor on the velocity over ground, what the wind adds north and east, drift,
/// length and offset of the sideslip.
const UNKNOWNS: usize = 7;
/// Times about that of a velocity over ground at which the air data are read for it, seconds: receivers tell means,
/// and noise is less.
const AVERAGED: [f64; 5] = [-0.1, -0.05, 0.0, 0.05, 0.1];
/// Fewest velocities of a fit.
const FEWEST: usize = 20;
/// Residuals beyond so many standard deviations are left out when the fit is made again.
const OUTLIER: f64 = 5.0;
/// Rounds in which the heading's offset moves to where it belongs, residuals say how much the samples weigh, and
/// outliers are left out.
const ROUNDS: usize = 5;
/// Least standard deviation of a sample, m/s: no air is smoother.
const SMOOTHEST: f64 = 0.1;

/// What is believed of the unknowns before any measurement, standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitPrior {
    /// Airspeed scale about 1.
    pub scale: f64,
    /// Heading offset about zero, radians.
    pub heading: f64,
    /// Heading drift about zero, rad/s; zero for a heading that does not drift.
    pub drift: f64,
    /// Wind per axis, m/s.
    pub wind: f64,
    /// Length of the sideslip about zero, m.
    pub slip_length: f64,
    /// Offset of the sideslip about zero, m²/s².
    pub slip_offset: f64,
}

/// One wind, one scale of the airspeed, one offset and drift of the heading, one readiness to slip sideways, by
/// whitened least squares.
///
/// The velocity over ground v of satellite navigation is smooth; gusts and noise are in the air velocity
/// u = V cos θ (cos ψ, sin ψ) as read. So u is explained by v and not the other way round, which would take every
/// gust for a smaller scale: u = a v + b v⊥ + c - d (t - t₀) (v - w)⊥ - s + e, with x⊥ the same turned to the
/// right by 90° and s the slip by the side force (`slip.rs`), linear in a, b, c, d and what makes s, the wind w of the
/// drift's term taken from the round before. The scale is 1 / |(a, b)|, the heading truly is atan2(-b, a) more, the wind solves a w + b w⊥ = -c. The error e remembers
/// itself: each sample counts by what is new in it, e(t) - φ e(t'), φ = exp(-(t - t') / τ).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AirFit {
    /// True airspeed over measured airspeed.
    pub scale: f64,
    /// Angle to be added to the heading as read at `reference`, radians.
    pub heading_offset: f64,
    /// Rate at which that angle grows, rad/s.
    pub heading_drift: f64,
    /// Time of the offset, seconds.
    pub reference: f64,
    /// Velocity of the air (north, east), m/s.
    pub wind: Vector2<f64>,
    /// Length L of the sideslip, m: the airplane slips to its right at (B - L f) / V with the specific force f along
    /// the right wing; zero where none is measured.
    pub slip_length: f64,
    /// Its standard deviation, m.
    pub slip_deviation: f64,
    /// Offset B of the sideslip, m²/s².
    pub slip_offset: f64,
    /// Standard deviation of the scale, by the residuals.
    pub scale_deviation: f64,
    /// Standard deviation of the heading's offset at `reference`, radians.
    pub offset_deviation: f64,
    /// Standard deviation of its drift, rad/s.
    pub drift_deviation: f64,
    /// Standard deviation of the wind per axis, m/s.
    pub wind_deviation: f64,
    /// Standard deviation per axis of what is left of the true air velocity, m/s.
    pub residual: f64,
    /// Logarithm of the likelihood of the air velocities as read, but for a constant that is the same for all
    /// fits to the same velocities over ground; what is left out counts as the largest residual that is not.
    pub log_likelihood: f64,
    /// Velocities that it rests on.
    pub samples: usize,
    /// Velocities left out because they fit to nothing.
    pub outliers: usize,
}

/// What is fitted to what.
pub struct FitProblem<'a> {
    /// Velocities over ground, m/s.
    pub velocities: &'a Series<Vector2<f64>>,
    /// Airspeed as read, m/s.
    pub airspeed: &'a Series,
    /// Horizontal part of the nose's direction.
    pub nose: &'a Series<Vector2<f64>>,
    /// Side force; may be empty.
    pub side_force: &'a SideForce,
    /// Stretch of the velocities, seconds.
    pub span: (f64, f64),
    /// Correlation time τ of the error, seconds.
    pub memory: f64,
    /// Standard deviation of the error per axis, m/s, before the residuals say it.
    pub deviation: f64,
    /// Priors.
    pub prior: FitPrior,
}

/// One velocity with what the air data say of it.
#[derive(Clone, Copy)]
struct Row {
    time: f64,
    ground: Vector2<f64>,
    air: Vector2<f64>,
    slip: Slip,
}

impl Row {
    /// Rows of the design matrix, north and east, `since` seconds after the reference, near a guess.
    fn design(&self, guess: &Guess, since: f64) -> [SVector<f64, UNKNOWNS>; 2] {
        let (n, e) = (self.ground.x, self.ground.y);
        let through_air = (self.ground - guess.wind) * since;
        let turned = Rotation2::new(guess.offset);
        let (slip, offset) = (turned * self.slip.per_length, turned * self.slip.per_offset);
        [
            SVector::from([n, -e, 1.0, 0.0, through_air.y, -slip.x, -offset.x]),
            SVector::from([e, n, 0.0, 1.0, -through_air.x, -slip.y, -offset.y]),
        ]
    }
}

/// Normal equations that grow.
struct Normal {
    matrix: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    right: SVector<f64, UNKNOWNS>,
    squares: f64,
    count: f64,
}

impl Normal {
    fn add(&mut self, row: &SVector<f64, UNKNOWNS>, value: f64, deviation: f64) {
        let weight = 1.0 / (deviation * deviation);
        self.matrix += row * row.transpose() * weight;
        self.right += row * (value * weight);
        self.squares += value * value * weight;
        self.count += 1.0;
    }
}

/// What a round takes from the one before.
#[derive(Clone, Copy)]
struct Guess {
    offset: f64,
    wind: Vector2<f64>,
    /// Standard deviation of a sample per axis, m/s.
    deviation: f64,
}

/// A solution with what the next round needs.
struct Round {
    fit: AirFit,
    unknowns: SVector<f64, UNKNOWNS>,
    /// Standard deviation of what is left of the air velocity as read, m/s.
    left: f64,
}

impl FitProblem<'_> {
    fn rows(&self, airspeed_delay: f64, gps_delay: f64) -> Vec<Row> {
        let row = |(stamp, ground): (f64, Vector2<f64>)| {
            let time = stamp - gps_delay;
            let mut air = Vector2::zeros();
            let (mut per_length, mut per_offset) = (Vector2::zeros(), Vector2::zeros());
            let share = 1.0 / AVERAGED.len() as f64;
            for part in AVERAGED {
                let there = time + part;
                let nose = self.nose.at(there)?;
                let airspeed = self.airspeed.at(there + airspeed_delay)?;
                air += nose * airspeed * share;
                let slip = self.side_force.slip(there, &nose, airspeed);
                per_length += slip.per_length * share;
                per_offset += slip.per_offset * share;
            }
            Some(Row {
                time,
                ground,
                air,
                slip: Slip {
                    per_length,
                    per_offset,
                },
            })
        };
        let (from, to) = self.span;
        self.velocities.between(from, to).filter_map(row).collect()
    }

    /// The best fit when the airspeed shows what was so many seconds ago, and the velocity likewise; `None`
    /// with fewer than 20 samples.
    ///
    /// The priors are about a scale and an offset, which are linear only near the right heading: the offset is
    /// found without them at first and with them in the rounds after, about itself.
    pub fn solve(&self, airspeed_delay: f64, gps_delay: f64) -> Option<AirFit> {
        let mut rows = self.rows(airspeed_delay, gps_delay);
        let whole = rows.len();
        let mut guess = Guess {
            offset: 0.0,
            wind: Vector2::zeros(),
            deviation: self.deviation,
        };
        let mut found = None;
        for round in 0..ROUNDS {
            if rows.len() < FEWEST {
                return None;
            }
            let loose = round == 0 && self.prior.heading > 0.5;
            let solved = self.round(&rows, &guess, loose)?;
            let turned = Rotation2::new(guess.offset);
            let limit = (OUTLIER * solved.left).max(1.0) * std::f64::consts::SQRT_2;
            let (reference, before) = (solved.fit.reference, rows.len());
            rows.retain(|row| {
                let design = row.design(&guess, row.time - reference);
                let read = turned * row.air;
                let left = Vector2::new(
                    read.x - design[0].dot(&solved.unknowns),
                    read.y - design[1].dot(&solved.unknowns),
                );
                left.norm() < limit
            });
            let settled = (solved.fit.wind - guess.wind).norm() < 0.01 && round > 1;
            let is_settled = rows.len() == before && settled;
            guess = Guess {
                offset: solved.fit.heading_offset,
                wind: solved.fit.wind,
                deviation: solved.left.max(SMOOTHEST),
            };
            found = Some((solved.fit, solved.left));
            if is_settled {
                break;
            }
        }
        found.map(|(fit, left)| {
            let outliers = whole - fit.samples;
            let both_axes = 2.0 * whole as f64;
            AirFit {
                outliers,
                log_likelihood: -both_axes * left.ln() - 0.5 * OUTLIER * OUTLIER * outliers as f64,
                ..fit
            }
        })
    }

    /// One solution about a guess; `loose` lets scale and offset be anything.
    fn round(&self, rows: &[Row], guess: &Guess, loose: bool) -> Option<Round> {
        let reference = rows.last()?.time;
        let turned = Rotation2::new(guess.offset);
        let mut normal = Normal {
            matrix: SMatrix::zeros(),
            right: SVector::zeros(),
            squares: 0.0,
            count: 0.0,
        };
        let mut earlier: Option<(f64, [SVector<f64, UNKNOWNS>; 2], Vector2<f64>)> = None;
        for row in rows {
            let design = row.design(guess, row.time - reference);
            let read = turned * row.air;
            let kept = earlier
                .as_ref()
                .map_or(0.0, |(time, ..)| (-(row.time - time) / self.memory).exp());
            let deviation = guess.deviation * (1.0 - kept * kept).max(1e-6).sqrt();
            for axis in 0..2 {
                let (before, value) = earlier
                    .as_ref()
                    .map_or((SVector::zeros(), 0.0), |(_, d, r)| (d[axis], r[axis]));
                let (row, value) = (design[axis] - before * kept, read[axis] - value * kept);
                normal.add(&row, value, deviation);
            }
            earlier = Some((row.time, design, read));
        }
        self.add_priors(&mut normal, guess.offset, loose);
        let root = normal.matrix.cholesky()?;
        let unknowns = root.solve(&normal.right);
        let squares = (normal.squares - normal.right.dot(&unknowns)).max(f64::MIN_POSITIVE);
        let left = (squares / normal.count).sqrt() * guess.deviation;
        let covariance = root.inverse();
        let factor = Vector2::new(unknowns[0], unknowns[1]);
        let scale = 1.0 / factor.norm();
        let into_wind = Matrix2::new(factor.x, factor.y, -factor.y, factor.x) * (-scale * scale);
        let wind = into_wind * Vector2::new(unknowns[2], unknowns[3]);
        // c = -(a w + b w⊥): how the wind moves with all of it.
        let by_unknowns = into_wind
            * SMatrix::<f64, 2, UNKNOWNS>::from_row_slice(&[
                wind.x, -wind.y, 1.0, 0.0, 0.0, 0.0, 0.0, wind.y, wind.x, 0.0, 1.0, 0.0, 0.0, 0.0,
            ]);
        let of_wind = by_unknowns * covariance * by_unknowns.transpose();
        let deviation = |i: usize| covariance[(i, i)].sqrt();
        let fit = AirFit {
            scale,
            heading_offset: guess.offset + (-factor.y).atan2(factor.x),
            heading_drift: unknowns[4] * scale,
            reference,
            wind,
            slip_length: unknowns[5],
            slip_deviation: deviation(5),
            slip_offset: unknowns[6],
            scale_deviation: deviation(0) * scale * scale,
            offset_deviation: deviation(1) * scale,
            drift_deviation: deviation(4) * scale,
            wind_deviation: of_wind[(0, 0)].max(of_wind[(1, 1)]).sqrt(),
            residual: left * scale,
            log_likelihood: 0.0,
            samples: rows.len(),
            outliers: 0,
        };
        Some(Round {
            fit,
            unknowns,
            left,
        })
    }

    fn add_priors(&self, normal: &mut Normal, offset: f64, loose: bool) {
        let about = |deviation: f64| if loose { 10.0 } else { deviation };
        let priors = [
            (1.0, about(self.prior.scale)),
            (offset, about(self.prior.heading)),
            (0.0, self.prior.wind),
            (0.0, self.prior.wind),
            (0.0, self.prior.drift.max(1e-9)),
            (0.0, self.prior.slip_length),
            (0.0, self.prior.slip_offset),
        ];
        for (index, (mean, deviation)) in priors.into_iter().enumerate() {
            let mut row = SVector::zeros();
            row[index] = 1.0;
            normal.add(&row, mean, deviation);
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Straight ahead for a minute, then, if it `turns`, round and round: 20 m/s through the air, which reads a tenth
    /// too little and noise of 0.6 m/s, in a wind of 5 m/s.
    fn fitted(turns: bool) -> AirFit {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
        let (mut velocities, mut airspeed, mut nose) =
            (Series::new(), Series::new(), Series::new());
        for i in 0..1200 {
            let time = 0.1 * f64::from(i);
            let heading = if turns {
                0.1 * (time - 60.0).max(0.0)
            } else {
                0.3
            };
            let (sin, cos) = heading.sin_cos();
            let wind = Vector2::new(-3.0, 4.0);
            if i % 2 == 0 {
                velocities.push(time, Vector2::new(cos, sin) * 20.0 + wind);
            }
            airspeed.push(time, 18.0 + 0.6 * noise());
            nose.push(time, Vector2::new(cos, sin));
        }
        let problem = FitProblem {
            velocities: &velocities,
            airspeed: &airspeed,
            nose: &nose,
            side_force: &SideForce::default(),
            span: (0.0, 120.0),
            memory: 1.0,
            deviation: 1.0,
            prior: FitPrior {
                scale: 0.1,
                heading: 0.2,
                drift: 0.0,
                wind: 5.0,
                slip_length: 30.0,
                slip_offset: 15.0,
            },
        };
        problem.solve(0.0, 0.0).expect("a fit")
    }

    #[test]
    fn noise_of_the_airspeed_is_not_taken_for_a_smaller_scale() {
        let fit = fitted(true);
        assert!((fit.scale - 1.0 / 0.9).abs() < 0.01, "{fit:?}");
        assert!((fit.wind - Vector2::new(-3.0, 4.0)).norm() < 0.1, "{fit:?}");
        assert!(fit.scale_deviation < 0.01 && fit.heading_offset.abs() < 0.01);
    }

    #[test]
    fn who_flies_straight_ahead_is_told_that_scale_and_wind_are_not_known() {
        let fit = fitted(false);
        assert!(
            fit.scale_deviation > 0.05 && fit.wind_deviation > 1.0,
            "{fit:?}"
        );
        assert!(
            (fit.scale - 1.0 / 0.9).abs() < 2.0 * fit.scale_deviation,
            "{fit:?}"
        );
        let off = (fit.wind - Vector2::new(-3.0, 4.0)).norm();
        assert!(off < 3.0 * fit.wind_deviation, "{fit:?}");
    }
}
