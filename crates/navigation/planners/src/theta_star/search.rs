//! Search of Theta* on the cells of a costmap.

use periplus_costmap::Costmap;
use periplus_costmap::cost::{LETHAL, MAX_NON_OBSTACLE, UNKNOWN};
use periplus_grid::Cell;

use crate::cell_index::CellIndex;
use crate::open_list::OpenList;
use crate::tables::ThetaStarParams;

/// Neighbours of a cell in the order of Nav2; the first four share a side.
const MOVES: [[i32; 2]; 8] = [[0, 1], [0, -1], [1, 0], [-1, 0], [1, -1], [-1, 1], [1, 1], [-1, -1]];
/// Scale of costs in the traversal cost.
const MAX_COST: f64 = MAX_NON_OBSTACLE as f64;

/// End of a search.
#[derive(Debug)]
pub(super) enum SearchEnd {
    /// Corners of the path from the start to the goal, and the number of expanded nodes.
    Found(Vec<Cell>, usize),
    /// The client cancelled the goal.
    Cancelled,
    /// All reachable cells were searched.
    Exhausted,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    x: i32,
    y: i32,
    /// Cost from the start, and with the estimate to the goal.
    g: f64,
    f: f64,
    parent: usize,
}

/// Properties of the cells by their cost in the costmap.
#[derive(Debug)]
struct CostTables {
    /// True if a step may enter the cell.
    is_safe: [bool; 256],
    /// Traversal cost of a step into the cell.
    step: [f64; 256],
    /// Traversal cost on a line of sight; infinite if the line must not pass.
    line: [f64; 256],
}

impl CostTables {
    fn new(params: &ThetaStarParams) -> Self {
        let rescaled = |cost: usize| 26.0 + 0.9 * cost as f64;
        let traversal = |cost: f64| params.w_traversal_cost * cost * cost / MAX_COST / MAX_COST;
        let is_unknown = |cost: usize| cost == usize::from(UNKNOWN) && params.allow_unknown;
        Self {
            is_safe: std::array::from_fn(|cost| {
                is_unknown(cost) || cost <= usize::from(MAX_NON_OBSTACLE)
            }),
            step: std::array::from_fn(|cost| traversal(rescaled(cost))),
            line: std::array::from_fn(|cost| {
                if is_unknown(cost) {
                    traversal(f64::from(LETHAL - 1))
                } else if rescaled(cost) <= MAX_COST {
                    traversal(rescaled(cost))
                } else {
                    f64::INFINITY
                }
            }),
        }
    }
}

/// Buffers of the search.
#[derive(Debug, Default)]
pub(super) struct ThetaStarSearch {
    index: CellIndex,
    nodes: Vec<Node>,
    open: OpenList,
}

/// Cells and weights of one search.
struct Ground<'a> {
    costs: &'a [u8],
    width: i32,
    height: i32,
    tables: CostTables,
    euclidean_weight: f64,
}

impl Ground<'_> {
    fn index(&self, x: i32, y: i32) -> usize {
        y as usize * self.width as usize + x as usize
    }

    fn cost(&self, x: i32, y: i32) -> usize {
        usize::from(self.costs[self.index(x, y)])
    }

    fn euclidean(&self, a: &Node, x: i32, y: i32) -> f64 {
        self.euclidean_weight * distance(a.x - x, a.y - y)
    }

    /// Returns the sum of the traversal costs on the line from a node towards another, without the latter;
    /// none if a cell blocks, or once the sum reaches a limit.
    fn line_of_sight(&self, from: &Node, to: &Node, limit: f64) -> Option<f64> {
        let (dx, dy) = ((to.x - from.x).abs(), (to.y - from.y).abs());
        let sx = if from.x < to.x { 1 } else { -1 };
        let sy = if from.y < to.y { 1 } else { -1 };
        let (mut x, mut y, mut error, mut sum) = (from.x, from.y, dx - dy, 0.0);
        while x != to.x || y != to.y {
            sum += self.tables.line[self.cost(x, y)];
            if sum >= limit {
                return None;
            }
            let doubled = 2 * error;
            if doubled > -dy && doubled <= dx {
                let is_safe = |x, y| self.tables.is_safe[self.cost(x, y)];
                if !is_safe(x + sx, y) || !is_safe(x, y + sy) {
                    return None;
                }
                x += sx;
                y += sy;
                error += dx - dy;
            } else if doubled > -dy {
                x += sx;
                error -= dy;
            } else {
                y += sy;
                error += dx;
            }
        }
        Some(sum)
    }
}

fn distance(dx: i32, dy: i32) -> f64 {
    f64::from(dx * dx + dy * dy).sqrt()
}

impl ThetaStarSearch {
    pub(super) fn run(
        &mut self,
        map: &Costmap,
        params: &ThetaStarParams,
        start: Cell,
        goal: Cell,
        is_cancelled: &mut dyn FnMut() -> bool,
    ) -> SearchEnd {
        let (width, height) = (map.info().width, map.info().height);
        let ground = Ground {
            costs: map.costs(),
            width: width as i32,
            height: height as i32,
            tables: CostTables::new(params),
            euclidean_weight: params.w_euc_cost,
        };
        let heuristic_weight = params.w_euc_cost.min(1.0);
        let goal = (goal.0 as i32, goal.1 as i32);
        let estimate = |x: i32, y: i32| heuristic_weight * distance(x - goal.0, y - goal.1);
        let move_count = if params.how_many_corners == 4 { 4 } else { 8 };
        self.index.reset(width * height);
        self.nodes.clear();
        self.open.clear();
        let (x, y) = (start.0 as i32, start.1 as i32);
        let g = ground.tables.step[ground.cost(x, y)];
        self.nodes.push(Node { x, y, g, f: g + estimate(x, y), parent: 0 });
        self.index.insert(ground.index(x, y), 0);
        self.open.push(0.0, 0);
        let mut expansion_count = 0;
        while let Some((cost, current)) = self.open.pop() {
            if cost > self.nodes[current].f as f32 {
                continue;
            }
            expansion_count += 1;
            if expansion_count % params.terminal_checking_interval == 0 && is_cancelled() {
                return SearchEnd::Cancelled;
            }
            if (self.nodes[current].x, self.nodes[current].y) == goal {
                return SearchEnd::Found(self.corners(current), expansion_count);
            }
            self.reset_parent(&ground, current);
            self.expand(&ground, current, &MOVES[..move_count], estimate);
        }
        SearchEnd::Exhausted
    }

    /// Skips the parent of a node if there is a cheaper line of sight to the parent's parent.
    fn reset_parent(&mut self, ground: &Ground<'_>, at: usize) {
        let node = self.nodes[at];
        let grandparent = self.nodes[node.parent].parent;
        let ancestor = self.nodes[grandparent];
        let straight = ancestor.g + ground.euclidean(&ancestor, node.x, node.y);
        let sum = ground.line_of_sight(&node, &ancestor, node.g - straight);
        let Some(g) = sum.map(|sum| straight + sum).filter(|g| *g < node.g) else { return };
        let f = node.f - node.g + g;
        self.nodes[at] = Node { g, f, parent: grandparent, ..node };
    }

    fn expand(
        &mut self,
        ground: &Ground<'_>,
        current: usize,
        moves: &[[i32; 2]],
        estimate: impl Fn(i32, i32) -> f64,
    ) {
        let from = self.nodes[current];
        for [dx, dy] in moves {
            let (x, y) = (from.x + dx, from.y + dy);
            if x < 0 || y < 0 || x >= ground.width || y >= ground.height {
                continue;
            }
            let cost = ground.cost(x, y);
            if !ground.tables.is_safe[cost] {
                continue;
            }
            let g = from.g + ground.euclidean(&from, x, y) + ground.tables.step[cost];
            let node = Node { x, y, g, f: g + estimate(x, y), parent: current };
            let cell = ground.index(x, y);
            let at = match self.index.get(cell) {
                Some(at) if self.nodes[at].f > node.f => {
                    self.nodes[at] = node;
                    at
                }
                Some(_) => continue,
                None => {
                    self.nodes.push(node);
                    self.index.insert(cell, self.nodes.len() - 1);
                    self.nodes.len() - 1
                }
            };
            self.open.push(node.f as f32, at);
        }
    }

    fn corners(&self, goal: usize) -> Vec<Cell> {
        let mut corners = Vec::new();
        let mut at = goal;
        loop {
            let node = self.nodes[at];
            corners.push((node.x as usize, node.y as usize));
            if node.parent == at {
                break;
            }
            at = node.parent;
        }
        corners.reverse();
        corners
    }
}
