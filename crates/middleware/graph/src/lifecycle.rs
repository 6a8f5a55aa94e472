//! Managed (lifecycle) nodes: other nodes configure, activate, deactivate and shut them down.
//!
//! Each keeps a bond with a lifecycle manager that requests one.
//!
//! Source: ROS 2's design article "Managed nodes", `rcl_lifecycle/default_state_machine.c` and
//! `rclcpp_lifecycle/lifecycle_node_interface_impl.cpp`.

mod bond;
mod machine;
mod node;
mod services;

use std::sync::{Arc, Mutex, Weak};

use periplus_msgs::lifecycle_msgs::TransitionEvent;

pub use bond::{Bond, BondSettings};
pub use machine::{LifecycleState, Step, StepOutcome, Transition};
pub use node::{LifecycleCallbacks, LifecycleNode};

use crate::actor::{Io, Once};
use crate::common::lock;
use crate::event_queue::{Key, Rank};
use crate::node::NodeCore;
use crate::{Actor, GraphError, Publisher, Qos};

/// Lifecycle of a managed node. This is a handle: clones refer to the same node.
#[derive(Clone)]
pub struct Lifecycle(Arc<LifecycleCore>);

pub(crate) struct LifecycleCore {
    node: Weak<NodeCore>,
    state: Mutex<LifecycleState>,
    /// Locked while the state changes.
    turn: Mutex<()>,
    step: Box<dyn Fn(Step) -> StepOutcome + Send + Sync>,
    events: Publisher<TransitionEvent>,
    /// The bond to a lifecycle manager while the node is active, and after that until the manager
    /// has acknowledged its end.
    bond: Mutex<Option<bond::End>>,
}

impl Lifecycle {
    /// The current state.
    #[must_use]
    pub fn state(&self) -> LifecycleState {
        *lock(&self.0.state)
    }

    /// True in the active state.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.0.is_active()
    }

    /// Changes the state from inside the program, as soon as the node is idle; no effect if the
    /// state then does not allow it.
    pub fn change(&self, transition: Transition) {
        let Some(node) = self.0.node.upgrade() else { return };
        let key = Key {
            time_ns: node.core.common.clock.now_ns(),
            node: node.full_name.clone(),
            rank: Rank::Request,
            name: "~/change_state".into(),
            sequence: node.next_ordinal(),
            ordinal: 0,
        };
        let life = Arc::downgrade(&self.0);
        let act = Once::new(move || {
            if let Some(life) = life.upgrade() {
                life.change(|state| transition.at(state));
            }
        });
        node.event_queue().add(key, Arc::new(act));
    }

    /// Changes the state at once, for a node that owns this one and whose own transition depends on
    /// it. Returns true if the transition succeeded; false without effect if the state does not allow
    /// it. Callbacks of this node must not wait for the caller.
    pub fn change_now(&self, transition: Transition) -> bool {
        self.0.change(|state| transition.at(state))
    }

    /// Configures and activates the node, as a lifecycle manager would.
    pub fn start(&self) {
        self.change(Transition::Configure);
        self.change(Transition::Activate);
    }
}

impl<S: Send + 'static> Actor<S> {
    /// Makes the node a managed one: unconfigured at first, with the five lifecycle services and
    /// the transition topic. `step` performs each transition and returns its outcome. After
    /// [`StepOutcome::Error`] it is called with [`Step::Error`], to clean up.
    ///
    /// # Errors
    /// When the node is managed already.
    pub fn managed(
        &mut self,
        step: impl FnMut(&mut S, Step, &mut Io<'_, S>) -> StepOutcome + Send + 'static,
    ) -> Result<Lifecycle, GraphError> {
        let act = self.act(step);
        let node = self.node().clone();
        let life = Arc::new(LifecycleCore {
            node: Arc::downgrade(&node.0),
            state: Mutex::new(LifecycleState::Unconfigured),
            turn: Mutex::new(()),
            step: Box::new(move |asked| {
                let mut outcome = StepOutcome::Error;
                act(&mut |step, state, io| outcome = step(state, asked, io));
                outcome
            }),
            events: node.publisher("~/transition_event", Qos::reliable(10))?,
            bond: Mutex::new(None),
        });
        lock(&node.0.standard().store).manage();
        for server in services::serve(&node, &life)? {
            self.keep(server);
        }
        // The services are there, so no other lifecycle is.
        let _ = node.0.lifecycle.set(Arc::downgrade(&life));
        Ok(Lifecycle(life))
    }
}

impl LifecycleCore {
    pub(crate) fn is_active(&self) -> bool {
        *lock(&self.state) == LifecycleState::Active
    }

    /// Executes a transition; true if it succeeded.
    fn change(
        &self,
        choose: impl FnOnce(LifecycleState) -> Option<&'static machine::Edge>,
    ) -> bool {
        let Ok(_turn) = self.turn.try_lock() else { return false };
        let state = *lock(&self.state);
        let Some(edge) = choose(state) else { return false };
        self.enter(edge);
        let Some(step) = edge.goal.step() else { return false };
        let outcome = (self.step)(step);
        self.leave(outcome);
        if *lock(&self.state) == LifecycleState::ErrorProcessing {
            let outcome = (self.step)(Step::Error);
            self.leave(outcome);
        }
        outcome == StepOutcome::Success
    }

    fn leave(&self, outcome: StepOutcome) {
        let state = *lock(&self.state);
        if let Some(edge) = machine::after(state, outcome) {
            self.enter(edge);
        }
    }

    /// Starts the bond when the node becomes active and breaks it when it leaves that state, as
    /// Nav2's nodes do.
    fn keep_bond(&self, edge: &'static machine::Edge) {
        if edge.goal == LifecycleState::Active {
            let node = self.node.upgrade().map(crate::Node);
            *lock(&self.bond) = node.and_then(|node| bond::End::start(&node));
        } else if edge.start == LifecycleState::Active
            && let Some(bond) = &*lock(&self.bond)
        {
            bond.end();
        }
    }

    fn enter(&self, edge: &'static machine::Edge) {
        *lock(&self.state) = edge.goal;
        self.keep_bond(edge);
        let now_ns = self.node.upgrade().map_or(0, |node| node.core.common.clock.now_ns());
        self.events.publish(TransitionEvent {
            timestamp: u64::try_from(now_ns).unwrap_or_default(),
            transition: edge.message(),
            start_state: edge.start.message(),
            goal_state: edge.goal.message(),
        });
    }
}
