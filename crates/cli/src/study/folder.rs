//! The folder of a study: its plan, a file for each shard that is flown, and what came of all.
//!
//! A shard's file is there whole or not at all, and the same to the bit whoever wrote it: who is killed runs the same
//! command again, and any number of programs may work on one folder.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use pilotage_study::{StudyDesign, StudyPlan, StudyRow, StudySummary};
use serde::{Deserialize, Serialize};

use super::rows::{self, RowWriter};
use crate::files::write_whole;

/// Beginning of a folder, which all who work on it must have in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Begun {
    /// Version of the program: another may fly otherwise.
    program: String,
    runs_per_shard: u64,
    plan: StudyPlan,
}

/// Folder of a study.
pub struct StudyFolder {
    root: PathBuf,
    runs: u64,
    per_shard: u64,
}

impl StudyFolder {
    /// The folder of that plan, begun if it is not there.
    ///
    /// # Errors
    /// A folder that was begun with another plan, size of shards or program.
    pub fn open(root: &Path, plan: &StudyPlan, per_shard: u64) -> Result<Self, String> {
        let shards = root.join("shards");
        fs::create_dir_all(&shards).map_err(|why| format!("{}: {why}", shards.display()))?;
        let begun = Begun {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            runs_per_shard: per_shard,
            plan: plan.clone(),
        };
        let path = root.join("study.json");
        if let Ok(text) = fs::read_to_string(&path) {
            let there: Option<Begun> = serde_json::from_str(&text).ok();
            if there.as_ref() != Some(&begun) {
                return Err(format!(
                    "{} was begun with another plan, size of shards or program; give another folder \
                     with --out, or remove it",
                    root.display()
                ));
            }
        } else {
            let text = serde_json::to_string_pretty(&begun).map_err(|why| why.to_string())?;
            write_whole(&path, text)?;
        }
        Ok(Self {
            root: root.to_owned(),
            runs: plan.runs(),
            per_shard,
        })
    }

    /// Number of shards.
    pub fn shards(&self) -> u64 {
        self.runs.div_ceil(self.per_shard)
    }

    /// Runs of a shard.
    pub fn runs_of(&self, shard: u64) -> Range<u64> {
        let first = shard * self.per_shard;
        first..self.runs.min(first + self.per_shard)
    }

    fn path(&self, shard: u64) -> PathBuf {
        self.root.join("shards").join(format!("{shard:06}.parquet"))
    }

    /// Whether a shard was flown.
    pub fn has(&self, shard: u64) -> bool {
        self.path(shard).is_file()
    }

    /// Keeps the rows of a shard.
    pub fn keep(
        &self,
        design: &StudyDesign,
        shard: u64,
        flown: Vec<StudyRow>,
    ) -> Result<(), String> {
        write_whole(&self.path(shard), rows::encode(design, flown)?)
    }

    /// The rows of a shard.
    pub fn rows(&self, design: &StudyDesign, shard: u64) -> Result<Vec<StudyRow>, String> {
        let path = self.path(shard);
        let blame = |why: &dyn std::fmt::Display| {
            format!(
                "{}: {why}; remove it, and run the study again",
                path.display()
            )
        };
        let bytes = fs::read(&path).map_err(|why| blame(&why))?;
        let rows = rows::decode(design, bytes).map_err(|why| blame(&why))?;
        if !rows.iter().map(|row| row.run).eq(self.runs_of(shard)) {
            return Err(blame(&"it has other runs than those of this shard"));
        }
        Ok(rows)
    }

    /// Writes what came of the study: the table of the flights that count, the summary for programs and for people.
    pub fn conclude(&self, design: &StudyDesign, summary: &StudySummary) -> Result<(), String> {
        let path = self.root.join("rows.parquet");
        let fresh = self
            .root
            .join(format!(".rows.{}.unfinished", std::process::id()));
        let blame = |why: std::io::Error| format!("{}: {why}", path.display());
        let file = fs::File::create(&fresh).map_err(blame)?;
        let mut writer = RowWriter::new(design, std::io::BufWriter::new(file))?;
        let mut shard = 0;
        while shard < self.shards() && self.runs_of(shard).start < summary.flights {
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
        file.sync_all().map_err(blame)?;
        fs::rename(&fresh, &path).map_err(blame)?;
        let mut text = serde_json::to_string_pretty(summary).map_err(|why| why.to_string())?;
        text.push('\n');
        write_whole(&self.root.join("summary.json"), text)?;
        write_whole(&self.root.join("summary.txt"), summary.table())
    }
}
