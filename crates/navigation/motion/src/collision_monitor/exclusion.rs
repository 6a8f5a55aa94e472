//! Exclusion zones: points of a source that are ignored.

use periplus_geometry::{DVec3, Pose};

use super::CollisionPoint;
use super::shape::MonitorShape;
use crate::outline::is_in_polygon;

/// Area in which points are ignored, such as a charger.
#[derive(Clone, Debug, PartialEq)]
pub struct ExclusionMask {
    /// Shape, in the frame of the zone. A circle includes its border.
    pub shape: MonitorShape,
    /// Minimum and maximum height of ignored points in the base frame \[m\].
    pub heights_m: [f64; 2],
}

impl ExclusionMask {
    /// Corners for display, in the base frame \[m\].
    #[must_use]
    pub fn outline(&self, base_from_zone: Pose) -> Vec<[f64; 2]> {
        let place = |[x, y]: &[f64; 2]| {
            let point = base_from_zone.transform_point(DVec3::new(*x, *y, 0.0));
            [point.x, point.y]
        };
        self.shape.outline().iter().map(place).collect()
    }
}

/// Removes the points within an exclusion zone. `base_from_zone` is the pose of the zone.
pub fn exclude(points: &mut Vec<CollisionPoint>, mask: &ExclusionMask, base_from_zone: Pose) {
    let [lowest_m, highest_m] = mask.heights_m;
    let has_height = |point: &CollisionPoint| lowest_m <= point.z_m && point.z_m <= highest_m;
    match &mask.shape {
        MonitorShape::Circle { radius_m } => {
            let centre = base_from_zone.translation;
            points.retain(|point| {
                let (x, y) = (point.x_m - centre.x, point.y_m - centre.y);
                !(has_height(point) && x * x + y * y <= radius_m * radius_m)
            });
        }
        MonitorShape::Polygon(_) => {
            let corners = mask.outline(base_from_zone);
            points.retain(|point| {
                !(has_height(point) && is_in_polygon(&corners, point.x_m, point.y_m))
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_in_the_zone_are_removed() {
        let check = |shape: MonitorShape, heights_m: [f64; 2], expected: &[f64]| {
            let mut points: Vec<CollisionPoint> =
                [0.0, 1.0, 2.0, 3.0].map(|x_m| CollisionPoint { x_m, y_m: 0.1, z_m: 0.5 }).to_vec();
            let mask = ExclusionMask { shape, heights_m };
            exclude(&mut points, &mask, Pose::from_xyz(2.0, 0.0, 0.0));
            let kept: Vec<f64> = points.iter().map(|point| point.x_m).collect();
            assert_eq!(kept, expected);
        };
        let all = [f64::MIN, f64::MAX];
        check(MonitorShape::Circle { radius_m: 0.5 }, all, &[0.0, 1.0, 3.0]);
        check(MonitorShape::Circle { radius_m: 0.5 }, [0.6, 2.0], &[0.0, 1.0, 2.0, 3.0]);
        let square = vec![[-1.5, -1.0], [0.5, -1.0], [0.5, 1.0], [-1.5, 1.0]];
        check(MonitorShape::Polygon(square), all, &[0.0, 3.0]);
    }
}
