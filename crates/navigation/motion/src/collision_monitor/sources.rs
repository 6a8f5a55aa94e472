//! Points from sensor data, in the frame of the data \[m\].

use periplus_costmap::{Costmap, cost};

/// Maximum number of points of one range reading; the value of Nav2.
const MAX_RANGE_POINT_COUNT: f64 = 1e4;

/// Returns the points of a laser scan with ranges within the limits of the sensor.
#[must_use]
pub fn scan_points(
    ranges_m: &[f32],
    angle_min_rad: f64,
    angle_increment_rad: f64,
    limits_m: [f32; 2],
) -> Vec<[f64; 3]> {
    let [range_min_m, range_max_m] = limits_m;
    let readings = ranges_m.iter().enumerate();
    let valid = readings.filter(|(_, range)| range_min_m <= **range && **range <= range_max_m);
    valid
        .map(|(index, range)| {
            let angle_rad = angle_min_rad + index as f64 * angle_increment_rad;
            on_arc(f64::from(*range), angle_rad)
        })
        .collect()
}

/// Returns points on the arc of a range reading, `step_rad` apart; none if they were too many or the
/// step is not positive.
#[must_use]
pub fn range_points(range_m: f64, field_of_view_rad: f64, step_rad: f64) -> Option<Vec<[f64; 3]>> {
    let count = libm::ceil(field_of_view_rad / step_rad) + 1.0;
    let is_possible = step_rad > 0.0 && (0.0..=MAX_RANGE_POINT_COUNT).contains(&count);
    if !is_possible {
        return None;
    }
    let last_rad = field_of_view_rad / 2.0;
    let mut points = Vec::new();
    let mut angle_rad = -last_rad;
    while angle_rad < last_rad {
        points.push(on_arc(range_m, angle_rad));
        angle_rad += step_rad;
    }
    points.push(on_arc(range_m, last_rad));
    Some(points)
}

fn on_arc(range_m: f64, angle_rad: f64) -> [f64; 3] {
    let (sine, cosine) = libm::sincos(angle_rad);
    [range_m * cosine, range_m * sine, 0.0]
}

/// Returns points on the sides of a polygon, at most `distance_m` apart, both ends of each side
/// included.
#[must_use]
pub fn polygon_points(corners: &[[f64; 2]], distance_m: f64) -> Vec<[f64; 3]> {
    let mut points = Vec::new();
    let ends = corners.iter().cycle().skip(1);
    for (start, end) in corners.iter().zip(ends) {
        let [along_x, along_y] = [end[0] - start[0], end[1] - start[1]];
        let parts = libm::ceil(libm::hypot(along_x, along_y) / distance_m);
        // A step of zero or less gives the corners.
        let parts = if parts.is_finite() { parts.clamp(1.0, MAX_RANGE_POINT_COUNT) } else { 1.0 };
        for index in 0..=parts as usize {
            let part = index as f64 / parts;
            points.push([start[0] + part * along_x, start[1] + part * along_y, 0.0]);
        }
    }
    points
}

/// Returns the centres of the cells with a cost from `min_cost` on, and of unknown cells if they
/// count as obstacles.
#[must_use]
pub fn costmap_points(costmap: &Costmap, min_cost: u8, unknown_is_obstacle: bool) -> Vec<[f64; 3]> {
    let info = costmap.info();
    let is_obstacle = |value: u8| {
        if value == cost::UNKNOWN { unknown_is_obstacle } else { value >= min_cost }
    };
    let cells = costmap.costs().iter().enumerate().filter(|(_, value)| is_obstacle(**value));
    cells
        .map(|(index, _)| {
            let (column, row) = (index % info.width, index / info.width);
            [
                info.origin.x_m + (column as f64 + 0.5) * info.resolution_m,
                info.origin.y_m + (row as f64 + 0.5) * info.resolution_m,
                0.0,
            ]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use periplus_geometry::Pose2;
    use periplus_grid::GridInfo;

    use super::*;

    fn check(points: Vec<[f64; 3]>, expected: &[[f64; 2]]) {
        assert_eq!(points.len(), expected.len(), "{points:?}");
        for (point, expected) in points.iter().zip(expected) {
            let distance = libm::hypot(point[0] - expected[0], point[1] - expected[1]);
            assert!(distance < 1e-9, "{points:?}");
        }
    }

    #[test]
    fn readings_become_points() {
        let ranges = [0.05, 1.0, 2.0, f32::INFINITY, f32::NAN];
        let scan = scan_points(&ranges, -FRAC_PI_2, FRAC_PI_2, [0.1, 5.0]);
        check(scan, &[[1.0, 0.0], [0.0, 2.0]]);
        let arc = range_points(1.0, 2.0 * FRAC_PI_2, FRAC_PI_2 * 0.75).unwrap();
        let side = libm::sin(FRAC_PI_2 / 4.0);
        let ahead = libm::cos(FRAC_PI_2 / 4.0);
        let half = libm::sqrt(0.5);
        check(arc, &[[0.0, -1.0], [ahead, -side], [half, half], [0.0, 1.0]]);
        assert_eq!(range_points(1.0, 1.0, 0.0), None);
        assert_eq!(range_points(1.0, 1.0, 1e-6), None);
    }

    #[test]
    fn sides_are_sampled_with_both_ends() {
        let triangle = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.4]];
        let points = polygon_points(&triangle, 0.5);
        let bottom = [[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]];
        let right = [[1.0, 0.0], [1.0, 0.4]];
        let last = [[1.0, 0.4], [2.0 / 3.0, 0.8 / 3.0], [1.0 / 3.0, 0.4 / 3.0], [0.0, 0.0]];
        check(points, &[&bottom[..], &right, &last].concat());
        assert_eq!(polygon_points(&triangle, 0.0).len(), 6);
    }

    #[test]
    fn cells_above_a_cost_are_points() {
        let info = GridInfo::new(0.5, 2, 2, Pose2::new(1.0, 2.0, 0.0)).unwrap();
        let mut costmap = Costmap::new(info, 0);
        costmap.set((1, 0), 253);
        costmap.set((0, 1), 255);
        check(costmap_points(&costmap, 253, false), &[[1.75, 2.25]]);
        check(costmap_points(&costmap, 253, true), &[[1.75, 2.25], [1.25, 2.75]]);
        check(costmap_points(&costmap, 254, false), &[]);
    }
}
