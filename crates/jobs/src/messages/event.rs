//! Events by which a worker reports on a job.

use pilotage_core::calibration::CameraToLog;
use pilotage_core::flight::Flight;
use pilotage_core::flight::log::LogOutline;
use pilotage_core::frames::Geodetic;
use pilotage_core::imagery::Window;
use pilotage_core::imagery::terrain::HeightGrid;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Run, StepReport};
use pilotage_core::plan::{
    Envelope, LandmarkCandidate, Localizability, RoutePrediction, Suggestion, UntestedDetection,
    ViewResult,
};
use pilotage_core::raster::{Raster, Rgba};
use pilotage_core::registration::Draped;
use pilotage_core::study::EstimatorComparison;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::{
    Assessment, BriefPictures, DetectorSearch, Distinctness, EncodedPicture, EvaluationReport,
    FoundPlan, LogAnswer, LogSeries, MadeFlight, MapInfo, MatchPictures, OpenedFiles, OutageReport,
    PhotoReport, ReadControlPoints, ReadLog, StudyReport, TrainingOutcome, TrainingReport,
    whole_bytes,
};

/// Event by which a worker reports on a job.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum JobEvent {
    /// Progress, 0 to 1, and the present activity in words.
    Progress(f32, String),
    /// The flight.
    Flight(Box<Flight>),
    /// Outline of a log, as far as it has been read.
    LogOutline(Box<LogOutline>),
    /// A log that was read.
    LogRead(Box<ReadLog>),
    /// A flight made of tables.
    FlightMade(Box<MadeFlight>),
    /// Samples of a series of a log.
    LogSeries(Box<LogSeries>),
    /// Something that was asked of a log.
    LogAnswer(Box<LogAnswer>),
    /// Result of an outage.
    OutageMade(Box<OutageReport>),
    /// Results of outages all along a flight.
    OutagesStudied(Box<StudyReport>),
    /// A camera in time and place beside its log.
    CameraCalibrated(Box<CameraToLog>),
    /// Place of a photo, or why it was not laid.
    PhotoRegistered(Box<PhotoReport>),
    /// A laid photo on the map in its own colours.
    PhotoDraped(Box<Draped>),
    /// Every estimator on one flight.
    ContestJudged(Box<EstimatorComparison>),
    /// Places of a smoothed run: time (seconds), north and east (metres) of each step.
    Smoothed(Vec<(f64, f64, f64)>),
    /// The mission that is flown.
    Mission(Box<Mission>),
    /// Why the flight cannot be navigated, after the flight and its mission; its pictures follow.
    CannotNavigate(String),
    /// The flight came without a mission: by what it is navigated and why, in a sentence.
    WithoutMission(String),
    /// The run's head, without steps.
    RunStarted(Box<Run>),
    /// More steps of the run.
    Steps(Vec<StepReport>),
    /// A camera picture was taken and can be asked for.
    FrameTaken {
        /// Index in the flight.
        index: usize,
        /// Digest of its encoded bytes, where they are here.
        digest: Option<u64>,
    },
    /// A camera picture as a file, JPEG or PNG.
    FrameEncoded {
        /// Index in the flight.
        index: usize,
        /// The file.
        encoded: EncodedPicture,
    },
    /// The pixels of a camera picture.
    FramePicture {
        /// Index in the flight.
        index: usize,
        /// Pixels in a row.
        width: usize,
        /// Red, green, blue and opacity of each pixel, row by row.
        #[serde(with = "whole_bytes")]
        pixels: Vec<u8>,
    },
    /// Description of a map.
    MapInfo(MapInfo),
    /// Pixels of a map.
    Tile {
        /// Part of the map.
        window: Window,
        /// Its pixels.
        pixels: Raster<Rgba>,
        /// Whether nothing is missing of it; what is comes with [`crate::PrepareMapOrder`].
        whole: bool,
    },
    /// Control points of a picture.
    ControlPoints(Box<ReadControlPoints>),
    /// Named places.
    Places(Vec<(String, Geodetic)>),
    /// The heights of an area.
    Heights(Box<HeightGrid>),
    /// Something people should know of the job's files, though it goes on.
    Remark(String),
    /// Distinctness of a box of the map.
    Distinctness(Box<Distinctness>),
    /// Pictures that explain a match.
    Match(Box<MatchPictures>),
    /// Evaluation of a trained detector, as far as it is known.
    Evaluation(Box<EvaluationReport>),
    /// Search of a trained detector in a past step.
    Detector(Box<DetectorSearch>),
    /// The uncertainty along a planned route.
    Prediction {
        /// The prediction.
        prediction: Box<RoutePrediction>,
        /// Computing time of the worker, milliseconds.
        computed: f64,
    },
    /// A share of the views of a landmark, each with the number of its look.
    Views(Vec<(usize, ViewResult)>),
    /// Assessment of a landmark.
    Assessment(Box<Assessment>),
    /// A landmark does not fit into a picture, which is why it cannot be assessed; `Failed` follows with the words.
    Misfit,
    /// Worth of a landmark of the map that nobody tested.
    Untested(Box<UntestedDetection>),
    /// From which heights and with which tilts a landmark is found, as far as it is known.
    Envelope(Box<Envelope>),
    /// A landmark has nothing by which a detector could be trained, whoever tries; `Failed` follows with the same words.
    Untrainable(String),
    /// Progress of the training of a detector.
    Training(Box<TrainingReport>),
    /// A detector is trained.
    Trained(Box<TrainingOutcome>),
    /// Places of a share, by its number, that passed a rehearsal, in its order.
    Candidates(usize, Vec<LandmarkCandidate>),
    /// Landmarks that are proposed, the one that gains most first.
    Suggestions(Vec<Suggestion>),
    /// Field of the probability of a fix, as far as it is known.
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
        /// Part of the mission's map that is not in the file and where to have it, in words.
        lacks: Option<String>,
    },
    /// A file of another program.
    Exported {
        /// The file.
        #[serde(with = "whole_bytes")]
        bytes: Vec<u8>,
        /// Assumptions and omissions, in sentences.
        notes: Vec<String>,
    },
    /// Contents of provided files.
    Opened(Box<OpenedFiles>),
    /// Figures of a result as the worker wrote them: who asked knows their type and reads them by
    /// [`JobEvent::read_figures`], so that only that program links it.
    Figures(#[serde(with = "whole_bytes")] Vec<u8>),
    /// Done.
    Finished,
    /// Stopped as asked.
    Cancelled,
    /// Impossible; the text names the file, the place, and what to do.
    Failed(String),
}

impl JobEvent {
    /// Event with these figures.
    ///
    /// ```
    /// use pilotage_jobs::JobEvent;
    ///
    /// let told = JobEvent::of_figures(&(3_u32, 0.5))?;
    /// assert_eq!(told.read_figures::<(u32, f64)>()?, (3, 0.5));
    /// assert!(JobEvent::Finished.read_figures::<u32>().is_err());
    /// # Ok::<(), String>(())
    /// ```
    ///
    /// # Errors
    /// If they cannot be written, in words.
    pub fn of_figures(figures: &impl Serialize) -> Result<Self, String> {
        let bytes = postcard::to_stdvec(figures).map_err(|cause| cause.to_string())?;
        Ok(Self::Figures(bytes))
    }

    /// Figures of the type that was asked for.
    ///
    /// # Errors
    /// If the event has none of that type, in words.
    pub fn read_figures<T: DeserializeOwned>(&self) -> Result<T, String> {
        let Self::Figures(bytes) = self else {
            return Err("the job told something else than figures".to_owned());
        };
        postcard::from_bytes(bytes).map_err(|cause| cause.to_string())
    }

    /// Whether nothing more comes of a job after this.
    pub fn is_last(&self) -> bool {
        matches!(self, Self::Finished | Self::Cancelled | Self::Failed(_))
    }
}
