//! Transform trees.

use std::collections::BTreeMap;

use periplus_tf::{TransformKind, TransformMonitor, display_time};

use crate::frames::faults::TreeFault;

/// Transform from a parent frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// The parent.
    pub parent: String,
    /// Broadcaster, if known.
    pub broadcaster: String,
    /// Static or dynamic.
    pub kind: TransformKind,
    /// Rate \[Hz\]; 10000 for a single sample, as in tf2.
    pub rate_hz: f64,
    /// Stamp of the newest sample \[ns\].
    pub newest_ns: i64,
    /// Stamp of the oldest sample \[ns\].
    pub oldest_ns: i64,
}

impl Edge {
    /// Lines of the label, as in `view_frames`.
    pub(crate) fn label(&self) -> [String; 5] {
        let length_s = (self.newest_ns - self.oldest_ns) as f64 * 1e-9;
        [
            format!("Broadcaster: {}", self.broadcaster),
            format!("Average rate: {:.3}", self.rate_hz),
            format!("Buffer length: {length_s:.3}"),
            format!("Most recent transform: {}", display_time(self.newest_ns)),
            format!("Oldest transform: {}", display_time(self.oldest_ns)),
        ]
    }
}

/// Frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Name.
    pub name: String,
    /// Transform from its parent; `None` for a root.
    pub edge: Option<Edge>,
    /// Additional parents.
    pub other_parents: Vec<String>,
    /// Indices of its children.
    pub(crate) children: Vec<usize>,
}

/// All frames, sorted by name.
#[derive(Clone, Debug, PartialEq)]
pub struct Forest {
    pub(crate) frames: Vec<Frame>,
    /// Start frames of the drawing: the roots, and one frame of each loop.
    pub(crate) tops: Vec<usize>,
    circles: Vec<Vec<usize>>,
}

impl Forest {
    /// Builds the trees from received transforms.
    #[must_use]
    pub fn new(survey: &TransformMonitor) -> Self {
        let edges: BTreeMap<&str, Edge> = survey
            .buffer
            .kept_frames()
            .map(|kept| {
                let edge = Edge {
                    parent: kept.parent.to_owned(),
                    broadcaster: kept.authority.to_owned(),
                    kind: kept.kind,
                    rate_hz: kept.rate_hz(),
                    newest_ns: kept.newest_ns,
                    oldest_ns: kept.oldest_ns,
                };
                (kept.name, edge)
            })
            .collect();
        let mut names: Vec<&str> = survey.buffer.frames().collect();
        names.sort_unstable();
        let number: BTreeMap<&str, usize> = names.iter().copied().zip(0..).collect();
        let mut frames: Vec<Frame> = names
            .iter()
            .map(|name| {
                let edge = edges.get(name).cloned();
                let heard = survey.parents_of(name).iter().map(|parent| &parent.name);
                let is_other =
                    |parent: &&String| edge.as_ref().is_some_and(|edge| edge.parent != **parent);
                Frame {
                    name: (*name).to_owned(),
                    other_parents: heard.filter(is_other).cloned().collect(),
                    edge,
                    children: Vec::new(),
                }
            })
            .collect();
        for (child, name) in names.iter().enumerate() {
            if let Some(edge) = edges.get(name) {
                frames[number[edge.parent.as_str()]].children.push(child);
            }
        }
        let parents: Vec<Option<usize>> = names
            .iter()
            .map(|name| edges.get(name).map(|edge| number[edge.parent.as_str()]))
            .collect();
        let circles = circles(&parents);
        let roots = (0..frames.len()).filter(|&frame| parents[frame].is_none());
        let mut tops: Vec<usize> = roots.chain(circles.iter().map(|circle| circle[0])).collect();
        tops.sort_unstable();
        Self { frames, tops, circles }
    }

    /// The frames, sorted by name.
    pub fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.frames.iter()
    }

    /// Frames without a parent.
    pub fn roots(&self) -> impl Iterator<Item = &str> {
        let roots = self.frames.iter().filter(|frame| frame.edge.is_none());
        roots.map(|frame| frame.name.as_str())
    }

    /// Sets the broadcaster of all frames of a kind.
    pub fn set_broadcaster(&mut self, kind: TransformKind, name: &str) {
        let edges = self.frames.iter_mut().filter_map(|frame| frame.edge.as_mut());
        for edge in edges.filter(|edge| edge.kind == kind) {
            name.clone_into(&mut edge.broadcaster);
        }
    }

    /// Frames in lines, children after parents: the depth, the frame, and for it and each of its
    /// ancestors below the top true if it is the last child.
    #[must_use]
    pub fn lines(&self) -> Vec<(usize, &Frame, Vec<bool>)> {
        let mut lines = Vec::new();
        let mut waiting: Vec<(usize, Vec<bool>)> =
            self.tops.iter().rev().map(|&top| (top, Vec::new())).collect();
        while let Some((frame, is_last)) = waiting.pop() {
            for (place, child) in
                self.below(frame).collect::<Vec<_>>().into_iter().rev().enumerate()
            {
                waiting.push((child, [is_last.as_slice(), &[place == 0]].concat()));
            }
            lines.push((is_last.len(), &self.frames[frame], is_last));
        }
        lines
    }

    /// Faults of the tree.
    #[must_use]
    pub fn faults(&self) -> Vec<TreeFault> {
        let name = |frame: &usize| self.frames[*frame].name.clone();
        let mut faults: Vec<TreeFault> = self
            .circles
            .iter()
            .map(|circle| TreeFault::Circle(circle.iter().map(name).collect()))
            .collect();
        let roots: Vec<String> = self.roots().map(str::to_owned).collect();
        if roots.len() > 1 {
            faults.push(TreeFault::SeveralTrees(roots));
        }
        for frame in self.frames.iter().filter(|frame| !frame.other_parents.is_empty()) {
            let last = frame.edge.iter().map(|edge| edge.parent.clone());
            faults.push(TreeFault::SeveralParents {
                child: frame.name.clone(),
                parents: last.chain(frame.other_parents.iter().cloned()).collect(),
            });
        }
        faults
    }

    /// Indices of all frames from the tops down, children after parents. In a loop the edge to its
    /// first frame is omitted.
    pub(crate) fn downward(&self) -> Vec<usize> {
        let mut order = self.tops.clone();
        let mut next = 0;
        while let Some(&frame) = order.get(next) {
            order.extend(self.below(frame));
            next += 1;
        }
        order
    }

    /// Children of a frame, in drawing order.
    pub(crate) fn below(&self, frame: usize) -> impl Iterator<Item = usize> {
        self.frames[frame].children.iter().copied().filter(|child| !self.tops.contains(child))
    }
}

/// Loops among frames with these parents, each from its smallest index against the direction of its
/// edges.
fn circles(parents: &[Option<usize>]) -> Vec<Vec<usize>> {
    let mut found: Vec<Vec<usize>> = Vec::new();
    // Index of the walk that visited a frame first.
    let mut met = vec![usize::MAX; parents.len()];
    for start in 0..parents.len() {
        let mut frame = Some(start);
        while let Some(at) = frame.filter(|&at| met[at] == usize::MAX) {
            met[at] = start;
            frame = parents[at];
        }
        let Some(at) = frame.filter(|&at| met[at] == start) else { continue };
        let mut circle = vec![at];
        while let Some(next) = parents[circle[circle.len() - 1]].filter(|&next| next != at) {
            circle.push(next);
        }
        let least = (0..circle.len()).min_by_key(|&place| circle[place]).unwrap_or(0);
        circle.rotate_left(least);
        found.push(circle);
    }
    found
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose;
    use periplus_tf::StampedTransform;

    use super::*;

    pub(crate) fn forest(edges: &[(&str, &str)]) -> Forest {
        let mut survey = TransformMonitor::default();
        for (stamp_ns, (parent, child)) in (1..).zip(edges) {
            let it = StampedTransform::new(*parent, *child, stamp_ns, Pose::IDENTITY);
            survey.insert(&it, "test", TransformKind::Moving).unwrap();
        }
        Forest::new(&survey)
    }

    #[test]
    fn a_tree_has_no_fault() {
        let tree = forest(&[("map", "odom"), ("odom", "base"), ("base", "laser"), ("base", "imu")]);
        assert_eq!(tree.roots().collect::<Vec<_>>(), ["map"]);
        assert!(tree.faults().is_empty());
        let names: Vec<_> =
            tree.downward().iter().map(|&it| tree.frames[it].name.as_str()).collect();
        assert_eq!(names, ["map", "odom", "base", "imu", "laser"]);
    }

    #[test]
    fn two_trees_are_told() {
        let two = forest(&[("map", "odom"), ("base", "laser")]);
        let told = two.faults()[0].to_string();
        assert!(told.contains("`base`, `map`"), "{told}");
    }

    #[test]
    fn a_circle_is_told_and_still_drawn() {
        let ring = forest(&[("a", "b"), ("b", "c"), ("c", "a"), ("a", "leaf")]);
        assert_eq!(ring.faults(), [TreeFault::Circle(vec!["a".into(), "c".into(), "b".into()])]);
        assert_eq!(ring.downward().len(), 4);
    }

    #[test]
    fn a_second_parent_is_told() {
        let two = forest(&[("odom", "base"), ("map", "base"), ("map", "odom")]);
        assert_eq!(
            two.faults(),
            [TreeFault::SeveralParents {
                child: "base".into(),
                parents: vec!["map".into(), "odom".into()]
            }]
        );
    }
}
