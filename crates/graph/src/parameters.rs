//! Parameters of a node: declared once in a table, read by the node, read and set by others through
//! the six services that every ROS 2 node has.
//!
//! Source: `rcl_interfaces`, and `rclcpp/parameter_service.cpp` for what the services do.

mod convert;
mod services;

use std::sync::{Arc, Mutex};

use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rcl_interfaces::{Parameter as Named, ParameterEvent, SetParametersResult};
use periplus_params::{Kind, Value, Values};

use crate::common::{Common, lock};
use crate::node::Node;
use crate::{Actor, GraphError, Publisher, Qos};

/// The parameter that every node has beside those of its table.
const USE_SIM_TIME: &str = "use_sim_time";

/// The parameters of a node. This is a handle: clones mean the same parameters.
#[derive(Clone)]
pub struct Parameters {
    store: Arc<Mutex<Store>>,
    /// For a node without an actor of its own, the one that answers.
    _answers: Option<Arc<Actor<()>>>,
}

struct Store {
    values: Values,
    generation: u64,
    events: Publisher<ParameterEvent>,
    common: Arc<Common>,
    node: Arc<str>,
}

impl Parameters {
    /// All values, as they are now.
    #[must_use]
    pub fn values(&self) -> Values {
        lock(&self.store).values.clone()
    }

    /// How often something was set; who keeps values looks whether this has changed.
    #[must_use]
    pub fn generation(&self) -> u64 {
        lock(&self.store).generation
    }
}

impl Node {
    /// Lets others read and set these parameters; the node itself looks at
    /// [`Parameters::generation`] and [`Parameters::values`].
    ///
    /// # Errors
    /// When the node has parameters already.
    pub fn parameters(&self, values: Values) -> Result<Parameters, GraphError> {
        let mut answers = self.actor(());
        let parameters = answers.parameters(values, |(), _, _| Ok(()))?;
        Ok(Parameters { _answers: Some(Arc::new(answers)), ..parameters })
    }
}

impl Store {
    fn new(node: &Node, values: Values) -> Result<Self, GraphError> {
        let events = node.publisher("/parameter_events", Qos::parameters())?;
        let common = node.0.core.common.clone();
        let store = Self { values, generation: 0, events, common, node: node.0.full_name.clone() };
        let all = store.names().into_iter().map(|name| store.named(name));
        store.tell(ParameterEvent { new_parameters: all.collect(), ..Default::default() });
        Ok(store)
    }

    /// The names of all parameters, sorted.
    fn names(&self) -> Vec<&'static str> {
        let table = self.values.table();
        let declared = table.parameters.iter().filter(|one| one.kind != Kind::Group);
        let mut names: Vec<_> = declared.map(|one| one.name).chain([USE_SIM_TIME]).collect();
        names.sort_unstable();
        names
    }

    fn get(&self, name: &str) -> Option<Value> {
        if name == USE_SIM_TIME {
            return Some(Value::Bool(self.common.clock.is_simulated()));
        }
        let parameter = self.values.table().find(name)?;
        self.values.get(parameter.name)
    }

    fn named(&self, name: &str) -> Named {
        let value = self.get(name).map(convert::to_message).unwrap_or_default();
        Named { name: name.to_owned(), value }
    }

    /// The values as they would be with all of these set. The error is for the one who sets.
    fn propose(&self, set: &[Named]) -> Result<Values, String> {
        let mut values = self.values.clone();
        let table = values.table();
        for Named { name, value } in set {
            let value = convert::from_message(value)
                .map_err(|reason| format!("`{name}`: the value {reason}"))?;
            if name == USE_SIM_TIME {
                self.check_sim_time(&value)?;
                continue;
            }
            let parameter = table.find(name).filter(|one| one.kind != Kind::Group);
            let Some(parameter) = parameter else {
                let near = periplus_diagnostics::closest(name, table.names());
                let near = near.map(|near| format!(", did you mean `{near}`?"));
                return Err(format!(
                    "{} has no parameter `{name}`{}",
                    self.node,
                    near.unwrap_or_default()
                ));
            };
            let value =
                value.fit(parameter).map_err(|reason| format!("`{name}`: the value {reason}"))?;
            values.set(name, value);
        }
        Ok(values)
    }

    fn check_sim_time(&self, value: &Value) -> Result<(), String> {
        let is_simulated = self.common.clock.is_simulated();
        if *value == Value::Bool(is_simulated) {
            return Ok(());
        }
        let time = if is_simulated { "simulated time" } else { "the time of the machine" };
        Err(format!("`{USE_SIM_TIME}` is {is_simulated}: all nodes of this program run on {time}"))
    }

    /// These values hold from now on.
    fn accept(&mut self, values: Values, set: &[Named]) {
        self.values = values;
        self.generation += 1;
        let changed = set.iter().map(|one| self.named(&one.name)).collect();
        self.tell(ParameterEvent { changed_parameters: changed, ..Default::default() });
    }

    fn tell(&self, event: ParameterEvent) {
        let stamp = stamp(self.common.clock.now_ns());
        self.events.publish(ParameterEvent { stamp, node: self.node.to_string(), ..event });
    }
}

fn stamp(time_ns: i64) -> Time {
    let seconds = time_ns.div_euclid(1_000_000_000);
    let nanoseconds = time_ns.rem_euclid(1_000_000_000);
    // After 2038 ROS cannot tell the time either.
    let sec = i32::try_from(seconds).unwrap_or(i32::MAX);
    Time { sec, nanosec: u32::try_from(nanoseconds).unwrap_or_default() }
}

fn result(outcome: Result<(), String>) -> SetParametersResult {
    match outcome {
        Ok(()) => SetParametersResult { successful: true, reason: String::new() },
        Err(reason) => SetParametersResult { successful: false, reason },
    }
}
