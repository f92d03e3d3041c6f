//! Times how a large map is read.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::{ByteSource, GeoTiff, GeoTiffFile, Imagery, MapMemory, Window};

/// Windows at every scale.
const WINDOWS: usize = 60;

struct Disk {
    name: String,
    length: u64,
    /// The file, and how many bytes were read of it.
    file: Mutex<(File, u64)>,
}

impl ByteSource for Disk {
    fn name(&self) -> &str {
        &self.name
    }

    fn length(&self) -> u64 {
        self.length
    }

    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        let mut locked = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let (file, count) = &mut *locked;
        *count += length as u64;
        let mut bytes = vec![0; length];
        file.seek(SeekFrom::Start(offset))
            .and_then(|_| file.read_exact(&mut bytes))
            .map_err(|e| e.to_string())?;
        Ok(bytes)
    }
}

/// Opens `path` and prints how long it and its windows take.
pub fn measure(path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let file = File::open(path)?;
    let source = Arc::new(Disk {
        name: path.to_string_lossy().into_owned(),
        length: file.metadata()?.len(),
        file: Mutex::new((file, 0)),
    });
    let read = || {
        let locked = source.file.lock().unwrap_or_else(PoisonError::into_inner);
        locked.1 as f64 / 1e6
    };
    let begun = Instant::now();
    let file = GeoTiffFile::open(source.clone(), None, None)?;
    let (width, height) = file.size();
    let overviews = file.tiff.levels().len() - 1;
    let origin = file.origin().ok_or("the map lies nowhere")?;
    let map = GeoTiff::new(file, &LocalFrame::new(origin), MapMemory::default())?;
    println!(
        "{width} × {height} pixels, {overviews} overviews, {:.0} MB",
        source.length as f64 / 1e6
    );
    println!(
        "opened in {:.1} ms, {:.2} MB read, {}",
        begun.elapsed().as_secs_f64() * 1e3,
        read(),
        memory()
    );
    let bounds = map.bounds();
    let whole = Window::covering(&bounds, bounds.height() / 900.0);
    for what in ["first look at the whole", "second look at the whole"] {
        let begun = Instant::now();
        map.window(&whole);
        println!(
            "{what}: {:.0} ms, {:.0} MB read, {}",
            begun.elapsed().as_secs_f64() * 1e3,
            read(),
            memory()
        );
    }
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    println!("windows of 1024 × 768, {WINDOWS} at random places each:");
    for times in [0.5, 1.0, 2.0, 3.9, 8.0, 32.0] {
        let gsd = map.native_gsd() * times;
        let mut taken: Vec<f64> = (0..WINDOWS)
            .map(|_| {
                let window = Window {
                    north_edge: bounds.south + random() * bounds.height(),
                    west_edge: bounds.west + random() * (bounds.width() - 1024.0 * gsd).max(0.0),
                    gsd,
                    width: 1024,
                    height: 768,
                };
                let begun = Instant::now();
                map.window(&window);
                begun.elapsed().as_secs_f64() * 1e3
            })
            .collect();
        taken.sort_by(f64::total_cmp);
        println!(
            "  {times:>4} × the map's pixel: median {:6.1} ms, worst {:6.1} ms",
            taken[WINDOWS / 2],
            taken[WINDOWS - 1]
        );
    }
    println!("at the end {:.0} MB read, {}", read(), memory());
    Ok(())
}

/// Memory of this process, where the system tells it.
fn memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = |name: &str| {
        let line = status.lines().find(|line| line.starts_with(name))?;
        let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
        Some(format!("{:.0} MB", kilobytes / 1024.0))
    };
    format!(
        "memory {}, peak {}",
        line("VmRSS").unwrap_or_else(|| "unknown".to_owned()),
        line("VmHWM").unwrap_or_else(|| "unknown".to_owned())
    )
}
