//! Faults of joints and surfaces.

use super::PhysicsWorld;
use crate::engine::Engine;
use crate::joints::JointCommand;
use crate::state::{JointId, LinkId};

impl PhysicsWorld {
    /// Seizes a joint or releases it: a seized joint is held at its position with its full effort, and ignores
    /// commands. Returns false without an axis. In [`PhysicsMode::Kinematic`](crate::PhysicsMode) wheels do not move a
    /// robot, so that a seized wheel does not stop it.
    pub fn set_seized(&mut self, joint: JointId, is_seized: bool) -> bool {
        let count = self.axes(joint).len();
        if count == 0 {
            return false;
        }
        let first = self.records.joints[joint.0 as usize].axes.start;
        for axis in &mut self.records.axes[first..first + count] {
            if axis.is_seized == is_seized {
                continue;
            }
            axis.is_seized = is_seized;
            axis.command = if is_seized {
                JointCommand::Velocity { target: 0.0, max_effort: f64::MAX }
            } else {
                JointCommand::Free
            };
        }
        true
    }

    /// Limits the coefficient of friction of all collisions of a link, as on ice or oil; `None` removes the limit. The
    /// smaller coefficient of two surfaces applies to their contact. Returns false without a collision, for a
    /// coefficient that is negative or not finite, and in [`PhysicsMode::Kinematic`](crate::PhysicsMode), which has no
    /// contacts. Friction with a direction (`<fdir1>`) is not limited.
    pub fn limit_friction(&mut self, link: LinkId, max_friction: Option<f64>) -> bool {
        let is_sound = max_friction.is_none_or(|friction| friction.is_finite() && friction >= 0.0);
        let body = self.records.links.get(link.0 as usize).map(|record| record.body);
        match (&mut self.engine, body) {
            (Engine::Rigid(rigid), Some(body)) if is_sound => {
                rigid.limit_friction(body, link.0, max_friction)
            }
            _ => false,
        }
    }
}
