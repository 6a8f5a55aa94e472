//! Routes: for each goal the walking distance from every cell, and the next point to walk to.
//!
//! Distances are shortest paths over the eight neighbours of a cell. A cell near a wall costs more, since people keep
//! a distance to walls.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec2;
use periplus_grid::{Cell, Grid, Line};

use crate::floor::Floor;

/// Distance that people keep to walls where there is space \[m\].
const COMFORT_CLEARANCE_M: f64 = 0.6;

/// Additional cost of a cell at a wall, per its length.
const WALL_COST_RATIO: f64 = 3.0;

/// People look at most this far ahead for the next corner \[m\].
const LOOKAHEAD_M: f64 = 4.0;

/// A line to the next point keeps this distance to walls, unless the agent is nearer already \[m\].
const LINE_CLEARANCE_M: f64 = 0.25;

/// Steps from a cell that is too narrow to one that is not.
const ESCAPE_CELLS: usize = 4;

/// Distances to one goal.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    /// Cost from each cell to the goal \[m\]; infinite where no path leads.
    cost_m: Grid<f32>,
    goal: DVec2,
}

impl Route {
    /// Distances to a disc; none where no cell of it is passable.
    pub(crate) fn new(floor: &Floor, goal: DVec2, radius_m: f64) -> Option<Self> {
        let info = floor.clearance_m.info;
        let mut cost_m = Grid::new(info, f32::INFINITY);
        let mut queue = BinaryHeap::new();
        let centre = info.cell_of(goal.x, goal.y)?;
        for index in 0..info.len() {
            let cell = info.cell(index);
            let is_in_goal = cell == centre
                || DVec2::from(info.centre_of(cell)).distance(goal) <= radius_m.min(0.5);
            if is_in_goal
                && floor.is_passable(cell)
                && !floor.walls.blocks(goal, info.centre_of(cell).into())
            {
                cost_m[cell] = 0.0;
                queue.push(Entry { cost_m: 0.0, cell });
            }
        }
        if queue.is_empty() {
            return None;
        }
        while let Some(Entry { cost_m: cost, cell }) = queue.pop() {
            if cost > cost_m[cell] {
                continue;
            }
            for (next, length_m) in neighbours(&floor.clearance_m, cell) {
                if !floor.is_passable(next) || !is_open_diagonal(floor, cell, next) {
                    continue;
                }
                #[expect(clippy::cast_possible_truncation, reason = "metres of a building")]
                let reached = (f64::from(cost) + length_m * cell_cost(floor, next)) as f32;
                if reached < cost_m[next] {
                    cost_m[next] = reached;
                    queue.push(Entry { cost_m: reached, cell: next });
                }
            }
        }
        Some(Self { cost_m, goal })
    }

    /// Cost from a point, from the next passable cell where the point is in a narrow one \[m\]; none without a path.
    pub(crate) fn cost_m(&self, floor: &Floor, point: DVec2) -> Option<f64> {
        let cell = self.passable_near(floor, point)?;
        Some(f64::from(self.cost_m[cell]))
    }

    /// Returns the farthest point of the path from a point to which a straight line is free, at most some metres ahead;
    /// none without a path.
    pub(crate) fn next_point(&self, floor: &Floor, from: DVec2) -> Option<DVec2> {
        let info = self.cost_m.info;
        let start = self.passable_near(floor, from)?;
        let mut cell = start;
        let mut visible: DVec2 = info.centre_of(start).into();
        let mut before = visible;
        let mut walked_m = 0.0;
        while walked_m < LOOKAHEAD_M {
            if self.cost_m[cell] == 0.0 {
                if !floor.walls.blocks(from, self.goal) && is_line_free(floor, from, self.goal) {
                    return Some(self.goal);
                }
                break;
            }
            let best = neighbours(&self.cost_m, cell)
                .filter(|(next, _)| is_open_diagonal(floor, cell, *next))
                .map(|(next, length_m)| (self.cost_m[next], next, length_m))
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let Some((cost, next, length_m)) = best else { break };
            if cost >= self.cost_m[cell] {
                break;
            }
            cell = next;
            walked_m += length_m;
            let point = info.centre_of(cell).into();
            if !is_line_free(floor, from, point) {
                break;
            }
            (before, visible) = (visible, point);
        }
        Some(in_own_layer(floor, from, before, visible))
    }

    /// The cell of a point, or the nearest cell with a path that no wall separates from it.
    fn passable_near(&self, floor: &Floor, point: DVec2) -> Option<Cell> {
        let info = self.cost_m.info;
        let (column, row) = info.cell_of(point.x, point.y)?;
        if self.cost_m[(column, row)].is_finite() {
            return Some((column, row));
        }
        let range = |at: usize, count: usize| {
            at.saturating_sub(ESCAPE_CELLS)..=(at + ESCAPE_CELLS).min(count - 1)
        };
        let mut best: Option<(f64, Cell)> = None;
        for row in range(row, info.height) {
            for column in range(column, info.width) {
                let cell = (column, row);
                let centre = DVec2::from(info.centre_of(cell));
                let distance_m = centre.distance(point);
                let is_nearer = best.is_none_or(|(best_m, _)| distance_m < best_m);
                if is_nearer && self.cost_m[cell].is_finite() && !floor.walls.blocks(point, centre)
                {
                    best = Some((distance_m, cell));
                }
            }
        }
        best.map(|(_, cell)| cell)
    }
}

/// Moves the next point to the side of the path on which the agent walks, as far as there is space: people use the whole
/// width of a passage, and not only its middle.
fn in_own_layer(floor: &Floor, from: DVec2, before: DVec2, point: DVec2) -> DVec2 {
    let Some(along) = (point - before).try_normalize() else { return point };
    let clearance_m = floor.clearance_m(point).min(COMFORT_CLEARANCE_M * 2.0);
    let space_m = (clearance_m - LINE_CLEARANCE_M).max(0.0);
    let aside_m = (from - point).dot(along.perp()).clamp(-space_m, space_m);
    let moved = point + along.perp() * aside_m;
    if is_line_free(floor, from, moved) { moved } else { point }
}

/// True where a body passes straight from one point to another.
fn is_line_free(floor: &Floor, from: DVec2, to: DVec2) -> bool {
    let info = floor.clearance_m.info;
    let (Some(start), Some(end)) = (info.cell_of(from.x, from.y), info.cell_of(to.x, to.y)) else {
        return false;
    };
    let mut needed_m = LINE_CLEARANCE_M.min(f64::from(floor.clearance_m[start]));
    needed_m = needed_m.min(f64::from(floor.clearance_m[end]));
    Line::between(start, end).all(|cell| f64::from(floor.clearance_m[cell]) >= needed_m)
        && needed_m > 0.0
}

/// A diagonal step must not cut a corner.
fn is_open_diagonal(floor: &Floor, from: Cell, to: Cell) -> bool {
    from.0 == to.0
        || from.1 == to.1
        || (floor.is_passable((from.0, to.1)) && floor.is_passable((to.0, from.1)))
}

/// The up to eight neighbours of a cell with the distances to them \[m\].
fn neighbours<T: Copy>(grid: &Grid<T>, (column, row): Cell) -> impl Iterator<Item = (Cell, f64)> {
    let info = grid.info;
    let side = info.resolution_m;
    (0..9).filter(|step| *step != 4).filter_map(move |step| {
        let next = ((column + step % 3).wrapping_sub(1), (row + step / 3).wrapping_sub(1));
        let length_m = if step % 2 == 1 { side } else { side * std::f64::consts::SQRT_2 };
        info.contains(next).then_some((next, length_m))
    })
}

/// Cost of a cell per metre.
fn cell_cost(floor: &Floor, cell: Cell) -> f64 {
    let lack_m = COMFORT_CLEARANCE_M - f64::from(floor.clearance_m[cell]);
    let lack_ratio = (lack_m / COMFORT_CLEARANCE_M).max(0.0);
    1.0 + WALL_COST_RATIO * lack_ratio * lack_ratio
}

/// Entry of the queue, the smallest cost first.
#[derive(PartialEq)]
struct Entry {
    cost_m: f32,
    cell: Cell,
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost_m.total_cmp(&self.cost_m).then_with(|| other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::Wall;

    /// Two rooms with a door at y = 2 in the wall x = 5.
    fn two_rooms() -> Floor {
        let mut walls = Wall::rectangle([0.0, 0.0], [10.0, 8.0]).to_vec();
        walls.push(Wall::new([5.0, 0.0], [5.0, 1.5]));
        walls.push(Wall::new([5.0, 2.5], [5.0, 8.0]));
        Floor::new(walls).unwrap()
    }

    #[test]
    fn the_way_to_the_other_room_leads_through_the_door() {
        let floor = two_rooms();
        let route = Route::new(&floor, DVec2::new(9.0, 7.0), 0.3).unwrap();
        let mut point = DVec2::new(1.0, 7.0);
        let mut length_m = 0.0;
        let mut crossed_at = None;
        while point.distance(DVec2::new(9.0, 7.0)) > 0.2 && length_m < 30.0 {
            let target = route.next_point(&floor, point).unwrap();
            let next = point + (target - point).clamp_length_max(0.1);
            assert!(!floor.walls.blocks(point, next), "{point}");
            if point.x < 5.0 && next.x >= 5.0 {
                crossed_at = Some(next.y);
            }
            length_m += point.distance(next);
            point = next;
        }
        assert!((1.7..2.3).contains(&crossed_at.unwrap()), "{crossed_at:?}");
        // Two straight lines from (1, 7) to (5, 2) to (9, 7): 12.8 m.
        assert!((12.0..14.0).contains(&length_m), "{length_m}");
    }

    #[test]
    fn a_goal_in_sight_is_walked_to_directly() {
        let floor = two_rooms();
        let goal = DVec2::new(3.0, 6.0);
        let route = Route::new(&floor, goal, 0.3).unwrap();
        assert_eq!(route.next_point(&floor, DVec2::new(2.0, 5.0)), Some(goal));
        let cost_m = route.cost_m(&floor, DVec2::new(2.0, 6.0)).unwrap();
        assert!((0.6..1.2).contains(&cost_m), "{cost_m}");
    }

    /// Points at which a body that has turned sideways touches the walls of two rooms, whose door and corners are not on
    /// the borders of cells.
    #[test]
    fn one_who_touches_walls_is_led_along_the_path() {
        let mut walls = Wall::rectangle([0.0, 0.0], [10.0, 6.0]).to_vec();
        walls.push(Wall::new([5.03, 0.0], [5.03, 1.57]));
        walls.push(Wall::new([5.03, 2.66], [5.03, 6.0]));
        let floor = Floor::new(walls).unwrap();
        let route = Route::new(&floor, DVec2::new(8.0, 5.0), 0.3).unwrap();
        let mut tried = 0;
        for step in 0..40_000 {
            let from = DVec2::new(f64::from(step % 200) * 0.05, f64::from(step / 200) * 0.03);
            let touch_m = floor.walls().iter().map(|wall| wall.nearest_point(from).distance(from));
            if !(0.13..0.2).contains(&touch_m.fold(f64::INFINITY, f64::min)) {
                continue;
            }
            let target = route.next_point(&floor, from).unwrap();
            assert!(!floor.walls.blocks(from, target), "{from} {target}");
            let cost_m = |point| route.cost_m(&floor, point).unwrap();
            assert!(cost_m(target) < cost_m(from) - 0.1, "{from} {target}");
            tried += 1;
        }
        assert!(tried > 1000, "{tried}");
    }

    #[test]
    fn one_in_a_narrow_niche_is_not_led_through_its_wall() {
        let mut walls = Wall::rectangle([0.0, 0.0], [10.0, 6.0]).to_vec();
        walls.extend([5.03, 5.39].map(|x| Wall::new([x, 2.0], [x, 6.0])));
        let floor = Floor::new(walls).unwrap();
        for goal in [[2.0, 5.0], [8.0, 5.0]] {
            let route = Route::new(&floor, goal.into(), 0.3).unwrap();
            for step in 0..30 {
                let from = DVec2::new(5.21, 2.1 + 0.1 * f64::from(step));
                let target = route.next_point(&floor, from);
                let is_blocked = target.is_some_and(|target| floor.walls.blocks(from, target));
                assert!(!is_blocked, "{from} {target:?}");
                assert_eq!(target.is_some(), step < 2, "{from} {target:?}");
            }
        }
    }

    #[test]
    fn no_path_leads_into_a_closed_box() {
        let mut walls = Wall::rectangle([0.0, 0.0], [10.0, 8.0]).to_vec();
        walls.extend(Wall::rectangle([4.0, 4.0], [6.0, 6.0]));
        let floor = Floor::new(walls).unwrap();
        let route = Route::new(&floor, DVec2::new(5.0, 5.0), 0.3).unwrap();
        assert_eq!(route.cost_m(&floor, DVec2::new(1.0, 1.0)), None);
        assert!(Route::new(&floor, DVec2::new(0.0, 4.0), 0.05).is_none());
    }
}
