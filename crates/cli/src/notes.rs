//! Sentences on what was assumed of files or left out.

use std::sync::Arc;

use pilotage_core::imagery::Imagery;

use crate::maps::MapOnDisk;

/// Tells them to whoever sits at the terminal, beside what the command prints.
pub fn tell(notes: &[String]) {
    for note in notes {
        eprintln!("note: {note}");
    }
}

/// The map, once its notes are told.
pub fn told(opened: MapOnDisk) -> Arc<dyn Imagery> {
    tell(&opened.notes);
    opened.map
}
