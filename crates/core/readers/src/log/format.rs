//! The enum of the formats of logs, made from the table in `mod.rs`.

/// Declares the folders of the formats, and makes their enum and the table of readers, and apart from it that of meanings.
/// Each line has the name for people, the ending of its files' names in small letters, and the folder's constant that
/// knows the reader; the order is that in which formats are tried.
macro_rules! log_formats {
    ($($folder:ident { $(
        $(#[$about:meta])* $name:ident($label:literal, $ending:literal, $info:ident),
    )* })*) => {
        $(mod $folder;)*

        /// A format of logs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
        pub enum LogFormat {
            $($(
                $(#[$about])*
                #[doc = concat!("See `", stringify!($folder), "`.")]
                $name,
            )*)*
            /// Tables of a flight, whose columns people or a file beside them told apart.
            Tables,
            /// Photos that say themselves when, where and how they were taken.
            Photos,
        }

        impl LogFormat {
            /// Endings of the names of logs, in the order of their formats.
            ///
            /// ```
            /// # use pilotage_readers::log::LogFormat;
            /// assert!(LogFormat::ENDINGS.join(", ").starts_with(".bin, .log, .ulg"));
            /// ```
            pub const ENDINGS: &[&str] = &[$($($ending,)*)*];

            /// Name for people.
            pub const fn label(self) -> &'static str {
                match self {
                    $($(Self::$name => $label,)*)*
                    Self::Tables => "Tables",
                    Self::Photos => "Photos",
                }
            }

            /// Meaning of its topics for a flight.
            pub(crate) fn meaning(self) -> crate::role::Meaning {
                match self {
                    $($(Self::$name => $folder::MEANING,)*)*
                    Self::Tables | Self::Photos => crate::role::Meaning {
                        roles: &[],
                        triggers: &[],
                        conditions: &[],
                        has_systems: false,
                    },
                }
            }
        }

        /// Every format, in the order in which they are tried.
        pub fn all_formats() -> &'static [LogFormatInfo] {
            &[$($($folder::$info,)*)*]
        }
    };
}
