//! `pilotage reference-map`: a map made into a table of generic landmarks.

use std::path::PathBuf;

use pilotage_core::imagery::Window;
use pilotage_core::reference::{GenericClass, ReferenceTable};
use pilotage_jobs::{JobEvent, ReferenceMapOrder};

use crate::CommandResult;
use crate::files::{MAP_CACHE, open_map_with_frame, write_whole};
use crate::workers::{self, Lent};

/// Arguments of `pilotage reference-map`.
#[derive(clap::Args)]
pub struct Arguments {
    /// The map: `GeoTIFF`, `PMTiles`, or a picture with its georeference beside it.
    map: PathBuf,
    /// File for the table.
    #[arg(long, short)]
    out: PathBuf,
    /// File for the rows of DeAngelo 2016, 3.4, as CSV: pixel x, pixel y, class (1 building, 2 field, 3 tree, 4 crossing,
    /// 5 water, 6 parking).
    #[arg(long, value_name = "FILE")]
    pixel_rows: Option<PathBuf>,
}

/// Makes the table that the arguments ask for.
pub fn run(arguments: &Arguments) -> CommandResult {
    let (map, _) = open_map_with_frame(&arguments.map, MAP_CACHE)?;
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
    let table = ReferenceTable::from_bytes(&bytes)?;
    write_whole(&arguments.out, &bytes)?;
    if let Some(path) = &arguments.pixel_rows {
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
        arguments.out.display(),
        bytes.len(),
        table.landmarks().len(),
        count(GenericClass::Building),
        count(GenericClass::Tree),
        count(GenericClass::Water),
        count(GenericClass::Parking)
    );
    Ok(())
}
