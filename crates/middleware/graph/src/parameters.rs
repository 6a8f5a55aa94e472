//! Parameters of a node: declared once in a table, read by the node, read and set by others through
//! the six services that every node has.
//!
//! Source: `rcl_interfaces`, and `rclcpp/parameter_service.cpp` for what the services do.

pub(crate) mod convert;
pub(crate) mod services;
mod store;

use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rcl_interfaces::{Parameter as Named, ParameterEvent, ParameterValue};
use periplus_params::{Value, Values};

use crate::actor::Io;
use crate::common::lock;
use crate::node::{Node, NodeCore};
use crate::standard::{Apply, Change};
use crate::{Actor, GraphError};

pub(crate) use store::Store;

/// The parameters of a node. This is a handle: clones mean the same parameters.
#[derive(Clone)]
pub struct Parameters {
    node: Node,
}

impl Parameters {
    /// All values of the table, as they are now.
    ///
    /// # Panics
    /// Never: there is a table, or this would not be there.
    #[must_use]
    pub fn values(&self) -> Values {
        lock(&self.node.0.standard().store).values().expect("declared together with this").clone()
    }

    /// How often something was set; who keeps values looks whether this has changed.
    #[must_use]
    pub fn generation(&self) -> u64 {
        lock(&self.node.0.standard().store).generation()
    }

    /// Sets a parameter from inside the node, and tells others. The node is not asked.
    ///
    /// # Errors
    /// When there is no such parameter or the value does not fit, in words.
    pub fn set(&self, name: &str, value: Value) -> Result<(), String> {
        let named = Named { name: name.to_owned(), value: convert::to_message(value) };
        self.node.0.set_parameters(std::slice::from_ref(&named), None)
    }
}

impl Node {
    /// Lets others read and set these parameters; the node itself looks at
    /// [`Parameters::generation`] and [`Parameters::values`]. Values that arguments give
    /// ([`crate::Arguments`]) take the place of those that are given here.
    ///
    /// # Errors
    /// When the node has declared parameters already.
    pub fn parameters(&self, values: Values) -> Result<Parameters, GraphError> {
        self.0.declare(values)?;
        Ok(Parameters { node: self.clone() })
    }

    /// A parameter by its name, whatever it is; nothing when there is none or it is not set.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<ParameterValue> {
        lock(&self.0.standard().store).get(name)
    }
}

impl<S: Send + 'static> Actor<S> {
    /// Lets others read and set these parameters. When somebody sets some, and their kinds and
    /// ranges are right, `change` gets all values as they would be. If it agrees they hold, and it
    /// has put them to use; otherwise its reason is told to who sets.
    ///
    /// # Errors
    /// When the node has declared parameters already.
    pub fn parameters(
        &mut self,
        values: Values,
        change: impl FnMut(&mut S, &Values, &mut Io<'_, S>) -> Result<(), String> + Send + 'static,
    ) -> Result<Parameters, GraphError> {
        let node = self.node().clone();
        node.0.declare(values)?;
        let act = self.act(change);
        let apply: Arc<Apply> = Arc::new(move |values| {
            let mut outcome = Err("the node is going away".to_owned());
            act(&mut |change, state, io| outcome = change(state, values, io));
            outcome
        });
        let ordinal = node.0.next_ordinal();
        *lock(&node.0.standard().change) = Some(Change { ordinal, apply });
        self.keep(OwnChange { node: node.0.clone(), ordinal });
        Ok(Parameters { node })
    }
}

/// What is asked before parameters change, until this is dropped.
struct OwnChange {
    node: Arc<NodeCore>,
    ordinal: u64,
}

impl Drop for OwnChange {
    fn drop(&mut self) {
        let mut change = lock(&self.node.standard().change);
        let gone = change.take_if(|change| change.ordinal == self.ordinal);
        drop(change);
        drop(gone);
    }
}

impl NodeCore {
    fn declare(&self, values: Values) -> Result<(), GraphError> {
        let mut store = lock(&self.standard().store);
        if store.values().is_some() {
            let reason = format!(
                "`{}` has declared parameters already; put all of them into one table",
                self.full_name
            );
            return Err(GraphError::Value { reason });
        }
        let unfit = store.declare(values);
        drop(store);
        for reason in unfit {
            let message =
                format!("a parameter of `{}` keeps its default: {reason}", self.full_name);
            self.core.common.report(Diagnostic::error("bad-parameter", message));
        }
        self.tell_parameters(|store| ParameterEvent {
            new_parameters: store.declared(),
            ..Default::default()
        });
        Ok(())
    }

    /// Sets all of these or none. The store is free while the node is asked, so that it may look at
    /// its parameters.
    fn set_parameters(&self, set: &[Named], change: Option<Arc<Apply>>) -> Result<(), String> {
        let values = lock(&self.standard().store).propose(set)?;
        if let (Some(values), Some(apply)) = (&values, change) {
            apply(values)?;
        }
        self.tell_parameters(|store| store.accept(values, set));
        Ok(())
    }

    pub(crate) fn tell_parameters(&self, event: impl FnOnce(&mut Store) -> ParameterEvent) {
        let standard = self.standard();
        let mut store = lock(&standard.store);
        let event = event(&mut store);
        let stamp = Time::of_ns(self.core.common.clock.now_ns());
        standard.publish_event(ParameterEvent { stamp, node: self.full_name.to_string(), ..event });
    }
}
