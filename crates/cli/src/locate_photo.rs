//! `pilotage reference-map locate`: photos placed by the straight edges of a table.

use std::path::{Path, PathBuf};

use nalgebra::Point3;
use pilotage_core::flight::photo::{PhotoLook, PhotoSearch, photo_pose};
use pilotage_core::frames::{Attitude, GroundPoint, LocalFrame, Pose};
use pilotage_core::reference::ReferenceTable;
use pilotage_core::reference::edges::{
    EDGE, EDGE_GSD, EDGES, PhotoBelief, PhotoEdges, edges_in_map,
};
use pilotage_core::registration::{HeadingPrior, limit_of};

use crate::CommandResult;
use crate::files::{DiskFile, MAP_CACHE, open_map_with_frame, write_whole};
use crate::numbers::{lat_lon, numbers};
use crate::photo_picture::decode_photo;

/// Probability from which on a place is believed.
const BELIEVED: f64 = 0.9;
/// Standard deviation of roll and pitch, radians.
const TILT: f64 = 0.035;

/// Arguments of `pilotage reference-map locate`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Table made by `pilotage reference-map --edges`.
    table: PathBuf,
    /// Photos (JPEG, TIFF or PNG) of a camera that looks down.
    #[arg(required = true, value_name = "PHOTO")]
    photos: Vec<PathBuf>,
    /// Believed place below the camera, degrees; what the photo says if absent.
    #[arg(long, value_name = "LAT,LON", allow_hyphen_values = true)]
    at: Option<String>,
    /// The same in metres from the origin of the map's world, where nothing tells where on the globe that is.
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
    /// Height above the ground, metres; what the photo says if absent.
    #[arg(long, value_name = "METRES")]
    height: Option<f64>,
    /// Range of the search around the height, percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 13.0)]
    height_within: f64,
    /// Heading of the picture's top, degrees from north; what the photo says if absent.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    heading: Option<f64>,
    /// Range of the search to each side of the heading, degrees.
    #[arg(long, value_name = "DEGREES", default_value_t = 15.0)]
    heading_within: f64,
    /// Angle by which the camera looks ahead of straight down, degrees; what the photo says if absent.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    ahead: Option<f64>,
    /// Focal length in pixels of the picture; what the photo says if absent.
    #[arg(long, value_name = "PIXELS")]
    focal: Option<f64>,
    /// Metres in a pixel in which edges are sought; those of the table if absent.
    #[arg(long, value_name = "METRES")]
    gsd: Option<f64>,
    /// Stated accuracy of the map, standard deviation per axis in metres.
    #[arg(long, value_name = "METRES", default_value_t = 3.0)]
    map_accuracy: f64,
}

/// Makes the table of the straight edges of a map, sought in pixels of `gsd` metres.
pub fn make_table(map: &Path, out: &Path, gsd: f64) -> CommandResult {
    let (map, frame) = open_map_with_frame(map, MAP_CACHE)?;
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
    let search = arguments.search()?;
    let metres = arguments.at_metres.as_deref();
    let metres: Option<[f64; 2]> = metres
        .map(|text| numbers(text, "--at-metres"))
        .transpose()?;
    let mut placed = 0;
    for photo in &arguments.photos {
        let name = photo.display();
        match arguments.place(photo, &search, metres, &table) {
            Ok(()) => placed += 1,
            Err(why) => println!("{name}: no place: {why}"),
        }
    }
    if arguments.photos.len() > 1 {
        println!("{placed} of {} photos were placed", arguments.photos.len());
    }
    Ok(())
}

impl Arguments {
    fn search(&self) -> Result<PhotoSearch, String> {
        Ok(PhotoSearch {
            at: self
                .at
                .as_deref()
                .map(|at| lat_lon(at, "--at"))
                .transpose()?,
            within: self.within,
            height: self.height,
            height_within: 0.01 * self.height_within,
            heading: self.heading.map(f64::to_radians),
            heading_within: self.heading_within.to_radians(),
            ahead: self.ahead.map(f64::to_radians),
            focal: self.focal,
            map_deviation: self.map_accuracy,
        })
    }

    /// Places a photo and prints where; why not, in words.
    fn place(
        &self,
        path: &Path,
        search: &PhotoSearch,
        metres: Option<[f64; 2]>,
        table: &ReferenceTable,
    ) -> Result<(), String> {
        let file = DiskFile::open(path, &path.to_string_lossy()).map_err(|e| e.to_string())?;
        let bounds = table.bounds().ok_or("the table has no edges")?;
        let world = table.origin().map(LocalFrame::new);
        let photo = PhotoLook::read(&file, decode_photo, search, world.as_ref(), &bounds)?;
        let prior = &photo.prior;
        println!("{}: {}", path.display(), photo.assumed.join("; "));
        let below = match metres {
            Some([north, east]) => GroundPoint::new(north, east),
            None if world.is_none() => {
                return Err(
                    "the table does not tell where on the globe it lies; give --at-metres".into(),
                );
            }
            None if search.at.is_some() || photo.told.place.is_some() => prior.position,
            None => return Err("the photo does not tell where it was taken; give --at".into()),
        };
        let told_height = photo_pose(&photo.told)
            .height
            .filter(|height| *height > 0.0);
        if search.height.or(told_height).is_none() {
            return Err("the photo does not tell its height; give --height".into());
        }
        let HeadingPrior::Around {
            heading, deviation, ..
        } = prior.heading
        else {
            return Err("the photo does not tell its heading; give --heading".into());
        };
        let belief = PhotoBelief {
            pose: Pose {
                position_in_world: Point3::new(below.north, below.east, -prior.height),
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
            map_deviation: self.map_accuracy,
            gsd: self.gsd.or(table.gsd()).unwrap_or(EDGE_GSD),
        };
        let edges = PhotoEdges::of(&photo.camera, &photo.picture, &belief);
        let found = edges.and_then(|edges| edges.place(table));
        let found = found.ok_or("the photo shows no straight edge")?;
        let probability = 100.0 * found.probability;
        if found.probability < BELIEVED {
            return Err(format!("the likeliest has {probability:.1} %"));
        }
        let middle = found.middle;
        let on_globe = world.map_or_else(String::new, |world| {
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
