//! Maps that come as square tiles of the web map: from an address template or a `PMTiles` archive.

mod imagery;
mod metadata;
mod number;
mod pmtiles;
mod template;
#[cfg(test)]
mod tests;

pub use imagery::{TileLack, TileStore, WebTiles, tiles_for};
pub use metadata::ArchiveMetadata;
pub use number::{TileNumber, TileRectangle};
pub use pmtiles::{PmTiles, PmTilesError, TileFormat};
pub use template::{TemplateError, TileTemplate};
