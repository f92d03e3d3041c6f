//! Looks at landmarks in photos of which registration says where they were taken.

use nalgebra::{Matrix2, Point3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::photos::{Photo, Site};
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_raster::imagery::Imagery;
use pilotage_vision::landmark::{
    Detection, Detector, FrameView, Landmark, Refusal, SearchRequest, Sighting,
};
use pilotage_vision::registration::{
    FrameLook, HeadingPrior, MapShape, PosePrior, StoredTurn, register,
};

/// Pixels beyond the edge of the picture.
const OUTSIDE: f64 = 150.0;

/// Metres from which on a place is another's.
pub const ELSEWHERE: f64 = 8.0;

/// A photo and the pose that registration found for it, which stands for the truth.
pub struct RegisteredPhotoTruth<'a> {
    pub photo: &'a Photo,
    pub pose: Pose,
}

/// Uncertainty about a photo when a landmark is looked for in it; standard deviations.
#[derive(Clone, Copy)]
pub struct Doubt {
    /// Metres per axis.
    pub position: f64,
    /// Radians.
    pub heading: f64,
    /// Of the natural logarithm of the height above ground.
    pub log_height: f64,
    /// Of roll and of pitch, radians.
    pub tilt: f64,
}

/// Uncertainty of a filter that works, with a consumer drone's compass and barometer.
pub const TRACKING: Doubt = Doubt {
    position: 5.0,
    heading: 4.0 * std::f64::consts::PI / 180.0,
    log_height: 0.04,
    tilt: std::f64::consts::PI / 180.0,
};

/// Look at a landmark that lies whole in the photo.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    pub landmark: u32,
    pub sighting: Sighting,
    /// (north, east) from where registration says that it is to where it was found, metres.
    pub error: Option<nalgebra::Vector2<f64>>,
}

impl Seen {
    pub fn off(&self) -> f64 {
        self.error.map_or(f64::INFINITY, |e| e.norm())
    }

    /// Square of the error over the stated covariance.
    fn square(&self) -> Option<f64> {
        let covariance: Matrix2<f64> = self
            .sighting
            .best()?
            .covariance
            .fixed_view::<2, 2>(0, 0)
            .into();
        let error = self.error?;
        Some((error.transpose() * covariance.try_inverse()? * error)[0])
    }

    pub fn accepted(&self) -> Option<Detection> {
        match self.sighting {
            Sighting::Found(detection) => Some(detection),
            Sighting::Refused(..) => None,
        }
    }
}

/// Registers every photo; those that cannot be are left out.
pub fn laid(site: &Site) -> Vec<RegisteredPhotoTruth<'_>> {
    let lay = |photo| {
        let look = look_at(site, photo);
        let found = register(&look, &prior(photo)).ok()?;
        Some(RegisteredPhotoTruth {
            photo,
            pose: found.fit.at.pose,
        })
    };
    site.photos.iter().filter_map(lay).collect()
}

fn look_at<'a>(site: &'a Site, photo: &'a Photo) -> FrameLook<'a> {
    FrameLook {
        camera: &photo.camera,
        ground_down: 0.0,
        luminance: &photo.luminance,
        map: &site.map,
    }
}

fn prior(photo: &Photo) -> PosePrior {
    PosePrior {
        position: photo.below,
        position_deviation: 10.0,
        anywhere_on: None,
        height: photo.height,
        log_height_deviation: 0.05,
        heading: HeadingPrior::Around {
            heading: photo.heading,
            deviation: 6_f64.to_radians(),
            stored: StoredTurn::None,
        },
        roll: 0.0,
        pitch: photo.pitch,
        tilt_deviation: 3_f64.to_radians(),
        slope_deviation: 3_f64.to_radians(),
        shape: MapShape::default(),
        shape_deviation: 1e-6,
        map_deviation: 3.0,
    }
}

/// Boxes of `side` metres all over the map, `step` metres apart.
pub fn boxes(map: &dyn Imagery, side: f64, step: f64) -> Vec<Landmark> {
    let bounds = map.bounds();
    let count = |length: f64| ((length - side) / step).floor() as u32 + 1;
    let (rows, columns) = (count(bounds.height()), count(bounds.width()));
    (0..rows * columns)
        .map(|number| {
            let (row, column) = (number / columns, number % columns);
            let center = GroundPoint::new(
                bounds.north - 0.5 * side - step * f64::from(row),
                bounds.west + 0.5 * side + step * f64::from(column),
            );
            let bounds = GroundRect::centered(center, side, side);
            Landmark::new(number, "box", bounds)
        })
        .collect()
}

/// The pose that somebody assumes who knows no better than `doubt`.
fn assumed(laid: &RegisteredPhotoTruth<'_>, doubt: &Doubt, random: &mut ChaCha8Rng) -> Pose {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    let mut pose = laid.pose;
    pose.position_in_world.x += doubt.position * normal();
    pose.position_in_world.y += doubt.position * normal();
    pose.position_in_world.z *= (doubt.log_height * normal()).exp();
    pose.attitude.yaw += doubt.heading * normal();
    pose.attitude.roll += doubt.tilt * normal();
    pose.attitude.pitch += doubt.tilt * normal();
    pose
}

/// Choice of the landmarks that are looked for in a photo.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// Those that it shows whole.
    Whole,
    /// Those of which it does not show the middle, but would if it were a little larger.
    JustOutside,
}

/// Whether the middle of a landmark lies out of the picture, by no more than [`OUTSIDE`].
fn is_just_outside(laid: &RegisteredPhotoTruth<'_>, landmark: &Landmark) -> bool {
    let middle = landmark.bounds.center();
    let point = Point3::new(middle.north, middle.east, 0.0);
    let pixel = laid.photo.camera.project(&laid.pose, &point);
    pixel.is_some_and(|p| {
        laid.photo.camera.in_picture(&p, -OUTSIDE) && !laid.photo.camera.in_picture(&p, 0.0)
    })
}

/// Looks for landmarks in every photo.
pub fn look(
    laid: &[RegisteredPhotoTruth<'_>],
    landmarks: &[Landmark],
    detector: &mut dyn Detector,
    doubt: &Doubt,
    seed: u64,
    which: Which,
) -> Vec<Seen> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut all = Vec::new();
    for laid in laid {
        let camera = &laid.photo.camera;
        let margin = 0.02 * camera.height as f64;
        for landmark in landmarks {
            let is_asked = match which {
                Which::Whole => camera.holds(&laid.pose, &landmark.bounds, 0.0, margin),
                Which::JustOutside => is_just_outside(laid, landmark),
            };
            if !is_asked {
                continue;
            }
            let view = FrameView {
                camera,
                pose: assumed(laid, doubt, &mut random),
                ground_down: 0.0,
                luminance: &laid.photo.luminance,
            };
            let height = -view.pose.position_in_world.z;
            let middle = landmark.bounds.center();
            let Some(expected) = camera
                .project(&laid.pose, &Point3::new(middle.north, middle.east, 0.0))
                .and_then(|pixel| camera.ground_at(&view.pose, &pixel, 0.0))
            else {
                continue;
            };
            let arm = middle.distance(&GroundPoint::from(laid.pose.position_in_world.xy().coords));
            let variance = doubt.position.powi(2)
                + (doubt.tilt * height).powi(2)
                + arm.powi(2) * (0.5 * doubt.heading.powi(2) + 0.5 * doubt.log_height.powi(2));
            let request = SearchRequest {
                landmark,
                displacement_covariance: Matrix2::identity() * variance,
                turn_deviation: doubt.heading,
                log_scale_deviation: doubt.log_height,
            };
            let sighting = detector.detect(&view, &request);
            let error = sighting
                .best()
                .map(|d| d.ground.to_vector() - expected.to_vector());
            all.push(Seen {
                landmark: landmark.id,
                sighting,
                error,
            });
        }
    }
    all
}

/// Outcome of looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tally {
    pub looks: usize,
    pub accepted: usize,
    /// Accepted, and farther off than was allowed.
    pub wrong: usize,
    /// Mean squared error of those accepted and right, over their stated covariance, per degree of freedom.
    pub nees: f64,
}

impl Tally {
    /// Share of the looks.
    pub fn share(&self) -> f64 {
        self.accepted as f64 / self.looks.max(1) as f64
    }
}

/// Counts looks, with places that are farther off than `limit` metres for wrong ones, and prints them.
pub fn tally(name: &str, looks: &[Seen], limit: f64) -> Tally {
    let accepted: Vec<&Seen> = looks.iter().filter(|s| s.accepted().is_some()).collect();
    let right = accepted.iter().filter(|s| s.off() <= limit);
    let squares: Vec<f64> = right.filter_map(|s| s.square()).collect();
    let tally = Tally {
        looks: looks.len(),
        accepted: accepted.len(),
        wrong: accepted.iter().filter(|s| s.off() > limit).count(),
        nees: squares.iter().sum::<f64>() / (2 * squares.len()).max(1) as f64,
    };
    let within = |limit: f64| accepted.iter().filter(|s| s.off() <= limit).count();
    println!(
        "{name}: accepted {} of {} ({:.1} %), of these {} within 3 m, {} within 5 m, {} within 8 m; \
         NEES per degree of freedom {:.2}",
        tally.accepted,
        tally.looks,
        100.0 * tally.share(),
        within(3.0),
        within(5.0),
        within(8.0),
        tally.nees
    );
    for reason in Refusal::ALL {
        let of_it = |s: &&Seen| matches!(s.sighting, Sighting::Refused(r, _) if r == reason);
        let refused: Vec<&Seen> = looks.iter().filter(of_it).collect();
        if !refused.is_empty() {
            let right = refused.iter().filter(|s| s.off() <= limit).count();
            println!(
                "  {} {}, the best place right in {right}",
                reason.key(),
                refused.len()
            );
        }
    }
    tally
}
