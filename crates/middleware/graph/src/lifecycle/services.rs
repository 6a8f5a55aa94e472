//! Lifecycle services of a managed node.

use std::sync::Arc;

use periplus_msgs::Service;
use periplus_msgs::lifecycle_msgs::{
    ChangeState, ChangeStateRequest, ChangeStateResponse, GetAvailableStates,
    GetAvailableStatesResponse, GetAvailableTransitions, GetAvailableTransitionsResponse, GetState,
    GetStateResponse, TransitionDescription,
};

use super::LifecycleCore;
use super::machine::{EDGES, Edge, LifecycleState, edges_from};
use crate::GraphError;
use crate::common::lock;
use crate::node::Node;
use crate::registry::TypeOf;
use crate::service::OwnServer;
use crate::standard::reaction;

pub(super) fn serve(node: &Node, life: &Arc<LifecycleCore>) -> Result<[OwnServer; 5], GraphError> {
    Ok([
        server::<ChangeState>(node, life, "~/change_state", |life, request| ChangeStateResponse {
            success: life.change(|state| asked(state, request)),
        })?,
        server::<GetState>(node, life, "~/get_state", |life, _| GetStateResponse {
            current_state: lock(&life.state).message(),
        })?,
        server::<GetAvailableStates>(node, life, "~/get_available_states", |_, _| {
            let states = LifecycleState::ALL.into_iter().map(LifecycleState::message);
            GetAvailableStatesResponse { available_states: states.collect() }
        })?,
        server::<GetAvailableTransitions>(node, life, "~/get_available_transitions", |life, _| {
            described(edges_from(*lock(&life.state)))
        })?,
        server::<GetAvailableTransitions>(node, life, "~/get_transition_graph", |_, _| {
            described(EDGES.iter())
        })?,
    ])
}

fn server<S: Service>(
    node: &Node,
    life: &Arc<LifecycleCore>,
    name: &str,
    answer: impl Fn(&LifecycleCore, &S::Request) -> S::Response + Send + Sync + 'static,
) -> Result<OwnServer, GraphError> {
    let life = life.clone();
    let reaction = reaction::<S>(&node.0, move |_, request| answer(&life, request));
    node.0.server(name, TypeOf::service::<S>(), Some(reaction))
}

/// Edge that a request selects: by its label if given, otherwise by its number, as in
/// `rclcpp_lifecycle`. Edges that end a transition state cannot be requested.
fn asked(state: LifecycleState, request: &ChangeStateRequest) -> Option<&'static Edge> {
    let wanted = &request.transition;
    let is_wanted = |edge: &&Edge| {
        if wanted.label.is_empty() { edge.id == wanted.id } else { edge.label == wanted.label }
    };
    edges_from(state).filter(|edge| edge.start.step().is_none()).find(is_wanted)
}

fn described(edges: impl Iterator<Item = &'static Edge>) -> GetAvailableTransitionsResponse {
    let description = |edge: &Edge| TransitionDescription {
        transition: edge.message(),
        start_state: edge.start.message(),
        goal_state: edge.goal.message(),
    };
    GetAvailableTransitionsResponse { available_transitions: edges.map(description).collect() }
}
