//! Topics of velocities, as Twist or TwistStamped.
//!
//! Source: `nav2_util/twist_publisher.hpp`, `twist_subscriber.hpp`: the parameter
//! `enable_stamped_cmd_vel` is false by default up to Jazzy and true from Kilted on; Humble has
//! Twist only.

use periplus_costmap::Nav2Release;
use periplus_graph::{Actor, GraphError, Io, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped, Vector3};
use periplus_msgs::std_msgs::Header;

/// Queue depth; only the newest velocity counts.
const DEPTH: usize = 1;

/// Returns true if velocities are stamped, for a value of `enable_stamped_cmd_vel`.
#[must_use]
pub fn uses_stamped_velocity(enabled: Option<bool>, release: Nav2Release) -> bool {
    match release {
        Nav2Release::Humble => false,
        Nav2Release::EarlyJazzy | Nav2Release::Jazzy => enabled.unwrap_or(false),
        Nav2Release::Kilted | Nav2Release::Main => enabled.unwrap_or(true),
    }
}

/// Publisher of velocities.
pub enum VelocityPublisher {
    /// Without stamp.
    Plain(Publisher<Twist>),
    /// With stamp and frame.
    Stamped(Publisher<TwistStamped>),
}

impl VelocityPublisher {
    /// Creates a publisher.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn new(node: &Node, topic: &str, is_stamped: bool) -> Result<Self, GraphError> {
        let qos = Qos::reliable(DEPTH);
        Ok(if is_stamped {
            Self::Stamped(node.publisher(topic, qos)?)
        } else {
            Self::Plain(node.publisher(topic, qos)?)
        })
    }

    /// Publishes a velocity; the header is dropped without stamp.
    pub fn publish(&self, velocity: TwistStamped) {
        match self {
            Self::Plain(publisher) => publisher.publish(velocity.twist),
            Self::Stamped(publisher) => publisher.publish(velocity),
        }
    }

    /// Publishes a velocity in the plane: x and y \[m/s\], yaw \[rad/s\].
    pub fn publish_planar(&self, header: Header, [vx, vy, wz]: [f64; 3]) {
        let twist = Twist {
            linear: Vector3 { x: vx, y: vy, z: 0.0 },
            angular: Vector3 { x: 0.0, y: 0.0, z: wz },
        };
        self.publish(TwistStamped { header, twist });
    }
}

/// Subscribes to velocities; those without stamp have an empty header.
///
/// # Errors
/// When the name is not valid or the topic has another type.
pub fn subscribe_velocity<S: Send + 'static>(
    actor: &mut Actor<S>,
    topic: &str,
    is_stamped: bool,
    mut react: impl FnMut(&mut S, &TwistStamped, &mut Io<'_, S>) + Send + 'static,
) -> Result<(), GraphError> {
    let qos = Qos::reliable(DEPTH);
    if is_stamped {
        return actor.subscribe::<TwistStamped>(topic, qos, move |state, velocity, io| {
            react(state, &velocity, io);
        });
    }
    actor.subscribe::<Twist>(topic, qos, move |state, twist, io| {
        let velocity = TwistStamped { header: Header::default(), twist: (*twist).clone() };
        react(state, &velocity, io);
    })
}

/// Components of a twist: x, y, z \[m/s\], then roll, pitch, yaw \[rad/s\].
pub(crate) fn components(twist: &Twist) -> [f64; 6] {
    let Twist { linear, angular } = twist;
    [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
}

/// Twist of components.
pub(crate) fn twist([x, y, z, roll, pitch, yaw]: [f64; 6]) -> Twist {
    Twist { linear: Vector3 { x, y, z }, angular: Vector3 { x: roll, y: pitch, z: yaw } }
}
