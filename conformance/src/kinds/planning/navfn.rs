//! NavFn and the coordinates of planners.

use periplus_costmap::{Costmap, CostmapView, Footprint};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_planners::{
    NavFnPlanner, PlanRequest, Planner, navfn_cell_of, navfn_point_of, tables,
};
use serde_json::{Value, json};

use super::super::Setting;
use super::{point, values_of};
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

/// Potential of a cell that was not reached.
const UNREACHED_COST: f64 = 1.0e10;

/// The costmap of a case: a default cost, and rectangles of cells, the later ones over the earlier.
fn costmap(given: &CaseReader<'_>) -> Result<Costmap, Unreadable> {
    let (width, height) = given.get("size")?.cell()?;
    let resolution = given.get("resolution")?;
    let [x_m, y_m] = given.get("origin")?.array()?;
    let info = GridInfo::new(resolution.number()?, width, height, Pose2::new(x_m, y_m, 0.0))
        .map_err(|error| resolution.unreadable(&error.to_string()))?;
    let mut costmap = Costmap::new(info, given.get("default_cost")?.byte()?);
    for rectangle in given.get("rectangles")?.list()? {
        let corners = rectangle.each(CaseReader::count)?;
        let [x0, y0, x1, y1, cost] = corners[..] else {
            return Err(rectangle.unreadable("x0, y0, x1, y1, cost"));
        };
        let cost = u8::try_from(cost).map_err(|_| rectangle.unreadable("a cost up to 255"))?;
        for cell in (y0..=y1).flat_map(|y| (x0..=x1).map(move |x| (x, y))) {
            costmap.set(cell, cost);
        }
    }
    Ok(costmap)
}

/// Path and potentials of a plan.
pub(in crate::kinds) fn check_navfn(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let (costs, footprint) = (costmap(&given)?, Footprint::circle(0.1));
    let costmap = CostmapView {
        costs: &costs,
        footprint: &footprint,
        is_circular: true,
        tracks_unknown: true,
        inflation: None,
    };
    let names = ["tolerance", "allow_unknown", "use_astar"];
    let mut planner = NavFnPlanner::new(values_of(&tables::NAVFN, &given, &names)?);
    let (start, goal) = (point(&given.get("start")?)?, point(&given.get("goal")?)?);
    let (is_cancelled, is_out_of_time) = (&mut || false, &mut || false);
    let plan =
        planner.plan(PlanRequest { costmap, start, goal, is_cancelled, is_out_of_time }).ok();
    let end = plan.as_ref().and_then(|plan| plan.poses.last());
    let potentials = given.get("probe_cells")?.each(|probe| {
        let (column, row) = probe.cell()?;
        let potential = planner.potentials().potential((column, row));
        Ok(json!([column, row, number(potential.map_or(UNREACHED_COST, f64::from))]))
    })?;
    differences.compare_members(
        &[
            (&["found"], json!(plan.is_some())),
            (&["end"], numbers(end.into_iter().flat_map(|pose| [pose.x_m, pose.y_m]))),
            (&["path_length"], number(plan.as_ref().map_or(0.0, |plan| plan.length_m()))),
            (&["potentials"], Value::Array(potentials)),
        ],
        &expect,
    );
    Ok(())
}

/// The cell of a point, and the point at which the planner assumes that cell.
pub(in crate::kinds) fn check_grid_coords(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let at = point(&given.get("world")?)?;
    let resolution = given.get("resolution")?;
    let origin = point(&given.get("origin")?)?;
    // Large enough for the point; the case has no size.
    let count = |length_m: f64, resolution_m: f64| (length_m / resolution_m).max(0.0) as usize + 2;
    let resolution_m = resolution.number()?;
    let width = count(at.x_m - origin.x_m, resolution_m);
    let height = count(at.y_m - origin.y_m, resolution_m);
    let info = GridInfo::new(resolution_m, width, height, origin)
        .map_err(|error| resolution.unreadable(&error.to_string()))?;
    let planner = given.get("planner")?;
    let (cell, in_world) = match planner.text()? {
        "navfn" => {
            let cell = navfn_cell_of(&info, at.x_m, at.y_m);
            let point = cell.map(|(x, y)| navfn_point_of(&info, x as f64, y as f64));
            (cell, point)
        }
        // All other planners use the cells of the costmap.
        "theta_star" => {
            let cell = info.cell_of(at.x_m, at.y_m);
            (cell, cell.map(|cell| info.centre_of(cell)))
        }
        _ => return Err(planner.unreadable("navfn or theta_star")),
    };
    differences.compare_members(
        &[
            (&["cell"], cell.map_or(json!([]), |(x, y)| json!([x, y]))),
            (&["cell_in_world"], in_world.map_or(json!([]), |(x, y)| numbers([x, y]))),
        ],
        &expect,
    );
    Ok(())
}
