//! Measurements of landmarks with everything they depend on, as mission files and the browser's storage keep them.

use pilotage_core::camera::CameraModel;
use pilotage_core::landmark::{Landmark, TemplateSettings};
use pilotage_core::navigator::SensorNoise;
use pilotage_core::plan::{DetectionStatistics, Envelope};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Assessment, MapInfo, MapSource};

/// Version of the method of measurement: raised whenever detector, camera simulator or rehearsal change so that
/// what was measured before is no longer true.
const METHOD: u32 = 2;
/// First byte of what is stored: the form of the bytes.
const FORM: u8 = 1;
/// Lengths that differ by less are equal, metres: a mission file keeps places as angles.
const SAME_PLACE: f64 = 2e-3;
/// The same for the corners of a map, whose frame may be laid through another origin.
const SAME_MAP: f64 = 0.5;

/// Everything a measurement depends on beside the landmark and the height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasurementBasis {
    method: u32,
    program: String,
    /// Name of the map without folders, or the address of its tiles.
    map: String,
    /// Metres per pixel.
    gsd: f64,
    /// South, west, north and east edge of the map, metres.
    edges: [f64; 4],
    camera: CameraModel,
    sensors: SensorNoise,
    detector: TemplateSettings,
}

impl MeasurementBasis {
    /// Basis of measurements over the map that `source` names, by that camera and those settings.
    pub fn new(
        map: &MapInfo,
        source: &MapSource,
        camera: &CameraModel,
        sensors: SensorNoise,
        detector: TemplateSettings,
    ) -> Self {
        let name = match source {
            MapSource::Web(web) => web.template.address.as_str(),
            _ => map.name.rsplit(['/', '\\']).next().unwrap_or_default(),
        };
        let b = map.bounds;
        Self {
            method: METHOD,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            map: name.to_owned(),
            gsd: map.native_gsd,
            edges: [b.south, b.west, b.north, b.east],
            camera: camera.clone(),
            sensors,
            detector,
        }
    }

    /// Whether both are the same but for what is lost when numbers are written down.
    pub fn is_like(&self, other: &Self) -> bool {
        let same_map = self
            .edges
            .iter()
            .zip(other.edges)
            .all(|(a, b)| (a - b).abs() < SAME_MAP);
        let rest = |basis: &Self| {
            serde_json::to_value(Self {
                edges: [0.0; 4],
                ..basis.clone()
            })
            .unwrap_or_default()
        };
        same_map && alike(&rest(self), &rest(other))
    }
}

/// Whether two values are equal, numbers to a millionth.
fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-6 * a.abs().max(b.abs()),
            _ => a == b,
        },
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let found = |(name, value)| b.get(name).is_some_and(|other| alike(value, other));
            a.len() == b.len() && a.iter().all(found)
        }
        _ => a == b,
    }
}

/// Measurements of one landmark, with everything they depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptMeasurement {
    /// State of map, camera, settings and program.
    pub basis: MeasurementBasis,
    /// The landmark as it was measured.
    pub landmark: Landmark,
    /// Reliability of its detection, if it was measured.
    pub measured: Option<MeasuredLandmark>,
    /// The height that was planned with, metres, and from where it is found.
    pub envelope: Option<(f64, Envelope)>,
}

impl KeptMeasurement {
    /// Measurements as bytes for a storage.
    pub fn encode_all(kept: &[Self]) -> Vec<u8> {
        postcard::to_extend(kept, vec![FORM]).unwrap_or_default()
    }

    /// Measurements out of a storage; none if it is damaged or of another version.
    pub fn decode_all(bytes: &[u8]) -> Vec<Self> {
        let body = bytes.strip_prefix(&[FORM]);
        body.and_then(|body| postcard::from_bytes(body).ok())
            .unwrap_or_default()
    }

    /// Whether it is of `landmark`, as that is now.
    pub fn is_of(&self, landmark: &Landmark) -> bool {
        let numbers = |l: &Landmark| {
            let b = l.bounds;
            [
                b.south,
                b.west,
                b.north,
                b.east,
                l.reference.north,
                l.reference.east,
                l.height,
            ]
        };
        let (ours, theirs) = (numbers(&self.landmark), numbers(landmark));
        self.landmark.id == landmark.id
            && self.landmark.detector_in_use() == landmark.detector_in_use()
            && (ours.iter().zip(theirs)).all(|(a, b)| (a - b).abs() < SAME_PLACE)
    }
}

/// Measurements of one landmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredLandmark {
    /// The last measurement.
    pub last: Assessment,
    /// By height.
    pub statistics: DetectionStatistics,
}
