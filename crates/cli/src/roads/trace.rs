//! `pilotage roads trace`: a road drawn from place to place along the road in a map's picture.

use std::path::{Path, PathBuf};

use pilotage_core::frames::LocalFrame;
use pilotage_core::roads::files::write_roads;
use pilotage_core::roads::{RoadLine, course_length};
use pilotage_core::simulate::{Scenario, world_origin};
use pilotage_jobs::{FollowRoadOrder, FollowedRoad, JobEvent, MapSource, WorkerState};

use super::source::class;
use crate::CommandResult;
use crate::files::write_whole;
use crate::maps::{MAP_CACHE, open_map};
use crate::notes::told;
use crate::numbers::lat_lon;
use crate::workers::{Lent, do_here};

/// Arguments of `pilotage roads trace`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Map: a picture that lies on the globe, or a built-in scenario.
    map: String,
    /// Place on the road, degrees; two or more in their order, each at most 1,000 m from the one before.
    #[arg(
        long = "at",
        value_name = "LATITUDE,LONGITUDE",
        required = true,
        allow_hyphen_values = true
    )]
    places: Vec<String>,
    /// Class of the road: path, track, service, residential, tertiary, …
    #[arg(long, default_value = "residential")]
    class: String,
    /// File to write, GeoJSON.
    #[arg(long)]
    out: PathBuf,
}

/// Follows the road from each place to the next, and writes it.
pub fn run(arguments: &Arguments) -> CommandResult {
    let class = class(&arguments.class, "--class")?;
    if arguments.places.len() < 2 {
        return Err("--at: a road has two places at least; give each of them by an --at".into());
    }
    let (source, lent, frame) = map(&arguments.map)?;
    // One for all legs: the world is laid out, and the map opened, once.
    let mut worker = lent.worker();
    let (mut course, mut widths) = (Vec::new(), Vec::new());
    for place in &arguments.places {
        let place = frame.ground_from_geodetic(&lat_lon(place, "--at")?);
        let Some(before) = course.last().copied() else {
            course.push(place);
            continue;
        };
        let order = FollowRoadOrder {
            map: source.clone(),
            ends: [before, place],
            is_free: [course.len() == 1, true],
        };
        let road = followed(order, &mut worker)?;
        let (length, leg) = (course_length(&road.course), widths.len() + 1);
        let width = road.width.map(|width| format!(", {width:.1} m wide"));
        println!(
            "leg {leg}: {length:.0} m, {} points{}",
            road.course.len(),
            width.unwrap_or_default()
        );
        if let Some(told) = &road.told {
            println!("    {told}");
        }
        widths.push(road.width.map(|width| (length, length * width)));
        // Its first place is the last of the leg before, or that in the middle of the road.
        course.pop();
        course.extend(road.course);
    }
    let known = widths.into_iter().flatten();
    let (length, sum) = known.fold((0.0, 0.0), |all, leg| (all.0 + leg.0, all.1 + leg.1));
    let road = RoadLine {
        class,
        width: if length > 0.0 {
            sum / length
        } else {
            class.usual_width()
        },
        course,
        ..RoadLine::default()
    };
    let (points, length) = (road.course.len(), course_length(&road.course));
    write_whole(&arguments.out, write_roads(&[road], &frame))?;
    println!(
        "{}: a road of {length:.0} m, {points} points",
        arguments.out.display()
    );
    Ok(())
}

/// The map, by the name of a file or of a scenario, and the frame of its world.
fn map(name: &str) -> Result<(MapSource, Lent, LocalFrame), Box<dyn std::error::Error>> {
    let path = Path::new(name);
    if !path.exists() && Scenario::named(name).is_some() {
        let source = MapSource::world("countryside");
        return Ok((source, Lent::default(), LocalFrame::new(world_origin())));
    }
    let opened = open_map(path, None, MAP_CACHE)?;
    let frame = opened.frame.ok_or_else(|| {
        format!(
            "{name}: nothing says where on the globe it lies; put a world file or corners beside it"
        )
    })?;
    let (source, lent) = Lent::over(Some(told(opened)));
    Ok((source, lent, frame))
}

fn followed(order: FollowRoadOrder, worker: &mut WorkerState) -> Result<FollowedRoad, String> {
    let mut road = None;
    do_here(order, worker, &mut |event| {
        match event {
            JobEvent::Figures(_) => road = Some(event.read_figures()?),
            JobEvent::Failed(why) => return Err(why),
            _ => {}
        }
        Ok(())
    })?;
    road.ok_or_else(|| "the road was not followed to its end".to_owned())
}
