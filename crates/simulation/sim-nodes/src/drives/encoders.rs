//! Wheel odometry.

use periplus_physics::{JointCommand, JointId, PhysicsWorld, Twist, drives::Odometry};

/// Encoders of a left and a right wheel, with the odometry computed from them.
#[derive(Clone, Debug)]
pub(crate) struct Encoders {
    wheels: [JointId; 2],
    radius_m: f64,
    separation_m: f64,
    before_rad: Option<[f64; 2]>,
    /// Odometry from zero at the start.
    pub(crate) odometry: Odometry,
}

impl Encoders {
    pub(crate) fn new(wheels: [JointId; 2], radius_m: f64, separation_m: f64) -> Self {
        let odometry = Odometry::default();
        Self { wheels, radius_m, separation_m, before_rad: None, odometry }
    }

    /// Before a step: the first angles are the zero.
    pub(crate) fn begin(&mut self, world: &PhysicsWorld) {
        if self.before_rad.is_none() {
            self.before_rad = Some(self.angles_rad(world));
        }
    }

    /// After a step of a duration [s].
    pub(crate) fn observe(&mut self, world: &PhysicsWorld, dt_s: f64) {
        let now = self.angles_rad(world);
        if let Some(before) = self.before_rad.replace(now) {
            let [left_m, right_m] = [0, 1].map(|side| (now[side] - before[side]) * self.radius_m);
            self.odometry = self.odometry.advanced(left_m, right_m, self.separation_m, dt_s);
        }
    }

    /// Rotates the wheels as if they rolled on the floor at a twist.
    pub(crate) fn roll(&self, world: &mut PhysicsWorld, twist: Twist) {
        for (joint, sign) in self.wheels.into_iter().zip([-1.0, 1.0]) {
            let speed_m_s = twist.x_m_s + sign * twist.yaw_rad_s * self.separation_m / 2.0;
            let target = speed_m_s / self.radius_m;
            world.command(joint, JointCommand::Velocity { target, max_effort: f64::INFINITY });
        }
    }

    pub(crate) fn reset(&mut self) {
        self.before_rad = None;
        self.odometry = Odometry::default();
    }

    fn angles_rad(&self, world: &PhysicsWorld) -> [f64; 2] {
        self.wheels.map(|joint| angle(world, joint))
    }
}

/// Returns the position of a joint axis [m or rad]; zero for a removed joint.
pub(crate) fn angle(world: &PhysicsWorld, joint: JointId) -> f64 {
    world.axis_state(joint).unwrap_or_default().position
}

/// Returns the velocity of a joint axis [m/s or rad/s]; zero for a removed joint.
pub(crate) fn speed(world: &PhysicsWorld, joint: JointId) -> f64 {
    world.axis_state(joint).unwrap_or_default().velocity
}
