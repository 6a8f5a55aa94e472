//! Filter masks and the meaning of their values.
//!
//! Source: `nav2_costmap_2d/costmap_filters/filter_values.hpp`, `costmap_filter.cpp`. Unlike the
//! reference, a rotation of the origin is applied.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_grid::{Cell, OccupancyGrid};
use periplus_params::ParamValues;

use crate::UpdateContext;

/// Filter mask.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterMask {
    /// Values.
    pub grid: OccupancyGrid,
    /// Frame of the origin.
    pub frame: String,
}

impl FilterMask {
    /// Returns `mask_from_global`; none without a transform.
    pub(super) fn placed(&self, moment: &UpdateContext<'_>) -> Option<Pose> {
        if self.frame == moment.global_frame {
            return Some(Pose::IDENTITY);
        }
        moment.frames.latest(&self.frame, moment.global_frame)
    }

    /// Returns the cell of a robot at `global_from_base`.
    pub(super) fn cell_of(&self, mask_from_global: Pose, global_from_base: Pose2) -> Option<Cell> {
        let Pose2 { x_m, y_m, .. } = global_from_base;
        let at = mask_from_global.transform_point(DVec3::new(x_m, y_m, 0.0));
        self.grid.info.cell_of(at.x, at.y)
    }
}

/// Type of a filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FilterKind {
    /// Keepout zones.
    #[default]
    Keepout,
    /// Speed limits in percent of the maximum speed.
    SpeedPercent,
    /// Speed limits \[m/s\].
    SpeedAbsolute,
    /// Zones that switch a state.
    Binary,
}

impl FilterKind {
    /// Converts the `type` of `nav2_msgs/CostmapFilterInfo`.
    #[must_use]
    pub fn from_number(number: u8) -> Option<Self> {
        [Self::Keepout, Self::SpeedPercent, Self::SpeedAbsolute, Self::Binary]
            .get(usize::from(number))
            .copied()
    }
}

/// Meaning of mask values: `base + multiplier * value`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterInfo {
    /// Type of the filter.
    pub kind: FilterKind,
    /// Offset.
    pub base: f64,
    /// Factor.
    pub multiplier: f64,
}

impl Default for FilterInfo {
    fn default() -> Self {
        Self { kind: FilterKind::Keepout, base: 0.0, multiplier: 1.0 }
    }
}

impl FilterInfo {
    /// Converts a mask value.
    #[must_use]
    pub fn value(&self, number: i8) -> f64 {
        self.base + f64::from(number) * self.multiplier
    }
}

/// Filter with a mask.
pub trait MaskFilter {
    /// Sets the meaning of the mask values.
    fn set_info(&mut self, info: FilterInfo);

    /// Sets the mask.
    fn set_mask(&mut self, mask: FilterMask);
}

/// Error of a filter whose filter info has a wrong type or wrong values.
pub(super) fn filter_info_error(name: &str, values: &ParamValues, what: &str) -> Diagnostic {
    Diagnostic::error("filter-info", format!("filter `{name}`: {what}"))
        .at(values.origin("filter_info_topic"))
}
