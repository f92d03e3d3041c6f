//! The page's end of the line to one worker.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use js_sys::Uint8Array;
use pilotage_jobs::{Program, Request, WorkerPort};
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, MessageEvent, Worker, WorkerOptions, WorkerType};

use crate::browser::{request_lock, send_program};
use crate::message::encode;

/// Notice that came from the worker on a seat.
pub enum Notice {
    /// An encoded reply.
    Said(usize, Vec<u8>),
    /// It is no more.
    Died(usize),
}

/// Notices in the order in which they came, and how to wake the page for them.
#[derive(Clone)]
pub struct Inbox {
    /// Not yet read.
    pub notices: Rc<RefCell<std::collections::VecDeque<Notice>>>,
    /// To repaint when something comes.
    pub context: egui::Context,
}

impl Inbox {
    fn put(&self, notice: Notice) {
        self.notices.borrow_mut().push_back(notice);
        self.context.request_repaint();
    }
}

/// A running worker; ended when dropped.
///
/// Its end is noticed even when nothing says so: the worker holds a lock for as long as it lives,
/// and the page waits for that lock.
pub struct BrowserPort {
    worker: Option<Worker>,
    seat: usize,
    inbox: Inbox,
    /// Set when the page itself ends the worker: what comes after is of no interest.
    closed: Rc<Cell<bool>>,
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(ErrorEvent)>,
}

impl BrowserPort {
    /// Starts a worker; the page's JavaScript sends it its program, and it keeps what it hears until then.
    pub fn open(seat: usize, program: Program, inbox: Inbox) -> Self {
        let closed = Rc::new(Cell::new(false));
        let died = {
            let (inbox, closed) = (inbox.clone(), closed.clone());
            move || {
                if !closed.replace(true) {
                    inbox.put(Notice::Died(seat));
                }
            }
        };
        let lock = format!("pilotage worker {:.17}", js_sys::Math::random());
        let on_message = Closure::<dyn FnMut(MessageEvent)>::new({
            let (inbox, lock, died) = (inbox.clone(), lock.clone(), died.clone());
            move |event: MessageEvent| {
                if let Some(bytes) = event.data().dyn_ref::<Uint8Array>() {
                    inbox.put(Notice::Said(seat, bytes.to_vec()));
                } else {
                    // The worker has its lock. Without locks, the page's timer has to notice.
                    let _ = request_lock(&lock, &Closure::once_into_js(died.clone()));
                }
            }
        });
        let on_error = Closure::<dyn FnMut(ErrorEvent)>::new({
            let died = died.clone();
            move |event: ErrorEvent| {
                event.prevent_default();
                // A script that cannot be loaded comes as an event without a message.
                let message = js_sys::Reflect::get(&event, &"message".into()).unwrap_or_default();
                web_sys::console::warn_2(&"worker stopped:".into(), &message);
                died();
            }
        });
        let worker = start_worker(program, &lock, &on_message, &on_error)
            .inspect_err(|_| died())
            .ok();
        Self {
            worker,
            seat,
            inbox,
            closed,
            _on_message: on_message,
            _on_error: on_error,
        }
    }

    /// Ends the worker without a word, as a browser short of memory does; for tests.
    pub fn silence(&self) {
        if let Some(worker) = &self.worker {
            worker.terminate();
        }
    }

    /// Makes the worker run into a fault; for tests.
    pub fn crash(&self) {
        if let Some(worker) = &self.worker {
            let _ = worker.post_message(&"crash".into());
        }
    }
}

fn start_worker(
    program: Program,
    lock: &str,
    on_message: &Closure<dyn FnMut(MessageEvent)>,
    on_error: &Closure<dyn FnMut(ErrorEvent)>,
) -> Result<Worker, JsValue> {
    let options = WorkerOptions::new();
    options.set_type(WorkerType::Module);
    let worker = Worker::new_with_options(&format!("./worker-{}.js", program.name()), &options)?;
    worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
    worker.set_onmessageerror(Some(on_error.as_ref().unchecked_ref()));
    send_program(&worker, program.name(), lock)?;
    Ok(worker)
}

impl WorkerPort for BrowserPort {
    fn send(&mut self, request: &Request) {
        let Some(worker) = &self.worker else { return };
        let sent = encode(request)
            .map_err(JsValue::from)
            .and_then(|message| worker.post_message(&message));
        if sent.is_err() {
            self.inbox.put(Notice::Died(self.seat));
        }
    }

    fn close(&mut self) {
        self.closed.set(true);
        if let Some(worker) = &self.worker {
            worker.set_onmessage(None);
            worker.set_onerror(None);
            worker.set_onmessageerror(None);
            worker.terminate();
        }
    }
}

impl Drop for BrowserPort {
    fn drop(&mut self) {
        self.close();
    }
}
