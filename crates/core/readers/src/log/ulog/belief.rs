//! Trust in messages.

use super::definition::Definitions;
use super::message::UlogMessage;
use super::rows::{RowFit, Subscriptions};

/// Trust in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MessageTrust {
    /// It holds together so well that it is no accident.
    Sure,
    /// Only if another message follows right behind it.
    Likely,
}

/// Trust in a message, or the reason for none.
pub(super) fn belief(
    definitions: &Definitions,
    subscriptions: &Subscriptions,
    message: &UlogMessage,
) -> Result<MessageTrust, &'static str> {
    let sure_if = |good| {
        Ok(if good {
            MessageTrust::Sure
        } else {
            MessageTrust::Likely
        })
    };
    match message {
        UlogMessage::Definition(_) | UlogMessage::Sync => Ok(MessageTrust::Sure),
        UlogMessage::Fact(value) => sure_if(value.is_whole()),
        UlogMessage::Parameter(value) | UlogMessage::Default { value, .. } => {
            let is_parameter = value.parameter().is_some();
            is_parameter
                .then_some(MessageTrust::Sure)
                .ok_or("a parameter that is no number")
        }
        UlogMessage::Subscribe { name, .. } => sure_if(definitions.has(name)),
        UlogMessage::Row { number, row } => match subscriptions.fit(*number, row.len()) {
            RowFit::Yes => Ok(MessageTrust::Sure),
            RowFit::Unknown => Ok(MessageTrust::Likely),
            RowFit::No => Err("a row has not the length of its definition"),
        },
        UlogMessage::Words { text, .. } => {
            let is_clean = |text: &str| {
                !text
                    .chars()
                    .any(|c| c.is_control() && !"\t\n\r\x1b".contains(c))
            };
            sure_if(str::from_utf8(text).is_ok_and(is_clean))
        }
        UlogMessage::Flags { .. }
        | UlogMessage::Unsubscribe
        | UlogMessage::Dropout(_)
        | UlogMessage::Unknown => Ok(MessageTrust::Likely),
    }
}
