//! Masks, and what their numbers mean.
//!
//! Source: `nav2_costmap_2d/costmap_filters/filter_values.hpp`, `costmap_filter.cpp`. Unlike there, a
//! mask whose origin is turned lies as it says.

use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_grid::{Cell, OccupancyGrid};

use crate::Moment;

/// A mask.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    /// Its cells.
    pub grid: OccupancyGrid,
    /// The frame in which they lie.
    pub frame: String,
}

impl Mask {
    /// `mask_from_global`; none when nobody knows.
    pub(super) fn placed(&self, moment: &Moment<'_>) -> Option<Pose> {
        if self.frame == moment.global_frame {
            return Some(Pose::IDENTITY);
        }
        moment.frames.latest(&self.frame, moment.global_frame)
    }

    /// The cell in which a robot at `global_from_base` is.
    pub(super) fn cell_of(&self, mask_from_global: Pose, global_from_base: Pose2) -> Option<Cell> {
        let Pose2 { x_m, y_m, .. } = global_from_base;
        let at = mask_from_global.transform_point(DVec3::new(x_m, y_m, 0.0));
        self.grid.info.cell_of(at.x, at.y)
    }
}

/// What a mask is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FilterKind {
    /// Where not to go.
    #[default]
    Keepout,
    /// How fast to go, in percent of the most.
    SpeedPercent,
    /// How fast to go \[m/s\].
    SpeedAbsolute,
    /// Where something is to be switched.
    Binary,
}

impl FilterKind {
    /// By the number in `nav2_msgs/CostmapFilterInfo`.
    #[must_use]
    pub fn from_number(number: u8) -> Option<Self> {
        [Self::Keepout, Self::SpeedPercent, Self::SpeedAbsolute, Self::Binary]
            .get(usize::from(number))
            .copied()
    }
}

/// What the numbers of a mask mean: `base + multiplier * number`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterInfo {
    /// What the mask is for.
    pub kind: FilterKind,
    /// What 0 means.
    pub base: f64,
    /// What one more means.
    pub multiplier: f64,
}

impl Default for FilterInfo {
    fn default() -> Self {
        Self { kind: FilterKind::Keepout, base: 0.0, multiplier: 1.0 }
    }
}

impl FilterInfo {
    /// What a number of the mask means.
    #[must_use]
    pub fn value(&self, number: i8) -> f64 {
        self.base + f64::from(number) * self.multiplier
    }
}

/// What follows a mask.
pub trait Masked {
    /// Takes in what the numbers of the mask mean.
    fn set_info(&mut self, info: FilterInfo);

    /// Takes in a mask.
    fn set_mask(&mut self, mask: Mask);
}
