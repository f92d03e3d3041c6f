//! Rows of equal length, in pieces that never move.

/// Bytes of one piece, about.
const PIECE: usize = 1 << 20;

/// Rows of equal length. Grows by pieces, so that a large log is never copied to make room.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    width: usize,
    per_piece: usize,
    pieces: Vec<Vec<u8>>,
    length: usize,
}

impl Rows {
    /// No rows of `width` bytes each.
    pub fn new(width: usize) -> Self {
        Self {
            width,
            per_piece: (PIECE / width.max(1)).max(1),
            pieces: Vec::new(),
            length: 0,
        }
    }

    /// Bytes of a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Bytes that the rows take in memory.
    pub fn memory(&self) -> usize {
        self.pieces.iter().map(Vec::capacity).sum()
    }

    /// Appends a row; what `bytes` lack is filled with zeros, what they have more is left out.
    #[inline]
    pub fn push(&mut self, bytes: &[u8]) {
        if self.length == self.pieces.len() * self.per_piece {
            self.add_piece();
        }
        if let Some(piece) = self.pieces.last_mut() {
            let end = piece.len() + self.width;
            piece.extend_from_slice(&bytes[..bytes.len().min(self.width)]);
            piece.resize(end, 0);
            self.length += 1;
        }
    }

    fn add_piece(&mut self) {
        // The first piece grows: most topics have few rows. Later ones are made whole.
        let whole = self.per_piece * self.width;
        let capacity = if self.pieces.is_empty() { 0 } else { whole };
        self.pieces.push(Vec::with_capacity(capacity));
    }

    /// Row `index`.
    #[inline]
    pub fn get(&self, index: usize) -> Option<&[u8]> {
        if index >= self.length {
            return None;
        }
        let start = index % self.per_piece * self.width;
        self.pieces
            .get(index / self.per_piece)?
            .get(start..start + self.width)
    }

    /// Pieces of whole rows, in each one row after the other: quicker to go through than row by row.
    pub fn pieces(&self) -> impl Iterator<Item = &[u8]> {
        self.pieces.iter().map(Vec::as_slice)
    }

    /// Row after row.
    pub fn iter(&self) -> impl Iterator<Item = &[u8]> {
        (0..self.length).filter_map(|index| self.get(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back_as_they_were_given_over_many_pieces() {
        let width = 300_000;
        let mut rows = Rows::new(width);
        for i in 0..10_u8 {
            rows.push(&vec![i; width]);
        }
        assert_eq!(rows.len(), 10);
        assert!(rows.pieces.len() > 1);
        let one_by_one: Vec<&[u8]> = rows.iter().collect();
        let by_pieces = rows.pieces().flat_map(|piece| piece.chunks_exact(width));
        assert!(by_pieces.eq(one_by_one));
        for (i, row) in rows.iter().enumerate() {
            assert!(row.len() == width && row.iter().all(|b| usize::from(*b) == i));
        }
        assert_eq!(rows.get(10), None);
    }

    #[test]
    fn a_short_row_is_filled_with_zeros_and_a_long_one_cut() {
        let mut rows = Rows::new(3);
        rows.push(&[7]);
        rows.push(&[1, 2, 3, 4]);
        assert_eq!(rows.get(0), Some(&[7, 0, 0][..]));
        assert_eq!(rows.get(1), Some(&[1, 2, 3][..]));
    }

    #[test]
    fn rows_without_bytes_are_still_counted() {
        let mut rows = Rows::new(0);
        rows.push(&[]);
        assert_eq!((rows.len(), rows.get(0)), (1, Some(&[][..])));
    }
}
