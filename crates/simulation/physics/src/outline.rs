//! Prisms over polylines, as convex pieces for the solver.

use periplus_geometry::DVec3;
use periplus_scene::{Polyline, Trapezoid, edges, trapezoids};

/// Maximum number of corners in a shape: in the worst case the number of pieces is quadratic.
const MAX_CORNERS: usize = 256;

/// Returns the corners of convex pieces that fill the area inside an odd number of the outlines,
/// from z = 0 to the height of the first outline. Outlines are closed implicitly.
///
/// # Errors
/// The problem, as a clause that follows the shape's name.
pub(crate) fn pieces(outlines: &[Polyline]) -> Result<Vec<[DVec3; 8]>, String> {
    let height_m = outlines.first().map_or(0.0, |first| first.height_m);
    let pieces: Vec<[DVec3; 8]> =
        trapezoids(&edges(outlines, MAX_CORNERS).map_err(|error| error.to_string())?)
            .iter()
            .map(|piece| piece_over(piece, height_m))
            .collect();
    if pieces.is_empty() { Err("encloses nothing".into()) } else { Ok(pieces) }
}

fn piece_over(
    Trapezoid { y_m: [low, high], low_m, high_m }: &Trapezoid,
    height_m: f64,
) -> [DVec3; 8] {
    let corners = |z: f64| {
        [
            DVec3::new(low_m[0], *low, z),
            DVec3::new(low_m[1], *low, z),
            DVec3::new(high_m[0], *high, z),
            DVec3::new(high_m[1], *high, z),
        ]
    };
    let ([a, b, c, d], [e, f, g, h]) = (corners(0.0), corners(height_m));
    [a, b, c, d, e, f, g, h]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_one_block() {
        let points_m = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        let blocks = pieces(&[Polyline { points_m, height_m: 3.0 }]).unwrap();
        assert_eq!(blocks.len(), 1);
        assert_eq!((blocks[0][0], blocks[0][7]), (DVec3::ZERO, DVec3::new(2.0, 1.0, 3.0)));
    }
}
