//! Walls: segments that no agent crosses, with an index for queries near a point.

use glam::DVec2;

/// Edge length of the index's cells \[m\].
const CELL_M: f64 = 1.0;

/// Most cells of the index along one axis; larger floors get larger cells.
const MAX_AXIS_CELL_COUNT: usize = 1024;

/// Wall without thickness between two points \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// One end.
    pub start: DVec2,
    /// The other end; may be equal to the first.
    pub end: DVec2,
}

impl Wall {
    /// Wall between two points.
    #[must_use]
    pub fn new(start: [f64; 2], end: [f64; 2]) -> Self {
        Self { start: start.into(), end: end.into() }
    }

    /// The four sides of an axis-parallel rectangle.
    #[must_use]
    pub fn rectangle(low: [f64; 2], high: [f64; 2]) -> [Self; 4] {
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        std::array::from_fn(|side| Self::new(corners[side], corners[(side + 1) % 4]))
    }

    /// Returns the point of the wall that is nearest to a point.
    #[must_use]
    pub fn nearest_point(&self, point: DVec2) -> DVec2 {
        let along = self.end - self.start;
        let length_squared = along.length_squared();
        if length_squared == 0.0 {
            return self.start;
        }
        self.start + along * ((point - self.start).dot(along) / length_squared).clamp(0.0, 1.0)
    }

    /// True where the line between two points crosses or touches the wall.
    #[must_use]
    pub fn crosses(&self, from: DVec2, to: DVec2) -> bool {
        let (along, line) = (self.end - self.start, to - from);
        let sides = [along.perp_dot(from - self.start), along.perp_dot(to - self.start)];
        let ends = [line.perp_dot(self.start - from), line.perp_dot(self.end - from)];
        sides[0] * sides[1] <= 0.0 && ends[0] * ends[1] <= 0.0 && (sides != [0.0; 2])
    }
}

/// Walls with a uniform grid over them.
#[derive(Clone, Debug)]
pub(crate) struct WallIndex {
    walls: Vec<Wall>,
    low: DVec2,
    cell_m: f64,
    columns: usize,
    rows: usize,
    /// Numbers of the walls whose bounding box touches the cell, row by row.
    cells: Vec<Vec<u32>>,
}

impl WallIndex {
    pub(crate) fn new(walls: Vec<Wall>) -> Self {
        let (mut low, mut high) = (DVec2::splat(f64::INFINITY), DVec2::splat(f64::NEG_INFINITY));
        for wall in &walls {
            low = low.min(wall.start).min(wall.end);
            high = high.max(wall.start).max(wall.end);
        }
        if walls.is_empty() {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        #[expect(clippy::cast_precision_loss, reason = "a small constant")]
        let cell_m = CELL_M.max((high - low).max_element() / (MAX_AXIS_CELL_COUNT - 1) as f64);
        let mut index = Self {
            walls,
            low,
            cell_m,
            columns: cell_number(high.x - low.x, cell_m) + 1,
            rows: cell_number(high.y - low.y, cell_m) + 1,
            cells: Vec::new(),
        };
        index.cells = vec![Vec::new(); index.columns * index.rows];
        for number in 0..index.walls.len() {
            let wall = index.walls[number];
            let [columns, rows] =
                index.cells_of(wall.start.min(wall.end), wall.start.max(wall.end));
            for row in rows[0]..=rows[1] {
                for column in columns[0]..=columns[1] {
                    #[expect(clippy::cast_possible_truncation, reason = "fewer than 4e9 walls")]
                    index.cells[row * index.columns + column].push(number as u32);
                }
            }
        }
        index
    }

    pub(crate) fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// Columns and rows of a box, clamped to the index.
    fn cells_of(&self, low: DVec2, high: DVec2) -> [[usize; 2]; 2] {
        let range = |low: f64, high: f64, count: usize| {
            [low, high].map(|value| cell_number(value, self.cell_m).min(count - 1))
        };
        let (low, high) = (low - self.low, high - self.low);
        [range(low.x, high.x, self.columns), range(low.y, high.y, self.rows)]
    }

    /// Calls `visit` with each wall that may touch a box; a wall may come more than once.
    fn visit(&self, low: DVec2, high: DVec2, mut visit: impl FnMut(u32) -> bool) {
        if self.walls.is_empty() {
            return;
        }
        let [columns, rows] = self.cells_of(low, high);
        for row in rows[0]..=rows[1] {
            for column in columns[0]..=columns[1] {
                for &wall in &self.cells[row * self.columns + column] {
                    if !visit(wall) {
                        return;
                    }
                }
            }
        }
    }

    /// Collects the numbers of the walls within a distance of a point, in ascending order.
    pub(crate) fn near(&self, point: DVec2, range_m: f64, found: &mut Vec<u32>) {
        found.clear();
        self.visit(point - range_m, point + range_m, |number| {
            let nearest = self.walls[number as usize].nearest_point(point);
            if nearest.distance_squared(point) <= range_m * range_m {
                found.push(number);
            }
            true
        });
        found.sort_unstable();
        found.dedup();
    }

    /// True where a wall is between two points.
    pub(crate) fn blocks(&self, from: DVec2, to: DVec2) -> bool {
        let mut is_blocked = false;
        self.visit(from.min(to), from.max(to), |number| {
            is_blocked = self.walls[number as usize].crosses(from, to);
            !is_blocked
        });
        is_blocked
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped at zero")]
fn cell_number(offset_m: f64, cell_m: f64) -> usize {
    (offset_m / cell_m).max(0.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_is_on_the_wall_or_at_its_end() {
        let wall = Wall::new([0.0, 0.0], [4.0, 0.0]);
        let check = |point: [f64; 2], nearest: [f64; 2]| {
            assert_eq!(wall.nearest_point(point.into()), nearest.into());
        };
        check([1.0, 3.0], [1.0, 0.0]);
        check([-2.0, 1.0], [0.0, 0.0]);
        check([9.0, -1.0], [4.0, 0.0]);
        assert_eq!(Wall::new([1.0, 1.0], [1.0, 1.0]).nearest_point(DVec2::ZERO), DVec2::ONE);
    }

    #[test]
    fn a_line_crosses_a_wall_or_passes_beside_it() {
        let wall = Wall::new([0.0, -1.0], [0.0, 1.0]);
        let check = |from: [f64; 2], to: [f64; 2], crosses| {
            assert_eq!(wall.crosses(from.into(), to.into()), crosses, "{from:?} {to:?}");
        };
        check([-1.0, 0.0], [1.0, 0.0], true);
        check([-1.0, 0.0], [-0.1, 0.0], false);
        check([-1.0, 2.0], [1.0, 2.0], false);
        check([-1.0, 1.0], [1.0, 1.0], true);
    }

    #[test]
    fn the_index_finds_what_a_loop_over_all_walls_finds() {
        let mut stream = periplus_geometry::Stream::keyed(3, "walls", 0);
        let mut point = || DVec2::new(stream.unit() * 20.0 - 3.0, stream.unit() * 9.0);
        let walls: Vec<Wall> = (0..60)
            .map(|_| {
                let start = point();
                Wall { start, end: start + (point() - start) * 0.2 }
            })
            .collect();
        let index = WallIndex::new(walls.clone());
        let mut found = Vec::new();
        for _ in 0..200 {
            let (from, to) = (point(), point());
            index.near(from, 1.7, &mut found);
            let is_near = |wall: &Wall| wall.nearest_point(from).distance(from) <= 1.7;
            let expected: Vec<u32> = (0..60).filter(|i| is_near(&walls[*i as usize])).collect();
            assert_eq!(found, expected);
            assert_eq!(index.blocks(from, to), walls.iter().any(|wall| wall.crosses(from, to)));
        }
    }
}
