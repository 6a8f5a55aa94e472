//! The most likely poses.

use periplus_base::{Pose2, normalize_angle};
use periplus_matching::Symmetric3;

use super::cholesky::{Block, Factor};
use super::order::order;
use super::{Edge, Graph, Kind};

/// How a step went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outcome {
    /// Poses moved by at most so many metres (turns count as an arm of a metre).
    Moved(f64),
    /// No step lowers the cost.
    Settled,
}

/// Gauss-Newton steps with the damping of Levenberg and Marquardt, in slices. What the graph gains after
/// the solver was made does not take part: new poses hang on those that they came after. So the order
/// of elimination is made once.
pub(crate) struct Solver {
    /// Poses and edges for which it was made.
    size: Size,
    /// Place of each pose in the order of elimination.
    place: Vec<u32>,
    factor: Factor,
    damping: f64,
    stage: Option<Stage>,
}

/// Numbers of poses and edges.
pub(crate) type Size = (usize, usize);

/// In the middle of a step.
struct Stage {
    right: Vec<[f64; 3]>,
    at: Place,
}

/// Where a step is.
#[derive(Clone, Copy)]
struct Place {
    /// Columns of the matrix that are done.
    columns: usize,
    /// Dampings that were too small.
    tries: usize,
    /// The cost before the step.
    before: f64,
}

/// What is to be known to go on later: the place of each pose in the order of elimination, the
/// damping, and of a step that has begun its columns, tries and cost before.
pub(crate) type Saved = (Vec<u32>, (f64, Option<(usize, (usize, f64))>));

/// So many dampings are tried in a step.
const TRIES: usize = 6;

/// The poses at the other ends of edges that count.
fn neighbours(graph: &Graph, (poses, edges): Size) -> Vec<Vec<u32>> {
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); poses];
    for edge in graph.edges[..edges].iter().filter(|edge| edge.weight > 0.0) {
        neighbours[edge.from].push(edge.to as u32);
        neighbours[edge.to].push(edge.from as u32);
    }
    neighbours
}

impl Solver {
    /// Prepares for all edges that count.
    pub(crate) fn new(graph: &Graph) -> Self {
        Self::sized(graph, (graph.poses.len(), graph.edges.len()))
    }

    /// Prepares for the first of the poses and edges.
    pub(crate) fn sized(graph: &Graph, size: Size) -> Self {
        let neighbours = neighbours(graph, size);
        let order = order(&graph.poses[..size.0], &neighbours);
        Self::ordered(size, &neighbours, &order, 0.0)
    }

    fn ordered(size: Size, neighbours: &[Vec<u32>], order: &[u32], damping: f64) -> Self {
        let mut place = vec![0; order.len()];
        for (at, &node) in order.iter().enumerate() {
            place[node as usize] = at as u32;
        }
        let below: Vec<Vec<u32>> = order
            .iter()
            .map(|&node| {
                neighbours[node as usize].iter().map(|&next| place[next as usize]).collect()
            })
            .collect();
        Self { size, place, factor: Factor::new(&below), damping, stage: None }
    }

    /// What is to be known to go on later.
    pub(crate) fn state(&self) -> Saved {
        let at = self.stage.as_ref().map(|it| (it.at.columns, (it.at.tries, it.at.before)));
        (self.place.clone(), (self.damping, at))
    }

    /// A solver for the first of the poses and edges, as it was; none when this is no state for them.
    pub(crate) fn resumed(
        graph: &Graph,
        size: Size,
        robust: &dyn Fn(Kind, f64) -> f64,
        (place, (damping, at)): Saved,
    ) -> Option<Self> {
        let mut order = vec![u32::MAX; size.0];
        for (node, &at) in place.iter().enumerate() {
            *order.get_mut(at as usize)? = node as u32;
        }
        let is_whole = place.len() == size.0 && !order.contains(&u32::MAX);
        let is_damping = (0.0..1e12).contains(&damping);
        if !is_whole || !is_damping {
            return None;
        }
        let mut solver = Self::ordered(size, &neighbours(graph, size), &order, damping);
        if let Some((columns, (tries, before))) = at {
            let columns = columns.min(size.0);
            solver.begin(graph, robust, Place { columns: 0, tries, before });
            let reached = solver.factor.factorize(0, columns, usize::MAX)?;
            solver.stage.as_mut()?.at.columns = reached;
        }
        Some(solver)
    }

    /// One step; the first pose stays where it is.
    pub(crate) fn step(&mut self, graph: &mut Graph, robust: &dyn Fn(Kind, f64) -> f64) -> Outcome {
        loop {
            if let Some(outcome) = self.advance(graph, robust, usize::MAX) {
                return outcome;
            }
        }
    }

    /// A part of a step, of so many products of blocks; how the step went when it is done.
    pub(crate) fn advance(
        &mut self,
        graph: &mut Graph,
        robust: &dyn Fn(Kind, f64) -> f64,
        most: usize,
    ) -> Option<Outcome> {
        let Some(Stage { mut right, mut at }) = self.stage.take() else {
            let before = self.cost(graph, &graph.poses, robust);
            self.begin(graph, robust, Place { columns: 0, tries: 0, before });
            return None;
        };
        let size = self.factor.len();
        let Some(columns) = self.factor.factorize(at.columns, size, most) else {
            return self.again(graph, robust, at);
        };
        at.columns = columns;
        if columns < size {
            self.stage = Some(Stage { right, at });
            return None;
        }
        self.factor.solve(&mut right);
        let change = |node: usize| right[self.place[node] as usize];
        let moved = graph.poses.iter().take(size).enumerate().map(|(node, pose)| {
            let [x, y, turn] = change(node);
            Pose2::new(pose.x_m + x, pose.y_m + y, normalize_angle(pose.yaw_rad + turn))
        });
        let moved: Vec<Pose2> = moved.collect();
        if self.cost(graph, &moved, robust) > at.before {
            return self.again(graph, robust, at);
        }
        self.damping = if self.damping < 1e-6 { 0.0 } else { self.damping * 0.1 };
        let largest = right.iter().flatten().fold(0.0, |most: f64, it| most.max(it.abs()));
        graph.poses[..size].copy_from_slice(&moved);
        graph.hang(size);
        Some(Outcome::Moved(largest))
    }

    /// The same step with more damping.
    fn again(
        &mut self,
        graph: &Graph,
        robust: &dyn Fn(Kind, f64) -> f64,
        at: Place,
    ) -> Option<Outcome> {
        self.damping = (self.damping * 10.0).max(1e-3);
        if at.tries + 1 >= TRIES {
            return Some(Outcome::Settled);
        }
        self.begin(graph, robust, Place { columns: 0, tries: at.tries + 1, ..at });
        None
    }

    /// Collects matrix and right side of a step.
    fn begin(&mut self, graph: &Graph, robust: &dyn Fn(Kind, f64) -> f64, at: Place) {
        let mut right = vec![[0.0; 3]; self.size.0];
        self.factor.clear();
        for edge in self.edges(graph) {
            let (from, to) = (graph.poses[edge.from], graph.poses[edge.to]);
            let error = edge.error(&graph.poses);
            let weight = edge.weight * robust(edge.kind, edge.information.quadratic(error));
            let information = edge.information * weight;
            let (s, c) = libm::sincos(from.yaw_rad);
            let (dx, dy) = (to.x_m - from.x_m, to.y_m - from.y_m);
            let (x, y) = (c * dx + s * dy, c * dy - s * dx);
            let at_from = [[-c, -s, y], [s, -c, -x], [0.0, 0.0, -1.0]];
            let at_to = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]];
            let (i, j) = (self.place[edge.from] as usize, self.place[edge.to] as usize);
            add(self.factor.diagonal(i), &product(&at_from, &information, &at_from));
            add(self.factor.diagonal(j), &product(&at_to, &information, &at_to));
            if i < j {
                add(self.factor.block(j, i), &product(&at_to, &information, &at_from));
            } else {
                add(self.factor.block(i, j), &product(&at_from, &information, &at_to));
            }
            let pull = information.times(error);
            for k in 0..3 {
                for l in 0..3 {
                    right[i][l] -= at_from[k][l] * pull[k];
                    right[j][l] -= at_to[k][l] * pull[k];
                }
            }
        }
        for at in 0..right.len() {
            let block = self.factor.diagonal(at);
            for k in [0, 4, 8] {
                block[k] += self.damping * block[k] + 1e-9;
            }
        }
        if let Some(&first) = self.place.first() {
            let block = self.factor.diagonal(first as usize);
            for k in [0, 4, 8] {
                block[k] += 1e9;
            }
        }
        self.stage = Some(Stage { right, at });
    }

    /// The edges that take part and count.
    fn edges<'a>(&self, graph: &'a Graph) -> impl Iterator<Item = &'a Edge> + use<'a> {
        graph.edges[..self.size.1].iter().filter(|edge| edge.weight > 0.0)
    }

    /// The sum that is made small. `robust` gives the weight of a squared distance; its loss is taken
    /// as weight times square, which grows as the loss does for the weights in use.
    fn cost(&self, graph: &Graph, poses: &[Pose2], robust: &dyn Fn(Kind, f64) -> f64) -> f64 {
        let costs = self.edges(graph).map(|edge| {
            let chi2 = edge.chi2(poses);
            edge.weight * robust(edge.kind, chi2).sqrt() * chi2
        });
        costs.sum()
    }
}

fn add(target: &mut Block, part: &Block) {
    for (sum, value) in target.iter_mut().zip(part) {
        *sum += value;
    }
}

/// aᵀ · m · b.
fn product(a: &[[f64; 3]; 3], m: &Symmetric3, b: &[[f64; 3]; 3]) -> Block {
    let full = [[m.xx, m.xy, m.xt], [m.xy, m.yy, m.yt], [m.xt, m.yt, m.tt]];
    let mut middle = [[0.0; 3]; 3];
    for k in 0..3 {
        for j in 0..3 {
            middle[k][j] = full[k][0] * b[0][j] + full[k][1] * b[1][j] + full[k][2] * b[2][j];
        }
    }
    let mut block = [0.0; 9];
    for i in 0..3 {
        for j in 0..3 {
            block[3 * i + j] =
                a[0][i] * middle[0][j] + a[1][i] * middle[1][j] + a[2][i] * middle[2][j];
        }
    }
    block
}

#[cfg(test)]
mod tests {
    use periplus_base::Stream;

    use super::*;
    use crate::graph::Edge;

    fn edge(from: usize, to: usize, from_from_to: Pose2) -> Edge {
        let information = Symmetric3::diagonal(100.0, 100.0, 400.0);
        Edge::new((from, to), from_from_to, information, Kind::Chain)
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
                if b == a + 1 || (between.x_m.hypot(between.y_m) < 0.5 && b % 3 == 0) {
                    graph.add_edge(edge(a, b, between));
                }
            }
        }
        let mut solver = Solver::new(&graph);
        for _ in 0..10 {
            solver.step(&mut graph, &|_, _| 1.0);
        }
        for (found, right) in graph.poses.iter().zip(&truth) {
            assert!((found.x_m - right.x_m).abs() < 1e-6 && (found.y_m - right.y_m).abs() < 1e-6);
        }
    }
}
