//! Decomposition of outlines into trapezoids.

use std::fmt;

use crate::shape::Polyline;

/// Edge of an outline [m].
pub type OutlineEdge = [[f64; 2]; 2];

/// Trapezoid inside outlines, with two sides parallel to x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trapezoid {
    /// Positions of its lower and its upper side along y [m].
    pub y_m: [f64; 2],
    /// Extent of the lower side along x [m].
    pub low_m: [f64; 2],
    /// Extent of the upper side along x [m].
    pub high_m: [f64; 2],
}

/// Fault of an outline. Its text completes a sentence that starts with the name of the shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutlineError {
    /// More corners than allowed.
    TooManyCorners {
        /// Number of corners.
        count: usize,
        /// Maximum number of corners.
        max: usize,
    },
    /// A corner that is not finite, or a height that is not finite and positive.
    NotFinite,
    /// Fewer than three corners.
    TooFewCorners,
}

impl fmt::Display for OutlineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyCorners { count, max } => {
                write!(f, "has {count} corners, more than {max}")
            }
            Self::NotFinite => {
                write!(f, "has a corner or a height that is not finite and positive")
            }
            Self::TooFewCorners => write!(f, "has fewer than three corners"),
        }
    }
}

impl std::error::Error for OutlineError {}

/// Returns the edges of the outlines of a shape. Outlines are closed implicitly.
///
/// # Errors
/// If the outlines enclose no area, or have too many corners.
pub fn edges(outlines: &[Polyline], max_corners: usize) -> Result<Vec<OutlineEdge>, OutlineError> {
    let corners: usize = outlines.iter().map(|outline| outline.points_m.len()).sum();
    if corners > max_corners {
        return Err(OutlineError::TooManyCorners { count: corners, max: max_corners });
    }
    let height_m = outlines.first().map_or(0.0, |first| first.height_m);
    let mut numbers = outlines.iter().flat_map(|outline| &outline.points_m).flatten();
    if !(numbers.all(|number| number.is_finite()) && height_m.is_finite() && height_m > 0.0) {
        return Err(OutlineError::NotFinite);
    }
    let mut edges = Vec::with_capacity(corners);
    for outline in outlines {
        let points = &outline.points_m;
        for (index, &from) in points.iter().enumerate() {
            let to = points[(index + 1) % points.len()];
            if from != to {
                edges.push([from, to]);
            }
        }
    }
    if edges.len() < 3 {
        return Err(OutlineError::TooFewCorners);
    }
    Ok(edges)
}

/// Returns the area inside an odd number of outlines.
///
/// The area is cut at the y of every corner. Between two cuts no edge ends, and every second gap between
/// edges is inside. Outlines that intersect themselves are cut at their corners only.
#[must_use]
pub fn trapezoids(edges: &[OutlineEdge]) -> Vec<Trapezoid> {
    let mut levels: Vec<f64> = edges.iter().map(|[[_, y], _]| *y).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut pieces = Vec::new();
    for pair in levels.windows(2) {
        let y_m = [pair[0], pair[1]];
        let mut crossings: Vec<[f64; 2]> = edges
            .iter()
            .filter(|[[_, a], [_, b]]| a.min(*b) <= y_m[0] && a.max(*b) >= y_m[1])
            .map(|edge| y_m.map(|y| x_at(edge, y)))
            .collect();
        crossings.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        for inside in crossings.chunks_exact(2) {
            let [low_m, high_m] = [0, 1].map(|end: usize| [inside[0][end], inside[1][end]]);
            pieces.push(Trapezoid { y_m, low_m, high_m });
        }
    }
    pieces
}

fn x_at([[ax, ay], [bx, by]]: &OutlineEdge, y: f64) -> f64 {
    if y == *ay {
        *ax
    } else if y == *by {
        *bx
    } else {
        ax + (bx - ax) * ((y - ay) / (by - ay))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(points: &[[f64; 2]]) -> Polyline {
        Polyline { points_m: points.to_vec(), height_m: 1.0 }
    }

    fn area(outlines: &[Polyline]) -> f64 {
        let width = |[from, to]: [f64; 2]| to - from;
        let pieces = trapezoids(&edges(outlines, 100).unwrap());
        pieces.iter().map(|it| (width(it.low_m) + width(it.high_m)) / 2.0 * width(it.y_m)).sum()
    }

    #[test]
    fn a_corner_room_and_a_frame() {
        let corner = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        assert_eq!(area(&[outline(&corner)]), 3.0);
        let square =
            |size: f64| outline(&[[-size, -size], [size, -size], [size, size], [-size, size]]);
        assert_eq!(area(&[square(2.0), square(1.0)]), 12.0);
    }

    #[test]
    fn nothing_and_too_much_are_told() {
        assert!(edges(&[], 100).is_err());
        assert!(edges(&[outline(&[[0.0, 0.0], [1.0, 0.0]])], 100).is_err());
        assert!(edges(&[outline(&[[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]])], 100).is_err());
        assert!(edges(&[outline(&[[0.0, 0.0]; 101])], 100).is_err());
    }
}
