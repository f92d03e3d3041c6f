//! The recorded flight over Brighton Beach is read where its author left it.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

use std::{path::PathBuf, sync::Arc};

use nalgebra::Point3;
use pilotage_core::{
    flight::{
        ChannelName, FlightFolder, FrameSource,
        files::{FileSet, MemoryFiles},
        read_flight,
    },
    frames::Pose,
    imagery::{Georeference, GeoreferencedPicture, Imagery, Window, decode_map},
    raster::{Picture, Raster, Rgba, encode_png},
};
use pilotage_tests::data::{repository, shared};

struct Directory(PathBuf);

impl FileSet for Directory {
    fn names(&self) -> Vec<String> {
        let Ok(entries) = std::fs::read_dir(&self.0) else {
            return Vec::new();
        };
        entries
            .flatten()
            .filter_map(|entry| entry.file_name().into_string().ok())
            .collect()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        std::fs::read(self.0.join(name)).ok()
    }
}

fn flight() -> Option<FlightFolder> {
    shared("brighton_beach")?;
    let folder = repository().join("tests/flights/brighton");
    Some(read_flight(Arc::new(Directory(folder))).unwrap())
}

#[test]
fn eighteen_frames_are_read_with_their_times_headings_and_heights() {
    let Some(folder) = flight() else { return };
    let flight = &folder.flight;
    assert_eq!(flight.frames.len(), 18);
    assert_eq!(flight.frames[0].time, 0.0);
    assert_eq!(flight.frames[6].time, 44.0);
    assert_eq!(flight.frames[17].time, 124.0);
    assert!(folder.notes.is_empty(), "{:?}", folder.notes);
    let attitude = flight.attitude(44.0).unwrap();
    assert!((attitude.yaw.to_degrees() + 140.0).abs() < 1e-9);
    assert!((attitude.pitch.to_degrees() - 0.1).abs() < 1e-9);
    let height = flight.value(ChannelName::HeightAboveGround, 44.0).unwrap();
    assert!((height - 39.9).abs() < 1e-9);
    assert!(flight.channel(ChannelName::Airspeed).is_none());
    let turned = flight.frames.iter().filter(|f| f.stored_turn != 0.0);
    assert_eq!(turned.count(), 6);
}

/// People drop the author's folder; the pictures lie in a folder inside it.
#[test]
fn the_folder_as_it_is_gives_nearly_the_same_flight() {
    let (Some(folder), Some(data)) = (flight(), shared("brighton_beach")) else {
        return;
    };
    let mut files = MemoryFiles::default();
    for entry in [data.clone(), data.join("frames")]
        .iter()
        .flat_map(|d| std::fs::read_dir(d).unwrap().flatten())
        .filter(|e| e.path().is_file())
    {
        let name = entry.path().strip_prefix(&data).unwrap().to_owned();
        let bytes = std::fs::read(entry.path()).unwrap();
        files.0.insert(format!("dropped/{}", name.display()), bytes);
    }
    let mut guessed = read_flight(Arc::new(files)).unwrap();
    assert_eq!(guessed.flight.frames, folder.flight.frames);
    assert_eq!(guessed.flight.truth, folder.flight.truth);
    assert_eq!(guessed.flight.channels, folder.flight.channels);
    assert_eq!(guessed.flight.start, folder.flight.start);
    assert!((guessed.flight.camera.focal / 966.4 - 1.0).abs() < 0.01);
    assert!(guessed.notes[0].contains("no flight.json"));
    assert_eq!(guessed.frames.picture(3).unwrap().width(), 1600);
}

#[test]
fn the_places_of_the_frames_on_the_map_agree_with_satellite_navigation() {
    let Some(folder) = flight() else { return };
    let flight = &folder.flight;
    let truth = flight.truth.as_ref().unwrap();
    assert_eq!(truth.frames.len(), 18);
    for (frame, place) in flight.frames.iter().zip(&truth.frames) {
        let north = flight.value(ChannelName::GpsNorth, frame.time).unwrap();
        let east = flight.value(ChannelName::GpsEast, frame.time).unwrap();
        let distance = (place.position.x - north).hypot(place.position.y - east);
        assert!(distance < 3.0, "{}: {distance} m", frame.name);
        assert!((place.position.z + 40.0).abs() < 0.3);
    }
    let start = flight.start.position;
    assert!((truth.frames[0].position.x - start.north).abs() < 3.0);
    assert!((truth.frames[0].position.y - start.east).abs() < 3.0);
}

fn map(folder: &FlightFolder) -> Option<GeoreferencedPicture> {
    let data = shared("brighton_beach")?;
    let picture = decode_map(&std::fs::read(data.join("ortho.jpg")).unwrap(), true).unwrap();
    let text = std::fs::read_to_string(data.join("ortho_georef.json")).unwrap();
    let georeference = Georeference::from_json(&text).unwrap();
    let frame = folder.flight.frame_on_globe.unwrap();
    let place = georeference
        .in_world(&frame, picture.width(), picture.height())
        .unwrap();
    GeoreferencedPicture::new("ortho", picture, place)
}

/// Frame `index` laid north-up onto `window`, from its true place and its measured attitude.
fn laid_on_the_ground(folder: &mut FlightFolder, index: usize, window: &Window) -> Picture {
    let flight = &folder.flight;
    let frame = &flight.frames[index];
    let mut camera = flight.camera.clone();
    camera.mount.yaw += frame.stored_turn;
    let pose = Pose {
        position_in_world: flight.truth.as_ref().unwrap().frames[index].position,
        attitude: flight.attitude(frame.time).unwrap(),
    };
    let picture = folder.frames.picture(index).unwrap();
    Raster::from_fn(window.width, window.height, |column, row| {
        let ground = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
        let point = Point3::new(ground.north, ground.east, 0.0);
        camera
            .project(&pose, &point)
            .and_then(|pixel| picture.sample(pixel.x, pixel.y))
            .unwrap_or_default()
    })
}

/// Correlation coefficient of the luminance where both have pixels.
fn correlation(a: &Picture, b: &Raster<Rgba>) -> f64 {
    let pairs: Vec<(f64, f64)> = a
        .to_gray()
        .pixels()
        .iter()
        .zip(b.to_gray().pixels())
        .filter(|(a, b)| **a > 0.0 && **b > 0.0)
        .map(|(a, b)| (f64::from(*a), f64::from(*b)))
        .collect();
    let mean =
        |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>() / pairs.len() as f64;
    let (ma, mb) = (mean(&|p| p.0), mean(&|p| p.1));
    let covariance = mean(&|p| (p.0 - ma) * (p.1 - mb));
    let variances = mean(&|p| (p.0 - ma).powi(2)) * mean(&|p| (p.1 - mb).powi(2));
    covariance / variances.sqrt()
}

/// A wrong sign of the yaw, a forgotten half turn or a swapped axis would leave nothing alike.
/// With `PILOTAGE_LOOK` set to a folder, the pairs are written there to be looked at.
#[test]
fn frames_laid_on_the_ground_look_like_the_map_there() {
    let Some(mut folder) = flight() else { return };
    let Some(map) = map(&folder) else { return };
    for index in [8, 14, 16] {
        let center = folder.flight.truth.as_ref().unwrap().frames[index].position;
        let window = Window {
            north_edge: center.x + 12.0,
            west_edge: center.y - 12.0,
            gsd: 0.24,
            width: 100,
            height: 100,
        };
        let frame = laid_on_the_ground(&mut folder, index, &window);
        let seen = map.window(&window);
        let here = correlation(&frame, &seen);
        let moved = Window {
            north_edge: window.north_edge + 8.0,
            ..window
        };
        let beside = correlation(&frame, &map.window(&moved));
        if let Ok(directory) = std::env::var("PILOTAGE_LOOK") {
            let together = Raster::from_fn(200, 100, |c, r| {
                let [red, green, blue, _] = seen.get(c % 100, r);
                if c < 100 {
                    frame.get(c, r)
                } else {
                    [red, green, blue]
                }
            });
            let png = encode_png(&together).unwrap();
            std::fs::write(format!("{directory}/brighton-{index}.png"), png).unwrap();
        }
        println!("frame {index}: {here:.2} here, {beside:.2} 8 m beside");
        assert!(
            here > 0.35 && here > beside + 0.2,
            "{index}: {here} {beside}"
        );
    }
}
