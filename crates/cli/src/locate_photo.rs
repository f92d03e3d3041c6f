//! `pilotage reference-map locate`: photos placed by the straight edges of a table.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use nalgebra::Point3;
use pilotage_core::flight::photo::{PhotoLook, PhotoRow, PhotoSearch, photo_pose};
use pilotage_core::frames::{Attitude, Geodetic, GroundPoint, GroundRect, LocalFrame, Pose};
use pilotage_core::imagery::ByteSource as _;
use pilotage_core::reference::ReferenceTable;
use pilotage_core::reference::edges::{
    EDGE, EDGE_GSD, EDGES, PhotoBelief, PhotoEdges, edges_in_map,
};
use pilotage_core::registration::{HeadingPrior, limit_of};
use pilotage_jobs::decode_photo;

use crate::CommandResult;
use crate::files::{DiskFile, write_whole};
use crate::maps::{MAP_CACHE, open_map};
use crate::notes::told;
use crate::numbers::{above_zero, numbers};
use crate::photo_search::{KnownOfPhotos, SearchRanges, TablesBesidePhotos, photo_file};

/// Probability from which on a place is believed.
const BELIEVED: f64 = 0.9;
/// Standard deviation of roll and pitch, radians.
const TILT: f64 = 0.035;

/// Time after which a search tells how much of it is done.
const QUIET: Duration = Duration::from_secs(2);

/// Most pixels in which edges are sought: they are in memory at once.
const MOST_PIXELS: f64 = 1e9;

/// Arguments of `pilotage reference-map locate`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Table made by `pilotage reference-map --edges`.
    table: PathBuf,
    /// Photos (JPEG, TIFF or PNG) of a camera that looks down.
    #[arg(required = true, value_name = "PHOTO")]
    photos: Vec<PathBuf>,
    #[command(flatten)]
    known: KnownOfPhotos,
    /// Place below the camera in metres from the origin of the map's world, where nothing tells where on the globe that
    /// is.
    #[arg(
        long,
        value_name = "NORTH,EAST",
        allow_hyphen_values = true,
        conflicts_with = "at"
    )]
    at_metres: Option<String>,
    /// Range of the search to each side of the place, metres.
    #[arg(long, value_name = "METRES", default_value_t = 25.0)]
    within: f64,
    /// Range of the search around the height, percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 13.0)]
    height_within: f64,
    /// Range of the search to each side of the heading, degrees.
    #[arg(long, value_name = "DEGREES", default_value_t = 15.0)]
    heading_within: f64,
    /// Metres in a pixel in which edges are sought; those of the table if absent.
    #[arg(long, value_name = "METRES", value_parser = above_zero)]
    gsd: Option<f64>,
}

/// Makes the table of the straight edges of a map, sought in pixels of `gsd` metres.
pub fn make_table(map: &Path, out: &Path, gsd: f64) -> CommandResult {
    let opened = open_map(map, None, MAP_CACHE)?;
    let frame = opened.frame;
    let map = told(opened);
    let bounds = map.bounds();
    let pixels = bounds.width() / gsd * (bounds.height() / gsd);
    if pixels > MOST_PIXELS {
        return Err(format!(
            "--gsd: {gsd} m makes {:.0} million pixels of the map; {:.0} million are the most",
            1e-6 * pixels,
            1e-6 * MOST_PIXELS
        )
        .into());
    }
    let edges = edges_in_map(map.as_ref(), gsd, EDGES);
    let table = ReferenceTable::new(edges, vec![EDGE.to_owned()])
        .on_globe(frame.map(|frame| frame.origin))
        .sought_in(gsd);
    let bytes = table.to_bytes();
    write_whole(out, &bytes)?;
    println!(
        "wrote {} ({} bytes): {} straight edges",
        out.display(),
        bytes.len(),
        table.landmarks().len()
    );
    if table.origin().is_none() {
        println!("nothing tells where on the globe the map lies: photos need --at-metres");
    }
    Ok(())
}

/// Places photos.
pub fn run(arguments: &Arguments) -> CommandResult {
    let path = arguments.table.display();
    let bytes = std::fs::read(&arguments.table).map_err(|e| format!("{path}: {e}"))?;
    let table = ReferenceTable::from_bytes(&bytes).map_err(|e| format!("{path}: {e}"))?;
    let mut search = arguments.known.search(&SearchRanges {
        metres: arguments.within,
        height_percent: arguments.height_within,
        heading_degrees: arguments.heading_within,
    })?;
    let world = table.origin().map(LocalFrame::new);
    // Places in metres are those of any world, wherever on the globe it lies.
    let anywhere = world.unwrap_or(LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0)));
    if let Some(metres) = &arguments.at_metres {
        let [north, east] = numbers(metres, "--at-metres")?;
        search.at = Some(anywhere.geodetic_from_ground(&GroundPoint::new(north, east)));
    }
    let looking = PhotoLocating {
        bounds: table
            .bounds()
            .ok_or_else(|| format!("{path}: it has no edges"))?,
        gsd: arguments.gsd.or(table.gsd()).unwrap_or(EDGE_GSD),
        table,
        search,
        world,
        anywhere,
    };
    let (mut files, mut tables) = (Vec::new(), TablesBesidePhotos::default());
    for photo in &arguments.photos {
        // What is not there at all is said before the work begins.
        files.push((photo_file(photo)?, tables.row(photo)));
    }
    let mut placed = 0;
    for (file, row) in &files {
        let name = file.name();
        match looking.place(file, row.as_ref()) {
            Ok(()) => placed += 1,
            Err(why) => println!("{name}: no place: {why}"),
        }
    }
    if files.len() > 1 {
        println!("{placed} of {} photos were placed", files.len());
    }
    Ok(())
}

/// Tells on the standard error how much of a search that takes its time is done.
fn telling(name: &str) -> impl FnMut(f64) {
    let (begun, mut shown) = (Instant::now(), 0);
    move |share| {
        let tenth = (10.0 * share) as usize;
        if tenth > shown && begun.elapsed() > QUIET {
            shown = tenth;
            eprintln!("{:3} %  {name}", 10 * tenth);
        }
    }
}

/// Table by which photos are placed, and how they are looked for.
struct PhotoLocating {
    table: ReferenceTable,
    bounds: GroundRect,
    gsd: f64,
    search: PhotoSearch,
    /// World of the table on the globe, if it is known where that lies.
    world: Option<LocalFrame>,
    /// The same, or any other that holds its metres.
    anywhere: LocalFrame,
}

impl PhotoLocating {
    /// Places a photo and prints where; why not, in words.
    fn place(&self, file: &DiskFile, row: Option<&PhotoRow>) -> Result<(), String> {
        let (search, world) = (&self.search, Some(&self.anywhere));
        let photo = PhotoLook::read(file, decode_photo, row, search, world, &self.bounds)?;
        let prior = &photo.prior;
        println!("{}: {}", file.name(), photo.assumed.join("; "));
        let asks = |what: &str, option: &str| {
            Err(format!("the photo does not tell {what}; give {option}"))
        };
        let told = photo_pose(&photo.told);
        if search.at.is_none() && self.world.is_none() {
            let why = "the table does not tell where on the globe it lies; give --at-metres";
            return Err(why.to_owned());
        }
        if search.at.is_none() && photo.told.place.is_none() {
            return asks("where it was taken", "--at");
        }
        if search
            .height
            .or(told.height.filter(|height| *height > 0.0))
            .is_none()
        {
            return asks("its height", "--height");
        }
        let HeadingPrior::Around {
            heading, deviation, ..
        } = prior.heading
        else {
            return match search.heading.or(told.heading) {
                Some(_) => Err("--heading-within has to be below 180".to_owned()),
                None => asks("its heading", "--heading"),
            };
        };
        let belief = PhotoBelief {
            pose: Pose {
                position_in_world: Point3::new(
                    prior.position.north,
                    prior.position.east,
                    -prior.height,
                ),
                attitude: Attitude {
                    roll: prior.roll,
                    pitch: prior.pitch,
                    yaw: heading,
                },
            },
            ground_down: 0.0,
            deviation: prior.position_deviation,
            tilt: TILT,
            turn: limit_of(deviation),
            log_height: prior.log_height_deviation,
            map_deviation: prior.map_deviation,
            gsd: self.gsd,
        };
        let edges = PhotoEdges::of(&photo.camera, &photo.picture, &belief);
        let edges = edges.map_err(|why| why.to_string())?;
        let found = edges.place_telling(&self.table, &mut telling(file.name()));
        let found = found.ok_or("the photo shows no straight edge")?;
        let probability = 100.0 * found.probability;
        if found.probability < BELIEVED {
            return Err(format!("the likeliest has {probability:.1} %"));
        }
        let middle = found.middle;
        let on_globe = self.world.map_or_else(String::new, |world| {
            let at = world.geodetic_from_ground(&middle);
            let (latitude, longitude) = (at.latitude.to_degrees(), at.longitude.to_degrees());
            format!("{latitude:.6}, {longitude:.6}; ")
        });
        println!(
            "  middle of the picture {on_globe}{:.1} m north, {:.1} m east, ± {:.1} m; {probability:.1} %",
            middle.north,
            middle.east,
            (0.5 * found.covariance.trace()).sqrt()
        );
        Ok(())
    }
}
