//! Files of a mapping run.

use std::io;
use std::path::Path;

use periplus_geometry::Pose2;
use periplus_maps::{Distro, PgmRows, Saving, render_yaml};
use periplus_slam::{Mapper, Plan};

use super::error::LogMappingError;
use super::pass::MappingPass;
use super::report::MappingReport;
use crate::files;
use crate::picture::draw_by;

/// Number of cells drawn at once, about 3 MB.
const CELLS_AT_ONCE: usize = 1 << 20;

/// Writes all results of a run.
///
/// The trajectory contains the scans of this log; poses of a session precede them.
pub(super) fn write(
    out: &Path,
    pass: &MappingPass,
    report: &MappingReport<'_>,
) -> Result<(), LogMappingError> {
    files::make_folder(out)?;
    let slam = pass.mapper();
    let trajectory = slam.trajectory();
    let lines: String = pass
        .stamps()
        .zip(trajectory.iter().skip(pass.before()))
        .map(|(stamp, (_, pose))| {
            format!("{stamp} {:.6} {:.6} {:.6}\n", pose.x_m, pose.y_m, pose.yaw_rad)
        })
        .collect();
    files::write(&out.join("trajectory.txt"), lines.as_bytes())?;
    let drawn = write_map(out, slam);
    // The report is last, so that it contains the peak memory.
    files::write(&out.join("report.json"), format!("{:#}\n", report.to_json()).as_bytes())?;
    drawn
}

/// Writes the map, and its picture with the trajectory and a ring where passes contradict each other.
fn write_map(out: &Path, slam: &dyn Mapper) -> Result<(), LogMappingError> {
    let plan = slam.plan().ok_or(LogMappingError::TooLarge)?;
    let info = plan.info();
    let saving = Saving::new("map", Distro::Jazzy);
    let (image_path, yaml_path, yaml) = render_yaml(&info, &saving);
    let marked = slam.contradictions().into_iter().map(|it| it.map_from_base);
    let marked: Vec<_> = marked.map(|it| (it.x_m, it.y_m)).collect();
    let mut png = Vec::new();
    files::write_by(&out.join(image_path), |image| {
        let mut rows = PgmRows::begin(image, &info, &saving)?;
        png = draw(&*plan, &poses(slam), &marked, |row| rows.push(row))?;
        Ok(())
    })?;
    files::write(&out.join(yaml_path), yaml.as_bytes())?;
    files::write(&out.join("trajectory.png"), &png)?;
    Ok(())
}

/// Draws the present map as PNG.
pub(super) fn preview(slam: &dyn Mapper) -> Option<Vec<u8>> {
    draw(&*slam.plan()?, &poses(slam), &[], |_| Ok(())).ok()
}

fn poses(slam: &dyn Mapper) -> Vec<Pose2> {
    slam.trajectory().into_iter().map(|(_, pose)| pose).collect()
}

/// Draws map and trajectory, some rows at a time: large maps are never in memory as a whole. `each_row` gets the rows
/// from the top.
fn draw(
    plan: &dyn Plan,
    poses: &[Pose2],
    marked: &[(f64, f64)],
    mut each_row: impl FnMut(&[i8]) -> io::Result<()>,
) -> io::Result<Vec<u8>> {
    let info = plan.info();
    draw_by(info, poses, marked, |picture| {
        let at_once = (CELLS_AT_ONCE / info.width.max(1)).max(1);
        let mut top = info.height;
        while top > 0 {
            let low = top.saturating_sub(at_once);
            for row in plan.rows(low..top).rows().rev() {
                each_row(row)?;
                picture.push(row)?;
            }
            top = low;
        }
        Ok(())
    })
}
