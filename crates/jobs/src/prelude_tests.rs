//! The stored first seconds are what the program computes, and what differs is told.

use std::cell::Cell;
use std::ffi::OsStr;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::Window;
use pilotage_core::navigator::FrameReport;
use pilotage_core::raster::{Picture, decode_picture, encode_jpeg};
use pilotage_core::simulate::Scenario;
use serde_json::Value;

use super::*;
use crate::{
    Abilities, Advance, AssessmentOrder, DescribeMapOrder, FlightSource, FlyOrder,
    MeasuredLandmark, MeasurementBasis, Reply, Request, SimulationOptions, WorkerState,
};

/// Seconds of the flight that are stored beyond its first match.
const BEYOND: f64 = 0.5;
/// Every so many pictures one is stored, a tenth of a megabyte each; the one before stays on screen meanwhile.
const EVERY: usize = 4;
/// Half the side of the ground that is stored, metres: more than the first view shows of it.
const REACH: f64 = 512.0;
/// Ground sample distance of that picture, metres.
const GROUND_GSD: f64 = 1.6;
/// Quality of that picture: it is soon covered by the tiles themselves.
const GROUND_QUALITY: u8 = 70;
/// Largest difference between two numbers of two machines, of the larger one or of 1: the last digits of a sine change
/// a grey level here and there, and that the place of a match by thousandths of a millimetre.
const DIGITS: f64 = 1e-4;

/// A file that the page ships.
fn shipped(name: &str) -> PathBuf {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../www/first");
    PathBuf::from(folder).join(name)
}

/// The jobs of a first visit.
fn first_jobs() -> [Job; 2] {
    let demo = SimulationOptions::demo();
    let map = demo.map();
    let fly = Job::Fly(FlyOrder {
        flight: FlightSource::Simulated(demo),
        map: map.clone(),
        mission: None,
    });
    [Job::DescribeMap(DescribeMapOrder(map)), fly]
}

/// First seconds to be stored, out of the events of those jobs.
fn of_events(events: impl IntoIterator<Item = JobEvent>) -> FirstSeconds {
    let (mut map_info, mut flight, mut mission, mut run) = (None, None, None, None);
    let (mut steps, mut pictures) = (Vec::new(), BTreeMap::new());
    let mut end = f64::INFINITY;
    for event in events {
        match event {
            JobEvent::MapInfo(it) => map_info = Some(it),
            JobEvent::Flight(it) => flight = Some(it),
            JobEvent::Mission(it) => mission = Some(it),
            JobEvent::RunStarted(it) => run = Some(it),
            JobEvent::Steps(some) => {
                for step in some {
                    let frame = step.frame.as_ref();
                    if frame.is_some_and(|frame| frame.accepted().next().is_some()) {
                        end = end.min(step.time + BEYOND);
                    }
                    if step.time <= end {
                        steps.push(StepReport {
                            timing: StepTiming::default(),
                            ..step
                        });
                    }
                }
            }
            JobEvent::FrameEncoded { index, encoded } => {
                pictures.insert(index, encoded);
            }
            _ => {}
        }
    }
    let last = last_frame(&steps);
    pictures.retain(|index, _| Some(*index) <= last);
    let start = steps[0].after.position();
    let center = GroundPoint::new(start.north.round(), start.east.round());
    let demo = SimulationOptions::demo();
    FirstSeconds {
        map: FirstMap {
            source: demo.map(),
            info: map_info.expect("a map"),
            ground: GroundRect::centered(center, 2.0 * REACH, 2.0 * REACH),
        },
        source: FlightSource::Simulated(demo),
        flight: flight.expect("a flight"),
        mission: mission.expect("a mission"),
        run: run.expect("a run"),
        steps,
        pictures,
        measured: Vec::new(),
    }
}

/// Landmarks of the first seconds as this program measures them: those of which the index is among `which`.
fn measured(first: &FirstSeconds, which: &[usize]) -> Vec<KeptMeasurement> {
    let navigator = &first.mission.navigator;
    let camera = first
        .mission
        .camera
        .as_ref()
        .unwrap_or(&first.flight.camera);
    let (sensors, detector) = (navigator.sensors, navigator.detector);
    let (map, source) = (&first.map.info, &first.map.source);
    let scenario = Scenario::named(&SimulationOptions::demo().scenario).expect("the demo");
    let measure = |index: &usize| {
        let landmark = &first.mission.landmarks[*index];
        let order = AssessmentOrder {
            map: source.clone(),
            landmark: landmark.clone(),
            camera: camera.clone(),
            height: scenario.height,
            navigator: navigator.clone(),
            ground_down: first.flight.ground_down,
            seed: AssessmentOrder::SEED,
        };
        let events = crate::running::finished(order).into_iter();
        let mut told = events.filter_map(|event| match event {
            JobEvent::Assessment(found) => Some(*found),
            _ => None,
        });
        let last = told.next().expect("it is measured");
        KeptMeasurement {
            basis: MeasurementBasis::new(map, source, camera, sensors, detector),
            landmark: landmark.clone(),
            measured: Some(MeasuredLandmark {
                statistics: last.statistics(),
                last,
            }),
            envelope: None,
        }
    };
    which.iter().map(measure).collect()
}

/// Index of the last frame in steps.
fn last_frame(steps: &[StepReport]) -> Option<usize> {
    let seen = steps.iter().filter_map(|step| step.frame.as_ref());
    seen.map(|frame| frame.index).max()
}

/// Order of the file of a picture of the demo.
fn asked_for(index: usize) -> FramePictureOrder {
    FramePictureOrder {
        flight: FlightSource::Simulated(SimulationOptions::demo()),
        index,
        form: PictureForm::Encoded,
    }
}

fn ask_for_file(index: usize) -> Job {
    Job::FramePicture(asked_for(index))
}

/// First seconds as this program computes them, and the picture of the ground.
fn computed() -> (FirstSeconds, Picture) {
    let mut worker = WorkerState::new(Abilities::FLYING.opens);
    let mut events = Vec::new();
    for job in first_jobs() {
        let mut running = (Abilities::FLYING.begin)(job, &mut worker);
        let (mut matched, mut advance) = (None, Advance::More);
        // Some steps beyond the first match are enough.
        while advance == Advance::More && matched.is_none_or(|at| events.len() < at + 60) {
            let mut tell = |event: JobEvent| {
                if let JobEvent::Steps(steps) = &event {
                    let frames = steps.iter().filter_map(|step| step.frame.as_ref());
                    if frames.flat_map(FrameReport::accepted).next().is_some() {
                        matched = matched.or(Some(events.len()));
                    }
                }
                events.push(event);
            };
            // Every look at the clock takes so long that a slice is a step.
            let time = Cell::new(0.0);
            let clock = || {
                time.set(time.get() + 1e3);
                time.get()
            };
            advance = running.advance(&mut worker, &clock, &mut tell).unwrap();
        }
    }
    let last = last_frame(&steps(&events)).unwrap_or_default();
    for index in (0..=last).step_by(EVERY) {
        let mut running = (Abilities::FLYING.begin)(ask_for_file(index), &mut worker);
        let mut tell = |event| events.push(event);
        running.advance(&mut worker, &|| 0.0, &mut tell).unwrap();
    }
    let first = of_events(events);
    let map = worker.map(&first.map.source).expect("the scenery");
    let pixels = map.window(&Window::covering(&first.map.ground, GROUND_GSD));
    (first, pixels.map(|[r, g, b, _]| [r, g, b]))
}

/// First seconds as the page in a folder computes them, asked without a browser: to the last digit the values
/// of its workers.
fn computed_by_page(page: &OsStr, pictures: impl Iterator<Item = usize>) -> FirstSeconds {
    let script = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/browser/first-seconds.mjs"
    );
    let mut node = Command::new("node")
        .arg(script)
        .arg(page)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("node runs the page's program");
    let mut ask = node.stdin.take().unwrap();
    let jobs = first_jobs().into_iter().chain(pictures.map(ask_for_file));
    for (id, job) in jobs.enumerate() {
        let request = Request::Start(id as u64, job);
        let bytes = postcard::to_stdvec(&request).unwrap();
        ask.write_all(&(bytes.len() as u32).to_le_bytes()).unwrap();
        ask.write_all(&bytes).unwrap();
    }
    drop(ask);
    let said = node.wait_with_output().unwrap();
    assert!(said.status.success(), "{}", said.status);
    let mut rest = said.stdout.as_slice();
    let replies = std::iter::from_fn(|| {
        let (length, behind) = rest.split_first_chunk()?;
        let (reply, behind) = behind.split_at(u32::from_le_bytes(*length) as usize);
        rest = behind;
        Some(postcard::from_bytes(reply).unwrap())
    });
    of_events(replies.filter_map(|reply| match reply {
        Reply::Event(_, event) => Some(event),
        Reply::Alive => None,
    }))
}

/// First place where two values differ by more than the last digits of a number may between machines, if
/// there is one.
fn difference(one: &Value, other: &Value, place: &str) -> Option<String> {
    use Value::{Array, Number, Object};
    match (one, other) {
        (Number(a), Number(b)) => {
            let (a, b) = (a.as_f64()?, b.as_f64()?);
            let is_near = (a - b).abs() <= DIGITS * a.abs().max(b.abs()).max(1.0);
            (!is_near).then(|| format!("{place}: {a} and {b}"))
        }
        (Array(a), Array(b)) if a.len() == b.len() => {
            let mut pairs = a.iter().zip(b).enumerate();
            pairs.find_map(|(at, (a, b))| difference(a, b, &format!("{place}/{at}")))
        }
        (Object(a), Object(b)) if a.keys().eq(b.keys()) => {
            let mut pairs = a.iter().zip(b.values());
            pairs.find_map(|((key, a), b)| difference(a, b, &format!("{place}/{key}")))
        }
        (Array(a), Array(b)) => Some(format!("{place}: {} and {}", a.len(), b.len())),
        _ if one == other => None,
        _ => Some(format!("{place}: {one:.60} and {other:.60}")),
    }
}

/// Root of the mean square of the differences between two pictures, grey levels.
fn rms(one: &Picture, other: &Picture) -> f64 {
    assert_eq!((one.width(), one.height()), (other.width(), other.height()));
    let pairs = one.pixels().iter().zip(other.pixels());
    let pairs = pairs.flat_map(|(one, other)| one.iter().zip(other));
    let squares: f64 = pairs
        .map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2))
        .sum();
    (squares / (3 * one.pixels().len()) as f64).sqrt()
}

#[test]
fn the_stored_first_seconds_are_what_the_program_computes() {
    let (computed, ground) = computed();
    let (seconds, picture) = (shipped("seconds.bin"), shipped("ground.jpg"));
    if let Some(page) = std::env::var_os("PILOTAGE_FIRST_SECONDS_OF") {
        std::fs::create_dir_all(shipped("")).unwrap();
        let mut first = computed_by_page(&page, computed.pictures.keys().copied());
        let all: Vec<usize> = (0..first.mission.landmarks.len()).collect();
        first.measured = measured(&first, &all);
        std::fs::write(&seconds, first.encode()).unwrap();
        std::fs::write(&picture, encode_jpeg(&ground, GROUND_QUALITY).unwrap()).unwrap();
    }
    let anew =
        "the program computes something else by now: `cargo xtask first-seconds` stores it anew";
    let stored = std::fs::read(&seconds).expect(anew);
    let head = FirstMap::decode(&stored).expect(anew);
    let stored = FirstSeconds::decode(&stored).expect(anew);
    assert_eq!(head, stored.map);
    for (index, encoded) in &stored.pictures {
        let [one, other] = [encoded, &computed.pictures[index]].map(|it| decode_picture(&it.0));
        let off = rms(&one.unwrap(), &other.unwrap());
        assert!(
            off < 0.5,
            "picture {index} is {off} grey levels off: {anew}"
        );
    }
    let [one, other] = [&stored, &computed].map(|it| {
        let without_pictures = FirstSeconds {
            pictures: BTreeMap::new(),
            measured: Vec::new(),
            ..it.clone()
        };
        serde_json::to_value(without_pictures).unwrap()
    });
    assert_eq!(difference(&one, &other, ""), None, "{anew}");
    let mut frames = stored.steps.iter().filter_map(|step| step.frame.as_ref());
    assert!(frames.any(|frame| frame.accepted().next().is_some()));
    // Of the landmarks one is measured again, which takes seconds.
    let again = measured(&computed, &[stored.measured.len() - 1]);
    assert_eq!(stored.measured.len(), stored.mission.landmarks.len());
    for anew in again {
        let of = |it: &&KeptMeasurement| it.landmark.id == anew.landmark.id;
        let before = stored.measured.iter().find(of).expect("all were measured");
        assert!(before.basis.is_like(&anew.basis));
        let found = |it: &KeptMeasurement| {
            let views = it.measured.iter().flat_map(|m| &m.last.views);
            views.filter(|view| view.found).count()
        };
        // The last digits of a machine may turn one look.
        let (a, b) = (found(before), found(&anew));
        assert!(a.abs_diff(b) <= 1, "{}: {a} and {b}", anew.landmark.name);
    }
    // The picture loses what JPEG loses.
    let kept = decode_picture(&std::fs::read(&picture).expect(anew)).unwrap();
    let off = rms(&kept, &ground);
    assert!(off < 12.0, "the ground is {off} grey levels off: {anew}");
}

/// A prelude over the stored first seconds that has begun the flight as job 7, and what it told.
fn begun() -> (Prelude, Vec<JobEvent>) {
    let bytes = std::fs::read(shipped("seconds.bin")).unwrap();
    let stored = FirstSeconds::decode(&bytes).unwrap();
    let fly = Job::Fly(FlyOrder {
        flight: stored.source.clone(),
        map: stored.map.source.clone(),
        mission: None,
    });
    let mut prelude = Prelude::new(Some(stored));
    let told = prelude.begin(7, &fly);
    (prelude, told)
}

/// The steps among events.
fn steps(told: &[JobEvent]) -> Vec<StepReport> {
    let of = |event: &JobEvent| match event {
        JobEvent::Steps(steps) => steps.clone(),
        _ => Vec::new(),
    };
    told.iter().flat_map(of).collect()
}

/// A step more than is stored.
fn later(told: &[JobEvent]) -> StepReport {
    let mut step = steps(told).pop().unwrap();
    step.time += 0.05;
    step
}

#[test]
fn what_a_worker_says_is_passed_on_once_it_is_beyond_what_is_stored() {
    let (mut prelude, told) = begun();
    for event in &told {
        assert_eq!(prelude.hear(7, event.clone()), []);
    }
    let new = || JobEvent::Steps(vec![later(&told)]);
    assert_eq!(prelude.hear(7, new()), [new()]);
    let (compared, different) = prelude.checked();
    assert_eq!(different, 0);
    assert_eq!(compared, told.len() - 1 + steps(&told).len());
    // Of another job, or after the last word, everything is passed on.
    assert_eq!(prelude.hear(8, told[0].clone()), [told[0].clone()]);
    assert_eq!(prelude.hear(7, JobEvent::Finished), [JobEvent::Finished]);
    assert_eq!(prelude.hear(7, told[0].clone()), [told[0].clone()]);
}

#[test]
fn a_worker_that_begins_anew_tells_nothing_twice() {
    let (mut prelude, told) = begun();
    for event in told.iter().chain(&told) {
        assert_eq!(prelude.hear(7, event.clone()), []);
    }
    assert_eq!(prelude.checked().1, 0);
}

#[test]
fn a_flight_that_begins_anew_beyond_what_is_stored_is_a_new_run() {
    let (mut prelude, told) = begun();
    for event in &told {
        assert_eq!(prelude.hear(7, event.clone()), []);
    }
    let beyond = JobEvent::Steps(vec![later(&told)]);
    assert_eq!(
        prelude.hear(7, beyond.clone()),
        std::slice::from_ref(&beyond)
    );
    for event in &told[..2] {
        assert_eq!(prelude.hear(7, event.clone()), []);
    }
    assert!(matches!(told[2], JobEvent::RunStarted(_)));
    assert_eq!(prelude.hear(7, told[2].clone()), told[..3]);
    for event in told[3..].iter().chain([&beyond]) {
        assert_eq!(prelude.hear(7, event.clone()), std::slice::from_ref(event));
    }
    assert_eq!(prelude.checked().1, 0);
}

#[test]
fn a_run_that_comes_out_otherwise_replaces_the_stored_one_from_there_on() {
    let (mut prelude, told) = begun();
    for event in &told[..3] {
        assert_eq!(prelude.hear(7, event.clone()), []);
    }
    let mut other = steps(&told);
    other[10].dead_reckoned.north += 0.01;
    let mut said = told[..3].to_vec();
    said.push(JobEvent::Steps(other.clone()));
    assert_eq!(prelude.hear(7, JobEvent::Steps(other)), said);
    assert_eq!(prelude.checked().1, 1);
    let next = JobEvent::Steps(vec![later(&told)]);
    assert_eq!(prelude.hear(7, next.clone()), [next]);
}

#[test]
fn a_flight_a_picture_or_a_map_that_comes_out_otherwise_is_told() {
    let (mut prelude, told) = begun();
    let ask = || {
        Job::FramePicture(FramePictureOrder {
            form: PictureForm::Pixels,
            ..asked_for(0)
        })
    };
    let form = |job| match job {
        Job::FramePicture(order) => order.form,
        other => panic!("{other:?}"),
    };
    let known = form(prelude.complete(ask()));
    assert!(matches!(known, PictureForm::PixelsOf(_)), "it is shipped");
    let picture = JobEvent::FrameTaken {
        index: 0,
        digest: Some(7),
    };
    assert_eq!(prelude.hear(7, picture.clone()), [picture]);
    assert_eq!(form(prelude.complete(ask())), PictureForm::Pixels);
    let JobEvent::Mission(mut mission) = told[1].clone() else {
        panic!("{:?}", told[1]);
    };
    mission.name = "another".to_owned();
    let another = JobEvent::Mission(mission);
    assert_eq!(prelude.hear(7, told[0].clone()), []);
    let anew = [told[0].clone(), another.clone()];
    assert_eq!(prelude.hear(7, another), anew);
    for event in &told[2..] {
        assert_eq!(prelude.hear(7, event.clone()), std::slice::from_ref(event));
    }
    let map = SimulationOptions::demo().map();
    let known = prelude.begin(9, &Job::DescribeMap(DescribeMapOrder(map)));
    assert_eq!(prelude.hear(9, known[0].clone()), []);
    let JobEvent::MapInfo(mut info) = known[0].clone() else {
        panic!("{known:?}");
    };
    info.name.push('!');
    let other = JobEvent::MapInfo(info);
    assert_eq!(prelude.hear(9, other.clone()), [other]);
    assert_eq!(prelude.checked().1, 3);
}
