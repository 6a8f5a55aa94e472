//! Prisms over polylines, with holes.

use periplus_scene::{Polyline, Trapezoid, edges, trapezoids};

use crate::mesh::SelectedMesh;

/// Maximum number of corners in a shape: triangulation is quadratic.
const MAX_CORNERS: usize = 1024;

/// Returns positions and triangles of the prism over the area inside an odd number of the outlines,
/// from z = 0 to the height of the first outline. Outlines are closed implicitly.
///
/// # Errors
/// The problem, as a clause that follows the shape's name.
pub(crate) fn extrude(outlines: &[Polyline]) -> Result<SelectedMesh, String> {
    let edges = edges(outlines, MAX_CORNERS).map_err(|error| error.to_string())?;
    let height_m = outlines.first().map_or(0.0, |first| first.height_m);
    let mut prism = Prism::default();
    for [[ax, ay], [bx, by]] in &edges {
        prism.quad([[*ax, *ay, 0.0], [*bx, *by, 0.0], [*bx, *by, height_m], [*ax, *ay, height_m]]);
    }
    for Trapezoid { y_m: [low, high], low_m: [a, b], high_m: [c, d] } in trapezoids(&edges) {
        for z in [0.0, height_m] {
            prism.quad([[a, low, z], [b, low, z], [d, high, z], [c, high, z]]);
        }
    }
    Ok(prism.0)
}

#[derive(Default)]
struct Prism(SelectedMesh);

impl Prism {
    fn quad(&mut self, corners: [[f64; 3]; 4]) {
        let SelectedMesh { positions_m, triangles, .. } = &mut self.0;
        #[expect(clippy::cast_possible_truncation, reason = "the corners are limited")]
        let first = positions_m.len() as u32;
        positions_m.extend(corners);
        triangles.push([first, first + 1, first + 2]);
        triangles.push([first, first + 2, first + 3]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(middle: [f64; 2], half: f64) -> Polyline {
        let [x, y] = middle;
        let points_m = vec![
            [x - half, y - half],
            [x + half, y - half],
            [x + half, y + half],
            [x - half, y + half],
        ];
        Polyline { points_m, height_m: 2.0 }
    }

    fn area(outlines: &[Polyline]) -> f64 {
        let SelectedMesh { positions_m, triangles, .. } = extrude(outlines).unwrap();
        let flat = triangles.iter().map(|t| t.map(|corner| positions_m[corner as usize]));
        flat.filter(|corners| corners.iter().all(|corner| corner[2] == 2.0))
            .map(|[a, b, c]| {
                ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs() / 2.0
            })
            .sum()
    }

    #[test]
    fn a_square_of_two_metres_with_a_hole_of_one() {
        assert_eq!(area(&[square([0.0, 0.0], 1.0)]), 4.0);
        assert_eq!(area(&[square([0.0, 0.0], 1.0), square([0.25, 0.25], 0.5)]), 3.0);
    }

    #[test]
    fn a_shape_like_the_letter_l() {
        let points_m = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        assert_eq!(area(&[Polyline { points_m, height_m: 2.0 }]), 4.0);
    }
}
