//! Filter on its way through the readings.

use std::borrow::Cow;

use nalgebra::{Const, Matrix2, SVector, Vector2};

use super::calibration::Calibration;
use super::fit::AirFit;
use super::models::Airplane;
use super::outlook::Outlook;
use super::refusal::{Refusals, RefusedKind};
use super::series::Series;
use super::slip::SideForce;
use pilotage_base::frames::Attitude;
use pilotage_estimation::filter::{
    FilterError, Gate, Gaussian, PredictedMeasurement, Ukf, UnscentedSettings, fading_factor,
};
use pilotage_estimation::vehicle::ControlInput;

/// Longest step of a prediction, seconds.
const LONGEST_STEP: f64 = 0.1;
/// Step over which a velocity is read off the process model, seconds: short against everything that moves.
const INSTANT: f64 = 1e-3;
/// Speed that an airplane may have whose heading nobody knows, as a multiple of the one it cruises at.
const BLIND: f64 = 1.0;

/// Air data at a time, with delays and the heading's offset taken out.
#[derive(Clone)]
pub(super) struct AirInputs<'a> {
    /// Airspeed as read, m/s.
    pub(super) airspeed: &'a Series,
    /// Horizontal part of the nose's direction as read.
    pub(super) nose: Cow<'a, Series<Vector2<f64>>>,
    /// Side force.
    pub(super) side_force: &'a SideForce,
    /// Calibration of the air data.
    pub(super) calibration: &'a Calibration,
}

impl AirInputs<'_> {
    /// The input at `time`, `None` without a heading.
    fn at(&self, time: f64) -> Option<ControlInput> {
        let nose = self.nose.at(time)?;
        let airspeed = self.airspeed.at(time + self.calibration.delays.airspeed);
        // The way through the air as a share of the airspeed: along the nose but for the sideslip.
        let mut way = nose;
        if let Some((fit, airspeed)) = self.calibration.fit.zip(airspeed) {
            let slip = self.side_force.slip(time, &nose, airspeed);
            let velocity = slip.per_length * fit.slip_length + slip.per_offset * fit.slip_offset;
            way += velocity / airspeed.max(f64::MIN_POSITIVE);
        }
        let way = self.calibration.heading_correction(time) * way;
        let attitude = Attitude {
            roll: 0.0,
            pitch: way.norm().min(1.0).acos(),
            yaw: way.y.atan2(way.x),
        };
        Some(ControlInput {
            airspeed,
            attitude,
            ..ControlInput::default()
        })
    }
}

/// Trust in satellite navigation: its standard deviations, and when it is refused.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trust {
    /// Standard deviation of a position per axis, m.
    pub(super) position: f64,
    /// Standard deviation of a velocity per axis, m/s; velocities are not used where `None`.
    pub(super) velocity: Option<f64>,
    /// Gate on both.
    pub(super) gate: Gate,
    /// After so many seconds of refusals the measurements are believed and the filter is not.
    pub(super) patience: f64,
    /// Whether the filter takes its noise from the flight.
    pub(super) learns: bool,
}

/// A filter, its model and the time of its belief.
#[derive(Clone)]
pub(super) struct Walker<const N: usize, V> {
    model: V,
    /// The same airplane while its heading is unknown.
    blind: V,
    filter: Ukf<N>,
    /// Fit from which the filter takes its noise.
    fit: Option<AirFit>,
    /// Components that measurements leave as they are.
    told: &'static [usize],
    /// The same airplane from the beginning of an outage on, if it is another.
    outage: Option<V>,
    time: f64,
    trust: Trust,
    /// Measurements that were refused.
    pub(super) refusals: Refusals,
    /// Logarithm of the likelihood of all measurements so far, as they were predicted.
    pub(super) log_likelihood: f64,
}

impl<const N: usize, V: Airplane<N>> Walker<N, V> {
    /// A filter that begins at `position` and `time`.
    pub(super) fn new(
        model: &V,
        calibration: &Calibration,
        start: &Gaussian<2>,
        time: f64,
        trust: Trust,
    ) -> Result<Self, FilterError> {
        let place = pilotage_base::frames::GroundPoint::new(start.mean.x, start.mean.y);
        let deviation = start.covariance.trace().max(0.0).sqrt() * std::f64::consts::FRAC_1_SQRT_2;
        let fit = calibration.fit.as_ref().filter(|_| trust.learns);
        let given = model;
        let model = fit.map_or_else(|| model.clone(), |fit| model.in_noise_of(fit));
        let (speed, stray) = (calibration.cruise, calibration.cruise_deviation);
        let any_way = BLIND * speed.hypot(stray) * std::f64::consts::FRAC_1_SQRT_2;
        Ok(Self {
            filter: Ukf::new(
                model.start(fit, place, deviation),
                UnscentedSettings::default(),
            )?,
            fit: fit.copied(),
            told: fit.map_or(&[], |_| model.told()),
            outage: fit.map(|fit| given.in_outage_after(fit).cruising(speed, stray)),
            model: model.cruising(speed, stray),
            blind: model.cruising(0.0, any_way),
            time,
            trust,
            refusals: Refusals::default(),
            log_likelihood: 0.0,
        })
    }

    /// The present belief.
    pub(super) fn state(&self) -> Gaussian<N> {
        let belief = self.filter.state();
        match &self.fit {
            Some(fit) if !self.told.is_empty() => self.model.with_doubts_of(fit, belief),
            _ => belief,
        }
    }

    /// Its time, seconds.
    pub(super) fn time(&self) -> f64 {
        self.time
    }

    /// Satellite navigation is lost.
    pub(super) fn lose_gps(&mut self, outlook: Option<&Outlook>) -> Result<(), FilterError> {
        let Some(model) = self.outage.take() else {
            return Ok(());
        };
        let mut belief = self.filter.state();
        if let Some(outlook) = outlook {
            model.begin_outage(&mut belief, outlook);
        }
        self.model = model;
        // What comes now, from landmarks, was not heard by the fit.
        self.told = &[];
        self.filter.reset(&belief)
    }

    /// Takes in what was measured, but for what is told: its doubt counts, and remains (Schmidt 1966).
    fn correct(
        &mut self,
        predicted: &PredictedMeasurement<N, Const<2>>,
        measured: &Vector2<f64>,
    ) -> Result<(), FilterError> {
        if self.told.is_empty() {
            self.filter.correct(predicted, measured)?;
            return Ok(());
        }
        let cross = &predicted.cross_covariance;
        let spread = &predicted.innovation_covariance;
        let inverse = spread.try_inverse().ok_or(FilterError::NotFinite {
            place: "gain of a measurement",
        })?;
        let mut gain = cross * inverse;
        for index in self.told {
            gain.row_mut(*index).fill(0.0);
        }
        let mut belief = self.filter.state();
        belief.mean += gain * predicted.innovation(measured);
        let shared = gain * cross.transpose();
        belief.covariance += gain * spread * gain.transpose() - shared - shared.transpose();
        self.filter.reset(&belief)
    }

    /// Predicts up to `to` seconds.
    pub(super) fn advance(&mut self, inputs: &AirInputs<'_>, to: f64) -> Result<(), FilterError> {
        let whole = to - self.time;
        if whole <= 0.0 {
            return Ok(());
        }
        let steps = (whole / LONGEST_STEP).ceil();
        let dt = whole / steps;
        for step in 0..steps as usize {
            let middle = self.time + (step as f64 + 0.5) * dt;
            let level = ControlInput::without_airspeed(Attitude::default());
            let (model, input) = match inputs.at(middle) {
                Some(input) => (&self.model, input),
                None => (&self.blind, level),
            };
            let noise = model.noise_of_belief(&self.filter.state(), &input, dt);
            self.filter
                .predict(|x| model.propagate(x, &input, dt), &noise)?;
        }
        self.time = to;
        Ok(())
    }

    /// Takes a position by satellite navigation in, or refuses it.
    pub(super) fn take_position(&mut self, place: Vector2<f64>) -> Result<(), FilterError> {
        let noise = Matrix2::identity() * self.trust.position.powi(2);
        self.take(RefusedKind::Position, place, &noise, |x| {
            Vector2::new(x[0], x[1])
        })
    }

    /// Takes a velocity by satellite navigation in, or refuses it.
    pub(super) fn take_velocity(
        &mut self,
        inputs: &AirInputs<'_>,
        velocity: Vector2<f64>,
    ) -> Result<(), FilterError> {
        let (Some(deviation), Some(input)) = (self.trust.velocity, inputs.at(self.time)) else {
            return Ok(());
        };
        let noise = Matrix2::identity() * deviation.powi(2);
        let model = self.model.clone();
        self.take(RefusedKind::Velocity, velocity, &noise, move |x| {
            let next = model.propagate(x, &input, INSTANT);
            Vector2::new(next[0] - x[0], next[1] - x[1]) / INSTANT
        })
    }

    /// Takes a position from elsewhere in, or refuses it.
    pub(super) fn take_fix(
        &mut self,
        place: Vector2<f64>,
        covariance: &Matrix2<f64>,
    ) -> Result<(), FilterError> {
        self.take(RefusedKind::Fix, place, covariance, |x| {
            Vector2::new(x[0], x[1])
        })
    }

    fn take(
        &mut self,
        source: RefusedKind,
        measured: Vector2<f64>,
        noise: &Matrix2<f64>,
        model: impl Fn(&SVector<f64, N>) -> Vector2<f64>,
    ) -> Result<(), FilterError> {
        let predicted = self.filter.predict_measurement(|x| Some(model(x)), noise)?;
        let verdict = self.trust.gate.judge(&predicted, &measured);
        let innovation = predicted.innovation(&measured);
        self.log_likelihood -= 0.5 * (predicted.innovation_covariance.determinant().ln())
            + 0.5 * verdict.nis.min(verdict.threshold)
            + std::f64::consts::TAU.ln();
        if verdict.accepted {
            self.refusals.accept(source, self.time);
            self.correct(&predicted, &measured)?;
            return Ok(());
        }
        let refused_for = self.refusals.refuse(source, self.time, innovation.norm());
        if refused_for < self.trust.patience {
            return Ok(());
        }
        // Whoever disagrees for so long is right, or nobody is: as much doubt as makes it likeliest.
        let dynamic = |m: &Matrix2<f64>| nalgebra::DMatrix::from_column_slice(2, 2, m.as_slice());
        let factor = fading_factor(
            &nalgebra::DVector::from_column_slice(innovation.as_slice()),
            &dynamic(&predicted.innovation_covariance),
            &dynamic(noise),
        );
        if let Some(factor) = factor {
            let mut belief = self.filter.state();
            belief.covariance *= factor;
            self.filter.reset(&belief)?;
            let predicted = self.filter.predict_measurement(|x| Some(model(x)), noise)?;
            self.correct(&predicted, &measured)?;
            self.refusals.believe(source);
        }
        Ok(())
    }
}
