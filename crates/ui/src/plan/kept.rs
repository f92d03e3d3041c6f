//! Measurements of landmarks, kept with the mission for as long as it is true.
//!
//! A measurement depends on the landmark and its detector, the map, the camera, how the filter is told to
//! look, and on this program. Kept beside each is all of that, and what differs from the state of things is
//! not used.

use pilotage_core::camera::CameraModel;
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::NavigatorSettings;

use super::flown;
use crate::documents::Documents;
use pilotage_jobs::{AssessmentOrder, KeptMeasurement, MeasurementBasis};

/// Key in the browser's storage.
pub const MEASURED_KEY: &str = "measured landmarks";
/// Basis of measurements on `order` over the open map; `None` while the map is not known.
pub fn basis_of(documents: &Documents, order: &AssessmentOrder) -> Option<MeasurementBasis> {
    basis(documents, &order.camera, &order.navigator)
}

/// Basis of measurements that would be made now; `None` while the map is not known.
pub fn basis_now(documents: &Documents) -> Option<MeasurementBasis> {
    let camera = flown::camera(documents);
    basis(documents, &camera, &documents.mission.navigator)
}

fn basis(
    documents: &Documents,
    camera: &CameraModel,
    navigator: &NavigatorSettings,
) -> Option<MeasurementBasis> {
    let (map, source) = (documents.map.info.as_ref()?, &documents.map.source);
    let (sensors, detector) = (navigator.sensors, navigator.detector);
    Some(MeasurementBasis::new(
        map, source, camera, sensors, detector,
    ))
}

/// Of `kept`, what is true now goes to `use_it` with the landmark it is of; the rest stays.
pub fn use_what_is_true(
    kept: &mut Vec<KeptMeasurement>,
    documents: &Documents,
    mut use_it: impl FnMut(KeptMeasurement, &Landmark),
) {
    let Some(now) = basis_now(documents) else {
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
    use pilotage_core::plan::{
        DetectionStatistics, Envelope, LookTally, UntestedDetection, ViewBreakdown,
    };

    use super::*;
    use crate::documents::Session;
    use pilotage_jobs::{Assessment, Beside, MapInfo, MeasuredLandmark};

    fn documents() -> Documents {
        let mut documents = Documents::new(&Session::demo());
        documents.map.info = Some(MapInfo {
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
            basis: basis_now(documents).unwrap(),
            measured: Some(MeasuredLandmark {
                last: Assessment {
                    landmark: landmark.clone(),
                    height: 120.0,
                    expected: UntestedDetection::of_any_map().expected,
                    false_matches: 0.0,
                    views: Vec::new(),
                    breakdown: ViewBreakdown::default(),
                },
                statistics: DetectionStatistics::everywhere(
                    UntestedDetection::of_any_map().expected,
                ),
            }),
            envelope: Some((
                120.0,
                Envelope {
                    heights: vec![120.0],
                    tilts: vec![0.0],
                    cells: vec![LookTally::default()],
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
                .info
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
            .info
            .iter_mut()
            .for_each(|m| m.native_gsd = 0.26)));
        assert!(!is_used_after(|d| d.map.info = None));
        assert!(!is_used_after(|d| d.mission.landmarks.clear()));
    }

    #[test]
    fn stored_bytes_and_mission_files_give_back_what_went_in() {
        let documents = documents();
        let all = vec![kept(&documents)];
        assert_eq!(
            KeptMeasurement::decode_all(&KeptMeasurement::encode_all(&all)),
            all
        );
        assert_eq!(KeptMeasurement::decode_all(&[]), []);
        assert_eq!(KeptMeasurement::decode_all(&[255, 0]), []);
        assert_eq!(
            KeptMeasurement::decode_all(&KeptMeasurement::encode_all(&all)[..40]),
            []
        );
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
