//! Small obstacles, cleared areas, and parameters.

use std::any::Any;

use periplus_costmap::clear::{Region, clear, clear_cells};
use periplus_costmap::layers::{
    DenoiseLayer, InflationLayer, MapMeaning, ObstacleLayer, StaticLayer, denoise,
};
use periplus_costmap::{
    CellWindow, Costmap, CostmapConfig, CostmapSettings, Layer, LayeredCostmap, Nav2Release,
    NoTransforms, TransformSource, tables,
};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose, Pose2};
use periplus_grid::GridInfo;
use periplus_params::{ParamValue as Parameter, ParamValues};
use serde_json::{Value, json};

use super::super::Setting;
use super::{cells_where, compat_of, costmap_of, counts_of, pose_of, rows_of, truth, values_of};
use crate::{Case, CaseReader, Differences, Expected, Unreadable};

/// Kind `denoise`: pictures before and after, or what becomes of parameters.
pub(in super::super) fn check_denoise(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    if let Some(inputs) = given.find("inputs") {
        let effective = inputs.each(|input| {
            let values = values_of(&tables::DENOISE, &[], Some(input))?;
            let layer = DenoiseLayer::new("denoise", values);
            Ok(json!({
                "enabled": layer.is_enabled(),
                "minimal_group_size": layer.smallest(),
                "group_connectivity_type": layer.ways(),
            }))
        })?;
        differences.compare_members(&[(&["effective"], Value::Array(effective))], &expect);
        return Ok(());
    }
    let legend = given.find("legend");
    if let Some(legend) = &legend {
        // Also those for which there is no letter in the rows must be costs.
        for (_, cost) in legend.members()? {
            cost.byte()?;
        }
    }
    let cost = |reader: &CaseReader<'_>, letter: char| -> Result<u8, Unreadable> {
        match &legend {
            Some(legend) => legend.get(&letter.to_string())?.byte(),
            None => match letter {
                '.' => Ok(0),
                'x' => Ok(254),
                'n' => Ok(255),
                _ => Err(reader.unreadable("rows of `.`, `x` and `n`")),
            },
        }
    };
    let read_row = |row: &CaseReader<'_>| -> Result<Vec<u8>, Unreadable> {
        row.text()?.chars().map(|letter| cost(row, letter)).collect()
    };
    let rows = given.get("rows")?.each(read_row)?;
    let width = rows.first().map_or(0, Vec::len);
    let info = GridInfo { resolution_m: 1.0, width, height: rows.len(), origin: Pose2::IDENTITY };
    let mut costmap = Costmap::new(info, 0);
    let cells = rows.concat();
    if cells.len() != info.len() {
        return Err(given.unreadable("rows of one length"));
    }
    costmap.costs_mut().copy_from_slice(&cells);
    let smallest = given.get("minimal_group_size")?.count()?;
    let diagonally = given.get("group_connectivity_type")?.integer()? == 8;
    let unknown = truth(&given, "no_information_is_obstacle", true)?;
    denoise(&mut costmap, &CellWindow::all(&info), smallest, diagonally, unknown);
    let got: Vec<Vec<u8>> = costmap.costs().chunks(width.max(1)).map(<[u8]>::to_vec).collect();
    for (name, expected) in expect.members()? {
        match name {
            "rows" => {
                let rows = expected.list()?;
                let rows = rows.iter().map(|row| read_row(&row.input()));
                let rows = rows.collect::<Result<Vec<_>, _>>()?;
                differences.hold("rows", json!(got), &expected, |_| rows == got);
            }
            "counts" => differences.compare(name, &counts_of(&costmap), &expected),
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}

/// Kind `clear_area`: cells that become unknown.
pub(in super::super) fn check_clear_area(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut grid = costmap_of(&given, "fill")?;
    let corners = given.get("start_end_cells")?;
    let (start, end) = match *corners.each(CaseReader::integer)?.as_slice() {
        [x0, y0, x1, y1] => ((x0, y0), (x1, y1)),
        _ => return Err(corners.unreadable("four whole numbers")),
    };
    clear_cells(&mut grid, start, end, truth(&given, "invert", false)?, compat_of(distro)?);
    compare_cleared(&grid, &expect, differences)
}

/// Compares the grid after clearing.
fn compare_cleared(
    grid: &Costmap,
    expect: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for (name, expected) in expect.members()? {
        compare_one_cleared(name, grid, &expected, differences);
    }
    Ok(())
}

fn compare_one_cleared(
    name: &str,
    grid: &Costmap,
    expected: &Expected<'_>,
    differences: &mut Differences,
) {
    let unknown = || cells_where(grid, false, |cost| cost == 255);
    match name {
        "unknown_cells" | "cleared_cells" => differences.compare_sets(name, unknown(), expected),
        "unknown_count" | "cleared_count" | "count" => {
            differences.compare(name, &json!(unknown().len()), expected);
        }
        "grid" => differences.compare(name, &rows_of(grid), expected),
        "counts" => differences.compare(name, &counts_of(grid), expected),
        _ => differences.not_known(format!("`{}`", expected.path())),
    }
}

/// A costmap with the layers of a name each, of which some may be cleared; those are lethal.
fn named_layers(given: &CaseReader<'_>, compat: Nav2Release) -> Result<LayeredCostmap, Unreadable> {
    let info = match given.find("size") {
        Some(_) => *costmap_of(given, "default")?.info(),
        None => GridInfo { resolution_m: 1.0, width: 10, height: 10, origin: Pose2::IDENTITY },
    };
    let fill = given.find("fill").map_or(Ok(254), |it| it.byte())?;
    let mut costmap =
        LayeredCostmap::new(CostmapSettings { compat, ..CostmapSettings::default() }, info);
    let plugins = given.get("plugins")?.list()?;
    let clearable = given.get("clearable")?.each(CaseReader::truth)?;
    if plugins.len() != clearable.len() {
        return Err(given.unreadable("one with `clearable` for each of its `plugins`"));
    }
    for (name, may_clear) in plugins.iter().zip(clearable) {
        let name = name.text()?;
        let layer: Box<dyn Layer> = if may_clear {
            let values = values_of(&tables::OBSTACLE, &[], None)?;
            Box::new(ObstacleLayer::new(name, values, false, Vec::new()))
        } else if name.contains("inflation") {
            let values = values_of(&tables::INFLATION, &[], None)?;
            Box::new(InflationLayer::new(name, values, compat))
        } else {
            let meaning = MapMeaning::read(&values_of(&tables::COSTMAP, &[], None)?, compat);
            let values = values_of(&tables::STATIC, &[], None)?;
            Box::new(StaticLayer::new(name, values, meaning, compat))
        };
        costmap.add_layer(layer);
    }
    // Cells come when a layer is added.
    for layer in costmap.all_mut() {
        if let Some(layer) = (layer as &mut dyn Any).downcast_mut::<ObstacleLayer>() {
            layer.grid_mut().fill(fill);
        }
    }
    Ok(costmap)
}

/// The region that a clear service concerns, by the beginning of its name.
pub(super) fn region_of(
    service: &CaseReader<'_>,
    [x_m, y_m]: [f64; 2],
    side_m: f64,
) -> Result<Region, Unreadable> {
    let name = service.text()?.trim_end_matches('_').trim_start_matches("clear_");
    Ok(match name {
        "entirely" => Region::Everything,
        "around" | "around_pose" => Region::Around { x_m, y_m, side_m },
        "except" => Region::Except { x_m, y_m, side_m },
        _ => return Err(service.unreadable("a service that clears")),
    })
}

/// Kind `clear_service`: what the services answer, that a refused request clears nothing, and which
/// cells are left.
pub(in super::super) fn check_clear_service(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let compat = compat_of(distro)?;
    let fill = given.find("fill").map_or(Ok(254), |it| it.byte())?;
    let place = given.find_any(&["pose", "robot", "robot_pose"]);
    let place = place.map_or(Ok(Pose2::new(5.0, 5.0, 0.0)), |it| pose_of(&it))?;
    let side_m = super::number(&given, "reset_distance", 4.0)?;
    let services = match given.find("services") {
        Some(services) => services.list()?,
        None => vec![given.get("service")?],
    };
    let requests = match given.find("requests") {
        Some(requests) => requests.each(|it| it.each(|name| Ok(name.text()?.to_owned())))?,
        None => vec![Vec::new()],
    };
    for service in services {
        let region = region_of(&service, [place.x_m, place.y_m], side_m)?;
        let what = service.text()?;
        let (mut success, mut counts) = (Vec::new(), Vec::new());
        let mut last = None;
        for names in &requests {
            let mut costmap = named_layers(&given, compat)?;
            let is_done = clear(&mut costmap, region, names).is_ok();
            let grids = costmap.all().filter(|layer| (*layer as &dyn Any).is::<ObstacleLayer>());
            let grids: Vec<Costmap> = grids.filter_map(|layer| layer.grid().cloned()).collect();
            let is_touched = grids.iter().any(|grid| grid.costs().iter().any(|cost| *cost != fill));
            if is_touched && !is_done {
                differences.push(format!("{what}{names:?} cleared something, and answers false"));
            }
            let unknown = |grid: &Costmap| cells_where(grid, false, |cost| cost == 255).len();
            counts.push(grids.first().map(unknown));
            last = grids.into_iter().next();
            success.push(is_done);
        }
        for (name, expected) in expect.members()? {
            let is_one = requests.len() == 1 && !expected.is_list();
            match (name, &last) {
                ("success", _) if is_one => {
                    differences.compare(
                        format_args!("{what} {name}"),
                        &json!(success[0]),
                        &expected,
                    );
                }
                ("success", _) => {
                    differences.compare(format_args!("{what} {name}"), &json!(success), &expected);
                }
                ("unknown_counts" | "cleared_counts", _) => {
                    differences.compare(format_args!("{what} {name}"), &json!(counts), &expected);
                }
                (_, Some(grid)) if requests.len() == 1 => {
                    compare_one_cleared(name, grid, &expected, differences);
                }
                _ => differences.not_known(format!(
                    "`{}` (for one request: cells; for several: `success`, `unknown_counts`)",
                    expected.path()
                )),
            }
        }
    }
    Ok(())
}

/// Kind `declare_params`: changes while a costmap runs, and defaults.
pub(in super::super) fn check_parameters(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut config = CostmapConfig::read([], Some(compat_of(distro)?), &mut Diagnostics::new());
    let mut costmap = config.build();
    costmap.update(0, Pose2::IDENTITY, &NoTransforms);
    // Besides the two frames that the costmap has anyway.
    let mut frames = vec!["map".to_owned(), "base_link".to_owned()];
    if let Some(more) = given.find("frames") {
        frames.extend(more.each(|name| Ok(name.text()?.to_owned()))?);
    }
    let known = |target: &str, source: &str| {
        let has = |name: &str| frames.iter().any(|frame| frame == name);
        (has(target) && has(source)).then_some(Pose::IDENTITY)
    };
    let mut accepted = Vec::new();
    if let Some(sets) = given.find("set") {
        for set in sets.list()? {
            accepted.push(change(&mut config, &mut costmap, &set, &known)?.is_ok());
        }
    }
    for (name, expected) in expect.members()? {
        match name {
            "accepted" | "success" => differences.compare(name, &json!(accepted), &expected),
            "defaults" | "values" => {
                for (name, expected) in expected.members()? {
                    let layers = config.layers.iter().chain(&config.filters);
                    let mut of_layers = layers.filter_map(|layer| {
                        let name = name.strip_prefix(&format!("{}.", layer.name))?;
                        layer.values.get(layer.values.table().find(name)?.name)
                    });
                    let of_node = config.node.table().find(name);
                    let of_node = of_node.and_then(|found| config.node.get(found.name));
                    match of_node.or_else(|| of_layers.next()) {
                        Some(value) => differences.compare(name, &json_of(&value), &expected),
                        None => differences.not_known(format!("`{}`", expected.path())),
                    }
                }
            }
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}

/// A value as a parameter of its kind.
fn parameter_of(value: &CaseReader<'_>) -> Result<Parameter, Unreadable> {
    Ok(match value.whole() {
        Value::Bool(truth) => Parameter::Bool(*truth),
        Value::String(text) => Parameter::Text(text.clone()),
        Value::Number(number) => match number.as_i64() {
            Some(integer) => Parameter::Integer(integer),
            None => Parameter::Number(number.as_f64().unwrap_or(f64::NAN)),
        },
        _ => return Err(value.unreadable("a value")),
    })
}

/// Sets parameters of a costmap that runs, as a service would.
fn change(
    config: &mut CostmapConfig,
    costmap: &mut LayeredCostmap,
    set: &CaseReader<'_>,
    frames: &dyn TransformSource,
) -> Result<Result<(), String>, Unreadable> {
    let mut values = config.node.clone();
    for (name, value) in set.members()? {
        let parameter = parameter_of(&value)?;
        if let Some((layer, name)) = name.rsplit_once('.') {
            let found = config.layers.iter_mut().chain(&mut config.filters);
            let layer = found.into_iter().find(|it| it.name == layer);
            let layer = layer.ok_or_else(|| value.unreadable("a parameter of a layer"))?;
            let mut changed = layer.values.clone();
            if let Err(why) = put(&mut changed, name, parameter, &value)? {
                return Ok(Err(why));
            }
            let running = costmap.find_mut(&layer.name);
            let running = running.ok_or_else(|| value.unreadable("a layer that runs"))?;
            if let Err(error) = running.configure(changed.clone()) {
                return Ok(Err(error.to_string()));
            }
            layer.values = changed;
        } else if let Err(why) = put(&mut values, name, parameter, &value)? {
            return Ok(Err(why));
        }
    }
    Ok(config.change(costmap, values, frames).map_err(|error| error.to_string()))
}

/// Sets a parameter; the inner error is the reason why the value does not fit.
fn put(
    values: &mut ParamValues,
    name: &str,
    parameter: Parameter,
    value: &CaseReader<'_>,
) -> Result<Result<(), String>, Unreadable> {
    let found = values.table().find(name);
    let found = found.ok_or_else(|| value.unreadable("the value of a known parameter"))?;
    Ok(match parameter.fit(found) {
        Ok(fitting) => {
            values.set(name, fitting);
            Ok(())
        }
        Err(why) => Err(format!("`{name}` {why}")),
    })
}

fn json_of(value: &Parameter) -> Value {
    match value {
        Parameter::Bool(truth) => json!(truth),
        Parameter::Integer(integer) => json!(integer),
        Parameter::Number(number) => json!(number),
        Parameter::Text(text) => json!(text),
        Parameter::Numbers(numbers) => json!(numbers),
        Parameter::Texts(texts) => json!(texts),
    }
}
