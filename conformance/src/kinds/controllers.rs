//! Controllers, and checkers of goal and progress.

mod checkers;
mod dwb;
mod graceful;
mod pure_pursuit;

pub(super) use checkers::{check_goal, check_progress};
pub(super) use dwb::{check_critic, check_samples, check_trajectory};
pub(super) use graceful::check_law;
pub(super) use pure_pursuit::{check_lookahead, check_regulation, check_rotation};

use periplus_costmap::{Costmap, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2};
use periplus_grid::GridInfo;
use periplus_params::{Given, ParamValues, Table};

use crate::{CaseReader, Unreadable};

/// The release of Nav2 that a distribution has.
fn release_of(distro: &str) -> Result<Nav2Release, Unreadable> {
    distro.parse().map_err(|why| Unreadable(format!("`distro`: {why}")))
}

/// A pose `[x, y, yaw]`.
fn pose(reader: &CaseReader<'_>) -> Result<Pose2, Unreadable> {
    let [x_m, y_m, yaw_rad] = reader.array()?;
    Ok(Pose2::new(x_m, y_m, yaw_rad))
}

/// A velocity `[vx, vy, wz]`.
fn velocity(reader: &CaseReader<'_>) -> Result<Twist2, Unreadable> {
    let [vx_m_s, vy_m_s, wz_rad_s] = reader.array()?;
    Ok(Twist2::new(vx_m_s, vy_m_s, wz_rad_s))
}

/// A path of points `[x, y]`.
fn path(reader: &CaseReader<'_>) -> Result<Vec<Pose2>, Unreadable> {
    reader.each(|point| {
        let [x_m, y_m] = point.array()?;
        Ok(Pose2::new(x_m, y_m, 0.0))
    })
}

/// A grid that is described by `size`, `resolution`, `origin`, a default cost and cells `[x, y, cost]`.
fn costmap(reader: &CaseReader<'_>) -> Result<Costmap, Unreadable> {
    let (width, height) = reader.get("size")?.cell()?;
    let [x_m, y_m] = reader.get("origin")?.array()?;
    let resolution_m = reader.get("resolution")?.number()?;
    let info = GridInfo::new(resolution_m, width, height, Pose2::new(x_m, y_m, 0.0))
        .map_err(|error| reader.unreadable(&error.to_string()))?;
    let mut costmap = Costmap::new(info, reader.get("default_cost")?.byte()?);
    for cell in reader.get("cells")?.list()? {
        let [column, row, cost] = cell.list()?.try_into().map_err(|_| cell.unreadable("a cell"))?;
        costmap.set((column.count()?, row.count()?), cost.byte()?);
    }
    Ok(costmap)
}

/// Parameters of a table among the members of an object. Members that belong to one of the `others` are skipped.
fn values_of(
    table: &'static Table,
    others: &[&'static Table],
    params: &CaseReader<'_>,
) -> Result<ParamValues, Unreadable> {
    let mut given: Vec<(&str, String)> = Vec::new();
    for (name, value) in params.members()? {
        if table.find(name).is_some() {
            given.push((name, value.written()));
        } else if others.iter().any(|other| other.find(name).is_some()) {
            value.skip();
        } else {
            return Err(value.unreadable(&format!("a parameter of {}", table.name)));
        }
    }
    let mut diagnostics = Diagnostics::new();
    let given = given.iter().map(|(name, text)| Given::new(name, text.as_str()));
    let values = table.check_given(given, &mut diagnostics);
    match diagnostics.iter().next() {
        Some(wrong) => Err(params.unreadable(&wrong.message)),
        None => Ok(values),
    }
}
