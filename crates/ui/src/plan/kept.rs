//! What was measured of landmarks, kept with the mission for as long as it is true.
//!
//! A measurement depends on the landmark and its detector, the map, the camera, how the filter is told to
//! look, and on this program. Kept beside each is all of that, and what differs from the state of things is
//! not used.

use pilotage_core::camera::CameraModel;
use pilotage_core::landmark::{Landmark, TemplateSettings};
use pilotage_core::navigator::SensorNoise;
use pilotage_core::plan::Envelope;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::flown;
use super::measured::Measured;
use crate::documents::Documents;
use crate::jobs::{AssessmentOrder, MapSource};

/// Key in the browser's storage.
pub const MEASURED_KEY: &str = "measured landmarks";
/// First byte of what is stored: the form of the bytes.
const FORM: u8 = 1;
/// How landmarks are measured: raised whenever detector, camera simulator or rehearsal change so that
/// what was measured before is no longer true.
const METHOD: u32 = 2;
/// Lengths that differ by less are equal, metres: a mission file keeps places as angles.
const SAME_PLACE: f64 = 2e-3;
/// The same for the corners of a map, whose frame may be laid through another origin.
const SAME_MAP: f64 = 0.5;

/// What a measurement depends on beside the landmark and the height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Basis {
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

impl Basis {
    /// What measurements on that order, of the map that is open, will depend on; `None` while the map is
    /// not known.
    pub fn of(documents: &Documents, order: &AssessmentOrder) -> Option<Self> {
        let navigator = &order.navigator;
        Self::with(
            documents,
            &order.camera,
            navigator.sensors,
            navigator.detector,
        )
    }

    /// What measurements would depend on now.
    fn now(documents: &Documents) -> Option<Self> {
        let navigator = &documents.mission.navigator;
        let camera = flown::camera(documents);
        Self::with(documents, &camera, navigator.sensors, navigator.detector)
    }

    fn with(
        documents: &Documents,
        camera: &CameraModel,
        sensors: SensorNoise,
        detector: TemplateSettings,
    ) -> Option<Self> {
        let map = documents.map.as_ref()?;
        let name = match &documents.map_source {
            MapSource::Web(web) => web.template.address.as_str(),
            _ => map.name.rsplit(['/', '\\']).next().unwrap_or_default(),
        };
        let b = map.bounds;
        Some(Self {
            method: METHOD,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            map: name.to_owned(),
            gsd: map.native_gsd,
            edges: [b.south, b.west, b.north, b.east],
            camera: camera.clone(),
            sensors,
            detector,
        })
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

/// What was measured of one landmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptMeasurement {
    /// What it depends on.
    pub basis: Basis,
    /// The landmark as it was measured.
    pub landmark: Landmark,
    /// How well it is found.
    pub measured: Option<Measured>,
    /// The height that was planned with, metres, and from where it is found.
    pub envelope: Option<(f64, Envelope)>,
}

impl KeptMeasurement {
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

/// As bytes for the storage.
pub fn encode(kept: &[KeptMeasurement]) -> Vec<u8> {
    postcard::to_extend(kept, vec![FORM]).unwrap_or_default()
}

/// From the storage; nothing if it is damaged or of another version.
pub fn decode(bytes: &[u8]) -> Vec<KeptMeasurement> {
    let body = bytes.strip_prefix(&[FORM]);
    body.and_then(|body| postcard::from_bytes(body).ok())
        .unwrap_or_default()
}

/// Of `kept`, what is true now goes to `use_it` with the landmark it is of; the rest stays.
pub fn use_what_is_true(
    kept: &mut Vec<KeptMeasurement>,
    documents: &Documents,
    mut use_it: impl FnMut(KeptMeasurement, &Landmark),
) {
    let Some(now) = Basis::now(documents) else {
        return;
    };
    let landmarks = &documents.mission.landmarks;
    for one in std::mem::take(kept) {
        let landmark = landmarks.iter().find(|landmark| one.is_of(landmark));
        match landmark.filter(|_| one.basis.is_like(&now)) {
            Some(landmark) => use_it(one, landmark),
            None => kept.push(one),
        }
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::{GroundPoint, GroundRect};
    use pilotage_core::landmark::DetectorChoice;
    use pilotage_core::plan::{Breakdown, DetectionStatistics, Tally};

    use super::super::assessments::assumed;
    use super::*;
    use crate::documents::Session;
    use crate::jobs::{Assessment, Beside, MapInfo};

    fn documents() -> Documents {
        let mut documents = Documents::new(&Session::demo());
        documents.map = Some(MapInfo {
            name: "maps/area.tif".to_owned(),
            bounds: GroundRect::centered(GroundPoint::default(), 800.0, 600.0),
            native_gsd: 0.25,
            is_coarse_cheap: true,
            origin: None,
            attribution: None,
        });
        let bounds = GroundRect::centered(GroundPoint::new(30.1, -20.7), 20.0, 15.0);
        documents.mission.landmarks = vec![Landmark::new(7, "barn", bounds)];
        documents
    }

    fn kept(documents: &Documents) -> KeptMeasurement {
        let landmark = documents.mission.landmarks[0].clone();
        KeptMeasurement {
            basis: Basis::now(documents).unwrap(),
            measured: Some(Measured {
                last: Assessment {
                    landmark: landmark.clone(),
                    height: 120.0,
                    expected: assumed(),
                    false_matches: 0.0,
                    views: Vec::new(),
                    breakdown: Breakdown::default(),
                },
                statistics: DetectionStatistics::everywhere(assumed()),
            }),
            envelope: Some((
                120.0,
                Envelope {
                    heights: vec![120.0],
                    tilts: vec![0.0],
                    cells: vec![Tally::default()],
                },
            )),
            landmark,
        }
    }

    /// Whether what was measured over `documents` is used after that change.
    fn is_used_after(change: impl FnOnce(&mut Documents)) -> bool {
        let mut documents = documents();
        let mut all = vec![kept(&documents)];
        change(&mut documents);
        let mut used = 0;
        use_what_is_true(&mut all, &documents, |_, landmark| {
            assert_eq!(landmark.id, 7);
            used += 1;
        });
        assert_eq!(used + all.len(), 1, "nothing is lost");
        used == 1
    }

    #[test]
    fn a_measurement_is_used_only_while_all_it_depends_on_is_the_same() {
        assert!(is_used_after(|_| ()));
        assert!(is_used_after(
            |d| d.mission.landmarks[0].name = "old barn".to_owned()
        ));
        // Places that went through a file as angles.
        assert!(is_used_after(
            |d| d.mission.landmarks[0].bounds.north += 3e-4
        ));
        assert!(is_used_after(|d| {
            d.map
                .iter_mut()
                .for_each(|m| m.name = "area.tif".to_owned());
        }));
        assert!(!is_used_after(
            |d| d.mission.landmarks[0].bounds.north += 0.1
        ));
        assert!(!is_used_after(|d| d.mission.landmarks[0].height = 3.0));
        let trained = |d: &mut Documents| d.mission.landmarks[0].keep_trained_text(Some("1"));
        assert!(is_used_after(trained), "it is looked for by its map patch");
        assert!(!is_used_after(|d| {
            trained(d);
            d.mission.landmarks[0].choose_detector(DetectorChoice::Both);
        }));
        assert!(!is_used_after(|d| d.mission.navigator.sensors.roll *= 1.1));
        assert!(!is_used_after(|d| d
            .mission
            .navigator
            .detector
            .least_score += 0.01));
        assert!(!is_used_after(
            |d| d.mission.camera = Some(CameraModel::pinhole(320, 200, 0.9))
        ));
        assert!(!is_used_after(|d| d
            .map
            .iter_mut()
            .for_each(|m| m.native_gsd = 0.26)));
        assert!(!is_used_after(|d| d.map = None));
        assert!(!is_used_after(|d| d.mission.landmarks.clear()));
    }

    #[test]
    fn stored_bytes_and_mission_files_give_back_what_went_in() {
        let documents = documents();
        let all = vec![kept(&documents)];
        assert_eq!(decode(&encode(&all)), all);
        assert_eq!(decode(&[]), []);
        assert_eq!(decode(&[FORM + 1, 0]), []);
        assert_eq!(decode(&encode(&all)[..40]), []);
        let beside = Beside {
            measured: all,
            ..Beside::default()
        };
        let text = serde_json::to_string(&beside).unwrap();
        assert_eq!(serde_json::from_str::<Beside>(&text).unwrap(), beside);
        let older = r#"{"simulation":null,"bookmarks":[4.0]}"#;
        let older: Beside = serde_json::from_str(older).unwrap();
        assert_eq!((older.bookmarks.len(), older.measured.len()), (1, 0));
    }
}
