//! Real pictures of the ground whose roads people traced.

use std::path::{Path, PathBuf};

use pilotage_raster::imagery::decode_map;
use pilotage_raster::raster::{Raster, Rgba};
use serde_json::Value;

/// Half a metre per pixel.
pub const GSD: f64 = 0.5;

/// A traced line, places in pixels of the grid.
pub struct Line {
    pub points: Vec<[f64; 2]>,
    /// Width, pixels of the grid; `None` where nobody said it.
    pub width: Option<f64>,
}

/// A picture with what was traced on it.
pub struct Site {
    pub name: &'static str,
    /// The picture in its own pixels, cut to what was traced.
    pub native: Raster<Rgba>,
    /// The same on the grid of half a metre.
    pub grid: Raster<Rgba>,
    pub lines: Vec<Line>,
    /// Polygons to be left out, and aisles of car parks.
    pub unsure: Raster<bool>,
}

fn beside(name: &str) -> Option<PathBuf> {
    let place = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../..")
        .join(name);
    if place.exists() {
        return Some(place);
    }
    println!("skipped: no {name}");
    None
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list of numbers");
    list.iter().map(|v| v.as_f64().expect("a number")).collect()
}

fn places(value: &Value, pixel: &dyn Fn(f64, f64) -> [f64; 2]) -> Vec<[f64; 2]> {
    let list = value.as_array().expect("a list of places");
    let pairs = list.iter().map(numbers);
    pairs.map(|p| pixel(p[0], p[1])).collect()
}

/// A picture traced by eye; `part` is what of it was traced, its own pixels: column, row, width, height.
fn traced(name: &'static str, picture: &str, part: Option<[usize; 4]>) -> Option<Site> {
    let trace = beside(&format!("tests/data/traces/{name}.geojson"))?;
    let file = beside(&format!("../shared/data/{picture}"))?;
    let json: Value = serde_json::from_slice(&std::fs::read(trace).expect("as the data note says"))
        .expect("as the data note says");
    let picture = decode_map(&std::fs::read(file).expect("as the data note says"), true)
        .expect("as the data note says");
    let (corner, step) = (
        numbers(&json["picture"]["corner"]),
        numbers(&json["picture"]["pixel_deg"]),
    );
    let size = numbers(&json["picture"]["size"]);
    let size = [size[0] as usize, size[1] as usize];
    let pixel = |lon: f64, lat: f64| [(lon - corner[0]) / step[0], (corner[1] - lat) / step[1]];
    let mut lines = Vec::new();
    let mut unsure = Raster::filled(size[0], size[1], false);
    for feature in json["features"].as_array().expect("as the data note says") {
        let (kind, shape) = (&feature["properties"], &feature["geometry"]["coordinates"]);
        match (kind["kind"].as_str(), kind["class"].as_str()) {
            (Some("road"), Some("parking_aisle")) => {
                let line = places(shape, &pixel);
                mark(&mut unsure, |p| distance(p, &line) < 8.0);
            }
            (Some("road"), _) => lines.push(Line {
                points: places(shape, &pixel),
                width: kind["width_m"].as_f64().map(|w| w / GSD),
            }),
            (Some("unsure"), _) => {
                let outline = places(&shape[0], &pixel);
                mark(&mut unsure, |p| is_inside(p, &outline));
            }
            _ => {}
        }
    }
    let [x, y, width, height] = part.unwrap_or([0, 0, picture.width(), picture.height()]);
    let native = picture
        .crop(x, y, width, height)
        .expect("as the data note says");
    Some(Site::new(name, &native, size, lines, unsure))
}

/// A satellite picture of Las Vegas: centre lines without widths, many of them in car parks.
fn vegas() -> Option<Site> {
    let folder = beside("../shared/data/roads_spacenet")?;
    let picture = decode_map(
        &std::fs::read(folder.join("vegas_img0.jpg")).expect("as the data note says"),
        false,
    )
    .expect("as the data note says");
    let roads: Value = serde_json::from_slice(
        &std::fs::read(folder.join("vegas_img0_roads.geojson")).expect("as the data note says"),
    )
    .expect("as the data note says");
    let metres_per_degree = 111_132.0;
    let lat0 = 36.240_617_7_f64;
    let scale = [
        metres_per_degree * lat0.to_radians().cos() / GSD,
        metres_per_degree / GSD,
    ];
    let pixel = |lon: f64, lat: f64| [(lon + 115.170_627_6) * scale[0], (lat0 - lat) * scale[1]];
    let side = 1300.0 * 2.7e-6;
    let size = [(side * scale[0]) as usize, (side * scale[1]) as usize];
    let mut lines = Vec::new();
    for feature in roads["features"].as_array().expect("as the data note says") {
        let shape = &feature["geometry"]["coordinates"];
        let is_many = feature["geometry"]["type"] == "MultiLineString";
        let parts = if is_many {
            shape.as_array().expect("as the data note says").clone()
        } else {
            vec![shape.clone()]
        };
        lines.extend(parts.iter().map(|part| Line {
            points: places(part, &pixel),
            width: None,
        }));
    }
    let unsure = Raster::filled(size[0], size[1], false);
    Some(Site::new("vegas_img0", &picture, size, lines, unsure))
}

impl Site {
    fn new(
        name: &'static str,
        native: &Raster<Rgba>,
        size: [usize; 2],
        lines: Vec<Line>,
        unsure: Raster<bool>,
    ) -> Self {
        let range = |at: usize, count: usize, size: usize| {
            let from = (at * size / count).min(size - 1);
            from..((at + 1) * size).div_ceil(count).clamp(from + 1, size)
        };
        let grid = Raster::from_fn(size[0], size[1], |column, row| {
            let (mut sum, mut count) = ([0_u32; 3], 0);
            for y in range(row, size[1], native.height()) {
                for pixel in &native.row(y)[range(column, size[0], native.width())] {
                    if pixel[3] > 0 {
                        count += 1;
                        (0..3).for_each(|i| sum[i] += u32::from(pixel[i]));
                    }
                }
            }
            let [red, green, blue] = sum.map(|s| (s / count.max(1)) as u8);
            [red, green, blue, if count > 0 { 255 } else { 0 }]
        });
        Self {
            name,
            native: native.clone(),
            grid,
            lines,
            unsure,
        }
    }

    /// Pixels of the grid on roads, where their widths were said.
    pub fn road_mask(&self) -> Option<Raster<bool>> {
        self.lines.iter().all(|l| l.width.is_some()).then(|| {
            let mut mask = self.unsure.map(|_| false);
            for line in &self.lines {
                let half = 0.5 * line.width.unwrap_or_default();
                mark(&mut mask, |p| distance(p, &line.points) <= half);
            }
            mask
        })
    }

    /// Places on the centre lines, a pixel apart, inside the grid and not unsure.
    pub fn centre_places(&self) -> Vec<[f64; 2]> {
        let mut all = Vec::new();
        for line in &self.lines {
            for pair in line.points.windows(2) {
                let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
                let steps = (bx - ax).hypot(by - ay).ceil().max(1.0) as usize;
                for i in 0..steps {
                    let t = i as f64 / steps as f64;
                    all.push([ax + t * (bx - ax), ay + t * (by - ay)]);
                }
            }
        }
        all.retain(|p| self.is_sure(*p));
        all
    }

    /// Whether a place lies inside, shows something and is not unsure.
    pub fn is_sure(&self, [x, y]: [f64; 2]) -> bool {
        let (width, height) = (self.grid.width() as f64, self.grid.height() as f64);
        x >= 0.0
            && y >= 0.0
            && x < width
            && y < height
            && !self.unsure.get(x as usize, y as usize)
            && self.grid.get(x as usize, y as usize)[3] > 0
    }

    /// Places where at least three arms of lines meet.
    pub fn crossings(&self) -> Vec<[f64; 2]> {
        let mut found: Vec<[f64; 2]> = Vec::new();
        let mut candidates = Vec::new();
        for (i, a) in self.lines.iter().enumerate() {
            candidates.extend([a.points[0], a.points[a.points.len() - 1]]);
            for b in &self.lines[i + 1..] {
                for p in a.points.windows(2) {
                    for q in b.points.windows(2) {
                        candidates.extend(meeting(p[0], p[1], q[0], q[1]));
                    }
                }
            }
        }
        for place in candidates {
            let arms = self.lines.iter().map(|line| {
                let near = |p: [f64; 2]| (p[0] - place[0]).hypot(p[1] - place[1]) < 5.0;
                let ends = near(line.points[0]) || near(line.points[line.points.len() - 1]);
                match (distance(place, &line.points) < 3.0, ends) {
                    (_, true) => 1,
                    (true, false) => 2,
                    _ => 0,
                }
            });
            let is_new = found
                .iter()
                .all(|f| (f[0] - place[0]).hypot(f[1] - place[1]) > 12.0);
            if arms.sum::<usize>() >= 3 && is_new && self.is_sure(place) {
                found.push(place);
            }
        }
        found
    }
}

fn meeting(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Option<[f64; 2]> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
    let cross = u[0] * v[1] - u[1] * v[0];
    let w = [c[0] - a[0], c[1] - a[1]];
    let (s, t) = (
        (w[0] * v[1] - w[1] * v[0]) / cross,
        (w[0] * u[1] - w[1] * u[0]) / cross,
    );
    ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t))
        .then(|| [a[0] + s * u[0], a[1] + s * u[1]])
}

/// Distance from a place to a line of straight pieces.
pub fn distance([x, y]: [f64; 2], line: &[[f64; 2]]) -> f64 {
    let mut least = f64::INFINITY;
    for pair in line.windows(2) {
        let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
        let (dx, dy) = (bx - ax, by - ay);
        let t = (((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy).max(1e-12)).clamp(0.0, 1.0);
        least = least.min((x - ax - t * dx).hypot(y - ay - t * dy));
    }
    least
}

fn is_inside([x, y]: [f64; 2], outline: &[[f64; 2]]) -> bool {
    let mut inside = false;
    for (i, &[ax, ay]) in outline.iter().enumerate() {
        let [bx, by] = outline[(i + 1) % outline.len()];
        if (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) {
            inside = !inside;
        }
    }
    inside
}

fn mark(mask: &mut Raster<bool>, is_marked: impl Fn([f64; 2]) -> bool) {
    for row in 0..mask.height() {
        for column in 0..mask.width() {
            if is_marked([column as f64 + 0.5, row as f64 + 0.5]) {
                mask.set(column, row, true);
            }
        }
    }
}

/// Those of the named ones that lie beside the repository.
pub fn all(names: &[&str]) -> Vec<Site> {
    let site = |name: &&str| match *name {
        "brighton_beach" => traced("brighton_beach", "brighton_beach/ortho.jpg", None),
        "caliterra" => traced("caliterra", "caliterra/ortho.png", None),
        "adm2014" => traced(
            "adm2014",
            "adm2014/map_january.jpg",
            Some([1700, 1400, 2730, 1600]),
        ),
        "fengyuan" => traced(
            "fengyuan",
            "fengyuan/map.jpg",
            Some([1450, 150, 2645, 3250]),
        ),
        _ => vegas(),
    };
    names.iter().filter_map(site).collect()
}
