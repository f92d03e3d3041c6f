//! The folder of a study: its plan, a file for each shard that is flown, and what came of all.

use std::fs;
use std::ops::Range;
use std::path::Path;

use pilotage_study::{StudyDesign, StudyPlan, StudyRow, StudySummary};
use serde::{Deserialize, Serialize};

use super::rows::{self, RowWriter};
use super::shards::Shards;
use crate::files::{unfinished_beside, write_whole};

/// Most shards of a folder, each of which is a file.
const MOST_SHARDS: u64 = 1_000_000;

/// Plan of a folder, and the size of its shards.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Planned {
    runs_per_shard: u64,
    plan: StudyPlan,
}

/// Folder of a study.
pub struct StudyFolder {
    /// Its shards.
    pub shards: Shards,
    runs: u64,
    per_shard: u64,
}

impl StudyFolder {
    /// The folder of that plan, begun if it is not there, unless it is only looked at.
    ///
    /// # Errors
    /// A folder that was begun with another plan, size of shards or program; more shards than a folder can have.
    pub fn open(
        root: &Path,
        plan: &StudyPlan,
        per_shard: u64,
        only_looks: bool,
    ) -> Result<Self, String> {
        let runs = plan.runs();
        if runs.div_ceil(per_shard) > MOST_SHARDS {
            return Err(format!(
                "{runs} flights are more than {MOST_SHARDS} shards of {per_shard}; give --runs-per-shard {} or more",
                runs.div_ceil(MOST_SHARDS)
            ));
        }
        let planned = Planned {
            runs_per_shard: per_shard,
            plan: plan.clone(),
        };
        let count = runs.div_ceil(per_shard);
        Ok(Self {
            shards: Shards::open(root, count, "parquet", planned, only_looks)?,
            runs,
            per_shard,
        })
    }

    /// Runs of a shard.
    pub fn runs_of(&self, shard: u64) -> Range<u64> {
        let first = shard * self.per_shard;
        first..self.runs.min(first + self.per_shard)
    }

    /// Keeps the rows of a shard.
    pub fn keep(
        &self,
        design: &StudyDesign,
        shard: u64,
        flown: Vec<StudyRow>,
    ) -> Result<(), String> {
        self.shards.keep(shard, rows::encode(design, flown)?)
    }

    /// The rows of a shard.
    pub fn rows(&self, design: &StudyDesign, shard: u64) -> Result<Vec<StudyRow>, String> {
        self.shards.read(shard, |bytes| {
            let rows = rows::decode(design, bytes)?;
            if !rows.iter().map(|row| row.run).eq(self.runs_of(shard)) {
                return Err("it has other runs than those of this shard".to_owned());
            }
            Ok(rows)
        })
    }

    /// Writes what came of the study: the table of the flights that count, the summary for programs and for people.
    pub fn conclude(&self, design: &StudyDesign, summary: &StudySummary) -> Result<(), String> {
        let path = self.shards.root.join("rows.parquet");
        let fresh = unfinished_beside(&path);
        let blame = |why: std::io::Error| format!("{}: {why}", path.display());
        let written = self.write_rows(design, summary, &fresh, &blame);
        let written = written.and_then(|()| fs::rename(&fresh, &path).map_err(blame));
        if written.is_err() {
            fs::remove_file(&fresh).ok();
        }
        written?;
        let mut text = serde_json::to_string_pretty(summary).map_err(|why| why.to_string())?;
        text.push('\n');
        write_whole(&self.shards.root.join("summary.json"), text)?;
        write_whole(&self.shards.root.join("summary.txt"), summary.table())
    }

    /// Writes the table of the flights that count to `path`.
    fn write_rows(
        &self,
        design: &StudyDesign,
        summary: &StudySummary,
        path: &Path,
        blame: &dyn Fn(std::io::Error) -> String,
    ) -> Result<(), String> {
        let file = fs::File::create(path).map_err(blame)?;
        let mut writer = RowWriter::new(design, std::io::BufWriter::new(file))?;
        let mut shard = 0;
        while shard < self.shards.count && self.runs_of(shard).start < summary.flights {
            let rows = self.rows(design, shard)?.into_iter();
            for row in rows.filter(|row| row.run < summary.flights) {
                writer.push(row)?;
            }
            shard += 1;
        }
        let file = writer
            .finish()?
            .into_inner()
            .map_err(|why| blame(why.into_error()))?;
        file.sync_all().map_err(blame)
    }
}
