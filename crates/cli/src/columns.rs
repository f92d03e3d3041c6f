//! `pilotage columns`: what the columns of tables mean, shown, and saved to be edited.

use std::path::PathBuf;

use pilotage_core::flight::columns::{
    ColumnMap, ColumnRole, MappedColumn, guess_tables, tables_lack, tables_lack_to_navigate,
};
use pilotage_jobs::COLUMNS_FILE;

use crate::CommandResult;
use crate::opening::{said, tables_at};

/// Tables to look at.
#[derive(clap::Args)]
pub struct Arguments {
    /// Tables of a flight (.csv, .tsv, .txt), or a folder of them.
    #[arg(required = true)]
    tables: Vec<PathBuf>,
    /// Print the map as JSON, to be edited and given to --columns of this and other commands.
    #[arg(long)]
    json: bool,
    /// Write that JSON to a file; without a name to columns.json beside the tables, where all commands and the page
    /// find it.
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "")]
    save: Option<String>,
    /// Start from this map instead of a guess.
    #[arg(long, value_name = "MAP")]
    columns: Option<PathBuf>,
    /// Guess, even where a columns.json lies beside the tables.
    #[arg(long, conflicts_with = "columns")]
    guess: bool,
}

/// Shows or saves what the columns mean.
pub fn run(arguments: &Arguments) -> CommandResult {
    let (files, names) = tables_at(&arguments.tables)?;
    let known = if arguments.guess {
        None
    } else {
        said(files.as_ref(), &names, arguments.columns.as_deref())?
    };
    let maps = known.unwrap_or_else(|| {
        let tables = guess_tables(files.as_ref(), &names);
        let is_some = tables.iter().any(|table| table.is_proposed);
        let tables = tables.into_iter();
        let tables = tables.filter(|table| table.is_proposed || !is_some);
        tables.map(|table| table.map).collect()
    });
    if maps.is_empty() {
        return Err("none of these is a table with numbers".into());
    }
    let json = serde_json::to_string_pretty(&maps)?;
    if arguments.json {
        println!("{json}");
    } else {
        maps.iter().for_each(print);
        let all: Vec<&ColumnMap> = maps.iter().collect();
        if let Some(lack) = tables_lack(&all) {
            println!("no flight yet: {lack}");
        } else if let Some(lack) = tables_lack_to_navigate(&all) {
            println!("a flight, but {lack}");
        }
    }
    if let Some(path) = &arguments.save {
        let path = if path.is_empty() {
            let first = &arguments.tables[0];
            let folder = if first.is_dir() {
                first.as_path()
            } else {
                first.parent().unwrap_or(first)
            };
            folder.join(COLUMNS_FILE)
        } else {
            PathBuf::from(path)
        };
        crate::files::write_whole(&path, json)?;
        eprintln!("written to {}", path.display());
    }
    Ok(())
}

/// A line a column: what it means and why.
fn print(map: &ColumnMap) {
    println!("{}:", map.file);
    for column in &map.columns {
        let meaning = match column.role {
            ColumnRole::Nothing => "-".to_owned(),
            role => role.label(),
        };
        println!(
            "    {:28} {:24} {:12} {:3.0} %  {}",
            column.name,
            meaning,
            unit(column),
            100.0 * column.confidence,
            column.reason
        );
    }
    if let Some(rate) = map.rows_per_second {
        println!("    {rate} rows a second");
    }
    for finding in &map.findings {
        println!("found: {finding}");
    }
    for question in &map.questions {
        println!("question: {question}");
    }
}

/// The unit of a column, with what is done to its numbers before.
fn unit(column: &MappedColumn) -> String {
    let mut words = column.unit.clone();
    if column.scale != 1.0 {
        words = format!("{words} · {}", column.scale);
    }
    if column.offset != 0.0 {
        words = format!("{words} {:+}", column.offset);
    }
    words
}
