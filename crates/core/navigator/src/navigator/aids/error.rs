//! Why an aid cannot be switched on.

/// Why an aid cannot be switched on.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AidError {
    /// Nothing has that name.
    #[error("there is no aid \"{key}\"; there are {known}")]
    Unknown {
        /// The name.
        key: String,
        /// Names of those that there are.
        known: String,
    },
    /// The aid has no such number.
    #[error("the aid \"{key}\" has no number \"{number}\"; it has {known}")]
    UnknownNumber {
        /// Name of the aid.
        key: String,
        /// Name of the number.
        number: String,
        /// Names of those that it has.
        known: String,
    },
    /// A number that is none, or below zero.
    #[error("the aid \"{key}\" cannot have {number} = {value}; say a number above zero")]
    Unsound {
        /// Name of the aid.
        key: String,
        /// Name of the number.
        number: String,
        /// The value.
        value: String,
    },
    /// The flight measured nothing of the kind.
    #[error("the flight has no channel {channel} for the aid \"{key}\"; switch that off")]
    NoChannel {
        /// Name of the aid.
        key: String,
        /// Key of the channel.
        channel: String,
    },
    /// Too little is known of the ground.
    #[error("there is no {what} for the aid \"{key}\"; {remedy}")]
    UnknownGround {
        /// Name of the aid.
        key: String,
        /// Part that lacks.
        what: String,
        /// Remedy to propose.
        remedy: String,
    },
}
