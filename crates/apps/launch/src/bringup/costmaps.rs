//! Nav2 servers with built-in costmaps but without their algorithms.

use periplus_costmap::CostmapConfig;
use periplus_diagnostics::Diagnostics;
use periplus_graph::{
    Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, LifecycleState, Node,
    NodeSettings, StepOutcome, Transition,
};
use periplus_nav_nodes::costmap_2d::CostmapNode;

use crate::bringup::make::{self, ParameterFile};
use crate::bringup::parts::BuiltInRequest;

/// Lifecycle node that replaces a server, and its costmap in the same state.
pub(crate) struct Host {
    costmap: LifecycleNode<CostmapNode>,
    /// The part of the server that Periplus does not have.
    lacks: &'static str,
}

impl Host {
    /// Creates the node; the costmap gets a separate node in the namespace of the server.
    ///
    /// # Errors
    /// A message when it cannot be created.
    pub(crate) fn new(
        ask: &BuiltInRequest,
        node: &Node,
        graph: &Graph,
        (costmap, lacks): (&'static str, &'static str),
        notes: &mut Vec<String>,
    ) -> Result<LifecycleNode<Self>, String> {
        let around = node.names().namespace().trim_end_matches('/');
        let namespace = format!("{around}/{costmap}");
        let named = make::parameters_as(ask, &format!("{namespace}/{costmap}"), notes);
        let written = ParameterFile::new(&named, &format!("{namespace}/{costmap}"))?;
        let config = written.read(notes, |tree, found| match tree {
            Some(tree) => CostmapConfig::read_yaml(tree, costmap, None, found),
            None => CostmapConfig::read([], None, found),
        });
        let settings = make::remapped(NodeSettings::new(costmap).namespace(&namespace), ask);
        let failed = |error: GraphError| error.to_string();
        let inner = graph.node(settings).map_err(failed)?;
        let costmap = CostmapNode::at(inner, config).map_err(failed)?;
        costmap.with(|costmap| costmap.name_lines_of(written.sources));
        LifecycleNode::new(node.actor(Self { costmap, lacks })).map_err(failed)
    }

    /// Lets the costmap follow a transition of its server.
    fn follow(&self, transition: Transition) -> StepOutcome {
        let lifecycle = self.costmap.lifecycle();
        if lifecycle.state() == LifecycleState::Finalized {
            return StepOutcome::Failure;
        }
        lifecycle.change(transition);
        StepOutcome::Success
    }
}

impl LifecycleCallbacks for Host {
    fn on_configure(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.follow(Transition::Configure)
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let outcome = self.follow(Transition::Activate);
        let text = format!("its costmap is active; Periplus has no {} to go with it", self.lacks);
        io.node().log(Level::Warn, text);
        outcome
    }

    fn on_deactivate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.follow(Transition::Deactivate)
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.follow(Transition::Cleanup)
    }

    fn on_shutdown(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.follow(Transition::Shutdown)
    }
}

/// Creates a stand-alone costmap.
///
/// # Errors
/// A message when it cannot be created.
pub(crate) fn alone(
    ask: &BuiltInRequest,
    node: Node,
    notes: &mut Vec<String>,
) -> Result<LifecycleNode<CostmapNode>, String> {
    let name = node.names().name().to_owned();
    let named = make::parameters_as(ask, node.full_name(), notes);
    let written = ParameterFile::new(&named, node.full_name())?;
    let config = written.read(notes, |tree, found: &mut Diagnostics| match tree {
        Some(tree) => CostmapConfig::read_yaml(tree, &name, None, found),
        None => CostmapConfig::read([], None, found),
    });
    let costmap = CostmapNode::at(node, config).map_err(|error| error.to_string())?;
    costmap.with(|costmap| costmap.name_lines_of(written.sources));
    Ok(costmap)
}
