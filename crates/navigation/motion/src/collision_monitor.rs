//! Collision monitor: velocity commands are reduced by the points that sensors see near the robot.
//!
//! A [`MonitorZone`] is a shape around the robot with the action that points inside it trigger.
//! [`decide`] applies all zones to a command, [`detect`] reports which zones have points. The module
//! [`sources`] makes points of sensor data.
//!
//! Source: `nav2_collision_monitor` (humble 3c3db59d, jazzy f4108e5b, main a3a97043).

mod decision;
mod exclusion;
mod shape;
pub mod sources;
mod velocity_polygon;
mod zone;

pub use decision::{MonitorAction, MonitorDecision, ZoneDetection, decide, detect};
pub use exclusion::{ExclusionMask, exclude};
pub use shape::{MonitorShape, PointsError, read_corners};
pub use velocity_polygon::{VelocityPart, VelocityParts};
pub use zone::{ApproachLimits, MonitorZone, TriggerFilter, ZoneAction};

/// Point that a source sees, in the base frame \[m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CollisionPoint {
    /// Forward.
    pub x_m: f64,
    /// To the left.
    pub y_m: f64,
    /// Upward; 0 for sources in the plane.
    pub z_m: f64,
}

impl CollisionPoint {
    /// Creates a point in the plane \[m\].
    #[must_use]
    pub const fn planar(x_m: f64, y_m: f64) -> Self {
        Self { x_m, y_m, z_m: 0.0 }
    }
}

/// Points of one source.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SourcePoints {
    /// Name of the source.
    pub source: String,
    /// Its points, in the base frame.
    pub points: Vec<CollisionPoint>,
}
