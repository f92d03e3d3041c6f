//! Trust in messages.

use super::definition::Definitions;
use super::message::Message;
use super::rows::{Fit, Subscriptions};

/// Trust in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Belief {
    /// It holds together so well that it is no accident.
    Sure,
    /// Only if another message follows right behind it.
    Likely,
}

/// Trust in a message, or the reason for none.
pub(super) fn belief(
    definitions: &Definitions,
    subscriptions: &Subscriptions,
    message: &Message,
) -> Result<Belief, &'static str> {
    let sure_if = |good| Ok(if good { Belief::Sure } else { Belief::Likely });
    match message {
        Message::Definition(_) | Message::Sync => Ok(Belief::Sure),
        Message::Fact(value) => sure_if(value.is_whole()),
        Message::Parameter(value) | Message::Default { value, .. } => {
            let is_parameter = value.parameter().is_some();
            is_parameter
                .then_some(Belief::Sure)
                .ok_or("a parameter that is no number")
        }
        Message::Subscribe { name, .. } => sure_if(definitions.has(name)),
        Message::Row { number, row } => match subscriptions.fit(*number, row.len()) {
            Fit::Yes => Ok(Belief::Sure),
            Fit::Unknown => Ok(Belief::Likely),
            Fit::No => Err("a row has not the length of its definition"),
        },
        Message::Words { text, .. } => {
            let is_clean = |text: &str| {
                !text
                    .chars()
                    .any(|c| c.is_control() && !"\t\n\r\x1b".contains(c))
            };
            sure_if(str::from_utf8(text).is_ok_and(is_clean))
        }
        Message::Flags { .. } | Message::Unsubscribe | Message::Dropout(_) | Message::Unknown => {
            Ok(Belief::Likely)
        }
    }
}
