//! Photos beside a log, put in time by what the log says of its camera.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::flight::{camera, is_photo, of_one_size};
use super::lenses::of_one_lens;
use super::read::{Photo, read_photo};
use super::triggers::triggers;
use crate::folder::FolderFrames;
use crate::log::Log;
use pilotage_base::files::FileSet;
use pilotage_base::text::by_count;
use pilotage_flight::{Flight, Frame, FrameSource};

/// Seconds by which a camera's clock, which counts whole ones, may be off from the log's at a photo.
const CLOCK: f64 = 1.0;
/// Photos whose times are tried as that of any event.
const TRIED: usize = 3;
/// Share of the photos, or of the events if they are fewer, that have to fall on one another by the camera's clock; and of
/// as many as by that shift another may reach.
const MOST: f64 = 0.9;

/// Photos that were put in time beside a log.
pub struct PlacedPhotos {
    /// Their pictures, in the order of the flight's frames; `None` if they were left out.
    pub frames: Option<Box<dyn FrameSource>>,
    /// Notes on assumptions, or on the reason why they were left out, in sentences.
    pub notes: Vec<String>,
}

/// Puts the photos among the files into the flight of `log` at the times at which the log says that its camera took
/// them: `CAM` or `TRIG`, `camera_capture` or `camera_trigger`, `CAMERA_IMAGE_CAPTURED`, `CAMERA_FEEDBACK` or `CAMERA_TRIGGER`.
/// `None` if it tells of none, or no photos are there.
///
/// Where photos tell their own times, the camera's clock is laid on the log's; else as many photos as events belong together
/// in order, and so do those whose numbers reach from the first event to the last. Otherwise nothing tells which photo
/// is which, and they are left out with a note.
pub fn add_photos(
    log: &Log,
    flight: &mut Flight,
    files: &Arc<dyn FileSet>,
) -> Option<PlacedPhotos> {
    let triggers = triggers(log)?;
    let mut notes = Vec::new();
    let photos = photos(files.as_ref(), &mut notes);
    let first = photos.first()?;
    let events = &triggers.times;
    let (count, source) = (events.len(), &triggers.source);
    let Some((order, how)) = matched(&photos, events) else {
        notes.push(format!(
            "the {} photos beside the log were left out: it tells of {count} ({source}), and nothing says which photo is \
             which. Remove those that were not taken in this flight, or give their times in frames.csv",
            photos.len()
        ));
        return Some(PlacedPhotos {
            frames: None,
            notes,
        });
    };
    notes.push(format!(
        "{} {} beside the log {} put in time by its {count} {} of {source}, {how}",
        order.len(),
        by_count(order.len(), "photo", "photos"),
        by_count(order.len(), "was", "were"),
        by_count(count, "event", "events")
    ));
    flight.camera = camera(first, &mut notes);
    let frames = order.iter().map(|(photo, event)| Frame {
        time: events[*event],
        name: photos[*photo].name.clone(),
        stored_turn: 0.0,
    });
    flight.frames = frames.collect();
    let names = flight.frames.iter().map(|frame| frame.name.clone());
    let frames = FolderFrames::new(Arc::clone(files), vec![String::new()], "", names.collect());
    Some(PlacedPhotos {
        frames: Some(Box::new(frames)),
        notes,
    })
}

/// The photos among files that have the size and the lens of most, in the order in which they were taken as far as that is told: by their
/// times if all have one, else by the numbers in their names.
fn photos(files: &dyn FileSet, notes: &mut Vec<String>) -> Vec<Photo> {
    let mut names = files.names();
    names.retain(|name| is_photo(name));
    let read = |name: String| {
        let photo = read_photo(files.source(&name)?.as_ref()).ok()?;
        Some(Photo { name, ..photo })
    };
    let mut photos: Vec<Photo> = names.into_iter().filter_map(read).collect();
    let mut sizes: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for photo in &photos {
        *sizes.entry((photo.width, photo.height)).or_default() += 1;
    }
    let most = sizes.into_iter().max_by_key(|(_, count)| *count);
    let Some((size, _)) = most else {
        return photos;
    };
    of_one_size(&mut photos, size, "photos beside the log", notes);
    of_one_lens(&mut photos, "the photos beside the log", notes);
    photos.sort_by(|a, b| (folder(a), number(a), &a.name).cmp(&(folder(b), number(b), &b.name)));
    if let Some(seconds) = clock(&photos) {
        let mut order: Vec<(f64, Photo)> = seconds.into_iter().zip(photos).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        return order.into_iter().map(|(_, photo)| photo).collect();
    }
    photos
}

fn folder(photo: &Photo) -> &str {
    photo.name.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// The last number in the name of a photo's file.
fn number(photo: &Photo) -> Option<u64> {
    let stem = photo.name.rsplit('/').next()?.rsplit_once('.')?.0;
    let end = stem.rfind(|letter: char| letter.is_ascii_digit())? + 1;
    let digits = stem[..end].bytes().rev().take_while(u8::is_ascii_digit);
    stem[end - digits.count()..end].parse().ok()
}

/// Seconds by the clock of the camera, from the first photo on; `None` unless all photos tell them, and not one and the same.
fn clock(photos: &[Photo]) -> Option<Vec<f64>> {
    let taken: Option<Vec<(i64, f64)>> = photos.iter().map(|photo| photo.taken).collect();
    let taken = taken?;
    let first = taken.iter().map(|(whole, _)| *whole).min()?;
    let seconds = |(whole, part): &(i64, f64)| whole.saturating_sub(first) as f64 + part;
    let seconds: Vec<f64> = taken.iter().map(seconds).collect();
    let is_told = seconds.iter().any(|s| (s - seconds[0]).abs() > CLOCK);
    is_told.then_some(seconds)
}

/// Pairs of a photo and an event by their places, and how they were found, in words.
type Matched = (Vec<(usize, usize)>, &'static str);

/// Pairs of a photo and its event; `None` if nothing decides that.
fn matched(photos: &[Photo], events: &[f64]) -> Option<Matched> {
    let seconds = clock(photos);
    let by_clock = seconds.as_ref().and_then(|times| by_clock(times, events));
    if photos.len() == events.len() {
        let in_order: Vec<(usize, usize)> = (0..photos.len()).map(|i| (i, i)).collect();
        return Some(match (&seconds, by_clock) {
            (None, _) => (in_order, "in order: they are as many"),
            (Some(_), Some(found)) if found.len() == photos.len() => (
                found,
                "in order: they are as many, and the camera's clock agrees",
            ),
            (Some(_), _) => (
                in_order,
                "in order: they are as many, though by their own times they were not taken then",
            ),
        });
    }
    if let Some(found) = by_clock {
        return Some((found, "by the camera's clock, laid on the log's"));
    }
    // Some were removed, and the numbers of the others tell which.
    let numbers: Option<Vec<u64>> = photos.iter().map(number).collect();
    let numbers = numbers.filter(|_| seconds.is_none())?;
    let first = *numbers.first()?;
    let is_growing = numbers.windows(2).all(|w| w[1] > w[0]);
    let reach = numbers.last()?.checked_sub(first)?.checked_add(1)?;
    if !is_growing || reach != events.len() as u64 {
        return None;
    }
    let pairs = numbers.iter().enumerate();
    let pairs = pairs.map(|(photo, number)| (photo, (number - first) as usize));
    Some((
        pairs.collect(),
        "by the numbers in their names, which reach from the first event to the last",
    ))
}

/// Pairs by the shift of the camera's clock (`photos`, seconds in order) with which nearly all photos, or nearly all events,
/// fall on one another; `None` without such a shift, or if another does nearly as well.
fn by_clock(photos: &[f64], events: &[f64]) -> Option<Vec<(usize, usize)>> {
    let fewer = photos.len().min(events.len()) as f64;
    let mut tried: Vec<(usize, f64)> = Vec::new();
    for photo in photos.iter().take(TRIED) {
        for event in events {
            let shift = event - photo;
            tried.push((pairs(photos, events, shift).len(), shift));
        }
    }
    let (best, shift) = *tried.iter().max_by(|a, b| a.0.cmp(&b.0))?;
    // The middle of what is left over is nearer than the first photo alone.
    let mut left: Vec<f64> = pairs(photos, events, shift)
        .iter()
        .map(|(photo, event)| events[*event] - photos[*photo])
        .collect();
    let middle = left.len() / 2;
    let shift = *left.select_nth_unstable_by(middle, f64::total_cmp).1;
    let found = pairs(photos, events, shift);
    let is_other = |(count, other): &(usize, f64)| {
        (other - shift).abs() > 2.0 * CLOCK && *count as f64 > MOST * found.len() as f64
    };
    let is_good = best >= 2 && found.len() as f64 >= MOST * fewer;
    (is_good && !tried.iter().any(is_other)).then_some(found)
}

/// Photos and events within [`CLOCK`] of each other if the camera's clock is `shift` seconds behind, each once and in
/// order.
fn pairs(photos: &[f64], events: &[f64], shift: f64) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut next = 0;
    for (photo, time) in photos.iter().enumerate() {
        let time = time + shift;
        next += events[next..].partition_point(|event| *event < time - CLOCK);
        let is_near = |event: &f64| (event - time).abs() <= CLOCK;
        let Some(_) = events.get(next).filter(|event| is_near(event)) else {
            continue;
        };
        // Of several the nearest.
        let nearer = |at: usize| {
            let (this, other) = (events.get(at), events.get(at + 1));
            this.zip(other)
                .is_some_and(|(a, b)| (b - time).abs() < (a - time).abs())
        };
        while nearer(next) {
            next += 1;
        }
        found.push((photo, next));
        next += 1;
    }
    found
}
