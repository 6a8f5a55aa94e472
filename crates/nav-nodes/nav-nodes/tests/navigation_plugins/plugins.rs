//! Plugins as another package would have them.

use periplus_behavior_tree::{
    BehaviorNode, NodeKind, NodeModel, NodeRun, NodeStatus, PortType, TreeError,
};
use periplus_controllers::{ControlError, ControlInput, Controller};
use periplus_geometry::{Pose2, Twist2};
use periplus_nav_nodes::behavior_server::{
    BehaviorAction, BehaviorGoal, BehaviorInput, BehaviorPlugin, CycleOutcome, FailureReason,
    MotionFailure,
};
use periplus_nav_nodes::navigation_plugins::NavigationPlugins;
use periplus_params::{ParamValue, ParamValues, params};
use periplus_planners::{ParameterRejected, PlanError, PlanRequest, PlannedPath, Planner};

params! {
    /// The planner of this test.
    #[table(STRAIGHT_LINE, "straight line")]
    struct StraightLineParams {
        /// Distance between two poses.
        #[param("step", unit("m"), above(0.0))]
        step_m: f64 = 1,
    }
}

/// Poses on the straight line to the goal.
struct StraightLine(ParamValues);

impl Planner for StraightLine {
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
        let step_m = StraightLineParams::from_values(&self.0).step_m;
        let (start, goal) = (request.start, request.goal);
        let length_m = libm::hypot(goal.x_m - start.x_m, goal.y_m - start.y_m);
        let count = libm::round(length_m / step_m) as u32;
        let at = |index: u32| {
            let part = f64::from(index) / f64::from(count.max(1));
            let (dx_m, dy_m) = (goal.x_m - start.x_m, goal.y_m - start.y_m);
            Pose2::new(start.x_m + part * dx_m, start.y_m + part * dy_m, goal.yaw_rad)
        };
        Ok(PlannedPath { poses: (0..=count).map(at).collect(), ..PlannedPath::default() })
    }

    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected> {
        let is_known = self.0.set(name, value.clone());
        is_known.then_some(()).ok_or_else(|| ParameterRejected::Unknown(name.to_owned(), None))
    }

    fn parameters(&self) -> Option<&ParamValues> {
        Some(&self.0)
    }
}

/// Drives straight on for ten cycles.
struct Forward {
    speed_m_s: f64,
    cycles: u32,
}

impl Controller for Forward {
    fn compute_velocity(&mut self, _: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        self.cycles += 1;
        if self.cycles > 10 {
            return Err(ControlError::NoValidControl("ten cycles are over".to_owned()));
        }
        Ok(Twist2::new(self.speed_m_s, 0.0, 0.0))
    }

    fn set_plan(&mut self, _: &[Pose2]) {
        self.cycles = 0;
    }

    fn set_speed_limit(&mut self, _: f64, _: bool) {}
}

/// Fails until it has been ticked a number of times.
#[derive(Default)]
struct CountTo(i64);

impl BehaviorNode for CountTo {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let limit = run.input_i64("limit").ok_or_else(|| run.missing("limit"))?;
        self.0 += 1;
        run.set_output("count", self.0)?;
        Ok(if self.0 < limit { NodeStatus::Failure } else { NodeStatus::Success })
    }
}

/// Turns to the left for 0.3 s.
struct Turn {
    speed_rad_s: f64,
}

impl BehaviorPlugin for Turn {
    fn on_run(&mut self, goal: BehaviorGoal<'_>) -> Result<(), MotionFailure> {
        match goal {
            BehaviorGoal::Spin(goal) if goal.target_yaw > 0.0 => Ok(()),
            other => Err(MotionFailure {
                reason: FailureReason::InvalidInput,
                text: format!("not to the left: {other:?}"),
            }),
        }
    }

    fn on_cycle(&mut self, input: &mut BehaviorInput<'_>) -> CycleOutcome {
        match input.pose() {
            Err(failure) => CycleOutcome::Failed(failure),
            Ok(_) if input.elapsed_ns() >= 300_000_000 => CycleOutcome::Succeeded,
            Ok(_) => CycleOutcome::Running(Some(Twist2::new(0.0, 0.0, self.speed_rad_s))),
        }
    }
}

pub(crate) fn plugins() -> NavigationPlugins {
    NavigationPlugins::new()
        .planner("my_package::StraightLine", |setup, diagnostics| {
            let values = setup.given.read(&STRAIGHT_LINE, &[], diagnostics);
            Some(Box::new(StraightLine(values)))
        })
        .planner("my_package::Broken", |_, _| None)
        .controller("my_package::Forward", |setup, _| {
            let speed_m_s = setup.given.text("speed")?.parse().ok()?;
            Some(Box::new(Forward { speed_m_s, cycles: 0 }))
        })
        .behavior("my_package::Turn", BehaviorAction::Spin, |setup, _| {
            let speed_rad_s = setup.given.text("speed")?.parse().ok()?;
            Some(Box::new(Turn { speed_rad_s }))
        })
        .tree_nodes(|registry| {
            let model = NodeModel::new("CountTo", NodeKind::Action)
                .input("limit", PortType::int())
                .output("count", PortType::int());
            registry.register(model, CountTo::default);
        })
}
