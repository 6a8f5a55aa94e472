//! Binary filter: zones that switch a state.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/costmap_filters/binary_filter.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_params::ParamValues;

use super::mask::filter_info_error;
use super::{FilterInfo, FilterKind, FilterMask, MaskFilter};
use crate::{CellWindow, Costmap, Layer, UpdateBounds, UpdateContext};

/// Filter that publishes a state by the mask value at the robot.
pub struct BinaryFilter {
    name: String,
    values: ParamValues,
    is_enabled: bool,
    default_state: bool,
    info: Option<FilterInfo>,
    mask: Option<FilterMask>,
    state: bool,
    outgoing: Option<bool>,
    diagnostics: Vec<Diagnostic>,
}

impl BinaryFilter {
    /// Creates the filter from parameters of [`crate::tables::BINARY`]. The default state is
    /// published at startup.
    #[must_use]
    pub fn new(name: impl Into<String>, values: ParamValues) -> Self {
        let default_state = values.flag("default_state").unwrap_or_default();
        Self {
            name: name.into(),
            is_enabled: values.flag("enabled").unwrap_or_default(),
            values,
            default_state,
            info: None,
            mask: None,
            state: default_state,
            outgoing: Some(default_state),
            diagnostics: Vec::new(),
        }
    }

    /// Returns the state.
    #[must_use]
    pub fn state(&self) -> bool {
        self.state
    }

    /// Takes the state to publish, if it has changed.
    pub fn take_state(&mut self) -> Option<bool> {
        self.outgoing.take()
    }

    fn change(&mut self, state: bool) {
        self.state = state;
        self.outgoing = Some(state);
    }
}

impl MaskFilter for BinaryFilter {
    fn set_info(&mut self, info: FilterInfo) {
        if info.kind == FilterKind::Binary {
            self.info = Some(info);
        } else {
            let what = format!("the mask is for {:?}", info.kind);
            let error = filter_info_error(&self.name, &self.values, &what);
            self.diagnostics.push(error.help("publish type 3 (binary)"));
        }
    }

    fn set_mask(&mut self, mask: FilterMask) {
        self.mask = Some(mask);
    }
}

impl Layer for BinaryFilter {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, _moment: &UpdateContext<'_>, _bounds: &mut UpdateBounds) {}

    fn costs(&mut self, moment: &UpdateContext<'_>, _master: &mut Costmap, _window: CellWindow) {
        let (Some(mask), Some(info)) = (&self.mask, &self.info) else { return };
        if !self.is_enabled {
            return;
        }
        let Some(mask_from_global) = mask.placed(moment) else { return };
        let Some(cell) = mask.cell_of(mask_from_global, moment.robot) else {
            if self.state != self.default_state {
                self.change(self.default_state);
            }
            return;
        };
        let number = mask.grid[cell];
        if number == periplus_grid::occupancy::UNKNOWN {
            return;
        }
        let threshold = self.values.number("flip_threshold").unwrap_or_default();
        let state = (info.value(number) > threshold) != self.default_state;
        if state != self.state {
            self.change(state);
        }
    }

    fn reset(&mut self) {
        self.change(self.default_state);
    }

    fn is_enabled(&self) -> bool {
        self.is_enabled
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), String> {
        self.is_enabled = values.flag("enabled").unwrap_or_default();
        self.default_state = values.flag("default_state").unwrap_or_default();
        self.values = values;
        Ok(())
    }

    fn masked(&mut self) -> Option<&mut dyn MaskFilter> {
        Some(self)
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }
}
