//! Layers over each other, and the update that makes one costmap of them.
//!
//! Source of the cycle: `nav2_costmap_2d/src/layered_costmap.cpp`.

use std::any::Any;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo};

use crate::cost::{FREE, UNKNOWN};
use crate::layer::is_settled;
use crate::{Bounds, Compat, Costmap, Footprint, Frames, Layer, Moment, Window};

/// What holds for all layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The frame of the costmap.
    pub global_frame: String,
    /// Whether the costmap moves with the robot.
    pub is_rolling: bool,
    /// Whether cells of which nothing is known are unknown instead of free.
    pub tracks_unknown: bool,
    /// Whose habits to keep.
    pub compat: Compat,
}

impl Default for Frame {
    fn default() -> Self {
        Self {
            global_frame: "map".to_owned(),
            is_rolling: false,
            tracks_unknown: false,
            compat: Compat::Main,
        }
    }
}

/// A costmap of layers.
pub struct LayeredCostmap {
    frame: Frame,
    /// What the layers give. Without filters this is the costmap.
    primary: Costmap,
    /// With the filters over it. Kept apart so that no layer ever sees what a filter did.
    combined: Option<Costmap>,
    layers: Vec<Box<dyn Layer>>,
    filters: Vec<Box<dyn Layer>>,
    footprint: Footprint,
    is_size_locked: bool,
    is_initialized: bool,
    was_outside: bool,
    complaints: Vec<Diagnostic>,
}

impl LayeredCostmap {
    /// Without layers.
    #[must_use]
    pub fn new(frame: Frame, info: GridInfo) -> Self {
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
            complaints: Vec::new(),
        }
    }

    /// Puts a layer over those that are there.
    pub fn add_layer(&mut self, mut layer: Box<dyn Layer>) {
        self.introduce(&mut *layer);
        self.layers.push(layer);
    }

    /// Puts a filter over all layers and the filters that are there.
    pub fn add_filter(&mut self, mut filter: Box<dyn Layer>) {
        self.introduce(&mut *filter);
        self.filters.push(filter);
        self.combined.get_or_insert_with(|| self.primary.clone());
    }

    fn introduce(&self, layer: &mut dyn Layer) {
        layer.resized(self.primary.info(), self.frame.is_rolling);
        if !self.footprint.points().is_empty() {
            layer.footprint_changed(&self.footprint);
        }
    }

    /// The costs.
    #[must_use]
    pub fn costmap(&self) -> &Costmap {
        self.combined.as_ref().unwrap_or(&self.primary)
    }

    /// The costs, to be changed by hand. The next update overwrites what its window covers.
    #[must_use]
    pub fn costmap_mut(&mut self) -> &mut Costmap {
        self.combined.as_mut().unwrap_or(&mut self.primary)
    }

    /// What holds for all layers.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The outline of the robot, padded.
    #[must_use]
    pub fn footprint(&self) -> &Footprint {
        &self.footprint
    }

    /// Whether an update has been made.
    #[must_use]
    pub fn is_initialized(&self) -> bool {
        self.is_initialized
    }

    /// Whether a map has set the size.
    #[must_use]
    pub fn is_size_locked(&self) -> bool {
        self.is_size_locked
    }

    /// Whether all layers that take part have what they need.
    #[must_use]
    pub fn is_current(&self, now_ns: i64) -> bool {
        self.all().all(|layer| is_settled(layer, now_ns))
    }

    /// Gives the robot an outline, padded already.
    pub fn set_footprint(&mut self, footprint: Footprint) {
        self.footprint = footprint;
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            layer.footprint_changed(&self.footprint);
        }
    }

    /// Takes other cells. All layers forget what they had in theirs.
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

    /// Takes the size of a map that has come, as layers ask for it. Updates do this first; to do it
    /// earlier lets others see the size before the first update.
    pub fn settle_size(&mut self) {
        // A costmap that moves with the robot keeps its own size.
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

    /// The layers, lowest first.
    #[must_use]
    pub fn layers(&self) -> &[Box<dyn Layer>] {
        &self.layers
    }

    /// The filters, lowest first.
    #[must_use]
    pub fn filters(&self) -> &[Box<dyn Layer>] {
        &self.filters
    }

    /// Layers, layers within them, and filters.
    pub fn all(&self) -> impl Iterator<Item = &dyn Layer> {
        let mut found: Vec<&dyn Layer> = Vec::new();
        for layer in self.layers.iter().chain(&self.filters) {
            collect(&**layer, &mut found);
        }
        found.into_iter()
    }

    /// Layers and filters, to be changed; not those within others.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut dyn Layer> {
        self.layers.iter_mut().chain(&mut self.filters).map(|layer| &mut **layer)
    }

    /// A layer or filter by its name; those within others have names such as `container.child`.
    #[must_use]
    pub fn find_mut(&mut self, name: &str) -> Option<&mut dyn Layer> {
        self.layers.iter_mut().chain(&mut self.filters).find_map(|layer| find(&mut **layer, name))
    }

    /// A layer or filter of a type, by its name.
    #[must_use]
    pub fn find_as<L: Layer + 'static>(&mut self, name: &str) -> Option<&mut L> {
        (self.find_mut(name)? as &mut dyn Any).downcast_mut()
    }

    /// Makes the costs anew where something has changed, and says where that is.
    pub fn update(
        &mut self,
        now_ns: i64,
        global_from_base: Pose2,
        frames: &dyn Frames,
    ) -> Option<Window> {
        self.settle_size();
        if self.frame.is_rolling {
            self.primary.roll_around(global_from_base, self.frame.compat);
            if let Some(combined) = &mut self.combined {
                combined.roll_around(global_from_base, self.frame.compat);
            }
        }
        self.watch_robot(global_from_base);
        let (info, footprint) = (*self.primary.info(), &self.footprint);
        let moment = moment_of(&self.frame, info, footprint, now_ns, global_from_base, frames);
        let mut bounds = Bounds::EMPTY;
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            let before = bounds;
            layer.bounds(&moment, &mut bounds);
            if !bounds.contains(&before) {
                self.complaints.push(shrunk(layer.name(), &before, &bounds));
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

    /// Puts the costs of one layer into a window, over what is there. False when there is no such
    /// layer.
    pub fn apply_layer(
        &mut self,
        name: &str,
        window: Window,
        now_ns: i64,
        global_from_base: Pose2,
        frames: &dyn Frames,
    ) -> bool {
        let (info, footprint) = (*self.primary.info(), &self.footprint);
        let moment = moment_of(&self.frame, info, footprint, now_ns, global_from_base, frames);
        let Some(layer) = self.layers.iter_mut().find_map(|layer| find(&mut **layer, name)) else {
            return false;
        };
        let master = self.combined.as_mut().unwrap_or(&mut self.primary);
        layer.costs(&moment, master, window.intersection(&Window::all(&info)));
        true
    }

    fn watch_robot(&mut self, global_from_base: Pose2) {
        let Pose2 { x_m, y_m, .. } = global_from_base;
        let is_outside = self.primary.info().cell_of(x_m, y_m).is_none();
        if is_outside && !self.was_outside {
            let Bounds { min_x, min_y, max_x, max_y } = Bounds::of(self.primary.info());
            self.complaints.push(
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

    /// Puts the default into all cells of the result; layers keep theirs.
    pub fn reset_costs(&mut self) {
        self.primary.reset();
        if let Some(combined) = &mut self.combined {
            combined.reset();
        }
    }

    /// Hands over what there was to complain about since the last time.
    pub fn complaints(&mut self) -> Diagnostics {
        let mut diagnostics = Diagnostics::new();
        diagnostics.extend(self.complaints.drain(..));
        for layer in self.layers.iter_mut().chain(&mut self.filters) {
            diagnostics.extend(layer.complaints());
        }
        diagnostics
    }

    /// The cost at a point of the global frame \[m\]. With the footprint: the highest cost on its
    /// outline at that pose. Outside it is lethal.
    #[must_use]
    pub fn cost_at(&self, global_from_base: Pose2, uses_footprint: bool) -> u8 {
        if uses_footprint {
            return self.footprint.cost(self.costmap(), global_from_base);
        }
        let Pose2 { x_m, y_m, .. } = global_from_base;
        self.costmap().cost_at(x_m, y_m).unwrap_or(crate::cost::LETHAL)
    }

    /// The cell of a point of the global frame \[m\].
    #[must_use]
    pub fn cell_of(&self, x_m: f64, y_m: f64) -> Option<Cell> {
        self.primary.info().cell_of(x_m, y_m)
    }
}

fn moment_of<'a>(
    frame: &'a Frame,
    info: GridInfo,
    footprint: &'a Footprint,
    now_ns: i64,
    robot: Pose2,
    frames: &'a dyn Frames,
) -> Moment<'a> {
    Moment {
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

fn shrunk(layer: &str, before: &Bounds, after: &Bounds) -> Diagnostic {
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
