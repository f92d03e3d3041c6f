//! Frame of one message with the time at which it came.

use super::checksum::Checksum;
use super::dialect::Dialect;

/// Bytes of the time before a frame.
pub(super) const STAMP: usize = 8;
const VERSION_1: u8 = 0xfe;
const VERSION_2: u8 = 0xfd;
/// The only flag of version 2 that changes a frame: a signature follows.
const SIGNED: u8 = 1;
const SIGNATURE: usize = 13;
/// A century of microseconds: times after 2070 are none.
const LATEST: u64 = 100 * 31_556_952 * 1_000_000;

/// A message with its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MavlinkFrame<'a> {
    /// Microseconds since 1970.
    pub time: u64,
    /// System that sent it.
    pub system: u8,
    /// Component of that system.
    pub component: u8,
    /// Number of its kind.
    pub number: u32,
    /// Payload; zeros at the end may be left out.
    pub payload: &'a [u8],
    /// Bytes that the checksum counts, and the checksum.
    counted: &'a [u8],
    checksum: [u8; 2],
    /// Bytes with time and signature.
    pub length: usize,
}

/// Why there is no frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoFrame {
    /// It takes more bytes to tell.
    Short,
    /// None begins here.
    None,
}

impl<'a> MavlinkFrame<'a> {
    /// The frame that begins here, its checksum not looked at.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, NoFrame> {
        // Most places are none, which their first byte says.
        if bytes.first().is_some_and(|first| *first != 0) {
            return Err(NoFrame::None);
        }
        let marker = *bytes.get(STAMP).ok_or(NoFrame::Short)?;
        let header = match marker {
            VERSION_1 => 6,
            VERSION_2 => 10,
            _ => return Err(NoFrame::None),
        };
        let time = bytes.first_chunk().ok_or(NoFrame::Short)?;
        let time = u64::from_be_bytes(*time);
        if time > LATEST {
            return Err(NoFrame::None);
        }
        let head = bytes.get(STAMP..STAMP + header).ok_or(NoFrame::Short)?;
        let (system, component, number, signature) = if marker == VERSION_1 {
            (head[3], head[4], u32::from(head[5]), 0)
        } else {
            let signature = match head[2] {
                0 => 0,
                SIGNED => SIGNATURE,
                _ => return Err(NoFrame::None),
            };
            let number = u32::from_le_bytes([head[7], head[8], head[9], 0]);
            (head[5], head[6], number, signature)
        };
        let start = STAMP + header;
        let end = start + usize::from(head[1]);
        let length = end + 2 + signature;
        let whole = bytes.get(..length).ok_or(NoFrame::Short)?;
        Ok(Self {
            time,
            system,
            component,
            number,
            payload: &whole[start..end],
            counted: &whole[STAMP + 1..end],
            checksum: [whole[end], whole[end + 1]],
            length,
        })
    }

    /// Whether the checksum is right, which begins from `seed` after the bytes.
    pub fn is_sound(&self, seed: u8) -> bool {
        let mut checksum = Checksum::default();
        checksum.add(self.counted);
        checksum.add(&[seed]);
        checksum.bytes() == self.checksum
    }
}

/// Bytes at the beginning of a file that may be damaged: two messages or so.
const DAMAGED: usize = 600;

/// Whether a frame may begin with these bytes, or with those that follow if they are too few to tell. More
/// than its time and marker is not looked at.
pub(super) fn may_begin(bytes: &[u8]) -> bool {
    let bytes = &bytes[..bytes.len().min(STAMP + 1)];
    MavlinkFrame::parse(bytes) != Err(NoFrame::None)
}

/// Whether a file that begins so is of this format: its first message is sound, or (where it is of a kind
/// that is not known) a second one begins right behind it. Where the beginning is damaged, a sound message among its first
/// bytes says it, too.
pub(super) fn begins(head: &[u8]) -> bool {
    let mut dialect = Dialect::default();
    // Nothing is known of kinds that no dialect has.
    let mut is_sound = |frame: &MavlinkFrame| {
        let definition = dialect.get(frame.number)?;
        Some(frame.is_sound(definition.seed))
    };
    if let Ok(frame) = MavlinkFrame::parse(head) {
        let behind = &head[frame.length..];
        let is_followed = behind.len() > STAMP && may_begin(behind);
        if is_sound(&frame).unwrap_or(is_followed) {
            return true;
        }
    }
    // Messages without times begin with their marker: what stands before the next one is no time.
    if matches!(head, [0xfd | 0xfe, ..]) {
        return false;
    }
    let mut places = 1..head.len().min(DAMAGED);
    places.any(|at| {
        MavlinkFrame::parse(&head[at..]).is_ok_and(|frame| is_sound(&frame) == Some(true))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_that_of_the_catalogue() {
        let mut checksum = Checksum::default();
        checksum.add(b"123456789");
        assert_eq!(checksum.bytes(), 0x6f91_u16.to_le_bytes());
    }

    #[test]
    fn a_frame_is_told_by_its_marker_behind_a_time() {
        let heartbeat = [
            0, 5, 0x9b, 0, 0, 0, 0, 1, 0xfe, 9, 7, 1, 2, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 0,
        ];
        let frame = MavlinkFrame::parse(&heartbeat).unwrap();
        assert_eq!((frame.system, frame.component, frame.number), (1, 2, 0));
        assert_eq!(frame.payload, [1, 2, 3, 4, 5, 6, 7, 8, 9]);
        assert_eq!(frame.length, heartbeat.len());
        assert!(!frame.is_sound(50));
        for end in 0..heartbeat.len() {
            assert_eq!(MavlinkFrame::parse(&heartbeat[..end]), Err(NoFrame::Short));
        }
        let mut other = heartbeat;
        other[8] = 0x55;
        assert_eq!(MavlinkFrame::parse(&other), Err(NoFrame::None));
        other = heartbeat;
        other[1] = 0x1f;
        assert_eq!(MavlinkFrame::parse(&other), Err(NoFrame::None));
    }
}
