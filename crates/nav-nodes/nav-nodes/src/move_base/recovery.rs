//! Recoveries of ROS 1.
//!
//! Source: `move_base.cpp`, `clear_costmap_recovery.cpp`, `rotate_recovery.cpp`, `move_slow_and_clear.cpp` (Noetic).

mod clearing;
mod rotation;

use periplus_costmap::CostmapConfig;
use periplus_diagnostics::{Diagnostics, closest};
use periplus_params::params;

use super::params::MoveBaseParams;
use super::values::{PrivateParameters, reading};
pub(super) use clearing::SlowMotion;
pub(super) use rotation::{Rotation, RotationLimits};

params! {
    /// A recovery that clears the costmaps (clear_costmap_recovery/ClearCostmapRecovery).
    #[table(CLEAR_COSTMAP_RECOVERY, "ClearCostmapRecovery")]
    pub struct ClearCostmapParams {
        /// Side of the square around the robot that is kept.
        #[param("reset_distance", unit("m"), min(0.0))]
        reset_distance_m: f64 = 3,
        /// Clears the square instead of the rest.
        #[param("invert_area_to_clear")]
        invert_area_to_clear: bool = false,
        /// Updates the costmaps at once; they follow in their next update in any case.
        #[param("force_updating")]
        _: bool = false,
        /// Costmaps: `global`, `local` or `both`.
        #[param("affected_maps")]
        affected_maps: String = "both",
        /// Names of the layers. The default of ROS is a layer `obstacles`; if there is none, all layers with
        /// obstacles of sensors are cleared.
        #[param("layer_names")]
        layer_names: Vec<String> = "obstacles",
    }
}

params! {
    /// A recovery that turns once around (rotate_recovery/RotateRecovery). Its speed is that of TrajectoryPlannerROS.
    #[table(ROTATE_RECOVERY, "RotateRecovery")]
    pub struct RotateRecoveryParams {
        /// Step of the check for collisions.
        #[param("sim_granularity", unit("rad"), above(0.0))]
        sim_granularity_rad: f64 = 0.017,
        /// Angle before the full turn at which it ends.
        #[param("yaw_goal_tolerance", unit("rad"), min(0.0))]
        yaw_goal_tolerance_rad: f64 = 0.1,
        /// Unused; the rate is `controller_frequency` of the node.
        #[param("frequency", unit("Hz"))]
        _: f64 = 20,
    }
}

params! {
    /// A recovery that clears around the robot and drives slowly (move_slow_and_clear/MoveSlowAndClear).
    #[table(MOVE_SLOW_AND_CLEAR, "MoveSlowAndClear")]
    pub struct MoveSlowAndClearParams {
        /// Half of the side of the square around the robot that is cleared.
        #[param("clearing_distance", unit("m"), min(0.0))]
        clearing_distance_m: f64 = 0.5,
        /// Maximum speed until the robot has moved.
        #[param("limited_trans_speed", unit("m/s"), min(0.0))]
        limited_trans_speed_m_s: f64 = 0.25,
        /// Maximum turn rate until the robot has moved.
        #[param("limited_rot_speed", unit("rad/s"), min(0.0))]
        limited_rot_speed_rad_s: f64 = 0.45,
        /// Distance after which the limits end.
        #[param("limited_distance", unit("m"), min(0.0))]
        limited_distance_m: f64 = 0.3,
        /// Parameter of the local planner with its maximum speed.
        #[param("max_trans_param_name")]
        max_trans_param_name: String = "max_trans_vel",
        /// Parameter of the local planner with its maximum turn rate.
        #[param("max_rot_param_name")]
        max_rot_param_name: String = "max_rot_vel",
        /// Name of the local planner.
        #[param("planner_namespace")]
        planner_namespace: String = "DWAPlannerROS",
        /// Names of the layers. The default of ROS is a layer `obstacles`; if there is none, all layers with
        /// obstacles of sensors are cleared.
        #[param("layer_names")]
        layer_names: Vec<String> = "obstacles",
    }
}

/// A recovery with its name.
#[derive(Clone)]
pub(super) struct Recovery {
    pub(super) name: String,
    pub(super) kind: RecoveryKind,
}

/// Kind of a recovery.
#[derive(Clone)]
pub(super) enum RecoveryKind {
    /// Clears costmaps.
    Clear(ClearCostmapParams),
    /// Clears costmaps beyond four times the circumscribed radius.
    ClearBeyondRobot(ClearCostmapParams),
    /// Turns once around.
    Rotate(RotateRecoveryParams, RotationLimits),
    /// Clears around the robot, and limits the speed.
    MoveSlow(MoveSlowAndClearParams),
}

/// Classes of recoveries.
const CLASSES: [&str; 3] = [
    "clear_costmap_recovery/ClearCostmapRecovery",
    "rotate_recovery/RotateRecovery",
    "move_slow_and_clear/MoveSlowAndClear",
];

/// Reads the recoveries; without a list those of `move_base`.
///
/// # Errors
/// A sentence about a class that does not exist.
pub(super) fn recoveries(
    params: &MoveBaseParams,
    node: &PrivateParameters,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Recovery>, String> {
    if node.entry("recovery_behaviors").is_none() {
        return Ok(default_recoveries(params, node, diagnostics));
    }
    let mut all = Vec::new();
    for name in node.words("recovery_behaviors") {
        let Some(class) = node.text(&format!("{name}.plugin")) else {
            return Err(format!(
                "`recovery_behaviors` names `{name}` without a type; write `{{name: {name}, type: {}}}`",
                CLASSES[0]
            ));
        };
        let mut group = node.group(&name);
        group.remove("plugin");
        let written = class.replace("::", "/");
        let kind = match CLASSES.iter().position(|known| *known == written) {
            Some(0) => RecoveryKind::Clear(clear_params(&group, diagnostics)),
            Some(1) => {
                RecoveryKind::Rotate(rotate_params(&group, diagnostics), RotationLimits::read(node))
            }
            Some(_) => {
                let values = reading(diagnostics, |found| {
                    MOVE_SLOW_AND_CLEAR.check(group.given(), None, found)
                });
                RecoveryKind::MoveSlow(MoveSlowAndClearParams::from_values(&values))
            }
            None => {
                let near = closest(&written, CLASSES.iter().copied());
                let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
                return Err(format!(
                    "the recovery `{name}` has the type `{class}`, which is not supported; known are `{}`{near}",
                    CLASSES.join("`, `")
                ));
            }
        };
        all.push(Recovery { name, kind });
    }
    Ok(all)
}

fn clear_params(group: &PrivateParameters, diagnostics: &mut Diagnostics) -> ClearCostmapParams {
    let values =
        reading(diagnostics, |found| CLEAR_COSTMAP_RECOVERY.check(group.given(), None, found));
    ClearCostmapParams::from_values(&values)
}

fn rotate_params(group: &PrivateParameters, diagnostics: &mut Diagnostics) -> RotateRecoveryParams {
    let values = reading(diagnostics, |found| ROTATE_RECOVERY.check(group.given(), None, found));
    RotateRecoveryParams::from_values(&values)
}

fn default_recoveries(
    params: &MoveBaseParams,
    node: &PrivateParameters,
    diagnostics: &mut Diagnostics,
) -> Vec<Recovery> {
    let clear = |name: &str, diagnostics: &mut Diagnostics| {
        let mut group = node.group(name);
        // The node sets it itself.
        group.remove("reset_distance");
        clear_params(&group, diagnostics)
    };
    let conservative = ClearCostmapParams {
        reset_distance_m: params.conservative_reset_dist_m,
        ..clear("conservative_reset", diagnostics)
    };
    let aggressive = clear("aggressive_reset", diagnostics);
    let rotate = Recovery {
        name: "rotate_recovery".to_owned(),
        kind: RecoveryKind::Rotate(
            rotate_params(&node.group("rotate_recovery"), diagnostics),
            RotationLimits::read(node),
        ),
    };
    let named = |name: &str, kind| Recovery { name: name.to_owned(), kind };
    let mut all = vec![named("conservative_reset", RecoveryKind::Clear(conservative))];
    if params.clearing_rotation_allowed {
        all.push(rotate.clone());
    }
    all.push(named("aggressive_reset", RecoveryKind::ClearBeyondRobot(aggressive)));
    if params.clearing_rotation_allowed {
        all.push(rotate);
    }
    all
}

/// Sets the distance of the aggressive reset by the footprint of the robot.
pub(super) fn measure_robot(recoveries: &mut [Recovery], costmap: &CostmapConfig) {
    for recovery in recoveries {
        if let RecoveryKind::ClearBeyondRobot(params) = &recovery.kind {
            let reset_distance_m = 4.0 * costmap.footprint.circumscribed_radius_m;
            let params = ClearCostmapParams { reset_distance_m, ..params.clone() };
            recovery.kind = RecoveryKind::Clear(params);
        }
    }
}
