//! Control points in the files of the QGIS georeferencer.

use nalgebra::Point2;

use super::{ControlPoint, Fit};
use pilotage_base::frames::ReferenceSystem;

/// Longest file that is read, lines.
const MOST_LINES: usize = 100_000;

/// Why a .points file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PointsFileError {
    /// The first line is not the one that QGIS writes.
    #[error(
        "line {line}: columns mapX, mapY, sourceX and sourceY are needed (older files call the last two pixelX and pixelY)"
    )]
    Header {
        /// Line, counted from one.
        line: usize,
    },
    /// A line of numbers is not one.
    #[error("line {line}: {cause}")]
    Line {
        /// Line, counted from one.
        line: usize,
        /// What is wrong.
        cause: String,
    },
}

/// Reads control points, and the reference system if the file names one that is known.
///
/// QGIS counts rows downward as negative numbers, from the outer corner of the first pixel.
pub fn read_points(
    text: &str,
) -> Result<(Vec<ControlPoint>, Option<ReferenceSystem>), PointsFileError> {
    let mut points = Vec::new();
    let mut system = None;
    let mut columns: Option<[usize; 4]> = None;
    let mut enabled_column = None;
    for (index, line) in text.lines().enumerate().take(MOST_LINES) {
        let number = index + 1;
        let line = line.trim().trim_start_matches('\u{feff}');
        if line.is_empty() {
            continue;
        }
        if let Some(comment) = line.strip_prefix('#') {
            let name = comment.trim().strip_prefix("CRS:");
            system = system.or(name.and_then(|name| ReferenceSystem::from_name(name.trim())));
            continue;
        }
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let Some(columns) = columns else {
            let find = |names: &[&str]| cells.iter().position(|cell| names.contains(cell));
            let found = || {
                Some([
                    find(&["mapX"])?,
                    find(&["mapY"])?,
                    find(&["sourceX", "pixelX"])?,
                    find(&["sourceY", "pixelY"])?,
                ])
            };
            columns = Some(found().ok_or(PointsFileError::Header { line: number })?);
            enabled_column = find(&["enable", "enabled"]);
            continue;
        };
        let cell = |column: usize| -> Result<f64, PointsFileError> {
            let text = cells.get(column).copied().unwrap_or("");
            let value: Option<f64> = text.parse().ok().filter(|v: &f64| v.is_finite());
            value.ok_or_else(|| PointsFileError::Line {
                line: number,
                cause: format!(
                    "\"{}\" is not a number",
                    text.chars().take(40).collect::<String>()
                ),
            })
        };
        let [x, y, column, row] = columns;
        let enabled = enabled_column.and_then(|column| cells.get(column).copied());
        points.push(ControlPoint {
            pixel: Point2::new(cell(column)?, -cell(row)?),
            place: Point2::new(cell(x)?, cell(y)?),
            enabled: enabled != Some("0"),
        });
    }
    if columns.is_none() {
        return Err(PointsFileError::Header { line: 1 });
    }
    Ok((points, system))
}

/// Control points as QGIS writes them, with the residuals of `fit` in pixels if there is one.
pub fn write_points(
    points: &[ControlPoint],
    system: Option<ReferenceSystem>,
    fit: Option<&Fit>,
) -> String {
    let system = system.map(|system| format!("#CRS: EPSG:{}\n", system.epsg()));
    let header = "mapX,mapY,sourceX,sourceY,enable,dX,dY,residual\n".to_owned();
    let lines = points.iter().enumerate().map(|(index, point)| {
        let residual = fit
            .and_then(|fit| fit.residuals.get(index)?.in_pixels)
            .unwrap_or_default();
        format!(
            "{},{},{},{},{},{},{},{}\n",
            point.place.x,
            point.place.y,
            point.pixel.x,
            -point.pixel.y,
            u8::from(point.enabled),
            residual.x,
            residual.y,
            residual.norm()
        )
    });
    system.into_iter().chain([header]).chain(lines).collect()
}
