//! Maps and heights opened as the page does it, on the calling thread.

use std::sync::atomic::{AtomicU64, Ordering};

use pilotage_core::frames::{Geodetic, GroundRect};
use pilotage_core::imagery::{ByteSource, Window};

use super::*;
use crate::{
    HeightsOrder, MapSource, OpenOrder, OpenedFiles, PrepareMapOrder, ProvideOrder, TileOrder,
};

fn words(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

fn reals(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// An uncompressed `GeoTIFF` of half-metre pixels in UTM zone 15 north, one sample a pixel: 8 bits
/// of brightness, or 16 with a sign of height.
fn geo_tiff(width: u32, height: u32, is_height: bool, sample: impl Fn(u32, u32) -> i16) -> Vec<u8> {
    let keys = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32_615];
    let size = if is_height { 2 } else { 1 };
    let pixels: Vec<u8> = (0..width * height)
        .flat_map(|i| {
            sample(i % width, i / width)
                .to_le_bytes()
                .into_iter()
                .take(size)
        })
        .collect();
    let scale = if is_height { 30.0 } else { 0.5 };
    let tags: Vec<(u16, u16, Vec<u8>)> = vec![
        (256, 4, width.to_le_bytes().to_vec()),
        (257, 4, height.to_le_bytes().to_vec()),
        (258, 3, words(&[8 * size as u16])),
        (259, 3, words(&[1])),
        (262, 3, words(&[1])),
        (273, 4, 8_u32.to_le_bytes().to_vec()),
        (277, 3, words(&[1])),
        (278, 4, height.to_le_bytes().to_vec()),
        (279, 4, (pixels.len() as u32).to_le_bytes().to_vec()),
        (339, 3, words(&[1 + u16::from(is_height)])),
        (33_550, 12, reals(&[scale, scale, 0.0])),
        (
            33_922,
            12,
            reals(&[0.0, 0.0, 0.0, 570_000.0, 5_190_000.0, 0.0]),
        ),
        (34_735, 3, words(&keys)),
    ];
    let mut file = b"II\x2a\x00".to_vec();
    let directory = (8 + pixels.len()).next_multiple_of(2);
    file.extend((directory as u32).to_le_bytes());
    file.extend(pixels);
    file.resize(directory, 0);
    let mut beyond = Vec::new();
    let after = directory + 2 + 12 * tags.len() + 4;
    file.extend((tags.len() as u16).to_le_bytes());
    for (tag, kind, value) in tags {
        let count = value.len() / [1, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8][usize::from(kind)];
        file.extend(tag.to_le_bytes());
        file.extend(kind.to_le_bytes());
        file.extend((count as u32).to_le_bytes());
        if value.len() <= 4 {
            let mut inside = value;
            inside.resize(4, 0);
            file.extend(inside);
        } else {
            file.extend(((after + beyond.len()) as u32).to_le_bytes());
            beyond.extend(value);
        }
    }
    file.extend([0; 4]);
    file.extend(beyond);
    file
}

/// A file on a disk, and how many bytes were read of it.
struct Disk(Vec<u8>, AtomicU64);

impl ByteSource for Disk {
    fn name(&self) -> &'static str {
        "disk"
    }
    fn length(&self) -> u64 {
        self.0.len() as u64
    }
    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        self.1.fetch_add(length as u64, Ordering::Relaxed);
        Ok(self.0[offset as usize..][..length].to_vec())
    }
}

/// Events of a job until its end.
fn all(host: &mut InlineWorkers, job: Job) -> Vec<JobEvent> {
    let id = host.start(job);
    host.finish_jobs();
    let events = host.events().into_iter().filter(|(of, _)| *of == id);
    events.map(|(_, event)| event).collect()
}

fn open(host: &mut InlineWorkers, files: &[(&str, FileContent)]) -> Result<OpenedFiles, String> {
    let files = files.iter().map(|(n, c)| ((*n).to_owned(), c.clone()));
    let key = "drop".to_owned();
    host.start(Job::Provide(ProvideOrder {
        key: key.clone(),
        files: files.collect(),
    }));
    let events = all(
        host,
        Job::Open(OpenOrder {
            key,
            near: None,
            origin: Geodetic::from_degrees(47.0, 8.0, 0.0),
        }),
    );
    events
        .into_iter()
        .find_map(|event| match event {
            JobEvent::Opened(opened) => Some(Ok(*opened)),
            JobEvent::Failed(why) => Some(Err(why)),
            _ => None,
        })
        .unwrap()
}

fn placed(origin: Geodetic) -> MapSource {
    MapSource::Placed {
        key: "drop".to_owned(),
        origin,
    }
}

/// The tile over `bounds` of 300 pixels, and whether it is whole.
fn look(host: &mut InlineWorkers, origin: Geodetic, bounds: &GroundRect) -> (Vec<[u8; 4]>, bool) {
    let window = Window::covering(bounds, bounds.width() / 300.0);
    let map = placed(origin);
    let events = all(host, Job::Tile(TileOrder { map, window }));
    let tile = events.into_iter().find_map(|event| match event {
        JobEvent::Tile { pixels, whole, .. } => Some((pixels.pixels().to_vec(), whole)),
        _ => None,
    });
    tile.unwrap()
}

#[test]
fn a_large_map_opens_without_being_read_and_wide_views_fill_while_it_is_made_ready() {
    let bytes = geo_tiff(3000, 2500, false, |x, y| {
        ((x / 8 + y / 8) % 200 + 20) as i16
    });
    let disk = Arc::new(Disk(bytes, AtomicU64::new(0)));
    let mut host = InlineWorkers::new();
    let lent = host.lend(1, disk.clone());
    let opened = open(&mut host, &[("maps/area.tif", lent)]).unwrap();
    let read = disk.1.load(Ordering::Relaxed);
    assert!(read < 600_000, "{read} bytes read to open it");
    let map = opened.map.unwrap();
    assert_eq!(map.name, "maps/area.tif");
    // 1500 m by 1250 m of a grid that is turned by 0.67°.
    assert!(
        (map.bounds.width() - 1515.2).abs() < 0.5,
        "{:?}",
        map.bounds
    );
    let origin = map.origin.unwrap();
    let (pixels, whole) = look(&mut host, origin, &map.bounds);
    assert!(!whole && pixels.iter().all(|p| p[3] == 0));
    let events = all(&mut host, Job::PrepareMap(PrepareMapOrder(placed(origin))));
    // In slices: how many depends on the machine.
    let (last, before) = events.split_last().unwrap();
    assert_eq!(*last, JobEvent::Finished);
    let is_part = |e: &JobEvent| matches!(e, JobEvent::Progress(part, _) if *part < 1.0);
    assert!(before.iter().all(is_part), "{before:?}");
    let (pixels, whole) = look(&mut host, origin, &map.bounds);
    let shown = pixels.iter().filter(|p| p[3] == 255).count();
    assert!(
        whole && shown > pixels.len() * 9 / 10,
        "{shown} of {}",
        pixels.len()
    );
}

#[test]
fn a_map_that_is_cut_off_says_so_and_shows_what_is_there() {
    let mut bytes = geo_tiff(400, 300, false, |x, _| (x % 200 + 20) as i16);
    let mut host = InlineWorkers::new();
    let cut = bytes[..60_000].to_vec();
    let why = open(&mut host, &[("cut.tif", cut.into())]).unwrap_err();
    assert!(why.contains("cut.tif"), "{why}");
    let no_tiff = open(&mut host, &[("none.tif", b"GIF89a".to_vec().into())]).unwrap_err();
    assert!(no_tiff.starts_with("none.tif: not a TIFF"), "{no_tiff}");
    // The strip is said to lie beyond the end of the file.
    let at = bytes
        .windows(12)
        .position(|w| w[..4] == [17, 1, 4, 0])
        .unwrap();
    bytes[at + 8..at + 12].copy_from_slice(&500_000_u32.to_le_bytes());
    let opened = open(&mut host, &[("strip.tif", bytes.into())]).unwrap();
    let map = opened.map.unwrap();
    let window = Window::covering(&map.bounds, 1.0);
    let events = all(
        &mut host,
        Job::Tile(TileOrder {
            map: placed(map.origin.unwrap()),
            window,
        }),
    );
    let told = events.iter().find_map(|event| match event {
        JobEvent::Remark(text) => Some(text.clone()),
        _ => None,
    });
    assert!(
        told.is_some_and(|text| text.contains("strip.tif")),
        "{events:?}"
    );
}

#[test]
fn heights_come_from_an_elevation_model_beside_the_map() {
    let mut host = InlineWorkers::new();
    let map = geo_tiff(400, 300, false, |x, _| (x % 200 + 20) as i16);
    let heights = geo_tiff(60, 50, true, |x, _| 180 + x as i16);
    let files = [("area.tif", map.into()), ("heights.tif", heights.into())];
    let opened = open(&mut host, &files).unwrap();
    let terrain = opened.terrain.unwrap();
    assert_eq!(terrain.name, "heights.tif");
    assert!((terrain.spacing - 30.0).abs() < 0.05);
    let map = opened.map.unwrap();
    let order = HeightsOrder {
        key: "drop".to_owned(),
        origin: map.origin.unwrap(),
        area: map.bounds,
        file: None,
    };
    let events = all(&mut host, Job::TakeHeights(Box::new(order)));
    let grid = events.iter().find_map(|event| match event {
        JobEvent::Heights(grid) => Some(grid),
        _ => None,
    });
    let (low, high) = grid.unwrap().extremes().unwrap();
    // The map's 200 m from west to east are six to seven posts; the first stands 15 m in.
    assert!(
        (180.0..180.6).contains(&low) && (186.0..187.0).contains(&high),
        "{low} {high}"
    );
}

#[test]
fn an_elevation_model_that_is_readable_in_part_gives_no_heights() {
    let mut heights = geo_tiff(60, 50, true, |x, _| 180 + x as i16);
    // The strip is said to lie beyond the end of the file.
    let at = heights
        .windows(12)
        .position(|w| w[..4] == [17, 1, 4, 0])
        .unwrap();
    heights[at + 8..at + 12].copy_from_slice(&500_000_u32.to_le_bytes());
    let mut host = InlineWorkers::new();
    let map = geo_tiff(400, 300, false, |x, _| (x % 200 + 20) as i16);
    let files = [("area.tif", map.into()), ("heights.tif", heights.into())];
    let map = open(&mut host, &files).unwrap().map.unwrap();
    for file in [None, Some("heights.tif".to_owned())] {
        let order = HeightsOrder {
            key: "drop".to_owned(),
            origin: map.origin.unwrap(),
            area: map.bounds,
            file,
        };
        let events = all(&mut host, Job::TakeHeights(Box::new(order)));
        let is_grid = |event: &JobEvent| matches!(event, JobEvent::Heights(_));
        assert!(!events.iter().any(is_grid));
        let [.., JobEvent::Failed(why)] = &events[..] else {
            panic!("{events:?}")
        };
        assert!(
            why.contains("heights.tif") && why.contains("too high"),
            "{why}"
        );
    }
}
