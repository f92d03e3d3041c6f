//! Chunks packed with Zstandard (RFC 8878).

use std::io::Read as _;

use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};

/// Largest window that is allowed for, bytes: nobody who writes logs asks for more.
const WINDOW: u64 = 16 << 20;

/// Unpacks a frame: at most a block more than `most` bytes, and whether that is all of it.
pub(super) fn unpack(packed: &[u8], most: u64) -> (Vec<u8>, bool) {
    match decode(packed, most) {
        Ok(unpacked) => (unpacked, true),
        Err(0) => (Vec::new(), false),
        // What was decoded stays behind in the decoder's window, unless the frame seems to end there.
        Err(blocks) => {
            let beginning = ended_after(packed, blocks);
            let unpacked = beginning.and_then(|beginning| decode(&beginning, most).ok());
            (unpacked.unwrap_or_default(), false)
        }
    }
}

/// The contents of a frame, or how many of its blocks are good.
fn decode(mut packed: &[u8], most: u64) -> Result<Vec<u8>, usize> {
    let mut decoder = FrameDecoder::new();
    decoder.set_max_window_size(WINDOW.max(most));
    if decoder.init(&mut packed).is_err() {
        return Err(0);
    }
    let mut unpacked = Vec::new();
    while !decoder.is_finished() {
        let one = BlockDecodingStrategy::UptoBlocks(1);
        if decoder.decode_blocks(&mut packed, one).is_err() {
            return Err(decoder.blocks_decoded());
        }
        let left = (most + 1).saturating_sub(unpacked.len() as u64);
        let read = (&mut decoder).take(left).read_to_end(&mut unpacked);
        if read.is_err() {
            return Err(0);
        }
        if unpacked.len() as u64 > most {
            return Ok(unpacked);
        }
    }
    Ok(unpacked)
}

/// The frame with its first `blocks` blocks only, the last of them marked as such; `None` if there are not so many.
fn ended_after(packed: &[u8], blocks: usize) -> Option<Vec<u8>> {
    let descriptor = *packed.get(4)?;
    let is_single = descriptor & 0x20 != 0;
    let dictionary = [0, 1, 2, 4][usize::from(descriptor & 3)];
    let size = [usize::from(is_single), 2, 4, 8][usize::from(descriptor >> 6)];
    let mut place = 5 + usize::from(!is_single) + dictionary + size;
    let mut last = None;
    for _ in 0..blocks {
        let head = packed.get(place..place + 3)?;
        let head = u32::from_le_bytes([head[0], head[1], head[2], 0]);
        last = Some(place);
        let is_repeated = head >> 1 & 3 == 1;
        place += 3 + if is_repeated { 1 } else { (head >> 3) as usize };
    }
    let mut frame = packed.get(..place)?.to_vec();
    frame[last?] |= 1;
    // A checksum of the whole would not fit.
    frame[4] &= !0x04;
    Some(frame)
}
