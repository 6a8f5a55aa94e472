//! Robots of a session as a fleet of Open-RMF.
//!
//! Each robot with navigation takes the requests of a fleet adapter (`rmf_fleet_msgs`) and drives its paths by Nav2's
//! action `navigate_through_poses`; slotcars of the world do so themselves. All publish `/robot_state`, and the fleet
//! publishes `/fleet_states`, as `robot_state_aggregator` of `rmf_fleet_adapter` does.

mod path;
mod robot;

use std::collections::BTreeMap;

use periplus_graph::{Actor, Graph, GraphError, NodeSettings, Publisher, Qos};
use periplus_msgs::rmf_fleet_msgs::{FleetState, RobotState};

use self::robot::RobotClient;
use super::{Estimators, RobotProfile};

/// Time between two messages of a fleet \[ns\].
const FLEET_PERIOD_NS: i64 = 500_000_000;

/// Messages of robots that wait.
const DEPTH: usize = 100;

/// A fleet, which runs until it is dropped.
pub struct OpenRmfFleet {
    _robots: Vec<Actor<RobotClient>>,
    _states: Actor<FleetStates>,
}

/// Robot of a fleet: its name, and its nodes.
pub(crate) struct OpenRmfMember<'a> {
    pub(crate) name: String,
    pub(crate) profile: &'a RobotProfile,
    pub(crate) estimators: &'a Estimators,
}

/// States of the robots by name.
struct FleetStates {
    fleet: String,
    robots: BTreeMap<String, RobotState>,
    publisher: Publisher<FleetState>,
}

impl OpenRmfFleet {
    /// Creates the nodes of a fleet. Members without navigation are left out.
    ///
    /// # Errors
    /// When the graph refuses a node.
    pub(crate) fn start<'a>(
        graph: &Graph,
        fleet: &str,
        members: impl Iterator<Item = OpenRmfMember<'a>>,
    ) -> Result<Self, GraphError> {
        let robots = members
            .filter(|member| !member.estimators.navigation.is_empty())
            .map(|member| RobotClient::start(graph, fleet, &member));
        let robots = robots.collect::<Result<Vec<_>, _>>()?;
        let node = graph.node(NodeSettings::new("periplus_fleet").keep_names())?;
        let state = FleetStates {
            fleet: fleet.to_owned(),
            robots: BTreeMap::new(),
            publisher: node.publisher("/fleet_states", Qos::reliable(10))?,
        };
        let mut states = node.actor(state);
        states.subscribe(
            "/robot_state",
            Qos::reliable(DEPTH),
            |it, state: std::sync::Arc<RobotState>, _| {
                it.robots.insert(state.name.clone(), (*state).clone());
            },
        )?;
        states.timer(FLEET_PERIOD_NS, |it, _| {
            let robots = it.robots.values().cloned().collect();
            it.publisher.publish(FleetState { name: it.fleet.clone(), robots });
        })?;
        Ok(Self { _robots: robots, _states: states })
    }
}
