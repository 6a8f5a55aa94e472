//! Filters.

use periplus_base::{Pose, Pose2};
use periplus_costmap::filters::{
    BinaryFilter, FilterInfo, FilterKind, KeepoutFilter, Mask, Masked, SpeedFilter,
};
use periplus_costmap::{
    Bounds, Costmap, Footprint, Frames, Layer, Moment, NoFrames, Window, tables,
};
use periplus_grid::{Lattice, OccupancyGrid};

use super::super::Setting;
use super::{compat_of, costmap_of, map_of, number, pose_of, truth, values_of, window_of};
use crate::{Case, Differences, Reader, Unreadable};

const GLOBAL: &str = "map";
const MASK: &str = "mask";

/// Where the mask is.
struct Shifted(Pose);

impl Frames for Shifted {
    fn latest(&self, target: &str, source: &str) -> Option<Pose> {
        match (target, source) {
            (MASK, GLOBAL) => Some(self.0),
            _ => NoFrames.latest(target, source),
        }
    }
}

/// A moment with a robot somewhere.
fn with_moment<T>(
    distro: &str,
    robot: Pose2,
    lattice: Lattice,
    frames: &dyn Frames,
    use_it: impl FnOnce(&Moment<'_>) -> T,
) -> T {
    use_it(&Moment {
        now_ns: 0,
        robot,
        footprint: &Footprint::default(),
        lattice,
        is_rolling: false,
        compat: compat_of(distro),
        global_frame: GLOBAL,
        frames,
    })
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
    let values = values_of(&tables::KEEPOUT, given.find("params").as_ref())?;
    let mut filter = KeepoutFilter::new("keepout", values);
    filter.set_mask(Mask { grid: map_of(&given.get("mask")?)?, frame: frame.to_owned() });
    let robot = given.find("pose").map_or(Ok(Pose2::IDENTITY), |it| pose_of(&it))?;
    let mut changed = Vec::new();
    for window in given.get("windows")?.list()? {
        let window = window_of(&window)?;
        with_moment(distro, robot, *master.lattice(), &frames, |moment| {
            filter.bounds(moment, &mut Bounds::default());
            filter.costs(moment, &mut master, window);
        });
        let pairs = before.costs().iter().zip(master.costs());
        changed.push(pairs.filter(|(old, new)| old != new).count());
    }
    if let Some(counts) = expect.find("changed_cells_after_each_window") {
        differences.same("changed cells", &changed, &counts.each(Reader::count)?);
    }
    if let Some(cells) = expect.find("changed_cells") {
        let cells = cells.each(Reader::cell)?;
        let value = |name: &str| expect.find(name).map(|it| it.byte()).transpose();
        let (new, other) = (value("changed_value")?, value("other_value")?);
        for index in 0..master.lattice().len() {
            let cell = master.lattice().cell(index);
            let wanted = if cells.contains(&cell) { new } else { other };
            if let Some(wanted) = wanted {
                let got = master.costs()[index].into();
                differences.whole(format_args!("{cell:?}"), got, wanted.into());
            }
        }
    }
    if let Some(rows) = expect.find("grid") {
        let rows: Vec<u8> = rows.each(|row| row.each(Reader::byte))?.concat();
        differences.same("costs", master.costs(), rows.as_slice());
    }
    Ok(())
}

/// A mask with one cell for each of some values, and the robot on each of them in turn; or a mask and
/// poses.
fn masks_and_poses(given: &Reader<'_>) -> Result<Vec<(Mask, Pose2)>, Unreadable> {
    if let Some(values) = given.find("mask_values") {
        let lattice = Lattice { resolution_m: 1.0, width: 1, height: 1, origin: Pose2::IDENTITY };
        return values.each(|value| {
            let number = i8::try_from(value.integer()?)
                .map_err(|_| value.unreadable("a number from -128 to 127"))?;
            let grid = OccupancyGrid::new(lattice, number);
            Ok((Mask { grid, frame: GLOBAL.to_owned() }, Pose2::new(0.5, 0.5, 0.0)))
        });
    }
    let mask = Mask { grid: map_of(&given.get("mask")?)?, frame: GLOBAL.to_owned() };
    given.get("poses")?.each(|pose| Ok((mask.clone(), pose_of(pose)?)))
}

fn info_of(given: &Reader<'_>, kind: FilterKind) -> Result<FilterInfo, Unreadable> {
    let kind = match given.find("type") {
        Some(number) => FilterKind::from_number(number.byte()?)
            .ok_or_else(|| number.unreadable("a type of filter"))?,
        None => kind,
    };
    Ok(FilterInfo {
        kind,
        base: number(given, "base", 0.0)?,
        multiplier: number(given, "multiplier", 1.0)?,
    })
}

/// What a filter does to a costmap that nobody looks at.
fn run(filter: &mut dyn Layer, distro: &str, robot: Pose2) {
    let mut master = Costmap::empty(0);
    with_moment(distro, robot, *master.lattice(), &NoFrames, |moment| {
        filter.bounds(moment, &mut Bounds::default());
        filter.costs(moment, &mut master, Window::default());
    });
}

/// Kind `speed_filter`: limits on the way over a mask.
pub(in super::super) fn check_speed(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut filter = SpeedFilter::new("speed", values_of(&tables::SPEED, None)?);
    filter.set_info(info_of(&given, FilterKind::SpeedPercent)?);
    let (mut limits, mut published) = (Vec::new(), Vec::new());
    let mut limit = 0.0;
    for (mask, robot) in masks_and_poses(&given)? {
        filter.set_mask(mask);
        run(&mut filter, distro, robot);
        let outgoing = filter.take_limit();
        published.push(outgoing.is_some());
        limit = outgoing.map_or(limit, |outgoing| outgoing.limit);
        limits.push(limit);
    }
    if let Some(expected) = expect.find("limits") {
        differences.all_near("limits", &limits, &expected.numbers()?);
    }
    if let Some(expected) = expect.find("published") {
        differences.same("published", &published, &expected.each(Reader::truth)?);
    }
    if let Some(expected) = expect.find("limit_first") {
        differences.near(
            "first limit",
            limits.first().copied().unwrap_or(f64::NAN),
            expected.number()?,
        );
    }
    if let Some(expected) = expect.find("limit_last") {
        differences.near(
            "last limit",
            limits.last().copied().unwrap_or(f64::NAN),
            expected.number()?,
        );
    }
    Ok(())
}

/// Kind `binary_filter`: states on the way over a mask.
pub(in super::super) fn check_binary(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut filter = BinaryFilter::new("binary", values_of(&tables::BINARY, Some(&given))?);
    filter.set_info(info_of(&given, FilterKind::Binary)?);
    let first = filter.take_state();
    differences.same("state at the start", &first, &Some(truth(&given, "default_state", false)?));
    let mut states = Vec::new();
    for (mask, robot) in masks_and_poses(&given)? {
        filter.set_mask(mask);
        run(&mut filter, distro, robot);
        states.push(filter.state());
    }
    let expected = expect.get("state").or(expect.get("states"))?.each(Reader::truth)?;
    differences.same("states", &states, &expected);
    Ok(())
}
