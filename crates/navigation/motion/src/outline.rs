//! Points in polygons.

use periplus_costmap::footprint::distance_to_side_m;

/// Growth of an overlap of outline and obstacles that rounding causes \[m\].
pub(crate) const SAME_OVERLAP_M: f64 = 1e-6;

/// True if a ray along x from a point crosses the sides of a polygon an odd number of times
/// (Shimrat, "Algorithm 112: position of point relative to polygon", 1962).
pub(crate) fn is_in_polygon(corners: &[[f64; 2]], x_m: f64, y_m: f64) -> bool {
    let Some(mut start) = corners.last() else { return false };
    let mut is_inside = false;
    for end in corners {
        if (y_m <= start[1]) == (y_m > end[1]) {
            let crossing_x_m =
                start[0] + (y_m - start[1]) * (end[0] - start[0]) / (end[1] - start[1]);
            if crossing_x_m > x_m {
                is_inside = !is_inside;
            }
        }
        start = end;
    }
    is_inside
}

/// Distance of a point from the sides of a polygon, negative outside \[m\].
pub(crate) fn inside_m(corners: &[[f64; 2]], x_m: f64, y_m: f64) -> f64 {
    let starts = corners.iter().cycle().skip(corners.len().saturating_sub(1));
    let distances =
        starts.zip(corners).map(|(start, end)| distance_to_side_m([x_m, y_m], *start, *end));
    let distance_m = distances.fold(f64::INFINITY, f64::min);
    if is_in_polygon(corners, x_m, y_m) { distance_m } else { -distance_m }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_negative_outside() {
        let check = |at: [f64; 2], expected_m: f64| {
            let square = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
            let distance_m = inside_m(&square, at[0], at[1]);
            assert!((distance_m - expected_m).abs() < 1e-12, "{distance_m}, expected {expected_m}");
        };
        check([0.0, 0.0], 1.0);
        check([0.9, 0.5], 0.1);
        check([1.5, 0.0], -0.5);
        check([4.0, 5.0], -5.0);
        assert_eq!(inside_m(&[], 0.0, 0.0), f64::NEG_INFINITY);
    }
}
