//! Surface properties.

use periplus_geometry::DVec3;
use periplus_xml::Element;
use serde::Serialize;

/// Friction, contact and bounce.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SurfaceProperties {
    /// Friction.
    pub friction: Friction,
    /// Stiffness and bounce.
    pub contact: ContactProperties,
    /// Torsional friction, soft contacts, other engines.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Coulomb friction after ODE: two coefficients along two directions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Friction {
    /// Coefficient along the first direction.
    pub mu: f64,
    /// Coefficient along the second.
    pub mu2: f64,
    /// First direction in the collision's frame, or in that of [`Self::fdir1_expressed_in`]; with zero the
    /// physics engine chooses.
    pub fdir1: DVec3,
    /// Link or frame of the model in which the first direction is fixed (`gz:expressed_in`), for wheels
    /// with rollers.
    pub fdir1_expressed_in: Option<String>,
    /// Slip along the first direction [m/(N s)].
    pub slip1: f64,
    /// Slip along the second direction [m/(N s)].
    pub slip2: f64,
}

/// Stiffness and bounce.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactProperties {
    /// Stiffness [N/m].
    pub kp: f64,
    /// Damping [N s/m].
    pub kd: f64,
    /// Maximum speed of the penetration correction [m/s].
    pub max_vel_m_s: f64,
    /// Penetration depth without correction [m].
    pub min_depth_m: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Minimum speed for a bounce [m/s].
    pub bounce_threshold_m_s: f64,
    /// True if it reports contacts without contact forces.
    pub collide_without_contact: bool,
    /// Collides with shapes whose category has a bit in common.
    pub collide_bitmask: u32,
}

impl Default for Friction {
    fn default() -> Self {
        Self {
            mu: 1.0,
            mu2: 1.0,
            fdir1: DVec3::ZERO,
            fdir1_expressed_in: None,
            slip1: 0.0,
            slip2: 0.0,
        }
    }
}

impl Default for ContactProperties {
    fn default() -> Self {
        Self {
            kp: 1e12,
            kd: 1.0,
            max_vel_m_s: 0.01,
            min_depth_m: 0.0,
            restitution: 0.0,
            bounce_threshold_m_s: 100_000.0,
            collide_without_contact: false,
            collide_bitmask: 0xffff,
        }
    }
}
