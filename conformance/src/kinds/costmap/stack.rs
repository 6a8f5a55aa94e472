//! Layers over each other, and what comes of readings.

use std::any::Any;

use periplus_costmap::clear::clear;
use periplus_costmap::layers::{
    ContainerLayer, DenoiseLayer, InflationLayer, MapMeaning, ObstacleLayer, RangeLayer,
    RangeReading, StaticLayer, VoxelLayer,
};
use periplus_costmap::{
    CellWindow, Costmap, CostmapSettings, Footprint, Layer, LayeredCostmap, Nav2Release,
    NoTransforms, Observation, ObservationSource, RangeLimits, tables,
};
use periplus_geometry::{Pose, Pose2};
use periplus_grid::GridInfo;
use periplus_params::{ParamValue as Parameter, Table, flag};
use serde_json::{Value, json};

use super::super::Setting;
use super::layers::region_of;
use super::{
    cell_named, cells_where, compat_of, counts_of, map_of, number, points_of, pose_of, rows_of,
    truth, values_of, window_of,
};
use crate::{Case, CaseReader, Differences, Expected, Unreadable, numbers};

/// The parameter of the costmap that obstacle and voxel layers read as well.
static UNKNOWN_SPACE: Table = Table {
    name: "the costmap",
    doc: "What layers read of the costmap.",
    parameters: &[flag("track_unknown_space", "Whether unseen cells are unknown.").or("false")],
};

/// The frame of everything.
const FRAME: &str = "map";

/// Kinds `layered_costmap` and `range_sensor_layer`: the costmap after each update.
pub(in super::super) fn check_layered(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let compat = compat_of(distro)?;
    let stack = Stack::after(&given, compat, compat)?;
    let exact = expect.stated("cells_that_differ_with_exact_distance");
    // A case that states how the two distance metrics differ has the grids of the branch main.
    let rounded =
        exact.as_ref().map(|_| Stack::after(&given, compat, Nav2Release::Main)).transpose()?;
    if let (Some(expected), Some(rounded)) = (&exact, &rounded) {
        let exact = Stack::after(&given, compat, Nav2Release::Humble)?;
        compare_exact(rounded, &exact, expected, differences)?;
    }
    let told = rounded.as_ref().unwrap_or(&stack);
    for (name, expected) in expect.members()? {
        match name {
            "after_each_update" => {
                let states = expected.list()?;
                differences.same_count("updates", told.states.len(), states.len());
                for (at, (got, expected)) in told.states.iter().zip(&states).enumerate() {
                    compare_state(&format!("update {}", at + 1), got, expected, differences)?;
                }
            }
            // One for each update, or one for the last.
            "peer_asserts" if expected.is_list() => {
                let asserts = expected.list()?;
                differences.same_count("peer_asserts", stack.states.len(), asserts.len());
                for (got, expected) in stack.states.iter().zip(&asserts) {
                    if expected.is_null() {
                        expected.input().skip();
                    } else {
                        assert_as_peer(&got.costmap, expected, differences)?;
                    }
                }
            }
            "peer_asserts" => {
                if let Some(got) = stack.states.last() {
                    assert_as_peer(&got.costmap, &expected, differences)?;
                }
            }
            "cells_that_differ_with_exact_distance" => {}
            _ => stack.compare_end(name, &expected, differences)?,
        }
    }
    stack.refuse_silent(&expect)
}

/// The cells that have another cost with exact distances, after each update.
fn compare_exact(
    rounded: &Stack,
    exact: &Stack,
    expected: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let updates = expected.list()?;
    differences.same_count("cells that differ", rounded.states.len(), updates.len());
    for (at, expected) in updates.iter().enumerate() {
        let (Some(rounded), Some(exact)) = (rounded.states.get(at), exact.states.get(at)) else {
            continue;
        };
        let costs = rounded.costmap.costs().iter().zip(exact.costmap.costs()).enumerate();
        let others = costs.filter(|(_, (rounded, exact))| rounded != exact);
        let others = others.map(|(index, (_, cost))| {
            let (x, y) = exact.costmap.info().cell(index);
            json!([x, y, cost])
        });
        let what = format!("update {}, cells that differ", at + 1);
        differences.compare_sets(what, others.collect(), expected);
    }
    Ok(())
}

/// Kind `obstacle_layer`: the layer's own cells after one update.
pub(in super::super) fn check_obstacle(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let compat = compat_of(distro)?;
    let mut stack = Stack::after(&given, compat, compat)?;
    if stack.states.is_empty() {
        stack.update(Pose2::IDENTITY);
    }
    let looks = |layer: &&dyn Layer| !layer.sources().is_empty();
    let grid = stack.costmap.all().find(looks).and_then(|layer| layer.grid().cloned());
    let Some(grid) = grid else {
        return Err(given.unreadable("a stack with a layer that has seen something"));
    };
    for (name, expected) in expect.members()? {
        // Null states nothing of these.
        let may_be_null = ["cell", "lethal", "nonfree_cells", "free_cells", "lethal_cells", "grid"];
        if expected.is_null() && may_be_null.contains(&name) {
            expected.input().skip();
            continue;
        }
        match name {
            "counts" => differences.compare("the layer", &counts_of(&grid), &expected),
            // A cell that is not lethal must be the one of the point that was observed, or the case
            // would check nothing.
            "cell" => {
                let cell = expected.input().cell()?;
                let is_lethal = grid.cost(cell) == Some(254);
                let seen = stack.last_cell(&grid).unwrap_or([cell.0, cell.1]);
                let got = if is_lethal { json!([cell.0, cell.1]) } else { json!(seen) };
                differences.compare(name, &got, &expected);
            }
            "lethal" => {
                let cell = expect.get("cell")?.input().cell()?;
                differences.compare(name, &json!(grid.cost(cell) == Some(254)), &expected);
            }
            "nonfree_cells" => {
                differences.compare_sets(name, cells_where(&grid, true, |it| it != 0), &expected);
            }
            "free_cells" => {
                differences.compare_sets(name, cells_where(&grid, false, |it| it == 0), &expected);
            }
            "lethal_cells" => {
                let lethal = cells_where(&grid, false, |it| it == 254);
                differences.compare_sets(name, lethal, &expected);
            }
            "grid" => differences.compare("the layer", &rows_of(&grid), &expected),
            "window_cells" => {
                let window = stack.states.last().and_then(|state| state.window);
                differences.compare(name, &window_value(window), &expected);
            }
            "peer_asserts" => assert_as_peer(&grid, &expected, differences)?,
            "after_each_update" => {
                let states = expected.list()?;
                differences.same_count("updates", stack.states.len(), states.len());
                for (at, (got, expected)) in stack.states.iter().zip(&states).enumerate() {
                    compare_state(&format!("update {}", at + 1), got, expected, differences)?;
                }
            }
            _ => stack.compare_end(name, &expected, differences)?,
        }
    }
    stack.refuse_silent(&expect)
}

/// The costmap at some time.
struct State {
    costmap: Costmap,
    window: Option<CellWindow>,
    layers: Vec<(String, Costmap)>,
    columns: Vec<(String, Vec<u32>)>,
    is_current: bool,
}

struct Stack {
    costmap: LayeredCostmap,
    /// Release whose distance metric the inflation layers use.
    distances: Nav2Release,
    states: Vec<State>,
    /// The point that was observed last, and did not come from a list of several.
    last_point: Option<[f32; 3]>,
    /// True for each parameter change that was accepted.
    accepted: Vec<bool>,
    refusals: Vec<String>,
    /// Responses of the clear services.
    success: Vec<bool>,
}

impl Stack {
    /// All steps done.
    fn after(
        given: &CaseReader<'_>,
        compat: Nav2Release,
        distances: Nav2Release,
    ) -> Result<Self, Unreadable> {
        let mut stack = Self::new(given, compat, distances)?;
        for step in given.get("steps")?.list()? {
            stack.step(&step)?;
        }
        Ok(stack)
    }

    fn new(
        given: &CaseReader<'_>,
        compat: Nav2Release,
        distances: Nav2Release,
    ) -> Result<Self, Unreadable> {
        let about = given.get("costmap")?;
        let count = |name: &str| about.get(name)?.count();
        let origin =
            Pose2::new(number(&about, "origin_x", 0.0)?, number(&about, "origin_y", 0.0)?, 0.0);
        let resolution_m = about.get("resolution")?.number()?;
        let info = GridInfo::new(resolution_m, count("size_x")?, count("size_y")?, origin)
            .map_err(|error| about.unreadable(&error.to_string()))?;
        let frame = CostmapSettings {
            global_frame: FRAME.to_owned(),
            is_rolling: truth(&about, "rolling_window", false)?,
            tracks_unknown: truth(&about, "track_unknown_space", false)?,
            compat,
        };
        let mut stack = Self {
            costmap: LayeredCostmap::new(frame, info),
            distances,
            states: Vec::new(),
            last_point: None,
            accepted: Vec::new(),
            refusals: Vec::new(),
            success: Vec::new(),
        };
        let layers = given.get("layers")?.list()?;
        for layer in &layers {
            let layer = stack.layer(layer, compat)?;
            stack.costmap.add_layer(layer);
        }
        if let Some(footprint) = given.find("footprint") {
            stack.costmap.set_footprint(Footprint::new(points_of(&footprint)?));
        }
        stack.costmap.apply_requested_size();
        stack.fill(&layers)?;
        Ok(stack)
    }

    /// The cell of the point that was observed last, in its single precision.
    fn last_cell(&self, grid: &Costmap) -> Option<[usize; 2]> {
        let [x, y, _] = self.last_point?;
        let (x, y) = grid.finder().cell_of(f64::from(x), f64::from(y))?;
        Some([x, y])
    }

    /// Compares the final state; for all kinds.
    fn compare_end(
        &self,
        name: &str,
        expected: &Expected<'_>,
        differences: &mut Differences,
    ) -> Result<(), Unreadable> {
        match name {
            "accepted" => differences.compare(name, &json!(self.accepted), expected),
            "success" => differences.compare(name, &json!(self.success), expected),
            "layers" => {
                let end = self.state(None);
                compare_layers("at the end", &end, expected, differences)?;
            }
            "costmap" => {
                let end = self.state(None);
                compare_state("at the end", &end, expected, differences)?;
            }
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
        Ok(())
    }

    /// Fails if a parameter is refused and the case does not expect that.
    fn refuse_silent(&self, expect: &Expected<'_>) -> Result<(), Unreadable> {
        match self.refusals.first() {
            Some(why) if !expect.has("accepted") => Err(Unreadable(format!(
                "a parameter was refused ({why}), and `expect.accepted` does not expect that"
            ))),
            _ => Ok(()),
        }
    }

    fn layer(
        &mut self,
        about: &CaseReader<'_>,
        compat: Nav2Release,
    ) -> Result<Box<dyn Layer>, Unreadable> {
        let name = about.get("name")?.text()?.to_owned();
        let params = about.find("params");
        let of = |table: &'static Table, others: &[&'static Table]| {
            values_of(table, others, params.as_ref())
        };
        let tracks_unknown = match &params {
            Some(params) => truth(params, "track_unknown_space", false)?,
            None => false,
        };
        let kind = about.get("type")?;
        Ok(match kind.text()? {
            "static" => {
                let meaning = of(&tables::COSTMAP, &[&tables::STATIC])?;
                let meaning = MapMeaning::read(&meaning, compat);
                let values = of(&tables::STATIC, &[&tables::COSTMAP])?;
                let mut layer = StaticLayer::new(name, values, meaning, compat);
                if let Some(map) = about.find("map") {
                    layer
                        .set_map(map_of(&map)?, FRAME)
                        .map_err(|error| map.unreadable(&error.to_string()))?;
                }
                Box::new(layer)
            }
            "obstacle" => {
                let values = of(&tables::OBSTACLE, &[&UNKNOWN_SPACE])?;
                Box::new(ObstacleLayer::new(name, values, tracks_unknown, Vec::new()))
            }
            "voxel" => {
                let values = of(&tables::VOXEL, &[&UNKNOWN_SPACE])?;
                Box::new(VoxelLayer::new(name, values, tracks_unknown, Vec::new()))
            }
            "inflation" => {
                Box::new(InflationLayer::new(name, of(&tables::INFLATION, &[])?, self.distances))
            }
            "range" => Box::new(RangeLayer::new(name, of(&tables::RANGE, &[])?)),
            "denoise" => Box::new(DenoiseLayer::new(name, of(&tables::DENOISE, &[])?)),
            "plugin_container" => {
                let mut children = Vec::new();
                for child in about.get("plugins")?.list()? {
                    children.push(self.layer(&child, compat)?);
                }
                Box::new(ContainerLayer::new(name, of(&tables::CONTAINER, &[])?, children))
            }
            _ => return Err(kind.unreadable("a layer that is known")),
        })
    }

    /// Initial costs of the layers.
    fn fill(&mut self, layers: &[CaseReader<'_>]) -> Result<(), Unreadable> {
        for about in layers {
            if let Some(children) = about.find("plugins") {
                self.fill(&children.list()?)?;
            }
            let (fill, cells) = (about.find("initial_fill"), about.find("initial_cells"));
            if fill.is_none() && cells.is_none() {
                continue;
            }
            let name = about.get("name")?.text()?;
            let grid = if let Some(layer) = self.costmap.find_as::<ObstacleLayer>(name) {
                layer.grid_mut()
            } else if let Some(layer) = self.costmap.find_as::<VoxelLayer>(name) {
                layer.grid_mut()
            } else if let Some(layer) = self.costmap.find_as::<RangeLayer>(name) {
                layer.grid_mut()
            } else {
                return Err(about.unreadable("a layer with its own cells"));
            };
            if let Some(fill) = fill {
                grid.fill(fill.byte()?);
            }
            for cell in cells.map_or(Ok(Vec::new()), |cells| cells.list())? {
                set_cell(grid, &cell)?;
            }
        }
        Ok(())
    }

    fn step(&mut self, step: &CaseReader<'_>) -> Result<(), Unreadable> {
        if let Some(pose) = step.find("update") {
            self.update(pose_of(&pose)?);
            return Ok(());
        }
        if let Some(cell) = step.find("set_cell") {
            return set_cell(self.costmap.costmap_mut(), &cell);
        }
        if let Some(footprint) = step.find("set_footprint").or(step.find("footprint")) {
            self.costmap.set_footprint(Footprint::new(points_of(&footprint)?));
            return Ok(());
        }
        if let Some(clear) = step.find("clear") {
            return self.clear(&clear);
        }
        let named = step.get("layer")?;
        let name = named.text()?;
        if let Some(map) = step.find("set_map") {
            let layer = self.costmap.find_as::<StaticLayer>(name);
            let layer = layer.ok_or_else(|| named.unreadable("a static layer"))?;
            return layer
                .set_map(map_of(&map)?, FRAME)
                .map_err(|error| map.unreadable(&error.to_string()));
        }
        if let Some(part) = step.find("map_update") {
            return self.update_map(&named, &part);
        }
        if let Some(observed) = step.find("observe") {
            return self.observe(&named, &observed);
        }
        if let Some(range) = step.find("range") {
            let reading = reading_of(step, &range)?;
            let layer = self.costmap.find_as::<RangeLayer>(name);
            layer.ok_or_else(|| named.unreadable("a range layer"))?.insert(reading);
            return Ok(());
        }
        if let Some(set) = step.find("set_param") {
            return self.set(&named, &set);
        }
        if let Some(window) = step.find("run_layer_costs") {
            let window = window_of(&window)?;
            if !self.costmap.apply_layer(name, window, 0, Pose2::IDENTITY, &NoTransforms) {
                return Err(named.unreadable("a layer that is there"));
            }
            self.states.push(self.state(None));
            return Ok(());
        }
        if truth(step, "reset", false)? {
            let layer = self.costmap.find_mut(name);
            layer.ok_or_else(|| named.unreadable("a layer that is there"))?.reset();
            return Ok(());
        }
        Err(step.unreadable("a step that is known"))
    }

    fn update(&mut self, pose: Pose2) {
        let window = self.costmap.update(0, pose, &NoTransforms);
        self.states.push(self.state(window));
    }

    /// Everything as it is now.
    fn state(&self, window: Option<CellWindow>) -> State {
        let (mut layers, mut columns) = (Vec::new(), Vec::new());
        for layer in self.costmap.all() {
            if let Some(grid) = layer.grid() {
                layers.push((layer.name().to_owned(), grid.clone()));
            }
            if let Some(voxels) = (layer as &dyn Any).downcast_ref::<VoxelLayer>() {
                let cells = voxels.voxels().columns().to_vec();
                columns.push((layer.name().to_owned(), cells));
            }
        }
        State {
            costmap: self.costmap.costmap().clone(),
            window,
            layers,
            columns,
            is_current: self.costmap.is_current(0),
        }
    }

    /// Calls a clear service: which one, where, how far, and for which layers.
    fn clear(&mut self, about: &CaseReader<'_>) -> Result<(), Unreadable> {
        let place = about.find_any(&["pose", "robot"]);
        let place = place.map_or(Ok(Pose2::IDENTITY), |it| pose_of(&it))?;
        let side_m = number(about, "reset_distance", 0.0)?;
        let region = region_of(&about.get("service")?, [place.x_m, place.y_m], side_m)?;
        let names = match about.find("plugins") {
            Some(names) => names.each(|name| Ok(name.text()?.to_owned()))?,
            None => Vec::new(),
        };
        self.success.push(clear(&mut self.costmap, region, &names).is_ok());
        Ok(())
    }

    /// Takes a part of a map that has changed: its lower left cell, its size and its cells.
    fn update_map(
        &mut self,
        named: &CaseReader<'_>,
        part: &CaseReader<'_>,
    ) -> Result<(), Unreadable> {
        let count = |name: &str| part.get(name)?.count();
        let (x0, y0) = (count("x")?, count("y")?);
        let window = CellWindow { x0, y0, xn: x0 + count("width")?, yn: y0 + count("height")? };
        let cells = part.get("data")?.each(|cell| {
            i8::try_from(cell.integer()?).map_err(|_| cell.unreadable("a number from -128 to 127"))
        })?;
        let layer = self.costmap.find_as::<StaticLayer>(named.text()?);
        let layer = layer.ok_or_else(|| named.unreadable("a static layer"))?;
        // A part that does not fit is ignored.
        let _ = layer.update_map(window, &cells, FRAME);
        Ok(())
    }

    fn observe(
        &mut self,
        named: &CaseReader<'_>,
        observed: &CaseReader<'_>,
    ) -> Result<(), Unreadable> {
        let points = observed.get("points")?.each(CaseReader::array::<3>)?;
        let range = |name: &str, usual: f64| number(observed, name, usual);
        if let [point] = points[..] {
            self.last_point = Some(point.map(|at| at as f32));
        }
        let seen = Observation {
            time_ns: 0,
            origin: observed.get("sensor_origin")?.array()?,
            points: points.iter().map(|point| point.map(|at| at as f32)).collect(),
            marks: RangeLimits {
                min_m: range("obstacle_min_range", 0.0)?,
                max_m: range("obstacle_max_range", 100.0)?,
            },
            rays: RangeLimits {
                min_m: range("raytrace_min_range", 0.0)?,
                max_m: range("raytrace_max_range", 100.0)?,
            },
        };
        let (marks, clears) =
            (truth(observed, "marking", true)?, truth(observed, "clearing", true)?);
        let source = ObservationSource::fixed("given", seen, marks, clears);
        let name = named.text()?;
        if let Some(layer) = self.costmap.find_as::<ObstacleLayer>(name) {
            layer.add_source(source);
        } else if let Some(layer) = self.costmap.find_as::<VoxelLayer>(name) {
            layer.add_source(source);
        } else {
            return Err(named.unreadable("an obstacle or voxel layer"));
        }
        Ok(())
    }

    /// Sets parameters of a layer, as `{name: value}`, as `[name, value]`, or with both named.
    fn set(&mut self, named: &CaseReader<'_>, set: &CaseReader<'_>) -> Result<(), Unreadable> {
        let layer_name = named.text()?;
        let changes: Vec<(&str, CaseReader<'_>)> = match set.raw() {
            Value::Array(_) => match set.list()?.as_slice() {
                [param, value] => vec![(param.text()?, value.clone())],
                _ => return Err(set.unreadable("a name and a value")),
            },
            Value::Object(map) if map.contains_key("name") && map.contains_key("value") => {
                vec![(set.get("name")?.text()?, set.get("value")?)]
            }
            _ => set.members()?,
        };
        let layer = self.costmap.find_mut(layer_name);
        let layer = layer.ok_or_else(|| named.unreadable("a layer that is there"))?;
        let Some(mut values) = layer.values().cloned() else {
            return Err(named.unreadable("a layer with parameters"));
        };
        let prefix = format!("{layer_name}.");
        for (param, value) in changes {
            // With or without the name of the layer.
            let param = param.strip_prefix(&prefix).unwrap_or(param);
            let table = values.table();
            let parameter = table.find(param).ok_or_else(|| {
                let known: Vec<&str> = table.parameters.iter().map(|it| it.name).collect();
                value.unreadable(&format!("a parameter of {}: {}", table.name, known.join(", ")))
            })?;
            match Parameter::read(parameter, &value.written()) {
                Ok(fitting) => {
                    values.set(param, fitting);
                }
                Err(why) => {
                    self.accepted.push(false);
                    self.refusals.push(format!("`{param}` {why}"));
                    return Ok(());
                }
            }
        }
        let answer = layer.configure(values);
        self.accepted.push(answer.is_ok());
        self.refusals.extend(answer.err().map(|error| error.to_string()));
        Ok(())
    }
}

/// A reading, in single precision as messages have it.
fn reading_of(step: &CaseReader<'_>, range: &CaseReader<'_>) -> Result<RangeReading, Unreadable> {
    let single = |name: &str| Ok(f64::from(range.get(name)?.number()? as f32));
    Ok(RangeReading {
        global_from_sensor: Pose::from(pose_of(&step.get("sensor_pose")?)?),
        range_m: single("range")?,
        min_range_m: single("min_range")?,
        max_range_m: single("max_range")?,
        field_of_view_rad: single("field_of_view")?,
    })
}

fn set_cell(grid: &mut Costmap, cell: &CaseReader<'_>) -> Result<(), Unreadable> {
    match *cell.each(CaseReader::count)?.as_slice() {
        [x, y, cost @ 0..=255] if grid.info().contains((x, y)) => {
            grid.set((x, y), cost as u8);
            Ok(())
        }
        _ => Err(cell.unreadable("a column, a row and a cost")),
    }
}

/// Four numbers of a window; null for no update.
fn window_value(window: Option<CellWindow>) -> Value {
    json!(window.map(|CellWindow { x0, y0, xn, yn }| [x0, y0, xn, yn]))
}

fn compare_state(
    when: &str,
    got: &State,
    expected: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for (name, expected) in expected.members()? {
        let what = format!("{when}, {name}");
        match name {
            "window_cells" => differences.compare(what, &window_value(got.window), &expected),
            "grid" => differences.compare(what, &rows_of(&got.costmap), &expected),
            "counts" => differences.compare(what, &counts_of(&got.costmap), &expected),
            "cells" => compare_cells(&what, &got.costmap, &expected, differences)?,
            "current" => differences.compare(what, &json!(got.is_current), &expected),
            "origin" => {
                let origin = got.costmap.info().origin;
                differences.compare(what, &numbers([origin.x_m, origin.y_m]), &expected);
            }
            "layers" => compare_layers(&what, got, &expected, differences)?,
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}

/// The own cells of layers, by the layers' names.
fn compare_layers(
    when: &str,
    got: &State,
    expected: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for (layer, expected) in expected.members()? {
        let found = got.layers.iter().find(|(name, _)| name == layer);
        let Some((_, grid)) = found else {
            differences.not_known(format!("`{}`", expected.path()));
            continue;
        };
        for (name, expected) in expected.members()? {
            let what = format!("{when}, {layer}, {name}");
            match name {
                "grid" => differences.compare(what, &rows_of(grid), &expected),
                "counts" => differences.compare(what, &counts_of(grid), &expected),
                "cells" => compare_cells(&what, grid, &expected, differences)?,
                "unknown_cells" => {
                    differences.compare_sets(
                        what,
                        cells_where(grid, false, |it| it == 255),
                        &expected,
                    );
                }
                "lethal_cells" => {
                    differences.compare_sets(
                        what,
                        cells_where(grid, false, |it| it == 254),
                        &expected,
                    );
                }
                "free_cells" => {
                    differences.compare_sets(
                        what,
                        cells_where(grid, false, |it| it == 0),
                        &expected,
                    );
                }
                "nonfree_cells" => {
                    differences.compare_sets(
                        what,
                        cells_where(grid, true, |it| it != 0),
                        &expected,
                    );
                }
                "columns" => {
                    let columns = got.columns.iter().find(|(name, _)| name == layer);
                    let Some((_, columns)) = columns else {
                        differences.not_known(format!("`{}`", expected.path()));
                        continue;
                    };
                    for (cell, expected) in expected.members()? {
                        let at = cell_named(cell).filter(|at| grid.info().contains(*at));
                        let at = at.ok_or_else(|| expected.unreadable("the column of a cell"))?;
                        let got = columns.get(grid.info().index(at));
                        differences.compare(format_args!("{what} {cell}"), &json!(got), &expected);
                    }
                }
                _ => differences.not_known(format!("`{}`", expected.path())),
            }
        }
    }
    Ok(())
}

/// Costs of cells, by `x,y`.
fn compare_cells(
    what: &str,
    costmap: &Costmap,
    expected: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for (cell, cost) in expected.members()? {
        let at = cell_named(cell).ok_or_else(|| cost.unreadable("the cost of a cell `x,y`"))?;
        differences.compare(format_args!("{what} {cell}"), &json!(costmap.cost(at)), &cost);
    }
    Ok(())
}

/// The only bound that the peer's tests have: inscribed.
const BOUND: u8 = 253;

/// Assertions of the peer's own tests.
fn assert_as_peer(
    costmap: &Costmap,
    asserts: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for (name, expected) in asserts.members()? {
        match name {
            "counts" => differences.compare("the peer's test", &counts_of(costmap), &expected),
            "non_free" => {
                let count = costmap.costs().iter().filter(|cost| **cost != 0).count();
                differences.compare("cells that are not free", &json!(count), &expected);
            }
            "cells" => compare_cells("the peer's test", costmap, &expected, differences)?,
            "at_least" | "less_than" => {
                for (cell, bound) in expected.members()? {
                    let at = cell_named(cell).ok_or_else(|| bound.unreadable("a bound"))?;
                    if bound.input().byte().ok() != Some(BOUND) {
                        return Err(bound.unreadable("253 (inscribed): other bounds are too weak"));
                    }
                    let got = costmap.cost(at);
                    let is_met = got.is_some_and(|got| (got >= BOUND) == (name == "at_least"));
                    differences
                        .hold(format_args!("{name} at {cell}"), json!(got), &bound, |_| is_met);
                }
            }
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}
