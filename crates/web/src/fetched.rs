//! Tiles of the web, fetched before the job that reads them begins.

use js_sys::{Array, Promise, Reflect, Uint8Array};
use pilotage_jobs::FileContent;
use wasm_bindgen::JsCast;
use wasm_bindgen_futures::JsFuture;

/// Result of fetching tiles.
pub struct Fetched {
    /// Addresses and bytes of the tiles that came.
    pub tiles: Vec<(String, FileContent)>,
    /// Why the first of those that did not come did not, in words.
    pub problem: Option<String>,
    /// Whether the server gave one of them now.
    pub is_new: bool,
}

/// Waits for what `Shell::fetch_tiles` promised for these addresses.
pub async fn fetched(addresses: Vec<String>, promise: Promise) -> Fetched {
    let Ok(came) = JsFuture::from(promise).await else {
        return Fetched {
            tiles: Vec::new(),
            problem: Some("tiles of the web cannot be fetched here".to_owned()),
            is_new: false,
        };
    };
    let field = |name: &str| Reflect::get(&came, &name.into()).ok();
    let tiles = field("tiles")
        .map(|tiles| Array::from(&tiles))
        .unwrap_or_default();
    let tiles = addresses.into_iter().zip(tiles.iter());
    Fetched {
        tiles: tiles
            .filter_map(|(address, tile)| {
                let bytes = tile.dyn_ref::<Uint8Array>()?.to_vec();
                Some((address, bytes.into()))
            })
            .collect(),
        problem: field("problem").and_then(|text| text.as_string()),
        is_new: field("isNew").and_then(|it| it.as_bool()) == Some(true),
    }
}
