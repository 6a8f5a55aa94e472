//! Prisms over outlines, with holes.

use periplus_scene::Polyline;

use crate::mesh::Selected;

/// More corners than this in one shape are refused: the caps take work of their square.
const MOST_CORNERS: usize = 1024;

/// Positions and triangles of the prism over the area inside an odd number of the outlines, from 0
/// to the height of the first along z. An outline closes by itself.
///
/// # Errors
/// What is wrong, to be read after the shape's name.
pub(crate) fn extrude(outlines: &[Polyline]) -> Result<Selected, String> {
    let height_m = outlines.first().map_or(0.0, |first| first.height_m);
    let corners: usize = outlines.iter().map(|outline| outline.points_m.len()).sum();
    if corners > MOST_CORNERS {
        return Err(format!("has {corners} corners, more than {MOST_CORNERS}"));
    }
    let finite =
        outlines.iter().flat_map(|outline| &outline.points_m).flatten().all(|x| x.is_finite());
    if !(finite && height_m.is_finite() && height_m > 0.0) {
        return Err("has a corner or a height that is not finite and positive".into());
    }
    let mut edges = Vec::new();
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
        return Err("has fewer than three corners".into());
    }
    let mut prism = Prism::default();
    for [[ax, ay], [bx, by]] in &edges {
        prism.quad([[*ax, *ay, 0.0], [*bx, *by, 0.0], [*bx, *by, height_m], [*ax, *ay, height_m]]);
    }
    for Trapezoid { y: [low, high], at_low: [a, b], at_high: [c, d] } in trapezoids(&edges) {
        for z in [0.0, height_m] {
            prism.quad([[a, low, z], [b, low, z], [d, high, z], [c, high, z]]);
        }
    }
    Ok(prism.0)
}

#[derive(Default)]
struct Prism(Selected);

impl Prism {
    fn quad(&mut self, corners: [[f64; 3]; 4]) {
        let Selected { positions_m, triangles, .. } = &mut self.0;
        #[expect(clippy::cast_possible_truncation, reason = "the corners are limited")]
        let first = positions_m.len() as u32;
        positions_m.extend(corners);
        triangles.push([first, first + 1, first + 2]);
        triangles.push([first, first + 2, first + 3]);
    }
}

type Edge = [[f64; 2]; 2];

/// A piece of the area between two levels of y, from one x to another at either.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Trapezoid {
    y: [f64; 2],
    at_low: [f64; 2],
    at_high: [f64; 2],
}

/// Cuts the area at the y of every corner; between two cuts its edges do not end, and every second
/// gap between them is inside. Outlines that cross themselves are cut where their corners are only.
fn trapezoids(edges: &[Edge]) -> Vec<Trapezoid> {
    let mut levels: Vec<f64> = edges.iter().map(|[[_, y], _]| *y).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut pieces = Vec::new();
    for pair in levels.windows(2) {
        let y = [pair[0], pair[1]];
        let mut crossings: Vec<[f64; 2]> = edges
            .iter()
            .filter(|[[_, a], [_, b]]| a.min(*b) <= y[0] && a.max(*b) >= y[1])
            .map(|edge| y.map(|y| x_at(edge, y)))
            .collect();
        crossings.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        for inside in crossings.chunks_exact(2) {
            let [at_low, at_high] = [0, 1].map(|end: usize| [inside[0][end], inside[1][end]]);
            pieces.push(Trapezoid { y, at_low, at_high });
        }
    }
    pieces
}

fn x_at([[ax, ay], [bx, by]]: &Edge, y: f64) -> f64 {
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
        let Selected { positions_m, triangles, .. } = extrude(outlines).unwrap();
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

    #[test]
    fn nothing_and_too_much_are_told() {
        assert!(extrude(&[]).is_err());
        let line = Polyline { points_m: vec![[0.0, 0.0], [1.0, 0.0]], height_m: 1.0 };
        assert!(extrude(&[line]).is_err());
        let many = Polyline { points_m: vec![[0.0, 0.0]; MOST_CORNERS + 1], height_m: 1.0 };
        assert!(extrude(&[many]).is_err());
        let bad = Polyline { points_m: vec![[0.0, f64::NAN]; 3], height_m: 1.0 };
        assert!(extrude(&[bad]).is_err());
    }
}
