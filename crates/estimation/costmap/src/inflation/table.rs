//! Cost by distance.

use crate::Nav2Release;
use crate::cost::{INSCRIBED, LETHAL};

/// Steps per cell to which distances are rounded on main.
const STEPS_PER_CELL: f64 = 100.0;

/// Maximum radius of a table; larger radii are limited \[cells\].
const MAX_RADIUS_CELLS: u32 = 2000;

/// Costs by squared distance \[cells²\]: integers, which makes every distance an index.
#[derive(Clone, Debug, PartialEq)]
pub struct CostTable {
    costs: Vec<u8>,
    radius_cells: u32,
}

impl CostTable {
    /// Creates a table: lethal at 0, inscribed up to `inscribed_radius_m`, and decreasing beyond
    /// with `exp(-cost_scaling_factor * d)`. The last cells with a cost are at the radius, rounded
    /// up to whole cells.
    /// Source: `InflationLayer::computeCost`, `Costmap2D::cellDistance`.
    #[must_use]
    pub fn new(
        resolution_m: f64,
        inflation_radius_m: f64,
        inscribed_radius_m: f64,
        cost_scaling_factor: f64,
        compat: Nav2Release,
    ) -> Self {
        let cells = libm::ceil(inflation_radius_m / resolution_m);
        let radius_cells = if cells > 0.0 { (cells as u32).min(MAX_RADIUS_CELLS) } else { 0 };
        let cost = |square: u32| {
            let mut distance = f64::from(square).sqrt();
            if compat.rounds_distances() {
                distance = libm::floor(distance * STEPS_PER_CELL + 0.5) / STEPS_PER_CELL;
            }
            let distance_m = distance * resolution_m;
            if square == 0 {
                LETHAL
            } else if distance_m <= inscribed_radius_m {
                INSCRIBED
            } else {
                let beyond_m = distance_m - inscribed_radius_m;
                (f64::from(INSCRIBED - 1) * libm::exp(-cost_scaling_factor * beyond_m)) as u8
            }
        };
        Self { costs: (0..=radius_cells * radius_cells).map(cost).collect(), radius_cells }
    }

    /// Returns the cost at a squared distance \[cells²\].
    #[must_use]
    pub fn cost(&self, squared_cells: u32) -> u8 {
        self.costs.get(squared_cells as usize).copied().unwrap_or(0)
    }

    /// Returns all costs, by squared distance \[cells²\].
    #[must_use]
    pub fn costs(&self) -> &[u8] {
        &self.costs
    }

    /// Returns the radius of the costs \[cells\].
    #[must_use]
    pub fn radius_cells(&self) -> u32 {
        self.radius_cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_fall_from_lethal_to_nothing() {
        let table = CostTable::new(0.05, 0.55, 0.195, 3.0, Nav2Release::Main);
        assert_eq!(table.radius_cells(), 11);
        let along = [0, 1, 3, 4, 5, 11, 12].map(|cells: u32| table.cost(cells * cells));
        assert_eq!(along, [254, 253, 253, 248, 213, 86, 0]);
    }

    #[test]
    fn distances_are_rounded_on_main_alone() {
        let cost = |compat| CostTable::new(1.0, 3.0, 1.0, 1.0, compat).cost(2);
        assert_eq!((cost(Nav2Release::Main), cost(Nav2Release::Jazzy)), (167, 166));
    }
}
