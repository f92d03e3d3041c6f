//! Recordings of satellite receivers, known by a message whose check sum is right, wherever they begin.

/// Messages of u-blox: two marks, class, number, length, contents, and two sums over all but the marks (u-blox interface
/// description, "UBX checksum").
pub(super) fn is_ubx(head: &[u8], _: u64) -> bool {
    has_message(head, [0xb5, 0x62], |rest| {
        let length = u16::from_le_bytes([*rest.get(2)?, *rest.get(3)?]);
        let end = 4 + usize::from(length);
        let (mut first, mut second) = (0_u8, 0_u8);
        for byte in rest.get(..end)? {
            first = first.wrapping_add(*byte);
            second = second.wrapping_add(first);
        }
        Some(rest.get(end..end + 2)? == [first, second])
    })
}

/// Messages of Swift Navigation: a mark, number and sender of two bytes each, length, contents, and the CCITT's sum of 16 bits
/// over all but the mark (SBP protocol, section 3).
pub(super) fn is_sbp(head: &[u8], _: u64) -> bool {
    has_message(head, [0x55], |rest| {
        let end = 5 + usize::from(*rest.get(4)?);
        let sum = rest.get(..end)?.iter().fold(0_u16, |sum, byte| {
            (0..8).fold(sum ^ (u16::from(*byte) << 8), |sum, _| {
                let more = if sum & 0x8000 == 0 { 0 } else { 0x1021 };
                (sum << 1) ^ more
            })
        });
        Some(rest.get(end..end + 2)? == sum.to_le_bytes())
    })
}

/// Whether a sound message begins with those bytes anywhere, `is_sound` judging what is behind them. Bytes before the first
/// are the rest of one that was cut.
fn has_message<const N: usize>(
    head: &[u8],
    mark: [u8; N],
    is_sound: impl Fn(&[u8]) -> Option<bool>,
) -> bool {
    // Texts have such letters anywhere.
    let is_binary = head.iter().any(|byte| *byte < 9);
    let begins = head
        .windows(N)
        .enumerate()
        .filter(|(_, part)| *part == mark);
    is_binary
        && begins
            .into_iter()
            .any(|(at, _)| is_sound(&head[at + N..]) == Some(true))
}

#[cfg(test)]
mod tests {
    use pilotage_base::bytes::MemoryBytes;

    use super::super::foreign_file;
    use super::*;

    #[test]
    fn a_recording_that_begins_within_a_message_is_known_by_the_next_one() {
        // UBX-ACK-ACK of CFG-PRT: the sums are those of u-blox's own documents.
        let acknowledged = [0xb5, 0x62, 5, 1, 2, 0, 6, 0, 0x0e, 0x37];
        let sound = [&[9, 0, 3][..], &acknowledged, &[4; 20]].concat();
        let what =
            |bytes: &[u8]| foreign_file(&MemoryBytes::new("a", bytes)).map_or("", |is| is.what);
        assert!(what(&sound).contains("u-blox"));
        let mut damaged = sound;
        damaged[12] ^= 1;
        assert_eq!(what(&damaged), "");
        // binascii.crc_hqx(bytes([2, 1, 0x12, 0x34, 3, 0, 5, 6]), 0) of Python.
        let swift = [
            &[0x55, 2, 1, 0x12, 0x34, 3, 0, 5, 6][..],
            &0x2704_u16.to_le_bytes(),
            &[0; 9],
        ]
        .concat();
        assert!(is_sbp(&swift, 20));
        assert!(what(&swift).contains("SBP"));
    }
}
