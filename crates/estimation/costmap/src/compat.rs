//! Behaviour to keep where the releases of Nav2 differ.
//!
//! Source: the branches of `ros-navigation/navigation2` (humble 3c3db59d, jazzy f4108e5b, tag 1.3.10,
//! kilted 71a1d84f, main a3a97043).

use std::fmt;
use std::str::FromStr;

use periplus_params::ParamChoice;

/// Release of Nav2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Nav2Release {
    /// ROS 2 Humble (2022).
    Humble,
    /// ROS 2 Jazzy (2024) up to Nav2 1.3.10.
    EarlyJazzy,
    /// ROS 2 Jazzy, its newest Nav2.
    Jazzy,
    /// ROS 2 Kilted (2025).
    Kilted,
    /// The main branch (2026).
    #[default]
    Main,
}

/// Measure by which an obstacle layer decides whether a point is in the range for marking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeMeasure {
    /// Whole cells in the plane, both limits included.
    Cells,
    /// Metres in the plane and whole cells, both limits included.
    GroundAndCells,
    /// Metres in space, the upper limit excluded. The sensor may be outside the grid.
    Space,
}

impl Nav2Release {
    /// All releases, oldest first.
    pub const ALL: [Self; 5] =
        [Self::Humble, Self::EarlyJazzy, Self::Jazzy, Self::Kilted, Self::Main];

    /// Names of releases in parameters and options, including those of other distributions with the
    /// same behaviour.
    pub const NAMES: [&str; 8] =
        ["humble", "iron", "jazzy-1.3.10", "jazzy", "kilted", "lyrical", "rolling", "main"];

    /// Returns the number of cells by which a grid is assumed shorter than it is when it is centred
    /// on the robot: before main, `getSizeInMeters` ended in the middle of the last cell.
    #[must_use]
    pub fn missing_cells(self) -> f64 {
        if self == Self::Main { 0.0 } else { 0.5 }
    }

    /// Returns true if distances to obstacles are rounded to hundredths of a cell before costs are
    /// computed.
    #[must_use]
    pub fn rounds_distances(self) -> bool {
        self == Self::Main
    }

    /// Returns the measure of the obstacle range of an obstacle layer. Voxel layers always measure
    /// in space.
    #[must_use]
    pub fn range_measure(self) -> RangeMeasure {
        match self {
            Self::Humble => RangeMeasure::Cells,
            Self::EarlyJazzy | Self::Kilted => RangeMeasure::Space,
            Self::Jazzy | Self::Main => RangeMeasure::GroundAndCells,
        }
    }

    /// Returns true if the value 99 in a map is inscribed.
    #[must_use]
    pub fn knows_inscribed_maps(self) -> bool {
        self == Self::Main
    }

    /// Returns true if the corners of an area to clear are computed without bounds and then clamped
    /// to the grid; other releases clamp the points first.
    #[must_use]
    pub fn clamps_cleared_areas(self) -> bool {
        self >= Self::Kilted
    }

    /// Returns true if clear services have layer names in the request and `success` in the
    /// response.
    #[must_use]
    pub fn clears_by_name(self) -> bool {
        self == Self::Main
    }

    /// Returns true if there is a service that clears around a pose.
    #[must_use]
    pub fn clears_around_poses(self) -> bool {
        matches!(self, Self::EarlyJazzy | Self::Jazzy | Self::Main)
    }

    /// Returns true if the cost service accepts several poses in any frame (`GetCosts`).
    #[must_use]
    pub fn answers_several_costs(self) -> bool {
        self >= Self::Kilted
    }

    /// Returns true if relative topics of layers are resolved in the parent namespace of the
    /// costmap.
    #[must_use]
    pub fn joins_parent_namespace(self) -> bool {
        self >= Self::Kilted
    }

    /// Returns true if a static layer can restore the cells that it cleared under the robot.
    #[must_use]
    pub fn restores_cleared_footprint(self) -> bool {
        self >= Self::Kilted
    }

    /// Returns true if `restore_cleared_footprint` can only be set while the footprint is cleared.
    #[must_use]
    pub fn guards_restore_parameter(self) -> bool {
        self == Self::Main
    }

    /// Returns true if the update after a full update (a reset, a new footprint) is limited to new
    /// changes; other releases inflate the bounds of the full update once more.
    #[must_use]
    pub fn forgets_bounds_when_redone(self) -> bool {
        matches!(self, Self::Jazzy | Self::Main)
    }

    /// Returns true if the static layer of a rolling costmap requests the window around the robot;
    /// other releases request the area of the map.
    #[must_use]
    pub fn follows_robot_with_map(self) -> bool {
        matches!(self, Self::Jazzy | Self::Main)
    }

    /// Returns true if a voxel layer ignores points below `min_obstacle_height`.
    #[must_use]
    pub fn has_lowest_voxel_height(self) -> bool {
        self != Self::Humble
    }

    /// Returns true if rays of a voxel layer that are cut at the edge of the grid end slightly
    /// inside it.
    #[must_use]
    pub fn shortens_cut_rays(self) -> bool {
        self != Self::Humble
    }

    /// Returns true if observation layers support combination method 2 and treat unknown methods as
    /// 1. In Humble such a layer writes nothing.
    #[must_use]
    pub fn knows_max_of_known(self) -> bool {
        self != Self::Humble
    }

    /// Returns true if each observation expires by its own age; other releases drop the first
    /// expired one together with all older ones.
    #[must_use]
    pub fn drops_observations_one_by_one(self) -> bool {
        self == Self::Main
    }

    /// Returns the cost of a point outside the costmap in the response of the single-cost service.
    #[must_use]
    pub fn cost_outside(self) -> f32 {
        if self.answers_several_costs() { 254.0 } else { -1.0 }
    }

    /// Returns true if a keepout filter can lower the cost of the zone in which the robot is, and
    /// extends an update by the area of a new mask.
    #[must_use]
    pub fn updates_keepout_zones(self) -> bool {
        self != Self::Humble
    }

    /// Returns true if `publish_frequency` must stay above 0 while the costmap runs.
    #[must_use]
    pub fn refuses_to_stop_publishing(self) -> bool {
        self == Self::Main
    }

    /// Returns true if a speed filter can look ahead on the path.
    #[must_use]
    pub fn looks_ahead_on_paths(self) -> bool {
        self == Self::Main
    }

    /// Returns true if the grids of the layers are published as well.
    #[must_use]
    pub fn publishes_layers(self) -> bool {
        self != Self::Humble
    }
}

impl ParamChoice for Nav2Release {
    const WORDS: &'static [&'static str] = &Self::NAMES;

    fn of_word(word: &str) -> Self {
        word.parse().unwrap_or_default()
    }

    fn word(self) -> &'static str {
        match self {
            Self::Humble => "humble",
            Self::EarlyJazzy => "jazzy-1.3.10",
            Self::Jazzy => "jazzy",
            Self::Kilted => "kilted",
            Self::Main => "main",
        }
    }
}

impl fmt::Display for Nav2Release {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for Nav2Release {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.to_ascii_lowercase().as_str() {
            "humble" | "iron" => Ok(Self::Humble),
            "jazzy-1.3.10" => Ok(Self::EarlyJazzy),
            "jazzy" => Ok(Self::Jazzy),
            "kilted" => Ok(Self::Kilted),
            "main" | "rolling" | "lyrical" => Ok(Self::Main),
            _ => Err(format!("`{text}` is not one of `{}`", Self::NAMES.join("`, `"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_read_and_every_release_is_named() {
        for name in Nav2Release::NAMES {
            assert!(name.parse::<Nav2Release>().is_ok(), "{name}");
        }
        for compat in Nav2Release::ALL {
            assert_eq!(compat.to_string().parse(), Ok(compat));
            assert!(Nav2Release::NAMES.contains(&compat.to_string().as_str()));
        }
        assert!("jazzy-1.3.9".parse::<Nav2Release>().unwrap_err().contains("jazzy-1.3.10"));
    }
}
