//! `nav2_lifecycle_manager`.
//!
//! Source: `nav2_lifecycle_manager/src/lifecycle_manager.cpp`: nodes are configured in the order of
//! `node_names`, then activated in that order; shutdown is in reverse. Each active node has a bond,
//! unless `bond_timeout` is 0. After a bond broke, the other nodes are reset; once all respond
//! again, the system is restarted (`attempt_respawn_reconnection`).

use std::collections::{BTreeMap, VecDeque};

use periplus_graph::{Calls, Client, Level, Node, Pending, Publisher, Qos};
use periplus_msgs::lifecycle_msgs::{ChangeState, ChangeStateRequest, State};
use periplus_msgs::nav2_msgs::{
    ManageLifecycleNodes, ManageLifecycleNodesRequest as Command, ManageLifecycleNodesResponse,
};
use periplus_msgs::std_msgs;
use periplus_msgs::std_srvs::{Trigger, TriggerResponse};

use super::bonds::{Bonds, BrokenBond};
use super::changer::transition;
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
    to_do: VecDeque<(String, &'static str)>,
    pending: Option<Pending<ChangeState>>,
    /// Steady time at which `pending` was sent \[ns\].
    pending_since_ns: i64,
    bonds: Option<Bonds>,
    respawn: Option<Respawn>,
    /// After a bond broke all nodes are reset, even if single ones fail.
    is_hard_reset: bool,
    waits_since_ns: i64,
    has_complained: bool,
    /// All nodes are active; the last bond may not be formed yet.
    is_rising: bool,
    is_up: bool,
    has_failed: bool,
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
            to_do: VecDeque::new(),
            pending: None,
            pending_since_ns: 0,
            bonds,
            respawn,
            is_hard_reset: false,
            waits_since_ns: now_ns,
            has_complained: false,
            is_rising: false,
            is_up: false,
            has_failed: false,
        };
        if settings.autostart {
            manager.order(Command::STARTUP);
        }
        Ok(manager)
    }

    /// Queues the transitions of a command. False for an unknown command.
    fn order(&mut self, command: u8) -> bool {
        let labels: &[&'static str] = match command {
            Command::STARTUP => &["configure", "activate"],
            Command::CONFIGURE => &["configure"],
            Command::RESUME => &["activate"],
            Command::PAUSE => &["deactivate"],
            Command::CLEANUP => &["cleanup"],
            Command::RESET => &["deactivate", "cleanup"],
            Command::SHUTDOWN => &["deactivate", "cleanup", "unconfigured_shutdown"],
            _ => return false,
        };
        (self.has_failed, self.is_hard_reset) = (false, false);
        if let Some(respawn) = &mut self.respawn {
            respawn.cancel();
        }
        for label in labels {
            let is_up = matches!(*label, "configure" | "activate");
            let mut names = self.names.clone();
            if !is_up {
                names.reverse();
            }
            self.to_do.extend(names.into_iter().map(|name| (name, *label)));
        }
        true
    }

    fn say(&self, stage: &mut TaskContext<'_>, level: Level, text: &str) {
        self.node.log(level, text);
        stage.said.push(LaunchLog { level, text: format!("{}: {text}", self.node.full_name()) });
    }

    /// Processes the queue; returns true on progress.
    fn process_queue(&mut self, stage: &mut TaskContext<'_>) -> bool {
        let Some((name, label)) = self.to_do.front().cloned() else {
            self.is_hard_reset = false;
            return false;
        };
        let steady_ns = stage.graph.steady_now_ns();
        if let Some(pending) = &self.pending {
            let succeeded = match pending.take() {
                Some(answer) => answer.is_ok_and(|answer| answer.success),
                // It may have ended together with the node whose bond broke.
                None if self.is_hard_reset
                    && steady_ns - self.pending_since_ns > SERVICE_TIMEOUT_NS =>
                {
                    false
                }
                None => return false,
            };
            self.pending = None;
            self.to_do.pop_front();
            if self.is_hard_reset {
                return true;
            }
            if succeeded {
                if label == "activate"
                    && let Some(bonds) = &mut self.bonds
                {
                    bonds.begin(&name, steady_ns);
                }
                if self.to_do.is_empty() {
                    self.is_rising = label == "activate";
                    if !self.is_rising {
                        self.is_up = false;
                        self.state.publish(std_msgs::Bool { data: false });
                    }
                }
            } else {
                let text = format!("failed to {label} `{name}`; later nodes are left unchanged");
                self.say(stage, Level::Error, &text);
                self.has_failed = true;
                self.to_do.clear();
            }
            return true;
        }
        // The next node waits until the bond with the previous one is formed.
        if self.bonds.as_ref().is_some_and(Bonds::is_forming) {
            return false;
        }
        if label == "deactivate"
            && let Some(bonds) = &mut self.bonds
        {
            bonds.end(&name, steady_ns);
        }
        let Some(client) = self.clients.get(&name) else { return false };
        if !client.is_ready() {
            if self.is_hard_reset {
                self.to_do.pop_front();
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
        let Some(transition) = transition(label) else { return false };
        self.pending = Some(client.call(ChangeStateRequest { transition }));
        self.pending_since_ns = steady_ns;
        stage.graph.settle();
        true
    }
}

impl Manager {
    /// Resets all nodes when one of them is gone.
    fn keep_bonds(&mut self, stage: &mut TaskContext<'_>) {
        let Some(bonds) = &mut self.bonds else { return };
        let steady_ns = stage.graph.steady_now_ns();
        let Some(BrokenBond { name, reason, was_formed }) = bonds.keep(steady_ns) else { return };
        self.say(stage, Level::Error, &format!("{reason}; resetting the other nodes"));
        self.is_hard_reset = true;
        if let Some(respawn) = self.respawn.as_mut().filter(|_| was_formed) {
            respawn.begin(steady_ns);
        }
        self.has_failed = true;
        (self.is_rising, self.is_up) = (false, false);
        self.state.publish(std_msgs::Bool { data: false });
        self.to_do.clear();
        self.pending = None;
        let others = self.names.iter().rev().filter(|other| **other != name);
        let others: Vec<String> = others.cloned().collect();
        for label in ["deactivate", "cleanup"] {
            self.to_do.extend(others.iter().map(|other| (other.clone(), label)));
        }
    }
}

impl Manager {
    /// Restarts the system once all nodes are back.
    fn await_respawn(&mut self, stage: &mut TaskContext<'_>) {
        let Some(respawn) = &mut self.respawn else { return };
        if !self.to_do.is_empty() || self.pending.is_some() {
            return;
        }
        match respawn.look(stage.graph.steady_now_ns()) {
            RespawnStatus::Idle => {}
            RespawnStatus::PartState => stage.graph.settle(),
            RespawnStatus::Back(states) => {
                let text = "all nodes respond again after a bond broke; restarting the system";
                self.say(stage, Level::Info, text);
                // A node that ended its bond by itself may be in any state.
                let mut resets = VecDeque::new();
                for name in self.names.iter().rev() {
                    match states.get(name) {
                        Some(&State::PRIMARY_STATE_ACTIVE) => {
                            resets.push_back((name.clone(), "deactivate"));
                            resets.push_back((name.clone(), "cleanup"));
                        }
                        Some(&State::PRIMARY_STATE_INACTIVE) => {
                            resets.push_back((name.clone(), "cleanup"));
                        }
                        _ => {}
                    }
                }
                self.to_do = resets;
                self.order(Command::STARTUP);
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
        while let Some(call) = self.manage.take() {
            let success = self.order(call.request.command);
            call.answer(ManageLifecycleNodesResponse { success });
        }
        while let Some(call) = self.is_active.take() {
            call.answer(TriggerResponse { success: self.is_up, ..TriggerResponse::default() });
        }
        while self.process_queue(stage) {}
        self.await_respawn(stage);
        if self.is_rising && !self.bonds.as_ref().is_some_and(Bonds::is_forming) {
            (self.is_rising, self.is_up) = (false, true);
            self.state.publish(std_msgs::Bool { data: true });
            self.say(stage, Level::Info, "managed nodes are active");
        }
        Done::No
    }
}
