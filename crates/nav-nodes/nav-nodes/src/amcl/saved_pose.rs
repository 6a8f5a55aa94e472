//! Saved pose that survives a restart of the node.

use std::path::PathBuf;

use periplus_geometry::Pose2;
use periplus_localization::{Covariance2, SavedPose};
use periplus_params::ParamValues;

use crate::Files;

/// Standard deviations of a saved pose: the robot may have been pushed.
const SAVED_STD_M: f64 = 0.5;
const SAVED_STD_RAD: f64 = 0.26;

/// Path of the saved pose: the parameter, otherwise `amcl_saved_pose` in the folder for temporary
/// files, as in Nav2. None if saved poses are not in use.
pub(crate) fn path(values: &ParamValues, files: &dyn Files) -> Option<PathBuf> {
    let given = values.text("saved_pose_filepath").unwrap_or_default();
    if !given.is_empty() {
        return Some(PathBuf::from(given));
    }
    let is_wanted = values.flag("initialize_at_saved_pose").unwrap_or_default()
        || values.is_given("save_pose_rate");
    let folder = || files.variable("TMPDIR").unwrap_or_else(|| "/tmp".into());
    is_wanted.then(|| PathBuf::from(folder()).join("amcl_saved_pose"))
}

/// Reads the saved pose, if there is one. The error is a description.
pub(crate) fn read(
    values: &ParamValues,
    files: &dyn Files,
    global_frame: &str,
) -> Result<Option<(Pose2, Covariance2)>, String> {
    let Some(path) = path(values, files) else { return Ok(None) };
    if files.kind(&path).is_none() {
        return Ok(None);
    }
    let why = |why: String| format!("the saved pose {} is not used: {why}", path.display());
    let bytes = files.read(&path).map_err(|error| why(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| why("it is not UTF-8 text".into()))?;
    let saved = SavedPose::parse(&text).map_err(|error| why(error.to_string()))?;
    if saved.frame != global_frame {
        return Err(why(format!(
            "its frame is `{}`, that of the map is `{global_frame}`",
            saved.frame
        )));
    }
    let variance_m2 = SAVED_STD_M * SAVED_STD_M;
    let yaw = SAVED_STD_RAD * SAVED_STD_RAD;
    let covariance = Covariance2 { xx: variance_m2, xy: 0.0, yy: variance_m2, yaw };
    Ok(Some((saved.pose, covariance)))
}

/// Saves a pose. The error is a description.
pub(crate) fn write(
    values: &ParamValues,
    files: &dyn Files,
    frame: &str,
    pose: Pose2,
    time_ns: i64,
) -> Result<(), String> {
    let Some(path) = path(values, files) else { return Ok(()) };
    let saved = SavedPose { time_ns, frame: frame.to_owned(), pose, z_m: 0.0 };
    files
        .replace(&path, saved.to_text().as_bytes())
        .map_err(|error| format!("the pose cannot be saved to {}: {error}", path.display()))
}
