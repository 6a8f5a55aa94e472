//! The most likely poses.

use periplus_geometry::Pose2;

use super::pose_clusters::pose_clusters;
use super::system::System;
use super::{ConstraintKind, Edge, Graph};

/// Result of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outcome {
    /// Largest motion of a pose \[m\]; rotations count with an arm of a metre.
    Moved(f64),
    /// No step lowers the cost.
    Settled,
}

/// Gauss-Newton steps with Levenberg-Marquardt damping, in slices. Poses added after the solver was created
/// do not take part; they follow their predecessors. The elimination order is computed once.
pub(crate) struct Solver {
    /// Poses and edges for which it was made.
    size: Size,
    system: System,
    damping: f64,
    stage: Option<Stage>,
}

/// Numbers of poses and edges.
pub(crate) type Size = (usize, usize);

/// Progress of a step.
#[derive(Clone, Copy)]
struct Stage {
    /// Columns of the matrix that are done.
    columns: usize,
    /// Dampings that were too small.
    tries: usize,
    /// The cost before the step.
    before: f64,
}

/// State for resuming: the position of each pose in the elimination order (poses of a cluster share one),
/// the damping, and the columns, tries and previous cost of a step in progress.
pub(crate) type Saved = (Vec<u32>, (f64, Option<(usize, (usize, f64))>));

/// Maximum number of damping values tried in a step.
const MAX_DAMPING_ATTEMPTS: usize = 6;

/// The edges that take part and count.
fn edges(graph: &Graph, size: Size) -> impl Iterator<Item = &Edge> {
    graph.edges[..size.1].iter().filter(|edge| edge.weight > 0.0)
}

fn ends(graph: &Graph, size: Size) -> impl Iterator<Item = (usize, usize)> {
    edges(graph, size).map(|edge| (edge.from, edge.to))
}

impl Solver {
    /// Prepares for the first of the poses and edges. In large maps some poses ride with others, with
    /// every `turn` other ones.
    pub(crate) fn new(graph: &Graph, size: Size, turn: usize) -> Self {
        let system = System::new(&pose_clusters(graph, size, turn), || ends(graph, size));
        Self { size, system, damping: 0.0, stage: None }
    }

    /// Returns the state for resuming.
    pub(crate) fn state(&self) -> Saved {
        let stage = self.stage.map(|it| (it.columns, (it.tries, it.before)));
        (self.system.places().to_vec(), (self.damping, stage))
    }

    /// A solver for the first of the poses and edges, as it was; none when this is no state for them.
    pub(crate) fn resumed(
        graph: &Graph,
        size: Size,
        robust: &dyn Fn(ConstraintKind, f64) -> f64,
        (places, (damping, stage)): Saved,
    ) -> Option<Self> {
        let is_damping = (0.0..1e12).contains(&damping);
        if places.len() != size.0 || !is_damping {
            return None;
        }
        let system = System::resumed(places, ends(graph, size))?;
        let mut solver = Self { size, system, damping, stage: None };
        if let Some((columns, (tries, before))) = stage {
            let columns = columns.min(solver.system.len());
            solver.begin(graph, robust, tries, before);
            solver.stage.as_mut()?.columns = solver.system.factorize(0, columns, usize::MAX)?;
        }
        Some(solver)
    }

    /// Advances a step by a number of block products; returns its result when it is done. The first pose is
    /// fixed.
    pub(crate) fn advance(
        &mut self,
        graph: &mut Graph,
        robust: &dyn Fn(ConstraintKind, f64) -> f64,
        most: usize,
    ) -> Option<Outcome> {
        let Some(mut stage) = self.stage.take() else {
            let before = self.cost(graph, &graph.poses, robust);
            self.begin(graph, robust, 0, before);
            return None;
        };
        let size = self.system.len();
        let Some(columns) = self.system.factorize(stage.columns, size, most) else {
            return self.again(graph, robust, stage);
        };
        stage.columns = columns;
        if columns < size {
            self.stage = Some(stage);
            return None;
        }
        let (moved, largest) = self.system.solve(&graph.poses);
        if self.cost(graph, &moved, robust) > stage.before {
            return self.again(graph, robust, stage);
        }
        self.damping = if self.damping < 1e-6 { 0.0 } else { self.damping * 0.1 };
        graph.poses[..moved.len()].copy_from_slice(&moved);
        graph.hang(moved.len());
        Some(Outcome::Moved(largest))
    }

    /// The same step with more damping.
    fn again(
        &mut self,
        graph: &Graph,
        robust: &dyn Fn(ConstraintKind, f64) -> f64,
        stage: Stage,
    ) -> Option<Outcome> {
        self.damping = (self.damping * 10.0).max(1e-3);
        if stage.tries + 1 >= MAX_DAMPING_ATTEMPTS {
            return Some(Outcome::Settled);
        }
        self.begin(graph, robust, stage.tries + 1, stage.before);
        None
    }

    /// Collects the equations of a step.
    fn begin(
        &mut self,
        graph: &Graph,
        robust: &dyn Fn(ConstraintKind, f64) -> f64,
        tries: usize,
        before: f64,
    ) {
        self.system.clear();
        for edge in edges(graph, self.size) {
            let error = edge.error(&graph.poses);
            let weight = edge.weight * robust(edge.kind, edge.information.quadratic(error));
            let information = edge.information * weight;
            self.system.add(&graph.poses, (edge.from, edge.to), error, &information);
        }
        self.system.hold(self.damping);
        self.stage = Some(Stage { columns: 0, tries, before });
    }

    /// Cost that is minimized: the sum of the losses of the edges. `robust` gives the weight of a squared
    /// distance; the loss is taken as weight times square, which grows as the loss does for the weights in
    /// use.
    fn cost(
        &self,
        graph: &Graph,
        poses: &[Pose2],
        robust: &dyn Fn(ConstraintKind, f64) -> f64,
    ) -> f64 {
        let costs = edges(graph, self.size).map(|edge| {
            let chi2 = edge.chi2(poses);
            edge.weight * robust(edge.kind, chi2).sqrt() * chi2
        });
        costs.sum()
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;
    use periplus_scan_matching::Symmetric3;

    use super::*;
    use crate::graph::Edge;

    fn edge(from: usize, to: usize, from_from_to: Pose2) -> Edge {
        let information = Symmetric3::diagonal(100.0, 100.0, 400.0);
        Edge::new((from, to), from_from_to, information, ConstraintKind::Sequential)
    }

    /// A walk over a lattice of streets, with edges wherever it comes by again.
    #[test]
    fn exact_edges_give_the_exact_poses() {
        let mut stream = Stream::keyed(3, "streets", 0);
        let mut truth = vec![Pose2::IDENTITY];
        for _ in 0..600 {
            let turn = [0.0, 0.0, 0.5, -0.5][(stream.unit() * 4.0) as usize] * std::f64::consts::PI;
            let last = truth[truth.len() - 1];
            truth
                .push((last * Pose2::new(0.0, 0.0, turn) * Pose2::new(1.0, 0.0, 0.0)).normalized());
        }
        let mut graph = Graph::default();
        for (index, pose) in truth.iter().enumerate() {
            // A start that is wrong, more and more.
            let wrong = Pose2::new(
                pose.x_m + 0.001 * index as f64,
                pose.y_m,
                pose.yaw_rad + 0.02 * stream.normal(),
            );
            graph.add_pose(if index == 0 { *pose } else { wrong });
        }
        for a in 0..truth.len() {
            for b in a + 1..truth.len() {
                let between = truth[a].inverse() * truth[b];
                if b == a + 1 || (libm::hypot(between.x_m, between.y_m) < 0.5 && b % 3 == 0) {
                    graph.add_edge(edge(a, b, between));
                }
            }
        }
        let size = (graph.poses.len(), graph.edges.len());
        let mut solver = Solver::new(&graph, size, 0);
        let mut steps = 0;
        while steps < 10 {
            steps += usize::from(solver.advance(&mut graph, &|_, _| 1.0, 1000).is_some());
        }
        for (found, right) in graph.poses.iter().zip(&truth) {
            assert!((found.x_m - right.x_m).abs() < 1e-6 && (found.y_m - right.y_m).abs() < 1e-6);
        }
    }
}
