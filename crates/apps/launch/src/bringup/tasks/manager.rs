//! `nav2_lifecycle_manager`.
//!
//! Source: `nav2_lifecycle_manager/src/lifecycle_manager.cpp`: nodes are configured in the order of
//! `node_names`, then activated in that order; shutdown is in reverse ([`CommandExecution`]). Each active node has a bond,
//! unless `bond_timeout` is 0. After a bond broke, the other nodes are reset; once all respond
//! again, the system is restarted (`attempt_respawn_reconnection`).

use std::collections::BTreeMap;

use periplus_graph::{Call, Calls, Client, Level, Node, Pending, Publisher, Qos};
use periplus_motion::{CommandExecution, ManagedState, ManagedTransition, ManagerCommand};
use periplus_msgs::lifecycle_msgs::{ChangeState, ChangeStateRequest, State, Transition};
use periplus_msgs::nav2_msgs::{ManageLifecycleNodes, ManageLifecycleNodesResponse};
use periplus_msgs::std_msgs;
use periplus_msgs::std_srvs::{Trigger, TriggerResponse};

use super::bonds::{Bonds, BrokenBond};
use super::respawn::{Respawn, RespawnStatus, SERVICE_TIMEOUT_NS};
use super::{Done, Task, TaskContext};
use crate::bringup::report::LaunchLog;

/// Time after which a missing node is logged \[ns\].
const WARNING_DELAY_NS: i64 = 5_000_000_000;

/// Parameters of a lifecycle manager, as named by Nav2; times in seconds.
pub(crate) struct ManagerSettings {
    /// Names of the nodes, relative to the manager's namespace.
    pub(crate) node_names: Vec<String>,
    pub(crate) autostart: bool,
    pub(crate) bond_timeout_s: f64,
    pub(crate) attempt_respawn_reconnection: bool,
    pub(crate) bond_respawn_max_duration_s: f64,
}

/// Lifecycle manager.
pub(crate) struct Manager {
    node: Node,
    names: Vec<String>,
    clients: BTreeMap<String, Client<ChangeState>>,
    manage: Calls<ManageLifecycleNodes>,
    is_active: Calls<Trigger>,
    state: Publisher<std_msgs::Bool>,
    /// Command that is being executed.
    execution: Option<CommandExecution>,
    /// Caller of that command, which waits for the result.
    caller: Option<Call<ManageLifecycleNodes>>,
    pending: Option<Pending<ChangeState>>,
    /// Steady time at which `pending` was sent \[ns\].
    pending_since_ns: i64,
    bonds: Option<Bonds>,
    respawn: Option<Respawn>,
    waits_since_ns: i64,
    has_complained: bool,
    /// All nodes are active; the last bond may not be formed yet.
    is_rising: bool,
    is_up: bool,
}

impl Manager {
    /// Creates a manager.
    ///
    /// # Errors
    /// A message when it cannot start.
    pub(crate) fn new(node: Node, settings: ManagerSettings, now_ns: i64) -> Result<Self, String> {
        let names = settings.node_names;
        let made = || {
            let mut clients = BTreeMap::new();
            for name in &names {
                clients.insert(name.clone(), node.client(&format!("{name}/change_state"))?);
            }
            let manage = node.server("~/manage_nodes")?;
            let is_active = node.server("~/is_active")?;
            let state = node.publisher("~/is_active_state", Qos::latched(1))?;
            let bonds = Bonds::new(&node, settings.bond_timeout_s)?;
            let respawn = if bonds.is_some() && settings.attempt_respawn_reconnection {
                Some(Respawn::new(&node, &names, settings.bond_respawn_max_duration_s)?)
            } else {
                None
            };
            Ok((clients, manage, is_active, state, bonds, respawn))
        };
        let made: Result<_, periplus_graph::GraphError> = made();
        let (clients, manage, is_active, state, bonds, respawn) =
            made.map_err(|error| error.to_string())?;
        let mut manager = Self {
            node,
            names,
            clients,
            manage,
            is_active,
            state,
            execution: None,
            caller: None,
            pending: None,
            pending_since_ns: 0,
            bonds,
            respawn,
            waits_since_ns: now_ns,
            has_complained: false,
            is_rising: false,
            is_up: false,
        };
        if settings.autostart {
            manager.start(ManagerCommand::Startup);
        }
        Ok(manager)
    }

    /// Starts a command.
    fn start(&mut self, command: ManagerCommand) {
        if let Some(respawn) = &mut self.respawn {
            respawn.cancel();
        }
        self.execution = Some(CommandExecution::new(command, &self.names));
    }

    /// Starts the command of a call. Calls are executed one after the other.
    fn start_next_call(&mut self) {
        if self.execution.is_some() || self.is_rising {
            return;
        }
        let Some(call) = self.manage.take() else { return };
        match ManagerCommand::of_number(call.request.command) {
            Some(command) => {
                self.start(command);
                self.caller = Some(call);
            }
            None => call.answer(ManageLifecycleNodesResponse { success: false }),
        }
    }

    fn say(&self, stage: &mut TaskContext<'_>, level: Level, text: &str) {
        self.node.log(level, text);
        stage.said.push(LaunchLog::of_launch(level, format!("{}: {text}", self.node.full_name())));
    }

    /// Executes the command; returns true on progress.
    fn proceed(&mut self, stage: &mut TaskContext<'_>) -> bool {
        let Some(execution) = &mut self.execution else { return false };
        if let Some((succeeded, state)) = execution.outcome() {
            let was_hard = execution.is_hard();
            self.execution = None;
            self.is_rising = succeeded && state == ManagedState::Active;
            if !self.is_rising && !was_hard {
                self.set_up(false);
                self.answer(succeeded);
            }
            return true;
        }
        let Some((name, transition)) = execution.next_step() else { return false };
        let (name, is_hard) = (name.to_owned(), execution.is_hard());
        let steady_ns = stage.graph.steady_now_ns();
        if let Some(pending) = &self.pending {
            let succeeded = match pending.take() {
                Some(answer) => answer.is_ok_and(|answer| answer.success),
                // It may have ended together with the node whose bond broke.
                None if is_hard && steady_ns - self.pending_since_ns > SERVICE_TIMEOUT_NS => false,
                None => return false,
            };
            self.pending = None;
            execution.finish_step(succeeded);
            if succeeded && transition == ManagedTransition::Activate {
                if let Some(bonds) = &mut self.bonds {
                    bonds.begin(&name, steady_ns);
                }
            } else if !succeeded && !is_hard {
                let label = transition.label();
                let text = format!("failed to {label} `{name}`; later nodes are left unchanged");
                self.say(stage, Level::Error, &text);
            }
            return true;
        }
        // The next node waits until the bond with the previous one is formed.
        if self.bonds.as_ref().is_some_and(Bonds::is_forming) {
            return false;
        }
        if transition == ManagedTransition::Deactivate
            && let Some(bonds) = &mut self.bonds
        {
            bonds.end(&name, steady_ns);
        }
        let Some(client) = self.clients.get(&name) else { return false };
        if !client.is_ready() {
            if is_hard {
                execution.finish_step(false);
                return true;
            }
            if stage.now_ns - self.waits_since_ns > WARNING_DELAY_NS && !self.has_complained {
                self.has_complained = true;
                let text = format!("waiting for the services of `{name}`");
                self.say(stage, Level::Warn, &text);
            }
            return false;
        }
        self.waits_since_ns = stage.now_ns;
        let transition = request_of(transition);
        self.pending = Some(client.call(ChangeStateRequest { transition }));
        self.pending_since_ns = steady_ns;
        stage.graph.settle();
        true
    }

    /// Reports the result of a command to its caller.
    fn answer(&mut self, success: bool) {
        if let Some(call) = self.caller.take() {
            call.answer(ManageLifecycleNodesResponse { success });
        }
    }

    fn set_up(&mut self, is_up: bool) {
        self.is_up = is_up;
        self.state.publish(std_msgs::Bool { data: is_up });
    }
}

/// Transition of a request. It has no label, as in Nav2: nodes would select by it, and all shutdowns have
/// the same.
fn request_of(transition: ManagedTransition) -> Transition {
    let id = match transition {
        ManagedTransition::Configure => Transition::TRANSITION_CONFIGURE,
        ManagedTransition::Activate => Transition::TRANSITION_ACTIVATE,
        ManagedTransition::Deactivate => Transition::TRANSITION_DEACTIVATE,
        ManagedTransition::Cleanup => Transition::TRANSITION_CLEANUP,
        ManagedTransition::Shutdown => Transition::TRANSITION_UNCONFIGURED_SHUTDOWN,
    };
    Transition { id, ..Transition::default() }
}

impl Manager {
    /// Resets all nodes when one of them is gone.
    fn keep_bonds(&mut self, stage: &mut TaskContext<'_>) {
        let Some(bonds) = &mut self.bonds else { return };
        let steady_ns = stage.graph.steady_now_ns();
        let Some(BrokenBond { name, reason, was_formed }) = bonds.keep(steady_ns) else { return };
        self.say(stage, Level::Error, &format!("{reason}; resetting the other nodes"));
        if let Some(respawn) = self.respawn.as_mut().filter(|_| was_formed) {
            respawn.begin(steady_ns);
        }
        self.is_rising = false;
        self.set_up(false);
        self.answer(false);
        self.pending = None;
        let others = self.names.iter().filter(|other| **other != name);
        let others: Vec<String> = others.cloned().collect();
        self.execution = Some(CommandExecution::hard_reset(&others));
    }

    /// Restarts the system once all nodes are back.
    fn await_respawn(&mut self, stage: &mut TaskContext<'_>) {
        let Some(respawn) = &mut self.respawn else { return };
        if self.execution.is_some() {
            return;
        }
        match respawn.look(stage.graph.steady_now_ns()) {
            RespawnStatus::Idle => {}
            RespawnStatus::PartState => stage.graph.settle(),
            RespawnStatus::Back(states) => {
                let text = "all nodes respond again after a bond broke; restarting the system";
                self.say(stage, Level::Info, text);
                // A node that ended its bond by itself may be in any state.
                let mut resets = Vec::new();
                for name in self.names.iter().rev() {
                    let transitions: &[ManagedTransition] = match states.get(name) {
                        Some(&State::PRIMARY_STATE_ACTIVE) => {
                            &[ManagedTransition::Deactivate, ManagedTransition::Cleanup]
                        }
                        Some(&State::PRIMARY_STATE_INACTIVE) => &[ManagedTransition::Cleanup],
                        _ => &[],
                    };
                    resets.extend(transitions.iter().map(|it| (name.clone(), *it)));
                }
                self.start(ManagerCommand::Startup);
                if let Some(execution) = &mut self.execution {
                    execution.prepend(resets);
                }
            }
            RespawnStatus::GivenUp => {
                let text = "not all nodes came back after a bond broke \
                            (`bond_respawn_max_duration`); start them, then call `manage_nodes`";
                self.say(stage, Level::Error, text);
            }
        }
    }
}

impl Task for Manager {
    fn time_went_back(&mut self, by_ns: i64) {
        self.waits_since_ns -= by_ns;
    }

    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        self.keep_bonds(stage);
        while let Some(call) = self.is_active.take() {
            call.answer(TriggerResponse { success: self.is_up, ..TriggerResponse::default() });
        }
        self.start_next_call();
        while self.proceed(stage) {
            self.start_next_call();
        }
        self.await_respawn(stage);
        if self.is_rising && !self.bonds.as_ref().is_some_and(Bonds::is_forming) {
            self.is_rising = false;
            self.set_up(true);
            self.answer(true);
            self.say(stage, Level::Info, "managed nodes are active");
        }
        Done::No
    }
}

#[cfg(test)]
mod tests;
