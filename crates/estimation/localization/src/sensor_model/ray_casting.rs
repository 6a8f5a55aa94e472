//! Expected ranges of the beam model by sphere tracing.
//!
//! Source: Hart, "Sphere tracing" (1996), on a grid.

use periplus_grid::squared_distances;

use crate::likelihood_map::{CellState, CellTransform, LikelihoodMap};

/// Distances to the cells that block beams: occupied, unknown, and everything outside of the map.
#[derive(Clone, Debug)]
pub(crate) struct RayCaster {
    cell_transform: CellTransform,
    width: usize,
    height: usize,
    cell_m: f64,
    /// Distance between cell centers \[cells\].
    distances_cells: Vec<f32>,
}

impl RayCaster {
    pub(crate) fn new(map: &LikelihoodMap) -> Self {
        let info = map.info();
        let blocks = map.states().map(|state| *state != CellState::Free);
        let distances = squared_distances(&blocks, |&blocks| blocks);
        Self {
            cell_transform: map.cell_transform(),
            width: info.width,
            height: info.height,
            cell_m: info.resolution_m,
            distances_cells: distances
                .cells
                .iter()
                .map(|&squared| (squared as f32).sqrt())
                .collect(),
        }
    }

    /// Casts a ray from a point of the map along a direction; returns the range \[m\], at most
    /// `range_max_m`.
    pub(crate) fn cast_m(&self, (x_m, y_m): (f64, f64), bearing_rad: f64, range_max_m: f64) -> f64 {
        let (mut u, mut v) = self.cell_transform.map_to_cells(x_m, y_m);
        let (along, across) = self.cell_transform.direction(bearing_rad);
        let (along, across) = (along * self.cell_m, across * self.cell_m);
        let reach = range_max_m / self.cell_m;
        let (width, height) = (self.width as f64, self.height as f64);
        let mut range = 0.0;
        while range < reach {
            let is_inside = u >= 0.0 && v >= 0.0 && u < width && v < height;
            if !is_inside {
                return self.cell_m * range;
            }
            let distance = f64::from(self.distances_cells[v as usize * self.width + u as usize]);
            if distance <= 0.0 {
                return self.cell_m * range;
            }
            // From any point in this cell to any point in that one.
            let step = (distance - std::f64::consts::SQRT_2).max(0.5);
            range += step;
            (u, v) = (u + along * step, v + across * step);
        }
        range_max_m
    }
}
