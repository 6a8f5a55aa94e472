//! Node of the planner server.

use std::collections::BTreeMap;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_graph::{
    ActionSettings, Actor, Alarm, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode,
    LifecycleState, Node, ParameterRejection, Publisher, Qos, StepOutcome, Transition,
};
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs_main::{ComputePathThroughPoses, ComputePathToPose, IsPathValid};
use periplus_params::{Given, ParamValues};
use periplus_resources::{Host, MemoryHost};

use super::goals::PathAction;
use super::parameters::{PLANNER_SERVER, PlannerServerParams, PlannerSlot, planners};
use crate::costmap_2d::CostmapNode;
use crate::nav2_actions::serve_nav2_service;
use crate::navigation_plugins::NavigationPlugins;
use crate::server_plugins::{ServerParameters, changed, find_plugin};
use crate::simple_action_server::{SimpleActionServer, serve_simple_action};

/// Planner server as a lifecycle node.
pub struct PlannerServer {
    pub(super) params: PlannerServerParams,
    /// Release whose behaviour is used.
    pub(super) release: Nav2Release,
    pub(super) planners: Vec<PlannerSlot>,
    pub(super) costmap: LifecycleNode<CostmapNode>,
    pub(super) plan: Option<Publisher<Path>>,
    /// Path before smoothing, once a planner has one.
    pub(super) unsmoothed: Option<Publisher<Path>>,
    pub(super) to_pose: SimpleActionServer<ComputePathToPose>,
    pub(super) through_poses: SimpleActionServer<ComputePathThroughPoses>,
    /// By action, the alarm of a goal that waits for the costmap.
    pub(super) waiting: BTreeMap<&'static str, Alarm>,
    /// Errors in the parameters because of which it cannot be configured.
    failures: Vec<String>,
}

impl PlannerServer {
    /// Creates the server on a node, with parameters as written. It owns the node of the global costmap, whose
    /// release applies to the server as well.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn new<'a>(
        node: &Node,
        given: impl IntoIterator<Item = Given<'a>>,
        costmap: LifecycleNode<CostmapNode>,
        diagnostics: &mut Diagnostics,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let (plugins, files) = (NavigationPlugins::new(), MemoryHost::new());
        Self::with_plugins(node, given, costmap, (&plugins, &files), diagnostics)
    }

    /// Creates the server as [`Self::new`] does, with planners of other authors, and with the files that
    /// parameters name.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn with_plugins<'a>(
        node: &Node,
        given: impl IntoIterator<Item = Given<'a>>,
        costmap: LifecycleNode<CostmapNode>,
        (plugins, files): (&NavigationPlugins, &dyn Host),
        diagnostics: &mut Diagnostics,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let (release, forms) = costmap.with(|costmap| costmap.releases());
        let mut server = ServerParameters::new(&PLANNER_SERVER, given, diagnostics);
        let planners = planners(&mut server, &plugins.planners, files, release);
        let (mut values, failures) = server.finish();
        let params = PlannerServerParams::from_values(&values);
        for slot in &planners {
            values.add_group(slot.id.clone(), slot.values.clone());
        }
        let result_timeout_s = params.action_server_result_timeout_s;
        let mut actor = node.actor(Self {
            params,
            release,
            planners,
            costmap,
            plan: None,
            unsmoothed: None,
            to_pose: SimpleActionServer::default(),
            through_poses: SimpleActionServer::default(),
            waiting: BTreeMap::new(),
            failures,
        });
        let parameters = actor.parameters(values, |state, values, _| state.change(values))?;
        actor.with(|state| {
            // Command-line arguments override the parameter file.
            if let Err(error) = state.change(&parameters.values()) {
                state.failures.push(error.to_string());
            }
        });
        let settings = ActionSettings { result_timeout_ns: (result_timeout_s * 1e9) as i64 };
        serve::<ComputePathToPose>(&mut actor, forms, settings)?;
        serve::<ComputePathThroughPoses>(&mut actor, forms, settings)?;
        serve_nav2_service::<IsPathValid, Self>(&mut actor, forms, "is_path_valid", {
            |state, request, io| state.check_path(&request, io)
        })?;
        LifecycleNode::new(actor)
    }

    /// Node of the global costmap.
    pub fn costmap(&self) -> &LifecycleNode<CostmapNode> {
        &self.costmap
    }

    /// Applies changed parameters; either all or none.
    fn change(&mut self, all: &ParamValues) -> Result<(), ParameterRejection> {
        let params = PlannerServerParams::from_values(all);
        let running = self.planners.iter().any(|slot| slot.planner.is_some());
        if running
            && params.expected_planner_frequency_hz != self.params.expected_planner_frequency_hz
            && params.expected_planner_frequency_hz <= 0.0
        {
            let text = "`expected_planner_frequency` must be above 0 while the server runs";
            return Err(ParameterRejection::new(text));
        }
        let current = self.planners.iter().map(|slot| (slot.id.as_str(), &slot.values));
        let changes = changed(all, current);
        for (done, (index, name, value)) in changes.iter().enumerate() {
            let slot = &mut self.planners[*index];
            let Some(planner) = &mut slot.planner else { continue };
            if let Err(error) = planner.set_parameter(name, value) {
                let rejection = ParameterRejection::new(format!("`{}`: {error}", slot.id));
                for (index, name, _) in &changes[..done] {
                    let slot = &mut self.planners[*index];
                    let old = slot.values.get(name);
                    if let (Some(planner), Some(old)) = (&mut slot.planner, old) {
                        // It was accepted before.
                        let _ = planner.set_parameter(name, &old);
                    }
                }
                return Err(rejection);
            }
        }
        for (index, name, value) in changes {
            self.planners[index].values.set(&name, value);
        }
        self.params = params;
        Ok(())
    }

    /// Index of the planner that a goal asks for.
    ///
    /// # Errors
    /// A sentence with the available planners.
    pub(super) fn find_planner(&self, id: &str) -> Result<usize, String> {
        find_plugin(self.planners.iter().map(|slot| slot.id.as_str()), id, "planner")
    }

    /// Name of the planner that a goal asks for, for messages.
    pub(super) fn planner_name<'a>(&'a self, id: &'a str) -> &'a str {
        self.find_planner(id).map_or(id, |index| &self.planners[index].id)
    }

    fn follow(&self, transition: Transition) -> StepOutcome {
        if self.costmap.lifecycle().change_now(transition) {
            StepOutcome::Success
        } else {
            StepOutcome::Failure
        }
    }

    fn release_all(&mut self) {
        self.plan = None;
        self.unsmoothed = None;
        self.planners.iter_mut().for_each(PlannerSlot::cleanup);
    }
}

fn serve<A: PathAction>(
    actor: &mut Actor<PlannerServer>,
    forms: Nav2Release,
    settings: ActionSettings,
) -> Result<(), GraphError> {
    serve_simple_action::<A, PlannerServer>(
        actor,
        forms,
        A::NAME,
        settings,
        |state| Some(A::server(state)),
        |state, goal, _| {
            // Before main, a goal with an unknown planner is accepted and then fails.
            if state.release < Nav2Release::Main {
                return Ok(());
            }
            state.find_planner(A::planner_id(goal)).map(|_| ())
        },
        |state, io| state.start::<A>(io),
    )
}

impl LifecycleCallbacks for PlannerServer {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        for failure in &self.failures {
            io.node().log(Level::Fatal, format!("Failed to create global planner: {failure}"));
        }
        if !self.failures.is_empty() || self.follow(Transition::Configure) != StepOutcome::Success {
            return StepOutcome::Failure;
        }
        match io.node().publisher("plan", Qos::reliable(1)) {
            Ok(plan) => self.plan = Some(plan),
            Err(error) => {
                io.node().log(Level::Error, error);
                self.follow(Transition::Cleanup);
                return StepOutcome::Failure;
            }
        }
        let release = self.release;
        self.planners.iter_mut().for_each(|slot| slot.configure(release));
        let ids: Vec<&str> = self.planners.iter().map(|slot| slot.id.as_str()).collect();
        let text = format!("Planner Server has {} planners available.", ids.join(" "));
        io.node().log(Level::Info, text);
        if self.params.expected_planner_frequency_hz <= 0.0 {
            let text = "`expected_planner_frequency` is not above 0: slow plans give no warning";
            io.node().log(Level::Warn, text);
        }
        StepOutcome::Success
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let outcome = self.follow(Transition::Activate);
        if let Some(advice) = self.costmap.with(|costmap| costmap.footprint_advice()) {
            io.node().log_finding(&advice);
        }
        if outcome == StepOutcome::Success {
            self.to_pose.activate();
            self.through_poses.activate();
        }
        outcome
    }

    fn on_deactivate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.waiting.clear();
        self.to_pose.deactivate();
        self.through_poses.deactivate();
        self.follow(Transition::Deactivate);
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        // A node may be shut down while it is active.
        self.waiting.clear();
        self.to_pose.deactivate();
        self.through_poses.deactivate();
        self.release_all();
        if self.costmap.lifecycle().state() == LifecycleState::Active {
            self.follow(Transition::Deactivate);
        }
        self.follow(Transition::Cleanup);
        StepOutcome::Success
    }
}
