//! Where frames are, as heard on `/tf` and `/tf_static`.

use periplus_base::{DQuat, DVec3, Pose};
use periplus_costmap::Frames;
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::{geometry_msgs, tf2_msgs};
use periplus_tf::{Buffer, Kind, LookupError, Stamped};

/// Most transforms that wait between two updates.
const DEPTH: usize = 1000;

/// Frames, and where news of them come from.
pub(crate) struct Listener {
    buffer: Buffer,
    moving: Mailbox<tf2_msgs::TFMessage>,
    fixed: Mailbox<tf2_msgs::TFMessage>,
}

impl Listener {
    pub(crate) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            buffer: Buffer::default(),
            moving: node.mailbox("/tf", Qos::reliable(DEPTH))?,
            fixed: node.mailbox("/tf_static", Qos::latched(DEPTH))?,
        })
    }

    /// Takes in what has come.
    pub(crate) fn listen(&mut self) {
        for (mailbox, kind) in [(&self.fixed, Kind::Fixed), (&self.moving, Kind::Moving)] {
            for message in mailbox.drain() {
                for transform in &message.transforms {
                    // What is malformed is dropped, as tf2 drops it.
                    let _refused = self.buffer.set(&stamped(transform), "tf", kind);
                }
            }
        }
    }

    /// `target_from_source` at a time \[ns\]; 0 for the newest. With it, when that was \[ns\].
    pub(crate) fn at(
        &self,
        target: &str,
        source: &str,
        time_ns: i64,
    ) -> Result<(Pose, i64), LookupError> {
        let target = target.trim_start_matches('/');
        let source = source.trim_start_matches('/');
        let found = self.buffer.lookup(target, source, time_ns)?;
        Ok((found.target_from_source, found.time_ns))
    }

    pub(crate) fn has(&self, frame: &str) -> bool {
        self.buffer.has_frame(frame)
    }
}

impl Frames for Listener {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        self.at(target, source, 0).ok().map(|(pose, _)| pose)
    }
}

fn stamped(transform: &geometry_msgs::TransformStamped) -> Stamped {
    let geometry_msgs::Transform { translation, rotation } = &transform.transform;
    Stamped {
        parent: transform.header.frame_id.clone(),
        child: transform.child_frame_id.clone(),
        stamp_ns: transform.header.stamp.ns(),
        translation: DVec3::new(translation.x, translation.y, translation.z),
        rotation: DQuat::from_xyzw(rotation.x, rotation.y, rotation.z, rotation.w),
    }
}
