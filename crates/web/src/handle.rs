//! The page's entry.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Uint8Array};
use pilotage_core::exchange::Format;
use pilotage_core::flight::log::LogFormat;
use pilotage_jobs::{FileContent, flown_in_words};
use pilotage_ui::host::OpenedFile;
use pilotage_ui::kept_mesh::install;
use pilotage_ui::kept_tree::{KeptTree, tree_json};
use pilotage_ui::short_map::ShortMap;
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use crate::app::PageApp;
use crate::browser::Shell;
use crate::graphics::Graphics;
use crate::host::{PageHost, Remembered};
use crate::lent::{Blob, lend};

/// Handle of the app that `www/main.js` drives, and `window.app` for tests.
#[wasm_bindgen]
#[derive(Clone)]
pub struct WebHandle {
    runner: eframe::WebRunner,
    remembered: Rc<RefCell<ShortMap<String, Vec<u8>>>>,
    remembered_files: Rc<RefCell<ShortMap<String, FileContent>>>,
    running: Rc<RefCell<Option<(egui::Context, PageHost)>>>,
}

#[wasm_bindgen]
impl WebHandle {
    /// A page that has not started.
    #[wasm_bindgen(constructor)]
    #[expect(clippy::new_without_default, reason = "constructed from JavaScript")]
    pub fn new() -> Self {
        Self {
            runner: eframe::WebRunner::new(),
            remembered: Rc::default(),
            remembered_files: Rc::default(),
            running: Rc::default(),
        }
    }

    /// Endings of the names of logs, for the page to name and `www/files.js` to know.
    pub fn log_endings() -> String {
        LogFormat::ENDINGS.join(", ")
    }

    /// Files that may be a flight by themselves, in words, for the page to name.
    pub fn flown_files() -> String {
        flown_in_words()
    }

    /// Names of the formats of routes and landmarks, for the page to name.
    pub fn exchange_names() -> String {
        let names: Vec<&str> = Format::all().map(Format::name).collect();
        names.join(", ")
    }

    /// Tells, before the start, what the browser remembered under a key.
    pub fn remember(&self, key: String, bytes: &[u8]) {
        self.remembered.borrow_mut().insert(key, bytes.to_vec());
    }

    /// Starts the app on a canvas.
    pub async fn start(&self, canvas: HtmlCanvasElement, shell: Shell) -> Result<(), JsValue> {
        let remembered = Remembered {
            bytes: self.remembered.take(),
            files: self.remembered_files.take(),
        };
        Graphics::prepare(&canvas)?;
        let running = self.running.clone();
        let drawn_on = canvas.clone();
        let create: eframe::AppCreator<'static> = Box::new(move |creation| {
            let context = creation.egui_ctx.clone();
            context.add_plugin(KeptTree::default());
            if let Some(keeper) = Graphics::of(&drawn_on) {
                install(&context, keeper);
            }
            let host = PageHost::new(shell, context.clone(), remembered);
            *running.borrow_mut() = Some((context.clone(), host.clone()));
            Ok(Box::new(PageApp::new(&context, host)))
        });
        self.runner
            .start(canvas, eframe::WebOptions::default(), create)
            .await
    }

    /// Tells, before the start, which file the browser remembered under a key.
    pub fn remember_file(&self, key: String, file: &Blob) {
        self.remembered_files.borrow_mut().insert(key, lend(file));
    }

    /// Gives files to the app: paths and contents, one for one. A content is a byte array, or the
    /// file itself, to be read by pieces.
    pub fn open_files(&self, paths: &Array, contents: &Array) {
        let files = paths
            .iter()
            .zip(contents.iter())
            .map(|(path, content)| OpenedFile {
                path: path.as_string().unwrap_or_default(),
                content: match content.dyn_ref::<Uint8Array>() {
                    Some(bytes) => bytes.to_vec().into(),
                    None => lend(content.unchecked_ref()),
                },
            });
        if let Some((_, host)) = &*self.running.borrow() {
            host.open_files(files.collect());
        }
    }

    /// Has the app tell that something went wrong, such as a file that could not be read.
    pub fn tell_trouble(&self, title: String, text: String) {
        if let Some((_, host)) = &*self.running.borrow() {
            host.tell_trouble(title, text);
        }
    }

    /// Goes to a place in the app: a state of the browser's history.
    pub fn go_to(&self, place: String) {
        if let Some((_, host)) = &*self.running.borrow() {
            host.go_to(place);
        }
    }

    /// To be called twice a second: looks whether the workers are alive.
    pub fn tick(&self) {
        if let Some((_, host)) = &*self.running.borrow() {
            host.tick();
        }
    }

    /// The app's state as JSON; empty once it has panicked.
    pub fn state(&self) -> String {
        self.runner
            .app_mut::<PageApp>()
            .map(|page| page.app.state_json())
            .unwrap_or_default()
    }

    /// Stores what was edited last at once: a page that is about to be left draws no frame any more.
    pub fn store_now(&self) {
        if let Some(mut page) = self.runner.app_mut::<PageApp>() {
            page.store_now();
        }
    }

    /// The accessibility tree of the last frame as JSON; see [`WebHandle::enable_a11y`].
    pub fn a11y(&self) -> String {
        match &*self.running.borrow() {
            Some((context, _)) => tree_json(context),
            None => "[]".to_owned(),
        }
    }

    /// Begins to make the accessibility tree.
    pub fn enable_a11y(&self) {
        if let Some((context, _)) = &*self.running.borrow() {
            context.enable_accesskit();
            context.with_plugin(KeptTree::tell_again);
            context.request_repaint();
        }
    }

    /// Makes the accessibility tree no more.
    pub fn disable_a11y(&self) {
        if let Some((context, _)) = &*self.running.borrow() {
            context.disable_accesskit();
        }
    }

    /// The accessibility tree of the last frame for `www/mirror.js`, if it changed since the last call.
    pub fn changed_a11y(&self) -> String {
        let running = self.running.borrow();
        let lines = running.as_ref().and_then(|(context, _)| {
            let zoom = f64::from(context.zoom_factor());
            context.with_plugin(|tree: &mut KeptTree| tree.changed_lines(zoom))
        });
        lines.unwrap_or_default()
    }

    /// Asks an action of a node of the accessibility tree: `Click`, `Focus`, `Increment`, `Decrement`, or `SetValue`
    /// with a text or a number.
    pub fn act(&self, node: u64, action: &str, text: Option<String>, number: Option<f64>) {
        if let Some((context, _)) = &*self.running.borrow() {
            context.with_plugin(|tree: &mut KeptTree| tree.ask(node, action, text, number));
            context.request_repaint();
        }
    }

    /// Presses a key by its name in the browser, for a page whose canvas does not have the keyboard.
    pub fn press(&self, key: &str, shift: bool, command: bool) {
        if let Some((context, _)) = &*self.running.borrow() {
            context.with_plugin(|tree: &mut KeptTree| tree.press(key, shift, command));
            context.request_repaint();
        }
    }

    /// Message of the panic that the app died of, if it did.
    pub fn panic_message(&self) -> Option<String> {
        self.runner.panic_summary().map(|p| p.message())
    }

    /// Bytes of memory that the page's instance has taken.
    pub fn memory_bytes(&self) -> f64 {
        let memory: js_sys::WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
        memory
            .buffer()
            .unchecked_into::<js_sys::ArrayBuffer>()
            .byte_length()
            .into()
    }

    /// The app's own milliseconds per frame as JSON.
    pub fn cpu_ms(&self) -> String {
        self.runner
            .app_mut::<PageApp>()
            .map(|page| page.times.json())
            .unwrap_or_default()
    }

    /// Measures milliseconds per frame from now on.
    pub fn forget_cpu_ms(&self) {
        if let Some(mut page) = self.runner.app_mut::<PageApp>() {
            page.times.forget();
        }
    }

    /// Lets the flight go on, lap after lap, until its run has at least so many steps, to measure
    /// what long flights cost; returns how many it has then.
    pub fn repeat_laps(&self, least_steps: usize) -> usize {
        let mut app = self.runner.app_mut::<PageApp>();
        app.as_mut()
            .map_or(0, |page| page.app.repeat_laps(least_steps))
    }

    /// The navigator's milliseconds per camera frame as JSON.
    pub fn navigator_ms(&self) -> String {
        match &*self.running.borrow() {
            Some((_, host)) => host.navigator_json(),
            None => "null".to_owned(),
        }
    }

    /// Comparison of the stored first seconds with those that the workers compute, as JSON.
    pub fn first_seconds(&self) -> String {
        match &*self.running.borrow() {
            Some((_, host)) => host.first_seconds_json(),
            None => "null".to_owned(),
        }
    }

    /// Lets the flight that is being flown keep its place without working; for tests that need no more of it.
    pub fn rest_flight(&self) {
        if let Some((_, host)) = &*self.running.borrow() {
            host.rest_flight();
        }
    }

    /// Leaves undone what nobody asked for; for tests, whose machine has no time for it.
    pub fn leave_ahead(&self) {
        if let Some((_, host)) = &*self.running.borrow() {
            host.leave_ahead();
        }
    }

    /// Ends a worker without a word, as a browser short of memory does; for tests.
    pub fn kill_worker(&self, index: usize) {
        if let Some((_, host)) = &*self.running.borrow() {
            host.silence_worker(index);
        }
    }

    /// Makes a worker run into a fault; for tests.
    pub fn crash_worker(&self, index: usize) {
        if let Some((_, host)) = &*self.running.borrow() {
            host.crash_worker(index);
        }
    }
}
