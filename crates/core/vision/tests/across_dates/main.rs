//! Photos laid on maps of other dates and other sensors: what the program is for.
//!
//! Nothing was fitted to these sets but the temperature of the evidence (`evidence.rs`), to which they are not
//! sensitive. `cargo test -p pilotage-vision --test across_dates -- --nocapture` prints every photo.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

mod maps;
mod photos;

use photos::studies::either;
use photos::{Photo, Site};
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Imagery;
use pilotage_vision::registration::{
    FrameLook, HeadingPrior, MapShape, NotRegistered, PosePrior, Registration, StoredTurn, register,
};

/// Uncertainty about a photo; deviations.
#[derive(Clone, Copy)]
struct Doubt {
    /// Metres per axis; the photo is looked for around a place this far off.
    position: f64,
    /// Radians; `None`: nothing is known.
    heading: Option<f64>,
    log_height: f64,
}

/// By how much the two maps differ in the median, as the data say: 5 pixels to the left and 11 up on the map of March;
/// metres, north and east. It is not the same everywhere ([`maps`]).
const SHIFT: nalgebra::Vector2<f64> = nalgebra::Vector2::new(11.0 * 0.243, -5.0 * 0.243);

/// `± limit`, as a deviation of what is searched to 2.5 of them.
fn within(limit: f64) -> f64 {
    limit / 2.5
}

/// Outcome of a photo.
struct Outcome {
    name: String,
    /// Error of the ground in the middle of the picture, (north, east), metres, by what the file says.
    error: Option<nalgebra::Vector2<f64>>,
    result: Result<Registration, NotRegistered>,
}

impl Outcome {
    fn off(&self) -> f64 {
        self.error.map_or(f64::INFINITY, |e| e.norm())
    }
}

/// Lays every `each`-th photo for itself.
fn lay(site: &Site, doubt: Doubt, each: usize) -> Vec<Outcome> {
    let mut outcomes = Vec::new();
    for (index, photo) in site.photos.iter().enumerate().step_by(each) {
        let look = FrameLook {
            camera: &photo.camera,
            ground_down: 0.0,
            luminance: &photo.luminance,
            map: &site.map,
        };
        // Every way in turn; the golden angle spreads them.
        let way = 2.399_963 * index as f64;
        let begun = std::time::Instant::now();
        let result = register(&look, &prior(photo, doubt, way));
        let error = result
            .as_ref()
            .ok()
            .map(|r| r.centre.to_vector() - photo.centre.to_vector());
        let told = match &result {
            Ok(r) => format!("{:?}, probability {:.5}", r.laid_by, r.probability),
            Err(cause) => cause.to_string(),
        };
        let outcome = Outcome {
            name: photo.name.clone(),
            error,
            result,
        };
        println!(
            "{}: {:.1} m off; {told}; {:.0} ms",
            outcome.name,
            outcome.off(),
            begun.elapsed().as_secs_f64() * 1e3
        );
        outcomes.push(outcome);
    }
    outcomes
}

/// Number of photos, of every `each`-th, that are believed on a map of another country, and the highest
/// probability.
fn believed_elsewhere(photos: &Site, map: &Site, each: usize) -> (usize, f64) {
    let doubt = Doubt {
        position: 150.0,
        heading: None,
        log_height: within(0.15),
    };
    let bounds = map.map.bounds();
    let (mut believed, mut highest) = (0, 0.0_f64);
    for photo in photos.photos.iter().step_by(each) {
        let look = FrameLook {
            camera: &photo.camera,
            ground_down: 0.0,
            luminance: &photo.luminance,
            map: &map.map,
        };
        let anywhere = PosePrior {
            position: bounds.center(),
            ..prior(photo, doubt, 0.0)
        };
        let probability = match register(&look, &anywhere) {
            Ok(found) => {
                believed += 1;
                found.probability
            }
            Err(cause) => cause.probability(),
        };
        highest = highest.max(probability);
    }
    (believed, highest)
}

fn prior(photo: &Photo, doubt: Doubt, way: f64) -> PosePrior {
    PosePrior {
        position: GroundPoint::new(
            photo.below.north + doubt.position * way.cos(),
            photo.below.east + doubt.position * way.sin(),
        ),
        position_deviation: doubt.position,
        anywhere_on: None,
        height: photo.height,
        log_height_deviation: doubt.log_height,
        heading: doubt
            .heading
            .map_or(HeadingPrior::Unknown, |deviation| HeadingPrior::Around {
                heading: photo.heading,
                deviation,
                stored: StoredTurn::None,
            }),
        roll: 0.0,
        pitch: photo.pitch,
        tilt_deviation: 3_f64.to_radians(),
        slope_deviation: 3_f64.to_radians(),
        shape: MapShape::default(),
        shape_deviation: 0.02,
        map_deviation: 3.0,
    }
}

/// Number of photos that lie within so many metres, and number that are believed and lie farther off than 20
/// m.
fn tally(outcomes: &[Outcome], metres: f64) -> (usize, usize) {
    let near = outcomes.iter().filter(|o| o.off() < metres).count();
    let wrong = outcomes
        .iter()
        .filter(|o| o.result.is_ok() && o.off() > 20.0)
        .count();
    println!(
        "{near} of {} within {metres} m, {wrong} wrong",
        outcomes.len()
    );
    (near, wrong)
}

/// Number of frames, of every `each`-th, that lie on two maps at one place within 3 m, the local shift between the maps
/// taken away.
fn at_one_place([january, march]: [&Site; 2], [one, two]: [&[Outcome]; 2], each: usize) -> usize {
    let (mut same, mut by_median, mut both) = (0, 0, 0);
    let photos = january.photos.iter().step_by(each);
    for ((a, b), photo) in one.iter().zip(two).zip(photos) {
        let Some((a, b)) = a.error.zip(b.error) else {
            continue;
        };
        let apart = b - a;
        let moved = maps::shift_between(&january.map, &march.map, photo.centre).unwrap_or(SHIFT);
        println!(
            "{}: {:.1} m apart where the maps differ by {:.1} m north and {:.1} m east",
            photo.name,
            (apart - moved).norm(),
            moved.x,
            moved.y
        );
        both += 1;
        same += usize::from((apart - moved).norm() < 3.0);
        by_median += usize::from((apart - SHIFT).norm() < 3.0);
    }
    println!(
        "laid on both {both}, at one place {same}; {by_median} by the median shift of the maps"
    );
    same
}

#[test]
fn every_photo_over_a_town_is_found_with_a_rough_heading_and_its_covariance_is_honest() {
    let Some(site) = photos::fengyuan() else {
        return;
    };
    let doubt = Doubt {
        position: 10.0,
        heading: Some(within(15_f64.to_radians())),
        log_height: within(0.12),
    };
    let outcomes = lay(&site, doubt, 1);
    assert_eq!(tally(&outcomes, 15.0), (30, 0));
    let nees = outcomes.iter().map(|o| {
        let found = o.result.as_ref().unwrap();
        let error = o.error.unwrap();
        let information = found.centre_covariance.try_inverse().unwrap();
        0.5 * (error.transpose() * information * error)[0]
    });
    let nees = nees.sum::<f64>() / outcomes.len() as f64;
    println!("NEES per degree of freedom {nees:.2}");
    assert!((0.7..1.5).contains(&nees), "{nees}");
}

#[test]
fn photos_over_a_town_are_found_with_a_compass_forty_degrees_off() {
    let Some(site) = photos::fengyuan() else {
        return;
    };
    let doubt = Doubt {
        position: 40.0,
        heading: Some(within(40_f64.to_radians())),
        log_height: within(0.15),
    };
    let each = either(2, 1);
    let outcomes = lay(&site, doubt, each);
    let (near, wrong) = tally(&outcomes, 15.0);
    assert!(near + 1 >= outcomes.len() && wrong == 0, "{near}, {wrong}");
}

#[test]
fn photos_over_a_town_are_found_anywhere_on_the_map_with_no_heading() {
    let Some(site) = photos::fengyuan() else {
        return;
    };
    let doubt = Doubt {
        position: 200.0,
        heading: None,
        log_height: within(0.15),
    };
    let outcomes = lay(&site, doubt, 3);
    let (near, wrong) = tally(&outcomes, 15.0);
    assert!(near >= 8 && wrong == 0, "{near}, {wrong}");
}

#[test]
fn frames_over_fields_and_river_lie_at_one_place_on_maps_of_two_dates() {
    let Some((january, march)) = photos::adm("map_january").zip(photos::adm("map_march")) else {
        return;
    };
    let doubt = Doubt {
        position: 10.0,
        heading: Some(within(15_f64.to_radians())),
        // As far as photos are searched where nobody says otherwise: the stated height is not the one above ground.
        log_height: within(0.2),
    };
    let each = either(2, 1);
    let (one, two) = (lay(&january, doubt, each), lay(&march, doubt, each));
    let same = at_one_place([&january, &march], [&one, &two], each);
    for outcomes in [&one, &two] {
        // Its own navigation is off by 12 m for nine in ten.
        let (_, wrong) = tally(outcomes, 15.0);
        assert_eq!(wrong, 0);
    }
    let both = one.iter().zip(&two);
    let both = both
        .filter(|(a, b)| a.result.is_ok() && b.result.is_ok())
        .count();
    let (least, most_apart) = either((26, 2), (52, 4));
    assert!(
        same >= least && both - same <= most_apart,
        "{same} of {both}"
    );
}

#[test]
fn a_map_of_another_country_does_not_show_a_photo() {
    let Some((town, fields)) = photos::fengyuan().zip(photos::adm("map_january")) else {
        return;
    };
    for (photos, map, each) in [
        (&town, &fields, either(6, 3)),
        (&fields, &town, either(8, 4)),
    ] {
        let (believed, highest) = believed_elsewhere(photos, map, each);
        println!("{believed} believed, the highest probability is {highest:.3}");
        assert!(believed == 0 && highest < 0.9, "{believed} {highest}");
    }
}
