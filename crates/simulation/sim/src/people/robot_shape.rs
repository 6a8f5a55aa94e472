//! Robots as people avoid them: capsules around their footprints.

use periplus_crowds::{DVec2, MovingObstacle, Wall};
use periplus_geometry::{Pose, Pose2};
use periplus_scene::Model;

/// Radius of a robot without collisions \[m\].
const UNKNOWN_RADIUS_M: f64 = 0.3;

/// Number of axis lengths that are tried.
const AXIS_COUNT: u32 = 16;

/// Capsule around the footprint of a robot, in the frame of its model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RobotShape {
    axis_in_model: [DVec2; 2],
    radius_m: f64,
}

impl RobotShape {
    /// Capsule along x or y of least area around a footprint \[m\]; a disc for a robot without one.
    pub(crate) fn around(footprint_m: Option<&[[f64; 2]]>) -> Self {
        let Some(corners) = footprint_m.filter(|corners| !corners.is_empty()) else {
            return Self { axis_in_model: [DVec2::ZERO; 2], radius_m: UNKNOWN_RADIUS_M };
        };
        let corners: Vec<DVec2> = corners.iter().map(|corner| DVec2::from(*corner)).collect();
        let (mut low, mut high) = (DVec2::splat(f64::INFINITY), DVec2::splat(f64::NEG_INFINITY));
        for corner in &corners {
            (low, high) = (low.min(*corner), high.max(*corner));
        }
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let along = if half.x >= half.y { DVec2::X } else { DVec2::Y };
        let candidates = (0..AXIS_COUNT).map(|step| {
            let reach = along * (half.max_element() * f64::from(step) / f64::from(AXIS_COUNT));
            let axis_in_model = [centre - reach, centre + reach];
            let axis = Wall { start: axis_in_model[0], end: axis_in_model[1] };
            let distances = corners.iter().map(|it| axis.nearest_point(*it).distance(*it));
            let radius_m = distances.fold(0.0, f64::max);
            let area_m2 = (4.0 * reach.length() + std::f64::consts::PI * radius_m) * radius_m;
            (area_m2, Self { axis_in_model, radius_m })
        });
        let best = candidates.min_by(|one, two| one.0.total_cmp(&two.0));
        best.map_or(Self { axis_in_model: [centre; 2], radius_m: half.length() }, |(_, it)| it)
    }

    /// The capsule at a pose, with a velocity \[m/s\].
    pub(crate) fn at(&self, world_from_model: Pose, velocity: DVec2) -> MovingObstacle {
        let world_from_model = Pose2::from(world_from_model);
        let axis = self.axis_in_model.map(|end| {
            let (x_m, y_m) = world_from_model.transform_point(end.x, end.y);
            DVec2::new(x_m, y_m)
        });
        MovingObstacle { axis, radius_m: self.radius_m, velocity, is_reciprocal: false }
    }
}

/// True if a model that moves is a robot and not furniture: it has a plugin or a sensor.
pub(crate) fn has_devices(model: &Model) -> bool {
    !model.is_static
        && (!model.plugins.is_empty()
            || model.links.iter().any(|link| !link.sensors.is_empty())
            || model.joints.iter().any(|joint| !joint.sensors.is_empty())
            || model.models.iter().any(has_devices))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_capsule_contains_its_footprint() {
        let check = |corners: &[[f64; 2]], max_area_m2: f64| {
            let shape = RobotShape::around(Some(corners));
            let obstacle = shape.at(Pose::IDENTITY, DVec2::ZERO);
            let is_inside = |corner: &[f64; 2]| obstacle.distance_m(DVec2::from(*corner)) < 1e-9;
            assert!(corners.iter().all(is_inside), "{shape:?}");
            let [start, end] = shape.axis_in_model;
            let round_m2 = std::f64::consts::PI * shape.radius_m * shape.radius_m;
            let area_m2 = 2.0 * start.distance(end) * shape.radius_m + round_m2;
            assert!(area_m2 <= max_area_m2, "{shape:?} {area_m2}");
        };
        // At most the circle around a square.
        let square = [[0.3, 0.3], [-0.3, 0.3], [-0.3, -0.3], [0.3, -0.3]];
        check(&square, std::f64::consts::PI * 0.18);
        // 1.6 m by 0.2 m: an axis of 1.5 m whose ends are 0.05 m before the sides.
        let radius_m = libm::hypot(0.05, 0.1);
        let long = [[0.8, 0.1], [-0.8, 0.1], [-0.8, -0.1], [0.8, -0.1]];
        check(&long, 3.0 * radius_m + std::f64::consts::PI * radius_m * radius_m + 1e-9);
        let unknown = RobotShape::around(None);
        assert_eq!((unknown.axis_in_model, unknown.radius_m), ([DVec2::ZERO; 2], 0.3));
    }

    #[test]
    fn a_capsule_moves_with_its_robot() {
        let square = [[0.5, 0.1], [0.3, 0.1], [0.3, -0.1], [0.5, -0.1]];
        let shape = RobotShape::around(Some(&square));
        let pose = Pose2::new(1.0, 2.0, std::f64::consts::FRAC_PI_2);
        let world_from_model = Pose::from_xyz_rpy(
            [pose.x_m, pose.y_m, 0.0],
            periplus_geometry::Rpy { roll: 0.0, pitch: 0.0, yaw: pose.yaw_rad },
        );
        let found = shape.at(world_from_model, DVec2::X);
        let middle = 0.5 * (found.axis[0] + found.axis[1]);
        assert!(middle.distance(DVec2::new(1.0, 2.4)) < 1e-9, "{found:?}");
        assert_eq!(found.velocity, DVec2::X);
    }
}
