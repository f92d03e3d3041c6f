//! `pilotage map georef`: a picture put on the ground by control points.

use std::path::{Path, PathBuf};

use nalgebra::Point2;
use pilotage_core::frames::ReferenceSystem;
use pilotage_core::imagery::georeferencer::{
    ControlPoint, TransformFit, TransformKind, fit, metres_per_unit,
};
use pilotage_core::imagery::systems;
use pilotage_core::mission::{MapOptions, open_map_with};
use pilotage_jobs::ReadControlPoints;
use serde::Serialize;

use crate::CommandResult;
use crate::files::DirectoryFiles;
use crate::notes::tell;

/// Arguments of `pilotage map georef`: the picture, and the points.
#[derive(clap::Args)]
pub struct Arguments {
    /// JPEG, PNG or TIFF.
    picture: PathBuf,
    /// Control points as the QGIS georeferencer writes them.
    #[arg(long)]
    points: PathBuf,
    /// Kind of transform from the picture to the ground.
    #[arg(long, value_enum, default_value_t = TransformKindArgument::Affine)]
    kind: TransformKindArgument,
    /// World file to write; a .prj is written beside it.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Reference system of the points, before what their file says, e.g. EPSG:32617.
    #[arg(long)]
    system: Option<String>,
    /// Also write the summary as JSON.
    #[arg(long)]
    summary: Option<PathBuf>,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum TransformKindArgument {
    /// Shift, turn, one scale: two points.
    Similarity,
    /// Also other scales and a skew: three points.
    Affine,
    /// Also perspective: four points; no world file can hold it.
    Projective,
}

/// Summary of the fit.
#[derive(Serialize)]
struct FitSummary {
    picture: String,
    width: usize,
    height: usize,
    kind: &'static str,
    reference_system: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    epsg: Option<u32>,
    gsd_m: f64,
    /// Metres of the ground that a unit of the reference system is here, by which errors are told in metres.
    metres_per_unit: f64,
    /// Of the points that are on; absent if so few check nothing.
    rms_px: Option<f64>,
    rms_m: Option<f64>,
    /// Of every point left out of its own fit; absent if points are too few.
    rms_left_out_m: Option<f64>,
    /// Latitude and longitude in degrees of the corners, from the top left one clockwise.
    corners_lat_lon: Vec<[f64; 2]>,
    /// (x, y, 1) up to a factor from (column, row, 1), row by row; pixel centres at half integers.
    plane_from_pixel: [[f64; 3]; 3],
    points: Vec<PointSummary>,
}

#[derive(Serialize)]
struct PointSummary {
    column: f64,
    row: f64,
    /// Coordinates in the reference system, in its own unit.
    x: f64,
    y: f64,
    enabled: bool,
    residual_px: Option<f64>,
    residual_east_m: f64,
    residual_north_m: f64,
    left_out_m: Option<f64>,
}

/// Does what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    let file = arguments.points.display();
    let text = std::fs::read_to_string(&arguments.points).map_err(|e| format!("{file}: {e}"))?;
    let named = match &arguments.system {
        Some(name) => Some(systems::by_name(name).map_err(|cause| format!("--system: {cause}"))?),
        None => None,
    };
    let remedy = "name it by --system, e.g. EPSG:32617";
    let read = ReadControlPoints::read(&file.to_string(), &text, named, None, remedy)?;
    tell(&read.notes);
    let ReadControlPoints { points, plane, .. } = read;
    let kind = match arguments.kind {
        TransformKindArgument::Similarity => TransformKind::Similarity,
        TransformKindArgument::Affine => TransformKind::Affine,
        TransformKindArgument::Projective => TransformKind::Projective,
    };
    let fitted = fit(&points, kind).map_err(|e| format!("{file}: {e}"))?;
    if fitted.is_exact {
        let least = kind.least_points();
        eprintln!(
            "note: {file}: {least} points always fit a transform of this kind: nothing is checked; one point more shows how \
             far a place between them may be off."
        );
    }
    let summary = summarize(&arguments.picture, &points, plane, &fitted)?;
    if let Some(out) = &arguments.out {
        let world_file = fitted.world_file().ok_or(
            "a world file cannot hold a projective transform; choose --kind affine, or leave --out away and take the matrix from the summary",
        )?;
        write(out, &world_file.to_string())?;
        write(&out.with_extension("prj"), &plane.well_known_text())?;
    }
    let text = serde_json::to_string_pretty(&summary)?;
    if let Some(path) = &arguments.summary {
        write(path, &text)?;
    }
    println!("{text}");
    Ok(())
}

fn summarize(
    picture: &Path,
    points: &[ControlPoint],
    plane: ReferenceSystem,
    fitted: &TransformFit,
) -> Result<FitSummary, Box<dyn std::error::Error>> {
    let name = picture.file_name().unwrap_or_default().to_string_lossy();
    let directory = DirectoryFiles::around(picture)?;
    let options = MapOptions {
        place: Some(fitted.georeference(plane)),
        ..MapOptions::default()
    };
    let map = open_map_with(&directory, &name, &options)?;
    let (width, height) = map
        .placement()
        .map_or((0, 0), pilotage_core::imagery::Placement::size);
    let (w, h) = (width as f64, height as f64);
    let corners = [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)];
    let corners = corners.into_iter().filter_map(|(x, y)| {
        let place = fitted.place_at(&Point2::new(x, y))?;
        let place = plane.geodetic(place.x, place.y)?;
        Some([place.latitude.to_degrees(), place.longitude.to_degrees()])
    });
    let unit =
        metres_per_unit(points, plane).ok_or("a point lies where its system does not reach")?;
    let told = points.iter().zip(&fitted.residuals);
    let m = fitted.plane_from_pixel / fitted.plane_from_pixel[(2, 2)];
    Ok(FitSummary {
        picture: name.clone().into_owned(),
        width,
        height,
        kind: fitted.kind.name(),
        reference_system: plane.name(),
        epsg: plane.epsg(),
        gsd_m: pilotage_core::imagery::Imagery::native_gsd(&map),
        rms_px: (!fitted.is_exact).then_some(fitted.rms_in_pixels),
        metres_per_unit: unit,
        rms_m: (!fitted.is_exact).then_some(fitted.rms_in_plane * unit),
        rms_left_out_m: fitted.rms_left_out.map(|rms| rms * unit),
        corners_lat_lon: corners.collect(),
        plane_from_pixel: [0, 1, 2].map(|r| [0, 1, 2].map(|c| m[(r, c)])),
        points: told
            .map(|(point, residual)| PointSummary {
                column: point.pixel.x,
                row: point.pixel.y,
                x: point.place.x,
                y: point.place.y,
                enabled: point.enabled,
                residual_px: residual.in_pixels.map(|r| r.norm()),
                residual_east_m: residual.in_plane.x * unit,
                residual_north_m: residual.in_plane.y * unit,
                left_out_m: residual.left_out.map(|r| r.norm() * unit),
            })
            .collect(),
    })
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    crate::files::write_whole(path, text)
}
