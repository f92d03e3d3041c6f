//! All orders. A new one is a file with its type, and a line in the list below.

use serde::{Deserialize, Serialize};

use super::assess::SumUpOrder;
use super::assess_ahead::AssessAheadOrder;
use super::control_points::ReadControlPointsOrder;
use super::distinct::DistinctnessOrder;
use super::envelope::EnvelopeOrder;
use super::explain::ExplainOrder;
use super::fly::FlyOrder;
use super::frame_picture::FramePictureOrder;
use super::log_series::SeriesOrder;
use super::logs::ReadLogOrder;
use super::map_view::{DescribeMapOrder, TileOrder};
use super::messages::{
    AssessmentOrder, BriefOrder, CalibrationOrder, ContestOrder, DrapeOrder, EvaluationOrder,
    ExportOrder, FieldOrder, FindOrder, HeightsOrder, LogOrder, OutageOrder, PackOrder,
    PhotosOrder, PredictionOrder, SuggestOrder, TrainOrder,
};
use super::open::{OpenOrder, ReadPlacesOrder};
use super::order::{Order, Reads, Urgency, WorkerRole};
use super::prepare::PrepareMapOrder;
use super::provided::{LetGoOrder, ProvideOrder};
use super::read_study_plan::ReadStudyPlanOrder;
use super::rehearse::RehearseOrder;
use super::running::once;
use super::share::ShareOrder;
use super::smooth::SmoothOrder;
use super::study_enough::StudyEnoughOrder;
use super::study_flights::StudyFlightsOrder;
use super::suggest::ProposeOrder;
use super::tables::MakeFlightOrder;
use super::untested::UntestedOrder;
use super::{MapSource, RunningJob, WorkerState};

/// Makes the enum of orders, and passes every question about a job on to its order.
macro_rules! orders {
    (small { $($small:ident($small_order:ty),)* } whole { $($name:ident($order:ty),)* }) => {
        /// Something to do in a worker: one of all orders, as it goes over the wire.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum Job {
            $(
                #[doc = concat!("See [`", stringify!($small_order), "`].")]
                $small($small_order),
            )*
            $(
                #[doc = concat!("See [`", stringify!($order), "`].")]
                $name($order),
            )*
        }

        impl Job {
            /// Urgency among the jobs of its worker.
            pub fn urgency(&self) -> Urgency {
                match self {
                    $(Self::$small(_) => <$small_order as Order>::URGENCY,)*
                    $(Self::$name(_) => <$order as Order>::URGENCY,)*
                }
            }

            /// Role of the worker that does it.
            pub fn role(&self) -> WorkerRole {
                match self {
                    $(Self::$small(order) => order.role(),)*
                    $(Self::$name(order) => order.role(),)*
                }
            }

            /// Keys of the provided files that it names.
            pub fn files(&self) -> Vec<&str> {
                match self {
                    $(Self::$small(order) => order.files(),)*
                    $(Self::$name(order) => order.files(),)*
                }
            }

            /// Map of which its worker needs tiles beforehand, and the parts of it.
            pub fn reads(&self) -> Option<(&MapSource, Reads)> {
                match self {
                    $(Self::$small(order) => order.reads(),)*
                    $(Self::$name(order) => order.reads(),)*
                }
            }

            /// Whether the small program does it.
            pub fn is_small(&self) -> bool {
                match self {
                    $(Self::$small(order) => order.is_small(),)*
                    _ => false,
                }
            }

            /// Makes it ready to advance in the small program, which links nothing else; other jobs fail with their
            /// first step.
            pub fn begin_small(self, worker: &mut WorkerState) -> Box<dyn RunningJob> {
                match self {
                    $(Self::$small(order) => order.begin(worker),)*
                    _ => once(|_, _| {
                        Err("this worker cannot do that; load the page again".to_owned())
                    }),
                }
            }

            /// Makes it ready to advance.
            pub fn begin(self, worker: &mut WorkerState) -> Box<dyn RunningJob> {
                match self {
                    $(Self::$small(order) => order.begin(worker),)*
                    $(Self::$name(order) => order.begin(worker),)*
                }
            }
        }
    };
}

orders! {
    small {
    LetGo(LetGoOrder),
    DescribeMap(DescribeMapOrder),
    Tile(TileOrder),
    Fly(FlyOrder),
    Distinctness(DistinctnessOrder),
    ExplainMatch(ExplainOrder),
    FramePicture(FramePictureOrder),
    Predict(Box<PredictionOrder>),
    Rehearse(Box<RehearseOrder>),
    }
    whole {
    Provide(ProvideOrder),
    Open(OpenOrder),
    ReadPlaces(ReadPlacesOrder),
    ReadControlPoints(ReadControlPointsOrder),
    PrepareMap(PrepareMapOrder),
    TakeHeights(Box<HeightsOrder>),
    ReadLog(ReadLogOrder),
    MakeFlight(MakeFlightOrder),
    LogSeries(SeriesOrder),
    AskLog(Box<LogOrder>),
    Outage(Box<OutageOrder>),
    Contest(Box<ContestOrder>),
    Smooth(SmoothOrder),
    Calibrate(Box<CalibrationOrder>),
    LayPhotos(Box<PhotosOrder>),
    DrapePhoto(Box<DrapeOrder>),
    Evaluate(Box<EvaluationOrder>),
    Assess(Box<AssessmentOrder>),
    AssessShare(ShareOrder<AssessmentOrder>),
    SumUp(SumUpOrder),
    AssessAhead(AssessAheadOrder),
    Untested(UntestedOrder),
    Envelope(EnvelopeOrder),
    Train(Box<TrainOrder>),
    Suggest(Box<SuggestOrder>),
    SuggestShare(ShareOrder<SuggestOrder>),
    Propose(ProposeOrder),
    Field(Box<FieldOrder>),
    Find(Box<FindOrder>),
    Brief(BriefOrder),
    Pack(Box<PackOrder>),
    Export(Box<ExportOrder>),
    ReadStudyPlan(ReadStudyPlanOrder),
    StudyEnough(StudyEnoughOrder),
    StudyFlights(StudyFlightsOrder),
    }
}
