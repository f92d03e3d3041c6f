//! `pilotage study PLAN.toml`: flies what is left of a study, and sums up.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_jobs::{JobEvent, StudyShardOrder};
use pilotage_study::{Study, StudyPlan, StudyRecord, StudyTally};
use serde::Serialize;

use super::folder::StudyFolder;
use super::progress::Progress;
use super::results;
use crate::CommandResult;
use crate::files::write_whole;
use crate::mission_file::OpenMission;
use crate::notes::tell;
use crate::workers::{self, Lent};

/// Arguments of `pilotage study PLAN`.
#[derive(clap::Args)]
#[group(id = "study_plan")]
pub struct Arguments {
    /// Plan of the study, TOML.
    plan: PathBuf,
    /// Folder for shards and summary; what is there already is not flown again. NAME.study if not given.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Flights of a shard: what is lost at most when the program is killed.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..))]
    runs_per_shard: u64,
    /// Number of programs that share the shards; each flies its own, and none sums up.
    #[arg(long, value_name = "N", requires = "share", value_parser = clap::value_parser!(u64).range(1..))]
    shares: Option<u64>,
    /// Number of this program among them, from 0.
    #[arg(long, value_name = "I", requires = "shares")]
    share: Option<u64>,
    /// Flies these shards alone, separated by commas, and does not sum up.
    #[arg(
        long,
        value_name = "NUMBERS",
        value_delimiter = ',',
        conflicts_with = "share"
    )]
    only: Vec<u64>,
    /// Flies nothing: sums up what is there.
    #[arg(long, conflicts_with_all = ["share", "only"])]
    merge: bool,
    /// Prints how many shards there are and which are there, as JSON, and flies nothing.
    #[arg(long, conflicts_with_all = ["share", "only", "merge"])]
    describe: bool,
    /// Writes the plan with the mission files that it names in it, TOML, and flies nothing: all that other machines need.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["share", "only", "merge", "describe", "record"])]
    pack: Option<PathBuf>,
    /// Threads; as many as there are processors if not given.
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    threads: Option<u64>,
    /// Keeps a record of the whole study in this folder, for the measured results.
    #[arg(long, value_name = "FOLDER", requires = "made", conflicts_with_all = ["share", "only", "describe"])]
    record: Option<PathBuf>,
    /// Date and state of the program that the record tells.
    #[arg(long, value_name = "TEXT", requires = "record")]
    made: Option<String>,
    /// Tells no progress and prints no table.
    #[arg(long)]
    quiet: bool,
}

/// A study for other programs.
#[derive(Serialize)]
struct Description {
    name: String,
    flights: u64,
    runs_per_shard: u64,
    shards: u64,
    /// Numbers of the shards that are not there, of those that are needed as far as is known.
    missing: Vec<u64>,
    /// Whether the shards that are there are enough.
    is_complete: bool,
}

/// The shards that are there, taken in one after the other from the first on.
struct Front<'a> {
    folder: &'a StudyFolder,
    tally: StudyTally<'a>,
    next: u64,
}

impl<'a> Front<'a> {
    fn new(folder: &'a StudyFolder, study: &'a Study) -> Self {
        Self {
            folder,
            tally: StudyTally::new(study.design()),
            next: 0,
        }
    }

    /// Takes in the shards that follow and are there.
    fn move_on(&mut self, study: &Study) -> Result<(), String> {
        while !self.is_complete() && self.folder.has(self.next) {
            for row in self.folder.rows(study.design(), self.next)? {
                self.tally.take(row).map_err(|why| why.to_string())?;
            }
            self.next += 1;
        }
        Ok(())
    }

    /// Whether no more shards are needed.
    fn is_complete(&self) -> bool {
        self.tally.is_enough() || self.next == self.folder.shards()
    }
}

/// Word with which the work is given up because it is enough.
const ENOUGH: &str = "enough";

/// Carries out the study.
pub fn run(arguments: &Arguments) -> CommandResult {
    let plan = read_plan(&arguments.plan)?;
    if !arguments.quiet {
        tell(&plan.notes());
    }
    if let Some(path) = &arguments.pack {
        return Ok(write_whole(path, plan.to_toml()?)?);
    }
    let usual = || PathBuf::from(format!("{}.study", plan.name));
    let root = arguments.out.clone().unwrap_or_else(usual);
    let folder = StudyFolder::open(&root, &plan, arguments.runs_per_shard)?;
    let study = Arc::new(Study::new(plan)?);
    let mut front = Front::new(&folder, &study);
    front.move_on(&study)?;
    if arguments.describe {
        return describe(&study, &front);
    }
    let is_part = arguments.share.is_some() || !arguments.only.is_empty();
    if !arguments.merge && !front.is_complete() {
        let wanted = wanted(arguments, &folder)?;
        fly(arguments, &study, &mut front, &wanted)?;
    }
    if is_part {
        return Ok(());
    }
    if !front.is_complete() {
        let missing = (0..folder.shards())
            .filter(|shard| !folder.has(*shard))
            .count();
        let all = folder.shards();
        return Err(format!(
            "{missing} of {all} shards are missing in {}; run the study without --merge, or the shares \
             that are left",
            root.display()
        )
        .into());
    }
    let summary = front.tally.summary();
    folder.conclude(study.design(), &summary)?;
    if !arguments.quiet {
        print!("{}", summary.table());
    }
    if let (Some(records), Some(made)) = (&arguments.record, &arguments.made) {
        let record = StudyRecord::new(&study, summary, made.clone())?;
        let text = serde_json::to_string_pretty(&record)? + "\n";
        write_whole(&results::place(records, &record.plan.name), text)?;
    }
    Ok(())
}

/// The plan in a file, with the mission files beside it that it names.
fn read_plan(path: &Path) -> Result<StudyPlan, String> {
    let blame = |why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
    let text = std::fs::read_to_string(path).map_err(|why| blame(&why))?;
    let beside = path.parent().unwrap_or(Path::new(""));
    let mut mission = |name: &str| Ok(OpenMission::read(&beside.join(name))?.package.mission);
    StudyPlan::read_with(&text, &mut mission).map_err(|why| blame(&why))
}

/// Numbers of the shards that this program flies.
fn wanted(arguments: &Arguments, folder: &StudyFolder) -> Result<Vec<u64>, String> {
    let all = 0..folder.shards();
    if let Some(beyond) = arguments.only.iter().find(|shard| !all.contains(shard)) {
        return Err(format!(
            "--only {beyond}: there are {} shards, from 0",
            all.end
        ));
    }
    let (count, own) = (arguments.shares.unwrap_or(1), arguments.share.unwrap_or(0));
    if own >= count {
        return Err(format!("--share {own}: there are {count} shares, from 0"));
    }
    let is_own = |shard: &u64| {
        if arguments.only.is_empty() {
            shard % count == own
        } else {
            arguments.only.contains(shard)
        }
    };
    Ok(all
        .filter(is_own)
        .filter(|shard| !folder.has(*shard))
        .collect())
}

/// Flies the wanted shards, until it is enough.
fn fly(
    arguments: &Arguments,
    study: &Arc<Study>,
    front: &mut Front<'_>,
    wanted: &[u64],
) -> Result<(), String> {
    let folder = front.folder;
    let orders: Vec<StudyShardOrder> = wanted
        .iter()
        .map(|shard| StudyShardOrder {
            study: Arc::clone(study),
            runs: folder.runs_of(*shard),
        })
        .collect();
    let left = orders
        .iter()
        .map(|order| order.runs.end - order.runs.start)
        .sum();
    let mut progress = Progress::new(left, arguments.quiet);
    let threads = arguments
        .threads
        .map_or_else(workers::processors, |count| count as usize);
    let outcome = workers::run_on(threads, orders, &Lent::default(), &mut |order, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Figures(_) => {
                let rows: Vec<_> = event.read_figures()?;
                progress.add(rows.len() as u64);
                folder.keep(study.design(), wanted[order], rows)?;
                // What others flew beside counts as well.
                front.move_on(study)?;
                if front.is_complete() && front.tally.is_enough() {
                    return Err(ENOUGH.to_owned());
                }
            }
            _ => {}
        }
        Ok(())
    });
    progress.finish();
    match outcome {
        Err(why) if why != ENOUGH => Err(why),
        _ => Ok(()),
    }
}

fn describe(study: &Study, front: &Front<'_>) -> CommandResult {
    let folder = front.folder;
    let is_complete = front.is_complete();
    let missing = (0..folder.shards()).filter(|shard| !is_complete && !folder.has(*shard));
    let description = Description {
        name: study.design().plan().name.clone(),
        flights: study.design().plan().runs(),
        runs_per_shard: folder.runs_of(0).end,
        shards: folder.shards(),
        missing: missing.collect(),
        is_complete,
    };
    println!("{}", serde_json::to_string_pretty(&description)?);
    Ok(())
}
