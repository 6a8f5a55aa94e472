//! Odometry of Gazebo Classic's differential and tricycle drives.

use periplus_geometry::Pose;
use periplus_physics::drives::true_twist;
use periplus_physics::{PhysicsWorld, Twist};

use super::body::Body;
use super::encoders::Encoders;
use super::rate_timer::RateTimer;
use super::wheel_frames::WheelFrames;
use crate::SenseContext;
use crate::states::{JointStates, OdometryPublisher, planar_twist};

/// Source of the published odometry (`odometry_source`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OdometrySource {
    /// Wheel odometry, from zero at the start.
    Encoder,
    /// True pose and velocity in the world.
    World,
}

impl OdometrySource {
    /// Selects wheel odometry or the truth.
    pub(crate) fn new(is_encoder: bool) -> Self {
        if is_encoder { Self::Encoder } else { Self::World }
    }
}

/// Odometry, wheel transforms and joint states of a drive, published at its update rate.
pub(crate) struct ClassicOdometry {
    pub(crate) source: OdometrySource,
    /// Body frame of the model, for [`OdometrySource::World`].
    pub(crate) body: Body,
    /// `None` for a drive without wheels.
    pub(crate) encoders: Option<Encoders>,
    pub(crate) publisher: OdometryPublisher,
    pub(crate) wheel_frames: Option<WheelFrames>,
    pub(crate) joint_states: Option<JointStates>,
    pub(crate) timer: RateTimer,
}

#[derive(Clone)]
pub(crate) struct ClassicOdometryState {
    encoders: Option<Encoders>,
    timer: RateTimer,
}

impl ClassicOdometry {
    /// Before a step: the first wheel angles are the zero of the odometry.
    pub(crate) fn begin(&mut self, world: &PhysicsWorld) {
        if let Some(encoders) = &mut self.encoders {
            encoders.begin(world);
        }
    }

    /// After a step: updates the odometry and publishes it if it is due.
    pub(crate) fn sense(&mut self, context: &SenseContext<'_>) {
        if let Some(encoders) = &mut self.encoders {
            encoders.observe(context.world, context.span.seconds());
        }
        let now_ns = context.time_ns();
        if !self.timer.due(now_ns) || !self.has_subscribers() {
            return;
        }
        if let Some((pose, twist)) = self.current(context.world) {
            self.publisher.publish(now_ns, pose, planar_twist(twist));
        }
        if let Some(frames) = &self.wheel_frames {
            frames.publish(context.world, now_ns);
        }
        if let Some(states) = &self.joint_states {
            states.publish(context.world, now_ns);
        }
    }

    /// Rotates the encoder wheels as if they rolled on the floor at a twist.
    pub(crate) fn roll(&self, world: &mut PhysicsWorld, twist: Twist) {
        if let Some(encoders) = &self.encoders {
            encoders.roll(world, twist);
        }
    }

    /// Returns the next time of publishing \[ns\]; `None` without subscribers.
    pub(crate) fn next_ns(&self) -> Option<i64> {
        self.timer.next_ns().filter(|_| self.has_subscribers())
    }

    /// Resets to the initial state.
    pub(crate) fn reset(&mut self, time_ns: i64) {
        self.timer.restart(time_ns);
        if let Some(encoders) = &mut self.encoders {
            encoders.reset();
        }
    }

    pub(crate) fn save(&self) -> ClassicOdometryState {
        ClassicOdometryState { encoders: self.encoders.clone(), timer: self.timer.clone() }
    }

    pub(crate) fn restore(&mut self, saved: &ClassicOdometryState) {
        self.encoders.clone_from(&saved.encoders);
        self.timer.clone_from(&saved.timer);
    }

    fn has_subscribers(&self) -> bool {
        self.publisher.has_subscribers()
            || self.wheel_frames.as_ref().is_some_and(WheelFrames::has_subscribers)
            || self.joint_states.as_ref().is_some_and(JointStates::has_subscribers)
    }

    fn current(&self, world: &PhysicsWorld) -> Option<(Pose, Twist)> {
        match (self.source, &self.encoders) {
            (OdometrySource::Encoder, Some(encoders)) => {
                Some((encoders.odometry.pose.pose(), encoders.odometry.twist))
            }
            _ => {
                let state = self.body.state(world)?;
                let twist =
                    true_twist(state.world_from_link, state.linear_m_s, state.angular_rad_s);
                Some((state.world_from_link, twist))
            }
        }
    }
}
