//! Nodes of Nav2 that need no ROS interfaces: control nodes, decorators and conditions.
//!
//! Rates and times count the time of the ticks. Nav2's own `RateController` counts the wall clock.

mod conditions;
mod motion;
mod recovery;
mod sequences;
mod timing;

use crate::value::PortType;
use crate::{NodeKind, NodeModel, NodeRegistry};

use conditions::{
    GlobalUpdatedGoal, GoalUpdated, HasErrorCode, InitialPoseReceived, PathExpiringTimer,
    TimeExpired,
};
pub use conditions::{RecoveryServer, would_recovery_help};
use motion::{DistanceController, DistanceTraveled, PathLongerOnApproach, SpeedController};
use recovery::{RecoveryNode, RoundRobin};
use sequences::{NonblockingSequence, PersistentSequence, PipelineSequence};
use timing::{GoalUpdatedController, RateController, SingleTrigger};

/// Names of the message types on the blackboard, as types of ports.
mod types {
    pub(super) const POSE: &str = "geometry_msgs/PoseStamped";
    pub(super) const GOALS: &str = "nav_msgs/Goals";
    pub(super) const PATH: &str = "nav_msgs/Path";
}

/// Differences between releases of Nav2 that these nodes have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nav2NodeRules {
    /// `RoundRobin` begins again with its first child after the last one: always in Humble and Jazzy. In
    /// later releases the port `wrap_around` decides (default false), and without it the node fails after
    /// its last child, even if that child succeeded.
    pub round_robin_wraps: bool,
}

impl Nav2NodeRules {
    /// Humble, Jazzy and Kilted.
    pub const JAZZY: Self = Self { round_robin_wraps: true };
    /// Main.
    pub const MAIN: Self = Self { round_robin_wraps: false };
}

/// Adds the nodes to a registry.
pub fn register(registry: &mut NodeRegistry, rules: Nav2NodeRules) {
    let control = |name: &str| NodeModel::new(name, NodeKind::Control);
    let real = PortType::real;
    registry.register(control("PipelineSequence"), PipelineSequence::default);
    let recovery = control("RecoveryNode").input_or("number_of_retries", PortType::int(), "1");
    registry.register(recovery, RecoveryNode::default);
    let wraps = if rules.round_robin_wraps { "true" } else { "false" };
    let round_robin = control("RoundRobin").input_or("wrap_around", PortType::Bool, wraps);
    registry.register(round_robin, RoundRobin::default);
    registry.register(control("NonblockingSequence"), || NonblockingSequence);
    let persistent = control("PersistentSequence").in_out("current_child_idx", PortType::int());
    registry.register(persistent, || PersistentSequence);
    register_decorators(registry);
    register_conditions(registry);

    fn goal(model: NodeModel) -> NodeModel {
        model
            .input("goal", PortType::object(types::POSE))
            .input("goals", PortType::object(types::GOALS))
    }

    fn frames(model: NodeModel) -> NodeModel {
        model.input("global_frame", PortType::Text).input("robot_base_frame", PortType::Text)
    }

    fn register_decorators(registry: &mut NodeRegistry) {
        let decorator = |name: &str| NodeModel::new(name, NodeKind::Decorator);
        let real = PortType::real;
        let rate = decorator("RateController").input_or("hz", real(), "10.0");
        registry.register(rate, RateController::default);
        let distance = frames(decorator("DistanceController").input_or("distance", real(), "1.0"));
        registry.register(distance, DistanceController::default);
        let speed = goal(decorator("SpeedController"))
            .input_or("min_rate", real(), "0.1")
            .input_or("max_rate", real(), "1.0")
            .input_or("min_speed", real(), "0.0")
            .input_or("max_speed", real(), "0.5");
        registry.register(speed, SpeedController::default);
        registry.register(decorator("SingleTrigger"), SingleTrigger::default);
        let updated = goal(decorator("GoalUpdatedController"));
        registry.register(updated, GoalUpdatedController::default);
        let longer = decorator("PathLongerOnApproach")
            .input("path", PortType::object(types::PATH))
            .input_or("prox_len", real(), "3.0")
            .input_or("length_factor", real(), "2.0");
        registry.register(longer, PathLongerOnApproach::default);
    }

    fn register_conditions(registry: &mut NodeRegistry) {
        let condition = |name: &str| NodeModel::new(name, NodeKind::Condition);
        registry.register(goal(condition("GoalUpdated")), GoalUpdated::default);
        registry.register(goal(condition("GlobalUpdatedGoal")), GlobalUpdatedGoal::default);
        let codes = |name: &str| {
            condition(name)
                .input("error_code", PortType::uint16())
                .input("error_codes_to_check", PortType::List("vector<int>".into()))
        };
        registry.register(codes("AreErrorCodesPresent"), || HasErrorCode(None));
        for (name, server) in [
            ("WouldAControllerRecoveryHelp", RecoveryServer::Controller),
            ("WouldAPlannerRecoveryHelp", RecoveryServer::Planner),
            ("WouldASmootherRecoveryHelp", RecoveryServer::Smoother),
            ("WouldARouteRecoveryHelp", RecoveryServer::Route),
        ] {
            registry.register(codes(name), move || HasErrorCode(Some(server)));
        }
        let seconds = |name: &str| condition(name).input_or("seconds", PortType::real(), "1.0");
        registry.register(seconds("TimeExpired"), TimeExpired::default);
        let expiring = seconds("PathExpiringTimer").input("path", PortType::object(types::PATH));
        registry.register(expiring, PathExpiringTimer::default);
        let received = condition("InitialPoseReceived");
        let received = received.input("initial_pose_received", PortType::Bool);
        registry.register(received, || InitialPoseReceived);
    }

    let travelled = NodeModel::new("DistanceTraveled", NodeKind::Condition);
    let travelled = frames(travelled.input_or("distance", real(), "1.0"));
    registry.register(travelled, DistanceTraveled::default);
}
