//! Functions of the browser that this crate uses beside `web-sys`.

use js_sys::{Uint8Array, Uint8ClampedArray};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// Milliseconds since the page or worker began, never going back.
    #[wasm_bindgen(js_namespace = performance, js_name = now)]
    pub fn now() -> f64;

    /// Asks for a lock of that name and calls back once it is had; what it was asked for to hold
    /// it is the browser's business.
    #[wasm_bindgen(js_namespace = ["navigator", "locks"], js_name = request, catch)]
    pub fn request_lock(name: &str, had: &JsValue) -> Result<JsValue, JsValue>;

    /// Sends a worker its compiled program, as soon as that is there, and the lock it is to hold; a
    /// function that `www/main.js` puts on the page.
    #[wasm_bindgen(js_namespace = window, js_name = sendProgram, catch)]
    pub fn send_program(worker: &web_sys::Worker, program: &str, lock: &str)
    -> Result<(), JsValue>;

    /// The page's services, an object of `www/shell.js`.
    pub type Shell;

    /// Shows the dialog that opens files.
    #[wasm_bindgen(method, js_name = askForFiles)]
    pub fn ask_for_files(this: &Shell);

    /// Offers bytes as a download.
    #[wasm_bindgen(method, js_name = saveFile)]
    pub fn save_file(this: &Shell, name: &str, bytes: Uint8Array);

    /// Offers an SVG drawing as a PNG picture of so many pixels as a download.
    #[wasm_bindgen(method, js_name = savePicture)]
    pub fn save_picture(this: &Shell, name: &str, svg: &str, width: u32, height: u32);

    /// Offers pixels (red, green, blue, opacity) as a PNG picture as a download.
    #[wasm_bindgen(method, js_name = savePixels)]
    pub fn save_pixels(
        this: &Shell,
        name: &str,
        pixels: Uint8ClampedArray,
        width: u32,
        height: u32,
    );

    /// Begins a film of the canvas; the ending of its file's name, or nothing.
    #[wasm_bindgen(method, js_name = startFilm)]
    pub fn start_film(this: &Shell) -> String;

    /// Ends the film and offers it as a download.
    #[wasm_bindgen(method, js_name = stopFilm)]
    pub fn stop_film(this: &Shell, name: &str);

    /// Remembers bytes in the browser's storage, soon.
    #[wasm_bindgen(method)]
    pub fn store(this: &Shell, key: &str, bytes: Uint8Array);

    /// Remembers a file in the browser's storage, soon.
    #[wasm_bindgen(method, js_name = storeFile)]
    pub fn store_file(this: &Shell, key: &str, file: &JsValue);

    /// Tiles at addresses, from the browser's cache or the web: a promise of an object with `tiles`,
    /// byte arrays or null, `problem`, a text or null, and `isNew`, whether the web gave one of them.
    #[wasm_bindgen(method, js_name = fetchTiles)]
    pub fn fetch_tiles(this: &Shell, addresses: js_sys::Array) -> js_sys::Promise;

    /// A file that the page has beside its program: a promise of its bytes.
    #[wasm_bindgen(method, js_name = fetchOwn)]
    pub fn fetch_own(this: &Shell, file: &str) -> js_sys::Promise;

    /// Fetches tiles into the browser's cache.
    #[wasm_bindgen(method, js_name = downloadTiles)]
    pub fn download_tiles(this: &Shell, addresses: js_sys::Array);

    /// Progress of the download: done, all, failed, and 1 once it is over, 2 if for lack of room; empty if it was never
    /// begun.
    #[wasm_bindgen(method, js_name = downloadState)]
    pub fn download_state(this: &Shell) -> Vec<f64>;

    /// Ends it.
    #[wasm_bindgen(method, js_name = stopDownload)]
    pub fn stop_download(this: &Shell);

    /// Throws away what is in the browser's storage under a key, soon.
    #[wasm_bindgen(method)]
    pub fn forget(this: &Shell, key: &str);

    /// Server that the page comes from.
    #[wasm_bindgen(method, js_name = ownServer)]
    pub fn own_server(this: &Shell) -> String;

    /// Whether people have the rest of their screen light.
    #[wasm_bindgen(method, js_name = prefersLight)]
    pub fn prefers_light(this: &Shell) -> bool;

    /// Whether people want nothing to move by itself.
    #[wasm_bindgen(method, js_name = prefersStillness)]
    pub fn prefers_stillness(this: &Shell) -> bool;

    /// Whether what people point with is their fingers first of all.
    #[wasm_bindgen(method, js_name = isTouchedFirst)]
    pub fn is_touched_first(this: &Shell) -> bool;

    /// Keys of what the browser refused to store since the last call.
    #[wasm_bindgen(method, js_name = failedStores)]
    pub fn failed_stores(this: &Shell) -> Vec<String>;

    /// Keys whose save in an earlier visit was found to have broken off, since the last call.
    #[wasm_bindgen(method, js_name = interruptedSaves)]
    pub fn interrupted_saves(this: &Shell) -> Vec<String>;

    /// Lets the user print a page: style sheet and body, as HTML.
    #[wasm_bindgen(method)]
    pub fn print(this: &Shell, style: &str, body: &str);

    /// Puts a link with that fragment into the clipboard, or shows it: a promise of whether it was copied.
    #[wasm_bindgen(method, js_name = copyLink)]
    pub fn copy_link(this: &Shell, fragment: &str) -> js_sys::Promise;

    /// Puts a place in the app into the browser's history, or in the place of the entry that is shown.
    #[wasm_bindgen(method, js_name = showPlace)]
    pub fn show_place(this: &Shell, place: &str, replaces: bool);

    /// Puts a text where screen readers read it out.
    #[wasm_bindgen(method)]
    pub fn announce(this: &Shell, text: &str);
}
