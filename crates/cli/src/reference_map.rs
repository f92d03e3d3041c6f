//! `pilotage reference-map`: a map made into a table of generic landmarks.

use std::path::{Path, PathBuf};

use pilotage_core::imagery::Window;
use pilotage_core::reference::edges::EDGE_GSD;
use pilotage_core::reference::{GenericClass, ReferenceTable};
use pilotage_jobs::{JobEvent, ReferenceMapOrder};

use crate::files::write_whole;
use crate::maps::{MAP_CACHE, open_map};
use crate::notes::told;
use crate::numbers::above_zero;
use crate::workers::{self, Lent};
use crate::{CommandResult, locate_photo};

/// Arguments of `pilotage reference-map`.
#[derive(clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
    #[command(subcommand)]
    job: Option<Job>,
    /// The map: `GeoTIFF`, `PMTiles`, or a picture with its georeference beside it.
    #[arg(required = true)]
    map: Option<PathBuf>,
    /// File for the table.
    #[arg(long, short, required = true)]
    out: Option<PathBuf>,
    /// Make a table of straight edges alone, by which `locate` places photos.
    #[arg(long)]
    edges: bool,
    /// Metres in a pixel in which edges are sought: less than half a metre for flights below 100 m.
    #[arg(long, value_name = "METRES", default_value_t = EDGE_GSD, value_parser = above_zero, requires = "edges")]
    gsd: f64,
    /// File for the rows of DeAngelo 2016, chapter 3, as CSV: pixel x, pixel y, class (1 building, 2 field, 3 tree, 4 crossing,
    /// 5 water, 6 parking).
    #[arg(long, value_name = "FILE", conflicts_with = "edges")]
    pixel_rows: Option<PathBuf>,
}

#[derive(clap::Subcommand)]
enum Job {
    /// Place a photo by a table of straight edges, without its map.
    Locate(locate_photo::Arguments),
}

/// Does what the arguments ask for.
pub fn run(arguments: &Arguments) -> CommandResult {
    if let Some(Job::Locate(arguments)) = &arguments.job {
        return locate_photo::run(arguments);
    }
    match (&arguments.map, &arguments.out) {
        (Some(map), Some(out)) if arguments.edges => {
            locate_photo::make_table(map, out, arguments.gsd)
        }
        (Some(map), Some(out)) => make_table(map, out, arguments.pixel_rows.as_deref()),
        _ => Err("there is no map, or no file for its table".into()),
    }
}

/// Makes the table of a map.
fn make_table(map: &Path, out: &Path, pixel_rows: Option<&Path>) -> CommandResult {
    let opened = open_map(map, None, MAP_CACHE)?;
    let frame = opened.frame;
    let map = told(opened);
    let picture = Window::covering(&map.bounds(), map.native_gsd());
    let lent = Lent::default().with_map(Lent::map_of_file(), map);
    let mut bytes: Vec<u8> = Vec::new();
    let mut shown = usize::MAX;
    let orders = vec![ReferenceMapOrder(Lent::map_of_file())];
    workers::run(orders, &lent, &mut |_, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Progress(share, what) => {
                let percent = (100.0 * share) as usize;
                if percent / 10 != shown {
                    shown = percent / 10;
                    eprintln!("{percent:3} %  {what}");
                }
            }
            JobEvent::Figures(_) => bytes = event.read_figures()?,
            _ => {}
        }
        Ok(())
    })?;
    let table = ReferenceTable::from_bytes(&bytes)?.on_globe(frame.map(|frame| frame.origin));
    let bytes = table.to_bytes();
    write_whole(out, &bytes)?;
    if let Some(path) = pixel_rows {
        let rows = table.pixel_rows(&picture);
        let lines = rows
            .iter()
            .map(|[x, y, class]| format!("{x},{y},{class}\n"));
        write_whole(path, lines.collect::<String>())?;
    }
    let count = |class| {
        table
            .landmarks()
            .iter()
            .filter(|l| l.class == class)
            .count()
    };
    println!(
        "wrote {} ({} bytes): {} landmarks, of them {} buildings, {} trees, {} waters, {} paved places",
        out.display(),
        bytes.len(),
        table.landmarks().len(),
        count(GenericClass::Building),
        count(GenericClass::Tree),
        count(GenericClass::Water),
        count(GenericClass::Parking)
    );
    Ok(())
}
