//! Filters.

use periplus_costmap::filters::{
    BinaryFilter, FilterInfo, FilterKind, FilterMask, KeepoutFilter, MaskFilter, SpeedFilter,
};
use periplus_costmap::{
    CellWindow, Costmap, Footprint, Layer, NoTransforms, TransformSource, UpdateBounds,
    UpdateContext, tables,
};
use periplus_geometry::{Pose, Pose2};
use periplus_grid::{GridInfo, OccupancyGrid};
use periplus_params::{ParamValues, Table};
use serde_json::{Value, json};

use super::super::Setting;
use super::{
    compat_of, costmap_of, counts_of, map_of, points_of, pose_of, rows_of, values_among, values_of,
    window_of,
};
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

const GLOBAL: &str = "map";
const MASK: &str = "mask";

/// Pose of the mask.
struct Shifted(Pose);

impl TransformSource for Shifted {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        match (target, source) {
            (MASK, GLOBAL) => Some(self.0),
            _ => NoTransforms.latest(target, source),
        }
    }
}

/// A moment with a robot somewhere.
fn with_moment<T>(
    distro: &str,
    robot: Pose2,
    info: GridInfo,
    frames: &dyn TransformSource,
    use_it: impl FnOnce(&UpdateContext<'_>) -> T,
) -> Result<T, Unreadable> {
    Ok(use_it(&UpdateContext {
        now_ns: 0,
        robot,
        footprint: &Footprint::default(),
        info,
        is_rolling: false,
        compat: compat_of(distro)?,
        global_frame: GLOBAL,
        frames,
    }))
}

/// Kind `keepout_filter`: windows one after the other.
pub(in super::super) fn check_keepout(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut master = costmap_of(&given.get("master")?, "fill")?;
    let before = master.clone();
    let shift = given.find("mask_frame_from_global_translation");
    let [x_m, y_m] = shift.map_or(Ok([0.0, 0.0]), |it| it.array())?;
    let frames = Shifted(Pose::from_xyz(x_m, y_m, 0.0));
    let frame = if [x_m, y_m] == [0.0, 0.0] { GLOBAL } else { MASK };
    let values = values_of(&tables::KEEPOUT, &[], given.find("params").as_ref())?;
    let mut filter = KeepoutFilter::new("keepout", values);
    filter.set_info(info_of(&given, FilterKind::Keepout)?);
    filter.set_mask(FilterMask { grid: map_of(&given.get("mask")?)?, frame: frame.to_owned() });
    let windows = given.get("windows")?.each(window_of)?;
    let poses = match (given.find("poses"), given.find("pose")) {
        (Some(poses), _) => poses.each(pose_of)?,
        (None, Some(pose)) => vec![pose_of(&pose)?; windows.len()],
        (None, None) => vec![Pose2::IDENTITY; windows.len()],
    };
    if poses.len() != windows.len() {
        return Err(given.unreadable("one with a pose for each window"));
    }
    let (mut counts, mut grids) = (Vec::new(), Vec::new());
    for (window, robot) in windows.into_iter().zip(poses) {
        with_moment(distro, robot, *master.info(), &frames, |moment| {
            filter.bounds(moment, &mut UpdateBounds::default());
            filter.costs(moment, &mut master, window);
        })?;
        let pairs = before.costs().iter().zip(master.costs());
        counts.push(pairs.filter(|(old, new)| old != new).count());
        grids.push(rows_of(&master));
    }
    let (mut changed, mut new_costs, mut other_costs) = (Vec::new(), Vec::new(), Vec::new());
    for index in 0..master.info().len() {
        let (x, y) = master.info().cell(index);
        let cost = master.costs()[index];
        if cost == before.costs()[index] {
            other_costs.push(cost);
        } else {
            changed.push(json!([x, y]));
            new_costs.push(cost);
        }
    }
    for (name, expected) in expect.members()? {
        match name {
            "changed_cells_after_each_window" => {
                differences.compare("changed cells", &json!(counts), &expected);
            }
            "changed_cells" => differences.compare_sets(name, changed.clone(), &expected),
            "changed_value" => differences.compare(name, &only(&new_costs), &expected),
            "other_value" => differences.compare(name, &only(&other_costs), &expected),
            "grid" => differences.compare("costs", &rows_of(&master), &expected),
            "grid_after_each_window" => differences.compare(name, &json!(grids), &expected),
            "counts" => differences.compare(name, &counts_of(&master), &expected),
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}

/// The cost that all of some cells have; null if there are none, and all costs if they differ.
fn only(costs: &[u8]) -> Value {
    match costs {
        [] => Value::Null,
        [first, rest @ ..] if rest.iter().all(|cost| cost == first) => json!(first),
        _ => json!(costs),
    }
}

/// A mask with one cell for each of some values, and the robot on each of them in turn; or a mask and
/// poses.
fn masks_and_poses(given: &CaseReader<'_>) -> Result<Vec<(FilterMask, Pose2)>, Unreadable> {
    if let Some(values) = given.find("mask_values") {
        let info = GridInfo { resolution_m: 1.0, width: 1, height: 1, origin: Pose2::IDENTITY };
        return values.each(|value| {
            let number = i8::try_from(value.integer()?)
                .map_err(|_| value.unreadable("a number from -128 to 127"))?;
            let grid = OccupancyGrid::new(info, number);
            Ok((FilterMask { grid, frame: GLOBAL.to_owned() }, Pose2::new(0.5, 0.5, 0.0)))
        });
    }
    let mask = FilterMask { grid: map_of(&given.get("mask")?)?, frame: GLOBAL.to_owned() };
    given.get("poses")?.each(|pose| Ok((mask.clone(), pose_of(pose)?)))
}

fn info_of(given: &CaseReader<'_>, kind: FilterKind) -> Result<FilterInfo, Unreadable> {
    let kind = match given.find("type") {
        Some(number) => FilterKind::from_number(number.byte()?)
            .ok_or_else(|| number.unreadable("a type of filter"))?,
        None => kind,
    };
    Ok(FilterInfo {
        kind,
        base: super::number(given, "base", 0.0)?,
        multiplier: super::number(given, "multiplier", 1.0)?,
    })
}

/// Lets a filter look at the mask where the robot is; it has no costmap to change.
fn run(filter: &mut dyn Layer, distro: &str, robot: Pose2) -> Result<(), Unreadable> {
    let mut master = Costmap::empty(0);
    with_moment(distro, robot, *master.info(), &NoTransforms, |moment| {
        filter.bounds(moment, &mut UpdateBounds::default());
        filter.costs(moment, &mut master, CellWindow::default());
    })
}

/// Parameters of a filter, in `params` or among what is given.
fn filter_values(table: &'static Table, given: &CaseReader<'_>) -> Result<ParamValues, Unreadable> {
    match given.find("params") {
        Some(params) => values_of(table, &[], Some(&params)),
        None => values_among(table, given),
    }
}

/// A value for each of some poses: a list, or one number for all.
fn per_pose(
    given: &CaseReader<'_>,
    names: &[&str],
    count: usize,
) -> Result<Option<Vec<f64>>, Unreadable> {
    let Some(found) = given.find_any(names) else { return Ok(None) };
    let values = match found.number() {
        Ok(value) => vec![value; count],
        Err(_) => found.numbers()?,
    };
    if values.len() != count {
        return Err(found.unreadable("a number for each pose"));
    }
    Ok(Some(values))
}

/// Kind `speed_filter`: speed limits along a path over a mask.
pub(in super::super) fn check_speed(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut filter = SpeedFilter::new("speed", filter_values(&tables::SPEED, &given)?);
    filter.set_info(info_of(&given, FilterKind::SpeedPercent)?);
    if let Some(path) = given.find_any(&["path", "plan"]) {
        filter.set_path(points_of(&path)?);
    }
    let places = masks_and_poses(&given)?;
    let speeds =
        per_pose(&given, &["speed", "speeds", "velocity", "linear_velocity"], places.len())?;
    let (mut limits, mut published, mut percentages) = (Vec::new(), Vec::new(), Vec::new());
    let mut limit = 0.0;
    for (at, (mask, robot)) in places.into_iter().enumerate() {
        if let Some(speeds) = &speeds {
            filter.set_speed(speeds[at]);
        }
        filter.set_mask(mask);
        run(&mut filter, distro, robot)?;
        let outgoing = filter.take_limit();
        published.push(outgoing.is_some());
        percentages.extend(outgoing.map(|outgoing| outgoing.is_percentage));
        limit = outgoing.map_or(limit, |outgoing| outgoing.limit);
        limits.push(limit);
    }
    let end = |limit: Option<&f64>| limit.map_or(Value::Null, |limit| number(*limit));
    // One answer for all messages, or one for each.
    let percentage = match expect.find("percentage") {
        Some(expected) if !expected.is_list() => {
            percentages.dedup();
            if percentages.len() == 1 { json!(percentages[0]) } else { json!(percentages) }
        }
        _ => json!(percentages),
    };
    differences.compare_members(
        &[
            (&["limits"], numbers(limits.iter().copied())),
            (&["published"], json!(published)),
            (&["limit_first"], end(limits.first())),
            (&["limit_last"], end(limits.last())),
            (&["percentage"], percentage),
            (&["published_count"], json!(published.iter().filter(|it| **it).count())),
        ],
        &expect,
    );
    Ok(())
}

/// Kind `binary_filter`: states along a path over a mask.
pub(in super::super) fn check_binary(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let values = filter_values(&tables::BINARY, &given)?;
    let default_state = values.flag("default_state").unwrap_or_default();
    let mut filter = BinaryFilter::new("binary", values);
    filter.set_info(info_of(&given, FilterKind::Binary)?);
    let first = filter.take_state();
    if first != Some(default_state) {
        differences.push(format!("state at the start: {first:?}, expected {default_state}"));
    }
    let (mut states, mut published) = (Vec::new(), Vec::new());
    for (mask, robot) in masks_and_poses(&given)? {
        filter.set_mask(mask);
        run(&mut filter, distro, robot)?;
        published.push(filter.take_state().is_some());
        states.push(filter.state());
    }
    differences.compare_members(
        &[
            (&["state", "states"], json!(states)),
            (&["published"], json!(published)),
            (&["state_first", "initial_state"], json!(first)),
            (&["state_last"], json!(states.last())),
        ],
        &expect,
    );
    Ok(())
}
