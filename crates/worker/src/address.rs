//! Files of the web read by pieces, with requests that ask for ranges and wait, which workers may.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use js_sys::{ArrayBuffer, Uint8Array};
use pilotage_core::imagery::ByteSource;
use wasm_bindgen::prelude::*;

/// Bytes that are asked for at least, so that many small pieces become few requests.
const BLOCK: u64 = 64 << 10;
/// Blocks that are kept.
const MOST_BLOCKS: usize = 128;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_name = XMLHttpRequest)]
    type Request;

    #[wasm_bindgen(constructor, js_class = "XMLHttpRequest")]
    fn new() -> Request;

    #[wasm_bindgen(method, catch)]
    fn open(this: &Request, method: &str, address: &str, waits_not: bool) -> Result<(), JsValue>;

    #[wasm_bindgen(method, setter, js_name = responseType)]
    fn set_kind(this: &Request, kind: &str);

    #[wasm_bindgen(method, js_name = setRequestHeader)]
    fn set_header(this: &Request, name: &str, value: &str);

    #[wasm_bindgen(method, catch)]
    fn send(this: &Request) -> Result<(), JsValue>;

    #[wasm_bindgen(method, getter)]
    fn status(this: &Request) -> u16;

    #[wasm_bindgen(method, getter)]
    fn response(this: &Request) -> JsValue;

    #[wasm_bindgen(method, js_name = getResponseHeader)]
    fn header(this: &Request, name: &str) -> Option<String>;
}

/// A file at an address.
pub struct AddressBytes {
    address: String,
    length: u64,
    blocks: Mutex<BTreeMap<u64, Vec<u8>>>,
}

impl AddressBytes {
    /// Asks how long the file is; the error says in words why it cannot be had.
    pub fn open(address: &str) -> Result<Self, String> {
        let request = ask("HEAD", address, None)?;
        let status = request.status();
        if status != 200 {
            return Err(format!("the server answers {status}; check the address"));
        }
        let length = request
            .header("Content-Length")
            .and_then(|v| v.parse().ok());
        let length = length
            .ok_or("the server does not say how long the file is; download it and drop it here")?;
        Ok(Self {
            address: address.to_owned(),
            length,
            blocks: Mutex::new(BTreeMap::new()),
        })
    }

    fn fetch(&self, first: u64, end: u64) -> Result<Vec<u8>, String> {
        let range = format!("bytes={first}-{}", end - 1);
        let request = ask("GET", &self.address, Some(&range))?;
        match request.status() {
            206 => {
                let bytes: ArrayBuffer = request.response().unchecked_into();
                let bytes = Uint8Array::new(&bytes).to_vec();
                if bytes.len() as u64 == end - first {
                    Ok(bytes)
                } else {
                    Err("the server gave another part than was asked for".to_owned())
                }
            }
            200 => Err(
                "the server does not give parts of files; download it and drop it here".to_owned(),
            ),
            other => Err(format!("the server answers {other}")),
        }
    }
}

fn ask(method: &str, address: &str, range: Option<&str>) -> Result<Request, String> {
    let request = Request::new();
    let opened = request.open(method, address, false);
    opened.map_err(|_| "this is no address of the web; check it")?;
    request.set_kind("arraybuffer");
    if let Some(range) = range {
        request.set_header("Range", range);
    }
    request.send().map_err(|_| {
        "the server does not answer this page: there is no network, or it does not allow it (CORS)"
    })?;
    Ok(request)
}

impl ByteSource for AddressBytes {
    fn name(&self) -> &str {
        &self.address
    }

    fn length(&self) -> u64 {
        self.length
    }

    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        let end = offset + length as u64;
        let (first, last) = (offset / BLOCK, end.saturating_sub(1) / BLOCK);
        let mut blocks = self.blocks.lock().unwrap_or_else(PoisonError::into_inner);
        let missing = |block: &u64| !blocks.contains_key(block);
        let gap = (first..=last)
            .find(missing)
            .zip((first..=last).rev().find(missing));
        if let Some((from, to)) = gap {
            let start = from * BLOCK;
            let bytes = self.fetch(start, ((to + 1) * BLOCK).min(self.length))?;
            if blocks.len() + (to - from + 1) as usize > MOST_BLOCKS {
                blocks.retain(|block, _| (first..=last).contains(block));
            }
            for (index, piece) in bytes.chunks(BLOCK as usize).enumerate() {
                blocks.insert(from + index as u64, piece.to_vec());
            }
        }
        let mut out = Vec::with_capacity(length);
        for block in first..=last {
            let bytes = blocks.get(&block).ok_or("a part is missing")?;
            let start = offset.saturating_sub(block * BLOCK).min(bytes.len() as u64);
            let stop = (end - block * BLOCK).min(bytes.len() as u64);
            out.extend_from_slice(&bytes[start as usize..stop as usize]);
        }
        Ok(out)
    }
}
