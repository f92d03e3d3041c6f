//! `MAVLink` messages with times, made here.

/// Second zero, microseconds since 1970.
const START: u64 = 1_700_000_000_000_000;
/// Number of a message, what its checksum counts besides its bytes, and bytes of its payload: heartbeat, parameter,
/// attitude, position, mission item, air data, text.
const KINDS: [(u8, u8, usize); 7] = [
    (0, 50, 9),
    (22, 220, 25),
    (30, 39, 28),
    (33, 104, 28),
    (73, 38, 37),
    (74, 20, 20),
    (253, 83, 51),
];

/// A file of `count` messages of version 1 or 2, of every kind in turn.
pub fn file(version: u8, count: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    for number in 0..count {
        let (kind, seed, length) = KINDS[number as usize % KINDS.len()];
        let payload = payload(kind, length, number);
        let time = START + 100_000 * u64::from(number);
        let sequence = number.to_le_bytes()[0];
        bytes.extend(message(
            version,
            (1, sequence),
            time,
            (kind, seed),
            &payload,
        ));
    }
    bytes
}

/// A file in which two systems say that they fly, and five times a second where they are: both go north, `7` along 8° E
/// and `9` along 9° E.
pub fn of_systems_7_and_9(seconds: u32) -> Vec<u8> {
    const HEARTBEAT: (u8, u8) = (0, 50);
    const GLOBAL_POSITION_INT: (u8, u8) = (33, 104);
    // An airplane by ArduPilot, armed and active.
    let beat = [10, 0, 0, 0, 1, 3, 217, 4, 3];
    let mut bytes = Vec::new();
    for number in 0..5 * seconds {
        let boot_ms = 200 * number;
        let time = START + 1000 * u64::from(boot_ms);
        for (system, longitude) in [(7, 8_i32), (9, 9)] {
            let latitude = 470_000_000 + 500 * number as i32;
            let heights = [500_000_i32, 100_000];
            let words = [latitude, longitude * 10_000_000]
                .into_iter()
                .chain(heights);
            let speeds = [2500_i16, 0, 0, 0].map(i16::to_le_bytes);
            let place: Vec<u8> = (boot_ms.to_le_bytes().into_iter())
                .chain(words.flat_map(i32::to_le_bytes))
                .chain(speeds.into_iter().flatten())
                .collect();
            let from = (system, number.to_le_bytes()[0]);
            if number % 5 == 0 {
                bytes.extend(message(2, from, time, HEARTBEAT, &beat));
            }
            bytes.extend(message(2, from, time, GLOBAL_POSITION_INT, &place));
        }
    }
    bytes
}

/// A message of a system behind the time, microseconds, at which it was received; `kind` with what its checksum counts
/// besides its bytes.
fn message(
    version: u8,
    (system, sequence): (u8, u8),
    time: u64,
    (kind, seed): (u8, u8),
    payload: &[u8],
) -> Vec<u8> {
    let length = payload.len().to_le_bytes()[0];
    let header = if version == 1 {
        vec![0xfe, length, sequence, system, 1, kind]
    } else {
        vec![0xfd, length, 0, 0, sequence, system, 1, kind, 0, 0]
    };
    let mut bytes = time.to_be_bytes().to_vec();
    bytes.extend(&header);
    bytes.extend(payload);
    let counted = header[1..].iter().chain(payload).chain([&seed]);
    bytes.extend(checksum(counted).to_le_bytes());
    bytes
}

/// Numbers that grow with the message's, or letters where it is text.
fn payload(kind: u8, length: usize, number: u32) -> Vec<u8> {
    if kind == 253 {
        let mut text = vec![6];
        text.extend(format!("Message number {number}").bytes());
        text.resize(length, 0);
        return text;
    }
    let time = (100 * number).to_le_bytes();
    let rest = (1..).flat_map(|i: u32| (0.01 * f64::from(i * number)).to_le_bytes());
    time.into_iter().chain(rest).take(length).collect()
}

/// X.25 as CRC-16/MCRF4XX has it.
fn checksum<'a>(bytes: impl Iterator<Item = &'a u8>) -> u16 {
    bytes.fold(0xffff, |sum: u16, byte| {
        let mixed = byte ^ sum.to_le_bytes()[0];
        let mixed = u16::from(mixed ^ (mixed << 4));
        (sum >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4)
    })
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::log::{HEAD, recognise};

    use super::*;
    use crate::logs::check::checked;

    #[test]
    fn every_message_of_both_versions_is_read() {
        for version in [1, 2] {
            let file = file(version, 70);
            let info = recognise(&file[..file.len().min(HEAD)]).expect("a log");
            let log = checked(info, &file, &[]).expect("nothing is wrong");
            assert!(log.report.is_clean(), "{:?}", log.report);
            assert_eq!(log.report.messages, 70);
        }
    }
}
