//! `pilotage study PLAN.toml`: flies what is left of a study, and sums up.

use std::sync::Arc;

use pilotage_jobs::{JobEvent, StudyShardOrder};
use pilotage_study::{Study, StudyPlan, StudyRecord, StudyTally};

use super::arguments::Arguments;
use super::folder::StudyFolder;
use super::progress::Progress;
use super::results;
use crate::CommandResult;
use crate::files::write_whole;
use crate::mission_file::OpenMission;
use crate::notes::tell;
use crate::workers::{self, Lent};

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
        while !self.is_complete() && self.folder.shards.has(self.next) {
            for row in self.folder.rows(study.design(), self.next)? {
                self.tally.take(row).map_err(|why| why.to_string())?;
            }
            self.next += 1;
        }
        Ok(())
    }

    /// Whether no more shards are needed.
    fn is_complete(&self) -> bool {
        self.tally.is_enough() || self.next == self.folder.shards.count
    }
}

/// Word with which the work is given up because it is enough.
const ENOUGH: &str = "enough";

/// Carries out the study.
pub fn run(arguments: &Arguments, text: &str) -> CommandResult {
    let plan = read_plan(arguments, text)?;
    if !arguments.quiet {
        tell(&plan.notes());
    }
    if let Some(path) = &arguments.pack {
        return Ok(write_whole(path, plan.to_toml()?)?);
    }
    let root = arguments.folder(&plan.name);
    let per_shard = arguments.runs_per_shard;
    let folder = StudyFolder::open(&root, &plan, per_shard, arguments.only_looks())?;
    let study = Arc::new(Study::new(plan)?);
    let mut front = Front::new(&folder, &study);
    front.move_on(&study)?;
    if arguments.describe {
        return describe(&study, &front);
    }
    let is_part = arguments.is_part();
    if !arguments.merge && !front.is_complete() {
        let wanted = arguments.wanted(&folder.shards)?;
        fly(arguments, &study, &mut front, &wanted)?;
    }
    if is_part {
        return Ok(());
    }
    if !front.is_complete() {
        return Err(folder.shards.lacking().into());
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

/// The plan of a text, with the mission files beside it that it names.
fn read_plan(arguments: &Arguments, text: &str) -> Result<StudyPlan, String> {
    let file = |name: &str| arguments.beside().join(name);
    let mut mission = |name: &str| Ok(OpenMission::read(&file(name))?.package.mission);
    StudyPlan::read_with(text, &mut mission).map_err(|why| arguments.blamed(why))
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
    let threads = arguments.threads();
    // Each is kept when it is done, for who is killed to lose no more than is under way.
    let outcome = workers::run_as_done(threads, orders, &Lent::default(), &mut |order, event| {
        match event {
            JobEvent::Failed(why) => return Err(format!("shard {}: {why}", wanted[order])),
            JobEvent::Figures(_) => {
                let rows: Vec<_> = event.read_figures()?;
                progress.add(rows.len() as u64);
                folder.keep(study.design(), wanted[order], rows)?;
                // What others flew beside counts as well.
                front.move_on(study)?;
                // Whoever asked for these shards alone waits for all of them.
                if arguments.only.is_empty() && front.tally.is_enough() {
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
    let plan = study.design().plan();
    let shards = &folder.shards;
    Ok(shards.describe(&plan.name, plan.runs(), folder.runs_of(0).end, is_complete)?)
}
