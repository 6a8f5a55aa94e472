//! Frontiers between free and unknown space.

use std::collections::BTreeSet;

use crate::reach::{Reach, neighbours};

/// A frontier: a connected set of free cells beside unknown ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Frontier {
    /// Cell with the lowest cost.
    pub cell: usize,
    /// Position of the cell \[m\].
    pub place_m: [f64; 2],
    /// Cost of the path to it \[m\].
    pub cost_m: f64,
    /// Length of the frontier \[m\].
    pub length_m: f64,
    /// All its cells, in ascending order.
    pub cells: Vec<usize>,
}

/// Returns all reachable frontiers of at least a minimum length \[m\], ordered by cell.
#[must_use]
pub fn frontiers(reach: &Reach<'_>, shortest_m: f64) -> Vec<Frontier> {
    let map = reach.map();
    let info = map.info;
    let touches =
        |index: usize| neighbours(map, info.cell(index)).any(|(next, _)| map.cells[next] < 0);
    let mut open: BTreeSet<usize> =
        (0..info.len()).filter(|index| reach.cost(*index).is_some() && touches(*index)).collect();
    let mut found = Vec::new();
    while let Some(first) = open.pop_first() {
        let (mut group, mut waiting) = (Vec::new(), vec![first]);
        while let Some(cell) = waiting.pop() {
            group.push(cell);
            for (next, _) in neighbours(map, info.cell(cell)) {
                if open.remove(&next) {
                    waiting.push(next);
                }
            }
        }
        let length_m = group.len() as f64 * info.resolution_m;
        if length_m < shortest_m {
            continue;
        }
        let cost = |cell: &usize| reach.cost(*cell).unwrap_or(f64::INFINITY);
        group.sort_unstable();
        let nearest =
            group.iter().copied().min_by(|a, b| cost(a).total_cmp(&cost(b)).then(a.cmp(b)));
        let Some(cell) = nearest else { continue };
        let (x_m, y_m) = info.centre_of(info.cell(cell));
        let (place_m, cost_m) = ([x_m, y_m], cost(&cell));
        found.push(Frontier { cell, place_m, cost_m, length_m, cells: group });
    }
    found
}
