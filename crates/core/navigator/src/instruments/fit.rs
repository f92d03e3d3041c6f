//! Wind, airspeed scale, heading and slip from what satellite navigation says of the velocity.

use nalgebra::{Rotation2, SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::problem::FitProblem;
use super::rows::{AirDataRow, rows};
use super::track_noise::{Left, TrackNoise, means, means_over};

/// Unknowns of the fit: the two of the factor on the air velocity, what the wind is north and east, drift, length and
/// offset of the sideslip.
pub(super) const UNKNOWNS: usize = 7;
/// Those of them that are no wind.
pub(super) const NO_WIND: [usize; 5] = [0, 1, 4, 5, 6];
/// Indices of length and offset of the sideslip among the unknowns.
const SLIP_LENGTH: usize = 5;
pub(super) const SLIP_OFFSET: usize = 6;
/// Mean square of how the nose strays from which on it turned: what wagging adds to it, some degrees, is a hundredth of
/// that.
const TURNED: f64 = 0.25;
/// Fewest velocities of a fit.
const FEWEST: usize = 20;
/// Residuals beyond so many standard deviations are left out when the fit is made again.
pub(super) const OUTLIER: f64 = 5.0;
/// Rounds in which the heading's offset moves to where it belongs, residuals say what noise there is, and outliers are
/// left out.
const ROUNDS: usize = 4;
/// The same while the noise is known.
const ROUNDS_IN_KNOWN_NOISE: usize = 2;
/// Standard deviation of a prior that leaves anything open.
const ANYTHING: f64 = 10.0;
/// Time over which what is left is evened for a comparison, seconds.
const SECOND: f64 = 1.0;
/// Share of a moment's variance below which it counts as nothing, so that moments that say the same can be weighed.
const NOTHING: f64 = 1e-9;

/// Fit of one wind, one scale of the airspeed, one offset and drift of the heading, and one readiness to slip
/// sideways.
///
/// The velocity over ground is v = a u + b u⊥ + d (t - t₀) u⊥ + s + w + e with the air velocity u = V cos θ (cos ψ, sin ψ)
/// as read, x⊥ the same turned to the right by 90° and s the slip by the side force (`slip.rs`); linear in a, b, d, w and
/// what makes s. The scale is |(a, b)|, the heading truly is atan2(b, a) more.
///
/// Both sides err. The airspeed reads gusts and noise that do not move the aircraft, so that least squares of v by u
/// would find too small a scale; winds and receivers move v and no airspeed shows it, so that u by v would find too large
/// a one; and the worse the more the fit listens to quick changes, in which there is little else. So the unknowns are
/// those with which v less what explains it has nothing in common with where the nose pointed: Σ zᵀ (v - X θ) = 0 with
/// instruments z that are made of the nose and the mean airspeed (instrumental variables: Reiersøl 1941; Durbin 1954);
/// while the aircraft hardly turned, of the nose two seconds before and after, so that one that wags is no turn either.
/// Every velocity counts alike, so that legs and turns decide and not the seconds; but for the slip the quick changes of
/// the side force are the instrument, since slow ones are more of the accelerometer, the roll and the airspeed.
///
/// How far those sums may be off follows from the noise that the residuals show, with its memory
/// (`TrackNoise::covariance`): a thousand velocities in the same gust are one. Weighed by it (Hansen 1982) they meet
/// the priors, and so the stated deviations hold for errors that remember themselves.
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
    /// Velocity of the air (north, east), m/s: the mean of the stretch.
    pub wind: Vector2<f64>,
    /// Length L of the sideslip, m: the airplane slips to its right at (B - L f) / V with the specific force f along
    /// the right wing; zero where none is measured.
    pub slip_length: f64,
    /// Its standard deviation, m.
    pub slip_deviation: f64,
    /// Offset B of the sideslip, m²/s².
    pub slip_offset: f64,
    /// Standard deviation of the scale.
    pub scale_deviation: f64,
    /// Standard deviation of the heading's offset at `reference`, radians.
    pub offset_deviation: f64,
    /// Standard deviation of its drift, rad/s.
    pub drift_deviation: f64,
    /// Standard deviation per axis of the wind at the end of the stretch about `wind`, m/s.
    pub wind_deviation: f64,
    /// Standard deviation per axis of a wind that does not walk: what gusts, scale and heading leave open, m/s.
    pub still_wind_deviation: f64,
    /// Standard deviation per axis of what is left of the velocity, m/s.
    pub residual: f64,
    /// Noise that moves the aircraft besides, likeliest by what is left of the velocity.
    pub noise: TrackNoise,
    /// The same in the mean over all that may be: what a prediction has to reckon with.
    pub expected_noise: TrackNoise,
    /// Logarithm of the likelihood of what is new in each velocity, but for a constant that is the same for all
    /// fits to the same velocities; what is left out counts as the largest residual that is not.
    pub log_likelihood: f64,
    /// Velocities that it rests on.
    pub samples: usize,
    /// Velocities left out because they fit to nothing.
    pub outliers: usize,
}

/// Guess that a round takes from the round before.
#[derive(Clone, Copy)]
pub(super) struct RoundGuess {
    /// Angle added to the heading at the end, radians, and its rate, rad/s.
    pub(super) offset: f64,
    pub(super) drift: f64,
    pub(super) noise: TrackNoise,
    /// Whether scale and heading may be anything.
    pub(super) is_open: bool,
}

/// The air velocity of a row as the unknowns act on it, near a guess.
pub(super) type Design = [Vector2<f64>; UNKNOWNS];

/// A solution.
pub(super) struct Solved {
    unknowns: SVector<f64, UNKNOWNS>,
    pub(super) covariance: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    offset: f64,
    drift: f64,
    reference: f64,
    /// Instruments of the rows, and by what their sums Σ zᵀ e have changed the unknowns.
    pub(super) moments: Vec<(f64, Design)>,
    pub(super) gain: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    /// The part of the covariance that the priors leave.
    pub(super) of_priors: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
}

fn right_of(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}

/// Vectors by which the unknowns act with an air velocity of `air`, `since` seconds after the reference, where the heading
/// is `turned` already.
fn acting(row: &AirDataRow, air: Vector2<f64>, turned: &Rotation2<f64>, since: f64) -> Design {
    let air = turned * air;
    [
        air,
        right_of(air),
        Vector2::x(),
        Vector2::y(),
        right_of(air) * since,
        turned * row.slip.per_length,
        turned * row.slip.per_offset,
    ]
}

impl Solved {
    pub(super) fn left(&self, row: &AirDataRow) -> Left<5> {
        let since = row.time - self.reference;
        let angle = self.offset + self.drift * since;
        let design = acting(row, row.air, &Rotation2::new(angle), since);
        let explained = design.iter().zip(self.unknowns.iter());
        let explained: Vector2<f64> = explained.map(|(vector, factor)| vector * *factor).sum();
        Left {
            time: row.time,
            velocity: row.ground - explained,
            design: NO_WIND.map(|index| design[index]),
        }
    }

    fn wind(&self) -> Vector2<f64> {
        Vector2::new(self.unknowns[2], self.unknowns[3])
    }

    fn scale(&self) -> f64 {
        self.unknowns[0].hypot(self.unknowns[1])
    }

    /// Angle to be added to the heading at the reference, radians.
    fn heading_offset(&self) -> f64 {
        self.offset + self.unknowns[1].atan2(self.unknowns[0])
    }

    /// Rate of that, rad/s. A drift adds up to an angle that is no small one, so that it moves to where it belongs as the
    /// offset does.
    fn heading_drift(&self) -> f64 {
        self.drift + self.unknowns[4] / self.scale()
    }
}

/// Mean square of how the nose strays from its mean direction: 0 of who flies straight, 1 of who flies everywhere.
fn spread(rows: &[AirDataRow]) -> f64 {
    let count = rows.len().max(1) as f64;
    let mean: Vector2<f64> = rows.iter().map(|row| row.nose).sum::<Vector2<f64>>() / count;
    let squares = rows.iter().map(|row| (row.nose - mean).norm_squared());
    squares.sum::<f64>() / count
}

/// Makes an instrument of the quick changes of another: Λᵀ Λ z, with Λ what is new in errors that remember themselves for
/// `memory` seconds.
fn quicken(moments: &mut [(f64, Design)], index: usize, memory: f64) {
    let kept = |from: f64, to: f64| (-(to - from) / memory).exp();
    let fresh = |kept: f64| 1.0 / (1.0 - kept * kept).max(1e-6);
    let mut news = Vec::with_capacity(moments.len());
    let mut earlier: Option<(f64, Vector2<f64>)> = None;
    for (time, vectors) in moments.iter() {
        let now = vectors[index];
        news.push(earlier.map_or(now, |(before, then)| {
            let kept = kept(before, *time);
            (now - then * kept) * fresh(kept)
        }));
        earlier = Some((*time, now));
    }
    for i in 0..moments.len() {
        let later = moments.get(i + 1).map(|m| m.0);
        let next = later.map_or(Vector2::zeros(), |later| {
            news[i + 1] * kept(moments[i].0, later)
        });
        moments[i].1[index] = news[i] - next;
    }
}

impl FitProblem<'_> {
    /// The fit when the airspeed shows what was so many seconds ago, and the velocity likewise; `None` with fewer
    /// than 20 samples. With an earlier fit it begins there and takes its noise for known.
    pub(super) fn solve(
        &self,
        airspeed_delay: f64,
        gps_delay: f64,
        earlier: Option<&AirFit>,
    ) -> Option<AirFit> {
        let mut rows = rows(self, airspeed_delay, gps_delay);
        let whole = rows.len();
        let mut guess = RoundGuess {
            offset: earlier.map_or(0.0, |fit| fit.heading_offset),
            drift: earlier.map_or(0.0, |fit| fit.heading_drift),
            noise: earlier.map_or_else(TrackNoise::default, |fit| fit.noise),
            // The priors are about a scale and an offset, which are linear only near the right heading: it is found
            // without them at first.
            is_open: earlier.is_none() && self.prior.heading > 0.5,
        };
        let rounds = earlier.map_or(ROUNDS, |_| ROUNDS_IN_KNOWN_NOISE);
        let mut found = None;
        for _ in 0..rounds {
            if rows.len() < FEWEST {
                return None;
            }
            let solved = self.round(&rows, &guess)?;
            let left: Vec<Left<5>> = rows.iter().map(|row| solved.left(row)).collect();
            let squares = left.iter().map(|left| left.velocity.norm_squared());
            let residual = (0.5 * squares.sum::<f64>() / rows.len() as f64).sqrt();
            let limit = (OUTLIER * residual).max(1.0) * std::f64::consts::SQRT_2;
            let fits = |left: &Left<5>| left.velocity.norm() < limit;
            let mut fitting = left.iter().map(fits);
            rows.retain(|_| fitting.next() == Some(true));
            (guess.offset, guess.drift) = (solved.heading_offset(), solved.heading_drift());
            guess.is_open = false;
            if earlier.is_none() {
                let left = means(left.into_iter().filter(fits));
                guess.noise = guess
                    .noise
                    .likeliest(&left, &self.spread(), self.prior.wind);
            }
            found = Some((solved, residual));
        }
        let (solved, residual) = found?;
        let (mut noise, mut expected_noise) = (guess.noise, guess.noise);
        let mut solved = solved;
        let mut still = 0.0;
        if earlier.is_none() {
            let left = means(rows.iter().map(|row| solved.left(row)));
            (noise, expected_noise) = noise.known(&left, &self.spread(), self.prior.wind);
            guess.noise = TrackNoise {
                walk: 0.0,
                ..expected_noise
            };
            still = self.round(&rows, &guess)?.fit().wind_deviation;
            guess.noise = expected_noise;
            solved = self.round(&rows, &guess)?;
        }
        Some(AirFit {
            residual,
            noise,
            expected_noise,
            still_wind_deviation: still,
            log_likelihood: self.log_likelihood(&rows, &solved, whole),
            samples: rows.len(),
            outliers: whole - rows.len(),
            ..solved.fit()
        })
    }

    /// Logarithm of the likelihood of what is new in each velocity.
    fn log_likelihood(&self, rows: &[AirDataRow], solved: &Solved, whole: usize) -> f64 {
        let news = self.new_in(rows, solved);
        let squares: f64 = news.map(|(_, new)| new.norm_squared()).sum();
        let deviation = (0.5 * squares / rows.len() as f64).sqrt();
        let left_out = (whole - rows.len()) as f64;
        -2.0 * whole as f64 * deviation.max(f64::MIN_POSITIVE).ln()
            - 0.5 * OUTLIER * OUTLIER * left_out
    }

    /// Velocities that the fit leaves, in means over a second, as they are stamped.
    pub(super) fn left(&self, airspeed_delay: f64, gps_delay: f64, fit: &AirFit) -> Vec<Left<0>> {
        let solved = Solved::of(fit);
        let rows = rows(self, airspeed_delay, gps_delay);
        let left = rows.iter().map(|row| Left {
            time: row.time + gps_delay,
            velocity: solved.left(row).velocity,
            design: [],
        });
        means_over(SECOND, left)
    }

    /// Innovation in each velocity, against an error that remembers itself.
    fn new_in<'a>(
        &self,
        rows: &'a [AirDataRow],
        solved: &'a Solved,
    ) -> impl Iterator<Item = (f64, Vector2<f64>)> + 'a {
        let memory = self.memory;
        let mut earlier: Option<Left<5>> = None;
        rows.iter().map(move |row| {
            let left = solved.left(row);
            let (kept, before) = earlier.map_or((0.0, Vector2::zeros()), |earlier| {
                let kept = (-(left.time - earlier.time) / memory).exp();
                (kept, earlier.velocity)
            });
            earlier = Some(left);
            let fresh = (1.0 - kept * kept).max(1e-6).sqrt();
            (left.time, (left.velocity - before * kept) / fresh)
        })
    }

    /// Standard deviations of the unknowns that are no wind.
    fn spread(&self) -> [f64; 5] {
        let prior = &self.prior;
        [
            prior.scale,
            prior.heading,
            prior.drift.max(1e-9),
            prior.slip_length,
            prior.slip_offset,
        ]
    }

    /// Solves the equations once, about a guess.
    pub(super) fn round(&self, rows: &[AirDataRow], guess: &RoundGuess) -> Option<Solved> {
        let reference = rows.last()?.time;
        let mean = rows.iter().map(|row| row.airspeed).sum::<f64>() / rows.len() as f64;
        let has_turned = spread(rows) > TURNED;
        let mut moments = Vec::with_capacity(rows.len());
        let mut slope = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
        let mut value = SVector::<f64, UNKNOWNS>::zeros();
        // Sine and cosine, which cost more than all else of a row, once for both.
        let turned = |row: &AirDataRow| {
            let since = row.time - reference;
            (since, Rotation2::new(guess.offset + guess.drift * since))
        };
        let turned: Vec<(f64, Rotation2<f64>)> = rows.iter().map(turned).collect();
        for (row, (since, turned)) in rows.iter().zip(&turned) {
            let nose = if has_turned {
                row.nose
            } else {
                row.nose_beside
            };
            let instruments = acting(row, nose * mean, turned, *since);
            moments.push((row.time, instruments));
        }
        // What the side force says it says quickly.
        for index in [SLIP_LENGTH, SLIP_OFFSET] {
            quicken(&mut moments, index, guess.noise.memory);
        }
        for ((row, (since, turned)), (_, instruments)) in rows.iter().zip(&turned).zip(&moments) {
            let design = acting(row, row.air, turned, *since);
            for axis in 0..2 {
                let x = SVector::<f64, UNKNOWNS>::from_fn(|i, _| design[i][axis]);
                let z = SVector::<f64, UNKNOWNS>::from_fn(|i, _| instruments[i][axis]);
                slope.ger(1.0, &z, &x, 1.0);
                value.axpy(row.ground[axis], &z, 1.0);
            }
        }
        let mut noise = guess.noise.covariance(&moments);
        // In units of their own deviations; what is no moment at all says nothing.
        let deviations = noise.diagonal().map(
            |variance| {
                if variance > 0.0 { variance.sqrt() } else { 1.0 }
            },
        );
        for i in 0..UNKNOWNS {
            value[i] /= deviations[i];
            for j in 0..UNKNOWNS {
                slope[(i, j)] /= deviations[i];
                noise[(i, j)] /= deviations[i] * deviations[j];
            }
            noise[(i, i)] += NOTHING;
        }
        for i in 0..UNKNOWNS {
            if noise[(i, i)] < 0.5 {
                noise[(i, i)] = 1.0;
            }
        }
        let weighed = noise.cholesky()?;
        let slope_by_noise = weighed.solve(&slope).transpose();
        let mut information = slope_by_noise * slope;
        let mut right = slope_by_noise * value;
        let mut weights = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
        for (index, (mean, deviation)) in self.priors(guess).into_iter().enumerate() {
            let weight = 1.0 / (deviation * deviation);
            weights[(index, index)] = weight;
            right[index] += weight * mean;
        }
        information += weights;
        let root = information.cholesky()?;
        let covariance = root.inverse();
        let gain = covariance * slope_by_noise;
        Some(Solved {
            unknowns: root.solve(&right),
            covariance,
            moments,
            gain: SMatrix::from_fn(|i, j| gain[(i, j)] / deviations[j]),
            of_priors: covariance * weights * covariance,
            offset: guess.offset,
            drift: guess.drift,
            reference,
        })
    }

    /// Means and standard deviations of the unknowns about a guess.
    fn priors(&self, guess: &RoundGuess) -> [(f64, f64); UNKNOWNS] {
        let prior = &self.prior;
        let about = |deviation: f64| if guess.is_open { ANYTHING } else { deviation };
        [
            (1.0, about(prior.scale)),
            (-guess.offset, about(prior.heading)),
            (0.0, prior.wind),
            (0.0, prior.wind),
            (-guess.drift, prior.drift.max(1e-9)),
            (0.0, prior.slip_length),
            (0.0, prior.slip_offset),
        ]
    }
}

impl Solved {
    /// Fit that the solution states, as far as it does.
    fn fit(&self) -> AirFit {
        let unknowns = &self.unknowns;
        let scale = self.scale();
        let along = Vector2::new(unknowns[0], unknowns[1]) / scale;
        let of_factor = self.covariance.fixed_view::<2, 2>(0, 0).into_owned();
        let deviation = |i: usize| self.covariance[(i, i)].max(0.0).sqrt();
        let spread = |v: Vector2<f64>| v.dot(&(of_factor * v)).max(0.0).sqrt();
        AirFit {
            scale,
            heading_offset: self.heading_offset(),
            heading_drift: self.heading_drift(),
            reference: self.reference,
            wind: self.wind(),
            slip_length: unknowns[5],
            slip_deviation: deviation(5),
            slip_offset: unknowns[6],
            scale_deviation: spread(along),
            offset_deviation: spread(right_of(along)) / scale,
            drift_deviation: deviation(4) / scale,
            wind_deviation: deviation(2).max(deviation(3)),
            residual: 0.0,
            noise: TrackNoise::default(),
            expected_noise: TrackNoise::default(),
            still_wind_deviation: 0.0,
            log_likelihood: 0.0,
            samples: 0,
            outliers: 0,
        }
    }

    /// The same again from what it said.
    pub(super) fn of(fit: &AirFit) -> Self {
        Self {
            unknowns: SVector::from([
                fit.scale,
                0.0,
                fit.wind.x,
                fit.wind.y,
                0.0,
                fit.slip_length,
                fit.slip_offset,
            ]),
            covariance: SMatrix::zeros(),
            moments: Vec::new(),
            gain: SMatrix::zeros(),
            of_priors: SMatrix::zeros(),
            offset: fit.heading_offset,
            drift: fit.heading_drift,
            reference: fit.reference,
        }
    }
}
