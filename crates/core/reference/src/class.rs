//! Classes of generic landmarks.

use serde::{Deserialize, Serialize};

/// Class of a generic landmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum GenericClass {
    /// A building or a part of one.
    Building,
    /// A field or a meadow.
    Field,
    /// A tree or a group of trees.
    Tree,
    /// A crossing of roads.
    Crossing,
    /// A pond, a pool or other standing water.
    Water,
    /// A place where cars are parked.
    Parking,
    /// A class that people named: its place among the names of the table, less than [`GenericClass::MOST_OTHERS`].
    Other(u8),
}

impl GenericClass {
    /// Classes that every table has.
    pub const USUAL: [Self; 6] = [
        Self::Building,
        Self::Field,
        Self::Tree,
        Self::Crossing,
        Self::Water,
        Self::Parking,
    ];

    /// Number of classes that people can name in one table.
    pub const MOST_OTHERS: u8 = 10;

    /// Number of the class in files, from 1: building, field and tree are 1, 2 and 3 as in DeAngelo 2016, chapter 3.
    pub fn number(self) -> u8 {
        match self {
            Self::Building => 1,
            Self::Field => 2,
            Self::Tree => 3,
            Self::Crossing => 4,
            Self::Water => 5,
            Self::Parking => 6,
            Self::Other(name) => 7 + name,
        }
    }

    /// The class of that number.
    ///
    /// ```
    /// use pilotage_reference::GenericClass;
    ///
    /// assert_eq!(GenericClass::of_number(3), Some(GenericClass::Tree));
    /// assert_eq!(GenericClass::of_number(7), Some(GenericClass::Other(0)));
    /// assert_eq!(GenericClass::of_number(0), None);
    /// ```
    pub fn of_number(number: u8) -> Option<Self> {
        let index = usize::from(number.checked_sub(1)?);
        let others = || {
            let name = (index - Self::USUAL.len()) as u8;
            (name < Self::MOST_OTHERS).then_some(Self::Other(name))
        };
        Self::USUAL.get(index).copied().or_else(others)
    }
}
