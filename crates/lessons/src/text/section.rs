//! Sections that a lesson's text has.

/// Section of a lesson.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Section {
    /// A guess that the reader commits to.
    Guess,
    /// Explanation in words.
    Story,
    /// The same by its equations.
    Mathematics,
    /// Numbers worked by hand that equal the program's.
    WorkedNumber,
    /// A control, and what to look at.
    TryIt,
    /// A setting at which it fails, and why.
    BreakIt,
    /// A setting of the reader's own, which is judged.
    YourTurn,
    /// The same in the flight on screen.
    InTheFlight,
    /// Words for the presenter.
    Notes,
    /// Symbols of the equations.
    Symbols,
    /// Words of the figure and of the controls.
    Labels,
    /// Origin of what it says.
    Sources,
}

impl Section {
    /// All of them, in the order in which they are read.
    pub const ALL: [Self; 12] = [
        Self::Guess,
        Self::Story,
        Self::Mathematics,
        Self::WorkedNumber,
        Self::TryIt,
        Self::BreakIt,
        Self::YourTurn,
        Self::InTheFlight,
        Self::Sources,
        Self::Notes,
        Self::Symbols,
        Self::Labels,
    ];

    /// Heading in every text. Readers see the words of the page for it.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Guess => "Guess",
            Self::Story => "Story",
            Self::Mathematics => "Mathematics",
            Self::WorkedNumber => "Worked number",
            Self::TryIt => "Try it",
            Self::BreakIt => "Break it",
            Self::YourTurn => "Your turn",
            Self::InTheFlight => "In the flight",
            Self::Notes => "Notes",
            Self::Symbols => "Symbols",
            Self::Labels => "Labels",
            Self::Sources => "Sources",
        }
    }

    /// Name in addresses.
    pub fn name(self) -> String {
        self.heading().to_lowercase().replace(' ', "-")
    }

    /// Whether readers go through it one after the other.
    pub fn is_step(self) -> bool {
        !matches!(
            self,
            Self::Notes | Self::Symbols | Self::Labels | Self::Sources
        )
    }

    pub(super) fn named(heading: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|own| own.heading() == heading)
    }
}
