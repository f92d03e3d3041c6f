//! `pilotage detect`: a cascade run over pictures.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use pilotage_core::landmark::cascade::{
    Cascade, Rectangle, ScanSettings, Scanned, group, refined, scan, soft_suppressed,
};
use pilotage_core::raster::{Raster, decode_picture};
use serde::Serialize;

use crate::CommandResult;
use crate::outcome::all_done;

/// Share of a window's margin that better ones must leave it to be told with --soft.
const LEFT: f64 = 0.3;

/// Least ratio of two scales: windows of some hundred pixels are whole pixels larger with some ten of them.
const LEAST_STEP: f64 = 1.001;

/// Arguments of `pilotage detect`.
#[derive(clap::Args)]
pub struct Arguments {
    /// The cascade: OpenCV's XML, old or new, also as MATLAB writes it, or the compact form.
    #[arg(long, value_name = "FILE")]
    cascade: PathBuf,
    /// Pictures to look in, JPEG or PNG.
    #[arg(required = true, value_name = "IMAGE")]
    images: Vec<PathBuf>,
    /// Size of the window relative to that of the scale before.
    #[arg(long, value_name = "RATIO", default_value_t = 1.1)]
    scale_step: f64,
    /// Smallest window, pixels; the cascade's own if absent.
    #[arg(long, value_name = "WxH", value_parser = size)]
    min: Option<(usize, usize)>,
    /// Largest window, pixels; the picture if absent.
    #[arg(long, value_name = "WxH", value_parser = size)]
    max: Option<(usize, usize)>,
    /// Tell groups of more than N windows, as OpenCV's minNeighbors; 0 tells every window by itself.
    #[arg(long, value_name = "N", default_value_t = 3)]
    merge: usize,
    /// Instead of groups tell windows, each weakened by the better ones that it overlaps, with their
    /// centres between pixels.
    #[arg(long, conflicts_with = "merge")]
    soft: bool,
    /// Answer as JSON.
    #[arg(long)]
    json: bool,
}

/// Detections in a picture.
#[derive(Serialize)]
struct PictureDetections {
    image: String,
    width: usize,
    height: usize,
    cascade: About,
    /// Windows that passed every stage.
    windows: usize,
    /// For the scan of this picture.
    seconds: f64,
    detections: Vec<DetectionBox>,
}

/// Description of the cascade.
#[derive(Clone, Serialize)]
struct About {
    file: String,
    width: usize,
    height: usize,
    stages: usize,
    features: usize,
}

/// Rectangle of a detection, pixels from the upper left corner.
#[derive(Serialize)]
struct DetectionBox {
    x: i32,
    y: i32,
    width: i32,
    height: i32,
    /// The best of its windows': what the votes of the last stage sum up to. With --soft what is left of
    /// the votes over the thresholds of all stages.
    score: f64,
    /// Windows in it.
    members: usize,
    /// Stages that each of them passed.
    stages: usize,
    /// Between pixels, with --soft.
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<[f64; 2]>,
}

/// Scans the pictures one after the other.
pub fn run(arguments: &Arguments) -> CommandResult {
    let step = arguments.scale_step;
    if !(step > 1.0 && step.is_finite()) {
        return Err(format!("--scale-step: {step} is not over 1").into());
    }
    if step < LEAST_STEP {
        return Err(format!("--scale-step: {step} is less than {LEAST_STEP}").into());
    }
    let settings = ScanSettings {
        scale_step: step,
        least: arguments.min.unwrap_or_default(),
        greatest: arguments.max.unwrap_or_default(),
        ..ScanSettings::default()
    };
    let name = arguments.cascade.display().to_string();
    let cascade = read(&arguments.cascade)?;
    let about = About {
        file: name,
        width: cascade.width,
        height: cascade.height,
        stages: cascade.stages.len(),
        features: cascade.features.len(),
    };
    let mut answers = Vec::new();
    for image in &arguments.images {
        let picture = match gray(image) {
            Ok(picture) => picture,
            Err(why) => {
                eprintln!("{why}");
                continue;
            }
        };
        let begun = Instant::now();
        let found = scan(&cascade, &picture, &settings);
        let seconds = begun.elapsed().as_secs_f64();
        let mut detections = if arguments.soft {
            softly(&cascade, &picture, &found)
        } else {
            merged(&found, arguments.merge, about.stages)
        };
        for detection in &mut detections {
            detection.keep_within(&picture);
        }
        detections.sort_by(|a, b| b.score.total_cmp(&a.score));
        answers.push(PictureDetections {
            image: image.display().to_string(),
            width: picture.width(),
            height: picture.height(),
            cascade: about.clone(),
            windows: found.len(),
            seconds,
            detections,
        });
    }
    if arguments.json {
        println!("{}", serde_json::to_string_pretty(&answers)?);
    } else {
        answers.iter().for_each(tell);
    }
    all_done(answers.len(), arguments.images.len(), "pictures", "read")
}

impl DetectionBox {
    fn new(rectangle: Rectangle, score: f64, members: usize, stages: usize) -> Self {
        Self {
            x: rectangle.x,
            y: rectangle.y,
            width: rectangle.width,
            height: rectangle.height,
            score,
            members,
            stages,
            centre: None,
        }
    }

    /// By rounding a window can leave the picture by some pixels.
    fn keep_within(&mut self, picture: &Raster<u8>) {
        let all = Rectangle {
            x: self.x,
            y: self.y,
            width: self.width,
            height: self.height,
        };
        let inside = all.within(picture.width(), picture.height());
        (self.x, self.y) = (inside.x, inside.y);
        (self.width, self.height) = (inside.width, inside.height);
    }
}

/// Groups of more than `least` windows, or every window.
fn merged(found: &[Scanned], least: usize, stages: usize) -> Vec<DetectionBox> {
    if least == 0 {
        let one = |w: &Scanned| DetectionBox::new(w.rectangle, w.score, 1, w.stages);
        return found.iter().map(one).collect();
    }
    let groups = group(found, least);
    let one = groups
        .iter()
        .map(|g| DetectionBox::new(g.rectangle, g.score, g.members, stages));
    one.collect()
}

fn softly(cascade: &Cascade, picture: &Raster<u8>, found: &[Scanned]) -> Vec<DetectionBox> {
    let kept = soft_suppressed(found, LEFT);
    let one = kept.iter().map(|kept| {
        let window = &kept.window;
        DetectionBox {
            centre: refined(cascade, picture, window).map(|r| r.centre),
            ..DetectionBox::new(window.rectangle, kept.score, 1, window.stages)
        }
    });
    one.collect()
}

/// The cascade in a file: XML begins with a bracket, the compact form does not.
fn read(path: &Path) -> Result<Cascade, String> {
    let name = path.display().to_string();
    let blame = |e: &dyn std::fmt::Display| format!("{name}: {e}");
    let bytes = fs::read(path).map_err(|e| blame(&e))?;
    if !bytes.trim_ascii_start().starts_with(b"<") && !bytes.starts_with(b"\xef\xbb\xbf") {
        return Cascade::from_bytes(&bytes).map_err(|e| blame(&e));
    }
    let text = String::from_utf8(bytes).map_err(|e| blame(&e))?;
    // Its complaints name the file.
    Cascade::read(&name, &text).map_err(|e| e.to_string())
}

fn tell(answer: &PictureDetections) {
    println!(
        "{}: {} × {} pixels, {} windows passed {} stages in {:.0} ms",
        answer.image,
        answer.width,
        answer.height,
        answer.windows,
        answer.cascade.stages,
        1000.0 * answer.seconds
    );
    for found in &answer.detections {
        println!(
            "    {:5} {:5}  {:4} × {:4}  score {:8.3}  {:3} windows",
            found.x, found.y, found.width, found.height, found.score, found.members
        );
    }
}

/// The picture's luminance as OpenCV computes it (weights in 1/16384), so that the same cascade finds the
/// same in the same file.
fn gray(path: &Path) -> Result<Raster<u8>, String> {
    let blame = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
    let bytes = fs::read(path).map_err(|e| blame(&e))?;
    let picture = decode_picture(&bytes).map_err(|e| blame(&e))?;
    Ok(picture.map(|[r, g, b]| {
        let sum = 4899 * u32::from(r) + 9617 * u32::from(g) + 1868 * u32::from(b);
        ((sum + (1 << 13)) >> 14) as u8
    }))
}

/// Two whole numbers over zero with an x between.
fn size(text: &str) -> Result<(usize, usize), String> {
    let parsed = text.split_once(['x', 'X', '×']).and_then(|(w, h)| {
        let side = |s: &str| s.trim().parse().ok().filter(|v: &usize| *v > 0);
        Some((side(w)?, side(h)?))
    });
    parsed.ok_or_else(|| "say width and height in pixels, such as 24x24".to_owned())
}
