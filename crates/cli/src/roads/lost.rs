//! `pilotage roads lost`: the place of photos, or of roads that were seen, among all roads of a map.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::Vector2;
use pilotage_core::camera::CameraModel;
use pilotage_core::flight::photo::{Photo, photo_pose, read_photo, told_focal};
use pilotage_core::frames::{Attitude, GroundPoint, GroundRect, LocalFrame};
use pilotage_core::imagery::MemoryBytes;
use pilotage_core::roads::RoadMap;
use pilotage_core::roads::lost::{
    LostBelief, LostSettings, LostShare, PartSettings, RoadParts, RoadView, ViewMotion,
};

use super::source::{RoadSource, class};
use pilotage_jobs::{BELIEVED_AMONG_ROADS, JobEvent, RoadsLostOrder, decode_photo, road_view};

use crate::CommandResult;
use crate::notes::tell;
use crate::numbers::{above_zero, any_number, lat_lon, numbers, zero_or_more};
use crate::plan::above_ground;
use crate::workers::{self, Lent};

/// Ranges that people state, in standard deviations.
const WITHIN: f64 = 2.0;
/// Standard deviation of dead reckoning: a share of the way (and radians of a turn).
const RECKONED: f64 = 0.03;

/// Arguments of `pilotage roads lost`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Road map: a file of OpenStreetMap (XML, PBF), GeoJSON or a mission, or a built-in scenario.
    map: String,
    /// Photo (JPEG, TIFF or PNG) of a camera that looks down, or roads that were seen as GeoJSON, wherever they lie on the
    /// globe; several of them in the order of the flight.
    #[arg(required = true)]
    views: Vec<PathBuf>,
    /// Way from a view to the next and the turn to the right by then: metres ahead, metres to the right, degrees; once
    /// for every view after the first.
    #[arg(
        long = "way",
        value_name = "AHEAD,RIGHT,TURN",
        allow_hyphen_values = true
    )]
    ways: Vec<String>,
    /// Height of the camera above the ground; what the photo says if absent.
    #[arg(long, value_name = "METRES")]
    height: Option<f64>,
    /// Focal length in pixels of the photo; what the photo says if absent.
    #[arg(long, value_name = "PIXELS", value_parser = above_zero)]
    focal: Option<f64>,
    /// Range of the height, percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 4.0, value_parser = zero_or_more)]
    height_within: f64,
    /// Angle by which the camera looks ahead of straight down, degrees; what the photo says if absent.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = any_number)]
    ahead: Option<f64>,
    /// Believed heading of the first view's top, degrees from north.
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 0.0,
        value_parser = any_number,
        allow_hyphen_values = true
    )]
    heading: f64,
    /// Range of the heading to each side; 180 where it is unknown.
    #[arg(long, value_name = "DEGREES", default_value_t = 180.0, value_parser = zero_or_more)]
    heading_within: f64,
    /// The least class of road that the map is searched for: path, track, service, residential, tertiary, …
    #[arg(long, default_value = "service")]
    least: String,
    /// Place around which the last view's is sought, degrees; anywhere on the map if absent.
    #[arg(long, value_name = "LAT,LON", allow_hyphen_values = true)]
    around: Option<String>,
    /// Distance to the north, east, south and west within which it is sought then, kilometres.
    #[arg(long, value_name = "KM", requires = "around", default_value_t = 10.0, value_parser = above_zero)]
    within: f64,
    /// Probability that the views show ground of the map, before they are looked at, percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 50.0)]
    on_map: f64,
}

/// Says where the views are.
pub fn run(arguments: &Arguments) -> CommandResult {
    above_ground(arguments.height)?;
    let percent = arguments.on_map;
    if !(percent > 0.0 && percent <= 100.0) {
        let why = "is no probability; give percent above 0, 100 at most";
        return Err(format!("--on-map: {percent} {why}").into());
    }
    let least = class(&arguments.least, "--least")?;
    let motions = motions(arguments)?;
    let around = arguments.around.as_deref();
    let around = around.map(|at| lat_lon(at, "--around")).transpose()?;
    // A view that cannot be read is told before anything is made of the map.
    let mut views = Vec::new();
    for path in &arguments.views {
        views.push(view(path, arguments)?);
    }
    let source = RoadSource::open(&arguments.map)?;
    tell(&source.notes());
    let frame = around.map_or_else(|| source.frame(), |at| Ok(LocalFrame::new(at)))?;
    let lines = source.lines(Some(&frame));
    drop(source);
    let settings = LostSettings {
        turn: arguments.heading.to_radians(),
        within_turn: arguments.heading_within.to_radians(),
        scale: 0.01 * arguments.height_within / WITHIN,
        on_map: 0.01 * arguments.on_map,
    };
    let mut views = views.into_iter();
    let first = views.next().ok_or("there is no view; name one")?;
    let then: Vec<(ViewMotion, RoadView)> = motions.into_iter().zip(views).collect();
    let sought = PartSettings {
        around: around.map(|_| {
            let side = 2000.0 * arguments.within;
            GroundRect::centered(GroundPoint::default(), side, side)
        }),
        ..PartSettings::of_views(least, &first, &then, settings.scale)
    };
    let parts =
        RoadParts::new(lines, &sought).map_err(|why| format!("{}: {why}", arguments.map))?;
    let belief = searched(parts, (first, then), settings)?;
    if belief.left > 0 {
        eprintln!(
            "{} of {} poses were looked at, those of the rarest pairs of crossings; --heading-within leaves fewer",
            belief.tried,
            belief.tried + belief.left
        );
    }
    let Some(place) = belief.place(BELIEVED_AMONG_ROADS) else {
        match belief.places.first() {
            Some(likeliest) => println!(
                "no place; the likeliest of {} has {:.1} %, elsewhere or not on the map {:.1} %",
                belief.places.len(),
                100.0 * likeliest.probability,
                100.0 * belief.elsewhere
            ),
            None => println!("no place; the views show too few roads and crossings"),
        }
        return Ok(());
    };
    let below = frame.geodetic_from_ground(&place.pose.place);
    println!(
        "{:.6}, {:.6}: {:.0} m north, {:.0} m east of {}; heading {:.1}°; {:.2} %",
        below.latitude.to_degrees(),
        below.longitude.to_degrees(),
        place.pose.place.north,
        place.pose.place.east,
        around.map_or("the middle of the map", |_| "that place"),
        place.pose.turn.to_degrees().rem_euclid(360.0),
        100.0 * place.probability
    );
    Ok(())
}

/// Memory for all parts that are searched at the same time, bytes.
const MEMORY: f64 = 4e9;

/// Belief over all parts, each searched by a thread of its own.
fn searched(
    parts: RoadParts,
    views: (RoadView, Vec<(ViewMotion, RoadView)>),
    settings: LostSettings,
) -> Result<LostBelief, String> {
    let count = parts.count();
    let (parts, views) = (Arc::new(parts), Arc::new(views));
    let order = |part| RoadsLostOrder {
        parts: Arc::clone(&parts),
        part,
        views: Arc::clone(&views),
        settings,
    };
    let orders = (0..count).map(order).collect();
    let mut shares = vec![LostShare::default(); count];
    let (mut done, mut shown) = (0, 0);
    // A square of a county, with all that its views reach, takes up to gigabytes.
    let at_once = (MEMORY / parts.bytes_at_once()) as usize;
    let threads = workers::processors().min(at_once.max(1));
    workers::run_as_done(threads, orders, &Lent::default(), &mut |part, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Figures(_) => {
                shares[part] = event.read_figures()?;
                done += 1;
                if count > 1 && 10 * done / count > shown {
                    shown = 10 * done / count;
                    eprintln!("{:3} %  {done} of {count} squares", 100 * done / count);
                }
            }
            _ => {}
        }
        Ok(())
    })?;
    Ok(LostBelief::of_parts(shares))
}

/// Motions between the views.
fn motions(arguments: &Arguments) -> Result<Vec<ViewMotion>, String> {
    let (ways, views) = (arguments.ways.len(), arguments.views.len());
    if ways + 1 != views {
        return Err(format!(
            "--way: {views} views need {} ways between them, and there are {ways}",
            views - 1
        ));
    }
    let motion = |text: &String| {
        let [ahead, right, turn] = numbers(text, "--way")?;
        let way = Vector2::new(ahead, right);
        Ok(ViewMotion {
            way,
            turn: f64::to_radians(turn),
            way_deviation: RECKONED * way.norm(),
            turn_deviation: RECKONED,
        })
    };
    arguments.ways.iter().map(motion).collect()
}

/// Roads that a file shows.
fn view(path: &Path, arguments: &Arguments) -> Result<RoadView, String> {
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|e| format!("{name}: {e}"))?;
    let is_text = bytes.iter().find(|b| !b.is_ascii_whitespace()) == Some(&b'{');
    if is_text {
        let map: RoadMap = RoadSource::open(&name)?.map(None);
        let seen = RoadView::of_map(&map).ok_or_else(|| format!("{name}: it has no roads"))?;
        seen.checked().map_err(|why| format!("{name}: {why}"))?;
        return Ok(seen);
    }
    let picture = decode_photo(&name, &bytes).map_err(|e| format!("{name}: {e}"))?;
    let source = MemoryBytes::new(&name, bytes);
    let photo = Photo {
        width: picture.width(),
        height: picture.height(),
        ..read_photo(&source).unwrap_or_default()
    };
    let told = photo_pose(&photo);
    let height = arguments
        .height
        .or(told.height.filter(|height| *height > 0.0));
    let height = height.ok_or(format!(
        "{name}: it does not tell its height; give --height"
    ))?;
    let focal = arguments.focal.or(told_focal(&photo));
    let focal = focal.ok_or(format!(
        "{name}: it does not tell its focal length; give --focal"
    ))?;
    let camera = CameraModel::of_focal(picture.width(), picture.height(), focal);
    let ahead = arguments.ahead.map(f64::to_radians);
    let attitude = Attitude {
        roll: told.roll,
        pitch: ahead.unwrap_or(told.pitch),
        yaw: 0.0,
    };
    road_view(&camera, attitude, height, &picture).map_err(|why| {
        let advice = "give its --height, --focal and --ahead, or a part of it from lower down";
        format!("{name}: {why}; {advice}")
    })
}
