//! Plugin container layer: layers with a separate grid.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/plugin_container_layer.cpp`. As in the reference,
//! an update does not reset the grid: a cost that a layer wrote by maximum stays until the layer
//! lowers it by another combination method, or until it is cleared.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, GridInfo};
use periplus_params::ParamValues;

use crate::clear::clear_cells;
use crate::cost::UNKNOWN;
use crate::layer::is_settled;
use crate::tables::ContainerLayerParams;
use crate::{
    CellWindow, ChangeError, Combination, Costmap, Explanation, Footprint, Layer, Nav2Release,
    UpdateBounds, UpdateContext,
};

/// Layers with a separate grid, combined into the costmap together.
pub struct ContainerLayer {
    name: String,
    values: ParamValues,
    is_enabled: bool,
    combination: Combination,
    grid: Costmap,
    children: Vec<Box<dyn Layer>>,
    is_waiting: bool,
}

impl ContainerLayer {
    /// Creates the layer from parameters of [`crate::tables::CONTAINER`]. The names of its layers
    /// have the name of the container and a dot as prefix.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        values: ParamValues,
        children: Vec<Box<dyn Layer>>,
    ) -> Self {
        let mut layer = Self {
            name: name.into(),
            values: values.clone(),
            is_enabled: true,
            combination: Combination::Max,
            grid: Costmap::empty(UNKNOWN),
            children,
            is_waiting: false,
        };
        layer.take(values);
        layer
    }

    fn take(&mut self, values: ParamValues) {
        let params = ContainerLayerParams::from_values(&values);
        self.is_enabled = params.layer.is_enabled;
        self.combination = Combination::from_number(params.combination.method);
        self.values = values;
    }
}

impl Layer for ContainerLayer {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        if moment.is_rolling {
            self.grid.roll_around(moment.robot, moment.compat);
        }
        for child in &mut self.children {
            child.bounds(moment, bounds);
        }
    }

    fn costs(&mut self, moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        if !self.is_enabled {
            return;
        }
        for child in &mut self.children {
            child.costs(moment, &mut self.grid, window);
        }
        self.combination.apply(master, &self.grid, &window);
        self.is_waiting = false;
    }

    fn reset(&mut self) {
        for child in &mut self.children {
            child.reset();
        }
        self.grid.reset();
        self.is_waiting = true;
    }

    fn is_clearable(&self) -> bool {
        self.children.iter().any(|child| child.is_clearable())
    }

    fn clear_area(
        &mut self,
        start: (i64, i64),
        end: (i64, i64),
        invert: bool,
        compat: Nav2Release,
    ) {
        clear_cells(&mut self.grid, start, end, invert, compat);
        for child in self.children.iter_mut().filter(|child| child.is_clearable()) {
            child.clear_area(start, end, invert, compat);
        }
        self.is_waiting = true;
    }

    fn footprint_changed(&mut self, footprint: &Footprint) {
        for child in &mut self.children {
            child.footprint_changed(footprint);
        }
    }

    fn resized(&mut self, info: &GridInfo, is_rolling: bool) {
        self.grid.resize(*info);
        for child in &mut self.children {
            child.resized(info, is_rolling);
        }
    }

    fn requested_grid_info(&self, current: &GridInfo, is_size_locked: bool) -> Option<GridInfo> {
        self.children.iter().find_map(|child| child.requested_grid_info(current, is_size_locked))
    }

    fn is_enabled(&self) -> bool {
        self.is_enabled
    }

    fn is_current(&self, now_ns: i64) -> bool {
        !self.is_waiting && self.children.iter().all(|child| is_settled(&**child, now_ns))
    }

    fn grid(&self) -> Option<&Costmap> {
        Some(&self.grid)
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        if values.get("plugins") != self.values.get("plugins") {
            return Err(ChangeError::Fixed("plugins"));
        }
        self.take(values);
        Ok(())
    }

    fn children(&self) -> &[Box<dyn Layer>] {
        &self.children
    }

    fn children_mut(&mut self) -> &mut [Box<dyn Layer>] {
        &mut self.children
    }

    fn explain(&self, _master: &Costmap, cell: Cell, is_rolling: bool) -> Explanation {
        let within = self
            .children
            .iter()
            .map(|child| (child.name().to_owned(), child.explain(&self.grid, cell, is_rolling)));
        Explanation {
            value: self.grid.cost(cell),
            reason: Some("the combined layers of the container".to_owned()),
            within: within.collect(),
            ..Explanation::default()
        }
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        self.children.iter_mut().flat_map(|child| child.diagnostics()).collect()
    }
}
