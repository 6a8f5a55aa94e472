//! Sonars: the nearest distance in a cone or in all directions.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose};
use periplus_raycast::{Hit, Ray};

use crate::RayView;

/// Number of rays of the first pass.
const FIRST_PASS_RAYS: usize = 512;
/// Number of rays of each refinement around the nearest hit.
const REFINEMENT_RAYS: usize = 32;
/// Ratio of the angles of successive refinements.
const REFINEMENT_RATIO: f64 = 0.35;
/// Number of refinements: the last is narrower than the first pass by 10^-4.
const REFINEMENT_COUNT: i32 = 9;
/// Angle between successive rays of the spiral: the golden angle, for even coverage (Vogel 1979).
const GOLDEN_RAD: f64 = 2.399_963_229_728_653;

/// A sonar. Its cone opens along the x axis of the sensor's frame (Classic's `sonar`).
///
/// The reading is the nearest of many rays, refined around it. Objects thinner than the gaps of the
/// first 512 rays, about a twentieth of the cone's radius, can be missed.
#[derive(Clone, Debug)]
pub struct Sonar {
    min_m: f64,
    max_m: f64,
    /// Half the angle of the cone [rad]; π covers all directions.
    half_angle_rad: f64,
}

impl Sonar {
    /// Creates a sonar from a geometry (`cone` or `sphere`), its ranges [m], and the radius [m] of
    /// the cone at the maximum range.
    ///
    /// # Errors
    /// When the values do not define a volume.
    pub fn new(
        geometry: &str,
        min_m: f64,
        max_m: f64,
        radius_m: f64,
    ) -> Result<Self, Box<Diagnostic>> {
        let half_angle_rad = match geometry {
            "cone" => libm::atan2(radius_m, max_m),
            "sphere" => std::f64::consts::PI,
            other => {
                return Err(Diagnostic::error(
                    "unknown-type",
                    format!("`{other}` is not a geometry of a sonar"),
                )
                .help("one of cone, sphere")
                .into());
            }
        };
        let sound = min_m >= 0.0 && max_m > min_m && max_m.is_finite() && half_angle_rad > 0.0;
        if !sound {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a sonar from {min_m} m to {max_m} m of radius {radius_m} m cannot measure anything"),
            )
            .help("0 <= min < max, and a radius above 0")
            .into());
        }
        Ok(Self { min_m, max_m, half_angle_rad })
    }

    /// Returns the minimum and maximum range [m].
    #[must_use]
    pub fn range_m(&self) -> [f64; 2] {
        [self.min_m, self.max_m]
    }

    /// Returns the full angle of the cone [rad].
    #[must_use]
    pub fn field_of_view_rad(&self) -> f64 {
        2.0 * self.half_angle_rad
    }

    /// Returns the nearest distance [m]: `-inf` too near, `inf` no hit.
    #[must_use]
    pub fn measure(&self, view: &RayView<'_>, world_from_sensor: Pose) -> f64 {
        let near = self.nearest(view, world_from_sensor, [0.0, self.min_m]);
        if self.min_m > 0.0 && near.is_some() {
            return f64::NEG_INFINITY;
        }
        self.nearest(view, world_from_sensor, [self.min_m, self.max_m]).unwrap_or(f64::INFINITY)
    }

    fn nearest(
        &self,
        view: &RayView<'_>,
        world_from_sensor: Pose,
        range_m: [f64; 2],
    ) -> Option<f64> {
        let [min_m, max_m] = range_m;
        let filter = view.without_own_model();
        if !view.rays.may_be_near(world_from_sensor.translation, max_m, filter) {
            return None;
        }
        let cast = |direction: DVec3| -> Option<(f64, DVec3)> {
            let ray = Ray {
                origin_m: world_from_sensor.translation,
                direction: world_from_sensor.rotation * direction,
                min_m,
                max_m,
            };
            let hit: Hit = view.rays.cast(&ray, filter)?;
            Some((hit.distance_m, direction))
        };
        let nearer = |a: Option<(f64, DVec3)>, b: Option<(f64, DVec3)>| match (a, b) {
            (Some(a), Some(b)) => Some(if b.0 < a.0 { b } else { a }),
            (a, b) => a.or(b),
        };
        let best =
            spiral(DVec3::X, self.half_angle_rad, FIRST_PASS_RAYS).map(cast).fold(None, nearer);
        let mut best = best?;
        // Twice the gap between neighbours of the first pass.
        let mut width = self.half_angle_rad * 4.0 / libm::sqrt(512.0);
        for _ in 0..REFINEMENT_COUNT {
            let inside = |direction: &DVec3| {
                libm::acos(direction.x.clamp(-1.0, 1.0)) <= self.half_angle_rad + 1e-12
            };
            let closer = spiral(best.1, width, REFINEMENT_RAYS).filter(inside).map(cast);
            best = closer.fold(Some(best), nearer).unwrap_or(best);
            width *= REFINEMENT_RATIO;
        }
        Some(best.0)
    }
}

/// Returns directions that cover a cone evenly, its axis first, its rim included.
fn spiral(axis: DVec3, half_angle_rad: f64, count: usize) -> impl Iterator<Item = DVec3> {
    let (across, up) = axis.any_orthonormal_pair();
    let rim = 1.0 - libm::cos(half_angle_rad);
    #[expect(clippy::cast_precision_loss, reason = "hundreds")]
    let part = move |number: usize| number as f64 / (count - 1) as f64;
    (0..count).map(move |number| {
        // Even by area on the sphere.
        let cosine = 1.0 - rim * part(number);
        let sine = libm::sqrt((1.0 - cosine * cosine).max(0.0));
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let (turn_sine, turn_cosine) = libm::sincos(GOLDEN_RAD * number as f64);
        axis * cosine + (across * turn_cosine + up * turn_sine) * sine
    })
}

#[cfg(test)]
mod tests {
    use periplus_raycast::{RaycastShape, RaycastWorld, Tags};

    use super::*;

    fn ball(x: f64, y: f64, group: u32) -> RaycastWorld {
        let mut builder = RaycastWorld::builder();
        let tags = Tags { group, ..Tags::default() };
        let ball = RaycastShape::Sphere { radius_m: 0.25 };
        builder.add_shape(&ball, &Pose::from_xyz(x, y, 0.0), tags).unwrap();
        builder.build(1).unwrap()
    }

    fn measure(world: &RaycastWorld, own_group: u32) -> f64 {
        let sonar = Sonar::new("cone", 0.3, 4.0, 2.0).unwrap();
        sonar.measure(&RayView { own_group, ..RayView::of(world) }, Pose::IDENTITY)
    }

    #[test]
    fn the_nearest_point_of_a_ball_is_found() {
        assert!((measure(&ball(2.0, 0.0, 0), 0) - 1.75).abs() < 1e-9);
        let aside = libm::hypot(2.0, 0.7) - 0.25;
        assert!((measure(&ball(2.0, 0.7, 0), 0) - aside).abs() < 1e-6);
    }

    /// A wall across the axis is nearest on the axis; one along it, where the cone first meets it.
    #[test]
    fn the_nearest_point_of_a_wall_may_lie_on_the_rim() {
        let mut builder = RaycastWorld::builder();
        let wall = RaycastShape::Box { size_m: DVec3::new(20.0, 0.2, 20.0) };
        builder.add_shape(&wall, &Pose::from_xyz(0.0, 0.6, 0.0), Tags::default()).unwrap();
        // The wall's face is at y = 0.5; the rim leads 1 m ahead for every 0.5 m aside.
        let expected = libm::hypot(1.0, 0.5);
        let measured = measure(&builder.build(1).unwrap(), 0);
        assert!((measured - expected).abs() < 1e-3, "{measured}");
    }

    #[test]
    fn too_near_nothing_and_its_own() {
        assert_eq!(measure(&ball(0.4, 0.0, 0), 0), f64::NEG_INFINITY);
        assert_eq!(measure(&ball(2.0, 3.0, 0), 0), f64::INFINITY);
        assert_eq!(measure(&ball(2.0, 0.0, 5), 5), f64::INFINITY);
        let around = Sonar::new("sphere", 0.0, 4.0, 0.0).unwrap();
        let measured = around.measure(&RayView::of(&ball(-2.0, 0.3, 0)), Pose::IDENTITY);
        assert!((measured - (libm::hypot(2.0, 0.3) - 0.25)).abs() < 1e-6, "{measured}");
        assert!(Sonar::new("cone", 1.0, 0.5, 1.0).is_err());
        assert!(Sonar::new("pyramid", 0.1, 0.5, 1.0).is_err());
    }
}
