//! Arguments of `pilotage study PLAN`, and the shards that they ask for.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use super::shards::Shards;
use crate::workers;

/// Reason to give a study up before its end.
#[derive(Clone, Copy, clap::ValueEnum)]
pub enum GiveUpChoice {
    /// The standard input ends, as it does when the program that waits for the study is no more.
    InputEnds,
}

/// Arguments of `pilotage study PLAN`.
#[derive(clap::Args)]
#[group(id = "study_plan")]
pub struct Arguments {
    /// Plan of the study or of the work on a map, TOML.
    pub plan: PathBuf,
    /// Folder for shards and summary; what is there already is not flown again. NAME.study if not given.
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    /// Flights of a shard; work on a map has pieces of its own: what is lost at most when the program is killed.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    pub runs_per_shard: u64,
    /// Number of programs that share the shards; each flies its own, and none sums up.
    #[arg(long, value_name = "N", requires = "share", value_parser = clap::value_parser!(u64).range(1..))]
    pub shares: Option<u64>,
    /// Number of this program among them, from 0.
    #[arg(long, value_name = "I", requires = "shares")]
    pub share: Option<u64>,
    /// Flies these shards alone, separated by commas, and does not sum up.
    #[arg(
        long,
        value_name = "NUMBERS",
        value_delimiter = ',',
        conflicts_with = "share"
    )]
    pub only: Vec<u64>,
    /// Flies nothing: sums up what is there.
    #[arg(long, conflicts_with_all = ["share", "only"])]
    pub merge: bool,
    /// Prints how many shards there are and which are there, as JSON, and flies nothing.
    #[arg(long, conflicts_with_all = ["share", "only", "merge"])]
    pub describe: bool,
    /// Writes the plan as other machines need it, TOML, and flies nothing: that of a study with the mission files that it
    /// names in it; that of work on a map with the full paths of its files, which are read where they are.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["share", "only", "merge", "describe", "record"])]
    pub pack: Option<PathBuf>,
    /// Threads; as many as there are processors if not given.
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    pub threads: Option<u64>,
    /// Goes on until then and no longer, whatever is under way; shards that are whole stay.
    #[arg(long, value_name = "WHEN")]
    pub until: Option<GiveUpChoice>,
    /// Keeps a record of the whole study in this folder, for the measured results.
    #[arg(long, value_name = "FOLDER", requires = "made", conflicts_with_all = ["share", "only", "describe"])]
    pub record: Option<PathBuf>,
    /// Date and state of the program that the record tells.
    #[arg(long, value_name = "TEXT", requires = "record")]
    pub made: Option<String>,
    /// Tells no progress and prints no table.
    #[arg(long)]
    pub quiet: bool,
}

impl Arguments {
    /// Text of the plan.
    pub fn text(&self) -> Result<String, String> {
        std::fs::read_to_string(&self.plan).map_err(|why| self.blamed(why))
    }

    /// Words on what is wrong with the plan, with its file.
    pub fn blamed(&self, why: impl Display) -> String {
        format!("{}: {why}", self.plan.display())
    }

    /// Folder of the plan, beside which the files that it names lie.
    pub fn beside(&self) -> &Path {
        self.plan.parent().unwrap_or(Path::new(""))
    }

    /// Folder for what comes of a plan of that name.
    pub fn folder(&self, name: &str) -> PathBuf {
        let stated = self.out.clone();
        stated.unwrap_or_else(|| PathBuf::from(format!("{name}.study")))
    }

    /// Whether this program does a part of the shards and leaves it to others to sum up.
    pub fn is_part(&self) -> bool {
        self.share.is_some() || !self.only.is_empty()
    }

    /// Numbers of the shards that this program does: those that are asked for and not there.
    pub fn wanted(&self, shards: &Shards) -> Result<Vec<u64>, String> {
        let all = 0..shards.count;
        if let Some(beyond) = self.only.iter().find(|shard| !all.contains(shard)) {
            return Err(format!(
                "--only {beyond}: there are {} shards, from 0",
                all.end
            ));
        }
        let (count, own) = (self.shares.unwrap_or(1), self.share.unwrap_or(0));
        if own >= count {
            return Err(format!("--share {own}: there are {count} shares, from 0"));
        }
        let is_own = |shard: &u64| {
            if self.only.is_empty() {
                shard % count == own
            } else {
                self.only.contains(shard)
            }
        };
        Ok(all
            .filter(is_own)
            .filter(|shard| !shards.has(*shard))
            .collect())
    }

    /// Whether it only looks at what is there, so that no folder is begun.
    pub fn only_looks(&self) -> bool {
        self.describe || self.merge
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.threads
            .map_or_else(workers::processors, |count| count as usize)
    }
}
