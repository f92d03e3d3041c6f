//! Messages that say more than their row: heartbeats, versions, parameters, words.

use super::super::Log;
use super::parameters::Parameters;
use super::row::{PayloadRow, Sender};
use super::vehicle::Heartbeats;
use super::words::SpokenTexts;

/// State of the messages that say more than their row: heartbeats, parameters, words.
#[derive(Default)]
pub(super) struct SpecialMessages {
    heartbeats: Heartbeats,
    parameters: Parameters,
    words: SpokenTexts,
}

impl SpecialMessages {
    /// Takes a message by the number of its kind.
    pub fn take<'a>(
        &mut self,
        number: u32,
        sender: Sender,
        time: f64,
        row: impl Fn() -> PayloadRow<'a>,
        log: &mut Log,
    ) {
        match number {
            0 if self.heartbeats.beat(sender, time, &row(), log) => {
                let by_type = self.heartbeats.has_bytes_in_floats();
                let vehicle = (sender.system, sender.component);
                self.parameters.know(vehicle, by_type, log);
            }
            22 => self.parameters.take(sender, time, &row(), log),
            148 => self.heartbeats.version(sender, &row(), log),
            253 => {
                let text = self.words.take(sender, time, &row(), log);
                self.heartbeats.words(sender, &text, log);
            }
            _ => {}
        }
    }

    /// The log is over.
    pub fn end(&mut self, log: &mut Log) {
        self.parameters.end(log);
        log.tell_vehicles();
    }
}
