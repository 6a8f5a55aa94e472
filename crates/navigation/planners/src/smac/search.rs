//! A* over cells and headings.
//!
//! Source of the rules: `nav2_smac_planner/a_star_impl.hpp`, `node_hybrid.cpp`.

use periplus_costmap::Costmap;
use periplus_geometry::Pose2;

use super::analytic::{AnalyticSettings, EARLIER_START_STEP_COUNT, expand, refine};
use super::collision::CollisionChecker;
use super::distance_table::{BinPose, DistanceTable};
use super::graph::{SmacGraph, SmacNode};
use super::motions::Motions;
use super::obstacle_heuristic::ObstacleHeuristic;
use crate::open_list::OpenList;

/// Limits of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SearchLimits {
    /// Maximum number of expanded nodes.
    pub(crate) max_iterations: usize,
    /// Maximum number of further nodes once one is within the tolerance.
    pub(crate) max_on_approach: usize,
    /// Expanded nodes between two checks of the hooks.
    pub(crate) check_interval: usize,
    /// Maximum heuristic of a node that may end the path \[cells\].
    pub(crate) tolerance: f64,
}

/// Hooks of the caller.
pub(crate) struct Hooks<'a> {
    pub(crate) is_cancelled: &'a mut dyn FnMut() -> bool,
    pub(crate) is_out_of_time: &'a mut dyn FnMut() -> bool,
}

/// End of a search.
#[derive(Debug)]
pub(crate) enum SmacOutcome {
    /// Poses from the start to the goal \[cells, rad\].
    Found(Vec<Pose2>),
    /// The client cancelled the goal.
    Cancelled,
    /// The time is over.
    OutOfTime,
    /// All reachable nodes, or as many as allowed, were expanded.
    Exhausted,
}

/// Tables of a motion model on a grid.
#[derive(Debug)]
pub(crate) struct MotionTables {
    pub(crate) bin_count: usize,
    pub(crate) motions: Motions,
    pub(crate) lengths: DistanceTable,
    pub(crate) analytic: AnalyticSettings,
    /// Ratio of the distance to the goal to the number of nodes between two analytic expansions.
    pub(crate) analytic_ratio: f64,
}

/// Goal of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SmacGoal {
    pub(crate) pose: BinPose,
    /// True if the analytic expansion always tries this heading, false if only after another succeeded.
    pub(crate) is_coarse: bool,
}

/// Buffers that are kept from search to search.
#[derive(Debug, Default)]
pub(crate) struct SearchBuffers {
    graph: SmacGraph,
    open: OpenList,
    pub(crate) obstacles: ObstacleHeuristic,
}

/// One search.
pub(crate) struct SmacSearch<'a> {
    pub(crate) map: &'a Costmap,
    pub(crate) checker: &'a CollisionChecker<'a>,
    pub(crate) tables: &'a mut MotionTables,
    pub(crate) buffers: &'a mut SearchBuffers,
    pub(crate) limits: SearchLimits,
    pub(crate) goals: &'a [SmacGoal],
}

/// Nearest node to the goal.
struct Nearest {
    heuristic: f32,
    node: usize,
}

/// Counters of the analytic expansion.
struct Attempts {
    /// Expanded nodes until the next attempt.
    rest: i64,
    /// Lowest heuristic of an expanded node.
    closest: i64,
}

impl SmacSearch<'_> {
    /// Searches from a pose; also returns the number of expanded nodes.
    pub(crate) fn run(mut self, start: BinPose, hooks: &mut Hooks<'_>) -> (SmacOutcome, usize) {
        let cell_count = self.map.info().len();
        self.buffers.graph.reset(cell_count, self.tables.bin_count);
        self.buffers.open.clear();
        let start = self.add(start);
        self.buffers.graph.nodes[start].g = 0.0;
        self.buffers.open.push(0.0, start);
        let goal_nodes: Vec<usize> = self.goals.iter().map(|goal| self.add(goal.pose)).collect();
        let rotations: Vec<(f64, f64)> = self
            .goals
            .iter()
            .map(|goal| libm::sincos(-self.tables.lengths.angle_rad(goal.pose.bin)))
            .collect();
        let mut nearest = Nearest { heuristic: f32::INFINITY, node: start };
        let mut attempts = Attempts { rest: 0, closest: i64::MAX };
        let (mut iterations, mut approach_iterations) = (0, 0);
        let tolerance = self.limits.tolerance as f32;
        let mut is_checked = false;
        while iterations < self.limits.max_iterations {
            if iterations % self.limits.check_interval == 0 && !is_checked {
                is_checked = true;
                if (hooks.is_cancelled)() {
                    return (SmacOutcome::Cancelled, iterations);
                }
                if (hooks.is_out_of_time)() {
                    let end = self.path_within(&nearest, tolerance);
                    return (end.unwrap_or(SmacOutcome::OutOfTime), iterations);
                }
            }
            let Some((_, current)) = self.buffers.open.pop() else { break };
            if self.buffers.graph.nodes[current].is_visited {
                continue;
            }
            iterations += 1;
            is_checked = false;
            self.buffers.graph.nodes[current].is_visited = true;
            if let Some(path) = self.try_analytic(current, &rotations, &mut attempts) {
                return (SmacOutcome::Found(path), iterations);
            }
            if goal_nodes.contains(&current) && current != start {
                return (SmacOutcome::Found(self.path_to(current)), iterations);
            }
            if nearest.heuristic < tolerance {
                approach_iterations += 1;
                if approach_iterations >= self.limits.max_on_approach {
                    return (SmacOutcome::Found(self.path_to(nearest.node)), iterations);
                }
            }
            self.expand_node(current, &rotations, &mut nearest);
        }
        let end = self.path_within(&nearest, tolerance);
        (end.unwrap_or(SmacOutcome::Exhausted), iterations)
    }

    fn path_within(&self, nearest: &Nearest, tolerance: f32) -> Option<SmacOutcome> {
        (nearest.heuristic < tolerance).then(|| SmacOutcome::Found(self.path_to(nearest.node)))
    }

    fn cell_of(&self, x: f64, y: f64) -> Option<usize> {
        let info = self.map.info();
        let is_inside = x >= 0.0 && y >= 0.0 && x < info.width as f64 && y < info.height as f64;
        is_inside.then(|| y as usize * info.width + x as usize)
    }

    /// Adds a node at a pose inside the grid.
    fn add(&mut self, pose: BinPose) -> usize {
        let cell = self.cell_of(pose.x, pose.y).unwrap_or(0);
        let node = SmacNode::new(pose.x, pose.y, pose.bin);
        self.buffers.graph.node_at(cell, pose.bin, node)
    }

    fn expand_node(&mut self, current: usize, rotations: &[(f64, f64)], nearest: &mut Nearest) {
        let from = self.buffers.graph.nodes[current];
        for index in 0..self.tables.motions.count(usize::from(from.bin)) {
            let to = self.tables.motions.candidate(&from, index);
            let Some(cell) = self.cell_of(to.x, to.y) else { continue };
            let new = SmacNode::new(to.x, to.y, to.bin);
            let at = self.buffers.graph.node_at(cell, to.bin, new);
            if self.buffers.graph.nodes[at].is_visited {
                continue;
            }
            let Some(step) = self.tables.motions.cost(&from, &to, self.checker) else { continue };
            let g = from.g + step;
            if g >= self.buffers.graph.nodes[at].g {
                continue;
            }
            let node = new.reached(g, to.motion, current);
            self.buffers.graph.nodes[at] = node;
            let heuristic = self.heuristic(&node, rotations);
            if heuristic < nearest.heuristic {
                *nearest = Nearest { heuristic, node: at };
            }
            self.buffers.open.push(g + heuristic, at);
        }
    }

    /// Returns the larger of the cost around obstacles and the length of the curve to the nearest goal.
    fn heuristic(&mut self, node: &SmacNode, rotations: &[(f64, f64)]) -> f32 {
        let (x, y) = (libm::floor(node.x), libm::floor(node.y));
        let obstacles = self.buffers.obstacles.cost(x, y);
        let from = BinPose { x, y, bin: usize::from(node.bin) };
        let mut distance = f32::INFINITY;
        for (goal, rotation) in self.goals.iter().zip(rotations) {
            let lengths = &mut self.tables.lengths;
            let length = lengths.length(from, goal.pose, *rotation);
            let length = length.unwrap_or_else(|| {
                if obstacles > 0.0 {
                    return 0.0;
                }
                let pose = |at: BinPose| Pose2::new(at.x, at.y, lengths.angle_rad(at.bin));
                lengths.direct(pose(from), pose(goal.pose))
            });
            distance = distance.min(length);
        }
        obstacles.max(distance)
    }

    fn pose_of(&self, node: usize) -> Pose2 {
        let node = &self.buffers.graph.nodes[node];
        Pose2::new(node.x, node.y, self.tables.lengths.angle_rad(usize::from(node.bin)))
    }

    fn path_to(&self, node: usize) -> Vec<Pose2> {
        let mut nodes: Vec<usize> = self.buffers.graph.backtrace(node).collect();
        nodes.reverse();
        let mut path: Vec<Pose2> = Vec::with_capacity(nodes.len());
        for at in nodes {
            if let (Some(motion), Some(last)) = (self.buffers.graph.nodes[at].motion, path.last()) {
                self.tables.motions.add_inner_poses(*last, motion, &mut path);
            }
            path.push(self.pose_of(at));
        }
        path
    }

    /// Tries to reach a goal by one curve, if it is time to; returns the whole path.
    fn try_analytic(
        &mut self,
        current: usize,
        rotations: &[(f64, f64)],
        attempts: &mut Attempts,
    ) -> Option<Vec<Pose2>> {
        let node = self.buffers.graph.nodes[current];
        let heuristic = self.heuristic(&node, rotations);
        attempts.closest = attempts.closest.min(heuristic as i64);
        let ratio = self.tables.analytic_ratio;
        let wanted = ((attempts.closest as f64 / ratio) as i64).max(libm::ceil(ratio) as i64);
        attempts.rest = attempts.rest.min(wanted);
        if attempts.rest > 0 {
            attempts.rest -= 1;
            return None;
        }
        attempts.rest = wanted - 1;
        let settings = self.tables.analytic;
        let start = (current, self.pose_of(current));
        let mut best: Option<(f64, usize, Pose2, Vec<Pose2>)> = None;
        for is_coarse in [true, false] {
            if !is_coarse && best.is_none() {
                break;
            }
            for goal in self.goals.iter().filter(|goal| goal.is_coarse == is_coarse) {
                let BinPose { x, y, bin } = goal.pose;
                let goal = Pose2::new(x, y, self.tables.lengths.angle_rad(bin));
                let first = expand(start.1, goal, settings.radius, &settings, self.checker);
                let Some(first) = first else { continue };
                let back = self.buffers.graph.backtrace(current);
                let earlier = back
                    .step_by(EARLIER_START_STEP_COUNT)
                    .skip(1)
                    .map(|node| (node, self.pose_of(node)));
                let (node, path) = refine(start, earlier, goal, first, &settings, self.checker);
                let best_score = best.as_ref().map_or(f64::INFINITY, |(score, ..)| *score);
                if path.score < best_score {
                    best = Some((path.score, node, goal, path.poses));
                }
            }
        }
        let (_, node, goal, poses) = best?;
        let mut path = self.path_to(node);
        path.extend(poses);
        path.push(goal);
        Some(path)
    }
}
