//! Jobs of the whole program beyond those of the small one.

use std::sync::Arc;

use pilotage_core::exchange::Written;
use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::{MapOptions, open_map_with};

use super::super::align::Align;
use super::super::assess::{Assess, sum_up};
use super::super::brief::Brief;
use super::super::contest::Contest;
use super::super::envelope::SurveyEnvelope;
use super::super::evaluate::Evaluate;
use super::super::field::ComputeField;
use super::super::file_pool::FilePool;
use super::super::find::FindRoute;
use super::super::flights::OpenFlight;
use super::super::heights::TakeHeights;
use super::super::log_answers::AnswerLog;
use super::super::log_series::SendSeries;
use super::super::logs::ReadingLog;
use super::super::pack::pack;
use super::super::photos::{LayPhotos, draped};
use super::super::prepare::PrepareMap;
use super::super::reckon::MakeCut;
use super::super::running::once;
use super::super::suggest::{Suggest, choose};
use super::super::tables::make_flight;
use super::super::train::Train;
use super::super::workshop::{MAP_MEMORY, OpenedMap};
use super::super::{FlightSource, Job, JobEvent, MapSource, RunningJob, Share, Workshop, opening};
use super::flying;

/// Makes a job ready to advance.
pub fn begin(workshop: &mut Workshop, job: Job) -> Box<dyn RunningJob> {
    match job {
        Job::Provide { key, files } => {
            workshop.provide(key, &files);
            once(|_, _| Ok(()))
        }
        Job::Open { key, near, origin } => once(move |workshop, emit| {
            let files = workshop.files(&key)?;
            let opened = opening::look_through(key, &files, near, origin)?;
            emit(JobEvent::Opened(Box::new(opened)));
            Ok(())
        }),
        Job::ReadLog { key, file } => Box::new(ReadingLog::new(key, file)),
        Job::MakeFlight { key } => once(move |workshop, emit| make_flight(workshop, &key, emit)),
        Job::LogSeries { key, file, series } => Box::new(SendSeries::new(key, file, series)),
        Job::AskLog(order) => Box::new(AnswerLog::new(*order)),
        Job::Cut(order) => Box::new(MakeCut::new(*order)),
        Job::Contest(order) => Box::new(Contest::new(*order)),
        Job::Align(order) => Box::new(Align::new(*order)),
        Job::LayPhotos(order) => Box::new(LayPhotos::new(*order)),
        Job::DrapePhoto(order) => once(move |workshop, emit| {
            let files = workshop.files(&order.key)?;
            emit(JobEvent::PhotoDraped(Box::new(draped(&files, &order)?)));
            Ok(())
        }),
        Job::ReadPlaces { key } => once(move |workshop, emit| {
            let files = workshop.files(&key)?;
            emit(JobEvent::Places(opening::places(&files)?));
            Ok(())
        }),
        Job::PrepareMap(source) => Box::new(PrepareMap::new(source)),
        Job::TakeHeights(order) => Box::new(TakeHeights::new(*order)),
        Job::Brief(order) => Box::new(Brief::new(order)),
        Job::Assess(order) => Box::new(Assess::new(*order, Share::WHOLE)),
        Job::AssessShare(order, share) => Box::new(Assess::new(*order, share)),
        Job::SumUp(order, views) => once(move |_, emit| {
            let found = sum_up(&order, &views)?;
            emit(JobEvent::Assessment(Box::new(found)));
            Ok(())
        }),
        Job::Envelope(order) => Box::new(SurveyEnvelope::new(*order)),
        Job::Train(order) => Box::new(Train::new(*order)),
        Job::Suggest(order) => Box::new(Suggest::new(*order, Share::WHOLE)),
        Job::SuggestShare(order, share) => Box::new(Suggest::new(*order, share)),
        Job::Propose(order, found) => once(move |workshop, emit| {
            emit(JobEvent::Suggestions(choose(workshop, *order, found)?));
            Ok(())
        }),
        Job::Evaluate(order) => Box::new(Evaluate::new(*order)),
        Job::Field(order) => Box::new(ComputeField::new(*order)),
        Job::Find(order) => Box::new(FindRoute::new(*order)),
        Job::Pack(order) => once(move |workshop, emit| {
            let (bytes, lacks) = pack(workshop, &order)?;
            emit(JobEvent::Packed { bytes, lacks });
            Ok(())
        }),
        Job::Export(order) => once(move |_, emit| {
            let Written { bytes, notes } = order.write()?;
            emit(JobEvent::Exported { bytes, notes });
            Ok(())
        }),
        Job::LetGo { .. }
        | Job::Fly { .. }
        | Job::DescribeMap(_)
        | Job::Tile { .. }
        | Job::Distinctness { .. }
        | Job::Predict(_)
        | Job::ExplainMatch { .. }
        | Job::DecodePicture { .. } => flying::begin(workshop, job),
    }
}

/// Opens a map.
pub fn open_map(workshop: &mut Workshop, source: &MapSource) -> OpenedMap {
    match source {
        MapSource::Scenery | MapSource::Hall | MapSource::Nothing => {
            flying::open_map(workshop, source)
        }
        MapSource::Web(map) => Ok(Arc::new(map.open(workshop.fetched()))),
        MapSource::Files(key) => {
            let files = workshop.files(key)?;
            let frame = match opening::flight_folder(&files)? {
                Some(folder) => folder.flight.frame_on_globe,
                None => None,
            };
            map_among(&files, frame)
        }
        MapSource::Placed { key, origin } => {
            let files = workshop.files(key)?;
            map_among(&files, Some(LocalFrame::new(*origin)))
        }
        MapSource::Picture {
            key,
            name,
            origin,
            place,
        } => {
            let options = MapOptions {
                frame: origin.map(LocalFrame::new),
                place: Some(*place),
                memory: MAP_MEMORY,
                ..MapOptions::default()
            };
            let files = workshop.files(key)?;
            let map = open_map_with(files.as_ref(), name, &options);
            Ok(Arc::new(map.map_err(|cause| cause.to_string())?))
        }
    }
}

/// The map among files, in the world frame `frame` or else its own.
fn map_among(files: &FilePool, frame: Option<LocalFrame>) -> Result<Arc<dyn Imagery>, String> {
    let options = MapOptions {
        frame,
        memory: MAP_MEMORY,
        ..MapOptions::default()
    };
    let map = opening::map(files, &options)?;
    let (_, map) = map.ok_or("there is no map among the files")?;
    Ok(Arc::new(map))
}

/// Opens a flight.
pub fn open_flight(workshop: &mut Workshop, source: &FlightSource) -> Result<OpenFlight, String> {
    match source {
        FlightSource::Files(key) => {
            let files = workshop.files(key)?;
            let open = opening::flight(&files)?;
            Ok(open.ok_or("there is no flight among the files")?)
        }
        FlightSource::Simulated(_) | FlightSource::Nothing => flying::open_flight(workshop, source),
    }
}
