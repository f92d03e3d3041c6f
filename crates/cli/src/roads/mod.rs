//! `pilotage roads`: road maps read, printed, drawn, put into missions, written, compared; flights by them, places on them.

mod fly;
mod lost;
mod source;
mod trace;

use std::path::PathBuf;

use pilotage_core::frames::LocalFrame;
use pilotage_core::mission::package::{read_package, write_package};
use pilotage_core::mission::{Mission, write_mission};
use pilotage_core::roads::files::write_roads;
use pilotage_core::roads::{AplsGraph, AplsSettings, RoadClass, RoadLine, apls, without_known};

use crate::CommandResult;
use crate::files::write_whole;
use crate::notes::tell;
use crate::numbers::{above_zero, zero_or_more};
use pilotage_jobs::roads_in_world;
use source::{RoadSource, class};

/// Arguments of `pilotage roads`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(clap::Subcommand)]
enum Task {
    /// Say what a road map has: roads by class, crossings, extent.
    Print {
        /// File of OpenStreetMap (XML, PBF), GeoJSON or a mission, or a built-in scenario.
        source: String,
    },
    /// Put the roads of a file within 30 km into a mission, beside those that it has.
    Import {
        /// File of OpenStreetMap (XML, PBF) or GeoJSON, or a built-in scenario.
        source: String,
        /// Mission file, which is made if it is missing, around the middle of the roads.
        #[arg(long)]
        mission: PathBuf,
        /// The least class of road that is taken: path, track, service, residential, tertiary, …
        #[arg(long, default_value = "path")]
        least: String,
        /// Leave out the roads that the mission has.
        #[arg(long)]
        replace: bool,
    },
    /// Write roads as GeoJSON.
    Export {
        /// File of OpenStreetMap (XML, PBF), GeoJSON or a mission, or a built-in scenario.
        source: String,
        /// File to write.
        #[arg(long)]
        out: PathBuf,
    },
    /// Say how alike two road maps are: average path length similarity.
    Apls {
        /// The true map.
        truth: String,
        /// The map that is judged.
        proposal: String,
        /// Greatest distance at which a point is put on the other map, metres.
        #[arg(long, default_value_t = 4.0, value_parser = zero_or_more)]
        snap: f64,
        /// Distance between the points that are compared, metres.
        #[arg(long, default_value_t = 50.0, value_parser = above_zero)]
        spacing: f64,
    },
    /// Fly a scenario by roads, and say how far across and along them the estimate is off.
    Fly(fly::Arguments),
    /// Say where photos, or roads that were seen, are among all roads of a map, if that is sure.
    Lost(lost::Arguments),
    /// Draw a road from place to place along the road in a map's picture, and write it.
    Trace(trace::Arguments),
}

/// Does what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    match &arguments.task {
        Task::Print { source } => print(&RoadSource::open(source)?),
        Task::Import {
            source,
            mission,
            least,
            replace,
        } => import(source, mission, class(least, "--least")?, *replace)?,
        Task::Export { source, out } => {
            let source = RoadSource::open(source)?;
            tell(&source.notes());
            write_whole(out, write_roads(&source.lines(None), &source.frame()?))?;
        }
        Task::Apls {
            truth,
            proposal,
            snap,
            spacing,
        } => {
            let (truth, proposal) = (RoadSource::open(truth)?, RoadSource::open(proposal)?);
            for read in [&truth, &proposal] {
                tell(&read.notes());
            }
            let frame = truth.frame()?;
            let first = AplsGraph::of(&truth.map(Some(&frame)), 0);
            let after = first.nodes.len() as u64;
            // Names of points along edges follow those of the nodes, so that the other's begin far off.
            let second = AplsGraph::of(&proposal.map(Some(&frame)), (after + 1) << 24);
            let settings = AplsSettings {
                snap: *snap,
                spacing: *spacing,
            };
            let score = apls(&first, &second, &settings);
            println!(
                "APLS {:.4} (truth onto proposal {:.4}, proposal onto truth {:.4}; {} and {} points)",
                score.total,
                score.truth_onto_proposal,
                score.proposal_onto_truth,
                score.of_truth,
                score.of_proposal
            );
        }
        Task::Fly(arguments) => fly::run(arguments)?,
        Task::Lost(arguments) => lost::run(arguments)?,
        Task::Trace(arguments) => trace::run(arguments)?,
    }
    Ok(())
}

fn print(source: &RoadSource) {
    let map = source.map(None);
    for note in source.notes() {
        println!("{note}");
    }
    for (class, key, _) in RoadClass::ALL {
        let lines = map.lines().iter().filter(|line| line.class == class);
        let lengths = lines.map(|line| pilotage_core::roads::course_length(&line.course));
        let lengths: Vec<f64> = lengths.collect();
        if !lengths.is_empty() {
            let length = lengths.iter().sum::<f64>() / 1000.0;
            println!("{key:12} {:6} lines {length:9.3} km", lengths.len());
        }
    }
    let graph = map.graph();
    println!(
        "{} nodes, {} edges, {} crossings, {:.3} km",
        graph.node_count(),
        graph.edge_count(),
        map.crossings().len(),
        map.length() / 1000.0
    );
    if let Some(bounds) = map.bounds() {
        println!("{:.0} m by {:.0} m", bounds.width(), bounds.height());
    }
}

fn import(name: &str, path: &PathBuf, least: RoadClass, replace: bool) -> CommandResult {
    let source = RoadSource::open(name)?;
    let blame = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
    let before = if path.exists() {
        std::fs::read(path).map_err(|e| blame(&e))?
    } else {
        write_mission(&Mission::new("Roads", source.frame()?.origin)).into_bytes()
    };
    let mut package = read_package(&before).map_err(|e| blame(&e))?;
    let mission = &mut package.mission;
    let frame = LocalFrame::new(mission.origin);
    let lines = match &source {
        RoadSource::File(read) => {
            let read = roads_in_world(name.to_owned(), read, &frame)?;
            tell(&read.notes);
            read.roads
        }
        RoadSource::World(_) => source.lines(Some(&frame)),
    };
    let before_them = if replace {
        std::mem::take(&mut mission.roads).len()
    } else {
        0
    };
    let kept = mission.roads.len();
    let taken = lines.into_iter().filter(|line| line.class >= least);
    let taken: Vec<RoadLine> = taken.collect();
    let read = taken.len();
    let new = without_known(&mission.roads, taken);
    mission.roads.make_mut().extend(new);
    let (count, added) = (mission.roads.len(), mission.roads.len() - kept);
    // What was a zip stays one, with the map that is in it.
    let after = if before.starts_with(b"PK") {
        write_package(&package).map_err(|e| blame(&e))?
    } else {
        write_mission(&package.mission).into_bytes()
    };
    write_whole(path, after)?;
    let beside = match before_them {
        0 => String::new(),
        number => format!(" in place of {number}"),
    };
    let known = match read - added {
        0 => String::new(),
        number => format!(", {number} left out that it has"),
    };
    println!(
        "{}: {added} roads added{beside}{known}, {count} in all",
        path.display()
    );
    Ok(())
}
