//! The camera and the correlation against OpenCV.

use nalgebra::{Point2, Point3};
use pilotage_core::camera::{CameraModel, Distortion, Mount};
use pilotage_core::frames::{Attitude, Pose};
use pilotage_core::raster::{Gray, Template};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

/// Uniform numbers from a seed (`SplitMix64`), so that every run asks the same question.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / 18_446_744_073_709_551_616.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

#[derive(Serialize)]
struct Projections {
    cases: Vec<Projection>,
}

#[derive(Serialize)]
struct Projection {
    camera_from_world: [[f64; 3]; 3],
    position: [f64; 3],
    focal: f64,
    principal: [f64; 2],
    distortion: [f64; 5],
    point: [f64; 3],
}

fn any_camera(random: &mut Uniform) -> CameraModel {
    let mut camera = CameraModel::pinhole(640, 480, random.between(0.6, 1.3));
    camera.principal = Point2::new(random.between(300.0, 340.0), random.between(220.0, 260.0));
    camera.distortion = Distortion {
        k1: random.between(-0.3, 0.2),
        k2: random.between(-0.05, 0.1),
        p1: random.between(-0.005, 0.005),
        p2: random.between(-0.005, 0.005),
        k3: random.between(-0.02, 0.02),
    };
    camera.mount = Mount {
        roll: random.between(-0.2, 0.2),
        pitch: random.between(-0.1, 0.6),
        yaw: random.between(-3.0, 3.0),
    };
    camera
}

fn any_pose(random: &mut Uniform) -> Pose {
    Pose {
        position_in_world: Point3::new(
            random.between(-2000.0, 2000.0),
            random.between(-2000.0, 2000.0),
            -random.between(30.0, 1000.0),
        ),
        attitude: Attitude {
            roll: random.between(-0.6, 0.6),
            pitch: random.between(-0.4, 0.4),
            yaw: random.between(-3.2, 3.2),
        },
    }
}

#[test]
fn a_thousand_points_fall_on_the_pixels_of_opencv() {
    let mut random = Uniform(2016);
    let mut cases = Vec::new();
    let mut expected = Vec::new();
    while cases.len() < 1000 {
        let (camera, pose) = (any_camera(&mut random), any_pose(&mut random));
        // A point in view or a little outside, nearer or farther than the ground.
        let pixel = Point2::new(random.between(-40.0, 680.0), random.between(-40.0, 520.0));
        let ray = camera.camera_from_world(&pose).inverse() * camera.ray_in_camera(&pixel);
        let point = pose.position_in_world + ray * random.between(5.0, 2000.0);
        let Some(projected) = camera.project(&pose, &point) else {
            continue; // Beyond the fold of a strong distortion there is no answer to compare.
        };
        let rotation = camera.camera_from_world(&pose);
        let d = camera.distortion;
        cases.push(Projection {
            camera_from_world: std::array::from_fn(|r| std::array::from_fn(|c| rotation[(r, c)])),
            position: pose.position_in_world.into(),
            focal: camera.focal,
            principal: camera.principal.into(),
            distortion: [d.k1, d.k2, d.p1, d.p2, d.k3],
            point: point.into(),
        });
        expected.push(projected);
    }
    let Some(answer) = ask::<_, Vec<[f64; 2]>>("opencv_project.py", &Projections { cases }) else {
        return;
    };
    let furthest = expected
        .iter()
        .zip(&answer)
        .map(|(ours, &theirs)| (ours - Point2::from(theirs)).norm())
        .fold(0.0, f64::max);
    println!("furthest of {} pixels: {furthest:.1e} px", answer.len());
    assert!(furthest < 1e-6, "{furthest} px");
}

#[derive(Serialize)]
struct Matches {
    cases: Vec<Match>,
    repeat: usize,
}

#[derive(Serialize)]
struct Match {
    width: usize,
    height: usize,
    search: Vec<f32>,
    template_width: usize,
    template_height: usize,
    template: Vec<f32>,
}

#[derive(Deserialize)]
struct Matched {
    surface: Vec<f64>,
}

fn texture(width: usize, height: usize, random: &mut Uniform) -> Gray {
    Gray::from_fn(width, height, |x, y| {
        let wave = (x as f64 * 0.31).sin() + (y as f64 * 0.17).cos();
        (128.0 + 40.0 * wave + random.between(-40.0, 40.0)) as f32
    })
}

#[test]
fn surfaces_of_the_navigators_sizes_are_those_of_opencv() {
    let mut random = Uniform(4);
    let mut cases = Vec::new();
    let mut expected = Vec::new();
    for (template, search) in [
        (16, 48),
        (24, 64),
        (24, 128),
        (32, 96),
        (48, 160),
        (64, 200),
        (96, 256),
    ] {
        let search = texture(search, search - 7, &mut random);
        let patch = texture(template, template + 3, &mut random);
        expected.push(Template::new(&patch).unwrap().correlate(&search));
        cases.push(Match {
            width: search.width(),
            height: search.height(),
            search: search.pixels().to_vec(),
            template_width: patch.width(),
            template_height: patch.height(),
            template: patch.pixels().to_vec(),
        });
    }
    let question = Matches { cases, repeat: 1 };
    let Some(answer) = ask::<_, Vec<Matched>>("opencv_match.py", &question) else {
        return;
    };
    for (ours, theirs) in expected.iter().zip(&answer) {
        assert_eq!(ours.pixels().len(), theirs.surface.len());
        let furthest = ours
            .pixels()
            .iter()
            .zip(&theirs.surface)
            .map(|(&a, &b)| (f64::from(a) - b).abs())
            .fold(0.0, f64::max);
        println!(
            "{} × {}: furthest {furthest:.1e}",
            ours.width(),
            ours.height()
        );
        assert!(furthest < 1e-5, "{furthest}");
    }
}
