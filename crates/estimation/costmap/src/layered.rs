//! Layered costmap: ordered layers and the update cycle.
//!
//! Source of the cycle: `nav2_costmap_2d/src/layered_costmap.cpp`.

use std::any::Any;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo};

use crate::cost::{FREE, UNKNOWN};
use crate::layer::is_settled;
use crate::tables::CostmapParams;
use crate::{
    CellWindow, Costmap, Footprint, Layer, Nav2Release, TransformSource, UpdateBounds,
    UpdateContext,
};

/// Settings shared by all layers.
#[derive(Clone, Debug, PartialEq)]
pub struct CostmapSettings {
    /// Frame of the costmap.
    pub global_frame: String,
    /// True if the costmap moves with the robot.
    pub is_rolling: bool,
    /// True if unobserved cells are unknown, false if they are free.
    pub tracks_unknown: bool,
    /// Release of Nav2 whose behaviour is used.
    pub compat: Nav2Release,
}

impl Default for CostmapSettings {
    fn default() -> Self {
        let params = CostmapParams::default();
        Self::new(&params, params.compat)
    }
}

impl CostmapSettings {
    /// Converts the parameters of a costmap; `compat` overrides theirs.
    #[must_use]
    pub fn new(params: &CostmapParams, compat: Nav2Release) -> Self {
        Self {
            global_frame: params.global_frame.clone(),
            is_rolling: params.rolling_window,
            tracks_unknown: params.track_unknown_space,
            compat,
        }
    }
}

/// Costmap made of layers.
pub struct LayeredCostmap {
    frame: CostmapSettings,
    /// Result of the layers. Without filters this is the costmap.
    primary: Costmap,
    /// Result with filters, separate so that no layer sees the effect of a filter.
    combined: Option<Costmap>,
    layers: Vec<Box<dyn Layer>>,
    filters: Vec<Box<dyn Layer>>,
    footprint: Footprint,
    is_size_locked: bool,
    is_initialized: bool,
    was_outside: bool,
    diagnostics: Vec<Diagnostic>,
}

impl LayeredCostmap {
    /// Creates a costmap without layers.
    #[must_use]
    pub fn new(frame: CostmapSettings, info: GridInfo) -> Self {
        let default_cost = if frame.tracks_unknown { UNKNOWN } else { FREE };
        Self {
            frame,
            primary: Costmap::new(info, default_cost),
            combined: None,
            layers: Vec::new(),
            filters: Vec::new(),
            footprint: Footprint::default(),
            is_size_locked: false,
            is_initialized: false,
            was_outside: false,
            diagnostics: Vec::new(),
        }
    }

    /// Adds a layer on top of the others.
    pub fn add_layer(&mut self, mut layer: Box<dyn Layer>) {
        self.initialize_layer(&mut *layer);
        self.layers.push(layer);
    }

    /// Adds a filter on top of the layers and other filters.
    pub fn add_filter(&mut self, mut filter: Box<dyn Layer>) {
        self.initialize_layer(&mut *filter);
        self.filters.push(filter);
        self.combined.get_or_insert_with(|| self.primary.clone());
    }

    fn initialize_layer(&self, layer: &mut dyn Layer) {
        layer.resized(self.primary.info(), self.frame.is_rolling);
        if !self.footprint.points().is_empty() {
            layer.footprint_changed(&self.footprint);
        }
    }

    /// Returns the costs.
    #[must_use]
    pub fn costmap(&self) -> &Costmap {
        self.combined.as_ref().unwrap_or(&self.primary)
    }

    /// Returns the costs for manual changes. The next update overwrites the cells of its window.
    #[must_use]
    pub fn costmap_mut(&mut self) -> &mut Costmap {
        self.combined.as_mut().unwrap_or(&mut self.primary)
    }

    /// Returns the settings shared by all layers.
    #[must_use]
    pub fn frame(&self) -> &CostmapSettings {
        &self.frame
    }

    /// Returns the padded footprint of the robot.
    #[must_use]
    pub fn footprint(&self) -> &Footprint {
        &self.footprint
    }

    /// Returns true if an update has been made.
    #[must_use]
    pub fn is_initialized(&self) -> bool {
        self.is_initialized
    }

    /// Returns true if a map has set the size.
    #[must_use]
    pub fn is_size_locked(&self) -> bool {
        self.is_size_locked
    }

    /// Returns true if all enabled layers are current.
    #[must_use]
    pub fn is_current(&self, now_ns: i64) -> bool {
        self.all().all(|layer| is_settled(layer, now_ns))
    }

    /// Sets the footprint, including padding.
    pub fn set_footprint(&mut self, footprint: Footprint) {
        self.footprint = footprint;
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            layer.footprint_changed(&self.footprint);
        }
    }

    /// Replaces the grid. All layers drop their cells.
    pub fn resize(&mut self, info: GridInfo, is_size_locked: bool) {
        self.is_size_locked = is_size_locked;
        self.primary.resize(info);
        if let Some(combined) = &mut self.combined {
            combined.resize(info);
        }
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            layer.resized(self.primary.info(), self.frame.is_rolling);
        }
    }

    /// Applies the size of a received map. Updates do this first; an earlier call makes the size
    /// visible before the first update.
    pub fn apply_requested_size(&mut self) {
        // A rolling costmap keeps its size.
        if self.frame.is_rolling {
            return;
        }
        let wanted = self
            .layers
            .iter()
            .find_map(|layer| layer.requested_grid_info(self.primary.info(), self.is_size_locked));
        if let Some(info) = wanted {
            self.resize(info, true);
        }
    }

    /// Returns the layers, lowest first.
    #[must_use]
    pub fn layers(&self) -> &[Box<dyn Layer>] {
        &self.layers
    }

    /// Returns the filters, lowest first.
    #[must_use]
    pub fn filters(&self) -> &[Box<dyn Layer>] {
        &self.filters
    }

    /// Iterates over layers, layers of containers, and filters.
    pub fn all(&self) -> impl Iterator<Item = &dyn Layer> {
        let mut found: Vec<&dyn Layer> = Vec::new();
        for layer in self.layers.iter().chain(&self.filters) {
            collect(&**layer, &mut found);
        }
        found.into_iter()
    }

    /// Iterates over mutable layers and filters, without those of containers.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut dyn Layer> {
        self.layers.iter_mut().chain(&mut self.filters).map(|layer| &mut **layer)
    }

    /// Returns a layer or filter by its name; layers of a container have names such as
    /// `container.child`.
    #[must_use]
    pub fn find_mut(&mut self, name: &str) -> Option<&mut dyn Layer> {
        self.layers.iter_mut().chain(&mut self.filters).find_map(|layer| find(&mut **layer, name))
    }

    /// Returns a layer or filter of a type by its name.
    #[must_use]
    pub fn find_as<L: Layer + 'static>(&mut self, name: &str) -> Option<&mut L> {
        (self.find_mut(name)? as &mut dyn Any).downcast_mut()
    }

    /// Updates the costs where a layer has changed, and returns that window.
    pub fn update(
        &mut self,
        now_ns: i64,
        global_from_base: Pose2,
        frames: &dyn TransformSource,
    ) -> Option<CellWindow> {
        self.apply_requested_size();
        if self.frame.is_rolling {
            self.primary.roll_around(global_from_base, self.frame.compat);
            if let Some(combined) = &mut self.combined {
                combined.roll_around(global_from_base, self.frame.compat);
            }
        }
        self.check_robot_inside(global_from_base);
        let (info, footprint) = (*self.primary.info(), &self.footprint);
        let moment = moment_of(&self.frame, info, footprint, now_ns, global_from_base, frames);
        let mut bounds = UpdateBounds::EMPTY;
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            let before = bounds;
            layer.bounds(&moment, &mut bounds);
            if !bounds.contains(&before) {
                self.diagnostics.push(shrunk(layer.name(), &before, &bounds));
            }
        }
        let window = self.primary.window_of(&bounds)?;
        self.primary.reset_window(&window);
        for layer in &mut self.layers {
            layer.costs(&moment, &mut self.primary, window);
        }
        if let Some(combined) = &mut self.combined {
            combined.copy_window(&self.primary, &window);
            for filter in &mut self.filters {
                filter.costs(&moment, combined, window);
            }
        }
        self.is_initialized = true;
        Some(window)
    }

    /// Writes the costs of one layer into a window. Returns false when there is no such layer.
    pub fn apply_layer(
        &mut self,
        name: &str,
        window: CellWindow,
        now_ns: i64,
        global_from_base: Pose2,
        frames: &dyn TransformSource,
    ) -> bool {
        let (info, footprint) = (*self.primary.info(), &self.footprint);
        let moment = moment_of(&self.frame, info, footprint, now_ns, global_from_base, frames);
        let Some(layer) = self.layers.iter_mut().find_map(|layer| find(&mut **layer, name)) else {
            return false;
        };
        let master = self.combined.as_mut().unwrap_or(&mut self.primary);
        layer.costs(&moment, master, window.intersection(&CellWindow::all(&info)));
        true
    }

    fn check_robot_inside(&mut self, global_from_base: Pose2) {
        let Pose2 { x_m, y_m, .. } = global_from_base;
        let is_outside = self.primary.info().cell_of(x_m, y_m).is_none();
        if is_outside && !self.was_outside {
            let UpdateBounds { min_x, min_y, max_x, max_y } = UpdateBounds::of(self.primary.info());
            self.diagnostics.push(
                Diagnostic::warning(
                    "robot-outside",
                    format!("the robot at ({x_m:.2}, {y_m:.2}) is out of bounds of the costmap"),
                )
                .note(format!(
                    "the costmap covers ({min_x:.2}, {min_y:.2}) to ({max_x:.2}, {max_y:.2})"
                ))
                .help("let it move with the robot (`rolling_window: true`), or set `origin_x`, `origin_y`, `width` and `height`"),
            );
        }
        self.was_outside = is_outside;
    }

    /// Resets all layers and filters, and the costs.
    pub fn reset(&mut self) {
        self.primary.reset();
        if let Some(combined) = &mut self.combined {
            combined.reset();
        }
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            layer.reset();
        }
    }

    /// Resets the resulting costs; layers keep their data.
    pub fn reset_costs(&mut self) {
        self.primary.reset();
        if let Some(combined) = &mut self.combined {
            combined.reset();
        }
    }

    /// Takes the warnings since the last call.
    pub fn diagnostics(&mut self) -> Diagnostics {
        let mut diagnostics = Diagnostics::new();
        diagnostics.extend(self.diagnostics.drain(..));
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            diagnostics.extend(layer.diagnostics());
        }
        diagnostics
    }

    /// Returns the cost at a point of the global frame \[m\]; with `uses_footprint` the highest
    /// cost on the outline at that pose. Points outside are lethal.
    #[must_use]
    pub fn cost_at(&self, global_from_base: Pose2, uses_footprint: bool) -> u8 {
        if uses_footprint {
            return self.footprint.cost(self.costmap(), global_from_base);
        }
        let Pose2 { x_m, y_m, .. } = global_from_base;
        self.costmap().cost_at(x_m, y_m).unwrap_or(crate::cost::LETHAL)
    }

    /// Returns the cell of a point of the global frame \[m\].
    #[must_use]
    pub fn cell_of(&self, x_m: f64, y_m: f64) -> Option<Cell> {
        self.primary.info().cell_of(x_m, y_m)
    }
}

fn moment_of<'a>(
    frame: &'a CostmapSettings,
    info: GridInfo,
    footprint: &'a Footprint,
    now_ns: i64,
    robot: Pose2,
    frames: &'a dyn TransformSource,
) -> UpdateContext<'a> {
    UpdateContext {
        now_ns,
        robot,
        footprint,
        info,
        is_rolling: frame.is_rolling,
        compat: frame.compat,
        global_frame: &frame.global_frame,
        frames,
    }
}

fn shrunk(layer: &str, before: &UpdateBounds, after: &UpdateBounds) -> Diagnostic {
    Diagnostic::warning(
        "shrunk-bounds",
        format!("layer `{layer}` made the bounds of an update smaller"),
    )
    .note(format!("they were {before:?} and became {after:?}"))
    .help("`bounds` of a layer may only enlarge what it is given")
}

fn collect<'a>(layer: &'a dyn Layer, found: &mut Vec<&'a dyn Layer>) {
    found.push(layer);
    for child in layer.children() {
        collect(&**child, found);
    }
}

fn find<'a>(layer: &'a mut dyn Layer, name: &str) -> Option<&'a mut dyn Layer> {
    if layer.name() == name {
        return Some(layer);
    }
    layer.children_mut().iter_mut().find_map(|child| find(&mut **child, name))
}
