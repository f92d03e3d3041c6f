//! Frames of a mission of very many named landmarks.

use std::time::{Duration, Instant};

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;
use pilotage_jobs::OpenedFiles;
use pilotage_ui::host::OpenedFile;

use super::reopen::nothing;
use super::support::flight::mission;
use super::support::{Rig, rig};

/// Workspaces with the tabs that are looked at there.
const PLACES: [(&str, &[&str]); 2] = [
    ("Replay", &["Landmarks"]),
    ("Plan", &["Landmarks", "Route"]),
];

/// The invented mission with so many named landmarks more, around a place so many metres to the east.
fn crowded(count: u32, east: f64) -> Rig {
    let mut rig = rig();
    let mut mission = mission();
    let side = f64::from(count).sqrt().ceil();
    let pitch = 1600.0 / side;
    let crowd = (0..count).map(|number| {
        let column = f64::from(number) % side;
        let row = (f64::from(number) / side).floor();
        let place = GroundPoint::new(
            (row - 0.5 * side) * pitch,
            east + (column - 0.5 * side) * pitch,
        );
        let bounds = GroundRect::centered(place, 0.5 * pitch, 0.5 * pitch);
        Landmark::new(100 + number, format!("House {number}"), bounds)
    });
    mission.landmarks.extend(crowd);
    rig.host().opens = Some(OpenedFiles {
        mission: Some(mission),
        ..nothing()
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "crowd.json".to_owned(),
        content: vec![7; 3].into(),
    }]);
    rig.settle();
    let landmarks = rig.state()["landmarks"].as_array().map(Vec::len);
    assert_eq!(landmarks, Some(4 + count as usize));
    rig
}

/// The quickest of some frames: others of the machine may hinder the rest.
fn frame(rig: &mut Rig) -> Duration {
    let frames = (0..12).map(|_| {
        let begun = Instant::now();
        rig.frames(1);
        begun.elapsed()
    });
    frames.min().unwrap_or_default()
}

#[test]
fn frames_of_very_many_landmarks_cost_no_more_than_in_proportion_to_their_number() {
    let mut told = Vec::new();
    for east in [0.0, 20_000.0] {
        let [few, many] = [1000, 10_000].map(|count| {
            let mut rig = crowded(count, east);
            PLACES.map(|(workspace, tabs)| {
                rig.open_tab(workspace);
                rig.settle();
                let mut frame_at = |tab: &&str| {
                    rig.open_tab(tab);
                    rig.frames(4);
                    frame(&mut rig)
                };
                tabs.iter().map(&mut frame_at).collect::<Vec<_>>()
            })
        });
        for (at, (workspace, tabs)) in PLACES.iter().enumerate() {
            for (tab, (few, many)) in tabs.iter().zip(few[at].iter().zip(&many[at])) {
                let words = format!(
                    "{workspace} {tab} {east} m away: {few:?} of 1,000, {many:?} of 10,000"
                );
                println!("{words}");
                told.push((words, *few, *many));
            }
        }
    }
    // Ten times as many; what is compared with each other costs a hundred times as much. A thousand fit into caches.
    for (words, few, many) in told {
        assert!(many < 30 * few, "{words}");
    }
}
