//! Laser scans of CARMEN logs.

use std::io::BufRead as _;
use std::path::Path;

use periplus::bags::{CarmenLog, is_carmen, read_carmen_from};
use periplus::geometry::{LaserScan2, Pose2};
use periplus_session::files;
use pyo3::prelude::*;

use crate::errors::{file_error, require_file};
use crate::estimator_parameters::warn;
use crate::work::released;

/// Number of malformed lines that are reported one by one.
const MAX_REPORTED_COUNT: usize = 20;

/// Scans of a log with the odometry at each.
pub(super) fn read(py: Python<'_>, path: &Path) -> PyResult<Vec<(LaserScan2, Option<Pose2>)>> {
    require_file(path)?;
    let log = released(py, "Slam.from_log", || open(path))?;
    let log = log.map_err(|error| file_error(py, path, error))?;
    for (line, fault) in log.faults.iter().take(MAX_REPORTED_COUNT) {
        warn(py, &format!("{}:{line}: {fault}", path.display()))?;
    }
    let (_, scans) = log.scans_of_first_kind();
    if scans.is_empty() {
        return Err(file_error(py, path, "the log has no scans"));
    }
    let both = scans.into_iter().map(|scan| {
        let odom_from_base = scan.odom_from_base;
        (scan.into(), odom_from_base)
    });
    Ok(both.collect())
}

fn open(path: &Path) -> Result<CarmenLog, String> {
    let mut text = files::reader(path).map_err(|error| error.to_string())?;
    match text.fill_buf() {
        Ok(head) if is_carmen(head) => {
            read_carmen_from(&mut text).map_err(|error| error.to_string())
        }
        Ok(_) => {
            Err("this is no CARMEN log (FLASER, RAWLASER, ROBOTLASER1 lines); map a recording \
                      with `periplus slam`, or scan by scan"
                .into())
        }
        Err(error) => Err(error.to_string()),
    }
}
