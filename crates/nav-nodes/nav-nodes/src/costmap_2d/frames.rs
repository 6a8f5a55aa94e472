//! TF listener of a costmap.

use periplus_costmap::TransformSource;
use periplus_geometry::Pose;
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::tf2_msgs;
use periplus_tf::{LookupError, TransformKind};
use periplus_tf_ros as whereabouts;

/// Maximum number of transforms queued between two updates.
const DEPTH: usize = 1000;

/// TF buffer with its subscriptions.
pub(crate) struct Listener {
    frames: whereabouts::Frames,
    moving: Mailbox<tf2_msgs::TFMessage>,
    fixed: Mailbox<tf2_msgs::TFMessage>,
}

impl Listener {
    pub(crate) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            frames: whereabouts::Frames::default(),
            moving: node.mailbox("/tf", Qos::reliable(DEPTH))?,
            fixed: node.mailbox("/tf_static", Qos::latched(DEPTH))?,
        })
    }

    /// Processes received transforms.
    pub(crate) fn listen(&mut self) {
        for (mailbox, kind) in
            [(&self.fixed, TransformKind::Fixed), (&self.moving, TransformKind::Moving)]
        {
            for message in mailbox.drain() {
                self.frames.take(&message, kind);
            }
        }
    }

    /// Drops dynamic transforms after a clock jump; static ones stay.
    pub(crate) fn forget(&mut self) {
        let _ = self.moving.drain();
        self.frames.forget();
    }

    /// Returns `target_from_source` at a time \[ns\], 0 for the newest, and the stamp of the result
    /// \[ns\].
    pub(crate) fn at(
        &self,
        target: &str,
        source: &str,
        time_ns: i64,
    ) -> Result<(Pose, i64), LookupError> {
        self.frames.at(target, source, time_ns)
    }

    pub(crate) fn has(&self, frame: &str) -> bool {
        self.frames.has(frame)
    }
}

impl TransformSource for Listener {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        self.at(target, source, 0).ok().map(|(pose, _)| pose)
    }
}
