//! Numbers and texts one after another, lowest byte first.

/// Unread rest of some bytes.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    rest: &'a [u8],
}

impl<'a> Cursor<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    pub fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    pub fn byte(&mut self) -> Option<u8> {
        self.array().map(|[byte]| byte)
    }

    pub fn short(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    pub fn word(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub fn long(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    /// As many bytes as a number of 32 bits before them says.
    pub fn counted(&mut self) -> Option<&'a [u8]> {
        let count = self.word()?;
        self.take(usize::try_from(count).ok()?)
    }

    /// Letters after their number.
    pub fn text(&mut self) -> Option<&'a str> {
        str::from_utf8(self.counted()?).ok()
    }

    /// Pairs of texts after the number of their bytes.
    pub fn pairs(&mut self) -> Option<Vec<(&'a str, &'a str)>> {
        let mut inside = Self::new(self.counted()?);
        let mut pairs = Vec::new();
        while !inside.is_over() {
            pairs.push((inside.text()?, inside.text()?));
        }
        Some(pairs)
    }

    pub fn is_over(&self) -> bool {
        self.rest.is_empty()
    }

    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_longer_than_its_bytes_is_not_read() {
        let mut bytes = Cursor::new(&[2, 0, 0, 0, b'h', b'i', 9, 0, 0, 0, b'x']);
        assert_eq!(bytes.text(), Some("hi"));
        assert_eq!(bytes.text(), None);
        let pairs = [12, 0, 0, 0, 1, 0, 0, 0, b'a', 3, 0, 0, 0, b'b', b'c', b'd'];
        assert_eq!(Cursor::new(&pairs).pairs(), Some(vec![("a", "bcd")]));
        assert_eq!(Cursor::new(&pairs[..15]).pairs(), None);
        let short = [11, 0, 0, 0, 1, 0, 0, 0, b'a', 3, 0, 0, 0, b'b', b'c'];
        assert_eq!(Cursor::new(&short).pairs(), None);
    }
}
