//! Satellite navigation cut out of a flight, in a worker.

use pilotage_core::instruments::{
    BeliefTrack, GpsWindSettings, Instruments, OutagePlan, OutageStudy, ReckonSettings, Reckoning,
    ReckoningWay, WindComparison, reckon, study_outages,
};

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::{
    Advance, AidedResult, JobEvent, Outage, OutageOrder, OutageReport, RunningJob, StudyReport,
    WindReport, WorkerState,
};

/// Time in the air that comes before an outage at least, seconds: there is nothing to go on from otherwise.
const BEFORE: f64 = 1.0;
/// Shortest outage, seconds.
const SHORTEST: f64 = 1.0;

/// Most points of a course of the wind: more than a chart has columns.
const MOST_WINDS: usize = 2000;

fn wind_report(instruments: &Instruments, name: &str) -> Option<WindReport> {
    let found = WindComparison::of(
        instruments,
        name,
        &GpsWindSettings::default(),
        GpsWindSettings::SETTLED,
    )
    .ok()?;
    let by_gps = found.by_gps.iter().map(|w| [w.time, w.wind.x, w.wind.y]);
    let by_autopilot = found.by_autopilot.iter();
    Some(WindReport {
        by_gps: thinned(by_gps.collect()),
        by_least_squares: found.by_least_squares.map(Into::into),
        by_autopilot: thinned(by_autopilot.map(|(t, w)| [t, w.x, w.y]).collect()),
        from_least_squares: found.from_least_squares,
        from_autopilot: found.from_autopilot,
    })
}

fn thinned(winds: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let every = winds.len().div_ceil(MOST_WINDS).max(1);
    let last = winds.len().saturating_sub(1);
    let kept = winds.into_iter().enumerate();
    let kept = kept.filter(|(i, _)| i.is_multiple_of(every) || *i == last);
    kept.map(|(_, wind)| wind).collect()
}

impl OutageOrder {
    /// The ways that are shown side by side.
    fn ways(&self, instruments: &Instruments) -> Vec<ReckoningWay> {
        let mut ways = vec![ReckoningWay::air_and_wind(), ReckoningWay::plain()];
        if matches!(self.outage, Outage::Stretch(..)) {
            ways.push(ReckoningWay::gps_throughout());
        }
        if let Some((label, fixes)) = &self.seen {
            ways.push(ReckoningWay::with_fixes(label, fixes.clone()));
        }
        if instruments.has_gyros() {
            ways.push(ReckoningWay::by_gyros());
        }
        ways
    }
}

/// The part of `outage` in which the aircraft flies, and has flown for a moment; all times are seconds.
fn in_the_air((begin, end): (f64, f64), outage: (f64, f64)) -> Option<(f64, f64)> {
    let (from, to) = (outage.0.max(begin + BEFORE), outage.1.min(end));
    (to - from >= SHORTEST).then_some((from, to))
}

/// An outage that is being made: events `Progress`, at the end `OutageMade` or `OutagesStudied`. Of outages all along the flight
/// one way to navigate is a slice.
pub struct MakeOutage {
    order: OutageOrder,
    /// With the name of their flight.
    instruments: Option<(Instruments, String)>,
    studies: Vec<OutageStudy>,
}

impl MakeOutage {
    /// Nothing done yet.
    pub fn new(order: OutageOrder) -> Self {
        Self {
            order,
            instruments: None,
            studies: Vec::new(),
        }
    }
}

/// All ways through one outage.
fn report(span: (f64, f64), made: Reckoning, winds: Option<WindReport>) -> OutageReport {
    let mut remarks: Vec<String> = Vec::new();
    let of_ways = made.tracks.iter().flat_map(|t| &t.findings);
    for finding in made.findings.iter().chain(of_ways) {
        let words = format!("{}. {}", finding.title, finding.text);
        if !remarks.contains(&words) {
            remarks.push(words);
        }
    }
    let result = |track: BeliefTrack| {
        let inside = track.points.iter();
        let inside = inside.filter(|p| (span.0..=span.1).contains(&p.time));
        AidedResult {
            growth: track.growth(span),
            places: inside
                .map(|p| [p.time, p.position.north, p.position.east])
                .collect(),
            label: track.label,
        }
    };
    OutageReport {
        span,
        results: made.tracks.into_iter().map(result).collect(),
        remarks,
        winds,
    }
}

impl RunningJob for MakeOutage {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some((instruments, name)) = &self.instruments else {
            let flight = worker.flight(&self.order.flight)?;
            let flight = flight.borrow().flight.clone();
            let time = match self.order.outage {
                Outage::Stretch(from, _) => Some(from),
                Outage::AllAlong(_) => None,
            };
            let found = Instruments::of(&flight, time).map_err(|cause| cause.to_string())?;
            self.instruments = Some((found, flight.name.clone()));
            return Ok(Advance::More);
        };
        let settings = ReckonSettings::default();
        let mut tell = |share: f64, words: &str| {
            emit(JobEvent::Progress(share as f32, words.to_owned()));
            true
        };
        let made = match self.order.outage {
            Outage::Stretch(from, to) => {
                let Some(span) = in_the_air(instruments.stretch, (from, to)) else {
                    return Err(format!(
                        "{name}: the aircraft does not fly then; move the cursor to where it is in the air, or select a \
                         stretch of the flight"
                    ));
                };
                let goes_on = |share| tell(share, "Navigating without GPS");
                let made = reckon(
                    instruments,
                    span,
                    &self.order.ways(instruments),
                    &settings,
                    goes_on,
                );
                let made = made.map_err(|cause| cause.to_string())?;
                let winds = wind_report(instruments, name);
                let mut report = report(span, made, winds);
                if span.0 > from {
                    let words = "The outage begins a second after take-off: the wind is hardly known by then, and \
                                 errors grow faster than later in the flight.";
                    report.remarks.insert(0, words.to_owned());
                }
                JobEvent::OutageMade(Box::new(report))
            }
            Outage::AllAlong(length) => {
                if let Some(way) = self.order.ways(instruments).get(self.studies.len()) {
                    let plan = OutagePlan {
                        length,
                        ..OutagePlan::default()
                    };
                    let mut goes_on = |share| tell(share, &way.label);
                    let study = study_outages(instruments, way, &plan, &settings, &mut goes_on);
                    let study = study.map_err(|cause| cause.to_string())?;
                    if study.outages.is_empty() {
                        let (start, end) = instruments.stretch;
                        let air = end - start;
                        return Err(format!(
                            "{name}: {air:.0} s in the air are too few for GPS outages of {length:.0} s; choose shorter ones"
                        ));
                    }
                    self.studies.push(study);
                    return Ok(Advance::More);
                }
                let studies = std::mem::take(&mut self.studies);
                JobEvent::OutagesStudied(Box::new(StudyReport { length, studies }))
            }
        };
        emit(made);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for OutageOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), None)
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(MakeOutage::new(self))
    }
}
