//! Outages all along a flight.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::calibration::Calibration;
use super::follow::{FilterEvents, PositionFix};
use super::models::Airplane;
use super::outlook::Outlook;
use super::prepared::{Instruments, ReckonError};
use super::reckon::{ReckoningWay, begin, calibration, calibration_times, trust};
use super::settings::{Method, ReckonSettings};
use super::statistics::quantile;
use super::walker::Trust;
use pilotage_base::statistics::chi_square_quantile;
use pilotage_estimation::filter::FilterError;

/// Plan of the outages.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutagePlan {
    /// Length of each, seconds.
    pub length: f64,
    /// From the beginning of one to the beginning of the next, seconds.
    pub every: f64,
    /// From the beginning of the stretch in the air to that of the first outage, seconds.
    pub warm_up: f64,
}

impl Default for OutagePlan {
    fn default() -> Self {
        Self {
            length: 60.0,
            every: 2.0,
            warm_up: 30.0,
        }
    }
}

/// Outcome of an outage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutageOutcome {
    /// Beginning, seconds: stamp of the last position that may have been used.
    pub from: f64,
    /// End, seconds: stamp of the position that it is compared with.
    pub to: f64,
    /// Position by satellite navigation minus the estimate (north, east), m.
    pub error: Vector2<f64>,
    /// Covariance of the estimate, m².
    pub covariance: Matrix2<f64>,
}

impl OutageOutcome {
    /// Normalised squared error.
    pub fn squared(&self) -> f64 {
        self.covariance
            .try_inverse()
            .map_or(f64::INFINITY, |inverse| {
                (inverse * self.error).dot(&self.error)
            })
    }
}

/// Outcomes of all outages, for one way to navigate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutageStudy {
    /// Name of the way, as shown to people.
    pub label: String,
    /// In order of time.
    pub outages: Vec<OutageOutcome>,
    /// Logarithm of the likelihood of all measurements of satellite navigation, each as it was predicted.
    pub log_likelihood: f64,
}

impl OutageStudy {
    /// The error at the end that the share `share` of the outages stays below, m.
    pub fn error_quantile(&self, share: f64) -> f64 {
        quantile(self.outages.iter().map(|c| c.error.norm()).collect(), share)
    }

    /// Share of the outages whose 95 % ellipse holds the position by satellite navigation.
    pub fn covered(&self) -> f64 {
        let limit = chi_square_quantile(0.95, 2.0);
        let inside = self.outages.iter().filter(|c| c.squared() <= limit).count();
        inside as f64 / self.outages.len().max(1) as f64
    }

    /// Logarithm of the likelihood of the positions at the ends of the outages, as they were predicted at their
    /// beginnings, but for a constant.
    pub fn end_log_likelihood(&self) -> f64 {
        let term = |c: &OutageOutcome| -0.5 * (c.covariance.determinant().ln() + c.squared());
        self.outages.iter().map(term).sum()
    }
}

/// Cuts satellite navigation again and again and navigates through each outage by `way`.
///
/// Every outage is made by a filter that has seen nothing later, with a calibration that rests on nothing later: the
/// latest of a few along the flight, as [`super::rolling_track`] has them. `goes_on` is told the share that is
/// done and ends the work by answering false.
pub fn study_outages(
    instruments: &Instruments,
    way: &ReckoningWay,
    plan: &OutagePlan,
    settings: &ReckonSettings,
    goes_on: &mut dyn FnMut(f64) -> bool,
) -> Result<OutageStudy, ReckonError> {
    let (start, end) = instruments.stretch;
    let mut study = OutageStudy {
        label: way.label.clone(),
        outages: Vec::new(),
        log_likelihood: 0.0,
    };
    let times = calibration_times(start, end, start + plan.warm_up);
    for (number, as_of) in times.iter().enumerate() {
        if !goes_on(number as f64 / times.len() as f64) {
            break;
        }
        let until = times.get(number + 1).copied().unwrap_or(end);
        let known = calibration(instruments, *as_of, way, settings);
        let trust = trust(way.method, settings);
        let part = CalibrationOutages {
            instruments,
            known: &known,
            trust,
            plan,
            fixes: &way.fixes,
            settings,
            span: (*as_of, until),
        };
        match way.method {
            Method::Scaled => part.study(&settings.airplane, &mut study)?,
            Method::Plain => part.study(&settings.plain, &mut study)?,
        }
    }
    Ok(study)
}

/// The outages that begin while one calibration is the latest.
struct CalibrationOutages<'a> {
    instruments: &'a Instruments,
    known: &'a Calibration,
    trust: Trust,
    plan: &'a OutagePlan,
    fixes: &'a [PositionFix],
    settings: &'a ReckonSettings,
    span: (f64, f64),
}

impl CalibrationOutages<'_> {
    /// Beginnings of the outages, seconds.
    fn beginnings(&self) -> Vec<f64> {
        let (start, end) = self.instruments.stretch;
        let first = start + self.plan.warm_up;
        let count = ((end - first) / self.plan.every).floor().max(0.0) as usize;
        let all = (0..=count).map(|i| first + i as f64 * self.plan.every);
        all.filter(|t| *t >= self.span.0 && *t < self.span.1 && t + self.plan.length <= end)
            .collect()
    }

    /// Outlook at the beginning of an outage; `None` for a filter that is told its noise.
    fn outlook(&self, from: f64) -> Option<Outlook> {
        let learns = self.trust.learns;
        let found = || {
            self.instruments
                .outlook(self.known, from, &self.settings.calibration)
        };
        learns.then(found).flatten()
    }

    fn study<const N: usize, V: Airplane<N>>(
        &self,
        model: &V,
        study: &mut OutageStudy,
    ) -> Result<(), FilterError> {
        let delay = self.known.delays.gps;
        let start = self.instruments.stretch.0;
        let readings = &self.instruments.readings;
        let inputs = self.instruments.inputs(self.known);
        let mut walker = begin(self.instruments, self.known, model, self.trust)?;
        // A report at its beginning marks a part whose measurements count for the likelihood.
        let marks = std::iter::once(self.span.0).chain(self.beginnings());
        let events = FilterEvents::default()
            .gps(readings, (start, self.span.1), delay)
            .fixes(self.fixes, (start, self.span.1 - delay))
            .reports(marks.map(|stamp| stamp - delay));
        let mut before = None;
        let mut trouble = None;
        events.lead(&mut walker, &inputs, |walker| {
            if before.is_none() {
                before = Some(walker.log_likelihood);
                return;
            }
            let from = walker.time() + delay;
            let to = from + self.plan.length;
            let mut coasting = walker.clone();
            let outlook = self.outlook(from);
            let through = FilterEvents::default()
                .outage(walker.time(), outlook)
                .fixes(self.fixes, (walker.time(), to - delay))
                .lead(&mut coasting, &inputs, |_| {});
            if let Err(error) = through.and_then(|()| coasting.advance(&inputs, to - delay)) {
                trouble = Some(error);
                return;
            }
            let place = coasting.state().marginal::<0, 2>();
            if let Some(there) = readings.positions.at(to) {
                study.outages.push(OutageOutcome {
                    from,
                    to,
                    error: there - place.mean,
                    covariance: place.covariance,
                });
            }
        })?;
        study.log_likelihood += walker.log_likelihood - before.unwrap_or(walker.log_likelihood);
        trouble.map_or(Ok(()), Err)
    }
}
