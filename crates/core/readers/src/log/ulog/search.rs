//! The way back after damage.

use super::belief::{MessageTrust, belief};
use super::definition::Definitions;
use super::header::{HEADER, MAGIC};
use super::message::{FRAME, frame, parse};
use super::rows::{RowFit, Subscriptions};

/// Number of `bytes` before the next message that holds together so well that it is no accident, and whether
/// there is one. Where more bytes are needed to tell, the count ends there; where `over`, no more will come.
pub(super) fn next_sure(
    definitions: &Definitions,
    subscriptions: &Subscriptions,
    bytes: &[u8],
    over: bool,
) -> (usize, bool) {
    for place in 0..bytes.len() {
        match is_sure(definitions, subscriptions, &bytes[place..]) {
            Some(true) => return (place, true),
            None if !over => return (place, false),
            Some(false) | None => {}
        }
    }
    (bytes.len(), false)
}

/// Whether a message begins here that is no accident; `None` if that takes more bytes.
fn is_sure(definitions: &Definitions, subscriptions: &Subscriptions, bytes: &[u8]) -> Option<bool> {
    if bytes.starts_with(&MAGIC) {
        return (bytes.len() >= HEADER).then_some(true);
    }
    if MAGIC.starts_with(bytes) {
        return None;
    }
    let (length, kind) = frame(bytes)?;
    // Of these kinds alone the bytes themselves say enough.
    if !b"DSFIMPQALC".contains(&kind) {
        return Some(false);
    }
    if kind == b'D' {
        let number = bytes.get(FRAME..FRAME + 2)?;
        let number = u16::from_le_bytes(number.try_into().ok()?);
        let row = length.checked_sub(2);
        if row.map(|row| subscriptions.fit(number, row)) != Some(RowFit::Yes) {
            return Some(false);
        }
    }
    let message = parse(kind, bytes.get(FRAME..FRAME + length)?);
    Some(message.is_ok_and(|message| {
        belief(definitions, subscriptions, &message) == Ok(MessageTrust::Sure)
    }))
}
