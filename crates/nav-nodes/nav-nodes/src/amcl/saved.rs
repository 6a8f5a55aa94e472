//! The pose that outlives a restart.

use std::path::PathBuf;

use periplus_geometry::Pose2;
use periplus_localization::{Covariance2, SavedPose};
use periplus_params::ParamValues;

use crate::Files;

/// How uncertain a saved pose is: the robot may have been pushed \[m\], \[rad\].
const SAVED: (f64, f64) = (0.5, 0.26);

/// Where the pose is saved: what the parameter says, otherwise `amcl_saved_pose` in the folder for
/// temporary files, where Nav2 has it. None when nothing asks for it.
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

/// The saved pose, if there is one; in words why it cannot be used.
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
    let text = String::from_utf8(bytes).map_err(|_| why("it is no text".into()))?;
    let saved = SavedPose::read(&text).map_err(|error| why(error.to_string()))?;
    if saved.frame != global_frame {
        return Err(why(format!("it is in `{}`, the map is `{global_frame}`", saved.frame)));
    }
    let (place, turn) = SAVED;
    let covariance =
        Covariance2 { xx: place * place, xy: 0.0, yy: place * place, yaw: turn * turn };
    Ok(Some((saved.pose, covariance)))
}

/// Saves a pose; in words why it cannot be.
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
