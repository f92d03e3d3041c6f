//! Tests of `suggest`.

use super::*;
use crate::poses::poses_over;

fn candidate(north: f64, east: f64, margin: f64) -> LandmarkCandidate {
    let place = GroundPoint::new(north, east);
    LandmarkCandidate {
        bounds: GroundRect::centered(place, 30.0, 30.0),
        score: 0.8,
        rival: 0.3,
        rival_place: GroundPoint::new(north + 40.0, east),
        margin,
        drift: 0.1,
        probability: margin,
        range: [margin; 2],
    }
}

#[test]
fn a_second_landmark_is_chosen_where_the_route_has_none_and_not_beside_the_first() {
    let path = [GroundPoint::new(0.0, 0.0), GroundPoint::new(1200.0, 0.0)];
    let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
    let frames = poses_over(&path, 120.0, 20.0, 0.0);
    let offered = [
        candidate(200.0, 0.0, 0.4),
        candidate(240.0, 0.0, 0.39),
        candidate(800.0, 10.0, 0.2),
        candidate(500.0, 900.0, 0.5),
    ];
    let chosen = choose(&offered, &camera, &frames, 0.0, 4);
    let middles: Vec<f64> = chosen
        .iter()
        .map(|s| s.candidate.bounds.center().north)
        .collect();
    assert_eq!(middles[..2], [200.0, 800.0], "{chosen:#?}");
    assert!(!middles.contains(&500.0), "it is never in view");
    assert!(chosen[0].in_view > 2.0 && chosen[0].gained > chosen[1].gained - 1e-9);
}

#[test]
fn poses_lie_on_the_path_half_a_second_apart_across_its_corners() {
    let path = [(0.0, 0.0), (95.0, 0.0), (95.0, 100.0)].map(|(n, e)| GroundPoint::new(n, e));
    let poses = poses_over(&path, 100.0, 20.0, 0.0);
    assert_eq!(poses.len(), 20);
    assert!(
        poses
            .windows(2)
            .all(|p| (p[1].0 - p[0].0 - 0.5).abs() < 1e-9)
    );
    let last = poses[19].1;
    assert!((last.position_in_world.y - 95.0).abs() < 1e-9, "{last:?}");
}

#[test]
fn the_longest_in_view_gives_way_to_two_that_cover_the_route_between_them() {
    let path = [GroundPoint::new(0.0, 0.0), GroundPoint::new(150.0, 0.0)];
    let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
    let frames = poses_over(&path, 120.0, 2.0, 0.0);
    let offered = [75.0, 30.0, 120.0].map(|north| candidate(north, 0.0, 0.8));
    let middles = |count: usize| -> Vec<f64> {
        let chosen = choose_lasting(&offered, &camera, &frames, 0.0, 0.0, count);
        let mut norths: Vec<f64> = chosen
            .iter()
            .map(|s| s.candidate.bounds.center().north)
            .collect();
        norths.sort_by(f64::total_cmp);
        norths
    };
    assert_eq!(middles(1), [75.0], "the one longest in view");
    assert_eq!(middles(2), [30.0, 120.0]);
}

#[test]
fn the_last_frame_of_a_flight_counts_too() {
    let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
    let path = [GroundPoint::new(0.0, 0.0), GroundPoint::new(400.0, 0.0)];
    let poses = poses_over(&path, 120.0, 20.0, 0.0);
    let frames = [poses[0], poses[poses.len() - 1]];
    let offered = [candidate(400.0, 0.0, 0.8)];
    let chosen = choose_lasting(&offered, &camera, &frames, 0.0, 0.0, 1);
    assert_eq!(chosen.len(), 1, "it is in the last picture only");
}

#[test]
fn a_fix_fades_at_once_where_nothing_is_known_of_the_way() {
    let mut settings = NavigatorSettings::default();
    assert_eq!(fading(&settings), FADING);
    settings.vehicle = VehicleChoice::RandomWalk;
    settings.process.position = 6.0;
    assert!(fading(&settings) < 0.2);
}
