//! A flight with satellite navigation cut out of it.

use serde::{Deserialize, Serialize};

use super::calibration::Calibration;
use super::follow::{FilterEvents, PositionFix};
use super::models::Airplane;
use super::prepared::{Instruments, ReckonError};
use super::refusal::findings;
use super::settings::{HeadingChoice, Method, ReckonSettings};
use super::track::{BeliefPoint, BeliefTrack};
use super::walker::{Trust, Walker};
use pilotage_estimation::filter::{FilterError, Gate};
use pilotage_flight::Finding;

/// Points of a track per second.
const POINTS: f64 = 5.0;
/// Seconds of flight before instruments are calibrated for the first time.
const FIRST_CALIBRATION: f64 = 15.0;
/// Growth of the time that calibrations rest on from one to the next.
const CALIBRATION_GROWTH: f64 = 1.15;

/// A way to navigate through an outage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReckoningWay {
    /// Name of the way, as shown to people.
    pub label: String,
    /// The filter.
    pub method: Method,
    /// The heading.
    pub heading: HeadingChoice,
    /// Whether satellite navigation goes on in spite of the outage.
    pub keeps_gps: bool,
    /// Positions from elsewhere, such as landmarks that were seen, in order of time.
    pub fixes: Vec<PositionFix>,
}

impl ReckoningWay {
    /// Airspeed, heading and wind alone.
    pub fn air_and_wind() -> Self {
        Self {
            label: "Airspeed and wind".to_owned(),
            method: Method::Scaled,
            heading: HeadingChoice::Best,
            keeps_gps: false,
            fixes: Vec::new(),
        }
    }

    /// The same by the gyros' heading.
    pub fn by_gyros() -> Self {
        Self {
            label: "Heading from the gyros".to_owned(),
            heading: HeadingChoice::Gyros,
            ..Self::air_and_wind()
        }
    }

    /// The same by the logged heading.
    pub fn by_logged_heading() -> Self {
        Self {
            label: "Heading as logged".to_owned(),
            heading: HeadingChoice::Logged,
            ..Self::air_and_wind()
        }
    }

    /// The four states of the thesis, with nothing known of delays, pitch, scale or gusts.
    pub fn plain() -> Self {
        Self {
            label: "Plain four-state filter".to_owned(),
            method: Method::Plain,
            heading: HeadingChoice::Logged,
            ..Self::air_and_wind()
        }
    }

    /// As if nothing were cut.
    pub fn gps_throughout() -> Self {
        Self {
            label: "GPS all the time".to_owned(),
            keeps_gps: true,
            ..Self::air_and_wind()
        }
    }

    /// Airspeed, heading, wind, and positions from elsewhere.
    pub fn with_fixes(label: &str, fixes: Vec<PositionFix>) -> Self {
        Self {
            label: label.to_owned(),
            fixes,
            ..Self::air_and_wind()
        }
    }
}

/// Result of reckoning through an outage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reckoning {
    /// The outage, seconds in the flight's time base.
    pub outage: (f64, f64),
    /// The stretch in the air that holds it, seconds.
    pub stretch: (f64, f64),
    /// Tracks, one for each way, in the order of the ways.
    pub tracks: Vec<BeliefTrack>,
    /// Findings on the instruments up to the outage, and on what was refused of them.
    pub findings: Vec<Finding>,
}

/// Navigates a stretch in the air with satellite navigation cut from `outage.0` to `outage.1` (seconds), once per way.
///
/// Every filter learns delays, wind, scale and heading from what came before the outage and from nothing later; it
/// starts at the beginning of the stretch and goes on after the outage. `goes_on` is told the share that is done
/// and ends the work by answering false; ways not begun by then are missing.
pub fn reckon(
    instruments: &Instruments,
    outage: (f64, f64),
    ways: &[ReckoningWay],
    settings: &ReckonSettings,
    mut goes_on: impl FnMut(f64) -> bool,
) -> Result<Reckoning, ReckonError> {
    let (begin, end) = instruments.stretch;
    if !(outage.0 > begin && outage.1 > outage.0 && outage.0 < end) {
        return Err(ReckonError::OutageOutside {
            from: outage.0,
            to: outage.1,
            begin,
            end,
        });
    }
    let mut tracks = Vec::new();
    for (number, way) in ways.iter().enumerate() {
        if !goes_on(number as f64 / ways.len() as f64) {
            break;
        }
        tracks.push(if way.keeps_gps {
            rolling_track(instruments, way, settings)?
        } else {
            outage_track(instruments, outage, way, settings)?
        });
    }
    let mut findings = instruments.findings.clone();
    findings.extend(instruments.remarks(outage.0, HeadingChoice::Best, &settings.calibration));
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    Ok(Reckoning {
        outage,
        stretch: instruments.stretch,
        tracks,
        findings,
    })
}

/// A way through an outage, with the calibration of its beginning.
fn outage_track(
    instruments: &Instruments,
    outage: (f64, f64),
    way: &ReckoningWay,
    settings: &ReckonSettings,
) -> Result<BeliefTrack, ReckonError> {
    let calibration = calibration(instruments, outage.0, way, settings);
    let (begin, end) = instruments.stretch;
    let mut points = Vec::new();
    let delay = calibration.delays.gps;
    let known = || instruments.outlook(&calibration, outage.0, &settings.calibration);
    let outlook = settings.learns_noise.then(known).flatten();
    let events = FilterEvents::default()
        .gps(&instruments.readings, (begin, outage.0), delay)
        .gps(&instruments.readings, (outage.1, end), delay)
        .outage(outage.0 - delay, outlook)
        .fixes(&way.fixes, (begin, end))
        .reports(grid(begin, end));
    let findings = run(
        instruments,
        &calibration,
        way,
        settings,
        events,
        &mut |point| {
            points.push(point);
        },
    )?;
    for point in &mut points {
        point.is_aided = !(outage.0..=outage.1).contains(&(point.time + delay));
    }
    Ok(BeliefTrack {
        label: way.label.clone(),
        points,
        findings,
        calibration,
    })
}

/// A way on which satellite navigation never fails; at any time it knows of the instruments what was known by
/// then.
///
/// Calibrations become rarer as they rest on more. With each the filter begins again at take-off, as it would
/// have run had it known that much, and is believed up to the next.
pub fn rolling_track(
    instruments: &Instruments,
    way: &ReckoningWay,
    settings: &ReckonSettings,
) -> Result<BeliefTrack, ReckonError> {
    let (begin, end) = instruments.stretch;
    let mut points: Vec<BeliefPoint> = Vec::new();
    let mut findings = Vec::new();
    let mut last = calibration(instruments, begin, way, settings);
    let mut known_from = begin;
    let times = calibration_times(begin, end, begin + FIRST_CALIBRATION);
    for until in times.into_iter().chain([end]) {
        let events = FilterEvents::default()
            .gps(&instruments.readings, (begin, until), last.delays.gps)
            .fixes(&way.fixes, (begin, until))
            .reports(grid(begin, until).filter(|t| *t >= known_from));
        findings = run(instruments, &last, way, settings, events, &mut |point| {
            points.push(BeliefPoint {
                is_aided: true,
                ..point
            });
        })?;
        if until < end {
            last = calibration(instruments, until, way, settings);
            known_from = until;
        }
    }
    Ok(BeliefTrack {
        label: way.label.clone(),
        points,
        findings,
        calibration: last,
    })
}

/// Times at which a flight's instruments are calibrated, from `first` on.
pub(super) fn calibration_times(begin: f64, end: f64, first: f64) -> Vec<f64> {
    let mut times = Vec::new();
    let mut time = first;
    while time < end && time > begin {
        times.push(time);
        time = begin + CALIBRATION_GROWTH * (time - begin);
    }
    times
}

/// Times of reports.
fn grid(begin: f64, end: f64) -> impl Iterator<Item = f64> {
    let count = ((end - begin) * POINTS).floor().max(0.0) as usize;
    (0..=count).map(move |i| begin + i as f64 / POINTS)
}

/// Calibration at `as_of` for a way.
pub(super) fn calibration(
    instruments: &Instruments,
    as_of: f64,
    way: &ReckoningWay,
    settings: &ReckonSettings,
) -> Calibration {
    match way.method {
        Method::Scaled => instruments.calibrate(as_of, way.heading, &settings.calibration),
        Method::Plain => instruments.uncalibrated(as_of, &settings.calibration),
    }
}

/// Trust of a way in satellite navigation.
pub(super) fn trust(method: Method, settings: &ReckonSettings) -> Trust {
    let (position, velocity) = match method {
        Method::Scaled => (
            settings.position_deviation,
            Some(settings.velocity_deviation),
        ),
        Method::Plain => (settings.plain_position_deviation, None),
    };
    Trust {
        position,
        velocity,
        gate: Gate {
            confidence: settings.gate_confidence,
        },
        patience: settings.patience,
        learns: settings.learns_noise,
    }
}

/// Leads the filter of a way through events; what it refused, in words.
fn run(
    instruments: &Instruments,
    calibration: &Calibration,
    way: &ReckoningWay,
    settings: &ReckonSettings,
    events: FilterEvents,
    report: &mut dyn FnMut(BeliefPoint),
) -> Result<Vec<Finding>, FilterError> {
    let trust = trust(way.method, settings);
    match way.method {
        Method::Scaled => lead(
            instruments,
            calibration,
            &settings.airplane,
            trust,
            events,
            report,
        ),
        Method::Plain => lead(
            instruments,
            calibration,
            &settings.plain,
            trust,
            events,
            report,
        ),
    }
}

fn lead<const N: usize, V: Airplane<N>>(
    instruments: &Instruments,
    calibration: &Calibration,
    model: &V,
    trust: Trust,
    events: FilterEvents,
    report: &mut dyn FnMut(BeliefPoint),
) -> Result<Vec<Finding>, FilterError> {
    let mut walker = begin(instruments, calibration, model, trust)?;
    let inputs = instruments.inputs(calibration);
    events.lead(&mut walker, &inputs, |walker| {
        let (belief, time) = (walker.state(), walker.time());
        report(BeliefPoint::of(
            &belief,
            model,
            time,
            instruments,
            calibration,
        ));
    })?;
    Ok(findings(walker.refusals.all()))
}

/// A filter at the beginning of the stretch.
pub(super) fn begin<const N: usize, V: Airplane<N>>(
    instruments: &Instruments,
    calibration: &Calibration,
    model: &V,
    trust: Trust,
) -> Result<Walker<N, V>, FilterError> {
    let start = instruments.start(trust.position);
    // Nothing older than the first measurement is predicted from.
    let time = instruments.stretch.0 - calibration.delays.gps.max(0.0);
    Walker::new(model, calibration, &start, time, trust)
}
