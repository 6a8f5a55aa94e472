//! Search for agents near a point, by a uniform grid: linear in the number of agents.

use glam::DVec2;

/// Agents sorted by the cell that contains them.
#[derive(Clone, Debug, Default)]
pub(crate) struct AgentIndex {
    low: DVec2,
    cell_m: DVec2,
    columns: usize,
    rows: usize,
    /// Length along x after which the floor repeats \[m\].
    period_m: Option<f64>,
    /// First entry of each cell in `agents`, and the end.
    starts: Vec<u32>,
    agents: Vec<u32>,
}

impl AgentIndex {
    /// Sorts positions into cells that are about as large as the range of the queries.
    pub(crate) fn build(&mut self, positions: &[DVec2], range_m: f64, period_m: Option<f64>) {
        let (mut low, mut high) = (DVec2::splat(f64::INFINITY), DVec2::splat(f64::NEG_INFINITY));
        for &position in positions {
            low = low.min(position);
            high = high.max(position);
        }
        if positions.is_empty() {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        if let Some(period_m) = period_m {
            (low.x, high.x) = (0.0, period_m);
        }
        // No more cells than a few per agent, however far the agents are apart.
        #[expect(clippy::cast_precision_loss, reason = "numbers of agents are small")]
        let longest = 8.0 * (positions.len() as f64).sqrt() + 8.0;
        let size = high - low;
        let cells = (size / range_m).floor().clamp(DVec2::ONE, DVec2::splat(longest));
        self.low = low;
        self.cell_m = (size / cells).max(DVec2::splat(1e-9));
        self.period_m = period_m;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped above"
        )]
        {
            self.columns = cells.x as usize;
            self.rows = cells.y as usize;
        }
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &position in positions {
            let cell = self.cell_of(position);
            self.starts[cell + 1] += 1;
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        let mut next = self.starts.clone();
        self.agents.clear();
        self.agents.resize(positions.len(), 0);
        for (number, &position) in positions.iter().enumerate() {
            let cell = self.cell_of(position);
            #[expect(clippy::cast_possible_truncation, reason = "fewer than 4e9 agents")]
            let number = number as u32;
            self.agents[next[cell] as usize] = number;
            next[cell] += 1;
        }
    }

    fn cell_of(&self, position: DVec2) -> usize {
        let [column, row] = self.column_and_row(position);
        row * self.columns + column
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped at zero")]
    fn column_and_row(&self, position: DVec2) -> [usize; 2] {
        let at = (position - self.low) / self.cell_m;
        [
            (at.x.max(0.0) as usize).min(self.columns - 1),
            (at.y.max(0.0) as usize).min(self.rows - 1),
        ]
    }

    /// Collects agents within a range of a point, with the vectors to them, in the order of their numbers. Those of a
    /// repeated floor are seen where they are nearest.
    pub(crate) fn near(
        &self,
        point: DVec2,
        range_m: f64,
        positions: &[DVec2],
        found: &mut Vec<(u32, DVec2)>,
    ) {
        found.clear();
        let low = self.column_and_row(point - range_m);
        let high = self.column_and_row(point + range_m);
        let columns = if self.period_m.is_some() {
            // The neighbours on the other side of the seam are in the first or the last columns.
            [0, self.columns - 1]
        } else {
            [low[0], high[0]]
        };
        for row in low[1]..=high[1] {
            let cells = row * self.columns + columns[0]..=row * self.columns + columns[1];
            let agents =
                self.starts[*cells.start()] as usize..self.starts[cells.end() + 1] as usize;
            for &agent in &self.agents[agents] {
                let offset = nearest_image(positions[agent as usize] - point, self.period_m);
                if offset.length_squared() <= range_m * range_m {
                    found.push((agent, offset));
                }
            }
        }
        found.sort_unstable_by_key(|(agent, _)| *agent);
    }
}

/// Returns the shortest of the vectors that differ by whole periods along x.
pub(crate) fn nearest_image(mut offset: DVec2, period_m: Option<f64>) -> DVec2 {
    if let Some(period_m) = period_m {
        offset.x -= (offset.x / period_m).round() * period_m;
    }
    offset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_index_finds_what_a_loop_over_all_agents_finds() {
        let mut stream = periplus_geometry::Stream::keyed(5, "agents", 0);
        for (count, period_m) in [(0, None), (1, None), (80, None), (80, Some(12.0))] {
            let positions: Vec<DVec2> = (0..count)
                .map(|_| DVec2::new(stream.unit() * 12.0, stream.unit() * 7.0 - 3.0))
                .collect();
            let mut index = AgentIndex::default();
            index.build(&positions, 1.5, period_m);
            let mut found = Vec::new();
            for _ in 0..50 {
                let point = DVec2::new(stream.unit() * 12.0, stream.unit() * 7.0 - 3.0);
                index.near(point, 1.5, &positions, &mut found);
                let expected: Vec<u32> = (0..count)
                    .filter(|agent| {
                        let offset = positions[*agent as usize] - point;
                        nearest_image(offset, period_m).length() <= 1.5
                    })
                    .collect();
                let numbers: Vec<u32> = found.iter().map(|(agent, _)| *agent).collect();
                assert_eq!(numbers, expected);
            }
        }
    }

    #[test]
    fn the_nearest_image_is_across_the_seam() {
        assert_eq!(nearest_image(DVec2::new(9.0, 1.0), Some(10.0)), DVec2::new(-1.0, 1.0));
        assert_eq!(nearest_image(DVec2::new(9.0, 1.0), None), DVec2::new(9.0, 1.0));
    }
}
