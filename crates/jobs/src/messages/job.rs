//! Something to do in a worker.

use std::sync::Arc;

use pilotage_core::frames::{Geodetic, GroundRect};
use pilotage_core::imagery::Window;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::StepReport;
use pilotage_core::plan::{Candidate, View};
use serde::{Deserialize, Serialize};

use super::{
    AlignOrder, AssessmentOrder, BriefOrder, ContestOrder, CutOrder, DrapeOrder, EvaluationOrder,
    ExplainedBy, ExportOrder, FieldOrder, FileContent, FindOrder, FlightSource, HeightsOrder,
    LogOrder, MapSource, PackOrder, PhotosOrder, PredictionOrder, SeriesName, Share, SuggestOrder,
    TrainOrder, whole_bytes,
};

/// Number of a job, unique within a page.
pub type JobId = u64;

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
        /// Name of the series.
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
    /// Lay photos on a map one by one: events `PhotoLaid`.
    LayPhotos(Box<PhotosOrder>),
    /// Show a laid photo on the map in its own colours: event `PhotoDraped`.
    DrapePhoto(Box<DrapeOrder>),
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
        /// Part of the map, and its scale.
        window: Window,
    },
    /// Measure the distinctness of a box of the map: event `Distinctness`.
    Distinctness {
        /// The map.
        map: MapSource,
        /// The box.
        bounds: GroundRect,
        /// Distance around the box within which to look for look-alikes, metres.
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
    /// Evaluate a trained detector where it was not trained: events `Evaluation`, each knowing more.
    Evaluate(Box<EvaluationOrder>),
    /// The pixels of a camera picture: event `Picture`.
    DecodePicture {
        /// JPEG or PNG bytes.
        #[serde(with = "whole_bytes")]
        encoded: Arc<[u8]>,
    },
    /// The uncertainty along a planned route: event `Prediction`.
    Predict(Box<PredictionOrder>),
    /// Assess a landmark on other days: event `Assessment`.
    Assess(Box<AssessmentOrder>),
    /// A share of that: event `Views`.
    AssessShare(Box<AssessmentOrder>, Share),
    /// Sum up all views of a landmark: event `Assessment`.
    SumUp(Box<AssessmentOrder>, Vec<View>),
    /// From which heights and with which tilts a landmark is found: events `Envelope`, each knowing more.
    Envelope(Box<AssessmentOrder>),
    /// A detector trained for a landmark: events `Training`, at the end `Trained`.
    Train(Box<TrainOrder>),
    /// Landmarks proposed for a route: event `Suggestions`.
    Suggest(Box<SuggestOrder>),
    /// A share of the places rehearsed for that: event `Candidates`.
    SuggestShare(Box<SuggestOrder>, Share),
    /// Choose the landmarks to propose among all places that passed: event `Suggestions`.
    Propose(Box<SuggestOrder>, Vec<Candidate>),
    /// Compute the field of the probability of a fix: events `Field`, each knowing more.
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
