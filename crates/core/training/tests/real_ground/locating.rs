//! Photos placed by the table of a map.

use nalgebra::{Matrix2, Matrix4, Point2, Point3, Vector4};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::photos::{RealPhoto, RealSite};
use crate::tally::FixTally;
use pilotage_base::frames::Pose;
use pilotage_reference::association::CommonError;
use pilotage_reference::seeing::PictureView;
use pilotage_reference::{GenericClass, GenericLandmark, ReferenceTable};
use pilotage_vision::ground_class::CoverNetwork;

/// Error of the believed position per axis, metres.
pub const POSITION: f64 = 10.0;
/// Errors of roll and pitch, and of a yaw within 15°, radians.
pub const TILT: f64 = 0.035;
pub const YAW: f64 = 0.15;
/// Relative error of the height.
pub const LOG_HEIGHT: f64 = 0.05;
/// Farthest that the ground of a photo is from below the aircraft, metres.
const IN_PHOTO: f64 = 150.0;

/// The pose that is believed of a photo: as wrong as is said, its position by `deviation` metres per axis.
pub fn believed_pose(photo: &RealPhoto, deviation: f64, random: &mut ChaCha8Rng) -> Pose {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    let mut believed = photo.pose;
    believed.position_in_world.x += deviation * normal();
    believed.position_in_world.y += deviation * normal();
    believed.position_in_world.z *= 1.0 + LOG_HEIGHT * normal();
    believed.attitude.yaw += random.random_range(-15.0_f64..15.0).to_radians();
    believed
}

/// Errors that all landmarks of a photo share.
pub fn common(believed: &Pose) -> CommonError {
    let height = -believed.position_in_world.z;
    let deviations = Vector4::new(TILT, TILT, YAW, LOG_HEIGHT * height);
    CommonError {
        position: Matrix2::identity() * POSITION * POSITION,
        pose: Matrix4::from_diagonal(&deviations.component_mul(&deviations)),
    }
}

/// Number of landmarks that lie by the photo's own pose where the table has one like them.
fn in_table(
    photo: &RealPhoto,
    believed: &Pose,
    seen: &[GenericLandmark],
    table: &ReferenceTable,
) -> usize {
    let is_there = |landmark: &&GenericLandmark| {
        let point = Point3::new(landmark.place.north, landmark.place.east, 0.0);
        let pixel = photo.camera.project(believed, &point);
        let place = pixel.and_then(|pixel| photo.camera.ground_at(&photo.pose, &pixel, 0.0));
        place.is_some_and(|place| {
            table.near(place, 6.0).any(|other| {
                other.class == landmark.class && (other.size / landmark.size).ln().abs() < 0.7
            })
        })
    };
    seen.iter().filter(is_there).count()
}

/// Each photo of a place by the landmarks of its map.
pub fn locate(site: &RealSite, table: &ReferenceTable, network: &CoverNetwork) -> FixTally {
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let mut tally = FixTally::default();
    let (mut all, mut there) = (0, 0);
    for photo in &site.photos {
        let believed = believed_pose(photo, POSITION, &mut random);
        let view = PictureView::of(&photo.camera, &believed, 0.0, &photo.picture, network).unwrap();
        let told: Vec<_> = view.seen.iter().filter_map(|l| view.observed(l)).collect();
        let around = table.near(view.below(), IN_PHOTO + 3.5 * POSITION);
        let around: Vec<_> = around.copied().collect();
        let found = view.associated(&told, &around, common(&believed));
        all += view.seen.len();
        there += in_table(photo, &believed, &view.seen, table);
        let half = |pixels: usize| 0.5 * pixels as f64;
        let middle = Point2::new(half(photo.picture.width()), half(photo.picture.height()));
        let assumed = photo.camera.ground_at(&believed, &middle, 0.0).unwrap();
        let in_middle = GenericLandmark {
            place: assumed,
            class: GenericClass::Tree,
            size: 1.0,
            orientation: 0.0,
            confidence: 1.0,
            stability: 1.0,
        };
        let by_pose = view.observed(&in_middle).unwrap();
        let fix = found.fix.map(|fix| {
            let (shift, covariance) = fix.shift(&by_pose.by_pose);
            let error = assumed.to_vector() + shift - photo.middle.to_vector();
            (error, covariance)
        });
        tally.add(&photo.name, found.probability, fix);
    }
    println!(
        "{}: {all} landmarks seen, {there} of them where the table has one like them; {tally}",
        site.name
    );
    tally
}
