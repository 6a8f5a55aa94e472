//! Binary filter: zones that switch a state.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/costmap_filters/binary_filter.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_params::ParamValues;

use super::mask::filter_info_error;
use super::{FilterInfo, FilterKind, FilterMask, MaskFilter};
use crate::tables::BinaryFilterParams;
use crate::{CellWindow, ChangeError, Costmap, Layer, UpdateBounds, UpdateContext};

/// Filter that publishes a state by the mask value at the robot.
pub struct BinaryFilter {
    name: String,
    values: ParamValues,
    params: BinaryFilterParams,
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
        let params = BinaryFilterParams::from_values(&values);
        Self {
            name: name.into(),
            values,
            info: None,
            mask: None,
            state: params.default_state,
            outgoing: Some(params.default_state),
            params,
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
        if !self.params.filter.is_enabled {
            return;
        }
        let Some(mask_from_global) = mask.placed(moment) else { return };
        let Some(cell) = mask.cell_of(mask_from_global, moment.robot) else {
            if self.state != self.params.default_state {
                self.change(self.params.default_state);
            }
            return;
        };
        let number = mask.grid[cell];
        if number == periplus_grid::occupancy::UNKNOWN {
            return;
        }
        let threshold = self.params.flip_threshold;
        let state = (info.value(number) > threshold) != self.params.default_state;
        if state != self.state {
            self.change(state);
        }
    }

    fn reset(&mut self) {
        self.change(self.params.default_state);
    }

    fn is_enabled(&self) -> bool {
        self.params.filter.is_enabled
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        self.params = BinaryFilterParams::from_values(&values);
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
