//! `pilotage study` of work on a map: tables, proposals and detectors, cut into pieces as studies are into shards.

mod detectors;
mod piecework;
mod plan;
mod reference_table;
mod suggestions;

use serde::{Deserialize, Serialize};

use super::arguments::Arguments;
use super::progress::Progress;
use super::shards::Shards;
use crate::CommandResult;
use crate::files::write_whole;
use detectors::TrainedDetectors;
use piecework::Piecework;
use plan::{MapWorkKind, NamedFile};
use reference_table::TableOfMap;
use suggestions::ProposedLandmarks;

pub use plan::MapWorkPlan;

/// Plan of a folder, and the content of the files that it names.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
struct Planned {
    plan: MapWorkPlan,
    files: Vec<NamedFile>,
}

/// Does the work that the text of a plan asks for; false where it is the plan of a study.
///
/// # Errors
/// In words, whatever is wrong with the plan or fails in the work.
pub fn run(arguments: &Arguments, text: &str) -> Result<bool, Box<dyn std::error::Error>> {
    let Some(plan) = MapWorkPlan::read(text).map_err(|why| arguments.blamed(why))? else {
        return Ok(false);
    };
    let plan = plan.beside(arguments.beside());
    carry_out(arguments, &plan.map_err(|why| arguments.blamed(why))?)?;
    Ok(true)
}

fn carry_out(arguments: &Arguments, plan: &MapWorkPlan) -> CommandResult {
    if let Some(path) = &arguments.pack {
        // The files are read where they are: on a disk that all machines see under this name.
        return Ok(write_whole(path, basic_toml::to_string(plan)?)?);
    }
    if arguments.record.is_some() {
        return Err("--record is of studies; this is work on a map".into());
    }
    let work: Box<dyn Piecework> = match (plan.work, &plan.map) {
        (MapWorkKind::Suggestions, _) => Box::new(ProposedLandmarks::open(plan)?),
        (MapWorkKind::Detectors, _) => Box::new(TrainedDetectors::open(plan)?),
        (MapWorkKind::ReferenceTable, Some(map)) => Box::new(TableOfMap::open(map)?),
        (MapWorkKind::ReferenceTable, None) => return Err("map: say the map".into()),
    };
    let root = arguments.folder(&plan.name);
    let (named, files) = plan.by_content()?;
    let planned = Planned { plan: named, files };
    let shards = Shards::open(&root, work.pieces(), "piece", planned)?;
    if arguments.describe {
        let is_complete = shards.are_all_there();
        return Ok(shards.describe(&plan.name, work.pieces(), 1, is_complete)?);
    }
    if !arguments.merge {
        let wanted = arguments.wanted(&shards)?;
        let mut progress = Progress::of(wanted.len() as u64, "pieces", arguments.quiet);
        work.carry_out(&wanted, arguments.threads(), &mut |piece, bytes| {
            progress.add(1);
            shards.keep(piece, bytes)
        })?;
        progress.finish();
    }
    if arguments.is_part() {
        return Ok(());
    }
    if !shards.are_all_there() {
        return Err(shards.lacking().into());
    }
    let pieces = (0..shards.count).map(|piece| shards.read(piece, Ok));
    let outcome = work.conclude(pieces.collect::<Result<_, _>>()?)?;
    let path = root.join(outcome.name);
    write_whole(&path, outcome.bytes)?;
    write_whole(&root.join("summary.txt"), &outcome.words)?;
    if !arguments.quiet {
        println!("{}wrote {}", outcome.words, path.display());
    }
    Ok(())
}
