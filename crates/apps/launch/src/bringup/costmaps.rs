//! Nav2 servers with built-in costmaps but without their algorithms.

use periplus_costmap::CostmapConfig;
use periplus_diagnostics::Diagnostics;
use periplus_graph::{
    Actor, Graph, GraphError, Level, Lifecycle, LifecycleState, Node, NodeSettings, Step,
    StepOutcome, Transition,
};
use periplus_nav_nodes::costmap_2d::CostmapNode;

use crate::bringup::make::{self, ParameterFile};
use crate::bringup::parts::BuiltInRequest;

/// Lifecycle node that replaces a server, and its costmap in the same state.
pub(crate) struct Host {
    _actor: Actor<CostmapNode>,
    life: Lifecycle,
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
    ) -> Result<Self, String> {
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
        costmap.name_lines_of(written.sources);
        let mut actor = node.actor(costmap);
        let life = actor
            .managed(move |costmap, step, io| {
                let outcome = follow(costmap, step);
                if step == Step::Activate {
                    let text =
                        format!("its costmap is active; Periplus has no {lacks} to go with it");
                    io.node().log(Level::Warn, text);
                }
                outcome
            })
            .map_err(failed)?;
        Ok(Self { _actor: actor, life })
    }

    pub(crate) fn life(&self) -> &Lifecycle {
        &self.life
    }
}

/// The costmap follows the transitions of its server.
fn follow(costmap: &CostmapNode, step: Step) -> StepOutcome {
    let life = costmap.life();
    let transition = match step {
        Step::Configure => Transition::Configure,
        Step::Activate => Transition::Activate,
        Step::Deactivate => Transition::Deactivate,
        Step::Cleanup | Step::Error => Transition::Cleanup,
        Step::Shutdown => Transition::Shutdown,
    };
    if life.state() == LifecycleState::Finalized {
        return StepOutcome::Failure;
    }
    life.change(transition);
    StepOutcome::Success
}

/// Creates a stand-alone costmap.
///
/// # Errors
/// A message when it cannot be created.
pub(crate) fn alone(
    ask: &BuiltInRequest,
    node: Node,
    notes: &mut Vec<String>,
) -> Result<CostmapNode, String> {
    let name = node.names().name().to_owned();
    let named = make::parameters_as(ask, node.full_name(), notes);
    let written = ParameterFile::new(&named, node.full_name())?;
    let config = written.read(notes, |tree, found: &mut Diagnostics| match tree {
        Some(tree) => CostmapConfig::read_yaml(tree, &name, None, found),
        None => CostmapConfig::read([], None, found),
    });
    let costmap = CostmapNode::at(node, config).map_err(|error| error.to_string())?;
    costmap.name_lines_of(written.sources);
    Ok(costmap)
}
