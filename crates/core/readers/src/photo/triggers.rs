//! When a log says that its camera took a photo.

use crate::log::{Log, LogFormat, Topic, system_of};

/// Photos that a log tells of.
#[derive(Clone, Debug, PartialEq)]
pub struct Triggers {
    /// Name of the topic that tells them.
    pub source: String,
    /// Seconds in the log's time base, growing.
    pub times: Vec<f64>,
}

/// Where a log tells photos, the surest first: that the shutter opened, before that it was asked to. A field that has to be 1
/// for a photo that was taken, if there is one.
type Place = (&'static str, &'static str);
const DATAFLASH: [Place; 2] = [("CAM", ""), ("TRIG", "")];
const ULOG: [Place; 2] = [("camera_capture", "result"), ("camera_trigger", "")];
const TLOG: [Place; 3] = [
    ("CAMERA_IMAGE_CAPTURED", "capture_result"),
    ("CAMERA_FEEDBACK", ""),
    ("CAMERA_TRIGGER", ""),
];

/// The photos that a log tells of; `None` if it tells of none.
pub fn triggers(log: &Log) -> Option<Triggers> {
    let places: &[Place] = match log.format {
        LogFormat::Dataflash | LogFormat::DataflashText => &DATAFLASH,
        LogFormat::Ulog | LogFormat::Mcap => &ULOG,
        LogFormat::Tlog => &TLOG,
        LogFormat::Tables | LogFormat::Photos => return None,
    };
    let chosen = log.chosen_vehicle();
    places.iter().find_map(|(name, taken)| {
        let is_own = |topic: &&Topic| {
            let system = topic.name.instance.map(system_of);
            topic.name.name == *name && chosen.is_none_or(|chosen| system == Some(chosen))
        };
        let topic = log.topics.iter().find(is_own)?;
        let is_taken = topic.field(taken);
        let rows = topic.times.iter().enumerate().filter(|(row, _)| {
            let taken = is_taken.and_then(|field| topic.value(field, *row));
            taken.is_none_or(|taken| taken == 1.0)
        });
        let mut times: Vec<f64> = rows.map(|(_, t)| *t).filter(|t| t.is_finite()).collect();
        times.sort_by(f64::total_cmp);
        // A message that was sent twice tells of one photo.
        times.dedup();
        (!times.is_empty()).then(|| Triggers {
            source: topic.name.to_string(),
            times,
        })
    })
}
