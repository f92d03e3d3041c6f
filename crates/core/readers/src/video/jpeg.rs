//! End of a JPEG.

/// End of a picture, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Behind so many bytes.
    At(usize),
    /// More bytes are needed.
    Later,
    /// It is broken: the next may begin at this byte or later.
    Broken(usize),
}

/// Looks for the end of a JPEG; remembers how far it looked, so that no byte is looked at twice.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scan {
    at: usize,
    is_in_data: bool,
}

impl Scan {
    /// The end of the picture that begins at the first of `bytes`, of which there may be more than last time.
    pub fn end(&mut self, bytes: &[u8]) -> End {
        if self.at == 0 {
            if bytes.len() < 2 {
                return End::Later;
            }
            if !bytes.starts_with(&[0xff, 0xd8]) {
                return End::Broken(1);
            }
            self.at = 2;
        }
        loop {
            if self.is_in_data && !self.skip_data(bytes) {
                return End::Later;
            }
            let Some([mark, kind]) = bytes
                .get(self.at..self.at + 2)
                .and_then(|b| b.first_chunk())
                .copied()
            else {
                return End::Later;
            };
            match (mark, kind) {
                (0xff, 0xff) => self.at += 1,
                (0xff, 0xd9) => return End::At(self.at + 2),
                // Another picture begins before this one ended.
                (0xff, 0xd8) => return End::Broken(self.at),
                (0xff, 0x01 | 0xd0..=0xd7) => self.at += 2,
                (0xff, 0x02..=0xff) => {
                    let Some(length) = bytes.get(self.at + 2..self.at + 4) else {
                        return End::Later;
                    };
                    let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
                    if length < 2 {
                        return End::Broken(2);
                    }
                    self.at += 2 + length;
                    self.is_in_data = kind == 0xda;
                }
                _ => return End::Broken(2),
            }
        }
    }

    /// Goes on to the next marker within the data of a scan; whether there is one.
    fn skip_data(&mut self, bytes: &[u8]) -> bool {
        while let Some(rest) = bytes.get(self.at..) {
            let Some(mark) = rest.iter().position(|b| *b == 0xff) else {
                self.at = bytes.len();
                return false;
            };
            self.at += mark;
            match rest.get(mark + 1) {
                None => return false,
                // A stuffed zero, or a mark to begin again at.
                Some(0x00 | 0xd0..=0xd7) => self.at += 2,
                Some(_) => {
                    self.is_in_data = false;
                    return true;
                }
            }
        }
        false
    }
}

/// Width and height of a JPEG, where its head says them.
pub(super) fn size(jpeg: &[u8]) -> Option<(usize, usize)> {
    let mut at = 2;
    while let Some([0xff, kind]) = jpeg.get(at..at + 2).and_then(|b| b.first_chunk()).copied() {
        if kind == 0xff {
            at += 1;
            continue;
        }
        let length = jpeg.get(at + 2..at + 4)?;
        let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
        if matches!(kind, 0xc0..=0xc3 | 0xc5..=0xc7 | 0xc9..=0xcb | 0xcd..=0xcf) {
            let number = |at: usize| {
                let bytes = jpeg.get(at..at + 2)?;
                Some(usize::from(u16::from_be_bytes([bytes[0], bytes[1]])))
            };
            return number(at + 7)
                .zip(number(at + 5))
                .filter(|(w, h)| *w > 0 && *h > 0);
        }
        if kind == 0xda || length < 2 {
            return None;
        }
        at += 2 + length;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture with a smaller one in its head, stuffed bytes and two scans.
    fn picture() -> Vec<u8> {
        [
            &b"\xff\xd8"[..],
            b"\xff\xe1\x00\x0a\xff\xd8\xff\xd9abcd",
            b"\xff\xc0\x00\x0b\x08\x00\x20\x00\x40\x01\x01\x11\x00",
            b"\xff\xda\x00\x04xy\x01\xff\x00\x02\xff\xd3\x03",
            b"\xff\xda\x00\x02\x04\xff\xd9",
        ]
        .concat()
    }

    #[test]
    fn the_end_is_behind_the_last_scan_whatever_stands_in_the_head() {
        let file = picture();
        assert_eq!(Scan::default().end(&file), End::At(file.len()));
        let mut slowly = Scan::default();
        for end in 0..file.len() {
            assert_eq!(slowly.end(&file[..end]), End::Later, "{end}");
        }
        assert_eq!(slowly.end(&file), End::At(file.len()));
        assert_eq!(size(&file), Some((64, 32)));
    }

    #[test]
    fn a_picture_that_another_one_interrupts_is_broken() {
        let file = picture();
        let cut = &file[..file.len() - 2];
        let both = [cut, &file].concat();
        assert_eq!(Scan::default().end(&both), End::Broken(cut.len()));
        assert_eq!(Scan::default().end(b"no"), End::Broken(1));
        assert_eq!(Scan::default().end(b"\xff\xd8\xff\xe0\0\0"), End::Broken(2));
    }
}
