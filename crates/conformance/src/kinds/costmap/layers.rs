//! Small obstacles, cleared areas, and parameters.

use std::any::Any;

use periplus_base::Pose2;
use periplus_costmap::clear::{Region, clear, clear_cells};
use periplus_costmap::layers::{
    DenoiseLayer, InflationLayer, MapMeaning, ObstacleLayer, StaticLayer, denoise,
};
use periplus_costmap::{
    Compat, Config, Costmap, Frame, Layer, LayeredCostmap, NoFrames, Window, tables,
};
use periplus_diagnostics::Diagnostics;
use periplus_grid::Lattice;
use periplus_params::Value as Parameter;
use serde_json::{Value, json};

use super::super::Setting;
use super::{compat_of, costmap_of, truth, values_of};
use crate::{Case, Differences, Reader, Unreadable};

/// Kind `denoise`: pictures before and after, or what becomes of parameters.
pub(in super::super) fn check_denoise(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    if let Some(inputs) = given.find("inputs") {
        let effective = expect.get("effective")?.list()?;
        for (input, expected) in inputs.list()?.iter().zip(&effective) {
            let layer = DenoiseLayer::new("denoise", values_of(&tables::DENOISE, Some(input))?);
            let got = json!({
                "enabled": layer.is_enabled(),
                "minimal_group_size": layer.smallest(),
                "group_connectivity_type": layer.ways(),
            });
            differences.same(format_args!("with {}", input.value()), &got, expected.value());
        }
        return Ok(());
    }
    let legend = given.find("legend");
    let cost = |reader: &Reader<'_>, letter: char| -> Result<u8, Unreadable> {
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
    let read = |reader: &Reader<'_>| -> Result<Vec<Vec<u8>>, Unreadable> {
        reader.each(|row| row.text()?.chars().map(|letter| cost(row, letter)).collect())
    };
    let rows = read(&given.get("rows")?)?;
    let width = rows.first().map_or(0, Vec::len);
    let lattice = Lattice { resolution_m: 1.0, width, height: rows.len(), origin: Pose2::IDENTITY };
    let mut costmap = Costmap::new(lattice, 0);
    let cells = rows.concat();
    if cells.len() != lattice.len() {
        return Err(given.unreadable("rows of one length"));
    }
    costmap.costs_mut().copy_from_slice(&cells);
    let smallest = given.get("minimal_group_size")?.count()?;
    let diagonally = given.get("group_connectivity_type")?.integer()? == 8;
    let unknown = truth(&given, "no_information_is_obstacle", true)?;
    denoise(&mut costmap, &Window::all(&lattice), smallest, diagonally, unknown);
    let expected = read(&expect.get("rows")?)?;
    let got: Vec<Vec<u8>> = costmap.costs().chunks(width.max(1)).map(<[u8]>::to_vec).collect();
    differences.same("rows", &got, &expected);
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
    let (start, end) = match *corners.each(Reader::integer)?.as_slice() {
        [x0, y0, x1, y1] => ((x0, y0), (x1, y1)),
        _ => return Err(corners.unreadable("four whole numbers")),
    };
    clear_cells(&mut grid, start, end, truth(&given, "invert", false)?, compat_of(distro));
    let unknown = |index: &usize| grid.costs()[*index] == 255;
    let cells = (0..grid.lattice().len()).filter(unknown).map(|index| grid.lattice().cell(index));
    let got: Vec<_> = cells.collect();
    if let Some(expected) = expect.find("unknown_cells") {
        let mut expected = expected.each(Reader::cell)?;
        expected.sort_by_key(|(x, y)| (*y, *x));
        differences.same("unknown cells", &got, &expected);
    }
    for name in ["unknown_count", "count"] {
        if let Some(expected) = expect.find(name) {
            differences.same("unknown cells", &got.len(), &expected.count()?);
        }
    }
    Ok(())
}

/// A costmap with the layers of a name each, of which some may be cleared.
fn named_layers(given: &Reader<'_>, compat: Compat) -> Result<LayeredCostmap, Unreadable> {
    let lattice = Lattice { resolution_m: 1.0, width: 10, height: 10, origin: Pose2::IDENTITY };
    let mut costmap = LayeredCostmap::new(Frame { compat, ..Frame::default() }, lattice);
    let clearable = given.get("clearable")?.each(Reader::truth)?;
    for (name, may_clear) in given.get("plugins")?.list()?.iter().zip(clearable) {
        let name = name.text()?;
        let layer: Box<dyn Layer> = if may_clear {
            let values = values_of(&tables::OBSTACLE, None)?;
            let mut layer = ObstacleLayer::new(name, values, false, Vec::new());
            layer.resized(&lattice, false);
            layer.grid_mut().fill(254);
            Box::new(layer)
        } else if name.contains("inflation") {
            Box::new(InflationLayer::new(name, values_of(&tables::INFLATION, None)?, compat))
        } else {
            let meaning = MapMeaning::read(&values_of(&tables::COSTMAP, None)?, compat);
            Box::new(StaticLayer::new(name, values_of(&tables::STATIC, None)?, meaning))
        };
        costmap.add_layer(layer);
    }
    // Cells come when a layer is added.
    for layer in costmap.all_mut() {
        if let Some(layer) = (layer as &mut dyn Any).downcast_mut::<ObstacleLayer>() {
            layer.grid_mut().fill(254);
        }
    }
    Ok(costmap)
}

/// Kind `clear_service`: what the services answer, and that a refused request clears nothing.
pub(in super::super) fn check_clear_service(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let success = expect.get("success")?.each(Reader::truth)?;
    let around = Region::Around { x_m: 5.0, y_m: 5.0, side_m: 4.0 };
    for service in given.get("services")?.list()? {
        let region = match service.text()? {
            "clear_entirely_" => Region::Everything,
            "clear_around_" | "clear_around_pose_" => around,
            "clear_except_" => Region::Except { x_m: 5.0, y_m: 5.0, side_m: 4.0 },
            _ => return Err(service.unreadable("a service that clears")),
        };
        for (request, expected) in given.get("requests")?.list()?.iter().zip(&success) {
            let names = request.each(|name| Ok(name.text()?.to_owned()))?;
            let mut costmap = named_layers(&given, compat_of(distro))?;
            let answer = clear(&mut costmap, region, &names);
            let what = format!("{}{names:?}", service.text()?);
            differences.same(&what, &answer.is_ok(), expected);
            let is_touched = costmap.all().any(|layer| {
                let is_obstacle = (layer as &dyn Any).is::<ObstacleLayer>();
                layer
                    .grid()
                    .is_some_and(|grid| is_obstacle && grid.costs().iter().any(|c| *c != 254))
            });
            differences.same(format_args!("{what} cleared something"), &is_touched, expected);
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
    let mut config = Config::read([], Some(compat_of(distro)), &mut Diagnostics::new());
    let mut costmap = config.build();
    costmap.update(0, Pose2::IDENTITY, &NoFrames);
    if let Some(sets) = given.find("set") {
        let accepted = expect.get("accepted")?.each(Reader::truth)?;
        let sets = sets.list()?;
        differences.same("answers", &sets.len(), &accepted.len());
        for (set, expected) in sets.iter().zip(accepted) {
            let answer = change(&mut config, &mut costmap, set)?;
            differences.same(
                format_args!("{}: {answer:?}", set.value()),
                &answer.is_ok(),
                &expected,
            );
        }
    }
    if let Some(defaults) = expect.find("defaults") {
        for (name, expected) in defaults.members()? {
            let got = config.node.get(name).map(|value| json_of(&value));
            differences.same(name, &got.as_ref(), &Some(expected.value()));
        }
    }
    Ok(())
}

/// Sets parameters of a costmap that runs, as a service would.
fn change(
    config: &mut Config,
    costmap: &mut LayeredCostmap,
    set: &Reader<'_>,
) -> Result<Result<(), String>, Unreadable> {
    let mut values = config.node.clone();
    for (name, value) in set.members()? {
        let Some(parameter) = tables::COSTMAP.find(name) else {
            return Ok(Err(format!("there is no `{name}`")));
        };
        let value = match value.value() {
            Value::Bool(truth) => Parameter::Bool(*truth),
            Value::String(text) => Parameter::Text(text.clone()),
            Value::Number(number) => match number.as_i64() {
                Some(integer) => Parameter::Integer(integer),
                None => Parameter::Number(number.as_f64().unwrap_or(f64::NAN)),
            },
            _ => return Err(value.unreadable("a value")),
        };
        match value.fit(parameter) {
            Ok(value) => {
                values.set(name, value);
            }
            Err(why) => return Ok(Err(format!("`{name}` {why}"))),
        }
    }
    Ok(config.change(costmap, values))
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
