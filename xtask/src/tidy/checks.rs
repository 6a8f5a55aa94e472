//! Checks of the language and what they find.

pub(crate) mod constants;
pub(crate) mod prose;
pub(crate) mod results;
pub(crate) mod types;

use std::fmt;
use std::ops::Range;

/// Check of `cargo xtask tidy`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, clap::ValueEnum)]
pub(crate) enum Check {
    /// Openings of doc comments
    Openings,
    /// Words and phrases that have a better term
    Words,
    /// Constants without a unit or ratio in their names
    Constants,
    /// Public type names that are defined more than once
    Types,
    /// Errors that are strings in public signatures
    Results,
    /// Error codes compared as strings
    Codes,
}

impl Check {
    pub(crate) const ALL: [Self; 6] =
        [Self::Openings, Self::Words, Self::Constants, Self::Types, Self::Results, Self::Codes];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Openings => "openings",
            Self::Words => "words",
            Self::Constants => "constants",
            Self::Types => "types",
            Self::Results => "results",
            Self::Codes => "codes",
        }
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Part of a file that a check objects to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Finding {
    pub(crate) check: Check,
    /// Entry of the data file for [`Check::Words`]; else empty.
    pub(crate) entry: String,
    /// Bytes in the file.
    pub(crate) range: Range<usize>,
    /// Text that is objected to, in one line.
    pub(crate) text: String,
    /// Replacement or remedy.
    pub(crate) advice: String,
}
