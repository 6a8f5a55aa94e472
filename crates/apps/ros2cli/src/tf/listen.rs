//! TF listener.

use std::sync::Arc;

use periplus_geometry::{DQuat, DVec3};
use periplus_graph::{Mailbox, Node, Qos};
use periplus_msgs::geometry_msgs::TransformStamped;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf::{RejectedTransform, StampedTransform, TransformKind, TransformMonitor};

use crate::{Outcome, Session};

/// DDS does not identify the broadcaster of a transform.
pub(super) const AUTHORITY: &str = "Authority undetectable";

/// TF buffer with its subscriptions.
pub(super) struct Frames {
    pub(super) survey: TransformMonitor,
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    _node: Node,
}

/// Received transform message.
pub(super) struct ReceivedTransform {
    pub(super) message: Arc<TFMessage>,
    pub(super) kind: TransformKind,
}

impl Frames {
    pub(super) fn open(session: &Session<'_>) -> Outcome<Self> {
        Self::of(session, ["/tf", "/tf_static"])
    }

    /// Subscribes to topics of these names.
    pub(super) fn of(session: &Session<'_>, [moving, fixed]: [&str; 2]) -> Outcome<Self> {
        let node = session.node(None)?;
        Ok(Self {
            survey: TransformMonitor::default(),
            moving: node.mailbox(moving, Qos::reliable(100))?,
            fixed: node.mailbox(fixed, Qos::latched(100))?,
            _node: node,
        })
    }

    /// Processes messages received since the last call. A jump back in time clears the buffer.
    pub(super) fn hear(&mut self, session: &mut Session<'_>) -> Vec<ReceivedTransform> {
        let fixed = self.fixed.drain().into_iter().map(|message| (message, TransformKind::Fixed));
        let moving =
            self.moving.drain().into_iter().map(|message| (message, TransformKind::Moving));
        let heard: Vec<ReceivedTransform> = fixed
            .chain(moving)
            .map(|(message, kind)| ReceivedTransform { message, kind })
            .collect();
        for one in &heard {
            for transform in &one.message.transforms {
                match self.survey.insert(&stamped(transform), AUTHORITY, one.kind) {
                    Ok(()) => {}
                    Err(RejectedTransform::OldData(..)) => {
                        session.say("Detected jump back in time. Clearing TF buffer.");
                    }
                    Err(refused) => session.say(&format!("WARNING: {refused}")),
                }
            }
        }
        heard
    }
}

pub(super) fn stamp_ns(transform: &TransformStamped) -> i64 {
    transform.header.stamp.ns()
}

/// Converts the transform of a message.
#[must_use]
pub fn stamped(transform: &TransformStamped) -> StampedTransform {
    let (shift, turn) = (&transform.transform.translation, &transform.transform.rotation);
    StampedTransform {
        parent: transform.header.frame_id.clone(),
        child: transform.child_frame_id.clone(),
        stamp_ns: stamp_ns(transform),
        translation: DVec3::new(shift.x, shift.y, shift.z),
        rotation: DQuat::from_xyzw(turn.x, turn.y, turn.z, turn.w),
    }
}
