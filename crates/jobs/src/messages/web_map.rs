//! A map of the web, and which tiles lie where in it.

use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_core::imagery::Window;
use pilotage_core::imagery::web_tiles::{TileNumber, TileRectangle, TileTemplate, tiles_for};
use serde::{Deserialize, Serialize};

/// Reach of the map from the origin, metres: beyond, the plane leaves the globe.
const REACH: f64 = 100_000.0;

/// A map of the web in a world frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WebMap {
    /// Source of the tiles.
    pub template: TileTemplate,
    /// Origin of the world frame.
    pub origin: Geodetic,
}

impl WebMap {
    /// The world frame.
    pub(crate) fn frame(&self) -> LocalFrame {
        LocalFrame::new(self.origin)
    }

    /// Least and greatest zoom of its tiles.
    pub(crate) fn zooms(&self) -> (u8, u8) {
        (self.template.least_zoom, self.template.most_zoom)
    }

    /// The ground that it covers.
    pub fn area() -> GroundRect {
        GroundRect::centered(GroundPoint::default(), 2.0 * REACH, 2.0 * REACH)
    }

    /// Metres per pixel of its deepest tiles.
    pub fn finest(&self) -> f64 {
        let metres = TileNumber::side(self.template.most_zoom) * self.origin.latitude.cos();
        metres / self.template.side as f64
    }

    /// Addresses of the tiles that a window is drawn from.
    pub(crate) fn of_window(&self, window: &Window) -> Vec<String> {
        let tiles = tiles_for(window, &self.frame(), self.zooms(), self.template.side);
        tiles.map_or_else(Vec::new, |tiles| self.addresses(&tiles))
    }

    fn addresses(&self, tiles: &TileRectangle) -> Vec<String> {
        let tiles = tiles.tiles();
        tiles
            .map(|(_, tile)| self.template.address_of(&tile))
            .collect()
    }

    /// Number of tiles over `area` at every zoom from `zooms.0` to `zooms.1`.
    pub fn count_over(&self, area: &GroundRect, zooms: (u8, u8)) -> u64 {
        let of = |zoom| TileRectangle::covering(area, &self.frame(), zoom).count();
        (zooms.0..=zooms.1).map(of).sum()
    }

    /// Addresses of those tiles, coarse ones first.
    ///
    /// ```
    /// use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect};
    /// use pilotage_core::imagery::web_tiles::TileTemplate;
    /// use pilotage_jobs::WebMap;
    ///
    /// let [name, attribution] = ["Tiles", "© Tiles"].map(str::to_owned);
    /// let address = "https://example.org/{z}/{x}/{y}.png".to_owned();
    /// let template = TileTemplate { name, address, attribution, least_zoom: 0, most_zoom: 18, side: 256 };
    /// let map = WebMap { template, origin: Geodetic::from_degrees(0.0, 0.0, 0.0) };
    /// // Just north-east of where the equator meets the meridian of Greenwich.
    /// let area = GroundRect::centered(GroundPoint::new(500.0, 500.0), 100.0, 100.0);
    /// let addresses = map.addresses_over(&area, (1, 2));
    /// assert_eq!(addresses, ["https://example.org/1/1/0.png", "https://example.org/2/2/1.png"]);
    /// ```
    pub fn addresses_over(&self, area: &GroundRect, zooms: (u8, u8)) -> Vec<String> {
        let of = |zoom| self.addresses(&TileRectangle::covering(area, &self.frame(), zoom));
        (zooms.0..=zooms.1).flat_map(of).collect()
    }
}
