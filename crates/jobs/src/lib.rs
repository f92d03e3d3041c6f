//! Heavy work as messages: what to do, what came of it. Runs in a worker.
//!
//! A [`Job`] becomes a [`RunningJob`] that advances in slices, so that a worker stays able to
//! listen; a [`JobRunner`] holds the jobs of one worker; a [`Crew`] shares jobs out among workers
//! and replaces one that died; [`InlineHost`] does all of it on the calling thread, for tests.

mod align;
mod assess;
mod brief;
mod contest;
mod crew;
mod distinct;
mod envelope;
mod evaluate;
mod explain;
mod export;
mod fetched_tiles;
mod field;
mod file_pool;
mod find;
mod flights;
mod fly;
mod heights;
mod imports;
mod inline;
mod lent;
mod log_answers;
mod log_flights;
mod log_series;
mod logs;
mod messages;
mod opening;
mod pack;
mod photos;
mod places;
mod predict;
mod prelude;
mod prepare;
mod programs;
mod reckon;
mod runner;
mod running;
mod samples;
mod shared;
mod simulated;
mod suggest;
mod tables;
mod train;
mod vehicle;
mod wanted_tiles;
mod workshop;

pub use crew::{Crew, WorkerPort};
pub use fetched_tiles::WEB_TILES;
pub use file_pool::has_ending;
pub use inline::InlineWorkers;
pub use lent::{LentFiles, OpenAddress};
pub use messages::{
    AidedResult, AlignOrder, Assessment, AssessmentOrder, BESIDE, Basis, Beside, BriefOrder,
    BriefPictures, COARSE, ContestOrder, Cut, CutOrder, CutReport, DetectorSearch, Distinctness,
    DrapeOrder, EncodedPicture, EvaluationOrder, EvaluationReport, ExplainedBy, ExportOrder,
    FieldFrom, FieldOrder, FileContent, FindOrder, FlightSource, Foreseen, FoundPlan, Glance,
    HeightsOrder, HighGround, ImportedFile, Job, JobEvent, JobId, KeptMeasurement, LabelledFrames,
    LogAnswer, LogOrder, LogQuestion, LogSeries, MadeFlight, MapInfo, MapSource, MatchPictures,
    Measured, Opened, PackOrder, PhotoReport, PhotosOrder, PredictionOrder, ReadLog,
    RecordedPlaces, Reply, Request, SeriesName, Share, SimulationOptions, StudyReport,
    SuggestOrder, TerrainInfo, TrainOrder, TrainingLeft, TrainingOutcome, TrainingReport, Unplaced,
    WebMap, WindReport,
};
pub use prelude::{FirstMap, FirstSeconds, Prelude};
pub use programs::Program;
pub use runner::JobRunner;
pub use simulated::{scenario_route, scenario_wind};
pub use tables::{COLUMNS_FILE, write_columns};
pub use vehicle::{VEHICLE_FILE, write_vehicle};
pub use wanted_tiles::wanted_addresses;
pub use workshop::{Abilities, Advance, RunningJob, Workshop};
