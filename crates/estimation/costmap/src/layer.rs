//! What a layer is.

use std::any::Any;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose, Pose2};
use periplus_grid::{Cell, GridInfo};
use periplus_params::ParamValues;

use crate::filters::Masked;
use crate::{Bounds, Compat, Costmap, Explanation, Footprint, Source, Window};

/// Where frames are.
pub trait Frames {
    /// `target_from_source` as it is known now; none when nobody knows.
    fn latest(&self, target: &str, source: &str) -> Option<Pose>;
}

/// Knows that every frame is where it is itself, and nothing else.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFrames;

impl Frames for NoFrames {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        (target == source).then_some(Pose::IDENTITY)
    }
}

impl<F: Fn(&str, &str) -> Option<Pose>> Frames for F {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        self(target, source)
    }
}

/// What layers are told in an update.
#[derive(Clone, Copy)]
pub struct Moment<'a> {
    /// The time \[ns\].
    pub now_ns: i64,
    /// `global_from_base`: where the robot is.
    pub robot: Pose2,
    /// The outline of the robot, padded.
    pub footprint: &'a Footprint,
    /// The cells of the costmap.
    pub info: GridInfo,
    /// Whether the costmap moves with the robot.
    pub is_rolling: bool,
    /// Whose habits to keep.
    pub compat: Compat,
    /// The frame of the costmap.
    pub global_frame: &'a str,
    /// Where frames are.
    pub frames: &'a dyn Frames,
}

/// A layer of a costmap, or a filter.
///
/// In an update every layer is asked for [`Layer::bounds`], in order, and then every one for
/// [`Layer::costs`] in the window that came of it. The cells of `master` are one flat list of bytes
/// ([`Costmap::costs_mut`]), row by row.
pub trait Layer: Any + Send {
    /// Its name, which also begins the names of its parameters.
    fn name(&self) -> &str;

    /// Takes in what is new, and makes the bounds larger by what changes with it. They must not
    /// become smaller.
    fn bounds(&mut self, moment: &Moment<'_>, bounds: &mut Bounds);

    /// Puts its costs into the window, over what the layers before it put there. Cells outside of
    /// the window must stay as they are.
    fn costs(&mut self, moment: &Moment<'_>, master: &mut Costmap, window: Window);

    /// Forgets what it has seen.
    fn reset(&mut self) {}

    /// Whether services may clear a part of it.
    fn is_clearable(&self) -> bool {
        false
    }

    /// Forgets a part: the cells strictly between `start` and `end`, or with `invert` all others.
    fn clear_area(&mut self, _start: (i64, i64), _end: (i64, i64), _invert: bool, _compat: Compat) {
    }

    /// The robot has another outline.
    fn footprint_changed(&mut self, _footprint: &Footprint) {}

    /// The costmap has other cells; what was in the old ones is gone.
    fn resized(&mut self, _info: &GridInfo, _is_rolling: bool) {}

    /// The cells that the costmap should have because of this layer (a map has its own).
    fn requested_grid_info(&self, _current: &GridInfo, _is_size_locked: bool) -> Option<GridInfo> {
        None
    }

    /// Whether it takes part.
    fn is_enabled(&self) -> bool {
        true
    }

    /// Whether it has what it needs and is not waiting for something.
    fn is_current(&self, _now_ns: i64) -> bool {
        true
    }

    /// Its own cells, if it has some to show.
    fn grid(&self) -> Option<&Costmap> {
        None
    }

    /// Its parameters as they are.
    fn values(&self) -> Option<&ParamValues> {
        None
    }

    /// Takes other values for its parameters; they are of the right kinds and in their ranges.
    ///
    /// # Errors
    /// Why they cannot be, in words; nothing has changed then.
    fn configure(&mut self, _values: ParamValues) -> Result<(), String> {
        Ok(())
    }

    /// What sees for it.
    fn sources(&self) -> &[Source] {
        &[]
    }

    /// The same, to give them something.
    fn sources_mut(&mut self) -> &mut [Source] {
        &mut []
    }

    /// Itself, if it follows a mask.
    fn masked(&mut self) -> Option<&mut dyn Masked> {
        None
    }

    /// Layers within it.
    fn children(&self) -> &[Box<dyn Layer>] {
        &[]
    }

    /// The same, to be changed.
    fn children_mut(&mut self) -> &mut [Box<dyn Layer>] {
        &mut []
    }

    /// What it gives a cell of `master`, and why.
    fn explain(&self, _master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        Explanation {
            value: self.grid().and_then(|grid| grid.cost(cell)),
            ..Explanation::default()
        }
    }

    /// Hands over what it has to complain about since the last time.
    fn complaints(&mut self) -> Vec<Diagnostic> {
        Vec::new()
    }
}

/// Whether a layer that is not enabled counts as current too.
pub(crate) fn is_settled(layer: &dyn Layer, now_ns: i64) -> bool {
    !layer.is_enabled() || layer.is_current(now_ns)
}
