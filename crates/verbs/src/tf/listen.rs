//! Listening to frames.

use std::sync::Arc;

use periplus_base::{DQuat, DVec3};
use periplus_graph::{Mailbox, Node, Qos};
use periplus_msgs::geometry_msgs::TransformStamped;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf::{Buffer, Kind, Refused, Stamped};

use crate::{Outcome, Session};

/// Nobody says over DDS who broadcast a transform.
pub(super) const AUTHORITY: &str = "Authority undetectable";

/// Frames as they are heard.
pub(super) struct Frames {
    pub(super) buffer: Buffer,
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    _node: Node,
}

/// A message that came.
pub(super) struct Heard {
    pub(super) message: Arc<TFMessage>,
    pub(super) kind: Kind,
}

impl Frames {
    pub(super) fn open(session: &Session<'_>) -> Outcome<Self> {
        let node = session.node(None)?;
        Ok(Self {
            buffer: Buffer::default(),
            moving: node.mailbox("/tf", Qos::reliable(100))?,
            fixed: node.mailbox("/tf_static", Qos::latched(100))?,
            _node: node,
        })
    }

    /// Takes in what has come since the last call. After a jump back in time all that was before is
    /// forgotten.
    pub(super) fn hear(&mut self, session: &mut Session<'_>) -> Vec<Heard> {
        let fixed = self.fixed.drain().into_iter().map(|message| (message, Kind::Fixed));
        let moving = self.moving.drain().into_iter().map(|message| (message, Kind::Moving));
        let heard: Vec<Heard> =
            fixed.chain(moving).map(|(message, kind)| Heard { message, kind }).collect();
        for one in &heard {
            for transform in &one.message.transforms {
                let stamped = stamped(transform);
                match self.buffer.set(&stamped, AUTHORITY, one.kind) {
                    Ok(()) => {}
                    Err(Refused::OldData(..)) => {
                        session.say("Detected jump back in time. Clearing TF buffer.");
                        self.buffer.clear();
                        let _ = self.buffer.set(&stamped, AUTHORITY, one.kind);
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

fn stamped(transform: &TransformStamped) -> Stamped {
    let (shift, turn) = (&transform.transform.translation, &transform.transform.rotation);
    Stamped {
        parent: transform.header.frame_id.clone(),
        child: transform.child_frame_id.clone(),
        stamp_ns: stamp_ns(transform),
        translation: DVec3::new(shift.x, shift.y, shift.z),
        rotation: DQuat::from_xyzw(turn.x, turn.y, turn.z, turn.w),
    }
}
