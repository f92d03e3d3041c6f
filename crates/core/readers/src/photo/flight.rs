//! The flight that a folder of photos tells of.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use nalgebra::Point3;

use super::camera::focal_in_pixels;
use super::lenses::of_one_lens;
use super::log::log;
use super::place::PhotoPlace;
use super::pose::{by_gimbal, photo_pose};
use super::read::{Photo, read_photo};
use super::tabled::{PhotoRows, are_of_a_table, fill};
use super::timed::TimedPhoto;
use crate::folder::{FlightFolder, FlightOrigin, FolderFrames};
use crate::times::most_told_era;
use pilotage_base::files::FileSet;
use pilotage_base::frames::{Attitude, Geodetic, GroundPoint, LocalFrame, wrap_pi};
use pilotage_base::text::by_count;
use pilotage_flight::{Channel, ChannelName, Flight, Frame, StartFix, Truth, TruthState};
use pilotage_raster::camera::{CameraModel, UNSTATED_MOUNT_DEVIATION};

/// Fewest photos that make a flight.
const FEWEST: usize = 2;
/// Most photos that are named in a note.
const NAMED: usize = 5;
/// Standard deviation per axis of the position of a photo, metres.
const GPS_DEVIATION: f64 = 5.0;

/// The flight of the photos among the files that say where they were taken; `None` if there are fewer than two, or if a
/// table tells of most.
///
/// Frames are the photos in the order of their times, counted in seconds from the first. Heading, pitch and roll are
/// those of the camera where it tells them (zero looks straight down with the picture's top forward), else those of
/// the aircraft. World is the tangent plane at the first photo, the ground where the aircraft took off. The track
/// of the photos counts as the truth: it is what there is, and no better than it.
pub fn read_photos(files: &Arc<dyn FileSet>) -> Option<FlightFolder> {
    flight_of_photos(files, None)
}

/// The same of photos whose places stand in tables beside them: of those that do not say themselves where they were taken,
/// `rows` tell it.
pub fn read_tabled_photos(files: &Arc<dyn FileSet>, rows: &PhotoRows) -> Option<FlightFolder> {
    flight_of_photos(files, Some(rows))
}

fn flight_of_photos(files: &Arc<dyn FileSet>, rows: Option<&PhotoRows>) -> Option<FlightFolder> {
    let mut notes = Vec::new();
    let photos = photos(files.as_ref(), rows, &mut notes);
    let (first, origin) = photos.iter().find_map(|p| Some((p, p.photo.place?)))?;
    if photos.iter().filter(|p| p.photo.place.is_some()).count() < FEWEST {
        return None;
    }
    let altitude = origin.altitude.unwrap_or(0.0);
    let take_off = altitude - first.photo.height_above_take_off.unwrap_or(0.0);
    let frame = LocalFrame::new(Geodetic {
        latitude: origin.latitude,
        longitude: origin.longitude,
        height: take_off,
    });
    let mut camera = camera(&photos[0].photo, &mut notes);
    if !tell_gimbal(&photos) {
        camera.mount_deviation = UNSTATED_MOUNT_DEVIATION;
    }
    let states = states(&photos, &frame);
    let start = states.first()?;
    let start = StartFix {
        time: start.time,
        position: GroundPoint::new(start.position.x, start.position.y),
        standard_deviation: GPS_DEVIATION,
    };
    let frames = photos.iter().map(|p| Frame {
        time: p.time,
        name: p.photo.name.clone(),
        stored_turn: 0.0,
    });
    let flight = Flight {
        name: name(&photos[0].photo.name),
        frame_on_globe: Some(frame),
        camera,
        ground_down: 0.0,
        channels: channels(&photos, &states, &mut notes),
        frames: frames.collect(),
        start,
        truth: Some(Truth {
            states,
            frames: Vec::new(),
        }),
    };
    tell(&photos, &mut notes);
    let names = flight
        .frames
        .iter()
        .map(|frame| frame.name.clone())
        .collect();
    let log = log(&flight.name, &photos, &flight.channels);
    Some(FlightFolder {
        told: FlightOrigin::Log(Box::new(log)),
        frames: FolderFrames::new(Arc::clone(files), vec![String::new()], "", names),
        flight,
        notes,
    })
}

/// Photos of one size, camera and lens, in the order of their times, with the places that `rows` of tables tell.
fn photos(
    files: &dyn FileSet,
    rows: Option<&PhotoRows>,
    notes: &mut Vec<String>,
) -> Vec<TimedPhoto> {
    let mut names = files.names();
    names.retain(|name| is_photo(name) || is_png(name));
    names.sort();
    let mut photos = Vec::new();
    let mut unread = Vec::new();
    let is_told = |name: &str, photo: Option<&Photo>| {
        let is_in_table = || rows.is_some_and(|rows| rows.0.contains_key(name));
        photo.is_some_and(|photo| photo.place.is_some() || is_in_table())
    };
    for name in &names {
        match files.source(name).map(|source| read_photo(source.as_ref())) {
            // A PNG without a place is some other picture: a map, a screen.
            Some(read) if is_png(name) && !is_told(name, read.as_ref().ok()) => {}
            Some(Ok(photo)) => photos.push(Photo {
                name: name.clone(),
                ..photo
            }),
            Some(Err(cause)) => unread.push(cause.to_string()),
            None => {}
        }
    }
    if let Some(first) = unread.first() {
        let them = match unread.len() {
            1 => "a file".to_owned(),
            more => format!("{more} files"),
        };
        notes.push(format!("{them} could not be read as photos: {first}"));
    }
    match rows {
        Some(rows) => fill(&mut photos, rows, notes),
        None if are_of_a_table(&names, &photos, files) => return Vec::new(),
        None => {}
    }
    // Most photos decide, if enough of them are placed.
    let mut sizes: BTreeMap<(usize, usize), (usize, usize)> = BTreeMap::new();
    for photo in &photos {
        let (placed, all) = sizes.entry((photo.width, photo.height)).or_default();
        *placed += usize::from(photo.place.is_some());
        *all += 1;
    }
    let enough = sizes
        .into_iter()
        .filter(|(_, (placed, _))| *placed >= FEWEST);
    let Some((size, _)) = enough.max_by_key(|(_, (_, all))| *all) else {
        return Vec::new();
    };
    let is_unplaced = |it: &&Photo| (it.width, it.height) != size && it.place.is_none();
    let unplaced = photos.iter().filter(is_unplaced).count();
    of_one_size(&mut photos, size, "photos", notes);
    if unplaced > 0 {
        notes.push(format!(
            "{unplaced} of the photos left out {} taken; a table of names, places, heights and \
             headings beside them (CSV) would make them a flight",
            by_count(
                unplaced,
                "does not say where it was",
                "do not say where they were"
            )
        ));
    }
    of_one_camera(&mut photos, notes);
    of_one_lens(&mut photos, "the photos", notes);
    timed(photos, notes)
}

/// Leaves out the photos of another size (width and height in pixels) with a note that calls all of them `what`.
pub(super) fn of_one_size(
    photos: &mut Vec<Photo>,
    size: (usize, usize),
    what: &str,
    notes: &mut Vec<String>,
) {
    let total = photos.len();
    photos.retain(|photo| (photo.width, photo.height) == size);
    if photos.len() < total {
        notes.push(format!(
            "{} of {total} {what} {} of another size than {} x {} and {} left out",
            total - photos.len(),
            by_count(total - photos.len(), "is", "are"),
            size.0,
            size.1,
            by_count(total - photos.len(), "was", "were")
        ));
    }
}

/// Why the photos among files are no flight, in words with the tags that lack; `None` without photos.
pub fn photos_lack(files: &dyn FileSet) -> Option<String> {
    let mut names = files.names();
    names.retain(|name| is_photo(name));
    names.sort();
    let read = |name: &String| read_photo(files.source(name)?.as_ref()).ok();
    let photos: Vec<Photo> = names.iter().filter_map(read).collect();
    let first = names.first()?;
    let placed = photos.iter().filter(|photo| photo.place.is_some()).count();
    Some(if photos.is_empty() {
        format!(
            "none of {} photos can be read: {first} and so on",
            names.len()
        )
    } else if placed < FEWEST {
        format!(
            "{placed} of {} photos say where they were taken, and two have to: they lack the EXIF tags GPSLatitude and \
             GPSLongitude (or have 0, 0 in them), and XMP has no place either",
            names.len()
        )
    } else {
        "no two photos of one size and one camera say where they were taken".to_owned()
    })
}

/// Leaves the photos of the camera that took most of them, and says which others there are.
fn of_one_camera(photos: &mut Vec<Photo>, notes: &mut Vec<String>) {
    let mut cameras: BTreeMap<&str, usize> = BTreeMap::new();
    for photo in photos.iter().filter(|photo| !photo.camera.is_empty()) {
        *cameras.entry(&photo.camera).or_default() += 1;
    }
    let most = cameras.iter().max_by_key(|(_, count)| **count);
    let Some(most) = most.map(|(camera, _)| (*camera).to_owned()) else {
        return;
    };
    let others: Vec<String> = cameras
        .iter()
        .filter(|(camera, _)| **camera != most)
        .map(|(camera, count)| format!("{count} by {camera}"))
        .collect();
    if others.is_empty() {
        return;
    }
    notes.push(format!(
        "the photos are those of {most}; others were left out: {}. Put them into a folder of their own to open them",
        others.join(", ")
    ));
    photos.retain(|photo| photo.camera.is_empty() || photo.camera == most);
}

pub(super) fn is_photo(name: &str) -> bool {
    ends_in(name, &["jpg", "jpeg"])
}

fn is_png(name: &str) -> bool {
    ends_in(name, &["png"])
}

fn ends_in(name: &str, endings: &[&str]) -> bool {
    let file = name.rsplit('/').next().unwrap_or(name);
    let ending = file.rsplit('.').next().unwrap_or_default();
    let is_one = endings.iter().any(|e| ending.eq_ignore_ascii_case(e));
    // What macOS leaves in zips begins with a dot.
    is_one && !file.starts_with('.')
}

fn timed(photos: Vec<Photo>, notes: &mut Vec<String>) -> Vec<TimedPhoto> {
    let seconds = photos.iter().filter_map(|photo| photo.taken);
    let era = most_told_era(seconds.map(|(whole, _)| whole as f64));
    let is_of_era = |photo: &Photo| {
        era.is_none_or(|(a, b)| {
            photo
                .taken
                .is_none_or(|(t, _)| (a..=b).contains(&(t as f64)))
        })
    };
    let (photos, strays): (Vec<Photo>, Vec<Photo>) = photos.into_iter().partition(is_of_era);
    if let Some(stray) = strays.first() {
        notes.push(format!(
            "{} {}",
            strays.len(),
            match strays.len() {
                1 => format!("photo was left out, as it says to be taken on another day than the rest: {}", stray.name),
                _ => format!(
                    "photos were left out, as they say to be taken on other days than the rest: {} and so on",
                    stray.name
                ),
            }
        ));
    }
    let first = photos
        .iter()
        .filter_map(|photo| photo.taken)
        .min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let Some(first) = first else {
        notes.push(
            "no photo says when it was taken: they count as a second apart, by name".to_owned(),
        );
        let numbered = photos.into_iter().enumerate();
        return numbered
            .map(|(i, photo)| TimedPhoto {
                time: i as f64,
                photo,
            })
            .collect();
    };
    let total = photos.len();
    let since = |photo: &Photo| {
        let (whole, fraction) = photo.taken?;
        Some(whole.saturating_sub(first.0) as f64 + (fraction - first.1))
    };
    let timed = photos.into_iter().filter_map(|photo| {
        Some(TimedPhoto {
            time: since(&photo)?,
            photo,
        })
    });
    let mut timed: Vec<TimedPhoto> = timed.collect();
    if timed.len() < total {
        notes.push(format!(
            "{} of {total} photos {} left out",
            total - timed.len(),
            by_count(
                total - timed.len(),
                "does not say when it was taken and was",
                "do not say when they were taken and were"
            )
        ));
    }
    timed.sort_by(|a, b| a.time.total_cmp(&b.time));
    spread_seconds(&mut timed, notes);
    timed
}

/// Photos taken within the same second by a clock of whole seconds are spread over it.
fn spread_seconds(photos: &mut [TimedPhoto], notes: &mut Vec<String>) {
    let has_fractions = photos
        .iter()
        .any(|p| p.photo.taken.is_some_and(|(_, part)| part != 0.0));
    if has_fractions {
        return;
    }
    let mut spread = 0;
    for group in photos.chunk_by_mut(|a, b| a.time == b.time) {
        let count = group.len();
        for (i, photo) in group.iter_mut().enumerate().skip(1) {
            photo.time += i as f64 / count as f64;
            spread += 1;
        }
    }
    if spread > 0 {
        notes.push(format!(
            "the camera's clock counts whole seconds: {spread} {} spread over it",
            by_count(
                spread,
                "photo was taken in the same second as another and is",
                "photos were taken in the same second as another and are"
            )
        ));
    }
}

fn name(photo: &str) -> String {
    let folder = photo.rsplit_once('/').map_or("", |(folder, _)| folder);
    let folder = folder.rsplit('/').next().unwrap_or_default();
    let name = if folder.is_empty() { "Photos" } else { folder };
    name.to_owned()
}

pub(super) fn camera(photo: &Photo, notes: &mut Vec<String>) -> CameraModel {
    let (focal, whence) = focal_in_pixels(photo);
    let camera = CameraModel::of_focal(photo.width, photo.height, focal);
    notes.push(format!(
        "the focal length of {focal:.0} pixels ({:.0}° across) is {whence}",
        camera.horizontal_fov().to_degrees()
    ));
    camera
}

fn states(photos: &[TimedPhoto], frame: &LocalFrame) -> Vec<TruthState> {
    let mut states: Vec<TruthState> = Vec::new();
    for TimedPhoto { time, photo } in photos {
        let Some(PhotoPlace {
            latitude,
            longitude,
            altitude,
        }) = photo.place
        else {
            continue;
        };
        let height = photo
            .height_above_take_off
            .or(altitude.map(|a| a - frame.origin.height));
        let ground = frame.ground_from_geodetic(&Geodetic {
            latitude,
            longitude,
            height: frame.origin.height,
        });
        let is_later = states.last().is_none_or(|last| *time > last.time);
        if is_later {
            states.push(TruthState {
                time: *time,
                position: Point3::new(ground.north, ground.east, -height.unwrap_or(0.0)),
                attitude: None,
                wind: None,
            });
        }
    }
    states
}

fn channels(photos: &[TimedPhoto], states: &[TruthState], notes: &mut Vec<String>) -> Vec<Channel> {
    let series = |name: ChannelName, value: &dyn Fn(&Photo) -> Option<f64>| {
        let samples = photos
            .iter()
            .filter_map(|p| Some((p.time, value(&p.photo)?)));
        let (times, values): (Vec<f64>, Vec<f64>) = samples.unzip();
        (!times.is_empty()).then_some(Channel {
            name,
            times,
            values,
        })
    };
    let track = |name: ChannelName, part: fn(&Point3<f64>) -> f64| Channel {
        name,
        times: states.iter().map(|s| s.time).collect(),
        values: states.iter().map(|s| part(&s.position)).collect(),
    };
    let mut channels = vec![
        track(ChannelName::GpsNorth, |p| p.x),
        track(ChannelName::GpsEast, |p| p.y),
    ];
    channels.extend(series(ChannelName::GpsHeight, &|p| p.place?.altitude));
    let height = series(ChannelName::HeightAboveGround, &|p| p.height_above_take_off);
    if height.is_none() {
        notes.push("no photo says how high it was taken above the ground".to_owned());
    }
    channels.extend(height);
    let of_gimbal = tell_gimbal(photos);
    // Zero angles of a gimbal say nothing, but that there is one: the camera does not roll with the aircraft.
    let is_blank = !of_gimbal && photos.iter().any(|p| p.photo.is_gimbal_blank);
    let attitude = |photo: &Photo| {
        if of_gimbal {
            by_gimbal(photo)
        } else {
            photo.aircraft.map(|aircraft| {
                let told = photo_pose(photo);
                Attitude {
                    roll: told.roll,
                    pitch: told.pitch,
                    ..aircraft
                }
            })
        }
    };
    let heading = series(ChannelName::Heading, &|p| {
        let yaw = attitude(p).map(|a| a.yaw);
        let yaw = if of_gimbal { yaw } else { yaw.or(p.direction) };
        yaw.map(wrap_pi)
    });
    notes.push(match (of_gimbal, &heading) {
        (true, _) => "heading, pitch and roll are those of the camera's gimbal".to_owned(),
        (false, Some(_)) if is_blank => "the gimbal's angles are all zero and do not count: the heading is that of \
                                         the aircraft, and the camera is taken to look straight down"
            .to_owned(),
        (false, Some(_)) => {
            "heading, pitch and roll are those of the aircraft, to which the camera counts as \
                             fixed, looking straight down"
                .to_owned()
        }
        (false, None) => "no photo says which way it was turned".to_owned(),
    });
    channels.extend(heading);
    channels.extend(series(ChannelName::Pitch, &|p| Some(attitude(p)?.pitch)));
    channels.extend(series(ChannelName::Roll, &|p| {
        Some(wrap_pi(attitude(p)?.roll))
    }));
    channels
}

/// Whether any photo tells the angles of its camera's gimbal.
fn tell_gimbal(photos: &[TimedPhoto]) -> bool {
    photos.iter().any(|p| p.photo.gimbal.is_some())
}

/// The first of some names.
fn some(names: &[&str]) -> String {
    let more = if names.len() > NAMED { ", …" } else { "" };
    names[..names.len().min(NAMED)].join(", ") + more
}

/// Says what else people should know.
fn tell(photos: &[TimedPhoto], notes: &mut Vec<String>) {
    let count = |is: &dyn Fn(&Photo) -> bool| photos.iter().filter(|p| is(&p.photo)).count();
    let total = photos.len();
    let nowhere = photos.iter().filter(|p| p.photo.place.is_none());
    let nowhere: Vec<&str> = nowhere.map(|p| p.photo.name.as_str()).collect();
    if !nowhere.is_empty() {
        notes.push(format!(
            "{} of {total} photos {} taken: {}",
            nowhere.len(),
            by_count(
                nowhere.len(),
                "does not say where it was",
                "do not say where they were"
            ),
            some(&nowhere)
        ));
    }
    let mut doubts: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for photo in photos.iter().map(|p| &p.photo) {
        for doubt in &photo.doubts {
            doubts.entry(doubt).or_default().push(&photo.name);
        }
    }
    for (doubt, names) in doubts {
        notes.push(format!(
            "{} of {total} photos: {doubt}: {}",
            names.len(),
            some(&names)
        ));
    }
    let oblique = count(&|p| {
        p.gimbal
            .is_some_and(|g| (g.pitch + FRAC_PI_2).abs() > 0.1 * PI)
    });
    if oblique > 0 {
        notes.push(format!(
            "{oblique} of {total} photos {} far from straight down",
            by_count(oblique, "looks", "look")
        ));
    }
    let turned = count(&|p| p.orientation != 1);
    if turned > 0 {
        notes.push(format!(
            "{turned} of {total} photos {} stored",
            by_count(
                turned,
                "is marked as to be turned for people: it is taken as it is",
                "are marked as to be turned for people: they are taken as they are"
            )
        ));
    }
    let saved = photos.iter().filter(|p| p.photo.saved_again_by.is_some());
    let saved: Vec<&TimedPhoto> = saved.collect();
    if let Some(program) = saved.first().and_then(|p| p.photo.saved_again_by.as_ref()) {
        notes.push(format!(
            "{} of {total} photos {} saved again by {program}, which may have turned {} heading",
            saved.len(),
            by_count(saved.len(), "was", "were"),
            by_count(saved.len(), "it against its", "them against their")
        ));
    }
}
