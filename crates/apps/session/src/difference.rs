//! Difference of two recordings: their topics, maps and trajectories.

mod topics;

use periplus_bags::files::{Bag, BagError};
use periplus_geometry::Pose2;
use periplus_grid::{Grid, GridInfo, OccupancyGrid};
use periplus_maps::from_message;
use periplus_msgs::nav_msgs;
use serde_json::{Value, json};

use crate::recorded::{RecordedFrames, each, has_type};

pub use topics::{MessageDifference, TopicDifference, ValueDifference, compare_topics};

/// Minimum occupancy of a wall \[%\], as in the maps of `slam_toolbox`.
const MIN_WALL_OCCUPANCY: i8 = 50;

/// Maximum number of cells of a comparison.
const MAX_CELL_COUNT: usize = 64_000_000;

/// Maximum number of poses of a trajectory that are compared.
const MAX_POSE_COUNT: usize = 2000;

/// State of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapCellState {
    /// Not observed, or outside of the map.
    #[default]
    Unknown,
    /// Free.
    Free,
    /// Occupied.
    Wall,
}

/// Cell of two maps: its state in the first and in the second.
pub type MapCellPair = (MapCellState, MapCellState);

/// Difference of two maps on the cells of the first.
#[derive(Clone, Debug)]
pub struct MapDifference {
    /// States in both maps, around both.
    pub cells: Grid<MapCellPair>,
    /// Cells that both maps know.
    pub known_count: usize,
    /// Cells that are free in one map and a wall in the other.
    pub changed_count: usize,
    /// Cells that only the first, or only the second map knows.
    pub only_first_count: usize,
    /// Cells that only the second map knows.
    pub only_second_count: usize,
}

/// Distance of two trajectories over time.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryDifference {
    /// Frame of the poses.
    pub frame: String,
    /// True if the recordings are of different times, so that times since their starts are compared.
    pub is_since_start: bool,
    /// Time \[s\] since the start and distance \[m\].
    pub distances_m: Vec<(f64, f64)>,
    /// Root mean square of the distances \[m\].
    pub rms_m: f64,
    /// Maximum distance \[m\].
    pub max_m: f64,
}

/// Difference of two recordings.
#[derive(Clone, Debug, Default)]
pub struct RecordingDifference {
    /// Difference of the last maps; none if one of them has none.
    pub map: Option<MapDifference>,
    /// Difference of the trajectories; none if they have no frame in common.
    pub trajectory: Option<TrajectoryDifference>,
}

impl RecordingDifference {
    /// Compares two recordings.
    ///
    /// # Errors
    /// When one of them cannot be read.
    pub fn of(first: &Bag, second: &Bag) -> Result<Self, BagError> {
        let maps = (last_map(first)?, last_map(second)?);
        let frames = (RecordedFrames::read(first)?, RecordedFrames::read(second)?);
        let map = match &maps {
            (Some(first), Some(second)) => compare_maps(first, second),
            _ => None,
        };
        Ok(Self { map, trajectory: compare_frames(&frames.0, &frames.1) })
    }

    /// Returns the numbers as JSON, as the page gets them; a missing part is null.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let map = self.map.as_ref().map(|map| {
            json!({
                "knownCount": map.known_count,
                "changedCount": map.changed_count,
                "onlyFirstCount": map.only_first_count,
                "onlySecondCount": map.only_second_count,
                "resolutionM": map.cells.info.resolution_m,
            })
        });
        let trajectory = self.trajectory.as_ref().map(|it| {
            let (times, distances): (Vec<f64>, Vec<f64>) = it.distances_m.iter().copied().unzip();
            json!({
                "frame": it.frame,
                "isSinceStart": it.is_since_start,
                "timesS": times,
                "distancesM": distances,
                "rmsM": it.rms_m,
                "maxM": it.max_m,
            })
        });
        json!({ "map": map, "trajectory": trajectory })
    }
}

/// Last map of a recording, from the topic `/map` or another whose name ends so.
///
/// # Errors
/// When the recording cannot be read.
pub fn last_map(bag: &Bag) -> Result<Option<OccupancyGrid>, BagError> {
    let maps = || bag.topics().iter().filter(|topic| has_type(topic, "OccupancyGrid"));
    let named = maps().find(|topic| topic.name == "/map");
    let topic = named.or_else(|| maps().find(|topic| topic.name.ends_with("/map")));
    let Some(topic) = topic else { return Ok(None) };
    let mut last = None;
    each::<nav_msgs::OccupancyGrid>(bag, &[topic.name.as_str()], |_, map| last = Some(map))?;
    Ok(last.and_then(|map| from_message(&map).ok()))
}

fn state_of(value: i8) -> MapCellState {
    match value {
        MIN_WALL_OCCUPANCY.. => MapCellState::Wall,
        0.. => MapCellState::Free,
        _ => MapCellState::Unknown,
    }
}

/// Compares two maps in one frame; none if they are too far from each other.
#[must_use]
pub fn compare_maps(first: &OccupancyGrid, second: &OccupancyGrid) -> Option<MapDifference> {
    let first_from_world = first.info.origin.inverse();
    let side_m = first.info.resolution_m;
    // Corners of the second map in cells of the first.
    let (width, height) = (second.info.width as f64, second.info.height as f64);
    let corners =
        [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)].map(|(column, row)| {
            let (x, y) = second.info.point_at(column, row);
            let point = first_from_world * Pose2::new(x, y, 0.0);
            (point.x_m / side_m, point.y_m / side_m)
        });
    let low = corners.iter().fold((0.0_f64, 0.0_f64), |a, b| (a.0.min(b.0), a.1.min(b.1)));
    let size = (first.info.width as f64, first.info.height as f64);
    let high = corners.iter().fold(size, |a, b| (a.0.max(b.0), a.1.max(b.1)));
    // A hair less, so that equal grids keep their cells.
    let (left, down) = ((low.0 + 1e-6).floor(), (low.1 + 1e-6).floor());
    let (right, up) = ((high.0 - 1e-6).ceil(), (high.1 - 1e-6).ceil());
    let columns = right - left;
    let rows = up - down;
    let cell_count = columns * rows;
    if !cell_count.is_finite() || cell_count > MAX_CELL_COUNT as f64 {
        return None;
    }
    let origin = first.info.origin * Pose2::new(left * side_m, down * side_m, 0.0);
    let info = GridInfo::new(side_m, columns as usize, rows as usize, origin).ok()?;
    let mut difference = MapDifference {
        cells: Grid::new(info, MapCellPair::default()),
        known_count: 0,
        changed_count: 0,
        only_first_count: 0,
        only_second_count: 0,
    };
    let (first_finder, second_finder) = (first.info.finder(), second.info.finder());
    for index in 0..info.len() {
        let (column, row) = info.cell(index);
        let (x, y) = info.point_at(column as f64 + 0.5, row as f64 + 0.5);
        let value = |map: &OccupancyGrid, cell: Option<(usize, usize)>| {
            cell.and_then(|cell| map.get(cell))
                .map_or(MapCellState::Unknown, |value| state_of(*value))
        };
        let a = value(first, first_finder.cell_of(x, y));
        let b = value(second, second_finder.cell_of(x, y));
        match (a, b) {
            (MapCellState::Unknown, MapCellState::Unknown) => {}
            (MapCellState::Unknown, _) => difference.only_second_count += 1,
            (_, MapCellState::Unknown) => difference.only_first_count += 1,
            (a, b) => {
                difference.known_count += 1;
                difference.changed_count += usize::from(a != b);
            }
        }
        difference.cells[(column, row)] = (a, b);
    }
    Some(difference)
}

/// Compares the poses of the robot in `map`, or else in `odom`.
fn compare_frames(first: &RecordedFrames, second: &RecordedFrames) -> Option<TrajectoryDifference> {
    let base = |frames: &RecordedFrames| frames.base("odom", None);
    let (first_base, second_base) = (base(first)?, base(second)?);
    ["map", "odom"].into_iter().find_map(|frame| {
        let tracks = [
            first.track(frame, &first_base, MAX_POSE_COUNT),
            second.track(frame, &second_base, MAX_POSE_COUNT),
        ];
        compare_tracks(frame, &tracks[0], &tracks[1])
    })
}

/// Compares two tracks at the times of the first. Recordings of different times are compared by the time since their
/// starts.
#[must_use]
pub fn compare_tracks(
    frame: &str,
    first: &[(i64, Pose2)],
    second: &[(i64, Pose2)],
) -> Option<TrajectoryDifference> {
    let (start_ns, end_ns) = (first.first()?.0, first.last()?.0);
    let (other_start_ns, other_end_ns) = (second.first()?.0, second.last()?.0);
    let is_since_start = other_start_ns > end_ns || other_end_ns < start_ns;
    let offset_ns = if is_since_start { other_start_ns - start_ns } else { 0 };
    let distances_m: Vec<(f64, f64)> = first
        .iter()
        .filter_map(|(time_ns, pose)| {
            let other = pose_at(second, time_ns + offset_ns)?;
            let distance_m = libm::hypot(pose.x_m - other.x_m, pose.y_m - other.y_m);
            Some(((time_ns - start_ns) as f64 * 1e-9, distance_m))
        })
        .collect();
    if distances_m.is_empty() {
        return None;
    }
    let squares: f64 = distances_m.iter().map(|(_, distance)| distance * distance).sum();
    let rms_m = (squares / distances_m.len() as f64).sqrt();
    let max_m = distances_m.iter().fold(0.0, |max: f64, (_, distance)| max.max(*distance));
    let frame = frame.to_owned();
    Some(TrajectoryDifference { frame, is_since_start, distances_m, rms_m, max_m })
}

/// Interpolated position; none outside of the track. The yaw is that of the earlier pose.
fn pose_at(track: &[(i64, Pose2)], time_ns: i64) -> Option<Pose2> {
    let next = track.partition_point(|(at_ns, _)| *at_ns < time_ns);
    let (after_ns, after) = *track.get(next)?;
    if after_ns == time_ns {
        return Some(after);
    }
    let (before_ns, before) = *track.get(next.checked_sub(1)?)?;
    let part = (time_ns - before_ns) as f64 / (after_ns - before_ns) as f64;
    let between = |from: f64, to: f64| from + part * (to - from);
    Some(Pose2::new(between(before.x_m, after.x_m), between(before.y_m, after.y_m), before.yaw_rad))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map of 0.5 m cells, rows from the lowest: `#` wall, `.` free, `?` unknown.
    fn map(x_m: f64, rows: [&str; 2]) -> OccupancyGrid {
        let info = GridInfo::new(0.5, rows[0].len(), 2, Pose2::new(x_m, 0.0, 0.0)).unwrap();
        let mut map = Grid::new(info, -1_i8);
        for (row, text) in rows.iter().enumerate() {
            for (column, cell) in text.chars().enumerate() {
                map[(column, row)] = match cell {
                    '#' => 100,
                    '.' => 0,
                    _ => -1,
                };
            }
        }
        map
    }

    fn counts(first: &OccupancyGrid, second: &OccupancyGrid) -> [usize; 4] {
        let it = compare_maps(first, second).unwrap();
        [it.known_count, it.changed_count, it.only_first_count, it.only_second_count]
    }

    #[test]
    fn cells_are_compared_where_both_maps_know_them() {
        let first = map(0.0, ["..#", "???"]);
        assert_eq!(counts(&first, &first), [3, 0, 0, 0]);
        assert_eq!(counts(&first, &map(0.0, [".##", "?.?"])), [3, 1, 0, 1]);
        // One cell to the right: the second's first column is the first's second.
        assert_eq!(counts(&first, &map(0.5, ["#.#", "???"])), [2, 2, 1, 1]);
    }

    #[test]
    fn a_coarser_map_is_compared_at_the_centres_of_cells() {
        let info = GridInfo::new(1.0, 1, 1, Pose2::IDENTITY).unwrap();
        let coarse = Grid::new(info, 0_i8);
        assert_eq!(counts(&map(0.0, ["..", "#."]), &coarse), [4, 1, 0, 0]);
    }

    #[test]
    fn trajectories_are_compared_at_equal_times() {
        let line = |start_ns: i64, y_m: f64| -> Vec<(i64, Pose2)> {
            (0..5).map(|step| (start_ns + step * 10, Pose2::new(step as f64, y_m, 0.0))).collect()
        };
        let of = |second: &[(i64, Pose2)]| compare_tracks("map", &line(0, 0.0), second).unwrap();
        let beside = of(&line(0, 3.0));
        assert_eq!((beside.rms_m, beside.max_m, beside.distances_m.len()), (3.0, 3.0, 5));
        // Half a step later the other robot is half a metre behind; its first time is outside.
        let later = of(&line(5, 0.0));
        assert_eq!((later.rms_m, later.distances_m.len(), later.is_since_start), (0.5, 4, false));
        let another_day = of(&line(1_000_000, 0.0));
        assert_eq!((another_day.rms_m, another_day.is_since_start), (0.0, true));
        assert_eq!(compare_tracks("map", &line(0, 0.0), &[]), None);
    }
}
