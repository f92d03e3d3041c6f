//! Heavy work as messages: what to do, what came of it. Runs in a worker.
//!
//! A [`Job`] becomes a [`RunningJob`] that advances in slices, so that a worker stays able to
//! listen; a [`JobRunner`] holds the jobs of one worker; a [`WorkerPool`] shares jobs out among workers
//! and replaces one that died; [`InlineWorkers`] does all of it on the calling thread, for tests.

#[macro_use]
mod job;

mod bare_mission;
mod brief;
mod calibrate;
mod circumstances;
mod contest;
mod control_points;
mod evaluate;
mod export;
mod far_away;
mod fetched_tiles;
mod field;
mod file_pool;
mod find;
mod find_among_roads;
mod flight_among;
mod flights;
mod frame_picture;
mod heights;
mod imports;
mod inline;
mod lent;
mod log_answers;
mod log_flights;
mod map_view;
mod messages;
mod open;
mod opening;
mod order;
mod outage;
mod pack;
mod passage;
mod photo_picture;
mod photo_places;
mod photos;
mod places;
mod predict;
mod prelude;
mod programs;
mod provided;
mod read_study_plan;
mod reference_map;
mod rehearse;
mod reliability;
mod road_files;
mod road_flight;
mod road_view;
mod roads_lost;
mod runner;
mod running;
mod samples;
mod sensitivity;
mod share;
mod shared;
mod simulated;
mod studied;
mod study_shard;
mod summary;
mod table_names;
mod tables;
mod train;
mod vehicle;
mod wanted_tiles;
mod worker_pool;
mod worker_state;

pub use bare_mission::BareMission;
pub use circumstances::PlanCircumstances;
pub use control_points::{PresumedSystem, ReadControlPointsOrder};
pub use fetched_tiles::WEB_TILES;
pub use find_among_roads::{
    BELIEVED_AMONG_ROADS, FindAmongRoadsOrder, FoundAmongRoads, PlaceAmongRoads, PlaceVerdict,
    SoughtPicture,
};
pub use flight_among::{
    FLOWN, FlownFiles, flight_among, flight_of_file, flown_in_words, with_films_told,
};
pub use flights::{KeptFrames, OpenFlight};
pub use frame_picture::{FramePictureOrder, PictureForm};
pub use imports::{labels, read_exchange};
pub use inline::InlineWorkers;
pub use lent::{LentFiles, OpenAddress};
pub use log_flights::{LogGlance, foreign_kind, glance_at_folder, log_among, open_log};
pub use map_view::{DescribeMapOrder, TileOrder};
pub use messages::{
    AidedResult, Assessment, AssessmentOrder, BESIDE, Beside, BriefOrder, BriefPictures, COARSE,
    CalibrationOrder, ContestOrder, DetectorSearch, Distinctness, DrapeOrder, EncodedPicture,
    EvaluationOrder, EvaluationReport, ExplainedBy, ExportOrder, FINE, FieldFrom, FieldOrder,
    FileContent, FindOrder, FixesFrom, FlightSource, FlownCamera, Foreseen, FoundPlan, Glance,
    HeightsOrder, HighGround, ImportedFile, JobEvent, JobId, JudgedDetector, KeptMeasurement,
    LabelledFrames, LogAnswer, LogOrder, LogQuestion, LogSeries, MadeFlight, MapInfo, MapSource,
    MatchPictures, MeasuredLandmark, MeasurementBasis, OpenedFiles, Outage, OutageOrder,
    OutageReport, PackOrder, PhotoReport, PhotosOrder, PlannedPath, PredictionOrder,
    ReadControlPoints, ReadLog, RecordedPlaces, RehearsedFlight, Reply, Request, RouteWishes,
    SeriesName, Share, SimulationOptions, StudiedFlight, StudyReport, SuggestOrder, TerrainInfo,
    TrackSeries, TrainOrder, TrainingLeft, TrainingOutcome, TrainingReport, Unplaced, WebMap,
    WindReport,
};
pub use open::{OpenOrder, ReadPlacesOrder};
pub use opening::{map as map_among, mission_beside_flight};
pub use order::{Order, Reads, Urgency, VariantOrder, WorkerRole};
pub use photo_picture::decode_photo;
pub use photo_places::{PlacesBesidePhotos, places_of_photos};
pub use prelude::{FirstMap, FirstSeconds, Prelude};
pub use programs::{Abilities, Begin, Program};
pub use provided::{LetGoOrder, ProvideOrder};
pub use read_study_plan::{ReadStudyPlan, ReadStudyPlanOrder};
pub use reference_map::ReferenceMapOrder;
pub use rehearse::{RehearseOrder, Rehearsed, fly_planned};
pub use reliability::ReliabilityOrder;
pub use road_files::{left_out_of_roads, roads_in_world, without_roads};
pub use road_flight::{RoadFlight, RoadFlightOrder};
pub use road_view::road_view;
pub use roads_lost::RoadsLostOrder;
pub use runner::JobRunner;
pub use samples::{samples as log_samples, values_along};
pub use sensitivity::SensitivityOrder;
pub use share::{ShareOrder, Shareable};
pub use simulated::scenario_wind;
pub use study_shard::StudyShardOrder;
pub use summary::SummaryOrder;
pub use table_names::{TABLES, is_text_table, table_names};
pub use tables::{
    COLUMNS_FILE, MakeFlightOrder, StatedColumns, columns_file, maps_beside, write_columns,
};
pub use vehicle::{VEHICLE_FILE, choose_vehicle, write_vehicle};
pub use wanted_tiles::wanted_addresses;
pub use worker_pool::{WorkerPool, WorkerPort};
pub use worker_state::{Advance, Elsewhere, Opens, RunningJob, WorkerState};

pub use follow_road::FollowedRoad;

// All orders: another one is a file of this folder with its type, and a line here.
orders! {
    small {
        LetGo(LetGoOrder);
        DescribeMap(DescribeMapOrder);
        Tile(TileOrder);
        Fly: pub use fly::FlyOrder;
        Distinctness: pub use distinct::DistinctnessOrder;
        ExplainMatch: pub use explain::ExplainOrder;
        FramePicture(FramePictureOrder);
        Predict(Box<PredictionOrder>);
        Rehearse(Box<RehearseOrder>);
    }
    whole {
        Provide(ProvideOrder);
        Open(OpenOrder);
        ReadPlaces(ReadPlacesOrder);
        ReadControlPoints(ReadControlPointsOrder);
        PrepareMap: pub use prepare::PrepareMapOrder;
        TakeHeights(Box<HeightsOrder>);
        ReadLog: pub use logs::ReadLogOrder;
        MakeFlight(MakeFlightOrder);
        LogSeries: pub use log_series::SeriesOrder;
        AskLog(Box<LogOrder>);
        Outage(Box<OutageOrder>);
        Contest(Box<ContestOrder>);
        Smooth: pub use smooth::SmoothOrder;
        Calibrate(Box<CalibrationOrder>);
        LayPhotos(Box<PhotosOrder>);
        DrapePhoto(Box<DrapeOrder>);
        Evaluate(Box<EvaluationOrder>);
        Assess(Box<AssessmentOrder>);
        AssessShare(ShareOrder<AssessmentOrder>);
        SumUp: pub use assess::SumUpOrder;
        AssessAhead: pub use assess_ahead::AssessAheadOrder;
        Untested: pub use untested::UntestedOrder;
        Envelope: pub use envelope::EnvelopeOrder;
        Train(Box<TrainOrder>);
        Suggest(Box<SuggestOrder>);
        SuggestShare(ShareOrder<SuggestOrder>);
        Propose: pub use suggest::ProposeOrder;
        Field(Box<FieldOrder>);
        Find(Box<FindOrder>);
        FindAmongRoads(Box<FindAmongRoadsOrder>);
        Brief(BriefOrder);
        Pack(Box<PackOrder>);
        Export(Box<ExportOrder>);
        ReadStudyPlan(ReadStudyPlanOrder);
        StudyEnough: pub use study_enough::StudyEnoughOrder;
        StudyFlights: pub use study_flights::StudyFlightsOrder;
        FollowRoad: pub use follow_road::FollowRoadOrder;
    }
}
