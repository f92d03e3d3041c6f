//! A trained detector judged where it was not trained: on photos of other days and on real frames.
//!
//! What the page draws and saves passes it ready made: only workers hold the programs that judge.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::{Flight, FrameSource as _};
use pilotage_core::landmark::trained::TrainedDetector;
use pilotage_core::training::FlightEnvelope;
use pilotage_core::training::evaluation::{
    AtThreshold, DetectorJudge, EvaluatedLook, Evaluation, EvaluationSettings, FrameJudge,
    HeldOutFrames, JudgingPlan, Plot, Rate,
};

use super::flights::OpenFlight;
use super::order::{Order, Reads, Urgency, VariantOrder, WorkerRole, around, keys_of};
use super::running::SLICE;
use super::{
    Advance, EvaluationOrder, EvaluationReport, FlightSource, JobEvent, JudgedDetector, MapSource,
    RunningJob, WorkerState,
};

/// Photos between two evaluations of what has been seen so far.
const TOLD_EVERY: usize = 50;
/// Samples of days for these, which are soon replaced.
const FEW_REPLICATES: usize = 100;

impl EvaluationReport {
    /// Report on the evaluation of `looks` for the detector whose own threshold is `least_score`.
    pub fn of(
        (landmark, name): (u32, &str),
        looks: &[EvaluatedLook],
        least_score: f64,
        evaluation: &Evaluation,
    ) -> Self {
        let mut figures = in_use(looks, least_score);
        figures.extend(figures_of(evaluation));
        let plots = evaluation.plots().into_iter();
        Self {
            landmark,
            name: name.to_owned(),
            figures,
            basis: basis(evaluation),
            plots: plots.map(with_svg).collect(),
            csv: evaluation.csv(),
            is_partial: false,
        }
    }
}

fn with_svg(plot: Plot) -> (Plot, String) {
    let svg = plot.svg();
    (plot, svg)
}

fn percent(share: f64) -> String {
    format!("{:.1}", 100.0 * share)
}

/// Rates of detection and of false alarms at the threshold that the navigator uses, in words: over all looks,
/// and over real frames alone.
fn in_use(looks: &[EvaluatedLook], least_score: f64) -> Vec<String> {
    let rate = |rate: &Rate| {
        let (low, high) = (percent(rate.low), percent(rate.high));
        format!("{} of {} ({low} to {high} %)", rate.happened, rate.of)
    };
    let told = |name: &str, at: &AtThreshold| {
        format!(
            "{name}found {}, false alarms in {}",
            rate(&at.found),
            rate(&at.deceived)
        )
    };
    let mut words = vec![told("as flown: ", &AtThreshold::over(looks, least_score))];
    let days: BTreeSet<usize> = (looks.iter().filter(|look| look.real))
        .map(|look| look.day)
        .collect();
    if !days.is_empty() {
        let real = AtThreshold::over_real(looks, least_score);
        let of = if days.len() == 1 {
            "; all of one flight"
        } else {
            ""
        };
        words.push(format!("{}{of}", told("as flown in real frames: ", &real)));
    }
    words
}

fn figures_of(evaluation: &Evaluation) -> Vec<String> {
    let operating = &evaluation.operating;
    let found = operating.detection;
    let mut figures = vec![format!(
        "found {} % ({} to {} %) at {} false alarms per picture",
        percent(found.value),
        percent(found.low),
        percent(found.high),
        operating.allowed
    )];
    if let Some(held_out) = operating.held_out
        && let Some(share) = held_out.found.share()
    {
        figures.push(format!(
            "on days left out {} % at {:.3} false alarms",
            percent(share),
            held_out.false_alarms
        ));
    }
    let precision = evaluation.average_precision;
    figures.push(format!(
        "average precision {:.3} ({:.3} to {:.3})",
        precision.value, precision.low, precision.high
    ));
    if let Some(covariance) = &evaluation.covariance {
        let [longer, shorter, along] = covariance.axes();
        let [north, east] = covariance.bias;
        figures.push(format!(
            "place σ {longer:.2} m along {:.0}°, {shorter:.2} m across; bias {north:.2} m north, {east:.2} m east",
            along.to_degrees()
        ));
    }
    figures
}

fn basis(evaluation: &Evaluation) -> String {
    let days = match evaluation.days {
        1 => "1 day".to_owned(),
        days => format!("{days} days"),
    };
    let over = if evaluation.draws_whole_days {
        "bands, bars and brackets: 95 % over other days"
    } else {
        "bands, bars and brackets: 95 % over other pictures; too few days to tell of other days"
    };
    format!(
        "{} pictures of {days}, {} with the landmark, {} real; {over}",
        evaluation.looks, evaluation.present, evaluation.real
    )
}

/// Real frames to be looked at.
struct RealFrames {
    open: Rc<RefCell<OpenFlight>>,
    /// The flight as its mission has it flown.
    flight: Arc<Flight>,
    /// Their numbers, the next one last.
    left: Vec<usize>,
    all: usize,
}

/// Frames that are looked at, and what is said of those that are not.
type ChosenFrames = (Option<RealFrames>, Option<String>);

impl RealFrames {
    /// Of a flight whose truth is known, without those that the detector may have learned from.
    fn of(
        worker: &mut WorkerState,
        source: &FlightSource,
        order: &EvaluationOrder,
    ) -> Result<ChosenFrames, String> {
        let open = worker.flight(source)?;
        let flight = order.camera.flown(&open.borrow().flight);
        let of = || HeldOutFrames::of(&flight, &order.labels, order.about.landmark.id);
        let held_out = flight.truth.is_some().then(of).unwrap_or_default();
        let frames = &held_out.frames;
        let count = frames.len().min(order.most_frames);
        let left = (0..count).rev().map(|i| frames[i * frames.len() / count]);
        let left = left.collect();
        let real = (count > 0).then_some(Self {
            open,
            flight,
            all: count,
            left,
        });
        Ok((real, held_out.told()))
    }
}

/// Everything that is needed once the judging has begun.
struct JudgingWork {
    judge: DetectorJudge,
    trained: TrainedDetector,
    envelope: FlightEnvelope,
    real: Option<RealFrames>,
    /// Number of frames that are not looked at since it may have learned from them, in words.
    left_out: Option<String>,
    looks: Vec<EvaluatedLook>,
}

impl JudgingWork {
    /// Looks so far.
    fn looks(&self) -> &[EvaluatedLook] {
        if self.looks.is_empty() {
            self.judge.looks()
        } else {
            &self.looks
        }
    }
}

/// Event beside the report at the end, of the landmark's name, the looks and what they come to.
type Detail = fn(&EvaluationOrder, &JudgingWork, Evaluation) -> Result<JobEvent, String>;

/// A detector being judged.
pub struct Evaluate {
    order: EvaluationOrder,
    detail: Option<Detail>,
    work: Option<JudgingWork>,
    told: usize,
}

impl Evaluate {
    /// Nothing looked at yet.
    fn new(order: EvaluationOrder, detail: Option<Detail>) -> Self {
        Self {
            order,
            detail,
            work: None,
            told: 0,
        }
    }

    fn plan(&self) -> JudgingPlan {
        JudgingPlan {
            photos: self.order.photos,
            days: self.order.days,
            seed: self.order.seed,
        }
    }

    fn begin(&self, worker: &mut WorkerState) -> Result<JudgingWork, String> {
        let about = &self.order.about;
        let landmark = &about.landmark;
        let trained = landmark.trained_detector();
        let trained = trained.ok_or_else(|| {
            format!(
                "\"{}\" has no detector that was trained for its box",
                landmark.name
            )
        })?;
        let map = worker.cached_map(&about.map)?;
        let others = worker.others(&about.map)?;
        let sensors = about.navigator.sensors;
        let envelope = FlightEnvelope {
            ground_down: about.ground_down,
            ..FlightEnvelope::around(&about.camera, about.height, sensors)
        };
        let judge = DetectorJudge::new(
            landmark,
            trained.clone(),
            &map,
            others.as_ref(),
            &envelope,
            self.plan(),
        );
        let (real, left_out) = match &self.order.flight {
            Some(source) => RealFrames::of(worker, source, &self.order)?,
            None => (None, None),
        };
        Ok(JudgingWork {
            judge,
            trained,
            envelope,
            real,
            left_out,
            looks: Vec::new(),
        })
    }

    /// Looks at pictures for a slice of time; whether there are more.
    fn look(&mut self, clock: &dyn Fn() -> f64) -> Result<bool, String> {
        let (plan, begun) = (self.plan(), clock());
        let Some(work) = &mut self.work else {
            return Ok(true);
        };
        while clock() - begun < SLICE {
            if work.judge.advance().map_err(|why| why.to_string())? {
                continue;
            }
            if work.looks.is_empty() {
                work.looks = work.judge.looks().to_vec();
            }
            let next = work.real.as_mut().and_then(|real| {
                let index = real.left.pop()?;
                Some((Rc::clone(&real.open), Arc::clone(&real.flight), index))
            });
            let Some((open, flight, index)) = next else {
                return Ok(false);
            };
            let picture = open.borrow_mut().frames.picture(index);
            let picture = picture.map_err(|e| e.to_string())?;
            let frames = FrameJudge {
                flight: &flight,
                envelope: &work.envelope,
                day: plan.days,
                seed: plan.seed,
            };
            let landmark = &self.order.about.landmark;
            let looks = frames.looks(landmark, &work.trained, index, &picture);
            work.looks.extend(looks);
        }
        Ok(true)
    }

    /// Pictures looked at, those in all, and what is being done.
    fn progress(&self) -> (usize, usize, &'static str) {
        let Some(work) = &self.work else {
            return (0, 1, "");
        };
        let (photos, all_photos) = work.judge.progress();
        let real = work.real.as_ref();
        let (frames, all_frames) = real.map_or((0, 0), |r| (r.all - r.left.len(), r.all));
        let what = if photos < all_photos {
            "photo"
        } else {
            "frame"
        };
        (photos + frames, all_photos + all_frames, what)
    }

    fn report(&self, replicates: usize) -> Result<(EvaluationReport, Evaluation), String> {
        let Some(work) = &self.work else {
            return Err("nothing was looked at".to_owned());
        };
        let looks = work.looks();
        let settings = EvaluationSettings {
            replicates,
            false_alarms: self.order.false_alarms,
            seed: self.order.seed,
        };
        let landmark = &self.order.about.landmark;
        let evaluation = Evaluation::of(looks, &settings)
            .map_err(|why| format!("\"{}\": {why}", landmark.name))?;
        let of = (landmark.id, landmark.name.as_str());
        let mut report = EvaluationReport::of(of, looks, work.trained.least_score, &evaluation);
        report.figures.extend(work.left_out.clone());
        Ok((report, evaluation))
    }
}

impl RunningJob for Evaluate {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if self.work.is_none() {
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            self.work = Some(self.begin(worker)?);
            return Ok(Advance::More);
        }
        let more = self.look(clock)?;
        let (done, all, what) = self.progress();
        let words = format!("Judging the detector: {what} {done} of {all}");
        emit(JobEvent::Progress(done as f32 / all.max(1) as f32, words));
        if more {
            if done >= self.told + TOLD_EVERY {
                self.told = done;
                // Of the first few pictures there may be nothing to tell.
                if let Ok((mut report, _)) = self.report(FEW_REPLICATES) {
                    report.is_partial = true;
                    emit(JobEvent::Evaluation(Box::new(report)));
                }
            }
            return Ok(Advance::More);
        }
        let (report, evaluation) = self.report(EvaluationSettings::default().replicates)?;
        emit(JobEvent::Evaluation(Box::new(report)));
        if let (Some(detail), Some(work)) = (self.detail, &self.work) {
            emit(detail(&self.order, work, evaluation)?);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for EvaluationOrder {
    const URGENCY: Urgency = Urgency::Ahead;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(self.flight.as_ref(), Some(&self.about.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let area = around(&self.about.landmark.bounds);
        Some((&self.about.map, Reads::Areas(vec![area])))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Evaluate::new(self, None))
    }
}

impl EvaluationOrder {
    /// Judging of which everything is told: after the last report an event `Figures` with a [`JudgedDetector`].
    pub fn in_detail(self) -> VariantOrder<Self> {
        VariantOrder::new(self, |order| {
            Box::new(Evaluate::new(order, Some(in_detail)))
        })
    }
}

fn in_detail(
    order: &EvaluationOrder,
    work: &JudgingWork,
    evaluation: Evaluation,
) -> Result<JobEvent, String> {
    let (looks, threshold) = (work.looks().to_vec(), work.trained.least_score);
    let asked = order.flight.as_ref();
    JobEvent::of_figures(&JudgedDetector {
        landmark: order.about.landmark.name.clone(),
        threshold,
        in_use: AtThreshold::over(&looks, threshold),
        in_real_frames: asked.map(|_| AtThreshold::over_real(&looks, threshold)),
        evaluation,
        looks,
    })
}

#[cfg(test)]
mod tests {
    use pilotage_core::landmark::cascade::{
        Cascade, CascadeFeature, NodeSplit, TrainedStage, TrainedTree,
    };
    use pilotage_core::landmark::trained::{DetectorWindow, Likelihood, MarkPrecision, Variants};
    use pilotage_core::mission::{FrameLabels, Mission};
    use pilotage_core::simulate::Scenario;

    use super::*;
    use crate::{
        Abilities, AssessmentOrder, FlownCamera, Job, JobRunner, MapSource, Reply, Request,
        SimulationOptions,
    };

    /// A detector that marks every place of the ground alike.
    fn anything(bounds: pilotage_core::frames::GroundRect) -> TrainedDetector {
        let feature = CascadeFeature::Hog {
            cell: [0, 0, 8, 8],
            component: 3,
        };
        let stump = TrainedTree::stump(0, NodeSplit::Threshold(0.1), -1.0, 1.0);
        let stage = TrainedStage {
            trees: vec![stump],
            threshold: -2.0,
        };
        let camera_gsd = 0.4;
        let window = DetectorWindow::around(&bounds, camera_gsd, Variants::default());
        let (width, height) = (window.width, window.height);
        TrainedDetector {
            cascade: Cascade::from_parts(width, height, vec![feature], &[stage]).unwrap(),
            window,
            bounds,
            least_score: 1.0,
            likelihood: Likelihood {
                offset: 0.0,
                slope: 1.0,
            },
            precision: MarkPrecision::even(1.0),
            template: None,
        }
    }

    fn order(is_trained: bool) -> EvaluationOrder {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mission = scenario.mission();
        let mut landmark = mission.landmarks[0].clone();
        if is_trained {
            landmark.keep_trained(Some(&anything(landmark.bounds)));
        }
        let about = AssessmentOrder {
            map: MapSource::world("countryside"),
            landmark,
            camera: Scenario::camera(),
            height: scenario.height,
            navigator: mission.navigator,
            ground_down: 0.0,
            seed: AssessmentOrder::SEED,
        };
        let flight = FlightSource::Simulated(SimulationOptions {
            scenario: scenario.name.to_owned(),
            seed: 1,
            other_day: true,
            wind: None,
            height: None,
        });
        EvaluationOrder {
            photos: 10,
            days: 2,
            ..EvaluationOrder::usual(about, Some(flight))
        }
    }

    fn events(order: EvaluationOrder) -> Vec<JobEvent> {
        let (mut runner, mut events) = (JobRunner::new(Abilities::WHOLE), Vec::new());
        let mut keep = |reply| {
            if let Reply::Event(_, event) = reply {
                events.push(event);
            }
        };
        runner.receive(Request::Start(1, Job::Evaluate(Box::new(order))), &mut keep);
        while runner.turn(&|| 0.0, &mut keep) {}
        events
    }

    #[test]
    fn a_detector_is_judged_on_photos_and_frames_and_what_is_told_can_be_saved() {
        let events = events(order(true));
        assert!(
            matches!(events.last(), Some(JobEvent::Finished)),
            "{:?}",
            events.last()
        );
        let mut reports = events.iter().filter_map(|event| match event {
            JobEvent::Evaluation(report) => Some(report),
            _ => None,
        });
        let report = reports.next_back().expect("a report");
        assert!(!report.is_partial);
        assert!(
            report.figures[0].starts_with("as flown: found "),
            "{:?}",
            report.figures
        );
        assert!(report.figures[1].starts_with("as flown in real frames: "));
        assert!(report.figures[1].ends_with("; all of one flight"));
        assert!(report.basis.contains("of 3 days"), "{}", report.basis);
        assert!(report.csv.starts_with("curve,x,y,low,high,threshold\n"));
        assert!(report.plots.len() >= 4);
        assert!(report.plots.iter().all(|(_, svg)| svg.starts_with("<svg")));
    }

    #[test]
    fn frames_that_are_labelled_are_no_frames_to_judge_by() {
        let mut order = order(true);
        let landmark = order.about.landmark.id;
        let labels = |count: usize| {
            let names = (0..count).map(|number| format!("{number:05}.jpg"));
            let labels = names.map(|frame| FrameLabels {
                frame,
                size: (640, 480),
                absent: vec![landmark],
                ..FrameLabels::default()
            });
            labels.collect()
        };
        order.labels = labels(1000);
        let all = events(order.clone());
        let last = all.iter().rev().find_map(|event| match event {
            JobEvent::Evaluation(report) => Some(report),
            _ => None,
        });
        let report = last.expect("a report");
        assert!(report.basis.contains(" 0 real;"), "{}", report.basis);
        let told = report.figures.last().expect("figures");
        assert!(told.starts_with("left out of the real frames: "), "{told}");
        assert!(
            told.ends_with(" labelled, 0 that show mostly the same ground"),
            "{told}"
        );
        order.labels = labels(1);
        order.most_frames = 2;
        let judged: JudgedDetector = crate::running::figures(order.in_detail());
        assert!(judged.evaluation.real > 0);
    }

    #[test]
    fn real_frames_are_looked_at_by_the_camera_that_the_mission_has_for_the_flight() {
        let judged = |focal: f64, camera: FlownCamera| {
            let order = EvaluationOrder {
                most_frames: 3,
                camera,
                ..order(true)
            };
            let mut worker = WorkerState::new(Abilities::WHOLE.opens);
            let open = worker.flight(order.flight.as_ref().unwrap()).unwrap();
            Arc::make_mut(&mut open.borrow_mut().flight).camera.focal *= focal;
            let (mut job, mut figures) = (order.in_detail().begin(&mut worker), None);
            let mut keep = |event: JobEvent| figures = event.read_figures().ok().or(figures.take());
            while job.advance(&mut worker, &|| 0.0, &mut keep).unwrap() == Advance::More {}
            let judged: JudgedDetector = figures.expect("figures");
            let looks = judged.looks.into_iter();
            looks.filter(|look| look.real).collect::<Vec<_>>()
        };
        let mission = Scenario::named("distinct-400ft-calm").unwrap().mission();
        let right = FlownCamera::of(&Mission {
            camera: Some(Scenario::camera()),
            ..mission
        });
        let as_opened = judged(1.0, FlownCamera::default());
        assert_eq!(as_opened.len(), 3);
        assert_eq!(judged(2.0, right), as_opened);
        assert_ne!(judged(2.0, FlownCamera::default()), as_opened);
    }

    #[test]
    fn without_a_detector_the_judging_says_so() {
        let events = events(order(false));
        let failed =
            matches!(events.last(), Some(JobEvent::Failed(why)) if why.contains("no detector"));
        assert!(failed, "{:?}", events.last());
    }

    #[test]
    fn everything_that_a_detector_was_judged_by_is_told_to_those_who_ask() {
        let mut order = order(true);
        order.most_frames = 3;
        order.false_alarms = 0.25;
        let judged: JudgedDetector = crate::running::figures(order.clone().in_detail());
        assert_eq!(judged.landmark, order.about.landmark.name);
        assert_eq!(judged.evaluation.operating.allowed, 0.25);
        let real = judged.looks.iter().filter(|look| look.real).count();
        assert_eq!(
            (judged.looks.len() - real, judged.evaluation.real),
            (10, real)
        );
        assert!((1..=3).contains(&real), "{real} real frames");
        let of_real = judged.in_real_frames.unwrap();
        assert_eq!(of_real.deceived.of, real);
        // Without a flight nothing is said of real frames.
        order.flight = None;
        let judged: JudgedDetector = crate::running::figures(order.in_detail());
        assert_eq!((judged.in_real_frames, judged.looks.len()), (None, 10));
    }
}
