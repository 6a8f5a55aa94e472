//! Whose habits to keep where the distributions of Nav2 differ.

use std::fmt;
use std::str::FromStr;

/// A generation of Nav2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Compat {
    /// ROS 2 Humble (2022).
    Humble,
    /// ROS 2 Jazzy (2024).
    Jazzy,
    /// The main branch (2026).
    #[default]
    Main,
}

impl Compat {
    /// All of them, oldest first.
    pub const ALL: [Self; 3] = [Self::Humble, Self::Jazzy, Self::Main];

    /// By how many cells the length of a grid is taken shorter than it is, when half of it is put on
    /// either side of the robot: before main, `getSizeInMeters` ended in the middle of the last cell.
    #[must_use]
    pub fn missing_cells(self) -> f64 {
        if self == Self::Main { 0.0 } else { 0.5 }
    }

    /// Whether distances to obstacles are rounded to hundredths of a cell before they become costs.
    #[must_use]
    pub fn rounds_distances(self) -> bool {
        self == Self::Main
    }

    /// Whether the range of a marking is also measured in metres, not in cells alone.
    #[must_use]
    pub fn measures_marks_in_metres(self) -> bool {
        self != Self::Humble
    }

    /// Whether 99 in a map is an inscribed cell.
    #[must_use]
    pub fn knows_inscribed_maps(self) -> bool {
        self == Self::Main
    }

    /// Whether an area to clear begins at the first cell at the lowest, so that this one is never
    /// cleared.
    #[must_use]
    pub fn clamps_cleared_areas(self) -> bool {
        self == Self::Main
    }

    /// Whether clear services take the names of layers and answer whether it worked.
    #[must_use]
    pub fn clears_by_name(self) -> bool {
        self == Self::Main
    }

    /// Whether relative topics of layers are looked for beside the costmap's namespace, not in it.
    #[must_use]
    pub fn joins_parent_namespace(self) -> bool {
        self == Self::Main
    }
}

impl fmt::Display for Compat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Humble => "humble",
            Self::Jazzy => "jazzy",
            Self::Main => "main",
        })
    }
}

impl FromStr for Compat {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.to_ascii_lowercase().as_str() {
            "humble" | "iron" => Ok(Self::Humble),
            "jazzy" | "kilted" => Ok(Self::Jazzy),
            "main" | "rolling" | "lyrical" => Ok(Self::Main),
            _ => Err(format!("`{text}` is none of `humble`, `jazzy`, `main`")),
        }
    }
}
