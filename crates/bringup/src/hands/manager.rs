//! `nav2_lifecycle_manager`.
//!
//! Source: `nav2_lifecycle_manager/src/lifecycle_manager.cpp`: nodes are configured one after the
//! other in the order of `node_names`, then activated in that order; down it goes in reverse. With each
//! active node a bond is kept, unless `bond_timeout` is 0.

use std::collections::{BTreeMap, VecDeque};

use periplus_graph::{Calls, Client, Level, Node, Pending, Publisher, Qos};
use periplus_msgs::lifecycle_msgs::{ChangeState, ChangeStateRequest};
use periplus_msgs::nav2_msgs::{
    ManageLifecycleNodes, ManageLifecycleNodesRequest as Command, ManageLifecycleNodesResponse,
};
use periplus_msgs::std_msgs;
use periplus_msgs::std_srvs::{Trigger, TriggerResponse};

use super::bonds::{Bonds, Broken};
use super::changer::transition;
use super::{Done, Hand, Stage};
use crate::told::Said;

/// After so long it is said for whom it waits \[ns\].
const PATIENCE_NS: i64 = 5_000_000_000;

/// A manager of nodes.
pub(crate) struct Manager {
    node: Node,
    names: Vec<String>,
    clients: BTreeMap<String, Client<ChangeState>>,
    manage: Calls<ManageLifecycleNodes>,
    is_active: Calls<Trigger>,
    state: Publisher<std_msgs::Bool>,
    to_do: VecDeque<(String, &'static str)>,
    pending: Option<Pending<ChangeState>>,
    bonds: Option<Bonds>,
    waits_since_ns: i64,
    has_complained: bool,
    /// All nodes are active; the last bond may not be formed yet.
    is_rising: bool,
    is_up: bool,
    has_failed: bool,
}

impl Manager {
    /// Of these nodes, by their names in its namespace; `lacking` are left out.
    ///
    /// # Errors
    /// In words.
    pub(crate) fn new(
        node: Node,
        names: Vec<String>,
        is_autostart: bool,
        bond_timeout_s: f64,
        now_ns: i64,
    ) -> Result<Self, String> {
        let made = || {
            let mut clients = BTreeMap::new();
            for name in &names {
                clients.insert(name.clone(), node.client(&format!("{name}/change_state"))?);
            }
            let manage = node.server("~/manage_nodes")?;
            let is_active = node.server("~/is_active")?;
            let state = node.publisher("~/is_active_state", Qos::latched(1))?;
            let bonds = Bonds::new(&node, bond_timeout_s)?;
            Ok((clients, manage, is_active, state, bonds))
        };
        let made: Result<_, periplus_graph::GraphError> = made();
        let (clients, manage, is_active, state, bonds) = made.map_err(|error| error.to_string())?;
        let mut manager = Self {
            node,
            names,
            clients,
            manage,
            is_active,
            state,
            to_do: VecDeque::new(),
            pending: None,
            bonds,
            waits_since_ns: now_ns,
            has_complained: false,
            is_rising: false,
            is_up: false,
            has_failed: false,
        };
        if is_autostart {
            manager.order(Command::STARTUP);
        }
        Ok(manager)
    }

    /// What a command asks for, in its order. False for one that is not known.
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
        self.has_failed = false;
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

    fn say(&self, stage: &mut Stage<'_>, level: Level, text: &str) {
        self.node.log(level, text);
        stage.said.push(Said { level, text: format!("{}: {text}", self.node.full_name()) });
    }

    /// Goes on with what is to be done; whether something was.
    fn go_on(&mut self, stage: &mut Stage<'_>) -> bool {
        let Some((name, label)) = self.to_do.front().cloned() else { return false };
        if let Some(pending) = &self.pending {
            let Some(answer) = pending.take() else { return false };
            self.pending = None;
            self.to_do.pop_front();
            let succeeded = answer.is_ok_and(|answer| answer.success);
            if succeeded {
                if label == "activate"
                    && let Some(bonds) = &mut self.bonds
                {
                    bonds.begin(&name, stage.now_ns);
                }
                if self.to_do.is_empty() {
                    self.is_rising = label == "activate";
                    if !self.is_rising {
                        self.is_up = false;
                        self.state.publish(std_msgs::Bool { data: false });
                    }
                }
            } else {
                let text =
                    format!("failed to {label} `{name}`; the nodes behind it stay as they are");
                self.say(stage, Level::Error, &text);
                self.has_failed = true;
                self.to_do.clear();
            }
            return true;
        }
        // The next node waits until the bond with the one before it is formed.
        if self.bonds.as_ref().is_some_and(Bonds::is_forming) {
            return false;
        }
        if label == "deactivate"
            && let Some(bonds) = &mut self.bonds
        {
            bonds.end(&name, stage.now_ns);
        }
        let Some(client) = self.clients.get(&name) else { return false };
        if !client.is_ready() {
            if stage.now_ns - self.waits_since_ns > PATIENCE_NS && !self.has_complained {
                self.has_complained = true;
                let text = format!("waits for `{name}`, whose services nobody has");
                self.say(stage, Level::Warn, &text);
            }
            return false;
        }
        self.waits_since_ns = stage.now_ns;
        let Some(transition) = transition(label) else { return false };
        self.pending = Some(client.call(ChangeStateRequest { transition }));
        stage.graph.settle();
        true
    }
}

impl Manager {
    /// Takes all nodes down when one of them is gone.
    fn keep_bonds(&mut self, stage: &mut Stage<'_>) {
        let Some(bonds) = &mut self.bonds else { return };
        let Some(Broken { name, reason }) = bonds.keep(stage.now_ns) else { return };
        self.say(stage, Level::Error, &format!("{reason}; the other nodes are reset"));
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

impl Hand for Manager {
    fn time_went_back(&mut self, by_ns: i64) {
        self.waits_since_ns -= by_ns;
    }

    fn work(&mut self, stage: &mut Stage<'_>) -> Done {
        self.keep_bonds(stage);
        while let Some(call) = self.manage.take() {
            let success = self.order(call.request.command);
            call.answer(ManageLifecycleNodesResponse { success });
        }
        while let Some(call) = self.is_active.take() {
            call.answer(TriggerResponse { success: self.is_up, ..TriggerResponse::default() });
        }
        while self.go_on(stage) {}
        if self.is_rising && !self.bonds.as_ref().is_some_and(Bonds::is_forming) {
            (self.is_rising, self.is_up) = (false, true);
            self.state.publish(std_msgs::Bool { data: true });
            self.say(stage, Level::Info, "managed nodes are active");
        }
        Done::No
    }
}
