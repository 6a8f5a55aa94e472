//! Costmaps: layers, filters, and what is around them.

mod filters;
mod footprints;
mod layers;
mod sensing;
mod stack;
mod values;
mod voxels;
mod wire;

pub(super) use filters::{check_binary, check_keepout, check_speed};
pub(super) use footprints::{check_cost as check_footprint_cost, check_footprint};
pub(super) use layers::{check_clear_area, check_clear_service, check_denoise, check_parameters};
pub(super) use sensing::{check_buffer, check_projection, check_range_model};
pub(super) use stack::{check_layered, check_obstacle};
pub(super) use values::{check_inflation, check_static, check_to_cost, check_to_occupancy};
pub(super) use voxels::check as check_voxels;
pub(super) use wire::check as check_publisher;

use periplus_costmap::{CellWindow, Costmap, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose2;
use periplus_grid::{GridInfo, OccupancyGrid};
use periplus_params::{Given, ParamValues, Table};
use serde_json::Value;

use crate::{CaseReader, Unreadable};

/// The release of Nav2 that a distribution has.
fn compat_of(distro: &str) -> Result<Nav2Release, Unreadable> {
    distro.parse().map_err(|why| Unreadable(format!("`applies_to`: {why}")))
}

/// Parameters of a table from the members of an object.
///
/// # Errors
/// When a member is not a parameter of this table or one of the `others`, or its value does not fit.
fn values_of(
    table: &'static Table,
    others: &[&'static Table],
    params: Option<&CaseReader<'_>>,
) -> Result<ParamValues, Unreadable> {
    let mut given: Vec<(&str, String)> = Vec::new();
    if let Some(params) = params {
        for (name, value) in params.members()? {
            if table.find(name).is_some() {
                given.push((name, value.written()));
            } else if !others.iter().any(|other| other.find(name).is_some()) {
                let known: Vec<&str> = table.parameters.iter().map(|it| it.name).collect();
                let known = known.join(", ");
                return Err(value.unreadable(&format!("a parameter of {}: {known}", table.name)));
            }
        }
    }
    let mut diagnostics = Diagnostics::new();
    let given = given.iter().map(|(name, text)| Given::new(name, text.as_str()));
    // What is missing has a default; what is given must fit.
    let values = table.check_given(given, &mut diagnostics);
    match (diagnostics.iter().next(), params) {
        (Some(wrong), Some(params)) => Err(params.unreadable(&wrong.message)),
        _ => Ok(values),
    }
}

/// The parameters of a table among the members of an object that holds other things as well.
fn values_among(table: &'static Table, given: &CaseReader<'_>) -> Result<ParamValues, Unreadable> {
    let mut diagnostics = Diagnostics::new();
    let mut found: Vec<(&str, String)> = Vec::new();
    for parameter in table.parameters {
        if let Some(value) = given.find(parameter.name) {
            found.push((parameter.name, value.written()));
        }
    }
    let found = found.iter().map(|(name, text)| Given::new(name, text.as_str()));
    let values = table.check_given(found, &mut diagnostics);
    match diagnostics.iter().next() {
        Some(wrong) => Err(given.unreadable(&wrong.message)),
        None => Ok(values),
    }
}

/// The costs of a grid as rows, the lowest first.
fn rows_of(costmap: &Costmap) -> Value {
    let width = costmap.info().width.max(1);
    costmap.costs().chunks(width).map(|row| Value::from(row.to_vec())).collect()
}

/// Number of cells of each cost.
fn counts_of(costmap: &Costmap) -> Value {
    let mut counts = [0_u64; 256];
    for cost in costmap.costs() {
        counts[usize::from(*cost)] += 1;
    }
    let named = counts.iter().enumerate().map(|(cost, count)| (cost.to_string(), (*count).into()));
    Value::Object(named.collect())
}

/// The cells of a grid for which something holds, as pairs, or with their cost.
fn cells_where(costmap: &Costmap, with_cost: bool, holds: impl Fn(u8) -> bool) -> Vec<Value> {
    let listed = costmap.costs().iter().enumerate().filter(|(_, cost)| holds(**cost));
    let listed = listed.map(|(index, cost)| {
        let (x, y) = costmap.info().cell(index);
        if with_cost {
            Value::from(vec![x, y, usize::from(*cost)])
        } else {
            Value::from(vec![x, y])
        }
    });
    listed.collect()
}

/// A cell written `x,y`.
fn cell_named(text: &str) -> Option<(usize, usize)> {
    let (x, y) = text.split_once(',')?;
    Some((x.trim().parse().ok()?, y.trim().parse().ok()?))
}

/// A truth value that may be left out.
fn truth(reader: &CaseReader<'_>, name: &str, usual: bool) -> Result<bool, Unreadable> {
    reader.find(name).map_or(Ok(usual), |it| it.truth())
}

/// A number that may be left out.
fn number(reader: &CaseReader<'_>, name: &str, usual: f64) -> Result<f64, Unreadable> {
    reader.find(name).map_or(Ok(usual), |it| it.number())
}

/// A grid that is described by `size`, `resolution`, `origin` and a first value.
fn costmap_of(reader: &CaseReader<'_>, first: &str) -> Result<Costmap, Unreadable> {
    let (width, height) = reader.get("size")?.cell()?;
    let [x_m, y_m] = reader.find("origin").map_or(Ok([0.0, 0.0]), |it| it.array())?;
    let origin = Pose2::new(x_m, y_m, 0.0);
    let info = GridInfo::new(number(reader, "resolution", 1.0)?, width, height, origin)
        .map_err(|error| reader.unreadable(&error.to_string()))?;
    let default = reader.find(first).map_or(Ok(0), |it| it.byte())?;
    Ok(Costmap::new(info, default))
}

/// A map that is described by `width`, `height`, `resolution`, an origin, and values.
fn map_of(reader: &CaseReader<'_>) -> Result<OccupancyGrid, Unreadable> {
    let (width, height) = (reader.get("width")?.count()?, reader.get("height")?.count()?);
    let [x_m, y_m] = match reader.find("origin") {
        Some(origin) => match *origin.numbers()?.as_slice() {
            [x_m, y_m, ..] => [x_m, y_m],
            _ => return Err(origin.unreadable("two numbers")),
        },
        None => [number(reader, "origin_x", 0.0)?, number(reader, "origin_y", 0.0)?],
    };
    let yaw_rad = number(reader, "origin_yaw", 0.0)?;
    let origin = Pose2::new(x_m, y_m, yaw_rad);
    let info = GridInfo::new(number(reader, "resolution", 1.0)?, width, height, origin)
        .map_err(|error| reader.unreadable(&error.to_string()))?;
    let occupancy = |it: &CaseReader<'_>| {
        i8::try_from(it.integer()?).map_err(|_| it.unreadable("a number from -128 to 127"))
    };
    let cells = if let Some(data) = reader.find("data") {
        data.each(occupancy)?
    } else if let Some(fill) = reader.find("fill") {
        vec![occupancy(&fill)?; info.len()]
    } else {
        let formula = reader.get("value_formula")?;
        by_formula(&formula, &info)?
    };
    OccupancyGrid::from_cells(info, cells)
        .map_err(|cells| reader.unreadable(&format!("a map; it has {} cells", cells.len())))
}

/// Cells by a formula such as `x + (y-1)*10 + 1 for y>=1`, 0 where it does not hold.
fn by_formula(formula: &CaseReader<'_>, info: &GridInfo) -> Result<Vec<i8>, Unreadable> {
    let known = formula.text()?.replace(' ', "");
    let width = info.width as i64;
    let value = |x: i64, y: i64| match known.as_str() {
        "x+(y-1)*10+1fory>=1" => Ok(if y >= 1 { x + (y - 1) * 10 + 1 } else { 0 }),
        "x+y*width+1" | "1+x+y*width" => Ok(x + y * width + 1),
        "x+y*width" => Ok(x + y * width),
        _ => Err(formula.unreadable("a formula that is known")),
    };
    let cells = (0..info.len()).map(|index| {
        let (x, y) = info.cell(index);
        let value = value(x as i64, y as i64)?;
        i8::try_from(value).map_err(|_| formula.unreadable("a formula with numbers below 128"))
    });
    cells.collect()
}

/// Four numbers as a window.
fn window_of(reader: &CaseReader<'_>) -> Result<CellWindow, Unreadable> {
    match *reader.each(CaseReader::count)?.as_slice() {
        [x0, y0, xn, yn] => Ok(CellWindow { x0, y0, xn, yn }),
        _ => Err(reader.unreadable("four counts")),
    }
}

/// Pose in the plane; the yaw is optional.
fn pose_of(reader: &CaseReader<'_>) -> Result<Pose2, Unreadable> {
    match *reader.numbers()?.as_slice() {
        [x_m, y_m] => Ok(Pose2::new(x_m, y_m, 0.0)),
        [x_m, y_m, yaw_rad] => Ok(Pose2::new(x_m, y_m, yaw_rad)),
        _ => Err(reader.unreadable("two or three numbers")),
    }
}

/// Points in the plane.
fn points_of(reader: &CaseReader<'_>) -> Result<Vec<[f64; 2]>, Unreadable> {
    reader.each(CaseReader::array)
}
