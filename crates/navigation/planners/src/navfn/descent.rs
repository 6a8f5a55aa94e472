//! Path down the gradient of the potentials.
//!
//! Source of the rules: `NavFn::calcPath`, `NavFn::gradCell` in `nav2_navfn_planner/src/navfn.cpp`.

use periplus_grid::Cell;

use super::field::{NEUTRAL_COST, OBSTACLE_COST, PotentialField, UNREACHED_COST};

/// Length of a step along the path \[cells\] (`pathStep`).
const STEP_CELLS: f32 = 0.5;

/// Points of a path \[cells\], relative to the corner of the grid; a cell is at its lower left corner.
pub(super) type CellPath = Vec<[f32; 2]>;

/// Position on the grid: the cell at the lower left of the four between which the gradient is interpolated.
#[derive(Clone, Copy, Debug)]
struct Position {
    cell: usize,
    /// Offset from the cell \[cells\].
    dx: f32,
    dy: f32,
}

/// Returns the path from a cell down to the robot, with at most `max_step_count` points; none if it ends in
/// a pit, at the edge of the grid or after too many steps.
pub(super) fn descend(
    field: &PotentialField,
    from: Cell,
    robot: Cell,
    max_step_count: usize,
) -> Option<CellPath> {
    let (width, height) = field.size();
    let mut path = CellPath::new();
    let mut at = Position { cell: from.1 * width + from.0, dx: 0.0, dy: 0.0 };
    for _ in 0..max_step_count {
        if field.at(nearest_cell(at, width, height)) < NEUTRAL_COST {
            path.push([robot.0 as f32, robot.1 as f32]);
            return Some(path);
        }
        if at.cell < width || at.cell > width * height - width {
            return None;
        }
        path.push([(at.cell % width) as f32 + at.dx, (at.cell / width) as f32 + at.dy]);
        let count = path.len();
        let is_oscillating = count > 2 && path[count - 1] == path[count - 3];
        at = if is_oscillating || is_at_boundary(field, at.cell, width) {
            lowest_neighbour(field, at.cell, width)?
        } else {
            step_down(field, at, width, height)?
        };
    }
    None
}

fn nearest_cell(at: Position, width: usize, height: usize) -> usize {
    let (rows, columns) = (libm::roundf(at.dy) as i64, libm::roundf(at.dx) as i64);
    let index = at.cell as i64 + columns + width as i64 * rows;
    index.clamp(0, (width * height) as i64 - 1) as usize
}

/// Indices of the eight neighbours, row by row.
fn neighbours(cell: usize, width: usize) -> [usize; 8] {
    let (below, above) = (cell.wrapping_sub(width), cell + width);
    [
        below.wrapping_sub(1),
        below,
        below.wrapping_add(1),
        cell.wrapping_sub(1),
        cell + 1,
        above - 1,
        above,
        above + 1,
    ]
}

fn is_at_boundary(field: &PotentialField, cell: usize, width: usize) -> bool {
    let is_unreached = |index: usize| field.at(index) >= UNREACHED_COST;
    is_unreached(cell) || neighbours(cell, width).into_iter().any(is_unreached)
}

/// Moves to the lowest of the eight neighbours. The comparison is with the minimum truncated to an integer.
fn lowest_neighbour(field: &PotentialField, cell: usize, width: usize) -> Option<Position> {
    let mut lowest = (cell, libm::truncf(field.at(cell)));
    for index in neighbours(cell, width) {
        let potential = field.at(index);
        if potential < lowest.1 {
            lowest = (index, libm::truncf(potential));
        }
    }
    let is_reached = field.at(lowest.0) < UNREACHED_COST;
    is_reached.then_some(Position { cell: lowest.0, dx: 0.0, dy: 0.0 })
}

/// Moves half a cell against the interpolated gradient.
fn step_down(
    field: &PotentialField,
    at: Position,
    width: usize,
    height: usize,
) -> Option<Position> {
    let Position { mut cell, mut dx, mut dy } = at;
    let gradient_at = |index: usize| gradient(field, index, width, height);
    let (low, low_right) = (gradient_at(cell), gradient_at(cell + 1));
    let (high, high_right) = (gradient_at(cell + width), gradient_at(cell + width + 1));
    let mix = |left: f32, right: f32, ratio: f32| {
        ((1.0 - f64::from(ratio)) * f64::from(left) + f64::from(ratio * right)) as f32
    };
    let component = |axis: usize| {
        mix(mix(low[axis], low_right[axis], dx), mix(high[axis], high_right[axis], dx), dy)
    };
    let (x, y) = (component(0), component(1));
    if x == 0.0 && y == 0.0 {
        return None;
    }
    let scale = (f64::from(STEP_CELLS) / libm::hypot(f64::from(x), f64::from(y))) as f32;
    dx += x * scale;
    dy += y * scale;
    if dx > 1.0 {
        cell += 1;
        dx -= 1.0;
    }
    if dx < -1.0 {
        cell -= 1;
        dx += 1.0;
    }
    if dy > 1.0 {
        cell += width;
        dy -= 1.0;
    }
    if dy < -1.0 {
        cell -= width;
        dy += 1.0;
    }
    Some(Position { cell, dx, dy })
}

/// Returns the normalised gradient at a cell, towards lower potentials; zero at the edge of the grid.
fn gradient(field: &PotentialField, cell: usize, width: usize, height: usize) -> [f32; 2] {
    if cell < width || cell > width * height - width {
        return [0.0, 0.0];
    }
    let here = field.at(cell);
    let slope = |before: f32, after: f32| {
        if here >= UNREACHED_COST {
            // In an obstacle: away from it.
            if before < UNREACHED_COST {
                -OBSTACLE_COST
            } else if after < UNREACHED_COST {
                OBSTACLE_COST
            } else {
                0.0
            }
        } else {
            let mut sum = 0.0;
            if before < UNREACHED_COST {
                sum += before - here;
            }
            if after < UNREACHED_COST {
                sum += here - after;
            }
            sum
        }
    };
    let dx = slope(field.at(cell - 1), field.at(cell + 1));
    let dy = slope(field.at(cell - width), field.at(cell + width));
    let norm = libm::hypot(f64::from(dx), f64::from(dy)) as f32;
    if norm > 0.0 {
        let inverse = 1.0 / norm;
        [inverse * dx, inverse * dy]
    } else {
        [0.0, 0.0]
    }
}
