use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::label_grid::label_grid;
use super::*;
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::Raster;
use pilotage_simulate::simulate::scenery::{SceneKind, SceneLabel};
use pilotage_vision::ground_class::GroundCover;

fn square(kind: SceneKind, north: f64, east: f64, half: f64) -> SceneLabel {
    let at = |n: f64, e: f64| GroundPoint::new(north + n * half, east + e * half);
    SceneLabel {
        kind,
        name: None,
        polygon: vec![at(1.0, 1.0), at(1.0, -1.0), at(-1.0, -1.0), at(-1.0, 1.0)],
    }
}

#[test]
fn labels_lie_over_each_other_as_things_do() {
    let grid = Window {
        north_edge: 30.0,
        west_edge: 0.0,
        gsd: 1.5,
        width: 20,
        height: 20,
    };
    let labels = [
        square(SceneKind::Tree, 15.0, 15.0, 3.0),
        square(SceneKind::Building, 15.0, 15.0, 6.0),
        square(SceneKind::Track, 15.0, 27.0, 1.5),
    ];
    let cells = label_grid(&labels, &grid);
    let at = |north: f64, east: f64| {
        let (x, y) = grid.pixel_at(&GroundPoint::new(north, east));
        cells[y as usize * 20 + x as usize]
    };
    assert_eq!(at(15.1, 15.1), Some(GroundCover::Tree));
    assert_eq!(at(20.0, 15.1), Some(GroundCover::Building));
    assert_eq!(at(25.0, 15.1), Some(GroundCover::Open));
    assert_eq!(at(15.1, 27.1), None);
    let roofs = cells.iter().filter(|c| **c == Some(GroundCover::Building));
    assert_eq!(roofs.count(), 8 * 8 - 4 * 4);
}

/// A tile of gray roofs in green grass.
fn roofs(seed: u64) -> LabelledTile {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut covers = vec![Some(GroundCover::Open); 50 * 50];
    for _ in 0..6 {
        let (column, row) = (random.random_range(0..42), random.random_range(0..42));
        for r in row..row + 8 {
            covers[r * 50 + column..][..8].fill(Some(GroundCover::Building));
        }
    }
    let picture = Raster::from_fn(100, 100, |x, y| {
        let noise = random.random_range(0..40);
        if covers[y / 2 * 50 + x / 2] == Some(GroundCover::Building) {
            [130 + noise / 4, 125 + noise / 4, 120 + noise / 4, 255]
        } else {
            [70 + noise, 95 + noise, 50 + noise, 255]
        }
    });
    LabelledTile { picture, covers }
}

#[test]
fn a_network_learns_two_classes_and_its_probabilities_are_true_elsewhere() {
    let mut examples = ClassExamples::drawn_by(1);
    for seed in 0..8 {
        examples.add(&roofs(seed));
    }
    let training = ClassTraining {
        rounds: 12,
        ..ClassTraining::default()
    };
    let mut losses = Vec::new();
    let network = training.train(&examples, &mut |_, loss| losses.push(loss));
    let network = network.unwrap();
    assert!(losses[11] < 0.3 * losses[0], "{losses:?}");
    let mut judgement = CoverJudgement::default();
    judgement.add(&roofs(100), &network);
    assert!(judgement.accuracy() > 0.97, "{judgement}");
    assert!(judgement.calibration_error() < 0.03, "{judgement}");
    // The same from the same seed.
    assert_eq!(training.train(&examples, &mut |_, _| ()), Ok(network));
}

#[test]
fn a_class_with_a_handful_of_examples_is_refused() {
    let mut examples = ClassExamples::drawn_by(1);
    examples.add(&roofs(1));
    examples.covers[0] = GroundCover::Water;
    let refused = ClassTraining::default().train(&examples, &mut |_, _| ());
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .contains("1 examples of water")
    );
}
