//! Odometry from wheels.

use periplus_physics::{Command, JointId, Twist, World, drives::Odometry};

/// A left and a right wheel that are counted.
#[derive(Clone, Debug)]
pub(crate) struct Encoders {
    wheels: [JointId; 2],
    radius_m: f64,
    separation_m: f64,
    before_rad: Option<[f64; 2]>,
    /// Where they say that the robot is, from the zero at which it started.
    pub(crate) odometry: Odometry,
}

impl Encoders {
    pub(crate) fn new(wheels: [JointId; 2], radius_m: f64, separation_m: f64) -> Self {
        let odometry = Odometry::default();
        Self { wheels, radius_m, separation_m, before_rad: None, odometry }
    }

    /// Before a step: the very first angles are the zero.
    pub(crate) fn begin(&mut self, world: &World) {
        if self.before_rad.is_none() {
            self.before_rad = Some(self.angles_rad(world));
        }
    }

    /// After a step of a length [s].
    pub(crate) fn observe(&mut self, world: &World, dt_s: f64) {
        let now = self.angles_rad(world);
        if let Some(before) = self.before_rad.replace(now) {
            let [left_m, right_m] = [0, 1].map(|side| (now[side] - before[side]) * self.radius_m);
            self.odometry = self.odometry.moved(left_m, right_m, self.separation_m, dt_s);
        }
    }

    /// Turns the wheels as ground would that passes below at a twist.
    pub(crate) fn roll(&self, world: &mut World, twist: Twist) {
        for (joint, sign) in self.wheels.into_iter().zip([-1.0, 1.0]) {
            let speed_m_s = twist.x_m_s + sign * twist.yaw_rad_s * self.separation_m / 2.0;
            let target = speed_m_s / self.radius_m;
            world.command(joint, Command::Velocity { target, max_effort: f64::INFINITY });
        }
    }

    pub(crate) fn reset(&mut self) {
        self.before_rad = None;
        self.odometry = Odometry::default();
    }

    fn angles_rad(&self, world: &World) -> [f64; 2] {
        self.wheels.map(|joint| angle(world, joint))
    }
}

/// Where an axis is [m or rad]; zero of a joint that is gone.
pub(crate) fn angle(world: &World, joint: JointId) -> f64 {
    world.axis_state(joint).unwrap_or_default().position
}

/// How fast an axis is [m/s or rad/s]; zero of a joint that is gone.
pub(crate) fn speed(world: &World, joint: JointId) -> f64 {
    world.axis_state(joint).unwrap_or_default().velocity
}
