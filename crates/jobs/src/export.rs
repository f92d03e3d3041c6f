//! Files for other programs, as a job: the page needs no writer of theirs.

use pilotage_core::exchange::labels::write_labels;
use pilotage_core::exchange::{Places, WrittenFile, write_flown, write_places};
use pilotage_core::frames::LocalFrame;

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::samples::values_along;
use super::{ExportOrder, JobEvent, RunningJob, WorkerState};

impl ExportOrder {
    /// With the values that stand beside its track, as the log has them that the worker has read.
    ///
    /// # Errors
    /// The log is not the one that was read last, or has no such series.
    fn with_values(mut self, worker: &mut WorkerState) -> Result<Self, String> {
        if let Self::Track {
            track,
            beside: Some(beside),
            ..
        } = &mut self
        {
            let samples = worker.samples(&beside.key, &beside.file, &beside.series)??;
            let times: Vec<f64> = track.points.iter().map(|point| point.time).collect();
            let values = values_along(&samples, &times);
            for (point, value) in track.points.iter_mut().zip(values) {
                point.value = value;
            }
        }
        Ok(self)
    }

    /// The file; the error says in words why there is none.
    pub fn write(&self) -> Result<WrittenFile, String> {
        match self {
            Self::Places {
                format,
                routes,
                landmarks,
                no_fly,
                rally,
                origin,
            } => {
                let places = Places {
                    routes,
                    landmarks,
                    no_fly,
                    rally: Some(rally),
                };
                write_places(*format, &places, &LocalFrame::new(*origin))
                    .map_err(|cause| cause.to_string())
            }
            Self::Track { format, track, .. } => {
                write_flown(*format, track).map_err(|cause| cause.to_string())
            }
            Self::Labels {
                format,
                frames,
                landmarks,
            } => write_labels(*format, frames, landmarks).map_err(|cause| cause.to_string()),
        }
    }
}

impl Order for ExportOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        match self {
            // The worker that has read the log.
            Self::Track {
                beside: Some(_), ..
            } => WorkerRole::Flight,
            _ => WorkerRole::Questions,
        }
    }

    fn files(&self) -> Vec<&str> {
        match self {
            Self::Track {
                beside: Some(beside),
                ..
            } => vec![&beside.key],
            _ => Vec::new(),
        }
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let WrittenFile { bytes, notes } = self.with_values(worker)?.write()?;
            emit(JobEvent::Exported { bytes, notes });
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::fmt::Write as _;
    use std::rc::Rc;

    use pilotage_core::exchange::{FlownPoint, FlownTrack, FlownValues, Format};
    use pilotage_core::flight::log::{Log, LogFormat, TopicName, read_log};
    use pilotage_core::frames::Geodetic;
    use pilotage_core::imagery::MemoryBytes;

    use super::*;
    use crate::{Abilities, SeriesName, TrackSeries};

    /// A counter that goes far between two rows.
    const COUNTED: [u64; 2] = [3, 1_700_000_000_123_457];

    #[test]
    fn a_value_beside_a_track_has_all_digits_that_the_log_has() {
        let mut text = "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n\
             FMT, 1, 19, CNT, QQ, TimeUS,Count\n"
            .to_owned();
        for (second, count) in COUNTED.iter().enumerate() {
            writeln!(text, "CNT, {}, {count}", 1_000_000 * (1 + second)).unwrap();
        }
        let log = read_log(&MemoryBytes::new("a.log", text.as_bytes())).unwrap();
        let log = Rc::new(RefCell::new(log.unwrap()));
        let mut worker = WorkerState::new(Abilities::WHOLE.opens);
        worker.keep_log("drop", "a.log", log);
        let point = |time| FlownPoint {
            time,
            place: Geodetic::from_degrees(47.0, 8.0, 0.0),
            value: None,
        };
        let order = ExportOrder::Track {
            format: Format::Csv,
            track: FlownTrack {
                name: "a".to_owned(),
                utc_at_zero: None,
                has_height: false,
                points: [0.5, 1.5, 2.0].map(point).to_vec(),
                values: Some(FlownValues {
                    name: "CNT.Count".to_owned(),
                    unit: String::new(),
                }),
            },
            beside: Some(TrackSeries {
                key: "drop".to_owned(),
                file: "a.log".to_owned(),
                series: SeriesName {
                    topic: TopicName::single("CNT"),
                    field: "Count".to_owned(),
                },
            }),
        };
        assert_eq!(order.role(), WorkerRole::Flight);
        let ExportOrder::Track { track, .. } = order.clone().with_values(&mut worker).unwrap()
        else {
            panic!("no track")
        };
        let values = track.points.iter().map(|point| point.value);
        let [few, many] = COUNTED.map(|count| Some(count as f64));
        assert_eq!(values.collect::<Vec<_>>(), [None, few, many]);
        // Of a log that nobody has read it has none, and says so.
        let other = Log::new("b.log", LogFormat::DataflashText);
        worker.keep_log("drop", "b.log", Rc::new(RefCell::new(other)));
        assert!(
            order
                .with_values(&mut worker)
                .unwrap_err()
                .contains("a.log")
        );
    }
}
