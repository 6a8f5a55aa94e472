//! Map servers of ROS distributions, and map modes.

/// Distribution whose map server and map saver are reproduced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Distro {
    /// ROS 1: `map_server` and `map_saver` of Noetic.
    Noetic,
    /// `nav2_map_server` up to Humble and Iron.
    Humble,
    /// `nav2_map_server` of Jazzy and later.
    #[default]
    Jazzy,
}

impl Distro {
    /// Returns the rules of a ROS distribution by its name; `ros1`, `rolling` and `main` are names
    /// as well.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "ros1" | "kinetic" | "melodic" | "noetic" => Some(Self::Noetic),
            "dashing" | "eloquent" | "foxy" | "galactic" | "humble" | "iron" => Some(Self::Humble),
            "jazzy" | "kilted" | "lyrical" | "rolling" | "main" => Some(Self::Jazzy),
            _ => None,
        }
    }

    /// Returns `noetic`, `humble` or `jazzy`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Noetic => "noetic",
            Self::Humble => "humble",
            Self::Jazzy => "jazzy",
        }
    }
}

/// Interpretation of the brightness of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// Occupied, free or unknown.
    #[default]
    Trinary,
    /// Occupied, free or unknown, and percentages between the thresholds.
    Scale,
    /// The occupancy value itself.
    Raw,
}

impl Mode {
    /// All modes.
    pub const ALL: [Self; 3] = [Self::Trinary, Self::Scale, Self::Raw];

    /// Returns a mode by its name, in upper or lower case.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mode| mode.name().eq_ignore_ascii_case(name))
    }

    /// Returns the name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Trinary => "trinary",
            Self::Scale => "scale",
            Self::Raw => "raw",
        }
    }
}
