//! Potentials in the part of a map through which the path to a goal may lead.
//!
//! First a propagation over tiles of the map, from the goal to the robot: a tile has the cost of its cheapest
//! cell, so that its potential bounds the rest of a path from below. Then Dijkstra's over the cells, in the
//! order of NavFn, which defers cells at which the sum of potential and bound is above a limit. The limit
//! starts at the bound of the robot and rises until the goal is reached, and then to the potential of the goal
//! and a margin. Potentials and costs are stored by tiles; the cells of a tile are set when the propagation
//! gets there.

use periplus_costmap::cost::{INSCRIBED, UNKNOWN};
use periplus_grid::Cell;

use super::super::front::Front;
use super::{
    CHECK_INTERVAL_COUNT, CellTerms, NEUTRAL_COST, OBSTACLE_COST, Propagation,
    PropagationCancelled, THRESHOLD_STEP_COST, UNREACHED_COST, UPDATE_RATIO, cell_cost,
};

/// Length of a tile \[cells\].
const TILE_SIDE: usize = 4;
/// Number of cells of a tile: their potentials are one cache line.
const TILE_LEN: usize = TILE_SIDE * TILE_SIDE;
/// Cost class of an obstacle; the classes of cells are their costs, 50 to 254.
const OBSTACLE: u8 = OBSTACLE_COST as u8;

/// Lower bound of the potential difference of free cells at a distance of one cell: the update
/// underestimates diagonal waves by 0.4 %.
const LOWEST_SLOPE_COST: f32 = 0.99 * NEUTRAL_COST;
/// Minimum gain of an update of a tile, in costs of the tile.
const TILE_UPDATE_RATIO: f64 = 0.1;
/// First share by which the potential of the robot's tile may be above the straight line; it doubles until the
/// tile is reached.
const FIRST_DETOUR_RATIO: f32 = 0.02;
/// Addition to the straight line in that limit.
const FIRST_DETOUR_COST: f32 = 1000.0;
/// First growth of the limit while the goal is not reached, as a ratio of the bound at the robot; it doubles.
const FIRST_EXCESS_RATIO: f32 = 0.004;
/// Ratio of the bound to the potential of a tile, since a wave over tiles is slower near its source.
const BOUND_RATIO: f32 = 0.997;
/// Part of the potential of a tile that is not in the bound: a cell may be 2 cells nearer to the goal than
/// the centre of its tile, and the goal 2 cells nearer to it.
const BOUND_OFFSET_COST: f32 = 200.0;
/// Margin of the bound of costly tiles, per cost above that of a free cell.
const BOUND_MARGIN_CELLS: f32 = 12.0;
/// Potential beyond that of the goal up to which cells are computed: the gradient of the path needs two cells
/// beside it, each at most 253, and an update may come from a cell aside of the direct line. The rest is for
/// the steps of the bound between tiles, so that potentials up to that of the goal are exact.
const COMPUTED_BEYOND_GOAL_COST: f32 = 1200.0;

/// Terms of the updates of a grid of cells or tiles, by cost class.
#[derive(Debug)]
struct ClassTables {
    terms: [CellTerms; 256],
    /// Minimum potential difference that makes an update worth while; infinite for obstacles.
    margin: [f32; 256],
}

impl ClassTables {
    fn new(side: f64, update_ratio: f64) -> Self {
        let margin = |class: usize| {
            let is_obstacle = class >= usize::from(OBSTACLE);
            if is_obstacle { f32::INFINITY } else { (update_ratio * side * class as f64) as f32 }
        };
        Self {
            terms: std::array::from_fn(|class| CellTerms::new(side * class.max(1) as f64)),
            margin: std::array::from_fn(margin),
        }
    }
}

/// Preparation of a tile for the propagation over cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum TileState {
    #[default]
    Empty,
    /// Its cells are set.
    Loaded,
    /// Its cells and those of the tiles around it are set.
    Ready,
}

/// Potentials of a part of a grid.
#[derive(Debug, Default)]
pub(super) struct Corridor {
    width: usize,
    height: usize,
    /// Number of tiles in a row, with one at each end that is outside the grid.
    stride: usize,
    /// Lowest cost class in each tile.
    classes: Vec<u8>,
    /// Potential of each tile from the goal; negative: not to be queued.
    tiles: Vec<f32>,
    /// Lower bound of the potential from a cell of each tile to the goal, less a margin by cost class.
    bounds: Vec<f32>,
    tile_front: Front,
    states: Vec<TileState>,
    /// Tiles whose cells are set.
    loaded: Vec<u32>,
    /// Potential of each cell, by tiles; negative: not to be queued.
    signed: Vec<f32>,
    /// Cost class of each cell, by tiles.
    costs: Vec<u8>,
    front: Front,
    /// Limit of the sum of potential and bound up to which potentials are those of the whole grid.
    exact_limit: f32,
}

/// Lower bound of the potential between the robot and each tile.
#[derive(Clone, Copy)]
struct Straight {
    stride: u32,
    inverse_stride: f64,
    robot: (i32, i32),
}

impl Straight {
    fn new(stride: usize, robot_tile: usize) -> Self {
        let robot = ((robot_tile % stride) as i32, (robot_tile / stride) as i32);
        Self { stride: stride as u32, inverse_stride: 1.0 / stride as f64, robot }
    }

    #[inline(always)]
    fn cost(&self, tile: usize) -> f32 {
        let tile = tile as u32;
        // Exact for all indices below 2^31, and faster than a division.
        let row = ((f64::from(tile) + 0.5) * self.inverse_stride) as u32;
        let column = tile - row * self.stride;
        let (dx, dy) = (column as i32 - self.robot.0, row as i32 - self.robot.1);
        let square = (dx * dx + dy * dy) as f32;
        square.sqrt() * (TILE_SIDE as f32 * LOWEST_SLOPE_COST)
    }
}

/// Settings of the propagation over cells.
struct CellRun<'a> {
    tables: &'a ClassTables,
    goal: usize,
    /// Limit of the sum of potential and bound.
    limit: f32,
    /// Threshold at which the propagation ends.
    end_threshold: f32,
}

/// Grid to read.
#[derive(Clone, Copy)]
struct Source<'a> {
    costs: &'a [u8],
    class_of: &'a [u8; 256],
    robot_tile: usize,
    goal_tile: usize,
    straight: Straight,
}

impl Corridor {
    /// Returns the potential of a cell of the grid, or [`UNREACHED_COST`].
    pub(super) fn at(&self, cell: Cell) -> f32 {
        let index = self.index(cell);
        let is_set = self.states[index / TILE_LEN] != TileState::Empty;
        if is_set { self.signed[index].abs() } else { UNREACHED_COST }
    }

    /// Returns true if the potential of a cell is that of the whole grid: no path to it leads over cells that
    /// were left out.
    pub(super) fn is_exact(&self, cell: Cell) -> bool {
        let tile = self.index(cell) / TILE_LEN;
        self.at(cell) + bound(self.tiles[tile]) <= self.exact_limit
    }

    fn index(&self, (column, row): Cell) -> usize {
        let tile = (row / TILE_SIDE + 1) * self.stride + column / TILE_SIDE + 1;
        tile * TILE_LEN + row % TILE_SIDE * TILE_SIDE + column % TILE_SIDE
    }

    /// Computes the potentials. Returns true and the number of updates; false if the goal was not reached.
    pub(super) fn compute(
        &mut self,
        costs: &[u8],
        (width, height): (usize, usize),
        goal: Cell,
        how: &Propagation,
        is_cancelled: &mut dyn FnMut() -> bool,
    ) -> Result<(bool, usize), PropagationCancelled> {
        self.restore(width, height);
        let class_of = std::array::from_fn(|cost| cell_cost(cost as u8, how.allow_unknown) as u8);
        let (robot, goal) = (self.index(how.robot), self.index(goal));
        let robot_tile = robot / TILE_LEN;
        let source = Source {
            costs,
            class_of: &class_of,
            robot_tile,
            goal_tile: goal / TILE_LEN,
            straight: Straight::new(self.stride, robot_tile),
        };
        let tile_tables = ClassTables::new(TILE_SIDE as f64, TILE_UPDATE_RATIO);
        let cell_tables = ClassTables::new(1.0, UPDATE_RATIO);
        let mut update_count = 0;
        self.start_tiles(&source, goal / TILE_LEN);
        let straight = source.straight.cost(goal / TILE_LEN);
        let mut detour_ratio = FIRST_DETOUR_RATIO;
        while self.tiles[robot_tile].abs() >= UNREACHED_COST {
            if !self.tile_front.has_deferred() {
                return Ok((false, update_count));
            }
            let limit = (1.0 + detour_ratio) * straight + FIRST_DETOUR_COST;
            update_count += self.extend_tiles(&source, &tile_tables, limit);
            detour_ratio *= 2.0;
        }
        let lowest = self.tiles[robot_tile].abs();
        let mut limit = lowest + COMPUTED_BEYOND_GOAL_COST;
        let mut excess = lowest * FIRST_EXCESS_RATIO;
        let mut end_threshold = f32::INFINITY;
        self.start_cells(&source, robot);
        loop {
            let tile_limit = (limit + BOUND_OFFSET_COST) / BOUND_RATIO;
            update_count += self.extend_tiles(&source, &tile_tables, tile_limit);
            let run = CellRun { tables: &cell_tables, goal, limit, end_threshold };
            update_count += self.extend_cells(&source, &run, is_cancelled)?;
            let potential = self.signed[goal].abs();
            if potential + COMPUTED_BEYOND_GOAL_COST <= limit {
                self.exact_limit = potential;
                return Ok((true, update_count));
            }
            if potential < UNREACHED_COST {
                end_threshold = end_threshold.min(self.front.threshold);
                limit = potential + COMPUTED_BEYOND_GOAL_COST;
            } else if !self.front.has_deferred() || limit >= UNREACHED_COST / 2.0 {
                return Ok((false, update_count));
            } else if !self.tile_front.has_deferred() {
                limit = UNREACHED_COST / 2.0;
            } else {
                limit += excess;
                excess *= 2.0;
            }
        }
    }

    /// Forgets all tiles.
    fn restore(&mut self, width: usize, height: usize) {
        if (self.width, self.height) == (width, height) {
            self.tiles.fill(UNREACHED_COST);
            self.bounds.fill(UNREACHED_COST);
            for tile in self.loaded.drain(..) {
                self.states[tile as usize] = TileState::Empty;
            }
        } else {
            (self.width, self.height) = (width, height);
            self.stride = width.div_ceil(TILE_SIDE) + 2;
            let tile_rows = height.div_ceil(TILE_SIDE) + 2;
            let count = self.stride * tile_rows;
            self.loaded.clear();
            self.classes = vec![OBSTACLE; count];
            self.tiles = vec![UNREACHED_COST; count];
            self.bounds = vec![UNREACHED_COST; count];
            self.states = vec![TileState::Empty; count];
            // Zeroed memory costs nothing until it is used.
            self.signed = vec![0.0; count * TILE_LEN];
            self.costs = vec![0; count * TILE_LEN];
            for tile in 0..count {
                let (row, column) = (tile / self.stride, tile % self.stride);
                let is_outside =
                    [0, tile_rows - 1].contains(&row) || [0, self.stride - 1].contains(&column);
                if is_outside {
                    self.states[tile] = TileState::Loaded;
                    self.signed[tile * TILE_LEN..][..TILE_LEN].fill(-UNREACHED_COST);
                }
            }
        }
        self.exact_limit = 0.0;
    }

    /// Returns the row and the column of the first cell of a tile.
    fn corner(&self, tile: usize) -> (usize, usize) {
        ((tile / self.stride - 1) * TILE_SIDE, (tile % self.stride - 1) * TILE_SIDE)
    }

    /// Sets the classes of all tiles: the lowest in each.
    fn read(&mut self, source: &Source<'_>) {
        // An unknown cell has the highest cost in the costmap, and may be passable.
        let is_unknown_passable = source.class_of[usize::from(UNKNOWN)] < OBSTACLE;
        let unknown = if is_unknown_passable { INSCRIBED - 1 } else { UNKNOWN };
        let width = self.width;
        let mut lowest = vec![0; (self.stride - 2) * TILE_SIDE];
        let rows = source.costs.chunks(width * TILE_SIDE);
        for (rows, classes) in rows.zip(self.classes.chunks_exact_mut(self.stride).skip(1)) {
            lowest.fill(UNKNOWN);
            for row in rows.chunks_exact(width) {
                for (lowest, cost) in lowest.iter_mut().zip(row) {
                    let cost = if *cost == UNKNOWN { unknown } else { *cost };
                    *lowest = (*lowest).min(cost);
                }
            }
            for (class, [a, b, c, d]) in classes[1..].iter_mut().zip(lowest.as_chunks().0) {
                *class = *a.min(b).min(c).min(d);
            }
            for class in &mut classes[1..self.stride - 1] {
                *class = source.class_of[usize::from(*class)];
            }
        }
        // The cell of the robot is free, whatever its cost.
        let class = &mut self.classes[source.robot_tile];
        *class = (*class).min(NEUTRAL_COST as u8);
    }

    /// Sets the cells of a tile and of those around it.
    fn prepare(&mut self, source: &Source<'_>, tile: usize) {
        for tile in [tile, tile - 1, tile + 1, tile - self.stride, tile + self.stride] {
            if self.states[tile] == TileState::Empty {
                self.load(source, tile);
            }
        }
        self.states[tile] = TileState::Ready;
    }

    /// Sets the cells of a tile.
    fn load(&mut self, source: &Source<'_>, tile: usize) {
        let (first_row, first_column) = self.corner(tile);
        let (width, height) = (self.width, self.height);
        let cells = tile * TILE_LEN..(tile + 1) * TILE_LEN;
        let signed = self.signed[cells.clone()].as_chunks_mut::<TILE_SIDE>().0;
        let classes = self.costs[cells].as_chunks_mut::<TILE_SIDE>().0;
        for (row, (signed, classes)) in (first_row..).zip(signed.iter_mut().zip(classes)) {
            if row >= height {
                *signed = [-UNREACHED_COST; TILE_SIDE];
                *classes = [OBSTACLE; TILE_SIDE];
                continue;
            }
            let is_edge = row == 0 || row + 1 == height;
            *signed = [if is_edge { -UNREACHED_COST } else { UNREACHED_COST }; TILE_SIDE];
            let costs = &source.costs[row * width + first_column..(row + 1) * width];
            if let Some(costs) = costs.first_chunk::<TILE_SIDE>() {
                for (class, cost) in classes.iter_mut().zip(costs) {
                    *class = source.class_of[usize::from(*cost)];
                }
            } else {
                *classes = [OBSTACLE; TILE_SIDE];
                for (class, cost) in classes.iter_mut().zip(costs) {
                    *class = source.class_of[usize::from(*cost)];
                }
            }
            if first_column == 0 {
                signed[0] = -UNREACHED_COST;
            }
            if first_column + TILE_SIDE >= width {
                signed[width - 1 - first_column..].fill(-UNREACHED_COST);
            }
        }
        self.states[tile] = TileState::Loaded;
        self.loaded.push(tile as u32);
    }

    fn start_tiles(&mut self, source: &Source<'_>, goal: usize) {
        self.tile_front.reset(0.0);
        self.read(source);
        self.tile_front.defer(0.0, goal as u32);
    }

    /// Continues the propagation over tiles until the sum of potential and straight rest is above a limit.
    fn extend_tiles(&mut self, source: &Source<'_>, tables: &ClassTables, limit: f32) -> usize {
        let mut update_count = 0;
        self.tile_front.resume(true);
        while !self.tile_front.is_empty() {
            let current = self.tile_front.begin_block();
            update_count += current.len();
            for &tile in &current {
                let signed = &mut self.tiles[tile as usize];
                *signed = signed.abs();
            }
            for &tile in &current {
                self.update_tile(source, tables, tile as usize, limit);
            }
            self.tile_front.end_block(current, 2.0 * TILE_SIDE as f32 * NEUTRAL_COST);
        }
        update_count
    }

    #[inline(always)]
    fn update_tile(&mut self, source: &Source<'_>, tables: &ClassTables, tile: usize, limit: f32) {
        let (left, right, below, above) =
            (tile - 1, tile + 1, tile - self.stride, tile + self.stride);
        let tiles = self.tiles.as_mut_slice();
        let old = tiles[tile];
        let (l, r, u, d) = (tiles[left], tiles[right], tiles[below], tiles[above]);
        let (across, along) = (l.abs().min(r.abs()), u.abs().min(d.abs()));
        let potential = if tile == source.goal_tile {
            0.0
        } else {
            tables.terms[usize::from(self.classes[tile])].wave(across, along)
        };
        if potential >= old.abs() {
            return;
        }
        if potential + source.straight.cost(tile) > limit {
            self.tile_front.defer(potential, tile as u32);
            return;
        }
        tiles[tile] = potential.copysign(old);
        let class = f32::from(self.classes[tile]);
        self.bounds[tile] = bound(potential) - BOUND_MARGIN_CELLS * (class - NEUTRAL_COST);
        let queue = self.tile_front.queue_for(potential);
        let mut offer = |neighbour: usize, value: f32| {
            let margin = tables.margin[usize::from(self.classes[neighbour])];
            let is_better = value > potential + margin;
            queue.push_if(neighbour as u32, is_better);
            tiles[neighbour] = if is_better { -value } else { value };
        };
        offer(left, l);
        offer(right, r);
        offer(below, u);
        offer(above, d);
    }

    /// Queues the neighbours of the robot.
    fn start_cells(&mut self, source: &Source<'_>, robot: usize) {
        self.front.reset(OBSTACLE_COST);
        self.prepare(source, source.goal_tile);
        self.prepare(source, source.robot_tile);
        self.signed[robot] = 0.0;
        let [left, right, below, above] = self.steps()[robot % TILE_LEN];
        for step in [right, left, below, above] {
            let index = (robot as u32).wrapping_add(step) as usize;
            let signed = &mut self.signed[index];
            if signed.is_sign_positive() && self.costs[index] < OBSTACLE {
                *signed = -*signed;
                self.front.seed(index as u32);
            }
        }
    }

    /// Continues the propagation over cells until the goal is reached, or no cell is left within the limit.
    fn extend_cells(
        &mut self,
        source: &Source<'_>,
        run: &CellRun<'_>,
        is_cancelled: &mut dyn FnMut() -> bool,
    ) -> Result<usize, PropagationCancelled> {
        let cell_count = self.width * self.height;
        let max_block_count = (cell_count / 20).max(self.width + self.height);
        let steps = self.steps();
        let mut update_count = 0;
        if self.front.has_deferred() {
            // Once the goal is reached, only cells that come before it are of interest.
            let keeps_waiting = run.end_threshold == f32::INFINITY;
            self.front.resume(keeps_waiting);
        }
        for block in 0..max_block_count {
            if block % CHECK_INTERVAL_COUNT == 0 && is_cancelled() {
                return Err(PropagationCancelled);
            }
            if self.front.is_empty() || self.front.threshold >= run.end_threshold {
                break;
            }
            let current = self.front.begin_block();
            update_count += current.len();
            for &index in &current {
                let signed = &mut self.signed[index as usize];
                *signed = signed.abs();
            }
            let mut rest = current.as_slice();
            loop {
                let grids = (&self.costs[..], &self.bounds[..], &self.states[..]);
                rest = update_block(&mut self.signed, grids, &mut self.front, run, &steps, rest);
                let Some(index) = rest.first() else { break };
                self.prepare(source, *index as usize / TILE_LEN);
            }
            self.front.end_block(current, THRESHOLD_STEP_COST);
            if self.signed[run.goal].abs() < UNREACHED_COST && run.end_threshold == f32::INFINITY {
                break;
            }
        }
        Ok(update_count)
    }

    /// Offsets to the neighbours of each cell of a tile: left, right, below, above.
    fn steps(&self) -> [[u32; 4]; TILE_LEN] {
        let tile_row = (self.stride * TILE_LEN) as u32;
        std::array::from_fn(|index| {
            let (row, column) = (index / TILE_SIDE, index % TILE_SIDE);
            let (side, len) = (TILE_SIDE as u32, TILE_LEN as u32);
            let last = TILE_SIDE - 1;
            [
                if column == 0 { (len - side + 1).wrapping_neg() } else { 1_u32.wrapping_neg() },
                if column == last { len - side + 1 } else { 1 },
                if row == 0 {
                    (tile_row + side).wrapping_sub(len).wrapping_neg()
                } else {
                    side.wrapping_neg()
                },
                if row == last { tile_row + side - len } else { side },
            ]
        })
    }
}

/// Updates cells up to one whose tile is not ready; returns that and those after it. Not inlined, so that the
/// compiler knows that the slices do not overlap.
#[inline(never)]
fn update_block<'a>(
    signed: &mut [f32],
    (costs, bounds, states): (&[u8], &[f32], &[TileState]),
    front: &mut Front,
    run: &CellRun<'_>,
    steps: &[[u32; 4]; TILE_LEN],
    cells: &'a [u32],
) -> &'a [u32] {
    for (count, index) in cells.iter().enumerate() {
        let tile = *index as usize / TILE_LEN;
        if states[tile] != TileState::Ready {
            return &cells[count..];
        }
        update(signed, costs, bounds[tile], front, run, steps, *index);
    }
    &[]
}

/// Updates a cell, and queues the neighbours that gain from it. A cell beyond the limit is deferred.
#[inline(always)]
fn update(
    signed: &mut [f32],
    costs: &[u8],
    bound: f32,
    front: &mut Front,
    run: &CellRun<'_>,
    steps: &[[u32; 4]; TILE_LEN],
    index: u32,
) {
    let at = index as usize;
    let next = |step: u32| index.wrapping_add(step) as usize;
    let [left, right, below, above] = &steps[at % TILE_LEN];
    let (left, right, below, above) = (next(*left), next(*right), next(*below), next(*above));
    let (l, r, u, d) = (signed[left], signed[right], signed[below], signed[above]);
    let old = signed[at];
    let (across, along) = (min(l.abs(), r.abs()), min(u.abs(), d.abs()));
    let potential = run.tables.terms[usize::from(costs[at])].wave(across, along);
    if potential >= old.abs() {
        return;
    }
    if potential + bound > run.limit {
        front.defer(potential, index);
        return;
    }
    signed[at] = potential.copysign(old);
    let is_better = |neighbour: usize, value: f32| {
        // A negative value is at the edge or queued already; the margin of an obstacle is infinite.
        value > potential + run.tables.margin[usize::from(costs[neighbour])]
    };
    let flip = |value: f32, is_better: bool| {
        f32::from_bits(value.to_bits() | (u32::from(is_better) << 31))
    };
    let better =
        [is_better(left, l), is_better(right, r), is_better(below, u), is_better(above, d)];
    signed[left] = flip(l, better[0]);
    signed[right] = flip(r, better[1]);
    signed[below] = flip(u, better[2]);
    signed[above] = flip(d, better[3]);
    let neighbours = [left as u32, right as u32, below as u32, above as u32];
    front.queue_for(potential).push_all(neighbours, better);
}

/// Lower number; one instruction, unlike `f32::min`, which treats NaN.
#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Lower bound of the potential from a cell of a tile to the goal.
#[inline(always)]
fn bound(tile: f32) -> f32 {
    BOUND_RATIO * tile.abs() - BOUND_OFFSET_COST
}

#[cfg(test)]
mod tests {
    use super::super::NavFnMethod;
    use super::*;

    /// Computes the potential of a goal on a map of free cells (`.`), obstacles (`#`) and unknown cells (`?`),
    /// twice, since the second propagation restores the first.
    fn check(rows: &[&str], robot: Cell, goal: Cell, expected: Option<f32>) {
        let cost = |letter: u8| match letter {
            b'.' => 0,
            b'?' => UNKNOWN,
            _ => 254,
        };
        let costs: Vec<u8> = rows.iter().flat_map(|row| row.bytes().map(cost)).collect();
        let size = (rows[0].len(), rows.len());
        let method = NavFnMethod::Dijkstra;
        let how = Propagation { method, allow_unknown: true, robot, goal: Some(goal) };
        let mut corridor = Corridor::default();
        for _ in 0..2 {
            let result = corridor.compute(&costs, size, goal, &how, &mut || false);
            assert_eq!(result.map(|(is_reached, _)| is_reached), Ok(expected.is_some()));
            if let Some(expected) = expected {
                assert_eq!((corridor.at(goal), corridor.is_exact(goal)), (expected, true));
            }
        }
    }

    #[test]
    fn a_straight_aisle_costs_50_for_each_cell() {
        let aisle = ["####################", "....................", "####################"];
        check(&aisle, (1, 1), (17, 1), Some(800.0));
        check(&aisle, (17, 1), (1, 1), Some(800.0));
        check(&aisle, (0, 1), (18, 1), Some(900.0));
        check(&aisle, (3, 1), (3, 1), Some(0.0));
        check(&["#######", "..?....", "#######"], (1, 1), (5, 1), Some(3.0 * 50.0 + 253.0));
    }

    #[test]
    fn goals_at_the_edge_and_behind_walls_are_not_reached() {
        let walls = ["........", "....#...", "....#...", "....#...", "########", "........"];
        check(&walls, (1, 1), (7, 2), None);
        check(&walls, (1, 1), (6, 2), None);
        let thick = ["................"; 6].map(|row| row.replace("........", "....####"));
        check(&thick.each_ref().map(String::as_str), (1, 2), (9, 2), None);
    }

    #[test]
    fn offsets_lead_to_the_neighbours() {
        let corridor = Corridor { width: 12, height: 12, stride: 5, ..Corridor::default() };
        let steps = corridor.steps();
        for (column, row) in [(5, 5), (4, 4), (7, 7), (4, 7), (7, 4)] {
            let at = corridor.index((column, row));
            let neighbours =
                steps[at % TILE_LEN].map(|step| (at as u32).wrapping_add(step) as usize);
            let around =
                [(column - 1, row), (column + 1, row), (column, row - 1), (column, row + 1)];
            assert_eq!(neighbours, around.map(|cell| corridor.index(cell)));
        }
    }
}
