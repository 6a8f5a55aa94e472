//! Faults of a running simulation.

use std::sync::Arc;

use periplus_diagnostics::Diagnostics;
use periplus_graph::{GraphError, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::std_msgs::String as StringMessage;
use periplus_sim::Simulation;
use serde_json::{Value, json};

use crate::messages::MessageFaults;
use crate::read::InjectedFault;
use crate::world::WorldFault;

/// Latched topic with the list of faults as JSON.
pub const FAULT_TOPIC: &str = "/faults";

/// Applies faults to a running simulation.
///
/// Call [`FaultInjector::update`] before each step.
pub struct FaultInjector {
    messages: Arc<MessageFaults>,
    world: Vec<WorldFault>,
    list: Vec<Value>,
    findings: Diagnostics,
    publisher: Option<Publisher<StringMessage>>,
    _node: Option<Node>,
}

impl FaultInjector {
    /// Starts with no faults; `seed` is the seed of all their random streams.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            messages: Arc::new(MessageFaults::new(seed)),
            world: Vec::new(),
            list: Vec::new(),
            findings: Diagnostics::new(),
            publisher: None,
            _node: None,
        }
    }

    /// Adds a fault, also while its time window has begun, and publishes the list.
    ///
    /// # Errors
    /// When the graph refuses the publisher of the list.
    pub fn add(&mut self, simulation: &Simulation, fault: InjectedFault) -> Result<(), GraphError> {
        let graph = simulation.graph();
        if self.publisher.is_none() {
            let node = graph.node(NodeSettings::new("periplus_faults").keep_names())?;
            self.publisher = Some(node.publisher(FAULT_TOPIC, Qos::latched(1))?);
            self._node = Some(node);
        }
        self.list.push(to_json(&fault));
        if fault.kind.topic().is_some() {
            self.messages.add(self.list.len(), &fault);
            graph.set_interceptor(Some(self.messages.clone()));
        } else {
            self.world.push(WorldFault::new(fault));
        }
        if let Some(publisher) = &self.publisher {
            publisher.publish(StringMessage { data: json!(self.list).to_string() });
        }
        Ok(())
    }

    /// Starts and ends faults, and delivers the messages that were held back until now. Returns true if a fault of
    /// wheels or of the world has started or ended.
    pub fn update(&mut self, simulation: &mut Simulation) -> bool {
        let mut has_changed = false;
        for fault in &mut self.world {
            has_changed |= fault.update(simulation, &mut self.findings);
        }
        self.messages.release(simulation);
        has_changed
    }

    /// Faults that were added, as JSON.
    #[must_use]
    pub fn list(&self) -> &[Value] {
        &self.list
    }

    /// Returns and clears the findings: faults that failed or have no effect. At the end of a run (`is_end`) also those
    /// whose topic had no messages.
    pub fn take_findings(&mut self, is_end: bool) -> Diagnostics {
        let mut findings = std::mem::take(&mut self.findings);
        findings.append(self.messages.take_findings(is_end));
        findings
    }
}

/// JSON of a fault: kind, window and parameters as written.
fn to_json(fault: &InjectedFault) -> Value {
    let values = fault.kind.to_values();
    let is_window = |name: &str| matches!(name, "from" | "until");
    let parameters = values.table().names().filter(|name| !is_window(name));
    let parameters: serde_json::Map<String, Value> = parameters
        .filter_map(|name| Some((name.to_owned(), json!(values.get(name)?.to_string()))))
        .collect();
    json!({
        "kind": fault.kind.word(),
        "from_s": fault.from_s,
        "until_s": fault.until_s.is_finite().then_some(fault.until_s),
        "parameters": parameters,
    })
}
