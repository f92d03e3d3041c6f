//! Exchange formats: routes and landmarks as other programs read and write them.
//!
//! One file per format and direction; docs/formats.md says what each format holds. What a file has
//! and we do not know is kept in the properties of routes, way-points and landmarks and written
//! again into the same format; whatever was assumed, kept aside or left out stands in the notes.

#[macro_use]
mod formats;

mod air_altitudes;
mod angle;
mod complex;
mod csv_axes;
mod csv_bare;
mod csv_cells;
mod csv_columns;
mod csv_fixed;
mod csv_geometry;
mod csv_heights;
mod csv_hemisphere;
mod csv_letter_o;
mod csv_named;
mod csv_pictures;
mod csv_place;
mod csv_preface;
mod csv_read;
mod csv_rows;
mod csv_system;
mod csv_table;
mod csv_utm;
mod decoded_text;
mod embedded;
mod error;
mod fence;
mod file_look;
mod flown;
mod flown_kml;
mod flown_text;
mod flown_track;
mod format_info;
mod format_of_file;
mod format_work;
mod found;
mod ground_overlay;
mod inav;
mod item;
mod item_route;
mod kml_data;
mod kml_elements;
mod kml_links;
mod kml_pilot;
mod kml_places;
mod kml_read;
mod kml_write;
mod kmz;
pub mod labels;
mod litchi_actions;
mod little_navmap;
mod places;
mod plan;
mod plan_firmware;
#[cfg(test)]
mod plan_schema;
mod plan_terrain;
mod rally;
mod read;
mod route_actions;
mod route_items;
mod see_you;
mod shadow;
mod speed_command;
#[cfg(test)]
mod tests;
mod wpml;
mod write;
mod written;
mod xml;

pub use csv_cells::cells_of_row;
pub use csv_pictures::{TabledPicture, TabledPictures, placed_pictures};
pub use error::ExchangeError;
pub use flown::write_flown;
pub use flown_track::{FlownPoint, FlownTrack, FlownValues};
pub use ground_overlay::{GroundOverlay, GroundOverlays, ground_overlays};
pub use places::Places;
pub use read::{Imported, read_any};
pub use write::{write_landmarks, write_places, write_route};
pub use written::WrittenFile;

// All formats: another one is a file of this folder with its `INFO` and its `WORK`, and a line here.
formats! {
    /// `QGroundControl`'s plan, JSON.
    Plan(old_mission),
    /// `QGC WPL 110`, the plain text of way-points.
    Waypoints(waypoints),
    /// Keyhole markup, XML.
    Kml(kml),
    /// Zipped KML.
    Kmz(kmz_format),
    /// DJI's way-point mission, WPML in a KMZ.
    Wpml(wpml_format),
    /// Litchi's table of way-points.
    Litchi(litchi),
    /// GPS exchange, XML.
    Gpx(gpx),
    /// GeoJSON, ours or others'.
    GeoJson(geojson),
    /// Tables with a header.
    Csv(csv_write),
}
