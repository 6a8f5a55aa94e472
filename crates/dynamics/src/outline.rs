//! Prisms over outlines, as the convex pieces that a solver wants.

use periplus_base::DVec3;
use periplus_scene::Polyline;

/// More corners than this in one shape are refused: the pieces are as many as their square, at worst.
const MOST_CORNERS: usize = 256;

/// The corners of convex pieces that fill the area inside an odd number of the outlines, from 0 to the
/// height of the first along z. An outline closes by itself.
///
/// # Errors
/// What is wrong, to be read after the shape's name.
pub(crate) fn pieces(outlines: &[Polyline]) -> Result<Vec<[DVec3; 8]>, String> {
    let height_m = outlines.first().map_or(0.0, |first| first.height_m);
    let corners: Vec<[f64; 2]> =
        outlines.iter().flat_map(|outline| outline.points_m.iter().copied()).collect();
    if corners.len() > MOST_CORNERS {
        return Err(format!("has {} corners, more than {MOST_CORNERS}", corners.len()));
    }
    let finite = corners.iter().flatten().all(|number| number.is_finite());
    if !(finite && height_m.is_finite() && height_m > 0.0) {
        return Err("has a corner or a height that is not finite and positive".into());
    }
    let edges: Vec<[[f64; 2]; 2]> = outlines
        .iter()
        .flat_map(|outline| {
            let points = &outline.points_m;
            (0..points.len()).map(|from| [points[from], points[(from + 1) % points.len()]])
        })
        .collect();
    let mut levels: Vec<f64> = corners.iter().map(|corner| corner[1]).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut pieces = Vec::new();
    // Between two levels no outline has a corner: what is inside are trapezoids.
    for slab in levels.windows(2) {
        let [low, high] = [slab[0], slab[1]];
        let mut across: Vec<[f64; 2]> =
            edges.iter().filter_map(|edge| crossing(edge, low, high)).collect();
        across.sort_by(|a, b| f64::total_cmp(&(a[0] + a[1]), &(b[0] + b[1])));
        for pair in across.chunks_exact(2) {
            let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
            let [left, right] = [pair[0], pair[1]];
            pieces.push([
                at(left[0], low, 0.0),
                at(right[0], low, 0.0),
                at(left[1], high, 0.0),
                at(right[1], high, 0.0),
                at(left[0], low, height_m),
                at(right[0], low, height_m),
                at(left[1], high, height_m),
                at(right[1], high, height_m),
            ]);
        }
    }
    if pieces.is_empty() { Err("encloses nothing".into()) } else { Ok(pieces) }
}

/// Where an edge that spans a slab meets its two levels.
fn crossing(edge: &[[f64; 2]; 2], low: f64, high: f64) -> Option<[f64; 2]> {
    let [[ax, ay], [bx, by]] = *edge;
    let spans = ay.min(by) <= low && ay.max(by) >= high && ay != by;
    let at = |y: f64| ax + (bx - ax) * ((y - ay) / (by - ay));
    spans.then(|| [at(low), at(high)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(pieces: &[[DVec3; 8]]) -> f64 {
        let trapezoid = |piece: &[DVec3; 8]| {
            let widths = (piece[1].x - piece[0].x) + (piece[3].x - piece[2].x);
            widths / 2.0 * (piece[2].y - piece[0].y)
        };
        pieces.iter().map(trapezoid).sum()
    }

    fn outline(points: &[[f64; 2]]) -> Polyline {
        Polyline { points_m: points.to_vec(), height_m: 1.0 }
    }

    #[test]
    fn a_corner_room_and_a_frame() {
        let corner =
            outline(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
        assert_eq!(area(&pieces(&[corner]).unwrap_or_default()), 3.0);
        let square =
            |size: f64| outline(&[[-size, -size], [size, -size], [size, size], [-size, size]]);
        let frame = pieces(&[square(2.0), square(1.0)]).unwrap_or_default();
        assert_eq!((frame.len(), area(&frame)), (4, 12.0));
    }

    #[test]
    fn what_encloses_nothing_is_said() {
        assert!(pieces(&[]).is_err());
        assert!(pieces(&[outline(&[[0.0, 0.0], [1.0, 0.0]])]).is_err());
        assert!(pieces(&[outline(&[[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]])]).is_err());
        assert!(pieces(&[outline(&vec![[0.0, 0.0]; 1000])]).is_err());
    }
}
