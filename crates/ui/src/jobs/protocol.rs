//! The messages between page and worker; both ends are this program, encoded with postcard.

use std::sync::Arc;

use pilotage_core::alignment::CameraToLog;
use pilotage_core::exchange::labels::FoundLabels;
use pilotage_core::flight::Flight;
use pilotage_core::flight::columns::GuessedTable;
use pilotage_core::flight::log::Outline;
use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect};
use pilotage_core::imagery::terrain::HeightGrid;
use pilotage_core::imagery::{Georeference, Window};
use pilotage_core::landmark::CascadeEvidence;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Run, StepReport};
use pilotage_core::plan::{Candidate, Envelope, Localizability, Prediction, Suggestion, View};
use pilotage_core::raster::{Gray, Raster, Rgba};
use pilotage_core::simulate::IndoorHall;
use pilotage_core::study::Comparison;
use serde::{Deserialize, Serialize};

use super::{
    AlignOrder, Assessment, AssessmentOrder, Beside, BriefOrder, BriefPictures, ContestOrder,
    CutOrder, CutReport, EvaluationOrder, EvaluationReport, ExportOrder, FieldOrder, FileContent,
    FindOrder, FoundPlan, HeightsOrder, ImportedFile, LogAnswer, LogOrder, LogSeries, MadeFlight,
    PackOrder, PredictionOrder, ReadLog, SeriesName, Share, StudyReport, SuggestOrder, TerrainInfo,
    TrainOrder, TrainingOutcome, TrainingReport, WebMap, whole_bytes,
};

/// Number of a job, unique within a page.
pub type JobId = u64;

/// What the user may change about a built-in scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SimulationOptions {
    /// Scenario name.
    pub scenario: String,
    /// Seed of all noise.
    pub seed: u64,
    /// Whether the camera sees another day than the map.
    pub other_day: bool,
    /// Direction the wind comes from, radians, and its speed, m/s; the scenario's own if `None`.
    pub wind: Option<(f64, f64)>,
    /// Height above ground, metres; the scenario's own if `None`.
    pub height: Option<f64>,
}

impl SimulationOptions {
    /// Whether it is the flight in the hall.
    pub fn is_indoors(&self) -> bool {
        self.scenario == IndoorHall::NAME
    }

    /// The map that it is flown by.
    pub fn map(&self) -> MapSource {
        if self.is_indoors() {
            MapSource::Hall
        } else {
            MapSource::Scenery
        }
    }
}

/// Where a map comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MapSource {
    /// The generated scenery that the built-in scenarios use as their map.
    Scenery,
    /// Files that the page gave to the worker under this key (see [`Job::Provide`]).
    Files(String),
    /// The map among files of this key, put into the world frame around an origin.
    Placed {
        /// Key of the files.
        key: String,
        /// Origin of the world frame.
        origin: Geodetic,
    },
    /// A picture among files of this key whose place is known better than by the files.
    Picture {
        /// Key of the files.
        key: String,
        /// The picture.
        name: String,
        /// Origin of the world frame; its own if `None`.
        origin: Option<Geodetic>,
        /// Where its pixels lie.
        place: Georeference,
    },
    /// Tiles of the web.
    Web(WebMap),
    /// No map.
    Nothing,
    /// The drawing of the floor of the hall.
    Hall,
}

impl MapSource {
    /// Key of the files that it is made from, if it is.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Scenery | Self::Hall | Self::Web(_) | Self::Nothing => None,
            Self::Files(key) | Self::Placed { key, .. } | Self::Picture { key, .. } => Some(key),
        }
    }

    /// Origin of the world frame it was put into, if one was given.
    pub fn origin(&self) -> Option<Geodetic> {
        match self {
            Self::Placed { origin, .. } => Some(*origin),
            Self::Picture { origin, .. } => *origin,
            Self::Web(map) => Some(map.origin),
            Self::Scenery | Self::Hall | Self::Files(_) | Self::Nothing => None,
        }
    }

    /// The same map in the world around another origin, if it can be put there.
    #[must_use]
    pub fn moved(&self, to: Geodetic) -> Self {
        let mut moved = self.clone();
        match &mut moved {
            Self::Placed { origin, .. } => *origin = to,
            Self::Picture { origin, .. } => *origin = Some(to),
            Self::Web(map) => map.origin = to,
            Self::Scenery | Self::Hall | Self::Files(_) | Self::Nothing => {}
        }
        moved
    }
}

/// Where a flight comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FlightSource {
    /// A simulated flight.
    Simulated(SimulationOptions),
    /// Files that the page gave to the worker under this key.
    Files(String),
    /// Nothing is flown.
    Nothing,
}

/// Something to do in a worker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Job {
    /// Keep these files under a key; sent to every worker, again after a restart.
    Provide {
        /// Key that later jobs name.
        key: String,
        /// Path and content of each.
        files: Vec<(String, FileContent)>,
    },
    /// Let go of provided files and what was made of them, once nothing else is to be done.
    LetGo {
        /// Keys of the files that stay.
        keys: Vec<String>,
    },
    /// Say what provided files are: events `Opened`, or `Failed`.
    Open {
        /// Key of the files.
        key: String,
        /// Origin of the world frame that is open; a map far from it gets a frame of its own.
        near: Option<Geodetic>,
        /// Origin of the mission's world, in which routes and landmarks are placed.
        origin: Geodetic,
    },
    /// Read the flight log `file` among provided files, or else the tables or photos of a flight, which are one as well
    /// and called by what they are kept under: events `LogOutline` as it grows, at the end
    /// `LogRead`. Kept by the worker for [`Job::LogSeries`] and [`Job::Fly`].
    ReadLog {
        /// Key of the files.
        key: String,
        /// Its name among them.
        file: String,
    },
    /// Make the flight of tables among provided files by the maps beside them: events `FlightMade`. Kept by the
    /// worker for [`Job::Fly`].
    MakeFlight {
        /// Key of the files.
        key: String,
    },
    /// A series of a log that is being read or was: events `LogSeries`, each with some of its samples.
    LogSeries {
        /// Key of the files.
        key: String,
        /// Name of the log among them.
        file: String,
        /// Which series.
        series: SeriesName,
    },
    /// Figures or a table of series of a log that was read: events `LogAnswer`.
    AskLog(Box<LogOrder>),
    /// Fly and navigate: events `Flight`, `Mission` (if none was given), `RunStarted`, then `Steps` and `FramePicture`;
    /// or `CannotNavigate` in the place of `RunStarted` and `Steps`.
    Fly {
        /// The flight.
        flight: FlightSource,
        /// The map.
        map: MapSource,
        /// The mission; the scenario's own if `None`.
        mission: Option<Mission>,
    },
    /// Cut satellite navigation out of a flight: events `CutMade` or `CutsStudied`.
    Cut(Box<CutOrder>),
    /// Fly a flight by every estimator: event `ContestJudged`.
    Contest(Box<ContestOrder>),
    /// Put a camera in time and place beside its log: event `CameraAligned`.
    Align(Box<AlignOrder>),
    /// Describe a map: event `MapInfo`.
    DescribeMap(MapSource),
    /// The named places in a file of routes and landmarks: event `Places`.
    ReadPlaces {
        /// Key of the files.
        key: String,
    },
    /// Make what wide views of a large map need: events `Progress`.
    PrepareMap(MapSource),
    /// The heights of an area: event `Heights`.
    TakeHeights(Box<HeightsOrder>),
    /// Pixels of a map: event `Tile`.
    Tile {
        /// The map.
        map: MapSource,
        /// Which part at which scale.
        window: Window,
    },
    /// How distinct a box of the map is: event `Distinctness`.
    Distinctness {
        /// The map.
        map: MapSource,
        /// The box.
        bounds: GroundRect,
        /// How far around it to look for look-alikes, metres.
        radius: f64,
    },
    /// Pictures that explain a match: event `Match`, or `Detector` of one by a trained detector.
    ExplainMatch {
        /// By what the landmark is looked for.
        by: ExplainedBy,
        /// The flight.
        flight: FlightSource,
        /// The map.
        map: MapSource,
        /// The mission.
        mission: Mission,
        /// The step whose frame is meant.
        step: Box<StepReport>,
        /// The landmark.
        landmark: u32,
    },
    /// How well a trained detector does where it was not trained: events `Evaluation`, each knowing more.
    Evaluate(Box<EvaluationOrder>),
    /// The pixels of a camera picture: event `Picture`.
    DecodePicture {
        /// JPEG or PNG bytes.
        #[serde(with = "whole_bytes")]
        encoded: Arc<[u8]>,
    },
    /// The uncertainty along a planned route: event `Prediction`.
    Predict(Box<PredictionOrder>),
    /// How well a landmark is found on other days: event `Assessment`.
    Assess(Box<AssessmentOrder>),
    /// A share of that: event `Views`.
    AssessShare(Box<AssessmentOrder>, Share),
    /// What all its views come to: event `Assessment`.
    SumUp(Box<AssessmentOrder>, Vec<View>),
    /// From which heights and with which tilts a landmark is found: events `Envelope`, each knowing more.
    Envelope(Box<AssessmentOrder>),
    /// A detector trained for a landmark: events `Training`, at the end `Trained`.
    Train(Box<TrainOrder>),
    /// Landmarks proposed for a route: event `Suggestions`.
    Suggest(Box<SuggestOrder>),
    /// A share of the places rehearsed for that: event `Candidates`.
    SuggestShare(Box<SuggestOrder>, Share),
    /// What is proposed of all that passed: event `Suggestions`.
    Propose(Box<SuggestOrder>, Vec<Candidate>),
    /// Where a fix would be had: events `Field`, each knowing more.
    Field(Box<FieldOrder>),
    /// A route over ground where fixes are had: event `FoundPlan`.
    Find(Box<FindOrder>),
    /// The pictures of a mission brief: event `BriefPictures`.
    Brief(BriefOrder),
    /// A mission file: event `Packed`.
    Pack(Box<PackOrder>),
    /// Routes or landmarks as a file of another program: event `Exported`.
    Export(Box<ExportOrder>),
}

/// A picture that does not say where it lies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unplaced {
    /// Its name among the files.
    pub name: String,
    /// A file of control points beside it: name and text.
    pub points: Option<(String, String)>,
}

/// What is known of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapInfo {
    /// Name for people.
    pub name: String,
    /// The ground that has pixels.
    pub bounds: GroundRect,
    /// Finest ground sample distance, metres per pixel.
    pub native_gsd: f64,
    /// Whether a coarser window of the same ground costs less than a fine one.
    pub is_coarse_cheap: bool,
    /// Origin of the world frame it lies in, if it has a place on the globe.
    pub origin: Option<Geodetic>,
    /// Who made it, where the map says so itself.
    pub attribution: Option<String>,
}

/// How distinct a box of the map is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distinctness {
    /// The box.
    pub bounds: GroundRect,
    /// Correlation of the box with the map around it.
    pub surface: Gray,
    /// Ground that the surface covers.
    pub surface_rect: GroundRect,
    /// How far around it look-alikes were looked for, metres.
    pub radius: f64,
    /// Centre of the strongest look-alike, and its score.
    pub look_alike: Option<(GroundPoint, f64)>,
    /// Standard deviation of the patch's grey values, 0 to 255.
    pub contrast: f64,
    /// Whether the detector would refuse the patch as flat.
    pub flat: bool,
    /// One sentence for people.
    pub verdict: String,
}

/// Pictures that explain a match.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MatchPictures {
    /// Time of the step.
    pub time: f64,
    /// The landmark.
    pub landmark: u32,
    /// The map patch.
    pub patch: Gray,
    /// The camera picture rectified to a north-up ground view over the search region.
    pub rectified: Gray,
    /// Score at every offset of the patch in the rectified picture.
    pub surface: Gray,
    /// Best offset (column, row) in `surface`, sub-pixel.
    pub peak: Option<(f64, f64)>,
    /// Second-best offset.
    pub second: Option<(f64, f64)>,
    /// Metres per pixel of all three.
    pub gsd: f64,
}

/// By what a landmark is looked for when a match is explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ExplainedBy {
    /// By its map patch.
    Template,
    /// By the detector that was trained for it.
    Cascade,
}

/// What a trained detector saw and did in a past step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DetectorSearch {
    /// Time of the step, seconds in the flight's time base.
    pub time: f64,
    /// The landmark.
    pub landmark: u32,
    /// What it saw and did, or why that cannot be told.
    pub found: Result<CascadeEvidence, String>,
}

/// What provided files turned out to be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opened {
    /// Key of the files.
    pub key: String,
    /// A flight, if there is one.
    pub flight: Option<Flight>,
    /// Name of a flight log that is to be read, if there is one.
    pub log: Option<String>,
    /// A map, if there is one.
    pub map: Option<MapInfo>,
    /// An elevation model, if there is one.
    pub terrain: Option<TerrainInfo>,
    /// A mission, if there is one.
    pub mission: Option<Mission>,
    /// A saved run, if there is one.
    pub run: Option<Run>,
    /// A picture that does not say where it lies, if there is nothing else.
    pub unplaced: Option<Unplaced>,
    /// Routes and landmarks of other programs, to be added to the mission.
    pub imports: Vec<ImportedFile>,
    /// Tables of a flight, if it is to be asked what their columns mean.
    pub tables: Vec<GuessedTable>,
    /// Labels of pictures, to be added to the mission.
    pub labels: Option<FoundLabels>,
    /// What was open beside the mission when it was saved.
    pub beside: Option<Beside>,
    /// What was skipped, in words.
    pub remarks: Vec<String>,
}

/// What a worker says of a job.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum JobEvent {
    /// How far it is, 0 to 1, and what it is doing.
    Progress(f32, String),
    /// The flight.
    Flight(Box<Flight>),
    /// What a log holds, as far as it has been read.
    LogOutline(Box<Outline>),
    /// A log that was read.
    LogRead(Box<ReadLog>),
    /// A flight made of tables.
    FlightMade(Box<MadeFlight>),
    /// Samples of a series of a log.
    LogSeries(Box<LogSeries>),
    /// Something that was asked of a log.
    LogAnswer(Box<LogAnswer>),
    /// What came of a cut.
    CutMade(Box<CutReport>),
    /// What came of cuts all along a flight.
    CutsStudied(Box<StudyReport>),
    /// A camera in time and place beside its log.
    CameraAligned(Box<CameraToLog>),
    /// Every estimator on one flight.
    ContestJudged(Box<Comparison>),
    /// The mission that is flown.
    Mission(Box<Mission>),
    /// Why the flight cannot be navigated, after the flight and its mission; its pictures follow.
    CannotNavigate(String),
    /// The run's head, without steps.
    RunStarted(Box<Run>),
    /// More steps of the run.
    Steps(Vec<StepReport>),
    /// A camera picture, encoded.
    FramePicture {
        /// Index in the flight.
        index: usize,
        /// JPEG or PNG bytes.
        #[serde(with = "whole_bytes")]
        encoded: Vec<u8>,
    },
    /// The pixels of a camera picture.
    Picture {
        /// Pixels in a row.
        width: usize,
        /// Red, green, blue and opacity of each pixel, row by row.
        #[serde(with = "whole_bytes")]
        pixels: Vec<u8>,
    },
    /// What is known of a map.
    MapInfo(MapInfo),
    /// Pixels of a map.
    Tile {
        /// Which part.
        window: Window,
        /// Its pixels.
        pixels: Raster<Rgba>,
        /// Whether nothing is missing of it; what is comes with [`Job::PrepareMap`].
        whole: bool,
    },
    /// Named places.
    Places(Vec<(String, Geodetic)>),
    /// The heights of an area.
    Heights(Box<HeightGrid>),
    /// Something people should know of the job's files, though it goes on.
    Remark(String),
    /// How distinct a box is.
    Distinctness(Box<Distinctness>),
    /// Pictures that explain a match.
    Match(Box<MatchPictures>),
    /// How well a trained detector does, as far as it is known.
    Evaluation(Box<EvaluationReport>),
    /// What a trained detector saw and did.
    Detector(Box<DetectorSearch>),
    /// The uncertainty along a planned route.
    Prediction {
        /// The prediction.
        prediction: Box<Prediction>,
        /// How long the worker computed, milliseconds.
        computed: f64,
    },
    /// A share of the views of a landmark, each with the number of its look.
    Views(Vec<(usize, View)>),
    /// How well a landmark is found.
    Assessment(Box<Assessment>),
    /// From which heights and with which tilts a landmark is found, as far as it is known.
    Envelope(Box<Envelope>),
    /// Where the training of a detector stands.
    Training(Box<TrainingReport>),
    /// A detector is trained.
    Trained(Box<TrainingOutcome>),
    /// Places of a share, by its number, that passed a rehearsal, in its order.
    Candidates(usize, Vec<Candidate>),
    /// Landmarks that are proposed, the one that gains most first.
    Suggestions(Vec<Suggestion>),
    /// Where a fix would be had, as far as it is known.
    Field(Box<Localizability>),
    /// A route that was found, beside the shortest.
    FoundPlan(Box<FoundPlan>),
    /// The pictures of a mission brief.
    BriefPictures(Box<BriefPictures>),
    /// A mission file.
    Packed {
        /// The zip.
        #[serde(with = "whole_bytes")]
        bytes: Vec<u8>,
        /// What of its map is not in it and where to have it, in words.
        lacks: Option<String>,
    },
    /// A file of another program.
    Exported {
        /// The file.
        #[serde(with = "whole_bytes")]
        bytes: Vec<u8>,
        /// What was assumed or left out, in sentences.
        notes: Vec<String>,
    },
    /// What provided files are.
    Opened(Box<Opened>),
    /// Done.
    Finished,
    /// Stopped as asked.
    Cancelled,
    /// Impossible; the text names the file, the place, and what to do.
    Failed(String),
}

impl JobEvent {
    /// Whether nothing more comes of a job after this.
    pub fn is_last(&self) -> bool {
        matches!(self, Self::Finished | Self::Cancelled | Self::Failed(_))
    }
}
