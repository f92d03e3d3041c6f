//! Messages of ROS 1 and ROS 2.

use super::definition::{Count, Member, MemberType, Types, Version};
use super::wire::{MessageLayout, Wire};
use crate::log::FieldKind;
use crate::log::growing::{FieldStep, GrowingTable, MOST_ELEMENTS, Path, ValuePlace};

const SHORT: &str = "a message is shorter than its schema says";

/// A type of message.
pub(super) struct Ros {
    types: Types,
    version: Version,
}

impl Ros {
    /// A message of ROS 1. The error says in words what is wrong with its definition.
    pub fn first(name: &str, definition: &[u8]) -> Result<Self, String> {
        Self::new(name, definition, Version::First)
    }

    /// A message of ROS 2.
    pub fn second(name: &str, definition: &[u8]) -> Result<Self, String> {
        Self::new(name, definition, Version::Second)
    }

    fn new(name: &str, definition: &[u8], version: Version) -> Result<Self, String> {
        let types = Types::parse(name, definition, version)?;
        Ok(Self { types, version })
    }

    /// Puts what a message says into the row.
    pub fn decode(
        &self,
        data: &[u8],
        root: &mut ValuePlace,
        table: &mut GrowingTable,
    ) -> Result<(), &'static str> {
        let mut wire = match self.version {
            Version::First => Wire::new(data, MessageLayout::FIRST),
            Version::Second => {
                let (head, data) = data.split_first_chunk().ok_or(SHORT)?;
                let form =
                    MessageLayout::of_cdr(*head).ok_or("a message in another form of CDR")?;
                Wire::new(data, form)
            }
        };
        let Some(message) = self.types.types.len().checked_sub(1) else {
            return Ok(());
        };
        self.members(message, &mut wire, Some(root), &Path::default(), table)
            .ok_or(SHORT)
    }

    /// Takes all members of a type; puts them where `place` says, if anywhere.
    fn members(
        &self,
        number: usize,
        wire: &mut Wire,
        place: Option<&mut ValuePlace>,
        path: &Path,
        table: &mut GrowingTable,
    ) -> Option<()> {
        // What is too short is known before anything is done, so that work is in proportion to the bytes.
        if self.types.least[number] > wire.left() {
            return None;
        }
        let members = &self.types.types[number];
        let mut places = place.and_then(|place| table.parts(place, members.len()));
        for (index, member) in members.iter().enumerate() {
            let place = places.as_mut().map(|places| &mut places[index]);
            let place = place.filter(|_| !member.name.is_empty());
            let path = path.then(FieldStep::Name(&member.name));
            match member.count {
                Count::One => self.element(member.element, wire, place, &path, table)?,
                Count::Always(count) => {
                    self.list(member, count, false, wire, place, &path, table)?;
                }
                Count::Counted => {
                    let count = wire.count()?;
                    self.list(member, count, true, wire, place, &path, table)?;
                }
            }
        }
        Some(())
    }

    #[allow(
        clippy::too_many_arguments,
        reason = "a place in the message and one in the row"
    )]
    fn list(
        &self,
        member: &Member,
        count: usize,
        is_counted: bool,
        wire: &mut Wire,
        place: Option<&mut ValuePlace>,
        path: &Path,
        table: &mut GrowingTable,
    ) -> Option<()> {
        if member.shortest.saturating_mul(count) > wire.left() {
            return None;
        }
        let is_blob = is_counted && member.element == MemberType::Number(FieldKind::U8);
        let kept = if is_blob { 0 } else { count.min(MOST_ELEMENTS) };
        let before = usize::from(is_counted);
        let mut places = place.and_then(|place| table.parts(place, before + kept));
        if let Some([length, ..]) = places.as_deref_mut().filter(|_| is_counted) {
            table.length(length, path, count);
        }
        if kept < count {
            table.cut_list(path, kept);
        }
        for index in 0..kept {
            let place = places.as_mut().map(|places| &mut places[before + index]);
            self.element(
                member.element,
                wire,
                place,
                &path.then(FieldStep::Index(index)),
                table,
            )?;
        }
        match member.element {
            // Nothing of those that are left has to be looked at.
            MemberType::Number(kind) => wire.take((count - kept) * kind.size()).map(|_| ()),
            element if member.shortest > 0 => {
                (kept..count).try_for_each(|_| self.element(element, wire, None, path, table))
            }
            _ => Some(()),
        }
    }

    fn element(
        &self,
        element: MemberType,
        wire: &mut Wire,
        place: Option<&mut ValuePlace>,
        path: &Path,
        table: &mut GrowingTable,
    ) -> Option<()> {
        match element {
            MemberType::Number(kind) => match kind.size() {
                1 => put::<1>(kind, wire, place, path, table),
                2 => put::<2>(kind, wire, place, path, table),
                4 => put::<4>(kind, wire, place, path, table),
                _ => put::<8>(kind, wire, place, path, table),
            },
            MemberType::Text => {
                let letters = wire.text()?;
                if let Some(place) = place {
                    table.text(place, path, letters);
                }
                Some(())
            }
            MemberType::Type(number) => self.members(number, wire, place, path, table),
        }
    }
}

#[inline]
fn put<const N: usize>(
    kind: FieldKind,
    wire: &mut Wire,
    place: Option<&mut ValuePlace>,
    path: &Path,
    table: &mut GrowingTable,
) -> Option<()> {
    let bytes = wire.number::<N>()?;
    if let Some(place) = place {
        table.number(place, path, kind, &bytes);
    }
    Some(())
}
