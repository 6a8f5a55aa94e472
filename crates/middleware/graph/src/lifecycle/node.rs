//! Managed nodes with callbacks.

use super::{Lifecycle, Step, StepOutcome};
use crate::actor::Io;
use crate::{Actor, GraphError, Node};

/// Callbacks of a [`LifecycleNode`], as in `rclcpp_lifecycle::LifecycleNode`. Those that a node does
/// not define succeed without an effect.
pub trait LifecycleCallbacks: Sized + Send + 'static {
    /// Allocates resources: topics, buffers, the estimator.
    fn on_configure(&mut self, _io: &mut Io<'_, Self>) -> StepOutcome {
        StepOutcome::Success
    }

    /// Starts operation. [`Node::is_active`] is true after it succeeds.
    fn on_activate(&mut self, _io: &mut Io<'_, Self>) -> StepOutcome {
        StepOutcome::Success
    }

    /// Stops operation. [`Node::is_active`] is false already.
    fn on_deactivate(&mut self, _io: &mut Io<'_, Self>) -> StepOutcome {
        StepOutcome::Success
    }

    /// Releases the resources of [`LifecycleCallbacks::on_configure`].
    fn on_cleanup(&mut self, _io: &mut Io<'_, Self>) -> StepOutcome {
        StepOutcome::Success
    }

    /// Shuts down, from any state; by default a cleanup.
    fn on_shutdown(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.on_cleanup(io)
    }

    /// Cleans up after an error; by default like a cleanup. The node is unconfigured after it
    /// succeeds, otherwise finalized.
    fn on_error(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.on_cleanup(io)
    }
}

/// A managed node: a state whose callbacks run in the transitions that a lifecycle manager
/// requests.
///
/// ```
/// use periplus_graph::{Graph, Io, LifecycleCallbacks, LifecycleNode, NodeSettings, StepOutcome};
///
/// struct Driver {
///     is_open: bool,
/// }
///
/// impl LifecycleCallbacks for Driver {
///     fn on_configure(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
///         self.is_open = true;
///         StepOutcome::Success
///     }
/// }
///
/// let graph = Graph::new();
/// let node = graph.node(NodeSettings::new("driver"))?;
/// let driver = LifecycleNode::new(node.actor(Driver { is_open: false }))?;
/// driver.start();
/// graph.settle();
/// assert!(driver.lifecycle().is_active() && driver.with(|driver| driver.is_open));
/// # Ok::<(), periplus_graph::GraphError>(())
/// ```
#[must_use = "the node stops reacting when this is dropped"]
pub struct LifecycleNode<S> {
    actor: Actor<S>,
    lifecycle: Lifecycle,
}

impl<S: LifecycleCallbacks> LifecycleNode<S> {
    /// Makes the node of an actor a managed one, unconfigured at first: it gets the five lifecycle
    /// services and `~/transition_event`.
    ///
    /// # Errors
    /// When the node is managed already.
    pub fn new(mut actor: Actor<S>) -> Result<Self, GraphError> {
        let lifecycle = actor.managed(|state: &mut S, step, io| match step {
            Step::Configure => state.on_configure(io),
            Step::Activate => state.on_activate(io),
            Step::Deactivate => state.on_deactivate(io),
            Step::Cleanup => state.on_cleanup(io),
            Step::Shutdown => state.on_shutdown(io),
            Step::Error => state.on_error(io),
        })?;
        Ok(Self { actor, lifecycle })
    }

    /// The node.
    #[must_use]
    pub fn node(&self) -> &Node {
        self.actor.node()
    }

    /// The lifecycle, to observe the state and to change it.
    #[must_use]
    pub fn lifecycle(&self) -> &Lifecycle {
        &self.lifecycle
    }

    /// Configures and activates the node where no lifecycle manager does.
    pub fn start(&self) {
        self.lifecycle.start();
    }

    /// Accesses the state between callbacks.
    pub fn with<R>(&self, look: impl FnOnce(&mut S) -> R) -> R {
        self.actor.with(look)
    }
}
