//! Control points in the files of the QGIS georeferencer.

use nalgebra::Point2;

use super::{ControlPoint, TransformFit};
use pilotage_base::frames::ReferenceSystem;
use pilotage_base::text::without_decimal_comma;

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
    /// The reference system that the file names is not known.
    #[error(
        "line {line}: the reference system \"{name}\" is not known; use points in EPSG:4326, EPSG:3857 or a UTM zone of WGS 84, or name the system"
    )]
    System {
        /// Line, counted from one.
        line: usize,
        /// Reference system that the file names.
        name: String,
    },
    /// Two lines name different reference systems.
    #[error("line {line}: its reference system {name} is not that of the lines before, {before}")]
    Systems {
        /// Line, counted from one.
        line: usize,
        /// System of that line.
        name: String,
        /// System of the lines before.
        before: String,
    },
    /// A line of numbers is not one.
    #[error("line {line}: {cause}")]
    Line {
        /// Line, counted from one.
        line: usize,
        /// Error of the line, in words.
        cause: String,
    },
}

/// Reads control points, and the reference system if the file names one: in a line `#CRS:`, or in a
/// column `CRS` of every line, as QGIS 3.16 to 3.20 wrote it. One that is not known is an error.
///
/// Tables of other programs have semicolons or tabulators between their cells, and may have commas before decimals there.
///
/// QGIS counts rows downward as negative numbers, from the outer corner of the first pixel.
///
/// ```
/// use pilotage_maps::georeferencer::read_points;
///
/// // As QGIS writes it: rows count downward as negative numbers.
/// let text = "#CRS: EPSG:3857\nmapX,mapY,sourceX,sourceY,enable,dX,dY,residual\n\
///             1000,2000,20,-30,1,0,0,0\n";
/// let (points, system) = read_points(text)?;
/// assert_eq!((points[0].pixel.x, points[0].pixel.y), (20.0, 30.0));
/// assert_eq!(system.and_then(|system| system.epsg()), Some(3857));
/// # Ok::<(), pilotage_maps::georeferencer::PointsFileError>(())
/// ```
pub fn read_points(
    text: &str,
) -> Result<(Vec<ControlPoint>, Option<ReferenceSystem>), PointsFileError> {
    read_points_in(text, None, ReferenceSystem::from_name)
}

/// As [`read_points`]; whoever knows the system better than the file gives it as `named`, and what the
/// file says of it is ignored. `system_of` finds systems by name: those of WGS 84 alone
/// ([`ReferenceSystem::from_name`]), or all of [`systems`](crate::systems).
pub fn read_points_in(
    text: &str,
    named: Option<ReferenceSystem>,
    system_of: fn(&str) -> Option<ReferenceSystem>,
) -> Result<(Vec<ControlPoint>, Option<ReferenceSystem>), PointsFileError> {
    let known = |name: &str, line: usize| {
        system_of(name).ok_or_else(|| PointsFileError::System {
            line,
            name: name.chars().take(60).collect(),
        })
    };
    let mut points = Vec::new();
    let mut system = named;
    let mut columns: Option<[usize; 4]> = None;
    let (mut enabled_column, mut system_column) = (None, None);
    // All lines mostly name the same.
    let mut last_name = String::new();
    let mut seam = ',';
    for (index, line) in text.lines().enumerate().take(MOST_LINES) {
        let number = index + 1;
        let line = line.trim().trim_start_matches('\u{feff}');
        if line.is_empty() {
            continue;
        }
        // NumPy puts names behind a `#`.
        let names = line.strip_prefix('#').map(str::trim);
        let line = names
            .filter(|names| names.starts_with("mapX"))
            .unwrap_or(line);
        if let Some(comment) = line.strip_prefix('#') {
            let name = comment.trim().strip_prefix("CRS:").map_or("", str::trim);
            if system.is_none() && !name.is_empty() {
                system = Some(known(name, number)?);
            }
            continue;
        }
        if columns.is_none() {
            let seams = [',', ';', '\t'].into_iter();
            seam = seams
                .max_by_key(|seam| line.matches(*seam).count())
                .unwrap_or(',');
        }
        let cells = cells(line, seam);
        let Some(columns) = columns else {
            let find =
                |names: &[&str]| cells.iter().position(|cell| names.contains(&cell.as_str()));
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
            system_column = find(&["CRS", "crs"]);
            continue;
        };
        let name = system_column.and_then(|column: usize| cells.get(column));
        if let Some(name) = name.filter(|name| named.is_none() && !name.is_empty())
            && *name != last_name
        {
            let own = known(name, number)?;
            if let Some(before) = system.filter(|before| *before != own) {
                return Err(PointsFileError::Systems {
                    line: number,
                    name: own.name(),
                    before: before.name(),
                });
            }
            system = Some(own);
            last_name.clone_from(name);
        }
        let cell = |column: usize| -> Result<f64, PointsFileError> {
            let text = cells.get(column).map_or("", String::as_str);
            let plain = without_decimal_comma(text).filter(|_| seam != ',');
            let value = plain.as_deref().unwrap_or(text).parse().ok();
            let value = value.filter(|value: &f64| value.is_finite());
            value.ok_or_else(|| PointsFileError::Line {
                line: number,
                cause: format!(
                    "\"{}\" is not a number",
                    text.chars().take(40).collect::<String>()
                ),
            })
        };
        let [x, y, column, row] = columns;
        let enabled = enabled_column.and_then(|column: usize| cells.get(column));
        points.push(ControlPoint {
            pixel: Point2::new(cell(column)?, -cell(row)?),
            place: Point2::new(cell(x)?, cell(y)?),
            enabled: enabled.is_none_or(|enabled| enabled != "0"),
        });
    }
    if columns.is_none() {
        return Err(PointsFileError::Header { line: 1 });
    }
    Ok((points, system))
}

/// Cells of a line, between seams that are not inside of quotes; two quotes in such a cell are one.
fn cells(line: &str, seam: char) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        let cell = cells.last_mut();
        match (character, cell) {
            ('"', Some(cell)) if is_quoted && characters.peek() == Some(&'"') => {
                characters.next();
                cell.push('"');
            }
            ('"', _) => is_quoted = !is_quoted,
            (letter, _) if letter == seam && !is_quoted => cells.push(String::new()),
            (other, Some(cell)) => cell.push(other),
            (_, None) => {}
        }
    }
    cells.iter().map(|cell| cell.trim().to_owned()).collect()
}

/// Control points as QGIS writes them, with the residuals of `fit` in pixels if there is one.
pub fn write_points(
    points: &[ControlPoint],
    system: Option<ReferenceSystem>,
    fit: Option<&TransformFit>,
) -> String {
    let system = system.map(|system| match system.epsg() {
        Some(code) => format!("#CRS: EPSG:{code}\n"),
        None => format!("#CRS: {}\n", system.well_known_text()),
    });
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
