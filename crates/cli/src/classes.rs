//! `pilotage classes`: the classes of the ground, trained and judged.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use pilotage_core::ground_class::{CELL_PIXELS, CoverNetwork, GroundCover};
use pilotage_core::raster::decode_picture;
use pilotage_core::training::ground_classes::{
    ClassExamples, ClassTraining, CoverJudgement, GeneratedTiles, LabelledTile, PairCounts,
    PlaceErrors,
};

use crate::files::write_whole;
use crate::{CommandResult, class_words};

/// Arguments of `pilotage classes`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    job: Job,
}

#[derive(Subcommand)]
enum Job {
    /// Train the network that tells classes of the ground.
    Train(Train),
    /// Judge it in generated countries, or on tiles of one's own.
    Judge(Judge),
    /// Measure how well landmarks of these classes lie where the map has them, from 1000 ft on other days.
    Places(Places),
    /// Count right and wrong pairs of such landmarks with those of the map.
    Pairs(Pairs),
}

#[derive(clap::Args)]
struct Train {
    /// Folder of labelled tiles of 0.75 m per pixel: in it one folder per class (field, tree, building, paved, water) with
    /// JPEG or PNG pictures. The generated country if absent.
    folder: Option<PathBuf>,
    /// Way by which classes are told. The network tells every metre or two, of these five classes. Words tell a whole
    /// tile, of any classes: one folder for each in FOLDER, named as one likes (bag of words, DeAngelo 2016).
    #[arg(long, value_enum, default_value_t)]
    by: Way,
    /// Generated countries to learn from, each on days of its own.
    #[arg(long, default_value_t = 14)]
    countries: u64,
    /// Tiles of each country.
    #[arg(long, default_value_t = 24)]
    tiles: usize,
    /// Rounds over all examples.
    #[arg(long, default_value_t = ClassTraining::default().rounds)]
    rounds: usize,
    /// Draws countries, days, weights; 1 or more, since those of 0 are the ones that weights are judged by.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    seed: u64,
    /// File for the weights.
    #[arg(long)]
    out: PathBuf,
}

/// Way by which classes are told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Way {
    #[default]
    Network,
    Words,
}

#[derive(clap::Args)]
struct Places {
    /// Weights; those of the program if absent.
    #[arg(long)]
    weights: Option<PathBuf>,
    /// Generated countries.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u64).range(1..))]
    countries: u64,
    /// Number of the first of them.
    #[arg(long, default_value_t = MEASURED)]
    first: u64,
    /// Pictures of each.
    #[arg(long, default_value_t = 12)]
    pictures: usize,
}

#[derive(clap::Args)]
struct Pairs {
    #[command(flatten)]
    looks: Places,
    /// Error of the believed position per axis, metres.
    #[arg(long, default_value_t = 60.0)]
    deviation: f64,
}

#[derive(clap::Args)]
struct Judge {
    /// Folder of labelled tiles, as for training. Generated countries that the weights at hand did not learn from if absent.
    folder: Option<PathBuf>,
    /// Way by which classes are told, as in training; words need FOLDER and weights.
    #[arg(long, value_enum, default_value_t)]
    by: Way,
    /// Weights; those of the program if absent.
    #[arg(long)]
    weights: Option<PathBuf>,
    /// Generated countries.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u64).range(1..))]
    countries: u64,
    /// Tiles of each.
    #[arg(long, default_value_t = 8)]
    tiles: usize,
}

/// First number of the countries to learn from; those to judge by come from below it, among them the built-in one.
const LEARNED: u64 = 1000;
/// First number of the countries in which places are measured.
const MEASURED: u64 = 200;
/// Days of a country.
const DAYS: u64 = 2;

/// Does what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    match &arguments.job {
        Job::Train(arguments) => train(arguments),
        Job::Judge(arguments) => judge(arguments),
        Job::Places(arguments) => places(arguments),
        Job::Pairs(arguments) => pairs(arguments),
    }
}

fn train(arguments: &Train) -> CommandResult {
    if arguments.by == Way::Words {
        let folder = arguments.folder.as_deref().ok_or("words need FOLDER")?;
        return class_words::train(folder, arguments.seed, &arguments.out);
    }
    let mut examples = ClassExamples::drawn_by(arguments.seed);
    if let Some(folder) = &arguments.folder {
        for tile in labelled_tiles(folder)? {
            examples.add(&tile);
        }
    } else {
        if arguments.tiles == 0 {
            return Err("--tiles 0: there is nothing to learn from; say one or more".into());
        }
        let first = LEARNED * arguments.seed;
        for number in 0..arguments.countries * DAYS {
            let country = GeneratedTiles::of(first + number / DAYS, first + number);
            for tile in country.take(tiles_of_day(arguments.tiles, number % DAYS)) {
                examples.add(&tile);
            }
            eprintln!("country {} of {}", number / DAYS + 1, arguments.countries);
        }
    }
    println!("{} examples", examples.covers.len());
    let training = ClassTraining {
        rounds: arguments.rounds,
        seed: arguments.seed,
        ..ClassTraining::default()
    };
    let network = training.train(&examples, &mut |round, loss| {
        eprintln!("round {round}: cross entropy {loss:.4}");
    })?;
    write_whole(&arguments.out, network.to_bytes())?;
    println!("wrote {}", arguments.out.display());
    Ok(())
}

fn judge(arguments: &Judge) -> CommandResult {
    if arguments.by == Way::Words {
        let both = arguments
            .folder
            .as_deref()
            .zip(arguments.weights.as_deref());
        let (folder, weights) = both.ok_or("words need FOLDER and --weights")?;
        return class_words::judge(folder, weights);
    }
    let network = network(arguments.weights.as_deref())?;
    let mut judgement = CoverJudgement::default();
    if let Some(folder) = &arguments.folder {
        for tile in labelled_tiles(folder)? {
            judgement.add(&tile, &network);
        }
    } else {
        for number in 0..arguments.countries {
            for tile in GeneratedTiles::of(7 + number, 500 + number).take(arguments.tiles) {
                judgement.add(&tile, &network);
            }
        }
    }
    print!("{judgement}");
    Ok(())
}

fn places(arguments: &Places) -> CommandResult {
    let network = network(arguments.weights.as_deref())?;
    let mut errors = PlaceErrors::default();
    for number in 0..arguments.countries {
        let country = arguments.first + number;
        errors.look(country, 10 * country, arguments.pictures, &network);
    }
    print!("{errors}");
    Ok(())
}

fn pairs(arguments: &Pairs) -> CommandResult {
    let looks = &arguments.looks;
    let network = network(looks.weights.as_deref())?;
    let mut counts = PairCounts::default();
    for number in 0..looks.countries {
        let country = looks.first + number;
        let of_country = (country, 10 * country);
        counts.look(of_country, looks.pictures, arguments.deviation, &network);
    }
    print!("{counts}");
    Ok(())
}

/// Tiles of one day of a country, of `tiles` of all its days: the first days have what cannot be shared evenly.
fn tiles_of_day(tiles: usize, day: u64) -> usize {
    (tiles + (DAYS - 1 - day) as usize) / DAYS as usize
}

/// The network of a file of weights, or that of the program.
fn network(weights: Option<&Path>) -> Result<CoverNetwork, Box<dyn std::error::Error>> {
    let Some(path) = weights else {
        return Ok(CoverNetwork::usual());
    };
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(CoverNetwork::from_bytes(&bytes)?)
}

/// Tiles of the folders that are named like classes.
fn labelled_tiles(folder: &Path) -> Result<Vec<LabelledTile>, Box<dyn std::error::Error>> {
    let mut tiles = Vec::new();
    for cover in GroundCover::ALL {
        let of_class = folder.join(cover.key());
        if !of_class.is_dir() {
            continue;
        }
        let entries = std::fs::read_dir(&of_class)?;
        let mut paths: Vec<PathBuf> = entries
            .map(|e| e.map(|e| e.path()))
            .collect::<Result<_, _>>()?;
        paths.sort();
        for path in paths {
            let bytes = std::fs::read(&path)?;
            let picture = decode_picture(&bytes).map_err(|e| format!("{}: {e}", path.display()))?;
            let cells = (picture.width() / CELL_PIXELS) * (picture.height() / CELL_PIXELS);
            tiles.push(LabelledTile {
                picture: picture.map(|[r, g, b]| [r, g, b, u8::MAX]),
                covers: vec![Some(cover); cells],
            });
        }
    }
    if tiles.is_empty() {
        let keys = GroundCover::ALL.map(GroundCover::key).join(", ");
        let folder = folder.display();
        return Err(
            format!("{folder}: there is no folder named {keys} with pictures in it").into(),
        );
    }
    Ok(tiles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tile_that_was_asked_for_is_of_some_day() {
        for tiles in 1..=25 {
            let days = (0..DAYS).map(|day| tiles_of_day(tiles, day));
            assert_eq!(days.sum::<usize>(), tiles);
        }
        assert_eq!([0, 1].map(|day| tiles_of_day(5, day)), [3, 2]);
    }
}
