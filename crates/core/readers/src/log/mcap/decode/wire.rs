//! Values of ROS messages one after another.

/// Layout of the bytes of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MessageLayout {
    /// Whether numbers have their lowest byte first.
    pub is_little: bool,
    /// Numbers begin at multiples of their size, if that is not more than this.
    pub alignment: usize,
    /// Whether texts count a zero at their end.
    pub ends_texts: bool,
}

impl MessageLayout {
    /// ROS 1: everything side by side.
    pub const FIRST: Self = Self {
        is_little: true,
        alignment: 1,
        ends_texts: false,
    };

    /// CDR by the four bytes before it; `None` for its forms that ROS 2 does not write.
    pub fn of_cdr(head: [u8; 4]) -> Option<Self> {
        let (is_little, alignment) = match head[1] {
            0 => (false, 8),
            1 => (true, 8),
            _ => return None,
        };
        Some(Self {
            is_little,
            alignment,
            ends_texts: true,
        })
    }
}

/// Unread rest of a message.
pub(super) struct Wire<'a> {
    bytes: &'a [u8],
    place: usize,
    form: MessageLayout,
}

impl<'a> Wire<'a> {
    pub fn new(bytes: &'a [u8], form: MessageLayout) -> Self {
        Self {
            bytes,
            place: 0,
            form,
        }
    }

    /// Bytes that are left.
    pub fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.place)
    }

    pub fn align(&mut self, size: usize) {
        self.place = self.place.next_multiple_of(size.min(self.form.alignment));
    }

    pub fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let end = self.place.checked_add(count)?;
        let taken = self.bytes.get(self.place..end)?;
        self.place = end;
        Some(taken)
    }

    /// A number of `N` bytes, its lowest byte first.
    #[inline]
    pub fn number<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.align(N);
        let mut bytes: [u8; N] = self.take(N)?.try_into().ok()?;
        if !self.form.is_little {
            bytes.reverse();
        }
        Some(bytes)
    }

    /// Number of elements that follow.
    pub fn count(&mut self) -> Option<usize> {
        usize::try_from(u32::from_le_bytes(self.number()?)).ok()
    }

    /// Letters after their number.
    pub fn text(&mut self) -> Option<&'a [u8]> {
        let count = self.count()?;
        let letters = self.take(count)?;
        Some(match letters {
            [letters @ .., 0] if self.form.ends_texts => letters,
            letters => letters,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_begin_at_multiples_of_their_size_in_cdr_only() {
        let bytes = [7, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0];
        let form = MessageLayout::of_cdr([0, 1, 0, 0]).expect("ROS 2 writes it");
        let mut wire = Wire::new(&bytes, form);
        assert_eq!(wire.number(), Some([7]));
        assert_eq!(wire.number(), Some([1, 0, 0, 0]));
        assert_eq!(wire.number().map(u64::from_le_bytes), Some(2));
        let mut wire = Wire::new(&bytes, MessageLayout::FIRST);
        assert_eq!(wire.number(), Some([7]));
        assert_eq!(wire.number(), Some([0, 0, 0, 1]));
        assert_eq!(wire.left(), 11);
    }

    #[test]
    fn a_highest_byte_first_is_turned_round() {
        let form = MessageLayout::of_cdr([0, 0, 0, 0]).expect("ROS 2 may write it");
        let mut wire = Wire::new(&[0, 0, 0, 3, b'a', b'b', 0, 9, 0, 5], form);
        assert_eq!(wire.text(), Some(&b"ab"[..]));
        assert_eq!(wire.number::<2>(), Some([5, 0]));
        assert_eq!(wire.number::<1>(), None);
        assert_eq!(MessageLayout::of_cdr([0, 3, 0, 0]), None);
    }
}
