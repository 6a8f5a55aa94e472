//! A door that moves.

use periplus_msgs::rmf_door_msgs::DoorMode;
use periplus_physics::{AxisState, JointCommand, JointId, PhysicsWorld};

use super::read::{DoorSpec, JointName};

/// Position of all leaves of a door.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum DoorPosition {
    #[default]
    Closed,
    Between,
    Open,
}

impl DoorPosition {
    /// Value in messages.
    pub(super) fn mode(self) -> DoorMode {
        let value = match self {
            Self::Closed => DoorMode::MODE_CLOSED,
            Self::Between => DoorMode::MODE_MOVING,
            Self::Open => DoorMode::MODE_OPEN,
        };
        DoorMode { value }
    }
}

/// Joint that is looked up when it is needed: models come after the device, and can be replaced.
pub(super) struct NamedJoint {
    name: JointName,
    found: Option<JointId>,
}

impl NamedJoint {
    pub(super) fn new(name: JointName) -> Self {
        Self { name, found: None }
    }

    /// The joint and its state; none while its model is not in the world.
    pub(super) fn state(&mut self, world: &PhysicsWorld) -> Option<(JointId, AxisState)> {
        if self.found.is_none_or(|joint| world.axis_state(joint).is_none()) {
            let model = world.find_model(&self.name.model)?;
            self.found = world.find_joint(model, &self.name.joint);
        }
        let joint = self.found?;
        Some((joint, world.axis_state(joint)?))
    }

    /// Name of the outermost model.
    pub(super) fn model(&self) -> &str {
        &self.name.model
    }
}

/// Door with its joints.
pub(super) struct Door {
    pub(super) spec: DoorSpec,
    joints: Vec<NamedJoint>,
}

/// Motion of a door.
#[derive(Clone, Debug, Default)]
pub(super) struct DoorMotion {
    /// Wanted position.
    pub(super) opens: bool,
    pub(super) position: DoorPosition,
    /// Commanded speeds of the leaves \[m/s or rad/s\].
    speeds: Vec<f64>,
}

impl DoorMotion {
    /// True if the door is where it should be.
    pub(super) fn is_done(&self) -> bool {
        self.position == if self.opens { DoorPosition::Open } else { DoorPosition::Closed }
    }
}

impl Door {
    pub(super) fn new(spec: DoorSpec) -> Self {
        let joints = spec.leaves.iter().map(|leaf| NamedJoint::new(leaf.joint.clone())).collect();
        Self { spec, joints }
    }

    /// Motion at the start: closed.
    pub(super) fn first_motion(&self) -> DoorMotion {
        DoorMotion { speeds: vec![0.0; self.joints.len()], ..DoorMotion::default() }
    }

    /// Commands the leaves for a step.
    pub(super) fn act(&mut self, motion: &mut DoorMotion, world: &mut PhysicsWorld, step_s: f64) {
        let leaves = self.joints.iter_mut().zip(&self.spec.leaves).zip(&mut motion.speeds);
        for ((joint, leaf), speed) in leaves {
            let Some((joint, state)) = joint.state(world) else { continue };
            let target = if motion.opens { leaf.open } else { leaf.closed };
            let distance = settled(target - state.position, self.spec.tolerance);
            *speed = self.spec.limits.next_speed(distance, *speed, step_s);
            world.command(
                joint,
                JointCommand::Velocity { target: *speed, max_effort: f64::INFINITY },
            );
        }
    }

    /// Looks at the position of the leaves.
    pub(super) fn look(&mut self, motion: &mut DoorMotion, world: &PhysicsWorld) {
        let (mut is_open, mut is_closed) = (true, true);
        for (joint, leaf) in self.joints.iter_mut().zip(&self.spec.leaves) {
            let Some((_, state)) = joint.state(world) else { continue };
            is_open &= (state.position - leaf.open).abs() < self.spec.tolerance;
            is_closed &= (state.position - leaf.closed).abs() < self.spec.tolerance;
        }
        motion.position = match (is_open, is_closed) {
            (_, true) => DoorPosition::Closed,
            (true, false) => DoorPosition::Open,
            (false, false) => DoorPosition::Between,
        };
    }

    /// Name of the outermost model of a leaf.
    pub(super) fn model(&self) -> &str {
        self.joints.first().map_or(self.spec.name.as_str(), NamedJoint::model)
    }
}

/// A distance, or zero in the middle of the tolerance.
pub(super) fn settled(distance: f64, tolerance: f64) -> f64 {
    if distance.abs() < 0.5 * tolerance { 0.0 } else { distance }
}
