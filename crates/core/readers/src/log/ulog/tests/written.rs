//! A `ULog` file written piece by piece.

use super::super::MAGIC;

/// A file so far.
#[derive(Clone)]
pub(super) struct Written(pub Vec<u8>);

impl Written {
    /// A header with the time of the start in microseconds.
    pub fn new(start: u64) -> Self {
        let mut bytes = MAGIC.to_vec();
        bytes.push(1);
        bytes.extend(start.to_le_bytes());
        Self(bytes)
    }

    /// Any message.
    pub fn message(mut self, kind: u8, parts: &[&[u8]]) -> Self {
        let bytes = parts.concat();
        let length = u16::try_from(bytes.len()).unwrap();
        self.0.extend(length.to_le_bytes());
        self.0.push(kind);
        self.0.extend(bytes);
        self
    }

    pub fn definition(self, text: &str) -> Self {
        self.message(b'F', &[text.as_bytes()])
    }

    pub fn announce(self, number: u16, instance: u8, name: &str) -> Self {
        self.message(b'A', &[&[instance], &number.to_le_bytes(), name.as_bytes()])
    }

    pub fn row(self, number: u16, fields: &[&[u8]]) -> Self {
        self.message(b'D', &[&number.to_le_bytes(), &fields.concat()])
    }

    /// Any message with a value after its type and name.
    pub fn keyed(self, kind: u8, before: &[u8], key: &str, value: &[u8]) -> Self {
        let length = [u8::try_from(key.len()).unwrap()];
        self.message(kind, &[before, &length, key.as_bytes(), value])
    }

    pub fn words(self, severity: u8, microseconds: u64, text: &str) -> Self {
        let time = microseconds.to_le_bytes();
        self.message(b'L', &[&[b'0' + severity], &time, text.as_bytes()])
    }

    pub fn sync(self) -> Self {
        self.message(b'S', &[&[0x2f, 0x73, 0x13, 0x20, 0x25, 0x0c, 0xbb, 0x12]])
    }

    /// `count` rows of a topic with time, two numbers, and `nav_state`, a tenth of a second apart.
    pub fn flight(count: u64) -> Self {
        let mut file = Self::new(1_000_000)
            .definition("pair:float a;int16_t b;")
            .definition("vehicle_status:uint64_t timestamp;pair[2] p;uint8_t nav_state;uint8_t[3] _padding0;")
            .keyed(b'I', &[], "char[3] sys_name", b"PX4")
            .keyed(b'P', &[], "float FW_AIRSPD_TRIM", &15.0_f32.to_le_bytes())
            .announce(3, 0, "vehicle_status");
        for index in 0..count {
            let time = 1_000_000 + 100_000 * index;
            let a = (index as f32).to_le_bytes();
            let state = [if index < count / 2 { 3 } else { 5 }];
            file = file.row(3, &[&time.to_le_bytes(), &a, &[1, 0], &a, &[2, 0], &state]);
            if index % 10 == 9 {
                file = file.sync().words(6, time, "all is well");
            }
        }
        file
    }
}
