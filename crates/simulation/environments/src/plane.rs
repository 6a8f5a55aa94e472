//! Vectors and segments of the plane.

/// Point or vector in the plane \[m\].
pub(crate) type Point2 = [f64; 2];

pub(crate) fn minus(a: Point2, b: Point2) -> Point2 {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn dot(a: Point2, b: Point2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross(a: Point2, b: Point2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn squared_distance(a: Point2, b: Point2) -> f64 {
    let difference = minus(a, b);
    dot(difference, difference)
}

/// Returns the squared distance from a point to a segment \[m²\].
pub(crate) fn squared_distance_to_segment(point: Point2, [a, b]: [Point2; 2]) -> f64 {
    let (along, from_a) = (minus(b, a), minus(point, a));
    let length_squared = dot(along, along);
    if length_squared == 0.0 {
        return dot(from_a, from_a);
    }
    let fraction = (dot(from_a, along) / length_squared).clamp(0.0, 1.0);
    squared_distance(from_a, [along[0] * fraction, along[1] * fraction])
}

/// Returns true if two segments cross in a point inside both. Segments that touch are at distance zero by their ends.
fn segments_cross([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> bool {
    let side = |from: Point2, to: Point2, point| cross(minus(to, from), minus(point, from));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Sides of a closed outline; of two corners one segment.
pub(crate) fn sides(corners: &[Point2]) -> impl Iterator<Item = [Point2; 2]> + '_ {
    let count = if corners.len() == 2 { 1 } else { corners.len() };
    (0..count).map(|at| [corners[at], corners[(at + 1) % corners.len()]])
}

/// Returns true if a point is inside a simple outline of at least three corners, by the number of sides that a ray
/// along x crosses.
pub(crate) fn contains(corners: &[Point2], point: Point2) -> bool {
    if corners.len() < 3 {
        return false;
    }
    let crossed = sides(corners).filter(|[a, b]| {
        (a[1] > point[1]) != (b[1] > point[1])
            && point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// Returns the distance from a point to an area with this outline; zero inside \[m\].
pub(crate) fn distance_to_outline(corners: &[Point2], point: Point2) -> f64 {
    if contains(corners, point) {
        return 0.0;
    }
    let squared = sides(corners).map(|side| squared_distance_to_segment(point, side));
    squared.fold(f64::INFINITY, f64::min).sqrt()
}

/// Returns the distance between two areas with simple outlines; zero if they overlap \[m\].
pub(crate) fn distance_of_outlines(one: &[Point2], other: &[Point2]) -> f64 {
    let crosses = || sides(one).any(|a| sides(other).any(|b| segments_cross(a, b)));
    let is_inside = one.first().is_some_and(|corner| contains(other, *corner))
        || other.first().is_some_and(|corner| contains(one, *corner));
    if is_inside || crosses() {
        return 0.0;
    }
    let corners_to_sides = |corners: &[Point2], of: &[Point2]| {
        let pairs = corners.iter().flat_map(|corner| {
            sides(of).map(move |side| squared_distance_to_segment(*corner, side))
        });
        pairs.fold(f64::INFINITY, f64::min)
    };
    corners_to_sides(one, other).min(corners_to_sides(other, one)).sqrt()
}

/// Returns the corners of the convex hull, counterclockwise (Andrew 1979, "Another efficient algorithm for convex
/// hulls in two dimensions"). Fewer than three corners if all points are on a line.
pub(crate) fn convex_hull(mut points: Vec<Point2>) -> Vec<Point2> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let chain = |points: &mut dyn Iterator<Item = Point2>| {
        let mut hull: Vec<Point2> = Vec::new();
        for point in points {
            while let [.., a, b] = hull[..]
                && cross(minus(b, a), minus(point, b)) <= 0.0
            {
                hull.pop();
            }
            hull.push(point);
        }
        hull.pop();
        hull
    };
    let mut hull = chain(&mut points.iter().copied());
    hull.extend(chain(&mut points.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [Point2; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];

    #[test]
    fn distances_to_a_square() {
        let check = |point, expected| assert_eq!(distance_to_outline(&SQUARE, point), expected);
        check([1.0, 1.0], 0.0);
        check([5.0, 6.0], 5.0);
        check([1.0, -3.0], 3.0);
    }

    #[test]
    fn distances_between_outlines() {
        let check = |other: &[Point2], expected| {
            assert_eq!(distance_of_outlines(&SQUARE, other), expected);
            assert_eq!(distance_of_outlines(other, &SQUARE), expected);
        };
        check(&[[3.0, 0.0], [4.0, 1.0], [3.0, 2.0]], 1.0);
        // A cross: no corner is inside the other.
        check(&[[0.5, -1.0], [1.5, -1.0], [1.5, 3.0], [0.5, 3.0]], 0.0);
        check(&[[0.9, 0.9], [1.1, 0.9], [1.0, 1.1]], 0.0);
        // A wall without thickness.
        check(&[[-1.0, 1.0], [3.0, 1.0]], 0.0);
        check(&[[-1.0, -2.0], [3.0, -2.0]], 2.0);
        check(&[[5.0, 6.0]], 5.0);
    }

    #[test]
    fn the_hull_of_a_square_with_points_inside_and_on_its_sides() {
        let inner = [[1.0, 1.0], [1.0, 0.0], [2.0, 1.0], [0.0, 0.0]];
        let points = inner.into_iter().chain(SQUARE).collect();
        assert_eq!(convex_hull(points), SQUARE);
        assert_eq!(convex_hull(vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), [[0.0, 0.0], [2.0, 2.0]]);
    }
}
