//! A flight made ready for dead reckoning.

use std::borrow::Cow;

use nalgebra::{Matrix2, Vector2};

use super::airborne::airborne;
use super::blend::Blend;
use super::calibration::{
    Calibration, CalibrationSettings, Delays, HeadingSource, calibrate, problem,
};
use super::fit::AirFit;
use super::heading::HeadingCheck;
use super::heading_choice::likelier;
use super::health;
use super::models::OUTAGE;
use super::nose::{bridged, gyro_nose, logged_nose};
use super::outlook::Outlook;
use super::readings::Readings;
use super::series::Series;
use super::settings::HeadingChoice;
use super::slip::SideForce;
use super::walker::AirInputs;
use pilotage_estimation::filter::{FilterError, Gaussian};
use pilotage_flight::{Finding, Flight, Severity};

/// Why a flight cannot be reckoned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReckonError {
    /// There is no satellite navigation to start from, to learn from and to compare with.
    #[error("{flight}: no position by satellite navigation, so that there is nothing to cut")]
    NoPosition {
        /// Name of the flight.
        flight: String,
    },
    /// There is neither a heading nor a set of gyros.
    #[error("{flight}: neither a heading nor turn rates, so that dead reckoning has no direction")]
    NoHeading {
        /// Name of the flight.
        flight: String,
    },
    /// It never flew.
    #[error("{flight}: it was never in the air")]
    NeverAirborne {
        /// Name of the flight.
        flight: String,
    },
    /// The outage lies outside the time in the air.
    #[error(
        "the outage from {from:.1} to {to:.1} s does not lie within a stretch in the air: choose it within {begin:.1} \
         to {end:.1} s"
    )]
    OutageOutside {
        /// Beginning of the outage, seconds.
        from: f64,
        /// End of the outage, seconds.
        to: f64,
        /// Beginning of the longest stretch in the air, seconds.
        begin: f64,
        /// Its end, seconds.
        end: f64,
    },
    /// The filter refused a step.
    #[error(transparent)]
    Filter(#[from] FilterError),
}

/// Half the time over which the airspeed is averaged, seconds. An airplane is too heavy to follow gusts that are
/// shorter, its airspeed shows them all the same, and a filter that finds the airspeed's scale by the track would
/// take every one for a smaller scale.
const GUST: f64 = 1.0;

/// A flight whose readings are cleaned, with a stretch in the air that is to be navigated.
#[derive(Clone, Debug)]
pub struct Instruments {
    /// Readings of the instruments, without what cannot be believed.
    pub readings: Readings,
    /// All stretches in the air, seconds.
    pub airborne: Vec<(f64, f64)>,
    /// The one that is navigated, seconds.
    pub stretch: (f64, f64),
    /// Findings on what was noticed and refused.
    pub findings: Vec<Finding>,
    /// The airspeed as it moves the airplane.
    calm: Series,
    side_force: SideForce,
    logged: Series<Vector2<f64>>,
    gyros: Series<Vector2<f64>>,
}

impl Instruments {
    /// Cleans the readings of `flight` and takes the stretch in the air that holds `time`, or the longest.
    pub fn of(flight: &Flight, time: Option<f64>) -> Result<Self, ReckonError> {
        let name = || flight.name.clone();
        let mut readings = Readings::of(flight);
        if readings.positions.is_empty() {
            return Err(ReckonError::NoPosition { flight: name() });
        }
        let airborne = airborne(&readings);
        let holds = |(from, to): &(f64, f64)| time.is_some_and(|t| (*from..=*to).contains(&t));
        let longest = || {
            let stretches = airborne.iter().copied();
            stretches.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)))
        };
        let stretch = airborne.iter().copied().find(holds).or_else(longest);
        let stretch = stretch.ok_or_else(|| ReckonError::NeverAirborne { flight: name() })?;
        let mut findings = std::mem::take(&mut readings.findings);
        findings.extend(refuse_unhealthy(&mut readings, &airborne));
        let gyros = gyro_nose(&readings, stretch.0);
        let logged = bridged(&logged_nose(&readings), &gyros);
        if logged.is_empty() && gyros.is_empty() {
            return Err(ReckonError::NoHeading { flight: name() });
        }
        Ok(Self {
            calm: readings.airspeed.averaged(GUST),
            side_force: SideForce::of(&readings, &airborne),
            readings,
            airborne,
            stretch,
            findings,
            logged,
            gyros,
        })
    }

    /// Whether turn rates tell a heading of their own.
    pub fn has_gyros(&self) -> bool {
        !self.gyros.is_empty()
    }

    /// The nose as a calibration has it.
    fn nose(&self, calibration: &Calibration) -> Cow<'_, Series<Vector2<f64>>> {
        match (calibration.heading, calibration.blend) {
            (HeadingSource::Both, Some(blend)) => Cow::Owned(blend.nose(&self.logged, &self.gyros)),
            (HeadingSource::Gyros, _) => Cow::Borrowed(&self.gyros),
            _ => Cow::Borrowed(&self.logged),
        }
    }

    /// Inputs that drive a filter under a calibration.
    pub(super) fn inputs<'a>(&'a self, calibration: &'a Calibration) -> AirInputs<'a> {
        AirInputs {
            airspeed: &self.calm,
            nose: self.nose(calibration),
            side_force: &self.side_force,
            calibration,
        }
    }

    /// Outlook at `until` (seconds, of satellite navigation) under a calibration of before.
    pub(super) fn outlook(
        &self,
        calibration: &Calibration,
        until: f64,
        settings: &CalibrationSettings,
    ) -> Option<Outlook> {
        let fit = calibration.fit.as_ref()?;
        let nose = self.nose(calibration);
        let mut problem = problem(
            &self.readings,
            &nose,
            &self.side_force,
            calibration.heading,
            (self.stretch.0, until),
            settings,
        );
        if let Some(refused) = &calibration.refused {
            problem.prior = refused.believed(problem.prior)?;
        }
        // What is left has to be what is left of the way that the outage will be flown by.
        problem.airspeed = &self.calm;
        let delays = calibration.delays;
        problem.outlook(fit, calibration.as_of, (delays.airspeed, delays.gps))
    }

    /// The position where the stretch begins, with standard deviation `deviation` (m) per axis.
    pub(super) fn start(&self, deviation: f64) -> Gaussian<2> {
        let positions = &self.readings.positions;
        let after = positions
            .between(self.stretch.0, f64::INFINITY)
            .map(|(_, p)| p)
            .next();
        let last = positions.values().last().copied();
        let place = positions.at(self.stretch.0).or(after).or(last);
        Gaussian::new(
            place.unwrap_or_default(),
            Matrix2::identity() * (deviation * deviation),
        )
    }

    /// Calibration of the instruments at `as_of` seconds, by nothing later than that.
    pub fn calibrate(
        &self,
        as_of: f64,
        choice: HeadingChoice,
        settings: &CalibrationSettings,
    ) -> Calibration {
        let by = |source| self.calibrate_by(source, as_of, settings);
        match choice {
            HeadingChoice::Logged => by(HeadingSource::Logged),
            HeadingChoice::Gyros => by(HeadingSource::Gyros),
            HeadingChoice::Best => {
                let (logged, gyros) = (by(HeadingSource::Logged), by(HeadingSource::Gyros));
                self.better(&logged, &gyros, settings)
            }
        }
    }

    fn calibrate_by(
        &self,
        source: HeadingSource,
        as_of: f64,
        settings: &CalibrationSettings,
    ) -> Calibration {
        let nose = match source {
            HeadingSource::Gyros => &self.gyros,
            HeadingSource::Logged | HeadingSource::Both => &self.logged,
        };
        self.calibrate_along(nose, source, as_of, settings)
    }

    fn calibrate_along(
        &self,
        nose: &Series<Vector2<f64>>,
        source: HeadingSource,
        as_of: f64,
        settings: &CalibrationSettings,
    ) -> Calibration {
        let span = (self.stretch.0, as_of);
        calibrate(
            &self.readings,
            nose,
            &self.side_force,
            source,
            span,
            settings,
        )
    }

    /// The readings as they are: no delays, no offset, the logged heading.
    pub(super) fn uncalibrated(&self, as_of: f64, settings: &CalibrationSettings) -> Calibration {
        let settings = CalibrationSettings {
            given_delays: Some(Delays::default()),
            ..*settings
        };
        Calibration {
            fit: None,
            ..self.calibrate(as_of, HeadingChoice::Logged, &settings)
        }
    }

    /// Remarks on the instruments by the flight up to `as_of`, in words: heading against gyros, airspeed
    /// scale, compass, delays.
    pub fn remarks(
        &self,
        as_of: f64,
        choice: HeadingChoice,
        settings: &CalibrationSettings,
    ) -> Vec<Finding> {
        let by = |source| self.calibrate_by(source, as_of, settings);
        let (logged, gyros) = (by(HeadingSource::Logged), by(HeadingSource::Gyros));
        let taken = match choice {
            HeadingChoice::Logged => logged,
            HeadingChoice::Gyros => gyros,
            HeadingChoice::Best => self.better(&logged, &gyros, settings),
        };
        let residuals = logged.fit.zip(gyros.fit);
        let residuals =
            residuals.map(|(by_logged, by_gyros)| (by_logged.residual, by_gyros.residual));
        let check = HeadingCheck::of(&self.logged, &self.gyros, (self.stretch.0, as_of));
        let check = check.and_then(|check| check.finding(residuals, taken.heading));
        let compass = logged.compass_finding(taken.heading != HeadingSource::Gyros);
        let check = check.into_iter().chain(compass);
        check.chain(taken.findings()).collect()
    }

    /// The calibration of the heading that explains the flight better, or of the mean of both.
    fn better(
        &self,
        logged: &Calibration,
        gyros: &Calibration,
        settings: &CalibrationSettings,
    ) -> Calibration {
        let left = |calibration: &Calibration, fit: &AirFit| {
            let nose = self.nose(calibration);
            let problem = problem(
                &self.readings,
                &nose,
                &self.side_force,
                calibration.heading,
                (self.stretch.0, calibration.as_of),
                settings,
            );
            let delays = calibration.delays;
            problem.left(delays.airspeed, delays.gps, fit)
        };
        let likelier = match (&logged.fit, &gyros.fit) {
            (Some(by_logged), Some(by_gyros)) => likelier(
                &left(logged, by_logged),
                &left(gyros, by_gyros),
                settings.logged.wind,
            ),
            (None, Some(_)) => HeadingSource::Gyros,
            (None, None) if self.logged.is_empty() => HeadingSource::Gyros,
            _ => HeadingSource::Logged,
        };
        // What the gyros drift by until the middle of an outage is across the airspeed then.
        let lasts = logged
            .fit
            .zip(gyros.fit)
            .is_none_or(|(by_logged, by_gyros)| {
                let drifted = gyros.cruise * by_gyros.drift_deviation * 0.5 * OUTAGE;
                by_gyros.residual.hypot(drifted) < by_logged.residual
            });
        match (likelier, &logged.fit, &gyros.fit) {
            (HeadingSource::Gyros | HeadingSource::Both, ..) if !lasts => *logged,
            (HeadingSource::Gyros, ..) => *gyros,
            (HeadingSource::Both, Some(by_logged), Some(by_gyros)) => {
                let blend = Blend::of(by_logged, by_gyros);
                let nose = blend.nose(&self.logged, &self.gyros);
                let known =
                    self.calibrate_along(&nose, HeadingSource::Both, logged.as_of, settings);
                Calibration {
                    blend: Some(blend),
                    ..known
                }
            }
            _ => *logged,
        }
    }
}

/// Takes out what is stuck, and says what is stuck or missing.
fn refuse_unhealthy(readings: &mut Readings, airborne: &[(f64, f64)]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut refuse = |what: &str, series: &mut Series| {
        let spans = health::stuck(series, airborne);
        findings.extend(health::stuck_findings(what, &spans));
        if !series.is_empty() {
            let gaps = health::gaps(series, airborne);
            findings.extend(health::gap_findings(what, &gaps));
        }
        *series = series.without(&spans);
    };
    refuse("Airspeed", &mut readings.airspeed);
    refuse("Heading", &mut readings.heading);
    refuse("Side force", &mut readings.side_force);
    let gaps = health::gaps(&readings.positions, airborne);
    findings.extend(health::gap_findings("GPS position", &gaps));
    if readings.airspeed.is_empty() {
        findings.push(Finding {
            severity: Severity::Warning,
            title: "There is no airspeed".to_owned(),
            text: "The mean speed over ground so far is taken for it, with the doubt that it deserves."
                .to_owned(),
            span: None,
        });
    }
    findings
}
