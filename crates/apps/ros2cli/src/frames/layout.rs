//! Layout of a tree: layers from the top down, siblings side by side, a parent centred above its
//! children, subtrees as close as their outlines allow.
//!
//! Source: E. M. Reingold and J. S. Tilford, "Tidier Drawings of Trees", 1981; each subtree stores
//! its extent to both sides on every layer.

use crate::frames::forest::Forest;

/// Distance between neighbours on a layer \[pt\].
const GAP_PT: f64 = 18.0;
/// Distance between trees \[pt\].
const TREE_GAP_PT: f64 = 48.0;

/// Horizontal centre and layer of each frame.
pub(crate) struct Layout {
    /// Horizontal centre by frame index \[pt\].
    pub(crate) middle: Vec<f64>,
    /// Layer by frame index, 0 at the top.
    pub(crate) layer: Vec<usize>,
    /// Total width \[pt\].
    pub(crate) width: f64,
    /// Number of layers.
    pub(crate) layers: usize,
}

/// Extent of a subtree to the left and right of its top, by layer.
type Outline = Vec<(f64, f64)>;

/// Lays out frames of these widths \[pt\].
pub(crate) fn layout(forest: &Forest, widths: &[f64]) -> Layout {
    let order = forest.downward();
    let count = widths.len();
    // Offset to the right of the centre of the parent.
    let mut offset = vec![0.0; count];
    let mut outlines: Vec<Outline> = vec![Vec::new(); count];
    for &frame in order.iter().rev() {
        let children: Vec<usize> = forest.below(frame).collect();
        let (mut below, places) = side_by_side(&children, &mut outlines, GAP_PT);
        let middle = match (places.first(), places.last()) {
            (Some(first), Some(last)) => 0.5 * (first + last),
            _ => 0.0,
        };
        for (&child, place) in children.iter().zip(places) {
            offset[child] = place - middle;
        }
        for (left, right) in &mut below {
            *left -= middle;
            *right -= middle;
        }
        let half = 0.5 * widths[frame];
        below.insert(0, (-half, half));
        outlines[frame] = below;
    }
    let (all, places) = side_by_side(&forest.tops, &mut outlines, TREE_GAP_PT);
    let left = all.iter().map(|(left, _)| *left).fold(0.0, f64::min);
    let right = all.iter().map(|(_, right)| *right).fold(0.0, f64::max);
    let mut layout = Layout {
        middle: vec![0.0; count],
        layer: vec![0; count],
        width: right - left,
        layers: all.len(),
    };
    for (&top, place) in forest.tops.iter().zip(places) {
        layout.middle[top] = place - left;
    }
    for &frame in &order {
        for child in forest.below(frame) {
            layout.middle[child] = layout.middle[frame] + offset[child];
            layout.layer[child] = layout.layer[frame] + 1;
        }
    }
    layout
}

/// Arranges subtrees side by side, the first at 0: the outline of all, and the offset of each.
fn side_by_side(tops: &[usize], outlines: &mut [Outline], gap: f64) -> (Outline, Vec<f64>) {
    let mut all = Outline::new();
    let mut places = Vec::new();
    for &top in tops {
        let outline = std::mem::take(&mut outlines[top]);
        let needed = all.iter().zip(&outline).map(|((_, right), (left, _))| right - left + gap);
        let place = if places.is_empty() { 0.0 } else { needed.fold(f64::NEG_INFINITY, f64::max) };
        places.push(place);
        for (layer, (left, right)) in outline.into_iter().enumerate() {
            let (left, right) = (left + place, right + place);
            match all.get_mut(layer) {
                Some(so_far) => *so_far = (so_far.0.min(left), so_far.1.max(right)),
                None => all.push((left, right)),
            }
        }
    }
    (all, places)
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose;
    use periplus_tf::{StampedTransform, TransformKind, TransformMonitor};

    use super::*;

    fn laid(edges: &[(&str, &str)]) -> (Forest, Layout) {
        let mut survey = TransformMonitor::default();
        for (parent, child) in edges {
            let it = StampedTransform::new(*parent, *child, 1, Pose::IDENTITY);
            survey.insert(&it, "test", TransformKind::Moving).unwrap();
        }
        let forest = Forest::new(&survey);
        let layout = layout(&forest, &vec![100.0; forest.frames.len()]);
        (forest, layout)
    }

    #[test]
    fn a_parent_is_over_the_middle_of_its_children() {
        let (_, layout) = laid(&[("a", "b"), ("a", "c"), ("a", "d")]);
        assert_eq!(layout.middle, [168.0, 50.0, 168.0, 286.0]);
        assert_eq!(layout.layer, [0, 1, 1, 1]);
        assert_eq!((layout.width, layout.layers), (336.0, 2));
    }

    #[test]
    fn nothing_overlaps() {
        let (forest, layout) = laid(&[
            ("a", "b"),
            ("a", "c"),
            ("b", "d"),
            ("b", "e"),
            ("b", "f"),
            ("c", "g"),
            ("g", "h"),
            ("g", "i"),
            ("x", "y"),
        ]);
        for one in 0..forest.frames.len() {
            for other in 0..one {
                let apart = (layout.middle[one] - layout.middle[other]).abs();
                assert!(layout.layer[one] != layout.layer[other] || apart >= 100.0 + GAP_PT - 1e-9);
            }
            assert!(layout.middle[one] >= 50.0 && layout.middle[one] <= layout.width - 50.0);
        }
    }

    #[test]
    fn a_long_chain_is_laid_out() {
        let names: Vec<String> = (0..5000).map(|number| format!("f{number:05}")).collect();
        let edges: Vec<_> =
            names.windows(2).map(|two| (two[0].as_str(), two[1].as_str())).collect();
        let (_, layout) = laid(&edges);
        assert_eq!((layout.layers, layout.width), (5000, 100.0));
    }
}
