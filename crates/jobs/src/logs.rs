//! Flight logs: read piece by piece and kept by the worker.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::interpret::{
    RecordedTrack, flight_from_log, log_of_flight, recorded_tracks,
};
use pilotage_core::flight::log::{Log, LogOutline, LogReader, recognise};
use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::ByteSource;

use serde::{Deserialize, Serialize};

use super::log_flights::{LogGlance, glance_at_folder, head};
use super::opening::open_folder;
use super::order::{Order, Urgency, WorkerRole};
use super::running::slice;
use super::tables::flight_folder;
use super::vehicle::choose_vehicle;
use super::{Advance, JobEvent, ReadLog, RecordedPlaces, RunningJob, WorkerState};

/// Bytes that are read at a time.
const PIECE: usize = 2 << 20;
/// Milliseconds after which what was read so far is told first; each time later twice as long.
const FIRST_WORD: f64 = 300.0;

/// A log that is read.
struct LogReading {
    source: Arc<dyn ByteSource>,
    reader: Box<dyn LogReader>,
    log: Rc<RefCell<Log>>,
    offset: u64,
}

impl LogReading {
    /// Nothing read yet; `None` if no file of that name is a log.
    fn begin(pool: &dyn FileSet, file: &str) -> Option<Self> {
        let source = pool.source(file)?;
        let head = head(source.as_ref()).unwrap_or_default();
        let info = recognise(&head)?;
        Some(Self {
            source,
            reader: (info.reader)(),
            log: Rc::new(RefCell::new(Log::new(file, info.format))),
            offset: 0,
        })
    }

    /// Reads a piece; whether there are more.
    fn step(&mut self) -> Result<bool, String> {
        let left = self.source.length() - self.offset;
        let length = PIECE.min(usize::try_from(left).unwrap_or(PIECE));
        let mut log = self.log.borrow_mut();
        if length == 0 {
            self.reader.finish(&mut log);
            return Ok(false);
        }
        let bytes = self.source.read(self.offset, length);
        let bytes = bytes.map_err(|cause| format!("{}: {cause}", log.name))?;
        self.reader.feed(&bytes, &mut log);
        self.offset += length as u64;
        Ok(true)
    }

    fn share(&self) -> f32 {
        self.offset as f32 / self.source.length().max(1) as f32
    }
}

/// A log that is being read: events `Progress`, `LogOutline` as it grows, at the end `LogRead`. Where no file of its name
/// is a log, it is what the tables or photos among the files are, which are read at once.
pub struct ReadingLog {
    key: String,
    file: String,
    reading: Option<LogReading>,
    begun: f64,
    /// When what was read so far is told next, milliseconds after the beginning.
    word: f64,
}

impl ReadingLog {
    /// Nothing read yet.
    pub fn new(key: String, file: String) -> Self {
        Self {
            key,
            file,
            reading: None,
            begun: 0.0,
            word: FIRST_WORD,
        }
    }
}

impl RunningJob for ReadingLog {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if self.reading.is_none() {
            self.begun = clock();
            let pool = worker.files(&self.key)?;
            let Some(reading) = LogReading::begin(pool.as_ref(), &self.file) else {
                return self.read_folder(worker, &pool, emit);
            };
            worker.keep_log(&self.key, &self.file, reading.log.clone());
            self.reading = Some(reading);
        }
        let Some(reading) = &mut self.reading else {
            return Ok(Advance::Done);
        };
        worker.log_grew();
        let mut trouble = None;
        let is_more = slice(clock, || match reading.step() {
            Ok(is_more) => is_more,
            Err(cause) => {
                trouble = Some(cause);
                false
            }
        });
        if let Some(cause) = trouble {
            return Err(cause);
        }
        if is_more {
            let words = format!("Reading {}", self.file);
            emit(JobEvent::Progress(reading.share(), words));
            if clock() - self.begun > self.word {
                self.word *= 2.0;
                let outline = LogOutline::of(&reading.log.borrow());
                emit(JobEvent::LogOutline(Box::new(outline)));
            }
            return Ok(Advance::More);
        }
        let mut log = reading.log.borrow_mut();
        choose_vehicle(worker.files(&self.key)?.as_ref(), &mut log)?;
        let interpreted = flight_from_log(&log);
        let tracks = recorded_tracks(&mut log, interpreted.measured().found);
        let pool = worker.files(&self.key)?;
        let glance = LogGlance::of(&log, interpreted, &pool);
        let frame = glance.flight.as_ref().map(|it| it.flight.frame_on_globe);
        let read = ReadLog {
            outline: LogOutline::of(&log),
            overview: glance.overview,
            tracks: frame.map_or_else(|_| Vec::new(), |frame| on_ground(&tracks, frame)),
            flight: frame.map_err(Clone::clone),
            lost_pictures: glance.lost_pictures,
        };
        if let Ok(open) = glance.flight {
            worker.keep_flight(&self.key, open);
        }
        emit(JobEvent::LogRead(Box::new(read)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

/// Tracks in the world `frame` of the flight; none where nobody knows where that lies.
fn on_ground(tracks: &[RecordedTrack], frame: Option<LocalFrame>) -> Vec<RecordedPlaces> {
    let Some(frame) = frame else {
        return Vec::new();
    };
    let places = |track: &RecordedTrack| {
        let points = track.points.iter();
        RecordedPlaces {
            name: track.name.clone(),
            places: points
                .map(|(_, place)| frame.ground_from_geodetic(place))
                .collect(),
        }
    };
    tracks.iter().map(places).collect()
}

impl ReadingLog {
    /// Reads the flight that stands in tables or photos, and the log that they are.
    fn read_folder(
        &self,
        worker: &mut WorkerState,
        pool: &Arc<dyn FileSet>,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let folder = flight_folder(pool)?;
        let folder = folder.ok_or_else(|| match pool.source(&self.file) {
            Some(_) => format!("{}: it is no flight log", self.file),
            None => format!("{}: it is not here any more; open it again", self.file),
        })?;
        let mut log = folder.log();
        let beside = log_of_flight(&log, &folder.flight);
        let tracks = recorded_tracks(&mut log, beside.measured().found);
        let overview = glance_at_folder(&log, &beside, &folder.flight);
        let read = ReadLog {
            outline: LogOutline::of(&log),
            overview,
            flight: Ok(folder.flight.frame_on_globe),
            tracks: on_ground(&tracks, folder.flight.frame_on_globe),
            lost_pictures: None,
        };
        worker.keep_log(&self.key, &self.file, Rc::new(RefCell::new(log)));
        worker.keep_flight(&self.key, open_folder(pool, folder)?);
        emit(JobEvent::LogRead(Box::new(read)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

/// Flight log to be read among provided files, or else the tables or photos of a flight, which are one as well and
/// called by the key they are kept under: events `LogOutline` as it grows, at the end `LogRead`. Kept by the worker for
/// [`super::SeriesOrder`] and [`super::FlyOrder`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadLogOrder {
    /// Key of the files.
    pub key: String,
    /// Its name among them.
    pub file: String,
}

impl Order for ReadLogOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(ReadingLog::new(self.key, self.file))
    }
}

#[cfg(test)]
#[path = "logs_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "measured_tests.rs"]
mod measured_tests;
