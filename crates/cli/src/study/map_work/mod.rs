//! `pilotage study` of work on a map: tables, proposals and detectors, cut into pieces as studies are into shards.

mod detectors;
mod named_file;
mod piecework;
mod plan;
mod reference_table;
mod suggestions;

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::arguments::Arguments;
use super::progress::Progress;
use super::shards::Shards;
use crate::CommandResult;
use crate::files::write_whole;
use detectors::TrainedDetectors;
use named_file::NamedFile;
use piecework::Piecework;
use plan::MapWorkKind;
use reference_table::TableOfMap;
use suggestions::ProposedLandmarks;

pub use plan::MapWorkPlan;

/// Plan of a folder, and the content of all files that the work depends on.
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

/// Content of the files that the work depends on. What lies in its own folder is none of them, even where that is in the
/// folder of a flight.
fn files_of(work: &dyn Piecework, root: &Path) -> Result<Vec<NamedFile>, String> {
    let blame = |why| format!("{}: {why}", root.display());
    let root = std::path::absolute(root).map_err(blame)?;
    let read = work.read().iter().filter(|path| !path.starts_with(&root));
    let read = read.map(|path| NamedFile::at(path));
    let mut files = read.collect::<Result<Vec<_>, _>>()?;
    files.extend(work.pictures()?);
    Ok(files)
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
    let planned = Planned {
        plan: plan.without_places(),
        files: files_of(work.as_ref(), &root)?,
    };
    let only_looks = arguments.only_looks();
    let shards = Shards::open(&root, work.pieces(), "piece", planned, only_looks)?;
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
