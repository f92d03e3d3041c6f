//! Heavy work as messages: what to do, what came of it. Runs in a worker.
//!
//! A [`Job`] becomes a [`RunningJob`] that advances in slices, so that a worker stays able to
//! listen; a [`JobRunner`] holds the jobs of one worker; a [`Crew`] shares jobs out among workers
//! and replaces one that died; [`InlineHost`] does all of it on the calling thread, for tests.

mod align;
mod assess;
mod beside;
mod brief;
mod content;
mod contest;
mod crew;
mod distinct;
mod envelope;
mod evaluate;
mod explain;
mod export;
mod field;
mod file_pool;
mod find;
mod flights;
mod fly;
mod heights;
mod imports;
mod inline;
mod log_answers;
mod log_series;
mod logs;
mod messages;
mod opening;
mod pack;
mod places;
mod predict;
mod prelude;
mod prepare;
mod programs;
mod protocol;
mod reckon;
mod runner;
mod running;
mod shared;
mod simulated;
mod suggest;
mod tables;
mod train;
mod web_map;
mod whole_bytes;
mod workshop;

pub use align::AlignOrder;
pub use assess::{Assessment, AssessmentOrder, Glance, Share};
pub use beside::{BESIDE, Beside};
pub use brief::{BriefOrder, BriefPictures, EncodedPicture};
pub use content::{FileContent, LentFiles, OpenAddress};
pub use contest::ContestOrder;
pub use crew::{Crew, WorkerPort};
pub use evaluate::{EvaluationOrder, EvaluationReport};
pub use export::ExportOrder;
pub use field::{FieldFrom, FieldOrder};
pub use file_pool::has_ending;
pub use find::{FindOrder, Foreseen, FoundPlan, HighGround};
pub use heights::{HeightsOrder, TerrainInfo};
pub use imports::ImportedFile;
pub use inline::InlineHost;
pub use log_answers::{LogAnswer, LogOrder, LogQuestion};
pub use log_series::{LogSeries, SeriesName};
pub use logs::ReadLog;
pub use messages::{Reply, Request};
pub use pack::PackOrder;
pub use predict::{COARSE, PredictionOrder};
pub use prelude::{FirstMap, FirstSeconds, Prelude};
pub use programs::{Abilities, Program};
pub use protocol::{
    DetectorSearch, Distinctness, ExplainedBy, FlightSource, Job, JobEvent, JobId, MapInfo,
    MapSource, MatchPictures, Opened, SimulationOptions, Unplaced,
};
pub use reckon::{AidedResult, Cut, CutOrder, CutReport, StudyReport, WindReport};
pub use runner::JobRunner;
pub use running::{Advance, RunningJob};
pub use simulated::{scenario_route, scenario_wind};
pub use suggest::SuggestOrder;
pub use tables::{COLUMNS_FILE, MadeFlight, write_columns};
pub use train::{LabelledFrames, TrainOrder, TrainingLeft, TrainingOutcome, TrainingReport};
pub use web_map::{WEB_TILES, WebMap, wanted_addresses};
pub use workshop::Workshop;
