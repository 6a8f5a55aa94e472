//! Whose rules apply, and what pixels stand for.

/// Whose rules apply to pixels and texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Distro {
    /// ROS 1: `map_server` and `map_saver` of noetic.
    Noetic,
    /// `nav2_map_server` up to humble and iron.
    Humble,
    /// `nav2_map_server` of jazzy and all that came later.
    #[default]
    Jazzy,
}

impl Distro {
    /// The rules of a distribution of ROS by its name; `ros1`, `rolling` and `main` are names, too.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "ros1" | "kinetic" | "melodic" | "noetic" => Some(Self::Noetic),
            "dashing" | "eloquent" | "foxy" | "galactic" | "humble" | "iron" => Some(Self::Humble),
            "jazzy" | "kilted" | "lyrical" | "rolling" | "main" => Some(Self::Jazzy),
            _ => None,
        }
    }

    /// `noetic`, `humble` or `jazzy`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Noetic => "noetic",
            Self::Humble => "humble",
            Self::Jazzy => "jazzy",
        }
    }
}

/// What the brightness of a pixel stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// Occupied, free or unknown.
    #[default]
    Trinary,
    /// The same, and percents between.
    Scale,
    /// The value itself.
    Raw,
}

impl Mode {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Trinary, Self::Scale, Self::Raw];

    /// By its name, in capitals or not.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mode| mode.name().eq_ignore_ascii_case(name))
    }

    /// As files write it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Trinary => "trinary",
            Self::Scale => "scale",
            Self::Raw => "raw",
        }
    }
}
