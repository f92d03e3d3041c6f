//! Kind of a file that is not read, and advices that several have.

use pilotage_base::text::capitalised;

/// Kind of a file that is not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foreign {
    /// Name of the kind, with its article: `an encrypted log of PX4`.
    pub what: &'static str,
    /// Advice to people, as a sentence without its stop.
    pub advice: &'static str,
}

impl Foreign {
    /// Sentences for people on the file `name` that is of this kind.
    pub fn sentence(&self, name: &str) -> String {
        let advice = capitalised(self.advice);
        format!("{name}: it is {}, which is not read. {advice}.", self.what)
    }
}

pub(super) const fn kind(what: &'static str, advice: &'static str) -> Foreign {
    Foreign { what, advice }
}

pub(super) const UNPACK: &str = "unpack it and open what is in it";
pub(super) const LOG: &str = "open the log of its flight";
pub(super) const FILM: &str = "open it in the page beside the log of its flight; places in films are read of GoPro alone (MP4, MOV, 360), of others make a CSV (ExifTool)";
/// Of films of kinds that the page does not take.
pub(super) const OTHER_FILM: &str =
    "convert it to MP4 (H.264) and open that in the page beside the log of its flight";
pub(super) const PHOTO: &str =
    "put it into a folder with the other photos of the flight and open that";
pub(super) const JPEG: &str = "save it as JPEG and open its folder";
pub(super) const TO_MCAP: &str =
    "make an MCAP of it (`mcap convert in.bag out.mcap`, or `ros2 bag convert`) and open that";
pub(super) const TO_CSV: &str = "save its tables as CSV and open those";
pub(super) const TO_GEOJSON: &str = "save its layers as GeoJSON (QGIS, `ogr2ogr`), or as GeoTIFF where they are pictures, and open those";
pub(super) const CONVERT: &str =
    "it holds routes or landmarks: `pilotage convert`, or open it in Plan";
pub(super) const FLIGHT_PLAN: &str =
    "save it as GPX (Little Navmap, or the program that made it) and open that in Plan";
pub(super) const SHAPE: &str =
    "save its layer as GeoJSON (QGIS, `ogr2ogr out.geojson in.shp`) and open that";
pub(super) const ROADS: &str = "import it: `pilotage roads import`";
pub(super) const LABELS: &str = "export them as COCO or Pascal VOC and open those";
pub(super) const GRID: &str = "make a GeoTIFF of it (`gdal_translate`) and open that";
pub(super) const RECEIVER: &str = "make a CSV or GPX of it (u-center, gpsbabel) and open that";
pub(super) const AGAIN: &str = "copy it again from where it comes from";

/// Bytes of a file's beginning and end in which archives and databases tell what is in them.
pub(super) const REACH: u64 = 1 << 16;
pub(super) const MODEL: &str =
    "models are not read: save their picture from above as GeoTIFF, and open that as a map";
