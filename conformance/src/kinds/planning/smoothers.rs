//! Path smoothers without a costmap.

use periplus_geometry::Pose2;
use periplus_planners::{SavitzkyGolaySmoother, SimpleSmoother, SmoothRequest, Smoother, tables};
use serde_json::Value;

use super::super::Setting;
use super::values_of;
use crate::{Case, Differences, Unreadable, numbers};

const REFINEMENT: [&str; 2] = ["do_refinement", "refinement_num"];
const SIMPLE: [&str; 4] = ["w_data", "w_smooth", "tolerance", "max_its"];
const SAVITZKY_GOLAY: [&str; 2] = ["window_size", "poly_order"];

/// The smoothed path.
pub(in crate::kinds) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let name = given.get("smoother")?;
    let mut smoother: Box<dyn Smoother> = match name.text()? {
        "SimpleSmoother" => {
            // Parameters of the other smoother have no effect.
            for other in SAVITZKY_GOLAY {
                given.get(other)?.skip();
            }
            let names = [&SIMPLE[..], &REFINEMENT].concat();
            Box::new(SimpleSmoother::new(values_of(&tables::SIMPLE_SMOOTHER, &given, &names)?))
        }
        "SavitzkyGolaySmoother" => {
            for other in SIMPLE {
                given.get(other)?.skip();
            }
            let names = [&SAVITZKY_GOLAY[..], &REFINEMENT].concat();
            let values = values_of(&tables::SAVITZKY_GOLAY_SMOOTHER, &given, &names)?;
            Box::new(SavitzkyGolaySmoother::new(values))
        }
        _ => return Err(name.unreadable("SimpleSmoother or SavitzkyGolaySmoother")),
    };
    let points = given.get("path")?.each(|point| point.array::<2>())?;
    let path: Vec<Pose2> = points.iter().map(|[x, y]| Pose2::new(*x, *y, 0.0)).collect();
    let is_out_of_time = &mut || false;
    let request = SmoothRequest { path: &path, costmap: None, is_out_of_time };
    let smoothed = smoother.smooth(request).map_err(|error| Unreadable(error.to_string()))?;
    let got: Value = smoothed.iter().map(|pose| numbers([pose.x_m, pose.y_m])).collect();
    differences.compare_members(&[(&["path"], got)], &expect);
    Ok(())
}
