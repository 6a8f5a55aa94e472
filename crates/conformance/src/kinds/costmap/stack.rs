//! Layers over each other, and what comes of readings.

use std::collections::BTreeMap;

use periplus_base::{Pose, Pose2};
use periplus_costmap::layers::{
    ContainerLayer, DenoiseLayer, InflationLayer, MapMeaning, ObstacleLayer, RangeLayer,
    RangeReading, StaticLayer, VoxelLayer,
};
use periplus_costmap::{
    Compat, Costmap, Footprint, Frame, Layer, LayeredCostmap, NoFrames, Observation, Source, Span,
    Window, tables,
};
use periplus_grid::{Cell, Lattice};
use periplus_params::{Given, Table};
use serde_json::Value;

use super::super::Setting;
use super::{compat_of, map_of, number, points_of, pose_of, truth, values_of, window_of, written};
use crate::{Case, Differences, Reader, Unreadable};

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
    let compat = compat_of(distro);
    let mut stack = Stack::new(&given, compat)?;
    for step in given.get("steps")?.list()? {
        stack.step(&step)?;
    }
    let is_exact = !compat.rounds_distances();
    let exact = expect.find("cells_that_differ_with_exact_distance").filter(|_| is_exact);
    if let Some(states) = expect.find("after_each_update") {
        let states = states.list()?;
        differences.same("updates", &stack.states.len(), &states.len());
        for (at, (got, expected)) in stack.states.iter().zip(&states).enumerate() {
            let others = match &exact {
                Some(exact) => match exact.list()?.get(at) {
                    Some(cells) => cells.each(Reader::array::<3>)?,
                    None => Vec::new(),
                },
                None => Vec::new(),
            };
            compare(&format!("update {}", at + 1), got, expected, &others, differences)?;
        }
    }
    if let Some(asserts) = expect.find("peer_asserts") {
        // One for each update, or one for the last.
        match asserts.list() {
            Ok(list) => {
                for (got, expected) in stack.states.iter().zip(&list) {
                    assert_as_peer(got, expected, differences)?;
                }
            }
            Err(_) => {
                if let Some(got) = stack.states.last() {
                    assert_as_peer(got, &asserts, differences)?;
                }
            }
        }
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
    let mut stack = Stack::new(&given, compat_of(distro))?;
    for step in given.get("steps")?.list()? {
        stack.step(&step)?;
    }
    if stack.states.is_empty() {
        stack.update(Pose2::IDENTITY);
    }
    let looks = |layer: &&dyn Layer| !layer.sources().is_empty();
    let grid = stack.costmap.all().find(looks).and_then(|layer| layer.grid().cloned());
    let Some(grid) = grid else {
        return Err(given.unreadable("a stack with a layer that has seen something"));
    };
    let width = grid.lattice().width;
    let cells = |wanted: &dyn Fn(u8) -> bool| {
        let all = grid.costs().iter().enumerate().filter(|(_, cost)| wanted(**cost));
        let listed = all.map(|(at, cost)| (at % width, at / width, *cost));
        listed.collect::<Vec<_>>()
    };
    if let Some(counts) = expect.find("counts") {
        compare_counts("the layer", grid.costs(), &counts, differences)?;
    }
    if let (Some(cell), Some(lethal)) = (expect.find("cell"), expect.find("lethal")) {
        let is_lethal = grid.cost(cell.cell()?) == Some(254);
        differences.same("lethal", &is_lethal, &lethal.truth()?);
    }
    if let Some(marked) = expect.find("nonfree_cells") {
        let mut expected = Vec::new();
        for cell in marked.list()? {
            match *cell.each(Reader::count)?.as_slice() {
                [x, y, cost] => expected.push((x, y, cost as u8)),
                _ => return Err(cell.unreadable("a column, a row and a cost")),
            }
        }
        expected.sort_by_key(|(x, y, _)| (*y, *x));
        differences.same("cells that are not free", &cells(&|cost| cost != 0), &expected);
    }
    if let Some(free) = expect.find("free_cells") {
        let mut expected = free.each(Reader::cell)?;
        expected.sort_by_key(|(x, y)| (*y, *x));
        let free: Vec<Cell> = cells(&|cost| cost == 0).iter().map(|(x, y, _)| (*x, *y)).collect();
        differences.same("free cells", &free, &expected);
    }
    if let Some(rows) = expect.find("grid") {
        compare_rows("the layer", &grid, &rows, &[], differences)?;
    }
    Ok(())
}

/// The costmap at some time.
struct State {
    costmap: Costmap,
    window: Option<Window>,
}

struct Stack {
    costmap: LayeredCostmap,
    /// What was set by hand of each layer.
    params: BTreeMap<String, BTreeMap<String, String>>,
    states: Vec<State>,
}

impl Stack {
    fn new(given: &Reader<'_>, compat: Compat) -> Result<Self, Unreadable> {
        let about = given.get("costmap")?;
        let count = |name: &str| about.get(name)?.count();
        let origin =
            Pose2::new(number(&about, "origin_x", 0.0)?, number(&about, "origin_y", 0.0)?, 0.0);
        let resolution_m = about.get("resolution")?.number()?;
        let lattice = Lattice::new(resolution_m, count("size_x")?, count("size_y")?, origin)
            .map_err(|error| about.unreadable(&error.to_string()))?;
        let frame = Frame {
            global_frame: FRAME.to_owned(),
            is_rolling: truth(&about, "rolling_window", false)?,
            tracks_unknown: truth(&about, "track_unknown_space", false)?,
            compat,
        };
        let mut stack = Self {
            costmap: LayeredCostmap::new(frame, lattice),
            params: BTreeMap::new(),
            states: Vec::new(),
        };
        let layers = given.get("layers")?.list()?;
        for layer in &layers {
            let layer = stack.layer(layer, compat)?;
            stack.costmap.add_layer(layer);
        }
        if let Some(footprint) = given.find("footprint") {
            stack.costmap.set_footprint(Footprint::new(points_of(&footprint)?));
        }
        stack.costmap.settle_size();
        stack.fill(&layers)?;
        Ok(stack)
    }

    fn layer(&mut self, about: &Reader<'_>, compat: Compat) -> Result<Box<dyn Layer>, Unreadable> {
        let name = about.get("name")?.text()?.to_owned();
        let params = about.find("params");
        let mut texts = BTreeMap::new();
        if let Some(params) = &params {
            for (param, value) in params.members()? {
                texts.insert(param.to_owned(), written(value.value()));
            }
        }
        self.params.insert(name.clone(), texts);
        let of = |table: &'static Table| values_of(table, params.as_ref());
        let tracks_unknown = match &params {
            Some(params) => truth(params, "track_unknown_space", false)?,
            None => false,
        };
        let kind = about.get("type")?;
        Ok(match kind.text()? {
            "static" => {
                let meaning = MapMeaning::read(&of(&tables::COSTMAP)?, compat);
                let mut layer = StaticLayer::new(name, of(&tables::STATIC)?, meaning);
                if let Some(map) = about.find("map") {
                    layer.set_map(map_of(&map)?, FRAME).map_err(|why| map.unreadable(&why))?;
                }
                Box::new(layer)
            }
            "obstacle" => {
                let values = of(&tables::OBSTACLE)?;
                Box::new(ObstacleLayer::new(name, values, tracks_unknown, Vec::new()))
            }
            "voxel" => {
                let values = of(&tables::VOXEL)?;
                Box::new(VoxelLayer::new(name, values, tracks_unknown, Vec::new()))
            }
            "inflation" => Box::new(InflationLayer::new(name, of(&tables::INFLATION)?, compat)),
            "range" => Box::new(RangeLayer::new(name, of(&tables::RANGE)?)),
            "denoise" => Box::new(DenoiseLayer::new(name, of(&tables::DENOISE)?)),
            "plugin_container" => {
                let mut children = Vec::new();
                for child in about.get("plugins")?.list()? {
                    children.push(self.layer(&child, compat)?);
                }
                Box::new(ContainerLayer::new(name, of(&tables::CONTAINER)?, children))
            }
            _ => return Err(kind.unreadable("a layer that is known")),
        })
    }

    /// What layers hold at the start.
    fn fill(&mut self, layers: &[Reader<'_>]) -> Result<(), Unreadable> {
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
            } else if let Some(layer) = self.costmap.find_as::<RangeLayer>(name) {
                layer.grid_mut()
            } else {
                return Err(about.unreadable("a layer with cells of its own"));
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

    fn step(&mut self, step: &Reader<'_>) -> Result<(), Unreadable> {
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
        let named = step.get("layer")?;
        let name = named.text()?;
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
            if !self.costmap.apply_layer(name, window, 0, Pose2::IDENTITY, &NoFrames) {
                return Err(named.unreadable("a layer that is there"));
            }
            self.states.push(State { costmap: self.costmap.costmap().clone(), window: None });
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
        let window = self.costmap.update(0, pose, &NoFrames);
        self.states.push(State { costmap: self.costmap.costmap().clone(), window });
    }

    fn observe(&mut self, named: &Reader<'_>, observed: &Reader<'_>) -> Result<(), Unreadable> {
        let points = observed.get("points")?.each(Reader::array::<3>)?;
        let range = |name: &str, usual: f64| number(observed, name, usual);
        let seen = Observation {
            time_ns: 0,
            origin: observed.get("sensor_origin")?.array()?,
            points: points.iter().map(|point| point.map(|at| at as f32)).collect(),
            marks: Span {
                min_m: range("obstacle_min_range", 0.0)?,
                max_m: range("obstacle_max_range", 100.0)?,
            },
            rays: Span {
                min_m: range("raytrace_min_range", 0.0)?,
                max_m: range("raytrace_max_range", 100.0)?,
            },
        };
        let (marks, clears) =
            (truth(observed, "marking", true)?, truth(observed, "clearing", true)?);
        let source = Source::fixed("given", seen, marks, clears);
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

    /// Sets parameters of a layer, as `{name: value}` or as `[name, value]`.
    fn set(&mut self, named: &Reader<'_>, set: &Reader<'_>) -> Result<(), Unreadable> {
        let name = named.text()?;
        let changes: Vec<(String, String)> = match set.value() {
            Value::Array(_) => match set.list()?.as_slice() {
                [param, value] => vec![(param.text()?.to_owned(), written(value.value()))],
                _ => return Err(set.unreadable("a name and a value")),
            },
            Value::Object(map) if map.contains_key("name") && map.contains_key("value") => {
                vec![(set.get("name")?.text()?.to_owned(), written(set.get("value")?.value()))]
            }
            _ => {
                let members = set.members()?;
                let pair =
                    |(name, value): (&str, Reader<'_>)| (name.to_owned(), written(value.value()));
                members.into_iter().map(pair).collect()
            }
        };
        let texts = self.params.entry(name.to_owned()).or_default();
        for (param, text) in changes {
            // With or without the name of the layer.
            let param = param.strip_prefix(&format!("{name}.")).unwrap_or(&param).to_owned();
            texts.insert(param, text);
        }
        let texts = texts.clone();
        let layer =
            self.costmap.find_mut(name).ok_or_else(|| named.unreadable("a layer that is there"))?;
        let Some(table) = layer.values().map(periplus_params::Values::table) else {
            return Err(named.unreadable("a layer with parameters"));
        };
        let known = texts.iter().filter(|(param, _)| table.find(param).is_some());
        let given = known.map(|(param, text)| Given::new(param, text.as_str()));
        let values = table.check(given, None, &mut periplus_diagnostics::Diagnostics::new());
        layer.configure(values).map_err(|why| set.unreadable(&why))
    }
}

/// A reading, in single precision as messages have it.
fn reading_of(step: &Reader<'_>, range: &Reader<'_>) -> Result<RangeReading, Unreadable> {
    let single = |name: &str| Ok(f64::from(range.get(name)?.number()? as f32));
    Ok(RangeReading {
        global_from_sensor: Pose::from(pose_of(&step.get("sensor_pose")?)?),
        range_m: single("range")?,
        min_range_m: single("min_range")?,
        max_range_m: single("max_range")?,
        field_of_view_rad: single("field_of_view")?,
    })
}

fn set_cell(grid: &mut Costmap, cell: &Reader<'_>) -> Result<(), Unreadable> {
    match *cell.each(Reader::count)?.as_slice() {
        [x, y, cost @ 0..=255] if grid.lattice().contains((x, y)) => {
            grid.set((x, y), cost as u8);
            Ok(())
        }
        _ => Err(cell.unreadable("a column, a row and a cost")),
    }
}

/// Compares a state; `others` are cells that are otherwise with exact distances.
fn compare(
    when: &str,
    got: &State,
    expected: &Reader<'_>,
    others: &[[f64; 3]],
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    if let Some(window) = expected.find("window_cells") {
        let window = window_of(&window)?;
        differences.same(format_args!("{when}, window"), &got.window, &Some(window));
    }
    if let Some(rows) = expected.find("grid") {
        return compare_rows(when, &got.costmap, &rows, others, differences);
    }
    for [x, y, cost] in others {
        let cell = (*x as usize, *y as usize);
        let cost = Some(*cost as u8);
        differences.same(format_args!("{when}, {cell:?}"), &got.costmap.cost(cell), &cost);
    }
    if let Some(counts) = expected.find("counts") {
        compare_counts(when, got.costmap.costs(), &counts, differences)?;
    }
    Ok(())
}

fn compare_rows(
    when: &str,
    got: &Costmap,
    rows: &Reader<'_>,
    others: &[[f64; 3]],
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let rows = rows.each(|row| row.each(Reader::byte))?;
    differences.same(format_args!("{when}, rows"), &got.lattice().height, &rows.len());
    for (y, row) in rows.iter().enumerate() {
        differences.same(format_args!("{when}, columns"), &got.lattice().width, &row.len());
        for (x, cost) in row.iter().enumerate() {
            let other = others.iter().find(|[ox, oy, _]| (*ox as usize, *oy as usize) == (x, y));
            let cost = other.map_or(*cost, |[_, _, cost]| *cost as u8);
            let got = got.cost((x, y)).map(i64::from);
            differences.whole(format_args!("{when}, ({x}, {y})"), got.unwrap_or(-1), cost.into());
        }
    }
    Ok(())
}

fn compare_counts(
    when: &str,
    costs: &[u8],
    counts: &Reader<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for (name, expected) in counts.members()? {
        let cost: u8 = name.parse().map_err(|_| counts.unreadable("counts of costs"))?;
        let got = costs.iter().filter(|it| **it == cost).count();
        differences.same(format_args!("{when}, cells with {cost}"), &got, &expected.count()?);
    }
    Ok(())
}

/// What the tests of the peer assert.
fn assert_as_peer(
    got: &State,
    asserts: &Reader<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    if asserts.is_null() {
        return Ok(());
    }
    let costmap = &got.costmap;
    for (name, expected) in asserts.members()? {
        match name {
            "note" => {}
            "counts" => compare_counts("the peer's test", costmap.costs(), &expected, differences)?,
            "non_free" => {
                let count = costmap.costs().iter().filter(|cost| **cost != 0).count();
                differences.same("cells that are not free", &count, &expected.count()?);
            }
            "cells" | "at_least" | "less_than" => {
                for (cell, cost) in expected.members()? {
                    let at = cell_named(cell).ok_or_else(|| expected.unreadable("cells"))?;
                    let (got, cost) = (costmap.cost(at), cost.byte()?);
                    let holds = got.is_some_and(|got| match name {
                        "cells" => got == cost,
                        "at_least" => got >= cost,
                        _ => got < cost,
                    });
                    differences.same(
                        format_args!("{name} {cost} at {cell}: {got:?}"),
                        &holds,
                        &true,
                    );
                }
            }
            _ => return Err(asserts.unreadable("assertions that are known")),
        }
    }
    Ok(())
}

/// A cell written `x,y`.
fn cell_named(text: &str) -> Option<Cell> {
    let (x, y) = text.split_once(',')?;
    Some((x.trim().parse().ok()?, y.trim().parse().ok()?))
}
