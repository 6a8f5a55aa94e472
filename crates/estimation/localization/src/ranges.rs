//! What beams should measure, by steps as long as nothing is in the way.
//!
//! Source: Hart, "Sphere tracing" (1996), on a grid.

use periplus_grid::squared_distances;

use crate::known_map::{CellState, Finder, KnownMap};

/// Distances to what stops beams: walls and what is unknown; outside of the map all is unknown.
#[derive(Clone, Debug)]
pub(crate) struct Ranges {
    finder: Finder,
    width: usize,
    height: usize,
    cell_m: f64,
    /// In cells, from middle to middle.
    distances: Vec<f32>,
}

impl Ranges {
    pub(crate) fn new(map: &KnownMap) -> Self {
        let lattice = map.lattice();
        let stops = map.states().map(|state| *state != CellState::Free);
        let distances = squared_distances(&stops, |&stops| stops);
        Self {
            finder: map.finder(),
            width: lattice.width,
            height: lattice.height,
            cell_m: lattice.resolution_m,
            distances: distances.cells.iter().map(|&squared| (squared as f32).sqrt()).collect(),
        }
    }

    /// How far it is from a point of the map along a direction to what stops beams, no more than
    /// `range_max_m` \[m\].
    pub(crate) fn range_m(
        &self,
        (x_m, y_m): (f64, f64),
        bearing_rad: f64,
        range_max_m: f64,
    ) -> f64 {
        let (mut u, mut v) = self.finder.cells_to(x_m, y_m);
        let (along, across) = self.finder.heading(bearing_rad);
        let (along, across) = (along * self.cell_m, across * self.cell_m);
        let reach = range_max_m / self.cell_m;
        let (width, height) = (self.width as f64, self.height as f64);
        let mut range = 0.0;
        while range < reach {
            let is_inside = u >= 0.0 && v >= 0.0 && u < width && v < height;
            if !is_inside {
                return self.cell_m * range;
            }
            let distance = f64::from(self.distances[v as usize * self.width + u as usize]);
            if distance <= 0.0 {
                return self.cell_m * range;
            }
            // From anywhere in this cell to anywhere in that one.
            let step = (distance - std::f64::consts::SQRT_2).max(0.5);
            range += step;
            (u, v) = (u + along * step, v + across * step);
        }
        range_max_m
    }
}
