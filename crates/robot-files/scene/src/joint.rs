//! Joints between links.

use periplus_diagnostics::Origin;
use periplus_geometry::{DVec3, Pose};
use periplus_xml::Element;
use serde::Serialize;

use crate::Sensor;

/// Type of motion of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// No motion.
    Fixed,
    /// Rotation about an axis, optionally with limits.
    Revolute,
    /// Rotation about an axis without limits.
    Continuous,
    /// Translation along an axis.
    Prismatic,
    /// Rotation about all axes.
    Ball,
    /// Rotation about two axes, one after the other.
    Universal,
    /// Rotation about two axes that do not intersect.
    Revolute2,
    /// Coupled rotation and translation.
    Screw,
    /// Two rotations coupled by a ratio.
    Gearbox,
    /// Free motion (URDF `floating`).
    Floating,
    /// Motion in the plane perpendicular to its axis (URDF `planar`).
    Planar,
}

/// Connection of two links.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Joint {
    /// Its name, unique in its model.
    pub name: String,
    /// Type of motion.
    pub kind: JointKind,
    /// The link, frame or nested model on the parent's side, scoped; or `world`.
    pub parent: String,
    /// The link, frame or nested model on the child's side, scoped.
    pub child: String,
    /// The joint's frame in the child's.
    pub child_from_joint: Pose,
    /// The first axis.
    pub axis: Option<Axis>,
    /// The second axis of universal, revolute2 and gearbox joints.
    pub axis2: Option<Axis>,
    /// Travel per turn of a screw [m], positive as in SDF's `screw_thread_pitch`.
    pub thread_pitch_m: Option<f64>,
    /// Force-torque sensors; poses are `joint_from_sensor`.
    pub sensors: Vec<Sensor>,
    /// Engine settings and other elements.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// An axis of motion. Metres and newtons for a prismatic joint, radians and newton metres
/// otherwise.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// Unit direction in the joint's frame.
    pub direction_in_joint: DVec3,
    /// Minimum position [m or rad]; `-inf` if unlimited.
    pub lower: f64,
    /// Maximum position [m or rad]; `inf` if unlimited.
    pub upper: f64,
    /// Maximum force or torque [N or N m]; `inf` if unlimited.
    pub effort: f64,
    /// Maximum speed [m/s or rad/s]; `inf` if unlimited.
    pub velocity: f64,
    /// Viscous damping [N s/m or N m s/rad].
    pub damping: f64,
    /// Static friction [N or N m].
    pub friction: f64,
    /// Spring constant [N/m or N m/rad].
    pub spring_stiffness: f64,
    /// Rest position of the spring [m or rad].
    pub spring_reference: f64,
    /// Joint that it follows.
    pub mimic: Option<Mimic>,
    /// Uninterpreted elements: limit stiffness and dissipation.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// `position = multiplier * (other - reference) + offset`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mimic {
    /// Joint that it follows.
    pub joint: String,
    /// Axis of that joint: `axis` or `axis2`.
    pub axis: String,
    /// Ratio of the motions.
    pub multiplier: f64,
    /// Offset [m or rad].
    pub offset: f64,
    /// Position of that joint that is subtracted [m or rad].
    pub reference: f64,
}

impl Default for Axis {
    fn default() -> Self {
        Self {
            direction_in_joint: DVec3::Z,
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
            effort: f64::INFINITY,
            velocity: f64::INFINITY,
            damping: 0.0,
            friction: 0.0,
            spring_stiffness: 0.0,
            spring_reference: 0.0,
            mimic: None,
            extra: Vec::new(),
        }
    }
}

impl Joint {
    /// Returns a joint without axis at the child's origin.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        kind: JointKind,
        parent: impl Into<String>,
        child: impl Into<String>,
    ) -> Self {
        Self {
            name: name.into(),
            kind,
            parent: parent.into(),
            child: child.into(),
            child_from_joint: Pose::IDENTITY,
            axis: None,
            axis2: None,
            thread_pitch_m: None,
            sensors: Vec::new(),
            extra: Vec::new(),
            origin: Origin::default(),
        }
    }
}
