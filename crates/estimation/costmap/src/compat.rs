//! Behaviour to keep where the releases of Nav2 differ.
//!
//! Source: the branches of `ros-navigation/navigation2` (humble 3c3db59d, jazzy f4108e5b, tag 1.3.10,
//! kilted 71a1d84f, main a3a97043).

use std::fmt;
use std::str::FromStr;

/// A release of Nav2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Compat {
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

/// Measure by which an obstacle layer decides that a point is too far away or too near to mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeMeasure {
    /// Whole cells on the ground, both limits included.
    Cells,
    /// Metres on the ground and whole cells, both limits included.
    GroundAndCells,
    /// Metres in space, the upper limit excluded. The sensor may be outside of the grid.
    Space,
}

impl Compat {
    /// All of them, oldest first.
    pub const ALL: [Self; 5] =
        [Self::Humble, Self::EarlyJazzy, Self::Jazzy, Self::Kilted, Self::Main];

    /// Names that parameters and options take, among them those of other releases with the same
    /// behaviour.
    pub const NAMES: [&str; 8] =
        ["humble", "iron", "jazzy-1.3.10", "jazzy", "kilted", "lyrical", "rolling", "main"];

    /// Number of cells by which the length of a grid is taken shorter than it is, when half of it is put
    /// on either side of the robot: before main, `getSizeInMeters` ended in the middle of the last cell.
    #[must_use]
    pub fn missing_cells(self) -> f64 {
        if self == Self::Main { 0.0 } else { 0.5 }
    }

    /// True if distances to obstacles are rounded to hundredths of a cell before they become costs.
    #[must_use]
    pub fn rounds_distances(self) -> bool {
        self == Self::Main
    }

    /// Measure of the obstacle range of an obstacle layer. Voxel layers always measure in space.
    #[must_use]
    pub fn range_measure(self) -> RangeMeasure {
        match self {
            Self::Humble => RangeMeasure::Cells,
            Self::EarlyJazzy | Self::Kilted => RangeMeasure::Space,
            Self::Jazzy | Self::Main => RangeMeasure::GroundAndCells,
        }
    }

    /// True if 99 in a map is an inscribed cell.
    #[must_use]
    pub fn knows_inscribed_maps(self) -> bool {
        self == Self::Main
    }

    /// True if the corners of an area to clear are computed without bounds and then clamped to the grid;
    /// the other releases enforce the bounds of the grid on the points.
    #[must_use]
    pub fn clamps_cleared_areas(self) -> bool {
        self >= Self::Kilted
    }

    /// True if clear services take the names of layers and answer `success`.
    #[must_use]
    pub fn clears_by_name(self) -> bool {
        self == Self::Main
    }

    /// True if there is a service that clears around a pose.
    #[must_use]
    pub fn clears_around_poses(self) -> bool {
        matches!(self, Self::EarlyJazzy | Self::Jazzy | Self::Main)
    }

    /// True if the cost service takes several poses in any frame (`GetCosts`).
    #[must_use]
    pub fn answers_several_costs(self) -> bool {
        self >= Self::Kilted
    }

    /// True if relative topics of layers are resolved beside the costmap's namespace, not in it.
    #[must_use]
    pub fn joins_parent_namespace(self) -> bool {
        self >= Self::Kilted
    }

    /// True if a static layer can restore the cells that it cleared under the robot.
    #[must_use]
    pub fn restores_cleared_footprint(self) -> bool {
        self >= Self::Kilted
    }

    /// True if `restore_cleared_footprint` can only be set while the footprint is cleared.
    #[must_use]
    pub fn guards_restore_parameter(self) -> bool {
        self == Self::Main
    }

    /// True if the update after one of the whole map (a reset, another footprint) only concerns what is
    /// new then; the other releases inflate the bounds of that first update once more.
    #[must_use]
    pub fn forgets_bounds_when_redone(self) -> bool {
        matches!(self, Self::Jazzy | Self::Main)
    }

    /// True if the static layer of a rolling costmap asks for the window around the robot; the other
    /// releases ask for the area of the map.
    #[must_use]
    pub fn follows_robot_with_map(self) -> bool {
        matches!(self, Self::Jazzy | Self::Main)
    }

    /// True if a voxel layer ignores points below `min_obstacle_height`.
    #[must_use]
    pub fn has_lowest_voxel_height(self) -> bool {
        self != Self::Humble
    }

    /// True if rays of a voxel layer that are cut at the edge of the grid end a little inside of it.
    #[must_use]
    pub fn shortens_cut_rays(self) -> bool {
        self != Self::Humble
    }

    /// True if observation layers have combination method 2, and take unknown methods as 1. In Humble
    /// such a layer writes nothing.
    #[must_use]
    pub fn knows_max_of_known(self) -> bool {
        self != Self::Humble
    }

    /// True if each observation is dropped by its own age; the other releases drop the first one that is
    /// too old together with all that came before it.
    #[must_use]
    pub fn drops_observations_one_by_one(self) -> bool {
        self == Self::Main
    }

    /// Cost of a point outside of the costmap that the single cost service answers, where it differs
    /// from that of a lethal cell.
    #[must_use]
    pub fn cost_outside(self) -> f32 {
        if self.answers_several_costs() { 254.0 } else { -1.0 }
    }

    /// True if a keepout filter can lower the cost of the zone in which the robot is, and enlarges an
    /// update by the area of a new mask.
    #[must_use]
    pub fn updates_keepout_zones(self) -> bool {
        self != Self::Humble
    }

    /// True if `publish_frequency` must stay above 0 while the costmap runs.
    #[must_use]
    pub fn refuses_to_stop_publishing(self) -> bool {
        self == Self::Main
    }

    /// True if a speed filter can look ahead on the path.
    #[must_use]
    pub fn looks_ahead_on_paths(self) -> bool {
        self == Self::Main
    }

    /// True if the layers' own grids are published as well.
    #[must_use]
    pub fn publishes_layers(self) -> bool {
        self != Self::Humble
    }
}

impl fmt::Display for Compat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Humble => "humble",
            Self::EarlyJazzy => "jazzy-1.3.10",
            Self::Jazzy => "jazzy",
            Self::Kilted => "kilted",
            Self::Main => "main",
        })
    }
}

impl FromStr for Compat {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.to_ascii_lowercase().as_str() {
            "humble" | "iron" => Ok(Self::Humble),
            "jazzy-1.3.10" => Ok(Self::EarlyJazzy),
            "jazzy" => Ok(Self::Jazzy),
            "kilted" => Ok(Self::Kilted),
            "main" | "rolling" | "lyrical" => Ok(Self::Main),
            _ => Err(format!("`{text}` is none of `{}`", Self::NAMES.join("`, `"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_read_and_every_release_is_named() {
        for name in Compat::NAMES {
            assert!(name.parse::<Compat>().is_ok(), "{name}");
        }
        for compat in Compat::ALL {
            assert_eq!(compat.to_string().parse(), Ok(compat));
            assert!(Compat::NAMES.contains(&compat.to_string().as_str()));
        }
        assert!("jazzy-1.3.9".parse::<Compat>().unwrap_err().contains("jazzy-1.3.10"));
    }
}
