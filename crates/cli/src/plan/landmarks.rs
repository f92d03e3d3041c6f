//! Detection of landmarks over the map of a plan.

use std::sync::Arc;

use pilotage_core::plan::{
    Assessor, Circumstances, Envelope, EnvelopeSurvey, PlannedLandmark, Rehearsal,
};

use super::arguments::Arguments;
use super::ground::Ground;

/// Circumstances in which landmarks are looked for on the plan.
pub fn circumstances(ground: &Ground) -> Circumstances {
    let settings = &ground.mission.navigator;
    Circumstances {
        camera: ground.camera.clone(),
        height: ground.height,
        position: Rehearsal::POSITION,
        sensors: settings.sensors,
        detector: settings.detector,
        ground_down: ground.plan.as_ref().map_or(0.0, |p| p.ground_down),
        tilt: 0.0,
    }
}

/// From which heights and with which tilts each landmark is found.
pub fn envelopes(arguments: &Arguments, ground: &Ground) -> Vec<Envelope> {
    let days = ground.days.spread(EnvelopeSurvey::DAYS, arguments.seed);
    let enabled = ground.mission.landmarks.iter().filter(|l| l.enabled);
    enabled
        .map(|landmark| {
            let map = Arc::clone(&ground.map);
            let assessor =
                Assessor::new(landmark, map, &days, circumstances(ground), arguments.seed);
            let mut survey = EnvelopeSurvey::usual(assessor);
            while survey.advance() {}
            let envelope = survey.envelope().clone();
            println!(
                "{}: height, then found of looks at tilts of {:?} degrees",
                landmark.name,
                EnvelopeSurvey::TILTS
            );
            for (row, height) in envelope.heights.iter().enumerate() {
                let cells = (0..envelope.tilts.len()).filter_map(|tilt| envelope.at(row, tilt));
                let cells: Vec<String> =
                    cells.map(|c| format!("{}/{}", c.found, c.looks)).collect();
                println!("{height:8.0} m  {}", cells.join("  "));
            }
            envelope
        })
        .collect()
}

/// Measures each landmark over the map.
pub fn expected(arguments: &Arguments, ground: &Ground, ground_down: f64) -> Vec<PlannedLandmark> {
    let days = Rehearsal::days(ground.days.as_ref(), arguments.seed);
    let mut landmarks = Vec::new();
    for landmark in ground.mission.landmarks.iter().filter(|l| l.enabled) {
        let circumstances = Circumstances {
            ground_down,
            ..circumstances(ground)
        };
        let map = Arc::clone(&ground.map);
        let begun = std::time::Instant::now();
        let mut assessor = Assessor::new(landmark, map, &days, circumstances, arguments.seed);
        assessor.rehearse();
        let expected = assessor.expected();
        println!(
            "{:24} found {}, false {:.3}, {:.1} s",
            landmark.name,
            expected.map_or_else(
                || "never: it does not fit into the picture".to_owned(),
                |e| format!("{:.2}", e.probability())
            ),
            assessor.false_matches(),
            begun.elapsed().as_secs_f64()
        );
        landmarks.push(PlannedLandmark {
            landmark: landmark.clone(),
            detection: assessor.statistics(),
        });
    }
    landmarks
}
