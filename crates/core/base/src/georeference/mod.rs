//! Georeferences of pictures, which place their pixels on the ground: world files and fitted similarities.

mod affine;
#[cfg(test)]
mod tests;

use nalgebra::{Matrix2, Matrix3, Point2, Vector2};
use serde::{Deserialize, Serialize};

use crate::frames::{Geodetic, GroundPoint, LocalFrame, ReferenceSystem, wrap_pi};

pub use affine::GroundFromPixel;

/// Radius of the sphere on which the fitted similarities count their metres.
const SPHERE_RADIUS: f64 = 6_378_137.0;

/// Why a georeference cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeoreferenceError {
    /// A world file has six numbers, one per line.
    #[error("line {line}: a world file has six numbers, one per line; {cause}")]
    WorldFile {
        /// Line, counted from one.
        line: usize,
        /// Error of the line, in words.
        cause: String,
    },
    /// The JSON does not have the expected members.
    #[error("line {line}, column {column}: {cause}")]
    Json {
        /// Line, counted from one.
        line: usize,
        /// Column, counted from one.
        column: usize,
        /// Error of the JSON, in words.
        cause: String,
    },
    /// The pixels do not span an area.
    #[error("the numbers do not span an area on the ground; check for zeros")]
    Degenerate,
    /// No part of the picture is near the world's origin.
    #[error(
        "it lies too far from the origin of the world, on the other side of the globe; open it in a world of its own"
    )]
    TooFar,
}

/// Farthest from a world's origin that metres of the world's own frame are believed; larger numbers are
/// those of a projected reference system, metres.
const WORLD_REACH: f64 = 60_000.0;

/// Georeference as a picture's side file states it, before a world frame is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Georeference {
    /// East and north in metres of the world frame itself, per pixel with centres at integers.
    Metres(WorldFile),
    /// Coordinates of a reference system, per pixel with centres at integers.
    Projected {
        /// Reference system of the coordinates.
        system: ReferenceSystem,
        /// Coordinates of the pixels.
        file: WorldFile,
    },
    /// A similarity to metres on a sphere around an origin.
    Similarity(GroundSimilarity),
    /// Coordinates of a reference system through perspective, as of a plane that was seen askew.
    Projective {
        /// Reference system of the coordinates.
        system: ReferenceSystem,
        /// (x, y, 1) up to a factor from (column, row, 1), pixel centres at half integers; the factor
        /// is positive on the seen side of the horizon.
        plane_from_pixel: Matrix3<f64>,
    },
}

/// The six numbers of a world file: x = a·column + b·row + c, y = d·column + e·row + f for the
/// centre of the pixel in that column and row, counted from zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldFile {
    /// x per column.
    pub a: f64,
    /// y per column.
    pub d: f64,
    /// x per row.
    pub b: f64,
    /// y per row.
    pub e: f64,
    /// x of the centre of the top-left pixel.
    pub c: f64,
    /// y of the centre of the top-left pixel.
    pub f: f64,
}

/// (east, north) = gsd · R · (column, -row) + T for pixel centres at integers, metres on a sphere of
/// radius 6,378,137 m around the origin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroundSimilarity {
    /// Latitude of the origin, degrees.
    pub origin_lat: f64,
    /// Longitude of the origin, degrees.
    pub origin_lon: f64,
    /// Ground sample distance, metres per pixel.
    #[serde(alias = "gsd_m_per_px")]
    pub gsd: f64,
    /// Rotation.
    #[serde(rename = "R")]
    pub rotation: [[f64; 2]; 2],
    /// East and north of the centre of the top-left pixel, metres.
    #[serde(rename = "T")]
    pub translation: [f64; 2],
}

/// A perspective as its file states it.
#[derive(Serialize, Deserialize)]
struct Perspective {
    epsg: u32,
    plane_from_pixel: [[f64; 3]; 3],
}

impl TryFrom<Perspective> for Georeference {
    type Error = serde_json::Error;

    fn try_from(file: Perspective) -> Result<Self, Self::Error> {
        let unknown = || serde::de::Error::custom(format!("EPSG:{} is not known", file.epsg));
        Ok(Self::Projective {
            system: ReferenceSystem::from_epsg(file.epsg).ok_or_else(unknown)?,
            plane_from_pixel: Matrix3::from_fn(|row, column| file.plane_from_pixel[row][column]),
        })
    }
}

impl Georeference {
    /// Reads a world file (.jgw, .pgw, .tfw, .wld).
    ///
    /// Such a file does not name its unit: numbers that fit longitude and latitude with pixels below
    /// a thousandth of a degree are taken for degrees, others for metres of the world frame.
    ///
    /// ```
    /// use pilotage_base::frames::{Geodetic, GroundPoint, LocalFrame};
    /// use pilotage_base::georeference::Georeference;
    ///
    /// // Pixels of 0.5 m; the middle of the top left one lies 100 m east and 200 m north of the origin.
    /// let file = "0.5\n0\n0\n-0.5\n100\n200\n";
    /// let georeference = Georeference::from_world_file(file)?;
    /// # let world = LocalFrame::new(Geodetic::from_degrees(46.8, -92.0, 0.0));
    /// // Ten columns to the right and four rows down; middles of pixels lie at halves.
    /// let ground = georeference.ground_at(&world, 10.5, 4.5);
    /// assert_eq!(ground, GroundPoint::new(198.0, 105.0));
    /// # Ok::<(), pilotage_base::georeference::GeoreferenceError>(())
    /// ```
    pub fn from_world_file(text: &str) -> Result<Self, GeoreferenceError> {
        let mut numbers = [0.0; 6];
        let mut count = 0;
        for (i, line) in text.lines().enumerate() {
            let line_number = i + 1;
            let word = line.trim().trim_start_matches('\u{feff}');
            if word.is_empty() {
                continue;
            }
            // Programs in countries with decimal commas write them.
            let is_with_comma = word.matches(',').count() == 1 && !word.contains('.');
            let plain = is_with_comma.then(|| word.replace(',', "."));
            let value = plain.as_deref().unwrap_or(word).parse::<f64>();
            let value = value.map_err(|_| GeoreferenceError::WorldFile {
                line: line_number,
                cause: format!("\"{}\" is not a number", abbreviated(word)),
            })?;
            if count == 6 || !value.is_finite() {
                return Err(GeoreferenceError::WorldFile {
                    line: line_number,
                    cause: if count == 6 {
                        "there are more".to_owned()
                    } else {
                        format!("{word} is not finite")
                    },
                });
            }
            numbers[count] = value;
            count += 1;
        }
        if count < 6 {
            return Err(GeoreferenceError::WorldFile {
                line: text.lines().count().max(1),
                cause: format!("the file ends after {count}"),
            });
        }
        let [a, d, b, e, c, f] = numbers;
        Ok(Self::of_world_file(WorldFile { a, d, b, e, c, f }))
    }

    /// The place of a world file's numbers, of which degrees are told from metres as in
    /// [`Georeference::from_world_file`].
    pub fn of_world_file(file: WorldFile) -> Self {
        let mut steps = [file.a, file.b, file.d, file.e].into_iter();
        if steps.all(|v| v.abs() < 1e-3) && file.c.abs() <= 360.0 && file.f.abs() <= 90.0 {
            Self::Projected {
                system: ReferenceSystem::Geographic,
                file,
            }
        } else {
            Self::Metres(file)
        }
    }

    /// The same numbers of a world file taken for coordinates of `system`; a similarity stays what
    /// it is.
    #[must_use]
    pub fn with_system(self, system: ReferenceSystem) -> Self {
        match self {
            Self::Metres(file) | Self::Projected { file, .. } => Self::Projected { system, file },
            Self::Similarity(_) => self,
            Self::Projective {
                plane_from_pixel, ..
            } => Self::Projective {
                system,
                plane_from_pixel,
            },
        }
    }

    /// Reference system of the coordinates, where they have one.
    pub fn system(&self) -> Option<&ReferenceSystem> {
        match self {
            Self::Projected { system, .. } | Self::Projective { system, .. } => Some(system),
            Self::Metres(_) | Self::Similarity(_) => None,
        }
    }

    /// Reads a fitted similarity: JSON with `origin_lat`, `origin_lon`, `gsd`, `R` and `T`; or a
    /// perspective: `epsg` and the rows of `plane_from_pixel`. Other members are ignored.
    pub fn from_json(text: &str) -> Result<Self, GeoreferenceError> {
        let read = if text.contains("\"plane_from_pixel\"") {
            serde_json::from_str::<Perspective>(text).and_then(Self::try_from)
        } else {
            serde_json::from_str(text).map(Self::Similarity)
        };
        read.map_err(|e| {
            let text = e.to_string();
            let end = text.rfind(" at line ").unwrap_or(text.len());
            GeoreferenceError::Json {
                line: e.line(),
                column: e.column(),
                cause: text[..end].to_owned(),
            }
        })
    }

    /// The JSON that [`Georeference::from_json`] reads; `None` of what is a world file, and of a system
    /// that has no code.
    pub fn to_json(&self) -> Option<String> {
        match self {
            Self::Metres(_) | Self::Projected { .. } => None,
            Self::Similarity(similarity) => serde_json::to_string(similarity).ok(),
            Self::Projective {
                system,
                plane_from_pixel: m,
            } => {
                let perspective = Perspective {
                    epsg: system.epsg()?,
                    plane_from_pixel: [0, 1, 2].map(|row| [0, 1, 2].map(|column| m[(row, column)])),
                };
                serde_json::to_string(&perspective).ok()
            }
        }
    }

    /// Reads either kind, by the first character.
    pub fn from_text(text: &str) -> Result<Self, GeoreferenceError> {
        if text.trim_start().starts_with('{') {
            Self::from_json(text)
        } else {
            Self::from_world_file(text)
        }
    }

    /// A place on the globe for the origin of a world frame, if the georeference names any: the
    /// similarity's own origin, or the middle of a picture of the given size.
    pub fn origin(&self, width: usize, height: usize) -> Option<Geodetic> {
        if let Self::Similarity(s) = self {
            return Some(Geodetic::from_degrees(s.origin_lat, s.origin_lon, 0.0));
        }
        self.place_at(0.5 * width as f64, 0.5 * height as f64)
    }

    /// Ground point of a pixel (centres at half integers) in the world frame `frame`; not a number
    /// where the coordinates name no place on Earth.
    pub fn ground_at(&self, frame: &LocalFrame, x: f64, y: f64) -> GroundPoint {
        if let Self::Metres(file) = self {
            let (east, north) = file.at(x, y);
            return GroundPoint::new(north, east);
        }
        self.place_at(x, y)
            .map_or(GroundPoint::new(f64::NAN, f64::NAN), |place| {
                frame.ground_from_geodetic(&place)
            })
    }

    /// Pixel (centres at half integers) of a ground point in the world frame `frame`; `None` where
    /// the reference system does not reach or the numbers span no area. Where coordinates go around the
    /// Earth, it is the first from the left edge on.
    pub fn pixel_at(&self, frame: &LocalFrame, ground: &GroundPoint) -> Option<Point2<f64>> {
        let half = self.turn().unwrap_or_default() * 0.5;
        self.pixel_near(frame, ground, &Point2::from(half))
    }

    /// As [`pixel_at`](Self::pixel_at), but of the pixels that are the same place the one nearest to `near`,
    /// the picture's middle.
    pub fn pixel_near(
        &self,
        frame: &LocalFrame,
        ground: &GroundPoint,
        near: &Point2<f64>,
    ) -> Option<Point2<f64>> {
        match self {
            Self::Metres(file) => file.pixel_at(ground.east, ground.north),
            Self::Projected { system, file } => {
                let (x, y) = system.coordinates(&frame.geodetic_from_ground(ground))?;
                let pixel = file.pixel_at(x, y)?;
                Some(match self.turn() {
                    Some(turn) => nearest(&pixel, near, &turn),
                    None => pixel,
                })
            }
            Self::Similarity(s) => s.pixel_at(&frame.geodetic_from_ground(ground)),
            Self::Projective {
                system,
                plane_from_pixel,
            } => {
                let (x, y) = system.coordinates(&frame.geodetic_from_ground(ground))?;
                let inverse = plane_from_pixel.try_inverse()?;
                let h = inverse * Point2::new(x, y).to_homogeneous();
                let pixel = Point2::new(h.x / h.z, h.y / h.z);
                // The inverse has lost the side of the horizon.
                seen_through(plane_from_pixel, &pixel).map(|_| pixel)
            }
        }
    }

    /// Place on the globe of a pixel (centres at half integers); `None` where the coordinates name no
    /// place on Earth, and of a georeference that names none.
    pub fn place_at(&self, x: f64, y: f64) -> Option<Geodetic> {
        match self {
            Self::Metres(_) => None,
            Self::Projected { system, file } => {
                let (x, y) = file.at(x, y);
                system.geodetic(x, y)
            }
            Self::Similarity(s) => {
                let (latitude, longitude) = s.degrees_at(x, y);
                (latitude.is_finite() && longitude.is_finite())
                    .then(|| Geodetic::from_degrees(latitude, longitude, 0.0))
            }
            Self::Projective {
                system,
                plane_from_pixel,
            } => {
                let place = seen_through(plane_from_pixel, &Point2::new(x, y))?;
                system.geodetic(place.x, place.y)
            }
        }
    }

    /// Pixels from a place to the same place after once around the Earth, where coordinates count along
    /// parallels.
    pub fn turn(&self) -> Option<Vector2<f64>> {
        let Self::Projected { system, file } = self else {
            return None;
        };
        let matrix = Matrix2::new(file.a, file.b, file.d, file.e);
        let turn = matrix.try_inverse()? * Vector2::new(system.around()?, 0.0);
        (turn.norm_squared().is_normal()).then_some(turn)
    }
}

/// `pixel`, or the same whole numbers of `turn` away that is nearest to `near`.
pub fn nearest(pixel: &Point2<f64>, near: &Point2<f64>, turn: &Vector2<f64>) -> Point2<f64> {
    let turns = (pixel - near).dot(turn) / turn.norm_squared();
    pixel - turns.round() * turn
}

/// A pixel under a projective map; `None` beyond the horizon.
fn seen_through(matrix: &Matrix3<f64>, pixel: &Point2<f64>) -> Option<Point2<f64>> {
    let h = matrix * pixel.to_homogeneous();
    (h.z > 0.0).then(|| Point2::new(h.x / h.z, h.y / h.z))
}

/// The six lines of the file, in digits that read back the same.
impl std::fmt::Display for WorldFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for value in [self.a, self.d, self.b, self.e, self.c, self.f] {
            writeln!(f, "{value}")?;
        }
        Ok(())
    }
}

impl WorldFile {
    /// A picture of one unit a pixel whose top left corner is the origin.
    #[must_use]
    pub fn of_pixels() -> Self {
        Self {
            a: 1.0,
            d: 0.0,
            b: 0.0,
            e: -1.0,
            c: 0.5,
            f: -0.5,
        }
    }

    /// Whether the numbers are too large for metres of a world's own frame: more than 60 km from its
    /// origin, where the eastings and northings of projected systems lie.
    #[must_use]
    pub fn is_beyond_a_world(&self) -> bool {
        self.c.abs() > WORLD_REACH || self.f.abs() > WORLD_REACH
    }

    /// (x, y) at a pixel with centres at half integers.
    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let (column, row) = (x - 0.5, y - 0.5);
        (
            self.a * column + self.b * row + self.c,
            self.d * column + self.e * row + self.f,
        )
    }
}

impl WorldFile {
    /// Pixel with centres at half integers of the coordinates (x, y).
    fn pixel_at(&self, x: f64, y: f64) -> Option<Point2<f64>> {
        let matrix = Matrix2::new(self.a, self.b, self.d, self.e);
        let pixel = matrix.try_inverse()? * Vector2::new(x - self.c, y - self.f);
        Some(Point2::new(pixel.x + 0.5, pixel.y + 0.5))
    }
}

impl GroundSimilarity {
    /// Latitude and longitude in degrees at a pixel with centres at half integers.
    fn degrees_at(&self, x: f64, y: f64) -> (f64, f64) {
        let (column, row) = (x - 0.5, y - 0.5);
        let [[r00, r01], [r10, r11]] = self.rotation;
        let east = self.gsd * (r00 * column - r01 * row) + self.translation[0];
        let north = self.gsd * (r10 * column - r11 * row) + self.translation[1];
        let cosine = self.origin_lat.to_radians().cos();
        (
            self.origin_lat + (north / SPHERE_RADIUS).to_degrees(),
            self.origin_lon + (east / (SPHERE_RADIUS * cosine)).to_degrees(),
        )
    }

    /// Pixel with centres at half integers of a place.
    fn pixel_at(&self, place: &Geodetic) -> Option<Point2<f64>> {
        let [[r00, r01], [r10, r11]] = self.rotation;
        let origin = Geodetic::from_degrees(self.origin_lat, self.origin_lon, 0.0);
        let from_origin = wrap_pi(place.longitude - origin.longitude);
        let east = from_origin * SPHERE_RADIUS * origin.latitude.cos();
        let north = (place.latitude - origin.latitude) * SPHERE_RADIUS;
        let matrix = self.gsd * Matrix2::new(r00, -r01, r10, -r11);
        let from = Vector2::new(east - self.translation[0], north - self.translation[1]);
        let pixel = matrix.try_inverse()? * from;
        Some(Point2::new(pixel.x + 0.5, pixel.y + 0.5))
    }
}

fn abbreviated(word: &str) -> String {
    word.chars().take(40).collect()
}
