//! Entries of the directories of TIFF files, which maps and photos have alike.

/// Entry of a directory, as it stands there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TiffEntry<'a> {
    /// Number of the tag.
    pub tag: u16,
    /// Type of its values.
    pub kind: u16,
    /// Number of values.
    pub count: u64,
    /// The values themselves where they have room there, or where they lie in the file: 4 bytes, 8 of a `BigTIFF`.
    pub inline: &'a [u8],
}

impl<'a> TiffEntry<'a> {
    /// Reads the 12 bytes of an entry, or the 20 of one of a `BigTIFF`.
    ///
    /// # Panics
    /// If there are fewer than 12 bytes, or an odd number.
    ///
    /// ```
    /// use pilotage_base::tiff_entry::TiffEntry;
    ///
    /// let entry = TiffEntry::read(&[1, 0x12, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0], false);
    /// assert_eq!((entry.tag, entry.kind, entry.count), (0x0112, 3, 1));
    /// assert_eq!((entry.length(), entry.inline), (Some(2), &[0, 6, 0, 0][..]));
    /// ```
    pub fn read(bytes: &'a [u8], is_little_endian: bool) -> Self {
        let (head, rest) = bytes.split_at(4);
        let (count, inline) = rest.split_at(rest.len() / 2);
        let number = |bytes: &[u8]| unsigned(bytes, is_little_endian);
        Self {
            tag: number(&head[..2]) as u16,
            kind: number(&head[2..]) as u16,
            count: number(count),
            inline,
        }
    }

    /// Bytes of all values, `u64::MAX` where that is more; `None` of a type that is not known.
    pub fn length(&self) -> Option<u64> {
        Some(self.count.saturating_mul(size_of_kind(self.kind)?))
    }
}

/// Bytes of a value of a type; `None` of one that is not known. Types 16 to 18 are those of `BigTIFF`.
pub fn size_of_kind(kind: u16) -> Option<u64> {
    match kind {
        1 | 2 | 6 | 7 => Some(1),
        3 | 8 => Some(2),
        4 | 9 | 11 | 13 => Some(4),
        5 | 10 | 12 | 16..=18 => Some(8),
        _ => None,
    }
}

/// Whole number of at most eight bytes.
pub fn unsigned(bytes: &[u8], is_little_endian: bool) -> u64 {
    let join = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
    if is_little_endian {
        bytes.iter().rev().fold(0, join)
    } else {
        bytes.iter().fold(0, join)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_read_in_both_orders_and_both_sizes() {
        let little = [0x12, 1, 4, 0, 3, 0, 0, 0, 7, 0, 1, 0];
        let entry = TiffEntry::read(&little, true);
        assert_eq!((entry.tag, entry.kind, entry.count), (0x0112, 4, 3));
        assert_eq!(
            (entry.length(), unsigned(entry.inline, true)),
            (Some(12), 65_543)
        );
        let mut big = vec![1, 0x44, 0, 16, 0x80, 0, 0, 0, 0, 0, 0, 0];
        big.extend([0, 0, 0, 0, 0, 0, 2, 1]);
        let entry = TiffEntry::read(&big, false);
        assert_eq!((entry.tag, entry.kind, entry.count), (0x0144, 16, 1 << 63));
        assert_eq!(
            (entry.length(), unsigned(entry.inline, false)),
            (Some(u64::MAX), 513)
        );
    }

    #[test]
    fn values_of_a_type_that_is_not_known_have_no_length() {
        let entry = TiffEntry::read(&[0, 1, 0, 15, 0, 0, 0, 1, 0, 0, 0, 0], false);
        assert_eq!(entry.length(), None);
    }
}
