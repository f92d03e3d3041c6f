//! Addresses of tiles.

use serde::{Deserialize, Serialize};

use super::TileNumber;
use super::number::DEEPEST;

/// Source of the tiles of a map, and the attribution to its makers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TileTemplate {
    /// Name for people.
    pub name: String,
    /// Address with `{z}`, `{x}` and `{y}` (or `{-y}`, counted from the south; or `{q}`, a quadkey), and
    /// optionally `{s}` or `{a-c}` for one of several servers.
    pub address: String,
    /// Attribution that has to be shown wherever the map is.
    pub attribution: String,
    /// Coarsest zoom that the server has.
    pub least_zoom: u8,
    /// Deepest zoom that the server has.
    pub most_zoom: u8,
    /// Pixels along the side of a tile.
    pub side: usize,
}

/// Error of a template.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TemplateError {
    /// Not every tile has an address of its own.
    #[error(
        "\"{address}\": {{z}}, {{x}} and {{y}} are needed, e.g. https://tiles.example.org/{{z}}/{{x}}/{{y}}.png"
    )]
    Placeholders {
        /// The address.
        address: String,
    },
    /// The address is none of the web.
    #[error("\"{address}\": an address of tiles begins with https:// or http://")]
    Scheme {
        /// The address.
        address: String,
    },
    /// The zooms contradict each other.
    #[error("zooms from {least} to {most}; they go from 0 up to {DEEPEST}, the least one first")]
    Zooms {
        /// Coarsest zoom.
        least: u8,
        /// Deepest zoom.
        most: u8,
    },
    /// The tiles have no size.
    #[error("tiles of {side} pixels; 256 and 512 are usual")]
    Side {
        /// Pixels along the side of a tile.
        side: usize,
    },
}

impl TileTemplate {
    /// A template, checked.
    pub fn checked(self) -> Result<Self, TemplateError> {
        let has = |part: &str| self.address.contains(part);
        let address = || self.address.clone();
        let is_numbered = has("{z}") && has("{x}") && (has("{y}") || has("{-y}"));
        if !is_numbered && !has("{q}") {
            return Err(TemplateError::Placeholders { address: address() });
        }
        if !["https://", "http://"]
            .iter()
            .any(|s| self.address.starts_with(s))
        {
            return Err(TemplateError::Scheme { address: address() });
        }
        if self.least_zoom > self.most_zoom || self.most_zoom > DEEPEST {
            return Err(TemplateError::Zooms {
                least: self.least_zoom,
                most: self.most_zoom,
            });
        }
        if !(16..=4096).contains(&self.side) {
            return Err(TemplateError::Side { side: self.side });
        }
        Ok(self)
    }

    /// Address of a tile.
    ///
    /// ```
    /// use pilotage_maps::web_tiles::{TileNumber, TileTemplate};
    ///
    /// let template = TileTemplate {
    ///     name: "Example".to_owned(),
    ///     address: "https://tiles.example.org/{z}/{x}/{y}.png".to_owned(),
    ///     attribution: "© somebody".to_owned(),
    /// #     least_zoom: 0,
    /// #     most_zoom: 19,
    /// #     side: 256,
    /// }
    /// .checked()?;
    /// let tile = TileNumber { zoom: 3, x: 5, y: 2 };
    /// assert_eq!(template.address_of(&tile), "https://tiles.example.org/3/5/2.png");
    /// # Ok::<(), pilotage_maps::web_tiles::TemplateError>(())
    /// ```
    pub fn address_of(&self, tile: &TileNumber) -> String {
        let TileNumber { zoom, x, y } = *tile;
        let from_south = (1_u32 << zoom.min(DEEPEST)) - 1 - y;
        let quadkey: String = (0..zoom)
            .rev()
            .map(|bit| ['0', '1', '2', '3'][((x >> bit & 1) + 2 * (y >> bit & 1)) as usize])
            .collect();
        let server = ["a", "b", "c"][((x + y) % 3) as usize];
        self.address
            .replace("{z}", &zoom.to_string())
            .replace("{x}", &x.to_string())
            .replace("{y}", &y.to_string())
            .replace("{-y}", &from_south.to_string())
            .replace("{q}", &quadkey)
            .replace("{s}", server)
            .replace("{a-c}", server)
    }
}
