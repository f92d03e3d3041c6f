//! The checksum of messages.

/// The checksum of `MAVLink`: X.25 as CRC-16/MCRF4XX has it.
pub(super) struct Checksum(u16);

impl Default for Checksum {
    fn default() -> Self {
        Self(0xffff)
    }
}

impl Checksum {
    /// Counts in some bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            let mixed = byte ^ self.0.to_le_bytes()[0];
            let mixed = u16::from(mixed ^ mixed << 4);
            self.0 = self.0 >> 8 ^ mixed << 8 ^ mixed << 3 ^ mixed >> 4;
        }
    }

    /// The checksum so far, its lower byte first.
    pub fn bytes(&self) -> [u8; 2] {
        self.0.to_le_bytes()
    }
}
