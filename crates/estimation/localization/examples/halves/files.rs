//! Files of the comparison.

use std::collections::BTreeMap;
use std::path::Path;

use periplus_bags::{CarmenScan, read_carmen};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::{LaserScan2, Pose2};
use periplus_grid::OccupancyGrid;
use periplus_images::Raster;
use periplus_maps::{Distro, grid_of, read_description};

/// Poses by their stamps \[us\].
pub(crate) type Way = BTreeMap<i64, Pose2>;

/// Scan of the second half.
pub(crate) struct Seen {
    pub(crate) stamp_us: i64,
    pub(crate) odom_from_base: Pose2,
    pub(crate) scan: LaserScan2,
}

/// Inputs of the comparison.
pub(crate) struct Half {
    /// Map of the first half.
    pub(crate) map: OccupancyGrid,
    /// `whole_from_base` by SLAM on the whole log.
    pub(crate) whole: Way,
    /// `map_from_base` of the first half, by the SLAM that made the map.
    pub(crate) first: Way,
    pub(crate) scans: Vec<Seen>,
}

/// Results of localization.
#[derive(Default)]
pub(crate) struct Found {
    /// `map_from_base` where a pose was known.
    pub(crate) poses: Way,
    /// Start times of states, in order.
    pub(crate) states: Vec<(i64, String)>,
}

impl Half {
    pub(crate) fn read(folder: &Path) -> Result<Self, String> {
        let log = read_carmen(&bytes(&folder.join("second.clf"))?);
        let (_, scans) = log.scans_of_first_kind();
        Ok(Self {
            map: map(&folder.join("map"))?,
            whole: way(&folder.join("whole/trajectory.txt"))?,
            first: way(&folder.join("map/trajectory.txt"))?,
            scans: scans.into_iter().filter_map(seen).collect(),
        })
    }
}

impl Found {
    pub(crate) fn read(folder: &Path) -> Result<Self, String> {
        let report = text(&folder.join("report.json"))?;
        let report: serde_json::Value =
            serde_json::from_str(&report).map_err(|why| format!("{}: {why}", folder.display()))?;
        let changes = report["state_changes"].as_array().into_iter().flatten();
        let state = |change: &serde_json::Value| {
            let stamp = stamp_us(change["stamp"].as_str()?)?;
            Some((stamp, change["state"].as_str()?.to_owned()))
        };
        let poses = way(&folder.join("trajectory.txt"))?;
        Ok(Self { poses, states: changes.filter_map(state).collect() })
    }

    /// State at a time.
    pub(crate) fn state(&self, stamp_us: i64) -> &str {
        let after = self.states.partition_point(|(begin, _)| *begin <= stamp_us);
        after.checked_sub(1).map_or("unset", |index| self.states[index].1.as_str())
    }
}

fn seen(logged: CarmenScan) -> Option<Seen> {
    let odom_from_base = logged.odom_from_base?;
    let stamp_us = (logged.time_s * 1e6).round() as i64;
    Some(Seen { stamp_us, odom_from_base, scan: logged.into() })
}

fn map(folder: &Path) -> Result<OccupancyGrid, String> {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let distro = Distro::default();
    let file = sources.add("map.yaml", text(&folder.join("map.yaml"))?);
    let description = read_description(file, &sources, distro, &mut diagnostics)
        .ok_or_else(|| format!("{}: map.yaml does not describe a map", folder.display()))?;
    let image = folder.join(&description.image);
    let raster =
        Raster::decode(&bytes(&image)?).map_err(|why| format!("{}: {why}", image.display()))?;
    grid_of(&raster.into_shallow(), &description, distro).map_err(|why| why.to_string())
}

/// Stamp, x, y and yaw in every line.
fn way(path: &Path) -> Result<Way, String> {
    let line = |line: &str| {
        let mut words = line.split_whitespace();
        let stamp = stamp_us(words.next()?)?;
        let mut number = || words.next()?.parse().ok();
        Some((stamp, Pose2::new(number()?, number()?, number()?)))
    };
    Ok(text(path)?.lines().filter_map(line).collect())
}

fn stamp_us(word: &str) -> Option<i64> {
    Some((word.parse::<f64>().ok()? * 1e6).round() as i64)
}

fn text(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|why| format!("{}: {why}", path.display()))
}

fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|why| format!("{}: {why}", path.display()))
}
