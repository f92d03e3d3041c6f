//! Services that the shell (the page, or a test) gives the app.

use std::collections::BTreeSet;

use pilotage_jobs::{FileContent, Job, JobEvent, JobId};

use crate::job_owners::{JobOwner, JobOwners};

/// Key under which the page gives the fragment of its address to the app.
pub const LINK_KEY: &str = "link";
/// Key under which the page gives the name of the tour's stop that its address asks for.
pub const TOUR_KEY: &str = "tour";

/// A file that the user chose or dropped.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenedFile {
    /// Path within what was dropped, with `/`.
    pub path: String,
    /// Its bytes, or where to read them.
    pub content: FileContent,
}

/// State of a download of tiles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Download {
    /// Tiles that are there, or could not be had.
    pub done: u64,
    /// Tiles in all.
    pub all: u64,
    /// Tiles that could not be had.
    pub failed: u64,
    /// Whether it came to its end.
    pub over: bool,
    /// Whether that was because the browser has no room for more.
    pub is_full: bool,
}

impl Download {
    /// Tiles that are there.
    pub fn got(&self) -> u64 {
        self.done.saturating_sub(self.failed)
    }
}

/// The shell's services.
pub trait Host {
    /// Milliseconds of a clock that never goes back.
    fn now(&self) -> f64;

    /// Gives a job to a worker, on behalf of [`Host::start`]; events arrive by [`Host::events`].
    fn begin(&mut self, job: Job) -> JobId;

    /// Owners of the jobs that were started.
    fn owners(&mut self) -> &mut JobOwners;

    /// Starts a job, whose events go to its owner.
    fn start(&mut self, owner: JobOwner, job: Job) -> JobId {
        let id = self.begin(job);
        self.owners().own(id, owner);
        id
    }

    /// Asks a job to stop; its last event is `Cancelled`.
    fn cancel(&mut self, job: JobId);

    /// Stops a job for whose end its owner does not wait: nothing more of it goes there.
    fn leave(&mut self, job: JobId) {
        self.owners().leave(job);
        self.cancel(job);
    }

    /// Lets a job keep its place without working, or work on.
    fn hold(&mut self, job: JobId, is_held: bool);

    /// Lets go of all files given to workers but those under the keys `in_use`, and of what was made of
    /// what was open before.
    fn let_go(&mut self, _in_use: &BTreeSet<String>) {}

    /// Takes the events that have arrived, in order.
    fn events(&mut self) -> Vec<(JobId, JobEvent)>;

    /// Files dropped or chosen since the last call.
    fn opened(&mut self) -> Vec<Vec<OpenedFile>>;

    /// Shows the dialog that opens files; they arrive by [`Host::opened`].
    fn ask_for_files(&mut self);

    /// Offers bytes to the user as a file.
    fn save_file(&mut self, name: &str, bytes: &[u8]);

    /// Offers an SVG drawing to the user as a PNG picture of so many pixels across and down.
    fn save_picture(&mut self, _name: &str, _svg: &str, _size: [u32; 2]) {}

    /// Offers a picture of so many pixels across and down to the user as a PNG file; four bytes for each pixel, row by
    /// row from the top: red, green, blue, opacity.
    fn save_pixels(&mut self, _name: &str, _size: [u32; 2], _pixels: &[u8]) {}

    /// Begins a film of what is drawn; the ending of its file's name, empty where films cannot be made.
    fn start_film(&mut self) -> String {
        String::new()
    }

    /// Ends the film that is being made and offers it to the user as a file.
    fn stop_film(&mut self, _name: &str) {}

    /// Remembers bytes under a key in the browser's own storage.
    fn store(&mut self, key: &str, bytes: &[u8]);

    /// Bytes remembered under a key, if loaded before the app started. To be asked once: the host
    /// need not hold them any longer.
    fn recall(&self, key: &str) -> Option<Vec<u8>>;

    /// Remembers a lent file under a key in the browser's own storage.
    fn store_lent(&mut self, _key: &str, _number: u32) {}

    /// The lent file remembered under a key, if loaded before the app started.
    fn recall_lent(&self, _key: &str) -> Option<FileContent> {
        None
    }

    /// Throws away what was stored under a key.
    fn forget(&mut self, _key: &str) {}

    /// Fetches tiles into the browser's cache; those that are there are passed over.
    fn download(&mut self, _addresses: Vec<String>) {}

    /// Progress of the download, if it was ever begun.
    fn download_state(&mut self) -> Option<Download> {
        None
    }

    /// Ends it; what has come stays.
    fn stop_download(&mut self) {}

    /// Fetches a file that the page has beside its program; it arrives by [`Host::fetched`].
    fn fetch(&mut self, _file: &str) {}

    /// Bytes of a fetched file, once they are there, empty if it cannot be had. To be asked once.
    fn fetched(&mut self, _file: &str) -> Option<Vec<u8>> {
        None
    }

    /// Troubles of the shell since the last call, each by title and text: files that could not be read, or not be made.
    fn troubles(&mut self) -> Vec<(String, String)> {
        Vec::new()
    }

    /// Keys of what the browser refused to store since the last call, for lack of room.
    fn failed_stores(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// Keys whose save in an earlier visit was found to have broken off, since the last call.
    fn interrupted_saves(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// Lets the user print a page: style sheet and body, as HTML.
    fn print(&mut self, _style: &str, _body: &str) {}

    /// Puts a link to this page with that fragment into the clipboard, or shows it where that is refused.
    fn copy_link(&mut self, _fragment: &str) {}

    /// Fate of the link once it is known: whether the clipboard took it. To be asked until then.
    fn link_copied(&mut self) -> Option<bool> {
        Some(true)
    }

    /// Server that the page comes from, such as `https://example.org`.
    fn own_server(&self) -> String {
        String::new()
    }

    /// Whether people have the rest of their screen light.
    fn prefers_light(&self) -> bool {
        false
    }

    /// Whether people want nothing on the screen to move by itself but what they play.
    fn prefers_stillness(&self) -> bool {
        false
    }

    /// Whether what people point with is their fingers first of all.
    fn is_touched_first(&self) -> bool {
        false
    }

    /// Whether the workers have time for what nobody asked for.
    fn works_ahead(&self) -> bool {
        true
    }

    /// Hears where in the app people are, once a frame; the place to which the browser's Back or Forward asks to go since
    /// the last call, if it does.
    fn follow(&mut self, _place: &str) -> Option<String> {
        None
    }

    /// Times a worker died and was started anew since the last call.
    fn lost_workers(&mut self) -> usize {
        0
    }

    /// A short text of what is on screen, for screen readers.
    fn announce(&mut self, _text: &str) {}
}

/// A name as it can stand in a file's name.
pub fn stem(name: &str) -> String {
    let allowed = |c: char| {
        if c.is_alphanumeric() || c == '-' {
            c
        } else {
            '-'
        }
    };
    let stem: String = name.chars().map(allowed).collect();
    if stem.is_empty() {
        "pilotage".to_owned()
    } else {
        stem
    }
}
