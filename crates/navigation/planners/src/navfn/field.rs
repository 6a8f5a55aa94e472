//! Potential field: the cost of the cheapest route from the robot to each cell.
//!
//! Source of the rules: `nav2_navfn_planner/src/navfn.cpp`.

use periplus_costmap::cost::{INSCRIBED, UNKNOWN};
use periplus_grid::Cell;

use super::front::Front;

/// Potential of a cell that was not reached (`POT_HIGH`).
pub(super) const UNREACHED_COST: f32 = 1.0e10;
/// Cost of a free cell (`COST_NEUTRAL`).
pub(super) const NEUTRAL_COST: f32 = 50.0;
/// Share of the costmap's cost in that of a cell (`COST_FACTOR`).
const COST_FACTOR: f64 = 0.8;
/// Cost of an obstacle (`COST_OBS`), which is also the first threshold.
pub(super) const OBSTACLE_COST: f32 = 254.0;
/// Growth of the threshold when a block is empty: two free cells.
const THRESHOLD_STEP_COST: f32 = 2.0 * NEUTRAL_COST;
/// Blocks between two calls of the cancel hook (`terminal_checking_interval`).
const CHECK_INTERVAL_COUNT: usize = 5000;
/// Minimum potential difference, in costs of the neighbour, that makes it worth an update (`INVSQRT2`).
const UPDATE_RATIO: f64 = 0.707_106_781;

/// Order in which cells are updated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NavFnMethod {
    /// By potential.
    Dijkstra,
    /// By potential plus the straight distance to the goal.
    AStar,
}

/// Settings of a propagation.
#[derive(Clone, Copy, Debug)]
pub struct Propagation {
    /// Order of the updates.
    pub method: NavFnMethod,
    /// True if unknown cells are passable, at the cost 253.
    pub allow_unknown: bool,
    /// Cell of the robot: the potential is 0 there, whatever its cost.
    pub robot: Cell,
    /// Cell at which the propagation ends; none to fill the map.
    pub goal: Option<Cell>,
}

/// Potentials of a grid, in single precision, as NavFn computes them: from the robot outwards, in blocks of
/// cells below a rising threshold, until the goal has one. Cells that are queued, obstacles and the outermost
/// rows and columns are marked by the sign.
#[derive(Debug, Default)]
pub struct PotentialField {
    width: usize,
    height: usize,
    /// Row by row; negative: never to be queued (an obstacle, or queued already).
    signed: Vec<f32>,
    front: Front,
    costs: CostTables,
}

/// Costs by the cost of a cell in the costmap.
#[derive(Debug)]
struct CostTables {
    /// Cost of a cell.
    cell: [f32; 256],
    /// Minimum potential difference that makes an update worth while.
    margin: [f32; 256],
}

impl Default for CostTables {
    fn default() -> Self {
        let cell: [f32; 256] = std::array::from_fn(|cost| match cost as u8 {
            UNKNOWN => OBSTACLE_COST - 1.0,
            cost if cost < INSCRIBED => {
                let whole = libm::trunc(f64::from(NEUTRAL_COST) + COST_FACTOR * f64::from(cost));
                (whole as f32).min(OBSTACLE_COST - 1.0)
            }
            _ => OBSTACLE_COST,
        });
        Self { cell, margin: cell.map(|cost| (UPDATE_RATIO * f64::from(cost)) as f32) }
    }
}

/// End of a propagation by the client.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PropagationCancelled;

impl PotentialField {
    /// Returns the potential of a cell; none if it was not reached or is outside the grid.
    #[must_use]
    pub fn potential(&self, (column, row): Cell) -> Option<f32> {
        let is_inside = column < self.width && row < self.height;
        let potential = is_inside.then(|| self.at(row * self.width + column))?;
        (potential < UNREACHED_COST).then_some(potential)
    }

    /// Returns the potential at an index, or [`UNREACHED_COST`].
    pub(super) fn at(&self, index: usize) -> f32 {
        self.signed.get(index).map_or(UNREACHED_COST, |signed| signed.abs())
    }

    /// Returns the number of columns and rows.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Computes the potentials on a costmap of this width, row by row. Returns the number of updates.
    ///
    /// # Errors
    /// When `is_cancelled` returns true.
    pub fn compute(
        &mut self,
        costs: &[u8],
        width: usize,
        how: &Propagation,
        is_cancelled: &mut dyn FnMut() -> bool,
    ) -> Result<usize, PropagationCancelled> {
        self.reset(costs, width, how.allow_unknown);
        let (column, row) = how.robot;
        if column >= self.width || row >= self.height {
            return Ok(0);
        }
        let robot = row * width + column;
        self.signed[robot] = 0.0;
        let neighbours =
            [robot + 1, robot.wrapping_sub(1), robot.wrapping_sub(width), robot + width];
        for index in neighbours {
            if self.signed.get(index).is_some_and(|signed| signed.is_sign_positive()) {
                self.signed[index] = -self.signed[index];
                self.front.seed(index as u32);
            }
        }
        match (how.method, how.goal) {
            (NavFnMethod::AStar, Some(goal)) => {
                let offset = |at: usize, goal: usize| (at as f64 - goal as f64) as f32;
                let estimate = |index: u32| {
                    let (x, y) = (index as usize % width, index as usize / width);
                    let (x, y) = (offset(x, goal.0), offset(y, goal.1));
                    (libm::hypot(f64::from(x), f64::from(y)) * f64::from(NEUTRAL_COST)) as f32
                };
                self.front.threshold += estimate(robot as u32);
                self.propagate(costs, Some(goal), estimate, is_cancelled)
            }
            (_, goal) => self.propagate(costs, goal, |_| 0.0, is_cancelled),
        }
    }

    fn reset(&mut self, costs: &[u8], width: usize, allow_unknown: bool) {
        let height = costs.len().checked_div(width).unwrap_or(0);
        (self.width, self.height) = (width, height);
        let unknown = if allow_unknown { UNREACHED_COST } else { -UNREACHED_COST };
        let initial = |cost: &u8| match *cost {
            UNKNOWN => unknown,
            cost if cost < INSCRIBED => UNREACHED_COST,
            _ => -UNREACHED_COST,
        };
        self.signed.clear();
        self.signed.extend(costs[..width * height].iter().map(initial));
        if width > 0 && height > 0 {
            self.signed[..width].fill(-UNREACHED_COST);
            self.signed[width * (height - 1)..].fill(-UNREACHED_COST);
            for row in self.signed.chunks_exact_mut(width) {
                row[0] = -UNREACHED_COST;
                row[width - 1] = -UNREACHED_COST;
            }
        }
        self.front.reset(OBSTACLE_COST);
    }

    fn propagate(
        &mut self,
        costs: &[u8],
        goal: Option<Cell>,
        estimate: impl Fn(u32) -> f32,
        is_cancelled: &mut dyn FnMut() -> bool,
    ) -> Result<usize, PropagationCancelled> {
        let goal = goal.map(|(column, row)| row * self.width + column);
        let cell_count = self.signed.len();
        let max_block_count = (cell_count / 20).max(self.width + self.height);
        let mut update_count = 0;
        for block in 0..max_block_count {
            if block % CHECK_INTERVAL_COUNT == 0 && is_cancelled() {
                return Err(PropagationCancelled);
            }
            if self.front.is_empty() {
                break;
            }
            let current = self.front.begin_block();
            update_count += current.len();
            for &index in &current {
                let signed = &mut self.signed[index as usize];
                *signed = signed.abs();
            }
            let front = &mut self.front;
            for &index in &current {
                update(&mut self.signed, costs, self.width, &self.costs, front, index, &estimate);
            }
            self.front.end_block(current, THRESHOLD_STEP_COST);
            if goal.is_some_and(|goal| self.at(goal) < UNREACHED_COST) {
                break;
            }
        }
        Ok(update_count)
    }
}

/// Updates the potential of a cell from its four neighbours by a planar wave, and queues the neighbours that
/// gain from it.
#[inline(always)]
fn update(
    signed: &mut [f32],
    costs: &[u8],
    width: usize,
    tables: &CostTables,
    front: &mut Front,
    index: u32,
    estimate: &impl Fn(u32) -> f32,
) {
    let at = index as usize;
    // Only inner cells are queued, so that all neighbours exist.
    let (left, right, below, above) = (at - 1, at + 1, at - width, at + width);
    let old = signed[at];
    let (l, r, u, d) = (signed[left], signed[right], signed[below], signed[above]);
    let (across, along) = (l.abs().min(r.abs()), u.abs().min(d.abs()));
    let (low, difference) = (across.min(along), (across - along).abs());
    let cost = tables.cell[usize::from(costs[at])];
    let potential = if difference >= cost {
        low + cost
    } else {
        let ratio = f64::from(difference / cost);
        let factor = (-0.2301 * ratio * ratio + 0.5307 * ratio + 0.7040) as f32;
        low + cost * factor
    };
    if potential >= old.abs() {
        return;
    }
    signed[at] = potential.copysign(old);
    let priority = potential + estimate(index);
    let queue = front.queue_for(priority);
    let mut offer = |neighbour: usize, value: f32| {
        // A negative value is an obstacle or queued already.
        let is_better = value > priority + tables.margin[usize::from(costs[neighbour])];
        queue.push_if(neighbour as u32, is_better);
        signed[neighbour] = if is_better { -value } else { value };
    };
    offer(left, l);
    offer(right, r);
    offer(below, u);
    offer(above, d);
}
