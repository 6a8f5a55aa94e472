//! Layers and sources that are responsible for the cost of a cell.

use periplus_costmap::cost::{INSCRIBED, LETHAL, UNKNOWN};
use periplus_costmap::{CellReport, CellWindow, Explanation, LayeredCostmap};
use periplus_grid::Cell;

/// Returns the layer that gave a cell its cost and, if it is known, the source that marked it; for a cell near
/// an obstacle those of the obstacle. None outside the costmap.
#[must_use]
pub fn blame(costmap: &LayeredCostmap, cell: Cell) -> Option<String> {
    let report = costmap.inspect(cell)?;
    let own = responsible(&report);
    if report.cost == LETHAL || report.cost == UNKNOWN {
        return Some(own.unwrap_or_else(|| unknown(&report)));
    }
    let Some((obstacle, distance_m)) = nearest_obstacle(costmap, cell) else { return own };
    let obstacle_report = costmap.inspect(obstacle)?;
    let (x_m, y_m) = obstacle_report.centre_m;
    let by = responsible(&obstacle_report).unwrap_or_else(|| unknown(&obstacle_report));
    Some(format!("the obstacle at ({x_m:.2}, {y_m:.2}), {distance_m:.2} m away, is from {by}"))
}

fn unknown(report: &CellReport) -> String {
    match report.cost {
        UNKNOWN => "no layer: nothing has observed the cell".to_owned(),
        _ => "no layer that remembers it".to_owned(),
    }
}

/// Returns the lowest layer that gave the cell its cost, or at least an inscribed one. An inflation layer above
/// repeats the cost of an obstacle.
fn responsible(report: &CellReport) -> Option<String> {
    let enabled = || report.layers.iter().filter(|layer| layer.is_enabled);
    let exact = enabled().find(|layer| layer.explanation.value == Some(report.cost));
    let blocks = |layer: &&periplus_costmap::LayerReport| {
        layer.explanation.value.is_some_and(|value| (INSCRIBED..UNKNOWN).contains(&value))
    };
    let layer = exact.or_else(|| enabled().find(blocks))?;
    Some(format!("layer `{}`{}", layer.name, reason(&layer.explanation)))
}

fn reason(explanation: &Explanation) -> String {
    if let Some(cause) = explanation.cause.as_ref().filter(|cause| cause.is_mark) {
        let [x_m, y_m] = cause.end;
        return format!(
            ", marked by `{}` at {:.1} s (point ({x_m:.2}, {y_m:.2}))",
            cause.source,
            cause.time_ns as f64 / 1e9
        );
    }
    let within = explanation.within.iter().find(|(_, part)| part.value == explanation.value);
    if let Some((name, part)) = within {
        return format!(", in it `{name}`{}", reason(part));
    }
    explanation.reason.as_ref().map(|reason| format!(": {reason}")).unwrap_or_default()
}

/// Returns the nearest lethal cell within the circumscribed radius of the robot, and its distance \[m\].
fn nearest_obstacle(costmap: &LayeredCostmap, (column, row): Cell) -> Option<(Cell, f64)> {
    let (grid, radius_m) = (costmap.costmap(), costmap.footprint().circumscribed_radius_m);
    let window = CellWindow { x0: column, y0: row, xn: column + 1, yn: row + 1 };
    let window = window.grown(grid.cells_along(radius_m) as usize + 1, grid.info());
    let distance_m = |(x, y): Cell| {
        libm::hypot(x.abs_diff(column) as f64, y.abs_diff(row) as f64) * grid.resolution_m()
    };
    (window.y0..window.yn)
        .flat_map(|y| (window.x0..window.xn).map(move |x| (x, y)))
        .filter(|cell| grid.cost(*cell) == Some(LETHAL))
        .map(|cell| (cell, distance_m(cell)))
        .min_by(|(_, left_m), (_, right_m)| left_m.total_cmp(right_m))
}
