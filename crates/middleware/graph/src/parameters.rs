//! Parameters of a node: declared once in a table, read by the node, and read and set by other
//! nodes through the six parameter services.
//!
//! Source: `rcl_interfaces`, and `rclcpp/parameter_service.cpp` for the behaviour of the services.

pub(crate) mod convert;
pub(crate) mod services;
mod store;

use std::fmt;
use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rcl_interfaces::{Parameter as Named, ParameterEvent, ParameterValue};
use periplus_params::{ParamValue, ParamValues};

use crate::actor::Io;
use crate::common::lock;
use crate::node::{Node, NodeCore};
use crate::standard::{Apply, Change};
use crate::{Actor, GraphError};

pub(crate) use store::Store;

/// Reason for which a parameter was not set, as the caller of the service gets it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterRejection {
    reason: String,
}

impl ParameterRejection {
    /// Creates a rejection with the text of an error.
    pub fn new(reason: impl fmt::Display) -> Self {
        Self { reason: reason.to_string() }
    }
}

impl fmt::Display for ParameterRejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for ParameterRejection {}

/// The parameters of a node. This is a handle: clones refer to the same parameters.
#[derive(Clone)]
pub struct Parameters {
    node: Node,
}

impl Parameters {
    /// Returns the current values of the table.
    ///
    /// # Panics
    /// Never: the table is declared before this is created.
    #[must_use]
    pub fn values(&self) -> ParamValues {
        lock(&self.node.0.standard().store)
            .values()
            .expect("declared before this is created")
            .clone()
    }

    /// Counter that changes with every change of a value; compare it to detect changes.
    #[must_use]
    pub fn generation(&self) -> u64 {
        lock(&self.node.0.standard().store).generation()
    }

    /// Sets a parameter from inside the node and publishes the change. The node's own callback is
    /// not called.
    ///
    /// # Errors
    /// When there is no such parameter or the value is not valid.
    pub fn set(&self, name: &str, value: ParamValue) -> Result<(), ParameterRejection> {
        let named = Named { name: name.to_owned(), value: convert::to_message(value) };
        self.node
            .0
            .set_parameters(std::slice::from_ref(&named), None)
            .map_err(ParameterRejection::new)
    }
}

impl Node {
    /// Declares parameters that other nodes can read and set; the node polls
    /// [`Parameters::generation`] and [`Parameters::values`]. Values from arguments
    /// ([`crate::Arguments`]) override the given ones.
    ///
    /// # Errors
    /// When the node has declared parameters already.
    pub fn parameters(&self, values: ParamValues) -> Result<Parameters, GraphError> {
        self.0.declare(values)?;
        Ok(Parameters { node: self.clone() })
    }

    /// Returns a parameter by name; none if it does not exist or is not set.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<ParameterValue> {
        lock(&self.0.standard().store).get(name)
    }
}

impl<S: Send + 'static> Actor<S> {
    /// Declares parameters that other nodes can read and set. When a request passes the checks of
    /// type and range, `change` gets all values as they would be. If it returns `Ok`, it has
    /// applied them and they are stored; otherwise its error is returned to the caller.
    ///
    /// # Errors
    /// When the node has declared parameters already.
    pub fn parameters(
        &mut self,
        values: ParamValues,
        change: impl FnMut(&mut S, &ParamValues, &mut Io<'_, S>) -> Result<(), ParameterRejection>
        + Send
        + 'static,
    ) -> Result<Parameters, GraphError> {
        let node = self.node().clone();
        node.0.declare(values)?;
        let act = self.act(change);
        let apply: Arc<Apply> = Arc::new(move |values| {
            let mut outcome = Err("the node is shutting down".to_owned());
            act(&mut |change, state, io| {
                outcome = change(state, values, io).map_err(|rejection| rejection.reason);
            });
            outcome
        });
        let ordinal = node.0.next_ordinal();
        *lock(&node.0.standard().change) = Some(Change { ordinal, apply });
        self.keep(OwnChange { node: node.0.clone(), ordinal });
        Ok(Parameters { node })
    }
}

/// A callback for changes of parameters, removed when this is dropped.
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
    fn declare(&self, values: ParamValues) -> Result<(), GraphError> {
        let mut store = lock(&self.standard().store);
        if store.values().is_some() {
            let reason = format!(
                "`{}` has already declared its parameters; declare all of them in one table",
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
        self.publish_parameter_event(|store| ParameterEvent {
            new_parameters: store.declared(),
            ..Default::default()
        });
        Ok(())
    }

    /// Sets all of these parameters or none. The store is not locked during the node's callback, so
    /// that the callback can read parameters.
    fn set_parameters(&self, set: &[Named], change: Option<Arc<Apply>>) -> Result<(), String> {
        let values = lock(&self.standard().store).propose(set)?;
        if let (Some(values), Some(apply)) = (&values, change) {
            apply(values)?;
        }
        self.publish_parameter_event(|store| store.accept(values, set));
        Ok(())
    }

    pub(crate) fn publish_parameter_event(&self, event: impl FnOnce(&mut Store) -> ParameterEvent) {
        let standard = self.standard();
        let mut store = lock(&standard.store);
        let event = event(&mut store);
        let stamp = Time::of_ns(self.core.common.clock.now_ns());
        standard.publish_event(ParameterEvent { stamp, node: self.full_name.to_string(), ..event });
    }
}
