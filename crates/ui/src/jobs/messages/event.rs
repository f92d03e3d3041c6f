//! What a worker says of a job.

use pilotage_core::alignment::CameraToLog;
use pilotage_core::flight::Flight;
use pilotage_core::flight::log::Outline;
use pilotage_core::frames::Geodetic;
use pilotage_core::imagery::Window;
use pilotage_core::imagery::terrain::HeightGrid;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Run, StepReport};
use pilotage_core::plan::{Candidate, Envelope, Localizability, Prediction, Suggestion, View};
use pilotage_core::raster::{Raster, Rgba};
use pilotage_core::registration::Draped;
use pilotage_core::study::Comparison;
use serde::{Deserialize, Serialize};

use super::{
    Assessment, BriefPictures, CutReport, DetectorSearch, Distinctness, EvaluationReport,
    FoundPlan, LogAnswer, LogSeries, MadeFlight, MapInfo, MatchPictures, Opened, PhotoReport,
    ReadLog, StudyReport, TrainingOutcome, TrainingReport, whole_bytes,
};

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
    /// Where a photo lies, or why it was not laid.
    PhotoLaid(Box<PhotoReport>),
    /// A laid photo on the map in its own colours.
    PhotoDraped(Box<Draped>),
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
        /// Whether nothing is missing of it; what is comes with [`super::Job::PrepareMap`].
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
