//! The table that says where the corners of several pictures lie.

use nalgebra::{Matrix3, SMatrix, SVector};

use crate::CornersError;
use pilotage_base::frames::ReferenceSystem;
use pilotage_base::georeference::{Georeference, WorldFile};

/// Words of columns that hold the names of pictures.
const FILES: [&str; 12] = [
    "file",
    "filename",
    "name",
    "mapname",
    "picture",
    "image",
    "tile",
    "map",
    "img",
    "photo",
    "path",
    "imagename",
];
/// Words that say nothing of which corner is meant.
const FILLERS: [&str; 12] = [
    "map",
    "corner",
    "deg",
    "degrees",
    "coordinate",
    "coord",
    "of",
    "the",
    "m",
    "metres",
    "meters",
    "point",
];
/// Largest distance of four corners from a parallelogram, as a share of its diagonal, to count as one.
const PARALLEL: f64 = 1e-6;

/// A picture and its corners (x, y) from the top left one clockwise: degrees of longitude and latitude, or coordinates
/// of another reference system.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CorneredPicture {
    /// Name of the picture, as the table gives it.
    pub file: String,
    /// Line of the table, counted from one.
    pub line: usize,
    /// Reference system of the coordinates.
    pub system: ReferenceSystem,
    /// Top left, top right, bottom right, bottom left.
    pub corners: [[f64; 2]; 4],
}

/// Meaning of a column: the corners and the coordinate that it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct CornerColumn {
    /// Whether it is y: latitude, northing.
    is_y: bool,
    /// Whether it is about the top, if about one of top and bottom.
    top: Option<bool>,
    /// Whether it is about the left, if about one of left and right.
    left: Option<bool>,
}

/// Corners from the top left one clockwise: whether each is at the top, and whether it is at the left.
const CORNERS: [(bool, bool); 4] = [(true, true), (true, false), (false, false), (false, true)];

impl CornerColumn {
    /// Meaning of a column by its name.
    fn of(name: &str) -> Option<Self> {
        let mut is_y = None;
        let (mut top, mut left) = (None, None);
        for word in words(name) {
            match word.as_str() {
                "lat" | "latitude" | "y" | "northing" => is_y = Some(true),
                "lon" | "long" | "lng" | "longitude" | "x" | "easting" => is_y = Some(false),
                "minx" | "xmin" => (is_y, left) = (Some(false), Some(true)),
                "maxx" | "xmax" => (is_y, left) = (Some(false), Some(false)),
                "miny" | "ymin" => (is_y, top) = (Some(true), Some(false)),
                "maxy" | "ymax" => (is_y, top) = (Some(true), Some(true)),
                "lt" | "tl" | "ul" | "nw" | "topleft" | "upperleft" | "northwest" => {
                    (top, left) = (Some(true), Some(true));
                }
                "rt" | "tr" | "ur" | "ne" | "topright" | "upperright" | "northeast" => {
                    (top, left) = (Some(true), Some(false));
                }
                "rb" | "br" | "lr" | "se" | "bottomright" | "lowerright" | "southeast" => {
                    (top, left) = (Some(false), Some(false));
                }
                "lb" | "bl" | "ll" | "sw" | "bottomleft" | "lowerleft" | "southwest" => {
                    (top, left) = (Some(false), Some(true));
                }
                "top" | "upper" | "north" => top = Some(true),
                "bottom" | "lower" | "south" => top = Some(false),
                "left" | "west" => left = Some(true),
                "right" | "east" => left = Some(false),
                "min" => (top, left) = (Some(false), Some(true)),
                "max" => (top, left) = (Some(true), Some(false)),
                filler if FILLERS.contains(&filler) => {}
                _ => return None,
            }
        }
        // North, south, west and east alone are the sides' own coordinate.
        let is_y = is_y.or(match (top, left) {
            (Some(_), None) => Some(true),
            (None, Some(_)) => Some(false),
            _ => None,
        })?;
        // A smallest latitude is about the bottom, and says nothing of left and right.
        let is_extreme = words(name).iter().any(|w| w == "min" || w == "max");
        let (top, left) = match (is_extreme, is_y) {
            (true, true) => (top, None),
            (true, false) => (None, left),
            _ => (top, left),
        };
        (top.is_some() || left.is_some()).then_some(Self { is_y, top, left })
    }

    fn is_of(self, (top, left): (bool, bool)) -> bool {
        self.top.is_none_or(|own| own == top) && self.left.is_none_or(|own| own == left)
    }
}

/// Words of a name in small letters.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut was_small = false;
    for letter in name.chars() {
        if !letter.is_alphanumeric() || was_small && letter.is_uppercase() {
            words.push(String::new());
        }
        was_small = letter.is_lowercase();
        if let Some(word) = words.last_mut().filter(|_| letter.is_alphanumeric()) {
            word.extend(letter.to_lowercase());
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// The cells of a line.
fn cells(line: &str, separator: char) -> Vec<&str> {
    line.split(separator)
        .map(|cell| cell.trim().trim_matches('"').trim())
        .collect()
}

/// Reads a table of corners; `system` is what its coordinates are of where they are not degrees.
pub(super) fn read_corners(
    text: &str,
    system: Option<ReferenceSystem>,
) -> Result<Vec<CorneredPicture>, CornersError> {
    let mut lines = text
        .trim_start_matches('\u{feff}')
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let lacks = |cause: &str| CornersError::Columns {
        cause: cause.to_owned(),
    };
    let (_, header) = lines.next().ok_or_else(|| lacks("the file is empty"))?;
    let separators = [',', ';', '\t'];
    let separator = separators
        .into_iter()
        .max_by_key(|s| header.matches(*s).count())
        .unwrap_or(',');
    let names = cells(header, separator);
    let is_file = |name: &&str| {
        let joined = words(name).concat();
        FILES.contains(&joined.as_str())
    };
    let file = names
        .iter()
        .position(is_file)
        .ok_or_else(|| lacks("no column is called file"))?;
    let meanings: Vec<Option<CornerColumn>> =
        names.iter().map(|name| CornerColumn::of(name)).collect();
    let is_known = |corner: (bool, bool)| {
        let has = |is_y| {
            let mut of_axis = meanings.iter().flatten().filter(|m| m.is_y == is_y);
            of_axis.any(|m| m.is_of(corner))
        };
        has(true) && has(false)
    };
    let known = CORNERS.map(is_known);
    if !(known[0] && known[2] || known[1] && known[3]) {
        return Err(lacks(&format!(
            "of its columns {} no two opposite corners can be made",
            names.join(", ")
        )));
    }
    let mut pictures = Vec::new();
    for (index, line) in lines {
        let row = cells(line, separator);
        let wrong = |cause: String| CornersError::Row {
            line: index + 1,
            cause,
        };
        let value = |corner: (bool, bool), is_y: bool| -> Result<Option<f64>, CornersError> {
            let found = meanings.iter().enumerate().find(|(_, meaning)| {
                meaning.is_some_and(|meaning| meaning.is_y == is_y && meaning.is_of(corner))
            });
            let Some((column, _)) = found else {
                return Ok(None);
            };
            let cell = row.get(column).copied().unwrap_or_default();
            let number = cell.parse::<f64>().ok().filter(|n| n.is_finite());
            let unread = || {
                wrong(format!(
                    "{} is \"{cell}\", which is no number",
                    names[column]
                ))
            };
            number.map(Some).ok_or_else(unread)
        };
        let mut found = [None; 4];
        for (slot, corner) in found.iter_mut().zip(CORNERS) {
            *slot = value(corner, false)?
                .zip(value(corner, true)?)
                .map(|(x, y)| [x, y]);
        }
        let corners =
            completed(found).ok_or_else(|| wrong("two opposite corners are missing".to_owned()))?;
        let file = row.get(file).copied().unwrap_or_default();
        if file.is_empty() {
            return Err(wrong("no file is named".to_owned()));
        }
        if !is_upright(&corners) {
            return Err(wrong(format!(
                "{file}: its corners would show the ground mirrored or without an area; are left and right, top and \
                 bottom, latitude and longitude where they belong?"
            )));
        }
        let are_degrees = corners
            .iter()
            .all(|[x, y]| x.abs() <= 360.0 && y.abs() <= 90.0);
        let system = system.or(are_degrees.then_some(ReferenceSystem::Geographic));
        pictures.push(CorneredPicture {
            file: file.to_owned(),
            line: index + 1,
            system: system.ok_or(CornersError::NoSystem)?,
            corners,
        });
    }
    if pictures.is_empty() {
        return Err(lacks("it has no rows"));
    }
    Ok(pictures)
}

/// All four corners: of two opposite ones upright with the axes, of three as a parallelogram.
fn completed(mut corners: [Option<[f64; 2]>; 4]) -> Option<[[f64; 2]; 4]> {
    let count = corners.iter().flatten().count();
    for missing in 0..4 {
        let [next, opposite, last] = [1, 2, 3].map(|step| corners[(missing + step) % 4]);
        if corners[missing].is_some() {
            continue;
        }
        corners[missing] = match (count, next, opposite, last) {
            (3, Some(a), Some(o), Some(b)) => Some([a[0] + b[0] - o[0], a[1] + b[1] - o[1]]),
            _ => None,
        };
    }
    match corners {
        [Some(a), Some(b), Some(c), Some(d)] => Some([a, b, c, d]),
        [Some(a), None, Some(c), None] => Some([a, [c[0], a[1]], c, [a[0], c[1]]]),
        [None, Some(b), None, Some(d)] => Some([[d[0], b[1]], b, [b[0], d[1]], d]),
        _ => None,
    }
}

/// Whether going round the corners clockwise in the picture is clockwise on the ground.
fn is_upright(corners: &[[f64; 2]; 4]) -> bool {
    let doubled: f64 = (0..4)
        .map(|i| {
            let ([x, y], [next_x, next_y]) = (corners[i], corners[(i + 1) % 4]);
            (next_x - x) * (next_y + y)
        })
        .sum();
    // y counts up, so that clockwise is positive.
    doubled > 0.0
}

impl CorneredPicture {
    /// Georeference of its pixels, with so many of them; `None` if its corners do not span an area.
    pub(crate) fn georeference(&self, width: usize, height: usize) -> Option<Georeference> {
        let (w, h) = (width as f64, height as f64);
        let [a, b, c, d] = self.corners;
        let gap = [0, 1].map(|i| a[i] + c[i] - b[i] - d[i]);
        let diagonal = (c[0] - a[0]).hypot(c[1] - a[1]);
        if gap[0].hypot(gap[1]) <= PARALLEL * diagonal {
            let right = [0, 1].map(|i| 0.5 * (b[i] - a[i] + c[i] - d[i]) / w);
            let down = [0, 1].map(|i| 0.5 * (d[i] - a[i] + c[i] - b[i]) / h);
            let first = [0, 1].map(|i| a[i] + 0.5 * (right[i] + down[i]));
            let file = WorldFile {
                a: right[0],
                d: right[1],
                b: down[0],
                e: down[1],
                c: first[0],
                f: first[1],
            };
            return Some(Georeference::Projected {
                system: self.system,
                file,
            });
        }
        let pixels = [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]];
        Some(Georeference::Projective {
            system: self.system,
            plane_from_pixel: homography(&pixels, &self.corners)?,
        })
    }
}

/// The homography that takes four points to four others; `None` if three of them lie on a line.
///
/// Both are counted from their first corner in units of their diagonal, so that degrees and pixels weigh alike.
fn homography(from: &[[f64; 2]; 4], to: &[[f64; 2]; 4]) -> Option<Matrix3<f64>> {
    let counted = |points: &[[f64; 2]; 4]| {
        let origin = points[0];
        let size = (points[2][0] - origin[0]).hypot(points[2][1] - origin[1]);
        let units = Matrix3::new(
            1.0 / size,
            0.0,
            -origin[0] / size,
            0.0,
            1.0 / size,
            -origin[1] / size,
            0.0,
            0.0,
            1.0,
        );
        let points = points.map(|[x, y]| [(x - origin[0]) / size, (y - origin[1]) / size]);
        (units, points)
    };
    let ((from_units, from), (to_units, to)) = (counted(from), counted(to));
    let mut equations = SMatrix::<f64, 8, 8>::zeros();
    let mut values = SVector::<f64, 8>::zeros();
    for (i, ([x, y], [u, v])) in from.into_iter().zip(to).enumerate() {
        for (row, value, shift) in [(2 * i, u, 0), (2 * i + 1, v, 3)] {
            for (column, term) in [x, y, 1.0].into_iter().enumerate() {
                equations[(row, shift + column)] = term;
            }
            equations[(row, 6)] = -x * value;
            equations[(row, 7)] = -y * value;
            values[row] = value;
        }
    }
    let h = equations.lu().solve(&values)?;
    let matrix = Matrix3::new(h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1.0);
    Some(to_units.try_inverse()? * matrix * from_units)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(text: &str) -> [[f64; 2]; 4] {
        read_corners(text, None).unwrap()[0].corners
    }

    #[test]
    fn two_opposite_corners_and_four_sides_say_the_same() {
        let expected = [[10.0, 50.2], [10.3, 50.2], [10.3, 50.0], [10.0, 50.0]];
        for text in [
            "mapname,LT_lat_map,LT_lon_map,RB_lat_map,RB_lon_map,region\na.png,50.2,10,50,10.3,x\n",
            "Filename,Top_left_lat,Top_left_lon,Bottom_right_lat,Bottom_right_long\na.png,50.2,10,50,10.3\n",
            "file;north;west;south;east\na.png;50.2;10;50;10.3\n",
            "tile\tminLon\tminLat\tmaxLon\tmaxLat\na.png\t10\t50\t10.3\t50.2\n",
            "image,upper right latitude,upper right longitude,lower left latitude,lower left longitude\n\
             a.png,50.2,10.3,50,10\n",
            "file,xmin,ymin,xmax,ymax\na.png,10,50,10.3,50.2\n",
        ] {
            assert_eq!(corners(text), expected, "{text}");
        }
    }

    #[test]
    fn three_corners_are_a_parallelogram_and_four_a_perspective() {
        let three = "file,tl_x,tl_y,tr_x,tr_y,br_x,br_y\na.png,0,10,8,12,9,2\n";
        let picture = &read_corners(three, None).unwrap()[0];
        assert_eq!(picture.corners[3], [1.0, 0.0]);
        let Some(Georeference::Projected { file, .. }) = picture.georeference(80, 100) else {
            panic!("{picture:?}");
        };
        let at = |x: f64, y: f64| {
            let (x, y) = (x - 0.5, y - 0.5);
            (
                file.a * x + file.b * y + file.c,
                file.d * x + file.e * y + file.f,
            )
        };
        for ((x, y), corner) in [(0.0, 0.0), (80.0, 0.0), (80.0, 100.0)]
            .into_iter()
            .zip(picture.corners)
        {
            assert!(
                (at(x, y).0 - corner[0]).abs() < 1e-12 && (at(x, y).1 - corner[1]).abs() < 1e-12
            );
        }
        let four = "file,tl_lon,tl_lat,tr_lon,tr_lat,br_lon,br_lat,bl_lon,bl_lat\n\
                    a.png,120.70,24.27,120.71,24.271,120.712,24.26,120.699,24.259\n";
        let picture = &read_corners(four, None).unwrap()[0];
        let Some(Georeference::Projective {
            plane_from_pixel: m,
            ..
        }) = picture.georeference(400, 300)
        else {
            panic!("{picture:?}");
        };
        let pixels = [(0.0, 0.0), (400.0, 0.0), (400.0, 300.0), (0.0, 300.0)];
        for ((x, y), corner) in pixels.into_iter().zip(picture.corners) {
            let h = m * nalgebra::Vector3::new(x, y, 1.0);
            assert!(h.z > 0.0);
            // A hundred-millionth of a degree is a millimetre.
            assert!((h.x / h.z - corner[0]).abs() < 1e-8 && (h.y / h.z - corner[1]).abs() < 1e-8);
        }
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let header = "file,north,west,south,east\n";
        let told = |text: &str| read_corners(text, None).unwrap_err().to_string();
        assert!(told("time,lat,lon\n0,1,2\n").contains("no column is called file"));
        assert!(told("file,lat,lon\na.png,1,2\n").contains("no two opposite corners"));
        assert!(told(&format!("{header}a.png,50,x,49,10\n")).starts_with("line 2: west is \"x\""));
        assert!(told(&format!("{header}a.png,49,10,50,11\n")).contains("mirrored"));
        assert!(
            told(&format!("{header}a.png,5000000,400000,4999000,401000\n")).contains("--system")
        );
        assert!(told(header).contains("no rows"));
        let utm = format!("{header}a.png,5000000,400000,4999000,401000\n");
        let system = ReferenceSystem::from_epsg(32_617);
        assert_eq!(
            read_corners(&utm, system).unwrap()[0].system.epsg(),
            Some(32_617)
        );
    }
}
