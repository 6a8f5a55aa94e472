//! Recovery of nodes after a bond broke.
//!
//! Source: `LifecycleManager::checkBondRespawnConnection` of Nav2 (parameters
//! `attempt_respawn_reconnection` and `bond_respawn_max_duration`): the states of all nodes are
//! requested every second; once all have responded, the system is restarted.

use std::collections::BTreeMap;

use periplus_graph::{Client, GraphError, Node, Pending};
use periplus_msgs::lifecycle_msgs::{GetState, GetStateRequest};

/// Period of state requests \[ns\]; the value of Nav2.
const PERIOD_NS: i64 = 1_000_000_000;

/// Timeout of a response \[ns\]; Nav2's `service_timeout`.
pub(super) const SERVICE_TIMEOUT_NS: i64 = 5_000_000_000;

/// Requests the states of nodes.
pub(super) struct Respawn {
    clients: BTreeMap<String, Client<GetState>>,
    max_duration_ns: i64,
    attempt: Option<Attempt>,
}

/// Failure that nodes may recover from.
struct Attempt {
    since_ns: i64,
    asked_ns: Option<i64>,
    pending: BTreeMap<String, Pending<GetState>>,
    states: BTreeMap<String, u8>,
}

/// Result of a poll.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum RespawnStatus {
    /// Idle.
    Idle,
    /// A node has not responded yet.
    PartState,
    /// All nodes have responded; their states by name.
    Back(BTreeMap<String, u8>),
    /// A node did not come back in time.
    GivenUp,
}

impl Respawn {
    /// Recovery of these nodes; each attempt ends after `max_duration_s`.
    ///
    /// # Errors
    /// An error when a service has another type.
    pub(super) fn new(
        node: &Node,
        names: &[String],
        max_duration_s: f64,
    ) -> Result<Self, GraphError> {
        let mut clients = BTreeMap::new();
        for name in names {
            clients.insert(name.clone(), node.client(&format!("{name}/get_state"))?);
        }
        #[allow(clippy::cast_possible_truncation, reason = "saturates")]
        let max_duration_ns = (max_duration_s * 1e9) as i64;
        Ok(Self { clients, max_duration_ns, attempt: None })
    }

    /// Starts an attempt.
    pub(super) fn begin(&mut self, now_ns: i64) {
        let (pending, states) = Default::default();
        self.attempt = Some(Attempt { since_ns: now_ns, asked_ns: None, pending, states });
    }

    /// Cancels an attempt.
    pub(super) fn cancel(&mut self) {
        self.attempt = None;
    }

    /// Sends requests, and collects responses.
    pub(super) fn look(&mut self, now_ns: i64) -> RespawnStatus {
        let Some(attempt) = &mut self.attempt else { return RespawnStatus::Idle };
        attempt.since_ns = attempt.since_ns.min(now_ns);
        let Attempt { pending, states, .. } = attempt;
        pending.retain(|name, pending| match pending.take() {
            Some(answer) => {
                if let Ok(answer) = answer {
                    states.insert(name.clone(), answer.current_state.id);
                }
                false
            }
            None => true,
        });
        if states.len() == self.clients.len() {
            let states = std::mem::take(states);
            self.attempt = None;
            return RespawnStatus::Back(states);
        }
        if now_ns - attempt.since_ns >= self.max_duration_ns {
            self.attempt = None;
            return RespawnStatus::GivenUp;
        }
        let age_ns = attempt.asked_ns.map(|asked_ns| now_ns - asked_ns);
        let is_over = pending.is_empty() || age_ns.is_some_and(|age| age >= SERVICE_TIMEOUT_NS);
        if age_ns.is_none_or(|age_ns| !(0..PERIOD_NS).contains(&age_ns)) && is_over {
            attempt.asked_ns = Some(now_ns);
            // All in the same round: a node that responded before may be gone by now.
            states.clear();
            let ready = self.clients.iter().filter(|(_, client)| client.is_ready());
            *pending = ready
                .map(|(name, client)| (name.clone(), client.call(GetStateRequest::default())))
                .collect();
        }
        RespawnStatus::PartState
    }
}
