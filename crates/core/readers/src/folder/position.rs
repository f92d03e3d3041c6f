//! Positions in a table: metres, degrees on the globe, or pixels of a map.

use nalgebra::Point3;

use super::error::FolderError;
use super::files::{FolderFiles, contents};
use super::layout::{MapPixelColumns, PixelCentres, PositionColumns, ValueColumn};
use super::table::CsvTable;
use crate::cells::Dimension;
use pilotage_base::frames::{Geodetic, GroundPoint, LocalFrame};
use pilotage_base::georeference::{Georeference, GeoreferenceError};

/// Turns columns into positions of the world frame.
pub(super) struct Positions {
    pub(super) frame: Option<LocalFrame>,
    pub(super) ground_down: f64,
}

impl Positions {
    fn frame(&self) -> Result<&LocalFrame, String> {
        self.frame
            .as_ref()
            .ok_or_else(|| "places on the globe need an \"origin\"".to_owned())
    }

    /// Ground point straight below or above a latitude and longitude in radians; of the far side of the globe one that is no
    /// nearer than that.
    pub(super) fn geodetic(&self, latitude: f64, longitude: f64) -> Result<GroundPoint, String> {
        let frame = self.frame()?;
        let place = Geodetic {
            latitude,
            longitude,
            height: frame.origin.height,
        };
        Ok(frame.ground_if_near(&place).unwrap_or_else(|| {
            let far = frame.world_from_geodetic(&place);
            GroundPoint::new(far.x, far.y)
        }))
    }

    /// Ground points of columns of latitude and longitude, in degrees unless they name a unit.
    pub(super) fn on_globe(
        &self,
        table: &CsvTable,
        latitude: &ValueColumn,
        longitude: &ValueColumn,
        place: &str,
    ) -> Result<Vec<Option<GroundPoint>>, FolderError> {
        let angles = |map: &ValueColumn| {
            let mut map = map.clone();
            map.unit.get_or_insert_with(|| "deg".to_owned());
            table.values(&map, Dimension::Angle)
        };
        angles(latitude)?
            .into_iter()
            .zip(angles(longitude)?)
            .map(|pair| {
                let (Some(latitude), Some(longitude)) = pair else {
                    return Ok(None);
                };
                self.geodetic(latitude, longitude)
                    .map(Some)
                    .map_err(|cause| contents(place, cause))
            })
            .collect()
    }

    fn at_map_pixels(
        &self,
        folder: &FolderFiles,
        table: &CsvTable,
        map: &MapPixelColumns,
        place: &str,
    ) -> Result<Vec<Option<GroundPoint>>, FolderError> {
        let bytes = folder.read(&map.georeference, place)?;
        let file = || map.georeference.clone();
        let text = String::from_utf8(bytes).map_err(|_| FolderError::File {
            file: file(),
            cause: "it is not text".to_owned(),
        })?;
        let georeference = Georeference::from_text(&text).map_err(|e| match e {
            GeoreferenceError::Json {
                line,
                column,
                cause,
            } => FolderError::Json {
                file: file(),
                line,
                column,
                cause,
            },
            other => FolderError::File {
                file: file(),
                cause: other.to_string(),
            },
        })?;
        let own_metres = LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0));
        let frame = match georeference {
            Georeference::Metres(_) => self.frame.as_ref().unwrap_or(&own_metres),
            _ => self.frame().map_err(|cause| contents(place, cause))?,
        };
        let shift = match map.pixel_centres {
            PixelCentres::HalfIntegers => 0.0,
            PixelCentres::Integers => 0.5,
        };
        let columns = table.values(&map.x, Dimension::Number)?;
        let rows = table.values(&map.y, Dimension::Number)?;
        Ok(columns
            .into_iter()
            .zip(rows)
            .map(|(x, y)| Some(georeference.ground_at(frame, x? + shift, y? + shift)))
            .collect())
    }

    /// Positions of all rows; `None` where a cell is empty.
    pub(super) fn read(
        &self,
        folder: &FolderFiles,
        table: &CsvTable,
        map: &PositionColumns,
        place: &str,
    ) -> Result<Vec<Option<Point3<f64>>>, FolderError> {
        let ground = match (
            &map.north,
            &map.east,
            &map.latitude,
            &map.longitude,
            &map.map_pixel,
        ) {
            (Some(north), Some(east), None, None, None) => {
                let north = table.values(north, Dimension::Length)?;
                let east = table.values(east, Dimension::Length)?;
                north
                    .into_iter()
                    .zip(east)
                    .map(|(n, e)| Some(GroundPoint::new(n?, e?)))
                    .collect()
            }
            (None, None, Some(latitude), Some(longitude), None) => {
                self.on_globe(table, latitude, longitude, place)?
            }
            (None, None, None, None, Some(pixel)) => {
                self.at_map_pixels(folder, table, pixel, place)?
            }
            _ => {
                return Err(contents(
                    place,
                    "state either north and east, or latitude and longitude, or map_pixel",
                ));
            }
        };
        let down: Vec<Option<f64>> = match (&map.down, &map.height) {
            (Some(down), None) => table.values(down, Dimension::Length)?,
            (None, Some(height)) => table
                .values(height, Dimension::Length)?
                .into_iter()
                .map(|height| Some(self.ground_down - height?))
                .collect(),
            _ => return Err(contents(place, "state either down or height")),
        };
        Ok(ground
            .into_iter()
            .zip(down)
            .map(|(ground, down): (Option<GroundPoint>, _)| Some(world_point(ground?, down?)))
            .collect())
    }
}

/// A position with its down coordinate.
fn world_point(ground: GroundPoint, down: f64) -> Point3<f64> {
    Point3::new(ground.north, ground.east, down)
}
