//! `pilotage convert`: routes and landmarks from one file format into another.

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser};
use pilotage_core::exchange::{
    ExchangeError, Format, Imported, Places, write_landmarks, write_places,
};
use pilotage_core::mission::Route;
use pilotage_core::mission::package::{MissionPackage, read_package};
use pilotage_core::navigator::NavigatorSettings;
use pilotage_jobs::read_exchange;

use crate::CommandResult;
use crate::opening::{foreign_words, has_ending};

/// Arguments of `pilotage convert`.
#[derive(clap::Args)]
pub struct Arguments {
    /// File with routes or landmarks, or labels of pictures.
    #[arg(help = from_help())]
    from: PathBuf,
    /// File to write; its extension names the format.
    to: PathBuf,
    /// Take only this route, by its name or its number in the file, counted from one.
    #[arg(long, value_name = "NAME|N", conflicts_with = "landmarks")]
    route: Option<String>,
    /// Take only the landmarks.
    #[arg(long)]
    landmarks: bool,
    /// Write the mission of a maker, whose files have the extension of another format.
    #[arg(long = "as", value_name = "MAKER", conflicts_with = "landmarks", value_parser = makers())]
    maker: Option<String>,
}

/// Explanation of what is read, with the endings of all formats.
fn from_help() -> String {
    format!(
        "File with routes or landmarks ({}), or a table of them that is known by its content: .cup of SeeYou, .wpt of \
         OziExplorer, .MRK of DJI, control points (gcp_list.txt). Or labels of pictures: COCO (.json), Pascal VOC \
         (.xml, a .zip or a folder of them)",
        Format::all_extensions()
    )
}

/// Makers whose missions have the extensions of other files.
fn makers() -> PossibleValuesParser {
    let makers = Format::of_makers();
    PossibleValuesParser::new(makers.map(|(maker, format)| {
        PossibleValue::new(maker).help(format!(
            "{} in a .{}",
            format.name(),
            format.extensions()[0]
        ))
    }))
}

/// Reads, chooses and writes; what was assumed or left out is told on the error stream.
pub fn run(arguments: &Arguments) -> CommandResult {
    let (from, to) = (&arguments.from, &arguments.to);
    if let Some((_, labels)) = crate::labels::read(from)? {
        return crate::labels::convert(labels, to);
    }
    let name = to.to_string_lossy();
    let named = Format::to_write(&name);
    let maker = arguments.maker.as_deref();
    let of_maker = maker.and_then(|maker| Format::of_makers().find(|(own, _)| *own == maker));
    let of_maker = of_maker.map(|(_, format)| format);
    if let Some(format) = of_maker {
        let extension = format.extensions()[0];
        if named.is_none_or(|named| named.extensions()[0] != extension) {
            let what = format.as_words();
            return Err(format!("{name}: the file of {what} is a .{extension}").into());
        }
    }
    let format = of_maker.or(named).ok_or_else(|| {
        let known: Vec<_> = Format::told_by_extension()
            .map(|f| f.extensions()[0])
            .collect();
        format!(
            "{name}: the extension names no format; known are .{}",
            known.join(", .")
        )
    })?;
    let bytes = std::fs::read(from).map_err(|e| format!("{}: {e}", from.display()))?;
    let mut imported = read_exchange(&from.to_string_lossy(), &bytes, None).map_err(|error| {
        // What is of another kind is called by its name; plain text may be anything.
        let may_be_any = has_ending(from, &["txt", "csv", "json"])
            || !Format::told_by_extension().any(|f| has_ending(from, f.extensions()));
        let is_unsure = may_be_any && !bytes.starts_with(b"QGC");
        let is = match error {
            ExchangeError::Unknown { .. } => foreign_words(from),
            ExchangeError::Place { .. } | ExchangeError::File { .. } if is_unsure => {
                foreign_words(from)
            }
            _ => None,
        };
        // What this command reads is not called by its name: the error says what is wrong in it.
        is.filter(|is| !is.contains("pilotage convert"))
            .unwrap_or_else(|| error.to_string())
    })?;
    tell(from, &imported.notes);
    let mut notes = Vec::new();
    let left_out = parts_of_a_mission(&bytes);
    if !left_out.is_empty() {
        let words = format!("without what no format of places holds: {left_out}");
        if is_same_file(from, to) {
            return Err(format!("{name}: it would be {words}; name another file to write").into());
        }
        notes.push(words);
    }
    if let Some(wanted) = &arguments.route {
        imported.routes = vec![chosen(&imported, wanted)?];
        leave_out_landmarks(&mut imported, &mut notes, "one route was asked for");
    } else if arguments.landmarks {
        imported.routes.clear();
    } else if !imported.routes.is_empty() && !format.holds_both() {
        leave_out_landmarks(&mut imported, &mut notes, "--landmarks takes them alone");
    }
    if !format.holds_several_routes() && imported.routes.len() > 1 {
        let names: Vec<_> = imported.routes.iter().map(|r| r.name.as_str()).collect();
        return Err(format!(
            "{name}: {} holds one route; choose by --route one of: {}",
            format.name(),
            names.join(", ")
        )
        .into());
    }
    let written = if arguments.landmarks {
        write_landmarks(format, &imported.landmarks, &imported.frame)?
    } else {
        let places = Places {
            routes: &imported.routes,
            landmarks: &imported.landmarks,
            no_fly: &imported.no_fly,
            rally: Some(&imported.rally),
        };
        write_places(format, &places, &imported.frame)?
    };
    crate::files::write_whole(to, &written.bytes)?;
    notes.extend(written.notes);
    tell(to, &notes);
    let no_fly = match imported.no_fly.len() {
        number if number == 0 || arguments.landmarks || !format.holds_areas() => String::new(),
        number => format!(", {}", count(number, "no-fly area")),
    };
    let holds_rally = format.holds_rally(!imported.routes.is_empty());
    let rally = match imported.rally.len() {
        number if number == 0 || arguments.landmarks || !holds_rally => String::new(),
        number => format!(", {}", count(number, "rally point")),
    };
    println!(
        "{name}: {}, {} and {}{no_fly}{rally}",
        format.name(),
        count(imported.routes.len(), "route"),
        count(imported.landmarks.len(), "landmark")
    );
    Ok(())
}

/// Parts of a mission of this program that it has beside routes, landmarks, no-fly areas and rally points, in words; none of
/// another file.
fn parts_of_a_mission(bytes: &[u8]) -> String {
    let Ok(MissionPackage {
        mission, settings, ..
    }) = read_package(bytes)
    else {
        return String::new();
    };
    let few = |number: usize, what| (number > 0).then(|| count(number, what));
    let one = |is_there: bool, what: &str| is_there.then(|| what.to_owned());
    let has_settings = mission.navigator != NavigatorSettings::default();
    let parts = [
        one(mission.camera.is_some(), "its camera"),
        one(mission.camera_to_log.is_some(), "that camera's adjustment"),
        one(has_settings, "settings of the navigator"),
        few(mission.roads.len(), "road"),
        few(mission.labels.len(), "labelled picture"),
        one(mission.map.is_some(), "the name of its map"),
        one(!settings.is_empty(), "what was open beside it"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    parts.join(", ")
}

/// Whether both paths lead to one file.
fn is_same_file(one: &Path, other: &Path) -> bool {
    match (one.canonicalize(), other.canonicalize()) {
        (Ok(one), Ok(other)) => one == other,
        _ => false,
    }
}

fn tell(file: &Path, notes: &[String]) {
    for note in notes {
        eprintln!("note: {}: {note}", file.display());
    }
}

fn count(number: usize, what: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{number} {what}{ending}")
}

fn leave_out_landmarks(imported: &mut Imported, notes: &mut Vec<String>, why: &str) {
    if !imported.landmarks.is_empty() {
        let left_out = count(imported.landmarks.len(), "landmark");
        notes.push(format!("without {left_out}: {why}"));
        imported.landmarks.clear();
    }
}

/// The route of that name, or else of that number.
fn chosen(imported: &Imported, wanted: &str) -> Result<Route, String> {
    let routes = &imported.routes;
    let by_name = routes.iter().find(|route| route.name == wanted);
    let by_number = || {
        let number: usize = wanted.parse().ok()?;
        routes.get(number.checked_sub(1)?)
    };
    by_name.or_else(by_number).cloned().ok_or_else(|| {
        let names: Vec<_> = routes.iter().map(|r| r.name.as_str()).collect();
        format!(
            "there is no route `{wanted}`; there are: {}",
            names.join(", ")
        )
    })
}
