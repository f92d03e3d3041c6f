//! Wind, airspeed scale and heading by least squares from what satellite navigation says of the velocity.

use nalgebra::{Rotation2, SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::series::Series;

/// Unknowns of the fit: a and b of the air velocity's factor, wind north and east, drift.
const UNKNOWNS: usize = 5;
/// Fewest velocities of a fit.
const FEWEST: usize = 20;
/// Residuals beyond so many standard deviations are left out when the fit is made again.
const OUTLIER: f64 = 5.0;
/// Rounds in which the heading's offset moves to where it belongs and outliers are left out.
const ROUNDS: usize = 4;

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
}

/// One wind, one scale of the airspeed, one offset and drift of the heading, by whitened least squares.
///
/// With the air velocity u = V cos θ (cos ψ, sin ψ) as read and u⊥ the same turned to the right by 90°, the
/// velocity over ground is a u + b u⊥ + d (t - t₀) u⊥ + wind + e: linear in all unknowns. The scale is |(a, b)|,
/// the heading truly is atan2(b, a) more, and drifts by d / scale. The error e remembers itself: each sample
/// counts by what is new in it, e(t) - φ e(t'), φ = exp(-(t - t') / τ).
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
    /// Standard deviation of the scale, by the residuals.
    pub scale_deviation: f64,
    /// Standard deviation of the heading's offset at `reference`, radians.
    pub offset_deviation: f64,
    /// Standard deviation of its drift, rad/s.
    pub drift_deviation: f64,
    /// Standard deviation of the wind per axis, m/s.
    pub wind_deviation: f64,
    /// Standard deviation per axis of what is left, m/s.
    pub residual: f64,
    /// Logarithm of the likelihood with that residual, but for a constant that is the same for all fits to
    /// the same velocities; what is left out counts as the largest residual that is not.
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
    /// Stretch of the velocities, seconds.
    pub span: (f64, f64),
    /// Correlation time τ of the error, seconds.
    pub memory: f64,
    /// Standard deviation of the error per axis, m/s, which weighs the priors against the samples.
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
}

impl Row {
    /// Rows of the design matrix, north and east, `since` seconds after the reference.
    fn design(&self, turned: &Rotation2<f64>, since: f64) -> [SVector<f64, UNKNOWNS>; 2] {
        let air = turned * self.air;
        let (n, e) = (air.x, air.y);
        [
            SVector::from([n, -e, 1.0, 0.0, -e * since]),
            SVector::from([e, n, 0.0, 1.0, n * since]),
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

/// A solution with what the next round needs.
struct Round {
    fit: AirFit,
    unknowns: SVector<f64, UNKNOWNS>,
}

impl FitProblem<'_> {
    fn rows(&self, airspeed_delay: f64, gps_delay: f64) -> Vec<Row> {
        let row = |(stamp, ground): (f64, Vector2<f64>)| {
            let time = stamp - gps_delay;
            let airspeed = self.airspeed.at(time + airspeed_delay)?;
            let air = self.nose.at(time)? * airspeed;
            Some(Row { time, ground, air })
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
        let mut offset = 0.0;
        let mut found = None;
        for round in 0..ROUNDS {
            if rows.len() < FEWEST {
                return None;
            }
            let loose = round == 0 && self.prior.heading > 0.5;
            let solved = self.round(&rows, offset, loose)?;
            offset = solved.fit.heading_offset;
            let limit = OUTLIER * solved.fit.residual;
            let reference = solved.fit.reference;
            let before = rows.len();
            let turned = Rotation2::new(offset - solved.unknowns[1].atan2(solved.unknowns[0]));
            rows.retain(|row| {
                let design = row.design(&turned, row.time - reference);
                let left = Vector2::new(
                    row.ground.x - design[0].dot(&solved.unknowns),
                    row.ground.y - design[1].dot(&solved.unknowns),
                );
                left.norm() < limit.max(1.0) * std::f64::consts::SQRT_2
            });
            let is_settled = rows.len() == before && round > 0;
            found = Some(solved.fit);
            if is_settled {
                break;
            }
        }
        found.map(|fit| {
            let outliers = whole - fit.samples;
            let both_axes = 2.0 * whole as f64;
            AirFit {
                outliers,
                log_likelihood: -both_axes * fit.residual.ln()
                    - 0.5 * OUTLIER * OUTLIER * outliers as f64,
                ..fit
            }
        })
    }

    /// One solution about the heading's `offset`; `loose` lets scale and offset be anything.
    fn round(&self, rows: &[Row], offset: f64, loose: bool) -> Option<Round> {
        let reference = rows.last()?.time;
        let turned = Rotation2::new(offset);
        let mut normal = Normal {
            matrix: SMatrix::zeros(),
            right: SVector::zeros(),
            squares: 0.0,
            count: 0.0,
        };
        let mut earlier: Option<(f64, [SVector<f64, UNKNOWNS>; 2], Vector2<f64>)> = None;
        for row in rows {
            let design = row.design(&turned, row.time - reference);
            let kept = earlier
                .as_ref()
                .map_or(0.0, |(time, ..)| (-(row.time - time) / self.memory).exp());
            let deviation = self.deviation * (1.0 - kept * kept).max(1e-6).sqrt();
            for axis in 0..2 {
                let (before, value) = earlier
                    .as_ref()
                    .map_or((SVector::zeros(), 0.0), |(_, d, g)| (d[axis], g[axis]));
                let (row, value) = (
                    design[axis] - before * kept,
                    row.ground[axis] - value * kept,
                );
                normal.add(&row, value, deviation);
            }
            earlier = Some((row.time, design, row.ground));
        }
        self.add_priors(&mut normal, offset, loose);
        let root = normal.matrix.cholesky()?;
        let unknowns = root.solve(&normal.right);
        let left = (normal.squares - normal.right.dot(&unknowns)).max(f64::MIN_POSITIVE);
        let inverse = root.inverse();
        let scale = unknowns[0].hypot(unknowns[1]);
        let excess = (left / normal.count).sqrt();
        let deviation = |i: usize| inverse[(i, i)].sqrt() * excess;
        let fit = AirFit {
            scale,
            heading_offset: offset + unknowns[1].atan2(unknowns[0]),
            heading_drift: unknowns[4] / scale,
            reference,
            wind: Vector2::new(unknowns[2], unknowns[3]),
            scale_deviation: deviation(0),
            offset_deviation: deviation(1) / scale,
            drift_deviation: deviation(4) / scale,
            wind_deviation: deviation(2).max(deviation(3)),
            residual: excess * self.deviation,
            log_likelihood: 0.0,
            samples: rows.len(),
            outliers: 0,
        };
        Some(Round { fit, unknowns })
    }

    fn add_priors(&self, normal: &mut Normal, offset: f64, loose: bool) {
        let about = |deviation: f64| if loose { 10.0 } else { deviation };
        let priors = [
            (1.0, about(self.prior.scale)),
            (-offset, about(self.prior.heading)),
            (0.0, self.prior.wind),
            (0.0, self.prior.wind),
            (0.0, self.prior.drift.max(1e-9)),
        ];
        for (index, (mean, deviation)) in priors.into_iter().enumerate() {
            let mut row = SVector::zeros();
            row[index] = 1.0;
            normal.add(&row, mean, deviation);
        }
    }
}
