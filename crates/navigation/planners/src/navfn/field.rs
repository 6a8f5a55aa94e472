//! Potential field: the cost of the cheapest route from the robot to each cell.
//!
//! Source of the rules: `nav2_navfn_planner/src/navfn.cpp`.

mod corridor;

use periplus_costmap::cost::{INSCRIBED, UNKNOWN};
use periplus_grid::Cell;

use self::corridor::Corridor;
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
const UPDATE_RATIO: f64 = std::f64::consts::FRAC_1_SQRT_2;

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
/// cells below a rising threshold, until the goal has one. Cells that are queued and the outermost rows and
/// columns are marked by the sign.
#[derive(Debug, Default)]
pub struct PotentialField {
    width: usize,
    height: usize,
    /// Row by row; negative: not to be queued (at the edge, or queued already).
    signed: Vec<f32>,
    /// Cells whose potential or sign changed; only these are restored for the next propagation.
    touched: Vec<u32>,
    front: Front,
    corridor: Corridor,
    /// True if the potentials are those of the corridor.
    has_corridor: bool,
}

/// Properties of the cells by their cost in the costmap.
#[derive(Debug)]
struct CostTables {
    /// Terms of the update of a cell.
    cell: [CellTerms; 256],
    /// Minimum potential difference that makes an update of a cell worth while; infinite for obstacles.
    margin: [f32; 256],
}

/// Terms of the planar wave `cost * (0.7040 + 0.5307 x - 0.2301 x²)` with `x = difference / cost`.
#[derive(Clone, Copy, Debug)]
struct CellTerms {
    cost: f32,
    /// `0.7040 * cost`
    base: f32,
    /// `-0.2301 / cost`
    bend: f32,
}

impl CellTerms {
    fn new(cost: f64) -> Self {
        let (base, bend) = ((0.7040 * cost) as f32, (-0.2301 / cost) as f32);
        Self { cost: cost as f32, base, bend }
    }

    /// Returns the potential that a planar wave brings from the lower neighbours in both directions.
    #[inline(always)]
    fn wave(&self, across: f32, along: f32) -> f32 {
        let (low, difference) = (across.min(along), (across - along).abs());
        let far = low + self.cost;
        let near = (low + self.base) + difference * (0.5307 + self.bend * difference);
        std::hint::select_unpredictable(difference >= self.cost, far, near)
    }
}

/// Returns the cost of a cell whose costmap has a cost.
fn cell_cost(cost: u8, allow_unknown: bool) -> f32 {
    match cost {
        UNKNOWN if allow_unknown => OBSTACLE_COST - 1.0,
        cost if cost < INSCRIBED => {
            let whole = libm::trunc(f64::from(NEUTRAL_COST) + COST_FACTOR * f64::from(cost));
            (whole as f32).min(OBSTACLE_COST - 1.0)
        }
        _ => OBSTACLE_COST,
    }
}

impl CostTables {
    fn new(allow_unknown: bool) -> Self {
        let cost_of = |cost: u8| cell_cost(cost, allow_unknown);
        let terms = |index: usize| CellTerms::new(f64::from(cost_of(index as u8)));
        let margin = |index: usize| {
            let cost = cost_of(index as u8);
            let is_obstacle = cost >= OBSTACLE_COST;
            if is_obstacle { f32::INFINITY } else { (UPDATE_RATIO * f64::from(cost)) as f32 }
        };
        Self { cell: std::array::from_fn(terms), margin: std::array::from_fn(margin) }
    }

    fn is_obstacle(&self, cost: u8) -> bool {
        self.margin[usize::from(cost)] == f32::INFINITY
    }
}

/// End of a propagation by the client.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PropagationCancelled;

/// Priority of a cell by its distance to the goal.
trait Guide {
    /// Returns the addition to the potential of a cell in the order of the updates.
    fn estimate(&self, index: u32) -> f32;
}

/// No goal: in all directions.
struct Everywhere;

impl Guide for Everywhere {
    fn estimate(&self, _: u32) -> f32 {
        0.0
    }
}

/// Offsets of cells from a goal.
struct GoalOffset {
    width: u32,
    inverse_width: f64,
    goal: (i64, i64),
}

impl GoalOffset {
    fn new(width: usize, goal: Cell) -> Self {
        let inverse_width = 1.0 / width as f64;
        Self { width: width as u32, inverse_width, goal: (goal.0 as i64, goal.1 as i64) }
    }

    /// Returns the squared distance of a cell \[cells²\].
    #[inline(always)]
    fn square(&self, index: u32) -> f32 {
        // Exact for all indices below 2^31, and faster than a division.
        let row = ((f64::from(index) + 0.5) * self.inverse_width) as u32;
        let column = index - row * self.width;
        let (dx, dy) = (i64::from(column) - self.goal.0, i64::from(row) - self.goal.1);
        (dx * dx + dy * dy) as f32
    }
}

/// A* of NavFn.
struct TowardsGoal(GoalOffset);

impl Guide for TowardsGoal {
    #[inline(always)]
    fn estimate(&self, index: u32) -> f32 {
        self.0.square(index).sqrt() * NEUTRAL_COST
    }
}

impl PotentialField {
    /// Returns the potential of a cell; none if it was not reached or is outside the grid.
    #[must_use]
    pub fn potential(&self, (column, row): Cell) -> Option<f32> {
        let is_inside = column < self.width && row < self.height;
        let potential = is_inside.then(|| self.at(row * self.width + column))?;
        let is_known = !self.has_corridor || self.corridor.is_exact((column, row));
        (potential < UNREACHED_COST && is_known).then_some(potential)
    }

    /// Returns the potential at an index, or [`UNREACHED_COST`].
    pub(super) fn at(&self, index: usize) -> f32 {
        if self.has_corridor {
            let is_inside = index < self.width * self.height;
            let cell = || (index % self.width, index / self.width);
            return if is_inside { self.corridor.at(cell()) } else { UNREACHED_COST };
        }
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
        let tables = CostTables::new(how.allow_unknown);
        let map = CostGrid { costs, tables: &tables };
        self.start(map, width, how.robot);
        match (how.method, how.goal) {
            (NavFnMethod::AStar, Some(goal)) => {
                let guide = TowardsGoal(GoalOffset::new(width, goal));
                self.front.threshold += guide.estimate(self.index(how.robot) as u32);
                self.propagate(map, how.goal, &guide, is_cancelled)
            }
            _ => self.propagate(map, how.goal, &Everywhere, is_cancelled),
        }
    }

    /// Computes potentials with Dijkstra in the part of the map through which the path to the goal may lead,
    /// and leaves the rest unreached. Where the goal cannot be reached, the whole map is computed. The
    /// potentials are those of [`Self::compute`] but for the influence of the order of the updates, at most
    /// half the cost of a cell.
    ///
    /// # Errors
    /// When `is_cancelled` returns true.
    pub fn compute_towards_goal(
        &mut self,
        costs: &[u8],
        width: usize,
        how: &Propagation,
        is_cancelled: &mut dyn FnMut() -> bool,
    ) -> Result<usize, PropagationCancelled> {
        let tables = CostTables::new(how.allow_unknown);
        let everywhere = Propagation { method: NavFnMethod::Dijkstra, ..*how };
        let is_goal_free =
            |(x, y): &Cell| costs.get(y * width + x).is_some_and(|cost| !tables.is_obstacle(*cost));
        let Some(goal) = how.goal.filter(is_goal_free) else {
            return self.compute(costs, width, &everywhere, is_cancelled);
        };
        let height = costs.len().checked_div(width).unwrap_or(0);
        let size = (width, height);
        if how.robot.0 >= width || how.robot.1 >= height {
            return self.compute(costs, width, &everywhere, is_cancelled);
        }
        self.has_corridor = false;
        let (is_reached, mut update_count) =
            self.corridor.compute(costs, size, goal, how, is_cancelled)?;
        if is_reached {
            self.has_corridor = true;
            if (self.width, self.height) != size {
                (self.width, self.height) = size;
                self.signed.clear();
            }
        } else {
            update_count += self.compute(costs, width, &everywhere, is_cancelled)?;
        }
        Ok(update_count)
    }

    fn index(&self, (column, row): Cell) -> usize {
        row * self.width + column
    }

    /// Restores the field and queues the neighbours of the robot.
    fn start(&mut self, map: CostGrid<'_>, width: usize, robot: Cell) {
        let height = map.costs.len().checked_div(width).unwrap_or(0);
        self.has_corridor = false;
        let is_filled = self.signed.len() == width * height;
        if (self.width, self.height) != (width, height) || !is_filled {
            (self.width, self.height) = (width, height);
            self.fill();
        } else {
            self.restore();
        }
        self.touched.clear();
        self.front.reset(OBSTACLE_COST);
        if robot.0 >= width || robot.1 >= height {
            return;
        }
        let robot = self.index(robot);
        self.signed[robot] = 0.0;
        self.touched.push(robot as u32);
        let neighbours =
            [robot + 1, robot.wrapping_sub(1), robot.wrapping_sub(width), robot + width];
        for index in neighbours {
            let is_open = self.signed.get(index).is_some_and(|signed| signed.is_sign_positive());
            if is_open && !map.tables.is_obstacle(map.costs[index]) {
                self.signed[index] = -self.signed[index];
                self.front.seed(index as u32);
            }
        }
    }

    /// Sets all cells to unreached, and marks those at the edge.
    fn fill(&mut self) {
        let (width, height) = (self.width, self.height);
        self.signed.clear();
        self.signed.resize(width * height, UNREACHED_COST);
        if width > 0 && height > 0 {
            self.signed[..width].fill(-UNREACHED_COST);
            self.signed[width * (height - 1)..].fill(-UNREACHED_COST);
            for row in self.signed.chunks_exact_mut(width) {
                row[0] = -UNREACHED_COST;
                row[width - 1] = -UNREACHED_COST;
            }
        }
    }

    /// Undoes the last propagation.
    fn restore(&mut self) {
        if self.touched.len() > self.signed.len() / 4 {
            return self.fill();
        }
        for index in &self.touched {
            self.signed[*index as usize] = UNREACHED_COST;
        }
        // Only the robot can be at the edge.
        if let Some(robot) = self.touched.first().map(|robot| *robot as usize) {
            let (column, row) = (robot % self.width, robot / self.width);
            let is_edge =
                column == 0 || row == 0 || column + 1 == self.width || row + 1 == self.height;
            if is_edge {
                self.signed[robot] = -UNREACHED_COST;
            }
        }
    }

    fn propagate<G: Guide>(
        &mut self,
        map: CostGrid<'_>,
        goal: Option<Cell>,
        guide: &G,
        is_cancelled: &mut dyn FnMut() -> bool,
    ) -> Result<usize, PropagationCancelled> {
        let goal = goal.map(|goal| self.index(goal));
        let cell_count = self.signed.len();
        let max_block_count = (cell_count / 20).max(self.width + self.height);
        let mut update_count = 0;
        let mut result = Ok(());
        for block in 0..max_block_count {
            if block % CHECK_INTERVAL_COUNT == 0 && is_cancelled() {
                result = Err(PropagationCancelled);
                break;
            }
            if self.front.is_empty() {
                break;
            }
            let current = self.front.begin_block();
            update_count += current.len();
            self.touched.extend_from_slice(&current);
            for &index in &current {
                let signed = &mut self.signed[index as usize];
                *signed = signed.abs();
            }
            let front = &mut self.front;
            for &index in &current {
                update(&mut self.signed, map, self.width, front, index, guide);
            }
            self.front.end_block(current, THRESHOLD_STEP_COST);
            if goal.is_some_and(|goal| self.at(goal) < UNREACHED_COST) {
                break;
            }
        }
        self.touched.extend(self.front.waiting());
        result.map(|()| update_count)
    }
}

/// Costs of the cells, and what follows from them.
#[derive(Clone, Copy)]
struct CostGrid<'a> {
    costs: &'a [u8],
    tables: &'a CostTables,
}

/// Updates the potential of a cell from its four neighbours by a planar wave, and queues the neighbours that
/// gain from it.
#[inline(always)]
fn update<G: Guide>(
    signed: &mut [f32],
    map: CostGrid<'_>,
    width: usize,
    front: &mut Front,
    index: u32,
    guide: &G,
) {
    let at = index as usize;
    // Only inner cells are queued, so that all neighbours exist.
    let (left, right, below, above) = (at - 1, at + 1, at - width, at + width);
    let old = signed[at];
    let (l, r, u, d) = (signed[left], signed[right], signed[below], signed[above]);
    let (across, along) = (l.abs().min(r.abs()), u.abs().min(d.abs()));
    let terms = &map.tables.cell[usize::from(map.costs[at])];
    let potential = terms.wave(across, along);
    if potential >= old.abs() {
        return;
    }
    signed[at] = potential.copysign(old);
    let priority = potential + guide.estimate(index);
    let queue = front.queue_for(priority);
    let mut offer = |neighbour: usize, value: f32| {
        // A negative value is at the edge or queued already; the margin of an obstacle is infinite.
        let is_better = value > priority + map.tables.margin[usize::from(map.costs[neighbour])];
        queue.push_if(neighbour as u32, is_better);
        signed[neighbour] = if is_better { -value } else { value };
    };
    offer(left, l);
    offer(right, r);
    offer(below, u);
    offer(above, d);
}
