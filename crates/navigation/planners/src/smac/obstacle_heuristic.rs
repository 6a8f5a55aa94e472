//! Cost to the goal around obstacles, on cells of twice the size.
//!
//! Source of the rules: `nav2_smac_planner/src/obstacle_heuristic.cpp`.

use periplus_costmap::Costmap;
use periplus_costmap::cost::INSCRIBED;

use crate::open_list::OpenList;

/// Cells at each edge that are not searched.
const EDGE_COUNT: usize = 3;
/// Value that marks the goal as reached.
const GOAL_COST: f32 = 1e-5;

/// Costs from the goal to the cells of a coarse map, computed as far as they are asked for. A positive cost
/// is final, a negative one waits in the open list, and 0 was not reached.
#[derive(Debug, Default)]
pub(crate) struct ObstacleHeuristic {
    width: usize,
    height: usize,
    /// Lowest cost of the four cells, by coarse cell; reused for the same costs.
    coarse: Vec<u8>,
    costs: Vec<f32>,
    /// Cells that have a cost, to be cleared for the next goal.
    reached: Vec<u32>,
    open: OpenList,
    /// Cost of a straight and a diagonal step into a cell, by its cost.
    steps: Vec<[f32; 2]>,
}

impl ObstacleHeuristic {
    /// Prepares for a goal \[cells of the costmap\].
    pub(crate) fn reset(
        &mut self,
        map: &Costmap,
        goal: [f64; 2],
        cost_penalty: f64,
        is_quadratic: bool,
    ) {
        self.coarsen(map);
        let count = self.width * self.height;
        if self.costs.len() == count {
            for cell in self.reached.drain(..) {
                self.costs[cell as usize] = 0.0;
            }
        } else {
            self.costs = vec![0.0; count];
            self.reached.clear();
        }
        let step = |cost: usize| {
            let normalized = cost as f64 / 252.0;
            let weight = if is_quadratic { normalized * normalized } else { normalized };
            let straight = (1.0 + cost_penalty * weight) as f32;
            [straight, std::f32::consts::SQRT_2 * straight]
        };
        self.steps = (0..256).map(step).collect();
        self.open.clear();
        if let Some(cell) = self.cell_of(goal[0], goal[1]) {
            self.costs[cell] = -GOAL_COST;
            self.reached.push(cell as u32);
            self.open.push(0.0, cell);
        }
    }

    fn coarsen(&mut self, map: &Costmap) {
        let info = map.info();
        (self.width, self.height) = (info.width.div_ceil(2), info.height.div_ceil(2));
        self.coarse.clear();
        for rows in map.costs().chunks(2 * info.width.max(1)) {
            let (low, high) = rows.split_at(info.width.min(rows.len()));
            let high = if high.is_empty() { low } else { high };
            let pairs = low.chunks(2).zip(high.chunks(2));
            self.coarse.extend(pairs.map(|(low, high)| {
                let lowest = |pair: &[u8]| pair.iter().copied().fold(u8::MAX, u8::min);
                lowest(low).min(lowest(high))
            }));
        }
    }

    fn cell_of(&self, x: f64, y: f64) -> Option<usize> {
        let (column, row) = ((x / 2.0) as usize, (y / 2.0) as usize);
        (x >= 0.0 && y >= 0.0 && column < self.width && row < self.height)
            .then_some(row * self.width + column)
    }

    /// Returns the cost from a position to the goal \[cells of the costmap\]; 0 if it is not reachable.
    pub(crate) fn cost(&mut self, x: f64, y: f64) -> f32 {
        let Some(asked) = self.cell_of(x, y) else { return 0.0 };
        if self.costs[asked] <= 0.0 && !self.open.is_empty() {
            self.expand_to(asked);
        }
        2.0 * self.costs[asked].max(0.0)
    }

    /// Expands the open list towards a cell until its cost is final.
    fn expand_to(&mut self, asked: usize) {
        let Self { width, height, coarse, costs, reached, open, steps } = self;
        let (width, height) = (*width, *height);
        let (asked_x, asked_y) = (asked % width, asked / width);
        let estimate = |x: usize, y: usize| {
            let (dx, dy) = (x as f32 - asked_x as f32, y as f32 - asked_y as f32);
            (dx * dx + dy * dy).sqrt()
        };
        open.reprioritize(|cell| -costs[cell] + estimate(cell % width, cell / width));
        while let Some((_, cell)) = open.pop() {
            if costs[cell] > 0.0 {
                continue;
            }
            let cost = -costs[cell];
            costs[cell] = cost;
            let (column, row) = (cell % width, cell / width);
            for (index, [dx, dy]) in NEIGHBOURS.into_iter().enumerate() {
                let (x, y) = (column.wrapping_add_signed(dx), row.wrapping_add_signed(dy));
                if !is_inner(x, width) || !is_inner(y, height) {
                    continue;
                }
                let neighbour = y * width + x;
                let known = costs[neighbour];
                let cell_cost = coarse[neighbour];
                if known > 0.0 || cell_cost >= INSCRIBED {
                    continue;
                }
                let new = cost + steps[usize::from(cell_cost)][usize::from(index > 3)];
                if known == 0.0 || -known > new {
                    if known == 0.0 {
                        reached.push(neighbour as u32);
                    }
                    costs[neighbour] = -new;
                    open.push(new + estimate(x, y), neighbour);
                }
            }
            if cell == asked {
                break;
            }
        }
    }
}

/// Neighbours of a cell; the first four share a side.
const NEIGHBOURS: [[isize; 2]; 8] =
    [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, 1], [1, -1], [-1, -1]];

fn is_inner(at: usize, count: usize) -> bool {
    at > EDGE_COUNT && at < count.saturating_sub(EDGE_COUNT)
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use periplus_grid::GridInfo;

    use super::*;

    #[test]
    fn the_cost_leads_around_a_wall() {
        let info = GridInfo::new(0.1, 60, 60, Pose2::IDENTITY).unwrap();
        let mut map = Costmap::new(info, 0);
        let mut heuristic = ObstacleHeuristic::default();
        heuristic.reset(&map, [20.0, 30.0], 2.0, false);
        // Ten coarse cells of two cells each.
        assert!((heuristic.cost(40.0, 30.0) - 20.0).abs() < 1e-3);
        for y in 0..50 {
            map.set((30, y), 254);
            map.set((31, y), 254);
        }
        heuristic.reset(&map, [20.0, 30.0], 2.0, false);
        assert!(heuristic.cost(40.0, 30.0) > 40.0);
        assert_eq!(heuristic.cost(30.0, 10.0), 0.0, "in the wall");
    }
}
