//! Words that come in pieces of fifty letters.

use std::collections::HashMap;

use super::super::{Log, LogMessage};
use super::row::{PayloadRow, Sender};

/// Text in place of pieces that never came.
const MISSING: &str = " … ";

/// A text of which more pieces may come.
struct Open {
    /// Number of the text.
    number: u16,
    /// Number of the next piece.
    next: u8,
    /// Its place among the log's messages.
    place: usize,
}

/// The words that were said.
#[derive(Default)]
pub(super) struct SpokenTexts {
    open: HashMap<(u8, u8), Open>,
}

impl SpokenTexts {
    /// Takes a piece; returns the text so far.
    pub fn take(&mut self, sender: Sender, time: f64, row: &PayloadRow, log: &mut Log) -> String {
        let own = (sender.system, sender.component);
        let number = row.integer("id") as u16;
        let piece = row.integer("chunk_seq") as u8;
        let text = row.text("text");
        if let Some(open) = self.open.get_mut(&own)
            && number != 0
            && open.number == number
            && piece >= open.next
            && let Some(message) = log.messages.get_mut(open.place)
        {
            if piece > open.next {
                message.text.push_str(MISSING);
            }
            message.text.push_str(&text);
            open.next = piece.saturating_add(1);
            return message.text.clone();
        }
        let open = Open {
            number,
            next: piece.saturating_add(1),
            place: log.messages.len(),
        };
        self.open.insert(own, open);
        let text = if piece == 0 {
            text
        } else {
            format!("{MISSING}{text}")
        };
        log.messages.push(LogMessage {
            time,
            source: Some(sender.instance),
            severity: u8::try_from(row.integer("severity"))
                .ok()
                .filter(|s| *s < 8),
            text: text.clone(),
        });
        text
    }
}
