//! Interface of layers.

use std::any::Any;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose, Pose2};
use periplus_grid::{Cell, GridInfo};
use periplus_params::ParamValues;

use crate::filters::MaskFilter;
use crate::{
    CellWindow, ChangeError, Costmap, Explanation, Footprint, Nav2Release, ObservationSource,
    UpdateBounds,
};

/// Source of transforms.
pub trait TransformSource {
    /// Returns the latest `target_from_source`; none without a transform.
    fn latest(&self, target: &str, source: &str) -> Option<Pose>;
}

/// Transforms of a single frame: only the identity of each frame to itself is known.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoTransforms;

impl TransformSource for NoTransforms {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        (target == source).then_some(Pose::IDENTITY)
    }
}

impl<F: Fn(&str, &str) -> Option<Pose>> TransformSource for F {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        self(target, source)
    }
}

/// Context of an update.
#[derive(Clone, Copy)]
pub struct UpdateContext<'a> {
    /// Time \[ns\].
    pub now_ns: i64,
    /// Pose of the robot, `global_from_base`.
    pub robot: Pose2,
    /// Padded footprint of the robot.
    pub footprint: &'a Footprint,
    /// Resolution, size and origin of the costmap.
    pub info: GridInfo,
    /// True if the costmap moves with the robot.
    pub is_rolling: bool,
    /// Release of Nav2 whose behaviour is used.
    pub compat: Nav2Release,
    /// Frame of the costmap.
    pub global_frame: &'a str,
    /// Source of transforms.
    pub frames: &'a dyn TransformSource,
}

/// A layer of a costmap, or a filter.
/// An update calls [`Layer::bounds`] of all layers in order, and then [`Layer::costs`] of all
/// layers with the resulting window. The cells of `master` are a slice of bytes in row-major order
/// ([`Costmap::costs_mut`]).
pub trait Layer: Any + Send {
    /// Returns the name, which is also the prefix of its parameters.
    fn name(&self) -> &str;

    /// Processes new data and enlarges the bounds by the area that has changed. The bounds must not
    /// shrink (`updateBounds`).
    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds);

    /// Writes costs into the window, over those of lower layers. Cells outside the window must not
    /// change (`updateCosts`).
    fn costs(&mut self, moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow);

    /// Drops all data.
    fn reset(&mut self) {}

    /// Returns true if clear services apply to the layer.
    fn is_clearable(&self) -> bool {
        false
    }

    /// Clears the cells strictly between `start` and `end`, or with `invert` all others.
    fn clear_area(
        &mut self,
        _start: (i64, i64),
        _end: (i64, i64),
        _invert: bool,
        _compat: Nav2Release,
    ) {
    }

    /// Notifies of a new footprint (`onFootprintChanged`).
    fn footprint_changed(&mut self, _footprint: &Footprint) {}

    /// Notifies of a new grid, which replaces the old cells (`matchSize`).
    fn resized(&mut self, _info: &GridInfo, _is_rolling: bool) {}

    /// Returns the grid that the layer requests for the costmap (that of a map).
    fn requested_grid_info(&self, _current: &GridInfo, _is_size_locked: bool) -> Option<GridInfo> {
        None
    }

    /// Returns true if the layer is enabled.
    fn is_enabled(&self) -> bool {
        true
    }

    /// Returns true if the layer has current data.
    fn is_current(&self, _now_ns: i64) -> bool {
        true
    }

    /// Returns the grid of the layer, if it has one.
    fn grid(&self) -> Option<&Costmap> {
        None
    }

    /// Returns the current parameters.
    fn values(&self) -> Option<&ParamValues> {
        None
    }

    /// Sets parameters of valid types and ranges.
    /// # Errors
    /// The reason for which they cannot be set; no change is made then.
    fn configure(&mut self, _values: ParamValues) -> Result<(), ChangeError> {
        Ok(())
    }

    /// Returns the observation sources.
    fn sources(&self) -> &[ObservationSource] {
        &[]
    }

    /// Returns the mutable observation sources, for inserting observations.
    fn sources_mut(&mut self) -> &mut [ObservationSource] {
        &mut []
    }

    /// Returns the layer as a filter, if it uses a mask.
    fn masked(&mut self) -> Option<&mut dyn MaskFilter> {
        None
    }

    /// Returns the layers of a container.
    fn children(&self) -> &[Box<dyn Layer>] {
        &[]
    }

    /// Returns the mutable layers of a container.
    fn children_mut(&mut self) -> &mut [Box<dyn Layer>] {
        &mut []
    }

    /// Returns the contribution of the layer to a cell of `master`, with the reason.
    fn explain(&self, _master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        Explanation {
            value: self.grid().and_then(|grid| grid.cost(cell)),
            ..Explanation::default()
        }
    }

    /// Takes the warnings since the last call.
    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        Vec::new()
    }
}

/// Returns true if a layer is current or disabled.
pub(crate) fn is_settled(layer: &dyn Layer, now_ns: i64) -> bool {
    !layer.is_enabled() || layer.is_current(now_ns)
}
