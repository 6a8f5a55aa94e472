//! Goal checkers of local planners, which in ROS 1 decide about the goal themselves.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_params::{ParamValue, ParamValues};

use super::{
    DWA_PLANNER, DwaPlannerParams, TEB_PLANNER, TRAJECTORY_PLANNER, TebPlannerParams,
    TrajectoryPlannerParams,
};
use crate::PluginSetup;
use crate::goal_checker::{
    GoalChecker, SIMPLE_GOAL_CHECKER, STOPPED_GOAL_CHECKER, SimpleGoalChecker,
};

/// Tolerances of a local planner.
struct LocalGoal {
    xy_m: f64,
    yaw_rad: f64,
    latches: bool,
    /// Speed and turn rate at which the robot must be.
    stopped: Option<(f64, f64)>,
}

/// Creates the goal checker of a local planner of ROS 1 from the planner's parameters: position, heading, and for
/// DWAPlannerROS and TEB standstill. None for other classes.
#[must_use]
pub fn create_local_goal_checker(
    class: &str,
    setup: &PluginSetup<'_>,
) -> Option<Box<dyn GoalChecker>> {
    // The planner itself reports findings about the same parameters.
    let ignored = &mut Diagnostics::new();
    let name = class.rsplit(['/', ':']).next().unwrap_or(class);
    let goal = match name {
        "DWAPlannerROS" => {
            let params = DwaPlannerParams::from_values(&setup.read(&DWA_PLANNER, ignored));
            LocalGoal {
                xy_m: params.xy_goal_tolerance_m,
                yaw_rad: params.yaw_goal_tolerance_rad,
                latches: params.latch_xy_goal_tolerance,
                stopped: Some((params.trans_stopped_vel_m_s, params.theta_stopped_vel_rad_s)),
            }
        }
        "TrajectoryPlannerROS" => {
            let values = setup.read(&TRAJECTORY_PLANNER, ignored);
            let params = TrajectoryPlannerParams::from_values(&values);
            LocalGoal {
                xy_m: params.xy_goal_tolerance_m,
                yaw_rad: params.yaw_goal_tolerance_rad,
                latches: params.latch_xy_goal_tolerance,
                stopped: None,
            }
        }
        "TebLocalPlannerROS" => {
            let params = TebPlannerParams::from_values(&setup.read(&TEB_PLANNER, ignored));
            let stopped = (params.trans_stopped_vel_m_s, params.theta_stopped_vel_rad_s);
            LocalGoal {
                xy_m: params.xy_goal_tolerance_m,
                yaw_rad: params.yaw_goal_tolerance_rad,
                latches: false,
                stopped: (!params.free_goal_vel).then_some(stopped),
            }
        }
        _ => return None,
    };
    Some(Box::new(checker(&goal)))
}

fn checker(goal: &LocalGoal) -> SimpleGoalChecker {
    let table = if goal.stopped.is_some() { &STOPPED_GOAL_CHECKER } else { &SIMPLE_GOAL_CHECKER };
    let mut values = ParamValues::defaults(table);
    values.set("xy_goal_tolerance", ParamValue::Number(goal.xy_m));
    values.set("yaw_goal_tolerance", ParamValue::Number(goal.yaw_rad));
    values.set("stateful", ParamValue::Bool(goal.latches));
    if let Some((speed_m_s, rate_rad_s)) = goal.stopped {
        values.set("trans_stopped_velocity", ParamValue::Number(speed_m_s));
        values.set("rot_stopped_velocity", ParamValue::Number(rate_rad_s));
    }
    // Before main the length of the plan does not count.
    SimpleGoalChecker::new(values, Nav2Release::Jazzy)
}
