//! The scripted host.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::Arc;

use pilotage_core::flight::interpret::log_of_flight;
use pilotage_core::flight::log::{Log, LogFormat, LogOutline};
use pilotage_core::flight::overview::overview;
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::EstimatorChoice;
use pilotage_core::plan::{
    Envelope, ExpectedDetection, LandmarkCandidate, Localizability, LookTally, Suggestion,
    UntestedDetection, ViewBreakdown,
};
use pilotage_core::raster::Raster;
use pilotage_core::study::{Contender, ContenderTally as FlightTally, EstimatorComparison};
use pilotage_jobs::{
    Abilities, AssessAheadOrder, Assessment, AssessmentOrder, ContestOrder, DetectorSearch,
    Distinctness, DistinctnessOrder, EnvelopeOrder, ExplainOrder, ExplainedBy, FieldOrder,
    FileContent, FlightSource, FlyOrder, Glance, Job, JobEvent, JobId, JobRunner, MakeFlightOrder,
    MapInfo, MatchPictures, OpenOrder, OpenedFiles, ProvideOrder, ReadLog, ReadLogOrder, Reply,
    Request, SuggestOrder, TileOrder,
};
use pilotage_ui::host::{Download, Host, OpenedFile};
use pilotage_ui::job_owners::JobOwners;

use super::flight::{flight, mission, run, run_head};
use super::followed::followed;
use super::heights::heights;
use super::laid::{Laying, early_flight, lay_frames};
use super::real::{Studies, is_real};
use super::tile::tile;

/// Fate of work that nobody asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ahead {
    /// It is left undone.
    #[default]
    Left,
    /// It is done.
    Done,
}

/// Colours of the rest of the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    /// Dark ones.
    #[default]
    Dark,
    /// Light ones.
    Light,
}

/// Pointing device of the machine.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub enum Pointing {
    /// With a mouse.
    #[default]
    Mouse,
    /// With their fingers.
    Fingers,
}

/// Answers jobs at once, unless told not to, and remembers what it was asked.
#[derive(Default)]
pub struct ScriptedHost {
    /// Pointer of the machine.
    pub pointer: Pointing,
    /// Milliseconds of its clock.
    pub now: f64,
    /// Every job asked for, in order.
    pub jobs: Vec<(JobId, Job)>,
    /// Owners of the jobs.
    pub owners: JobOwners,
    /// Jobs cancelled.
    pub cancelled: Vec<JobId>,
    /// Jobs whose last event was handed over.
    pub over: HashSet<JobId>,
    /// Jobs told to keep their place, or to go on.
    pub held: Vec<(JobId, bool)>,
    /// Films: `begun`, and the names of those that ended.
    pub films: Vec<String>,
    /// Events to hand over.
    pub events: Vec<(JobId, JobEvent)>,
    /// Files to hand over.
    pub opened: Vec<Vec<OpenedFile>>,
    /// Data that was stored, by key.
    pub stored: HashMap<String, Vec<u8>>,
    /// Keys of which this visit was told: as the page does, each once.
    pub recalled: RefCell<HashSet<String>>,
    /// Files offered to the user.
    pub saved: Vec<(String, Vec<u8>)>,
    /// Addresses of tiles that were to be downloaded.
    pub downloaded: Vec<String>,
    /// State of that, told in answer.
    pub download: Option<Download>,
    /// Pictures offered to the user: name, drawing, and size in pixels.
    pub pictures: Vec<(String, String, [u32; 2])>,
    /// Number of times that the file dialog was asked for.
    pub file_dialogs: usize,
    /// The fragment of the last link that was copied.
    pub link: String,
    /// Fate of it once that is known: whether the clipboard took it.
    pub link_copied: Option<bool>,
    /// The page printed last: its style and its body.
    pub printed: Option<(String, String)>,
    /// Files of the page that were asked for, in order.
    pub asked_files: Vec<String>,
    /// Bytes of the files of the page, by name.
    pub own_files: HashMap<String, Vec<u8>>,
    /// Keys to report as refused.
    pub refused: Vec<String>,
    /// Places in the app that it told of, one after the other.
    pub places: Vec<String>,
    /// Place to which the browser's Back leads.
    pub gone_back: Option<String>,
    /// Saves to report as broken off.
    pub interrupted: Vec<String>,
    /// Notices that the shell tells of its own, title and text.
    pub troubles: Vec<(String, String)>,
    /// Share of frames in which tested landmarks are found on a day on which they are recognised, unless one half.
    pub per_frame: Option<f64>,
    /// Share of views in which something else is taken for a landmark, 1/32 unless set.
    pub wrong: Option<f64>,
    /// Work that nobody asked for.
    pub ahead: Ahead,
    /// Colours of the rest of the screen.
    pub scheme: Scheme,
    /// Workers to report as lost.
    pub lost: usize,
    /// Keys of the files that stayed when others were let go last.
    pub in_use: BTreeSet<String>,
    /// Laying of pictures on the map.
    pub laying: Laying,
    /// Leave flights without an answer.
    pub silent_flights: bool,
    /// Jobs that are left without an answer.
    pub left: Option<fn(&Job) -> bool>,
    /// Fate of the flights of studies.
    pub studies: Studies,
    /// Error that is told of opened files.
    pub opening_fails: Option<String>,
    /// Contents of opened files.
    pub opens: Option<OpenedFiles>,
    /// Look at opened files as a worker does.
    pub really_open: bool,
    /// Height of the ground in the elevation model that is opened, metres.
    pub heights: Option<fn(&GroundPoint) -> f64>,
}

/// Events of a match that is to be explained: pictures, or that a trained detector's are gone.
fn explained(order: &ExplainOrder) -> [JobEvent; 2] {
    let (time, landmark) = (order.step.time, order.landmark);
    let pixels = |side| Raster::from_fn(side, side, |c, r| (c * r) as f32);
    let answer = match order.by {
        ExplainedBy::Template => JobEvent::Match(Box::new(MatchPictures {
            time,
            landmark,
            patch: pixels(4),
            rectified: pixels(12),
            surface: pixels(9),
            peak: Some((8.0, 8.0)),
            second: None,
            gsd: 0.5,
        })),
        ExplainedBy::Cascade => JobEvent::Detector(Box::new(DetectorSearch {
            time,
            landmark,
            found: Err("the picture is gone".to_owned()),
        })),
    };
    [answer, JobEvent::Finished]
}

impl ScriptedHost {
    /// Begins another visit, which may be told again of what is stored.
    pub fn begin_visit(&mut self) {
        self.recalled.get_mut().clear();
    }

    /// Flights asked for so far.
    pub fn flights(&self) -> usize {
        self.jobs
            .iter()
            .filter(|(_, j)| matches!(j, Job::Fly(_)))
            .count()
    }

    /// The last flight asked for.
    pub fn last_flight(&self) -> Option<&(JobId, Job)> {
        self.jobs
            .iter()
            .rev()
            .find(|(_, j)| matches!(j, Job::Fly(_)))
    }

    /// Answers the flights that were left without an answer, and those to come.
    pub fn begin_flights(&mut self) {
        self.silent_flights = false;
        for (id, job) in self.jobs.clone() {
            if matches!(job, Job::Fly(_)) {
                self.answer(id, &job);
            }
        }
    }

    /// Whether a job is about the flight that a log or tables tell of, which are really read.
    fn is_of_a_log(&self, job: &Job) -> bool {
        let flight = match job {
            Job::Fly(FlyOrder { flight, .. }) if !self.silent_flights => flight,
            Job::Outage(order) => &order.flight,
            _ => return false,
        };
        let is_it = |j: &Job| match (j, flight) {
            (
                Job::ReadLog(ReadLogOrder { key, .. }) | Job::MakeFlight(MakeFlightOrder { key }),
                FlightSource::Files(flown),
            ) => key == flown && !self.is_invented(key),
            _ => false,
        };
        self.jobs.iter().any(|(_, j)| is_it(j))
    }

    /// Whether the files under a key stand for others: all of one byte over and over.
    fn is_invented(&self, key: &str) -> bool {
        let of_key = |job: &Job| match job {
            Job::Provide(ProvideOrder { key: of, files }) if of == key => Some(files.clone()),
            _ => None,
        };
        let files = self.jobs.iter().rev().find_map(|(_, job)| of_key(job));
        let is_one_byte = |content: &FileContent| {
            let bytes = content.bytes();
            bytes.is_some_and(|bytes| bytes.windows(2).all(|pair| pair[0] == pair[1]))
        };
        files.is_some_and(|files| files.iter().all(|(_, content)| is_one_byte(content)))
    }

    /// Invents the content of files that stand for others: a log of which nothing is known.
    fn invent_log(&mut self, id: JobId, file: &str) {
        let log = Log::new(file, LogFormat::Tables);
        let flown = flight();
        let read = ReadLog {
            outline: LogOutline::of(&log),
            overview: overview(&log, &log_of_flight(&log, &flown).measured()),
            flight: Ok(flown.frame_on_globe),
            tracks: Vec::new(),
            lost_pictures: None,
        };
        self.events.push((id, JobEvent::LogRead(Box::new(read))));
        self.events.push((id, JobEvent::Finished));
    }

    /// Does what a worker would do.
    fn carry_out(&mut self, id: JobId, job: &Job) {
        let mut runner = JobRunner::new(Abilities::WHOLE);
        let events = &mut self.events;
        let mut keep = |reply: Reply| {
            // Through the bytes that the page would get. What the job rests on was answered before.
            if let Some(Reply::Event(of, event)) = Reply::from_bytes(&reply.to_bytes())
                && of == id
            {
                events.push((id, event));
            }
        };
        // What the job rests on: its files, and the log that it asks of.
        let is_ground = |j: &Job| matches!(j, Job::Provide(_) | Job::ReadLog(_)) && j != job;
        let files = self.jobs.iter().filter(|(_, j)| is_ground(j));
        for (of, job) in files.cloned().chain([(id, job.clone())]) {
            runner.receive(Request::Start(of, job), &mut keep);
            while runner.turn(&|| 0.0, &mut keep) {}
        }
    }

    fn fly(&mut self, id: JobId, given: Option<&Mission>) {
        let laying = self.laying;
        let mut say = |event| self.events.push((id, event));
        let mission = given.cloned().unwrap_or_else(mission);
        say(JobEvent::Progress(0.1, "Flying".into()));
        let mut flown = flight();
        let mut steps = run(&mission).steps;
        if laying != Laying::Never {
            let opened = early_flight();
            flown = mission.flown(&Arc::new(opened.clone())).as_ref().clone();
            if laying == Laying::Always || mission.navigator.whole_frames.is_some() {
                lay_frames(&mut steps, &opened, &flown);
            }
        }
        say(JobEvent::Flight(Box::new(flown)));
        if given.is_none() {
            say(JobEvent::Mission(Box::new(mission.clone())));
        }
        say(JobEvent::RunStarted(Box::new(run_head(&mission))));
        say(JobEvent::Steps(steps));
        for index in 0..flight().frames.len() {
            let digest = None;
            say(JobEvent::FrameTaken { index, digest });
        }
        say(JobEvent::Finished);
    }

    /// Answers a job, unless it is one of those that are left.
    pub fn answer(&mut self, id: JobId, job: &Job) {
        if let Job::ReadLog(ReadLogOrder { key, file }) = job
            && self.is_invented(key)
        {
            return self.invent_log(id, file);
        }
        if self.studies == Studies::Left && matches!(job, Job::StudyFlights(_)) {
            return;
        }
        if self.left.is_some_and(|left| left(job)) {
            return;
        }
        if is_real(job) || self.is_of_a_log(job) {
            return self.carry_out(id, job);
        }
        let mut say = |event| self.events.push((id, event));
        match job {
            Job::Fly(FlyOrder { mission, .. }) if !self.silent_flights => {
                self.fly(id, mission.as_ref());
            }
            Job::FramePicture(order) => {
                say(picture(order.index));
                say(JobEvent::Finished);
            }
            Job::Contest(order) => {
                say(JobEvent::Progress(0.5, "Extended Kalman filter".into()));
                say(JobEvent::ContestJudged(Box::new(contest(order))));
                say(JobEvent::Finished);
            }
            Job::DescribeMap(_) => {
                say(JobEvent::MapInfo(MapInfo {
                    name: "Invented ground".into(),
                    bounds: GroundRect::centered(GroundPoint::new(0.0, 0.0), 2000.0, 2000.0),
                    native_gsd: 0.15,
                    is_coarse_cheap: true,
                    origin: None,
                    attribution: None,
                }));
                say(JobEvent::Finished);
            }
            Job::Tile(TileOrder { window, .. }) => {
                say(tile(*window));
                say(JobEvent::Finished);
            }
            Job::Distinctness(DistinctnessOrder { bounds, radius, .. }) => {
                let found = distinctness(*bounds, *radius);
                say(JobEvent::Distinctness(Box::new(found)));
                say(JobEvent::Finished);
            }
            Job::Open(_) if self.really_open => self.carry_out(id, job),
            Job::Open(OpenOrder { key, .. }) => {
                if let Some(mut opened) = self.opens.clone() {
                    opened.key.clone_from(key);
                    say(JobEvent::Opened(Box::new(opened)));
                    say(JobEvent::Finished);
                }
                if let Some(why) = self.opening_fails.clone() {
                    say(JobEvent::Failed(why));
                }
            }
            Job::Predict(order) => match order.predict() {
                Ok(prediction) => {
                    say(JobEvent::Prediction {
                        prediction: Box::new(prediction),
                        computed: 1.0,
                    });
                    say(JobEvent::Finished);
                }
                Err(why) => say(JobEvent::Failed(why)),
            },
            Job::Field(order) => {
                let [half, whole] = fields(order).map(Box::new);
                say(JobEvent::Progress(0.5, "Row 1 of 2".into()));
                say(JobEvent::Field(half));
                say(JobEvent::Field(whole));
                say(JobEvent::Finished);
            }
            Job::TakeHeights(order) => {
                if let Some(shape) = self.heights {
                    say(JobEvent::Heights(Box::new(heights(shape, order))));
                    say(JobEvent::Finished);
                }
            }
            Job::Brief(_) => {
                say(JobEvent::BriefPictures(Box::default()));
                say(JobEvent::Finished);
            }
            Job::FollowRoad(order) => followed(order).into_iter().for_each(&mut say),
            Job::ExplainMatch(order) => explained(order).into_iter().for_each(&mut say),
            _ => self.rehearse(id, job),
        }
    }

    /// Answers what is asked about landmarks on other days; nothing is said of other jobs.
    fn rehearse(&mut self, id: JobId, job: &Job) {
        let mut say = |event| self.events.push((id, event));
        match job {
            Job::Assess(order) | Job::AssessAhead(AssessAheadOrder(order)) => {
                say(JobEvent::Progress(0.5, "View 16 of 32".into()));
                say(JobEvent::Assessment(Box::new(assessment(
                    order,
                    self.per_frame.unwrap_or(0.5),
                    self.wrong.unwrap_or(1.0 / 32.0),
                ))));
                say(JobEvent::Finished);
            }
            Job::Untested(_) => {
                let mut stated = UntestedDetection::of_any_map();
                stated.boxes = 24;
                stated.expected.recognised = 0.25 / stated.expected.per_frame;
                say(JobEvent::Untested(Box::new(stated)));
                say(JobEvent::Finished);
            }
            Job::Envelope(EnvelopeOrder(order)) => {
                say(JobEvent::Progress(0.5, "Look 6 of 12".into()));
                say(JobEvent::Envelope(Box::new(envelope(order.height))));
                say(JobEvent::Finished);
            }
            Job::Suggest(order) => {
                say(JobEvent::Progress(0.5, "Place 1 of 2".into()));
                say(JobEvent::Suggestions(suggestions(order)));
                say(JobEvent::Finished);
            }
            _ => {}
        }
    }
}

/// Pixels of a camera picture of the invented flight.
pub fn picture(index: usize) -> JobEvent {
    JobEvent::FramePicture {
        index,
        width: 8,
        pixels: [90, 110, 70, 255].repeat(48),
    }
}

/// The invented run as the judgement of every estimator.
fn contest(order: &ContestOrder) -> EstimatorComparison {
    let vehicle = order.mission.navigator.vehicle;
    let contenders = Contender::all(&EstimatorChoice::ALL, &[vehicle]);
    let judged = contenders.into_iter().map(|contender| {
        let mut tally = FlightTally::new(contender, false);
        tally
            .add(&flight(), &run(&order.mission), &|| 0.0)
            .expect("a run with its truth");
        tally
    });
    EstimatorComparison::of(&judged.collect::<Vec<_>>())
}

/// A field of which the north is known, and the same with a blind south.
fn fields(order: &FieldOrder) -> [Localizability; 2] {
    let mut half = Localizability::unknown(&order.region, order.step());
    let north = half.values.len() / 2;
    half.values[..north].fill(0.9);
    let mut whole = half.clone();
    whole.values[north..].fill(0.0);
    [half, whole]
}

/// A box with one look-alike to the north of it.
fn distinctness(bounds: GroundRect, radius: f64) -> Distinctness {
    let center = bounds.center();
    Distinctness {
        bounds,
        radius,
        surface: Raster::from_fn(40, 40, |c, r| {
            let (x, y) = (c as f32 - 20.0, r as f32 - 20.0);
            (-0.02 * (x * x + y * y)).exp()
        }),
        surface_rect: bounds.grown(radius),
        look_alike: Some((GroundPoint::new(center.north + 50.0, center.east), 0.41)),
        contrast: 38.0,
        flat: false,
        verdict: "Nothing within 120 m of it on this map looks like it.".into(),
    }
}

/// So many looks, of which so many found the landmark and so many something else.
fn tally(looks: usize, found: usize, wrong: usize) -> LookTally {
    LookTally {
        looks,
        found,
        wrong,
        covariances: nalgebra::Matrix2::identity() * 0.04 * found as f64,
    }
}

/// A grid in which the landmark does not fit into pictures from the lowest height.
fn envelope(height: f64) -> Envelope {
    let mut cells = vec![LookTally::default(); 2];
    cells.extend([tally(6, 6, 0), tally(6, 3, 1)]);
    Envelope {
        heights: vec![0.5 * height, height],
        tilts: vec![0.0, 0.35],
        cells,
    }
}

/// Two places of the map, the surer first.
fn suggestions(order: &SuggestOrder) -> Vec<Suggestion> {
    let place = |north: f64, probability: f64| Suggestion {
        candidate: LandmarkCandidate {
            bounds: GroundRect::centered(GroundPoint::new(north, 0.0), 30.0, 30.0),
            score: 0.7,
            rival: 0.3,
            rival_place: GroundPoint::new(north + 40.0, 0.0),
            margin: 0.295,
            drift: 0.1,
            probability,
            range: [probability; 2],
        },
        in_view: 12.0,
        gained: 9.0,
        reason: format!("keeps 9 s from dead reckoning, found in {probability:.2}"),
    };
    let mut list = vec![place(-120.0, 0.7), place(160.0, 0.5)];
    list.truncate(order.count);
    list
}

/// A landmark that is found in every other view.
fn assessment(order: &AssessmentOrder, per_frame: f64, wrong: f64) -> Assessment {
    let glance = |i: u32| Glance {
        heading: f64::from(i),
        off_centre: 10.0 * f64::from(i),
        day: i as usize % 4,
        found: i.is_multiple_of(2),
        wrong: i == 7,
    };
    Assessment {
        landmark: order.landmark.clone(),
        height: order.height,
        expected: ExpectedDetection {
            recognised: 0.9,
            per_frame,
            covariance: nalgebra::Matrix4::identity() * 0.04,
        },
        false_matches: wrong,
        views: (0..32).map(glance).collect(),
        breakdown: ViewBreakdown {
            heading: vec![tally(8, 4, 0); 4],
            attitude_error: vec![tally(10, 5, 1), tally(10, 5, 0), LookTally::default()],
            edges: [0.005, 0.01],
            day: vec![tally(8, 4, 0); 4],
        },
    }
}

impl Host for ScriptedHost {
    fn prefers_light(&self) -> bool {
        self.scheme == Scheme::Light
    }

    fn is_touched_first(&self) -> bool {
        self.pointer == Pointing::Fingers
    }

    fn download(&mut self, addresses: Vec<String>) {
        self.downloaded.extend(addresses);
    }

    fn download_state(&mut self) -> Option<Download> {
        self.download
    }

    fn works_ahead(&self) -> bool {
        self.ahead == Ahead::Done
    }

    fn now(&self) -> f64 {
        self.now
    }

    fn owners(&mut self) -> &mut JobOwners {
        &mut self.owners
    }

    fn begin(&mut self, job: Job) -> JobId {
        let id = self.jobs.len() as JobId + 1;
        self.answer(id, &job);
        self.jobs.push((id, job));
        id
    }

    fn let_go(&mut self, in_use: &BTreeSet<String>) {
        self.in_use.clone_from(in_use);
    }

    fn cancel(&mut self, job: JobId) {
        self.cancelled.push(job);
        self.events.push((job, JobEvent::Cancelled));
    }

    fn hold(&mut self, job: JobId, is_held: bool) {
        self.held.push((job, is_held));
    }

    fn events(&mut self) -> Vec<(JobId, JobEvent)> {
        let events = std::mem::take(&mut self.events);
        let last = events.iter().filter(|(_, event)| event.is_last());
        self.over.extend(last.map(|(id, _)| *id));
        events
    }

    fn opened(&mut self) -> Vec<Vec<OpenedFile>> {
        std::mem::take(&mut self.opened)
    }

    fn ask_for_files(&mut self) {
        self.file_dialogs += 1;
    }

    fn save_file(&mut self, name: &str, bytes: &[u8]) {
        self.saved.push((name.into(), bytes.into()));
    }

    fn follow(&mut self, place: &str) -> Option<String> {
        if self.places.last().is_none_or(|last| last != place) {
            self.places.push(place.to_owned());
        }
        self.gone_back.take()
    }

    fn save_pixels(&mut self, name: &str, [width, height]: [u32; 2], pixels: &[u8]) {
        let picture = image::RgbaImage::from_raw(width, height, pixels.to_vec());
        let mut png = std::io::Cursor::new(Vec::new());
        picture
            .expect("four bytes for each pixel")
            .write_to(&mut png, image::ImageFormat::Png)
            .expect("memory can be written to");
        self.saved.push((name.into(), png.into_inner()));
    }

    fn start_film(&mut self) -> String {
        self.films.push("begun".into());
        "webm".into()
    }

    fn stop_film(&mut self, name: &str) {
        self.films.push(name.into());
    }

    fn save_picture(&mut self, name: &str, svg: &str, size: [u32; 2]) {
        self.pictures.push((name.into(), svg.into(), size));
    }

    fn store(&mut self, key: &str, bytes: &[u8]) {
        self.stored.insert(key.into(), bytes.into());
    }

    fn forget(&mut self, key: &str) {
        self.stored.remove(key);
    }

    fn recall(&self, key: &str) -> Option<Vec<u8>> {
        let is_first = self.recalled.borrow_mut().insert(key.to_owned());
        is_first.then(|| self.stored.get(key).cloned()).flatten()
    }

    fn copy_link(&mut self, fragment: &str) {
        self.link = fragment.into();
    }

    fn link_copied(&mut self) -> Option<bool> {
        self.link_copied
    }

    fn print(&mut self, style: &str, body: &str) {
        self.printed = Some((style.into(), body.into()));
    }

    fn fetch(&mut self, file: &str) {
        self.asked_files.push(file.into());
    }

    fn fetched(&mut self, file: &str) -> Option<Vec<u8>> {
        self.own_files.remove(file)
    }

    fn troubles(&mut self) -> Vec<(String, String)> {
        std::mem::take(&mut self.troubles)
    }

    fn failed_stores(&mut self) -> Vec<String> {
        std::mem::take(&mut self.refused)
    }

    fn interrupted_saves(&mut self) -> Vec<String> {
        std::mem::take(&mut self.interrupted)
    }

    fn lost_workers(&mut self) -> usize {
        std::mem::take(&mut self.lost)
    }
}
