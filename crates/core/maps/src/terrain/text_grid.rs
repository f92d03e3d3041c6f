//! Grids of heights as text: Esri's ASCII grid (`.asc`), and places of a grid with their heights (`.xyz`).

use super::highest::may_be_height;
use pilotage_base::frames::ReferenceSystem;
use pilotage_base::georeference::{Georeference, WorldFile};

/// Most posts along a side, and in all.
const MOST_ALONG: usize = 100_000;
const MOST: usize = 200_000_000;
/// Height of a post that is missing, where an ASCII grid does not say it.
const NODATA: f64 = -9999.0;
/// Places of a grid are this near to its posts, in steps.
const NEAR: f64 = 0.05;

/// The heights of one file.
pub(super) struct TextGrid {
    name: String,
    system: ReferenceSystem,
    file: WorldFile,
    columns: usize,
    /// Row by row from the north; not a number where unknown.
    heights: Vec<f32>,
}

/// Posts before their system is known.
struct TextPosts {
    /// Middle of the first post and the steps between posts, of which that of y is positive.
    first: [f64; 2],
    steps: [f64; 2],
    columns: usize,
    heights: Vec<f32>,
}

/// Whether the first bytes of a file are those of an ASCII grid.
pub(super) fn is_ascii_grid(head: &[u8]) -> bool {
    let head = head.trim_ascii_start();
    head.len() > 5 && head[..5].eq_ignore_ascii_case(b"ncols")
}

impl TextGrid {
    /// Reads a text in `system`, or in degrees where its places may be such; the error says in words what is wrong.
    pub fn read(name: &str, bytes: &[u8], system: Option<ReferenceSystem>) -> Result<Self, String> {
        let text = String::from_utf8_lossy(bytes);
        let posts = if is_ascii_grid(bytes) {
            ascii(&text)?
        } else {
            places(&text)?
        };
        let [x, y] = posts.first;
        let [dx, dy] = posts.steps;
        let may_be_degrees = x.abs() <= 360.0 && y.abs() <= 90.0 && dx < 1.0 && dy < 1.0;
        let system = system.or(may_be_degrees.then_some(ReferenceSystem::Geographic));
        let system = system.ok_or_else(|| {
            format!(
                "it begins at x = {x}, y = {y} and does not say in which reference system: put its code or its well-known text \
                 into a .prj beside it, or name it by --system on the terminal"
            )
        })?;
        Ok(Self {
            name: name.to_owned(),
            system,
            file: WorldFile {
                a: dx,
                d: 0.0,
                b: 0.0,
                e: -dy,
                c: x,
                f: y,
            },
            columns: posts.columns,
            heights: posts.heights,
        })
    }

    /// Name of the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Posts from west to east and from north to south.
    pub fn size(&self) -> (usize, usize) {
        (self.columns, self.heights.len() / self.columns)
    }

    /// Georeference of the posts.
    pub fn georeference(&self) -> Georeference {
        Georeference::Projected {
            system: self.system,
            file: self.file,
        }
    }

    /// Height at a post, metres; panics outside.
    pub fn post(&self, column: usize, row: usize) -> Option<f64> {
        let height = f64::from(self.heights[row * self.columns + column]);
        Some(height).filter(|height| may_be_height(*height))
    }
}

fn number(text: &str) -> Option<f64> {
    let number = text
        .parse()
        .ok()
        .or_else(|| text.replacen(',', ".", 1).parse().ok());
    number.filter(|number: &f64| number.is_finite())
}

/// Whether a word stands for a height that is missing: `nan`, `-nan`, `NaN`, `inf`, or `-1.#IND` as older programs on Windows
/// print it.
fn is_no_number(word: &str) -> bool {
    let is_old = ["1.#IND", "1.#QNAN", "1.#INF"]
        .into_iter()
        .any(|begin| word.trim_start_matches('-').starts_with(begin));
    is_old || word.parse().is_ok_and(|number: f64| !number.is_finite())
}

/// `ncols`, `nrows`, the south-west corner or the middle of its post, `cellsize`, and the heights from the north on.
fn ascii(text: &str) -> Result<TextPosts, String> {
    let mut words = text.split_ascii_whitespace().peekable();
    let mut head: Vec<(String, f64)> = Vec::new();
    let is_name = |w: &&str| w.starts_with(|c: char| c.is_ascii_alphabetic()) && !is_no_number(w);
    while let Some(word) = words.next_if(is_name) {
        let value = words.next().unwrap_or("");
        // What is missing may be marked by what is no number, which equals no height.
        let no_number =
            (word.to_lowercase().starts_with("nodata") && is_no_number(value)).then_some(f64::NAN);
        let value = number(value).or(no_number);
        let value = value.ok_or_else(|| format!("there is no number behind {word}"))?;
        head.push((word.to_lowercase(), value));
    }
    let find = |names: &[&str]| {
        let found = head.iter().find(|(name, _)| names.contains(&name.as_str()));
        found.map(|(_, value)| *value)
    };
    let wanted =
        |names: &[&str]| find(names).ok_or_else(|| format!("its head has no {}", names[0]));
    let count = |name: &str| {
        let value = wanted(&[name])?;
        let is_count = value.fract() == 0.0 && (1.0..=MOST_ALONG as f64).contains(&value);
        is_count
            .then_some(value as usize)
            .ok_or_else(|| format!("{name} is {value}"))
    };
    let (columns, rows) = (count("ncols")?, count("nrows")?);
    if columns.saturating_mul(rows) > MOST {
        return Err(format!("{columns} × {rows} posts are too many"));
    }
    let steps = [
        wanted(&["cellsize", "dx", "xdim"])?,
        wanted(&["cellsize", "dy", "ydim"])?,
    ];
    if steps.iter().any(|step| *step <= 0.0) {
        return Err("its cellsize is not positive".to_owned());
    }
    let west = match find(&["xllcenter", "xllcentre"]) {
        Some(middle) => middle,
        None => wanted(&["xllcorner"])? + 0.5 * steps[0],
    };
    let south = match find(&["yllcenter", "yllcentre"]) {
        Some(middle) => middle,
        None => wanted(&["yllcorner"])? + 0.5 * steps[1],
    };
    let missing = find(&["nodata_value", "nodata"]).unwrap_or(NODATA);
    // Each height is a letter and a blank at least.
    let mut heights = Vec::with_capacity((columns * rows).min(text.len() / 2 + 1));
    for word in words {
        let height = match number(word) {
            Some(height) if height != missing => height as f32,
            Some(_) => f32::NAN,
            None if is_no_number(word) => f32::NAN,
            None => return Err(format!("`{word}` is no height")),
        };
        heights.push(height);
    }
    if heights.len() != columns * rows {
        return Err(format!(
            "it has {} heights where its head says {columns} × {rows}",
            heights.len()
        ));
    }
    Ok(TextPosts {
        first: [west, south + (rows - 1) as f64 * steps[1]],
        steps,
        columns,
        heights,
    })
}

/// `x y z` in each line, in any order, below a line of names or none.
fn places(text: &str) -> Result<TextPosts, String> {
    let mut points: Vec<[f64; 3]> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let mut cells = line
            .split(|c: char| c.is_ascii_whitespace() || c == ';' || c == ',')
            .filter(|cell| !cell.is_empty());
        let mut next = || cells.next().and_then(|cell| cell.parse::<f64>().ok());
        match (next(), next(), next()) {
            (Some(x), Some(y), Some(z)) if x.is_finite() && y.is_finite() => points.push([x, y, z]),
            _ if line.trim().is_empty() || index == 0 || line.starts_with('#') => {}
            _ => return Err(format!("line {} is no x, y and height", index + 1)),
        }
    }
    let axis = |of: usize| {
        let mut values: Vec<f64> = points.iter().map(|point| point[of]).collect();
        values.sort_by(f64::total_cmp);
        let (low, high) = (*values.first()?, *values.last()?);
        let least = 1e-9 * (high - low).max(1e-9);
        let steps = values
            .windows(2)
            .map(|w| w[1] - w[0])
            .filter(|step| *step > least);
        let step = steps.reduce(f64::min)?;
        let count = ((high - low) / step).round();
        (count < MOST_ALONG as f64).then_some((low, high, (high - low) / count, count as usize + 1))
    };
    let no_grid = || "its places are no grid: make one of them (`gdal_grid`)".to_owned();
    let (west, _, dx, columns) = axis(0).ok_or_else(no_grid)?;
    let (_, north, dy, rows) = axis(1).ok_or_else(no_grid)?;
    // Places that lie anywhere would make a grid of nearly nothing.
    if columns.saturating_mul(rows) > MOST.min(16 * points.len().max(1000)) {
        return Err(no_grid());
    }
    let mut heights = vec![f32::NAN; columns * rows];
    for [x, y, z] in points {
        let (column, row) = ((x - west) / dx, (north - y) / dy);
        if (column - column.round()).abs() > NEAR || (row - row.round()).abs() > NEAR {
            return Err(no_grid());
        }
        if z != NODATA {
            heights[row.round() as usize * columns + column.round() as usize] = z as f32;
        }
    }
    Ok(TextPosts {
        first: [west, north],
        steps: [dx, dy],
        columns,
        heights,
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::{Dem, Terrain};
    use super::*;
    use pilotage_base::bytes::MemoryBytes;
    use pilotage_base::frames::{Geodetic, GroundPoint, LocalFrame};

    fn height(
        name: &str,
        text: &str,
        system: Option<ReferenceSystem>,
        at: [f64; 2],
    ) -> Option<f64> {
        let place = Geodetic::from_degrees(at[0], at[1], 0.0);
        let frame = Some(LocalFrame::new(place));
        let source = Arc::new(MemoryBytes::new(name, text.as_bytes()));
        let dem = Dem::open(source, frame, system).unwrap();
        dem.height_at(&GroundPoint::default())
    }

    const DEGREES: &str = "ncols 3\nnrows 2\nxllcorner 8.0\nyllcorner 47.0\ncellsize 0.01\nNODATA_value -9999\n\
        400 410 420\n430 440 -9999\n";

    #[test]
    fn posts_of_an_ascii_grid_stand_in_the_middle_of_cells_from_the_north_on() {
        for text in [
            DEGREES.to_owned(),
            DEGREES.to_uppercase().replace('\n', "\r\n"),
            DEGREES
                .replace("corner 8.0", "center 8.005")
                .replace("corner 47.0", "center 47.005"),
        ] {
            assert_eq!(
                height("a.asc", &text, None, [47.015, 8.005]),
                Some(400.0),
                "{text}"
            );
            assert_eq!(height("a.asc", &text, None, [47.005, 8.015]), Some(440.0));
            let between = height("a.asc", &text, None, [47.015, 8.010]).unwrap();
            assert!((between - 405.0).abs() < 1e-3);
            assert_eq!(height("a.asc", &text, None, [47.005, 8.025]), None);
        }
    }

    #[test]
    fn heights_that_are_no_numbers_are_missing_wherever_they_stand() {
        // Its first post is 30 m from the corner: 440750, 3750210 in zone 11 north.
        let head = "ncols 2\nnrows 2\nxllcorner 440720\nyllcorner 3750120\ncellsize 60\n";
        let system = ReferenceSystem::from_epsg(32_611);
        let of = |mark: &str, cells: &str| {
            let text = format!("{head}NODATA_value {mark}\n{cells}\n");
            TextGrid::read("a.asc", text.as_bytes(), system).map(|grid| {
                let at = |i: usize| grid.post(i % 2, i / 2);
                [at(0), at(1), at(2), at(3)]
            })
        };
        for mark in ["nan", "NaN", "-9999"] {
            let last = [Some(0.0), Some(0.0), Some(0.0), None];
            assert_eq!(of(mark, "0.0 0\n0 nan"), Ok(last), "{mark}");
            let first = [None, Some(1.0), Some(2.0), Some(3.0)];
            assert_eq!(of(mark, "nan 1\n2 3"), Ok(first), "{mark}");
            assert_eq!(of(mark, "-nan 1\n2 3"), Ok(first), "{mark}");
            assert_eq!(of(mark, "-1.#IND00 1\n2 3"), Ok(first), "{mark}");
        }
        assert!(of("none", "0 0\n0 0").is_err());
    }

    #[test]
    fn heights_beyond_twelve_kilometres_are_missing() {
        for mark in ["-32768", "-99999", "3.4e38", "1e40"] {
            let text = DEGREES.replace("400", mark);
            let height = height("a.asc", &text, None, [47.015, 8.005]);
            assert_eq!(height, None, "{mark}");
            let text = format!("8.0 47.0 {mark}\n8.1 47.0 2\n8.0 47.1 3\n8.1 47.1 4\n");
            let grid = TextGrid::read("a.xyz", text.as_bytes(), None).unwrap();
            assert_eq!((grid.post(0, 1), grid.post(1, 1)), (None, Some(2.0)));
        }
    }

    #[test]
    fn places_with_heights_are_a_grid_in_any_order() {
        // By pyproj: 47.3712, 8.5421 is 465429.756, 5246517.201 in zone 32 north.
        let mut lines: Vec<String> = Vec::new();
        for row in 0..5 {
            for column in 0..4 {
                let (x, y) = (
                    465_429.756 + 2.0 * f64::from(column),
                    5_246_517.201 - 2.0 * f64::from(row),
                );
                lines.push(format!("{x:.3} {y:.3} {}", 400 + 10 * column + row));
            }
        }
        let system = ReferenceSystem::from_epsg(32_632);
        lines.reverse();
        for head in ["", "X Y Z\n"] {
            let text = format!("{head}{}\n", lines.join("\n"));
            let found = height("a.xyz", &text, system, [47.3712, 8.5421]).unwrap();
            assert!((found - 400.0).abs() < 0.1, "{found}");
        }
    }

    #[test]
    fn what_is_no_grid_or_in_no_system_is_refused_in_words() {
        let refused = |text: &str| TextGrid::read("a", text.as_bytes(), None).err().unwrap();
        assert!(refused(&DEGREES.replace("8.0", "600000")).contains(".prj"));
        assert!(refused(&DEGREES.replace("430", "")).contains("5 heights"));
        assert!(refused(&DEGREES.replace("430", "x")).contains("`x`"));
        assert!(refused(&DEGREES.replace("ncols 3", "ncols 1e9")).contains("ncols"));
        assert!(refused("1 2 3\n1.37 5.1 3\n9 9.7 3\n").contains("no grid"));
        assert!(refused("a b c\nd e f\n").contains("line 2"));
        assert!(refused("").contains("no grid"));
    }
}
