//! Keepout filter: forbidden zones.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/costmap_filters/keepout_filter.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose};
use periplus_grid::{Cell, GridInfo};
use periplus_params::ParamValues;

use super::mask::filter_info_error;
use super::{FilterInfo, FilterKind, FilterMask, MaskFilter};
use crate::cost::{INSCRIBED, LETHAL, UNKNOWN, cost_of};
use crate::tables::KeepoutFilterParams;
use crate::{CellWindow, ChangeError, Costmap, Explanation, Layer, UpdateBounds, UpdateContext};

/// Filter that raises costs to those of a mask.
pub struct KeepoutFilter {
    name: String,
    values: ParamValues,
    is_enabled: bool,
    /// Cost of zones while the robot is inside one, if `override_lethal_cost` is set.
    leaving_cost: Option<u8>,
    mask: Option<FilterMask>,
    /// True if the whole mask must be written in the next update.
    has_changed: bool,
    was_inside: bool,
    was_lost: bool,
    diagnostics: Vec<Diagnostic>,
}

impl KeepoutFilter {
    /// Creates the filter from parameters of [`crate::tables::KEEPOUT`].
    #[must_use]
    pub fn new(name: impl Into<String>, values: ParamValues) -> Self {
        let mut filter = Self {
            name: name.into(),
            values: values.clone(),
            is_enabled: true,
            leaving_cost: None,
            mask: None,
            has_changed: false,
            was_inside: false,
            was_lost: false,
            diagnostics: Vec::new(),
        };
        filter.take(values);
        filter
    }

    fn take(&mut self, values: ParamValues) {
        let params = KeepoutFilterParams::from_values(&values);
        self.is_enabled = params.filter.is_enabled;
        let cost = params.lethal_override_cost;
        // Negative values wrap to large unsigned ones before they are limited.
        let cost = if (0..=252).contains(&cost) { cost as u8 } else { 252 };
        self.leaving_cost = params.override_lethal_cost.then_some(cost);
        self.values = values;
        self.has_changed = true;
    }

    fn wrong(&self, what: &str) -> Diagnostic {
        filter_info_error(&self.name, &self.values, what)
            .help("check the node that publishes the filter info")
    }

    /// Returns true if a mask was received.
    #[must_use]
    pub fn has_mask(&self) -> bool {
        self.mask.is_some()
    }

    /// Returns true if the robot is inside a zone.
    fn is_inside(&self, moment: &UpdateContext<'_>) -> bool {
        let Some(mask) = &self.mask else { return false };
        let Some(mask_from_global) = mask.placed(moment) else { return false };
        mask.cell_of(mask_from_global, moment.robot)
            .is_some_and(|cell| matches!(cost_of(mask.grid[cell]), INSCRIBED | LETHAL))
    }
}

/// Returns the bounding box of a mask in the global frame.
fn bounds_of(mask: &FilterMask, mask_from_global: Pose) -> UpdateBounds {
    let global_from_mask = mask_from_global.inverse();
    let GridInfo { width, height, .. } = mask.grid.info;
    let mut bounds = UpdateBounds::EMPTY;
    for (column, row) in [(0, 0), (width, 0), (0, height), (width, height)] {
        let (x_m, y_m) = mask.grid.info.point_at(column as f64, row as f64);
        let at = global_from_mask.transform_point(DVec3::new(x_m, y_m, 0.0));
        bounds.touch(at.x, at.y);
    }
    bounds
}

impl MaskFilter for KeepoutFilter {
    fn set_info(&mut self, info: FilterInfo) {
        let plain = FilterInfo::default();
        if info.kind != FilterKind::Keepout {
            self.diagnostics.push(self.wrong(&format!("the mask is for {:?}", info.kind)));
        }
        if (info.base, info.multiplier) != (plain.base, plain.multiplier) {
            self.diagnostics.push(self.wrong(&format!(
                "base is {} and multiplier {}, and must be 0 and 1; the mask is used unchanged",
                info.base, info.multiplier
            )));
        }
    }

    fn set_mask(&mut self, mask: FilterMask) {
        self.mask = Some(mask);
        self.has_changed = true;
    }
}

impl Layer for KeepoutFilter {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        if !self.is_enabled || !moment.compat.updates_keepout_zones() {
            return;
        }
        if self.leaving_cost.is_some() {
            let is_inside = self.is_inside(moment);
            self.has_changed |= is_inside != self.was_inside;
            self.was_inside = is_inside;
        }
        if let Some(mask) = &self.mask
            && self.has_changed
            && let Some(mask_from_global) = mask.placed(moment)
        {
            bounds.include(&bounds_of(mask, mask_from_global));
            self.has_changed = false;
        }
    }

    fn costs(&mut self, moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        let Some(mask) = self.mask.as_ref().filter(|_| self.is_enabled) else { return };
        let Some(mask_from_global) = mask.placed(moment) else {
            if !std::mem::replace(&mut self.was_lost, true) {
                self.diagnostics.push(
                    Diagnostic::error(
                        "no-transform",
                        format!(
                            "filter `{}` has no transform from `{}` to `{}`, the frame of its mask",
                            self.name, moment.global_frame, mask.frame
                        ),
                    )
                    .help("publish the transform; until then the keepout zones have no effect"),
                );
            }
            return;
        };
        self.was_lost = false;
        let zone_cost = self
            .leaving_cost
            .filter(|_| moment.compat.updates_keepout_zones() && self.is_inside(moment));
        let info = *master.info();
        let finder = mask.grid.info.finder();
        // Only the cells of the mask.
        let near = master.window_of(&bounds_of(mask, mask_from_global));
        let window = window.intersection(&near.unwrap_or_default());
        for y in window.y0..window.yn {
            for x in window.x0..window.xn {
                let (wx, wy) = info.centre_of((x, y));
                let at = mask_from_global.transform_point(DVec3::new(wx, wy, 0.0));
                let Some(cell) = finder.cell_of(at.x, at.y) else { continue };
                let cost = cost_of(mask.grid[cell]);
                let index = y * info.width + x;
                let old = master.costs()[index];
                if cost != UNKNOWN && (cost > old || old == UNKNOWN) {
                    master.costs_mut()[index] = zone_cost.unwrap_or(cost);
                }
            }
        }
    }

    fn resized(&mut self, _info: &GridInfo, _is_rolling: bool) {
        self.has_changed = true;
    }

    fn reset(&mut self) {
        self.has_changed = true;
    }

    fn is_enabled(&self) -> bool {
        self.is_enabled
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        self.take(values);
        Ok(())
    }

    fn explain(&self, master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        let Some(mask) = &self.mask else {
            return Explanation {
                reason: Some("no mask was received".to_owned()),
                parameter: Some(format!("{}.filter_info_topic", self.name)),
                ..Explanation::default()
            };
        };
        let (x_m, y_m) = master.info().centre_of(cell);
        // Transforms are available in updates only; most masks are in the frame of the costmap.
        let number = mask.grid.at(x_m, y_m);
        Explanation {
            value: number.map(|number| cost_of(*number)),
            reason: number
                .map(|number| format!("the mask (frame `{}`) has the value {number}", mask.frame)),
            ..Explanation::default()
        }
    }

    fn masked(&mut self) -> Option<&mut dyn MaskFilter> {
        Some(self)
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }
}
