//! A file of stamped messages written one by one.

use super::super::checksum::Checksum;
use super::super::dialect::Dialect;

/// Second zero of the files, microseconds since 1970.
pub(super) const START: u64 = 1_700_000_000_000_000;

/// A file so far.
#[derive(Clone, Default)]
pub(super) struct Written {
    pub bytes: Vec<u8>,
    /// System and component that send.
    pub sender: (u8, u8),
}

impl Written {
    pub fn new() -> Self {
        Self {
            bytes: Vec::new(),
            sender: (1, 1),
        }
    }

    pub fn from(mut self, system: u8, component: u8) -> Self {
        self.sender = (system, component);
        self
    }

    fn frame(mut self, microseconds: u64, header: &[u8], number: u32, payload: &[u8]) -> Self {
        let seed = Dialect::default()
            .get(number)
            .map_or(0, |definition| definition.seed);
        let mut checksum = Checksum::default();
        checksum.add(&header[1..]);
        checksum.add(payload);
        checksum.add(&[seed]);
        self.bytes.extend((START + microseconds).to_be_bytes());
        self.bytes.extend(header);
        self.bytes.extend(payload);
        self.bytes.extend(checksum.bytes());
        self
    }

    /// A message of version 1.
    pub fn version_1(self, microseconds: u64, number: u8, parts: &[&[u8]]) -> Self {
        let payload = parts.concat();
        let length = u8::try_from(payload.len()).unwrap();
        let header = [0xfe, length, 0, self.sender.0, self.sender.1, number];
        self.frame(microseconds, &header, u32::from(number), &payload)
    }

    /// A message of version 2, zeros at its end left out.
    pub fn version_2(self, microseconds: u64, number: u32, parts: &[&[u8]]) -> Self {
        let header = self.header_2(number, parts, 0);
        self.frame(microseconds, &header, number, &trimmed(parts))
    }

    /// A message of version 2 with a signature.
    pub fn signed(self, microseconds: u64, number: u32, parts: &[&[u8]]) -> Self {
        let header = self.header_2(number, parts, 1);
        let mut file = self.frame(microseconds, &header, number, &trimmed(parts));
        file.bytes.extend([0x5a; 13]);
        file
    }

    fn header_2(&self, number: u32, parts: &[&[u8]], flags: u8) -> Vec<u8> {
        let length = u8::try_from(trimmed(parts).len()).unwrap();
        let [a, b, c, _] = number.to_le_bytes();
        vec![
            0xfd,
            length,
            flags,
            0,
            0,
            self.sender.0,
            self.sender.1,
            a,
            b,
            c,
        ]
    }

    /// A heartbeat: `MAV_TYPE`, `MAV_AUTOPILOT`, mode.
    pub fn heartbeat(self, microseconds: u64, kind: u8, autopilot: u8, mode: u32) -> Self {
        self.version_1(
            microseconds,
            0,
            &[&mode.to_le_bytes(), &[kind, autopilot, 1, 4, 3]],
        )
    }

    /// A parameter: its four bytes and `MAV_PARAM_TYPE`.
    pub fn parameter(self, microseconds: u64, name: &str, bytes: [u8; 4], kind: u8) -> Self {
        let mut letters = [0; 16];
        letters[..name.len()].copy_from_slice(name.as_bytes());
        self.version_1(
            microseconds,
            22,
            &[&bytes, &[1, 0, 0, 0], &letters, &[kind]],
        )
    }

    /// Words, or a piece of them.
    pub fn words(
        self,
        microseconds: u64,
        severity: u8,
        text: &str,
        number: u16,
        piece: u8,
    ) -> Self {
        let mut letters = [0; 50];
        letters[..text.len()].copy_from_slice(text.as_bytes());
        self.version_2(
            microseconds,
            253,
            &[&[severity], &letters, &number.to_le_bytes(), &[piece]],
        )
    }

    /// `count` attitudes a tenth of a second apart, with a heartbeat every second.
    pub fn flight(count: u32) -> Self {
        let mut file = Self::new();
        for index in 0..count {
            let time = u64::from(index) * 100_000;
            if index % 10 == 0 {
                file = file.heartbeat(time, 1, 3, 10 + index / 20);
            }
            let angle = (index as f32 * 0.01).to_le_bytes();
            let fields: [&[u8]; 7] = [
                &(100 * index).to_le_bytes(),
                &angle,
                &angle,
                &angle,
                &[0; 4],
                &[0; 4],
                &[0; 4],
            ];
            file = match index % 3 {
                0 => file.version_1(time, 30, &fields),
                1 => file.version_2(time, 30, &fields),
                _ => file.signed(time, 30, &fields),
            };
        }
        file
    }
}

fn trimmed(parts: &[&[u8]]) -> Vec<u8> {
    let mut payload = parts.concat();
    while payload.len() > 1 && payload.last() == Some(&0) {
        payload.pop();
    }
    payload
}
