//! Cascades against plain computations and hand-made pictures.

use super::*;
use pilotage_raster::raster::Raster;

/// A picture with structure in all directions.
fn picture(width: usize, height: usize) -> Raster<u8> {
    Raster::from_fn(width, height, |x, y| {
        let wave =
            (x as f64 * 0.41).sin() * 60.0 + (y as f64 * 0.23 + x as f64 * 0.11).cos() * 50.0;
        (128.0 + wave + ((x * 37 + y * 91 + x * y * 11) % 31) as f64) as u8
    })
}

fn pixel(picture: &Raster<u8>, x: i32, y: i32) -> f64 {
    let x = x.clamp(0, picture.width() as i32 - 1) as usize;
    f64::from(picture.get(x, y.clamp(0, picture.height() as i32 - 1) as usize))
}

/// The definition, pixel by pixel.
fn plain_hog(picture: &Raster<u8>, at: (i32, i32), [x, y, w, h]: Area, component: u8) -> f64 {
    let (wanted_cell, wanted_direction) = (i32::from(component / 9), i32::from(component % 9));
    let (mut own, mut all) = (0.0, 0.0);
    for j in 0..2 * h {
        for i in 0..2 * w {
            let (px, py) = (at.0 + x + i, at.1 + y + j);
            let dx = pixel(picture, px + 1, py) - pixel(picture, px - 1, py);
            let dy = pixel(picture, px, py + 1) - pixel(picture, px, py - 1);
            let turns = dy.atan2(dx) * 9.0 / std::f64::consts::PI - 0.5;
            let direction = (turns.floor() as i32).rem_euclid(9);
            all += dx.hypot(dy);
            if (i / w + 2 * (j / h), direction) == (wanted_cell, wanted_direction) {
                own += dx.hypot(dy);
            }
        }
    }
    if own > 0.001 {
        own / (all + 0.001)
    } else {
        0.0
    }
}

fn hog_features() -> Vec<CascadeFeature> {
    let cells = [[0, 0, 8, 8], [4, 2, 4, 7], [3, 1, 6, 5], [1, 0, 7, 8]];
    let components = 0..36;
    components
        .flat_map(|component| cells.map(|cell| CascadeFeature::Hog { cell, component }))
        .collect()
}

fn haar_features() -> Vec<CascadeFeature> {
    let haar = |areas, tilted| CascadeFeature::Haar(HaarFeature { areas, tilted });
    vec![
        haar(
            [
                ([0, 0, 16, 16], -1.0),
                ([4, 4, 8, 8], 4.0),
                ([1, 0, 1, 1], 0.0),
            ],
            false,
        ),
        haar(
            [
                ([2, 3, 12, 4], -1.0),
                ([2, 3, 4, 4], 3.0),
                ([6, 3, 4, 4], 3.0),
            ],
            false,
        ),
        haar(
            [
                ([7, 1, 6, 5], -1.0),
                ([7, 1, 3, 5], 2.0),
                ([1, 0, 1, 1], 0.0),
            ],
            true,
        ),
    ]
}

fn lbp_features() -> Vec<CascadeFeature> {
    let areas = [[0, 0, 5, 5], [1, 3, 2, 4], [4, 0, 3, 5], [0, 10, 4, 1]];
    areas.map(CascadeFeature::Lbp).to_vec()
}

#[test]
fn hog_values_are_the_shares_that_a_plain_computation_finds() {
    let picture = picture(40, 30);
    let features = hog_features();
    let mut values = vec![0.0; features.len()];
    for at in [(0, 0), (24, 14), (24, 0), (7, 5)] {
        let patch = Patch::cut(&picture, at.0, at.1, 16, 16).unwrap();
        assert!(feature_values(&features, &patch, &mut values));
        for (feature, value) in features.iter().zip(&values) {
            let CascadeFeature::Hog { cell, component } = feature else {
                panic!("these are HOG features");
            };
            let plain = plain_hog(&picture, (at.0 as i32, at.1 as i32), *cell, *component);
            assert!((f64::from(*value) - plain).abs() < 1e-5, "{value} {plain}");
        }
    }
    let shares: f32 = (0..36).map(|c| values[c * 4]).sum();
    assert!((shares - 1.0).abs() < 1e-4, "{shares}");
}

/// A window that looks for an edge upright through the middle of its upper left cell.
fn upright_edge() -> Cascade {
    // The gradient points along x: 170° to 190°, the last direction. The cell below has the other half.
    let feature = CascadeFeature::Hog {
        cell: [0, 0, 8, 8],
        component: 8,
    };
    let stump = TrainedTree::stump(0, NodeSplit::Threshold(0.45), -1.0, 1.0);
    let stage = TrainedStage {
        trees: vec![stump],
        threshold: 0.5,
    };
    Cascade::from_parts(16, 16, vec![feature], &[stage]).unwrap()
}

#[test]
fn one_hog_stump_finds_an_upright_edge_and_no_other() {
    let cascade = upright_edge();
    let upright = Raster::from_fn(60, 40, |x, _| if x < 30 { 40 } else { 200 });
    let found = responses(&cascade, &upright);
    assert_eq!((found.stages.width(), found.stages.height()), (45, 25));
    for x in 0..45 {
        // Columns 29 and 30 have gradients; none may lie in the right cell.
        let inside = (23..=30).contains(&x);
        assert_eq!(found.stages.get(x, 10), u8::from(inside), "column {x}");
        let margin = if inside { 0.5 } else { -1.5 };
        assert!((found.score.get(x, 10) - margin).abs() < 1e-6);
    }
    let slanting = Raster::from_fn(60, 40, |x, y| if x < y + 10 { 40 } else { 200 });
    let level = Raster::from_fn(60, 40, |_, y| if y < 20 { 40 } else { 200 });
    for other in [slanting, level] {
        assert!(
            responses(&cascade, &other)
                .stages
                .pixels()
                .iter()
                .all(|&s| s == 0)
        );
    }
}

/// Every feature as a stump of its own stage, with the value it has at (x, y) as its threshold: at
/// that window no value is less, but the one that is next in size would be.
fn exact_stages(values: &[f32]) -> Vec<TrainedStage> {
    let stumps = values.iter().enumerate().flat_map(|(i, &value)| {
        [
            TrainedTree::stump(i, NodeSplit::Threshold(value), -1.0, 1.0),
            TrainedTree::stump(i, NodeSplit::Threshold(value.next_up()), 1.0, -1.0),
        ]
    });
    let trees: Vec<_> = stumps.collect();
    let threshold = trees.len() as f32 - 0.5;
    vec![TrainedStage { trees, threshold }]
}

#[test]
fn a_patch_has_to_the_bit_the_values_that_the_scan_sees_where_it_was_cut() {
    let picture = picture(50, 44);
    for features in [hog_features(), haar_features()] {
        let evaluator = PatchEvaluator::new(&features, 16, 16);
        let mut values = vec![0.0; features.len()];
        for (x, y) in [(0, 0), (34, 28), (34, 3), (13, 17), (20, 28)] {
            let patch = Patch::cut(&picture, x, y, 16, 16).unwrap();
            assert!(evaluator.values(&patch, &mut values));
            let stages = exact_stages(&values);
            let cascade = Cascade::from_parts(16, 16, features.clone(), &stages).unwrap();
            assert_eq!(responses(&cascade, &picture).stages.get(x, y), 1, "{x} {y}");
        }
    }
}

#[test]
fn a_patch_has_the_codes_that_the_scan_sees() {
    let picture = picture(50, 44);
    let features = lbp_features();
    let evaluator = PatchEvaluator::new(&features, 16, 16);
    let mut codes = vec![0; features.len()];
    for (x, y) in [(0, 0), (34, 28), (13, 17)] {
        let patch = Patch::cut(&picture, x, y, 16, 16).unwrap();
        evaluator.codes(&patch, &mut codes);
        let trees: Vec<_> = codes
            .iter()
            .enumerate()
            .map(|(i, &code)| {
                let mut set = [0; 8];
                set[usize::from(code / 32)] |= 1 << (code % 32);
                TrainedTree::stump(i, NodeSplit::Codes(set), 1.0, -1.0)
            })
            .collect();
        let threshold = trees.len() as f32 - 0.5;
        let stages = [TrainedStage { trees, threshold }];
        let cascade = Cascade::from_parts(16, 16, features.clone(), &stages).unwrap();
        assert_eq!(responses(&cascade, &picture).stages.get(x, y), 1, "{x} {y}");
    }
}

#[test]
fn a_flat_window_is_refused_unseen_by_haar_features_alone() {
    let flat = Raster::filled(20, 20, 77);
    let patch = Patch::cut(&flat, 1, 1, 16, 16).unwrap();
    let mut values = vec![1.0; 3];
    assert!(!feature_values(&haar_features(), &patch, &mut values));
    assert!(values.iter().all(|v| *v == 0.0));
    let mut values = vec![1.0; hog_features().len()];
    assert!(feature_values(&hog_features(), &patch, &mut values));
    assert!(values.iter().all(|v| *v == 0.0));
}

#[test]
fn a_window_larger_than_the_picture_has_no_responses() {
    let found = responses(&upright_edge(), &Raster::filled(15, 40, 0));
    assert!(found.stages.is_empty() && found.score.is_empty());
}

#[test]
fn hog_cascades_are_read_from_opencvs_layout() {
    let xml = r#"<?xml version="1.0"?><opencv_storage>
<cascade type_id="opencv-cascade-classifier"><stageType>BOOST</stageType>
  <featureType>HOG</featureType><height>16</height><width>16</width>
  <stageParams><boostType>GAB</boostType><maxDepth>1</maxDepth></stageParams>
  <featureParams><maxCatCount>0</maxCatCount><featSize>36</featSize></featureParams>
  <stageNum>1</stageNum>
  <stages><_><maxWeakCount>1</maxWeakCount><stageThreshold>0.50001</stageThreshold>
    <weakClassifiers><_><internalNodes>0 -1 0 4.5e-01</internalNodes>
      <leafValues>-1. 1.</leafValues></_></weakClassifiers></_></stages>
  <features><_><rect>0 0 8 8 8</rect></_></features></cascade></opencv_storage>"#;
    assert_eq!(Cascade::read("edge.xml", xml).unwrap(), upright_edge());
    let broken = xml.replace("0 0 8 8 8<", "0 0 8 8 36<");
    let complaint = Cascade::read("edge.xml", &broken).unwrap_err().to_string();
    assert!(complaint.contains("feature 0 / rect") && complaint.contains("component 36"));
}

#[test]
fn what_is_written_reads_as_the_same_cascade() {
    for features in [hog_features(), haar_features()] {
        let values: Vec<f32> = (0..features.len())
            .map(|i| 1.0 / (i as f32 + 3.0))
            .collect();
        let mut stages = exact_stages(&values);
        stages[0].trees.push(TrainedTree {
            nodes: [(2, 1), (0, -1), (-2, -3)]
                .map(|(left, right)| TrainedNode {
                    feature: 1,
                    split: NodeSplit::Threshold(0.125),
                    left,
                    right,
                })
                .to_vec(),
            leaves: vec![0.1, -0.2, 0.3, -0.4],
        });
        let cascade = Cascade::from_parts(16, 16, features, &stages).unwrap();
        assert_eq!(
            Cascade::read("written", &cascade.to_xml()).unwrap(),
            cascade
        );
        assert_eq!(Cascade::from_bytes(&cascade.to_bytes()).unwrap(), cascade);
    }
}

#[test]
fn what_the_former_layout_cannot_say_is_refused() {
    let said = upright_edge().to_former_xml().unwrap_err().to_string();
    assert!(said.contains("Haar features only"), "{said}");
    let node = |left, right| TrainedNode {
        feature: 0,
        split: NodeSplit::Threshold(0.0),
        left,
        right,
    };
    let tree = TrainedTree {
        nodes: vec![node(1, 1), node(0, -1)],
        leaves: vec![0.0; 3],
    };
    let trees = vec![tree];
    let stages = [TrainedStage {
        trees,
        threshold: 0.0,
    }];
    let cascade = Cascade::from_parts(16, 16, haar_features(), &stages).unwrap();
    let said = cascade.to_former_xml().unwrap_err().to_string();
    assert!(said.contains("stage 0, tree 0"), "{said}");
}

/// Trees of three nodes over features and thresholds that part the windows of a picture.
fn forest(features: &[CascadeFeature], picture: &Raster<u8>) -> Vec<TrainedStage> {
    let lbp = matches!(features[0], CascadeFeature::Lbp(_));
    let evaluator = PatchEvaluator::new(features, 16, 16);
    let typical = Patch::cut(picture, 11, 9, 16, 16).unwrap();
    let mut values = vec![0.0; features.len()];
    evaluator.values(&typical, &mut values);
    let split = |feature: usize, salt: u32| {
        if lbp {
            let word = |i: u32| (i + salt).wrapping_mul(2_654_435_761) ^ 0x5a5a_f00f;
            NodeSplit::Codes(std::array::from_fn(|i| word(i as u32)))
        } else {
            NodeSplit::Threshold(values[feature] * 1.01)
        }
    };
    let stage = |number: usize| {
        let trees = (0..5).map(|t| {
            let feature = |n: usize| (number * 7 + t * 3 + n) % features.len();
            let node = |n: usize, left, right| TrainedNode {
                feature: feature(n),
                split: split(feature(n), (t + n) as u32),
                left,
                right,
            };
            if t % 2 == 0 {
                return TrainedTree::stump(feature(0), split(feature(0), 3), -0.31, 0.47);
            }
            TrainedTree {
                nodes: vec![node(0, 1, 2), node(1, 0, -1), node(2, -2, -3)],
                leaves: vec![0.7, -0.3, 0.11, -0.9],
            }
        });
        TrainedStage {
            trees: trees.collect(),
            threshold: -0.4,
        }
    };
    (0..4).map(stage).collect()
}

#[test]
fn many_windows_at_once_are_judged_to_the_bit_as_one_after_the_other() {
    let picture = picture(83, 61);
    let mut passed = 0;
    for features in [hog_features(), haar_features(), lbp_features()] {
        let stages = forest(&features, &picture);
        let cascade = Cascade::from_parts(16, 16, features, &stages).unwrap();
        let found = responses(&cascade, &picture);
        let twin = twin::CascadeView::new(&cascade, &picture);
        let mut by_stage = [0; 5];
        for y in 0..found.stages.height() {
            for x in 0..found.stages.width() {
                let seen = twin.look(x, y);
                assert_eq!(usize::from(found.stages.get(x, y)), seen.passed, "{x} {y}");
                let (ours, theirs) = (found.score.get(x, y), seen.margin as f32);
                assert_eq!(ours.to_bits(), theirs.to_bits(), "{x} {y}");
                by_stage[seen.passed] += 1;
            }
        }
        assert!(
            by_stage.iter().filter(|n| **n > 20).count() >= 3,
            "{by_stage:?}"
        );

        // The scan at scale one sees every other window, and skips behind those refused at once.
        let settings = ScanSettings {
            greatest: (16, 16),
            ..ScanSettings::default()
        };
        let mut wanted = Vec::new();
        for y in (0..found.stages.height()).step_by(2) {
            let mut x = 0;
            while x < found.stages.width() {
                let seen = twin.look(x, y);
                if seen.passed == 4 {
                    wanted.push((x as i32, y as i32, seen.votes.to_bits()));
                } else if seen.passed == 0 && !seen.flat {
                    x += 2;
                }
                x += 2;
            }
        }
        let scanned = scan(&cascade, &picture, &settings);
        let of = |s: &Scanned| (s.rectangle.x, s.rectangle.y, s.score.to_bits());
        assert_eq!(scanned.iter().map(of).collect::<Vec<_>>(), wanted);
        passed += wanted.len();
    }
    assert!(passed > 20, "{passed}");
}

#[test]
fn a_scan_of_a_region_finds_what_lies_in_it_and_a_stride_of_one_misses_nothing() {
    let picture = picture(83, 61);
    let features = haar_features();
    let stages = forest(&features, &picture);
    let cascade = Cascade::from_parts(16, 16, features, &stages).unwrap();
    let everywhere = ScanSettings {
        greatest: (16, 16),
        stride: 1,
        ..ScanSettings::default()
    };
    let all = scan(&cascade, &picture, &everywhere);
    let dense = responses(&cascade, &picture);
    let passed = dense
        .stages
        .pixels()
        .iter()
        .filter(|s| usize::from(**s) == 4)
        .count();
    assert_eq!(all.len(), passed);
    for window in &all {
        let r = window.rectangle;
        let margin = dense.score.get(r.x as usize, r.y as usize);
        assert_eq!(window.margin as f32, margin);
    }
    let region = Rectangle {
        x: 10,
        y: 7,
        width: 50,
        height: 40,
    };
    let settings = ScanSettings {
        region: Some(region),
        ..everywhere
    };
    let inside = |w: &&Scanned| {
        let r = w.rectangle;
        r.x >= 10 && r.y >= 7 && r.x + r.width <= 60 && r.y + r.height <= 47
    };
    let wanted: Vec<_> = all.iter().filter(inside).copied().collect();
    assert!(!wanted.is_empty() && wanted.len() < all.len());
    assert_eq!(scan(&cascade, &picture, &settings), wanted);
    let settings = ScanSettings {
        stride: 3,
        ..everywhere
    };
    let third = |w: &&Scanned| w.rectangle.x % 3 == 0 && w.rectangle.y % 3 == 0;
    let wanted: Vec<_> = all.iter().filter(third).copied().collect();
    assert_eq!(scan(&cascade, &picture, &settings), wanted);
    let settings = ScanSettings {
        spare: 3,
        ..everywhere
    };
    let nearly = scan(&cascade, &picture, &settings);
    let once = dense.stages.pixels().iter().filter(|s| **s >= 1).count();
    assert_eq!(nearly.len(), once);
    assert!(nearly.iter().all(|w| w.stages >= 1) && once > passed);
}
