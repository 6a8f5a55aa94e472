//! Node of the smoother server.

use periplus_costmap::{CostmapView, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose2;
use periplus_graph::{
    ActionSettings, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node,
    ParameterRejection, Publisher, Qos, StepOutcome,
};
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs_main::{SmoothPath, SmoothPathGoal, SmoothPathResult};
use periplus_params::{Given, ParamValues};
use periplus_planners::{SmoothError, SmoothErrorKind, SmoothRequest, first_collision};
use periplus_tf_ros::pose;

use super::parameters::{SMOOTHER_SERVER, SmootherServerParams, SmootherSlot, smoothers};
use crate::costmap_2d::frames::Listener;
use crate::costmap_2d::pose2_of;
use crate::costmap_subscriber::{CostmapSubscriber, FootprintSubscriber};
use crate::server_plugins::{ServerParameters, changed, find_plugin};
use crate::simple_action_server::{SimpleActionServer, serve_simple_action};

/// Smoother server as a lifecycle node.
pub struct SmootherServer {
    params: SmootherServerParams,
    /// Release whose behaviour is used.
    release: Nav2Release,
    smoothers: Vec<SmootherSlot>,
    tf: Listener,
    inputs: Option<Inputs>,
    server: SimpleActionServer<SmoothPath>,
    /// Errors in the parameters because of which it cannot be configured.
    failures: Vec<String>,
}

/// Topics of a configured server.
struct Inputs {
    costmap: CostmapSubscriber,
    footprint: FootprintSubscriber,
    smoothed: Publisher<Path>,
}

impl SmootherServer {
    /// Creates the server on a node, with parameters as written. `release` is the release whose behaviour is used,
    /// `forms` the one whose messages are used.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn new<'a>(
        node: &Node,
        given: impl IntoIterator<Item = Given<'a>>,
        (release, forms): (Nav2Release, Nav2Release),
        diagnostics: &mut Diagnostics,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let mut server = ServerParameters::new(&SMOOTHER_SERVER, given, diagnostics);
        let smoothers = smoothers(&mut server);
        let (mut values, failures) = server.finish();
        for slot in &smoothers {
            values.add_group(slot.id.clone(), slot.values.clone());
        }
        let mut actor = node.actor(Self {
            params: SmootherServerParams::from_values(&values),
            release,
            smoothers,
            tf: Listener::new(node)?,
            inputs: None,
            server: SimpleActionServer::default(),
            failures,
        });
        let parameters = actor.parameters(values, |state, values, _| state.change(values))?;
        let result_timeout_s = actor.with(|state| {
            // Command-line arguments override the parameter file.
            if let Err(error) = state.change(&parameters.values()) {
                state.failures.push(error.to_string());
            }
            state.params.action_server_result_timeout_s
        });
        serve_simple_action::<SmoothPath, Self>(
            &mut actor,
            forms,
            "smooth_path",
            ActionSettings { result_timeout_ns: (result_timeout_s * 1e9) as i64 },
            |state| Some(&mut state.server),
            |state, goal, _| {
                // Before main, a goal that is not valid is accepted and then fails.
                if state.release < Nav2Release::Main {
                    return Ok(());
                }
                state.validate(goal).map(|_| ()).map_err(|error| error.to_string())
            },
            |state, io| state.work(io),
        )?;
        actor.on_jump(|state, _| state.tf.forget());
        LifecycleNode::new(actor)
    }

    /// Applies changed parameters; those of smoothers are read when the server is configured.
    fn change(&mut self, all: &ParamValues) -> Result<(), ParameterRejection> {
        let current = self.smoothers.iter().map(|slot| (slot.id.as_str(), &slot.values));
        for (index, name, value) in changed(all, current) {
            let slot = &mut self.smoothers[index];
            if let Some(smoother) = &mut slot.smoother {
                let refused = |error| ParameterRejection::new(format!("`{}`: {error}", slot.id));
                smoother.set_parameter(&name, &value).map_err(refused)?;
            }
            slot.values.set(&name, value);
        }
        self.params = SmootherServerParams::from_values(all);
        Ok(())
    }

    /// Index of the smoother of a goal.
    fn validate(&self, goal: &SmoothPathGoal) -> Result<usize, SmoothError> {
        let ids = self.smoothers.iter().map(|slot| slot.id.as_str());
        let index = find_plugin(ids, &goal.smoother_id, "smoother")
            .map_err(|text| SmoothError::new(SmoothErrorKind::InvalidSmoother, text))?;
        if goal.path.poses.is_empty() {
            let text = "Requested path to smooth is empty";
            return Err(SmoothError::new(SmoothErrorKind::InvalidPath, text));
        }
        let mut poses = goal.path.poses.iter().map(|pose| pose2_of(&pose.pose));
        if let Some(wrong) = poses.position(|pose| !pose.is_finite()) {
            let text =
                format!("pose {wrong} of the path has a component that is not a finite number");
            return Err(SmoothError::new(SmoothErrorKind::InvalidPath, text));
        }
        Ok(index)
    }

    fn work(&mut self, io: &mut Io<'_, Self>) {
        loop {
            if let Some(goal) = self.server.current_goal() {
                io.node().log(Level::Info, "Received a path to smooth.");
                let start_ns = io.now_ns();
                let mut result = SmoothPathResult { path: goal.path.clone(), ..Default::default() };
                match self.smooth(&goal, &mut result, io) {
                    Ok(()) => {
                        result.was_completed = true;
                        result.smoothing_duration = Duration::of_ns(io.now_ns() - start_ns);
                        self.server.succeeded_current(result);
                    }
                    Err(error) => {
                        io.node().log(Level::Error, &error);
                        result.error_code = error.kind.code();
                        result.error_msg = error.to_string();
                        self.server.terminate_current(result);
                    }
                }
            }
            if !self.server.finish() {
                return;
            }
        }
    }

    /// Smooths the path of a goal into a result.
    fn smooth(
        &mut self,
        goal: &SmoothPathGoal,
        result: &mut SmoothPathResult,
        io: &mut Io<'_, Self>,
    ) -> Result<(), SmoothError> {
        let index = self.validate(goal)?;
        let unknown = |text: String| SmoothError::new(SmoothErrorKind::Unknown, text);
        let (Some(inputs), Some(smoother)) =
            (&mut self.inputs, &mut self.smoothers[index].smoother)
        else {
            return Err(unknown("the server is not configured".to_owned()));
        };
        self.tf.listen();
        inputs.footprint.receive(&self.tf, &self.params.robot_base_frame);
        if let Err(why) = inputs.costmap.receive() {
            io.node().log(Level::Error, why);
        }
        let own: Vec<Pose2> = goal.path.poses.iter().map(|pose| pose2_of(&pose.pose)).collect();
        // Path in the frame of the costmap, if there is one.
        let costmap_from_path = match inputs.costmap.latest() {
            Some((frame, _)) if *frame != goal.path.header.frame_id => {
                let found = self.tf.at(frame, &goal.path.header.frame_id, 0);
                Pose2::from(found.map_err(|why| unknown(why.to_string()))?.0)
            }
            _ => Pose2::IDENTITY,
        };
        let path: Vec<Pose2> = own.iter().map(|pose| costmap_from_path * *pose).collect();
        let no_footprint = periplus_costmap::Footprint::default();
        let view = inputs.costmap.latest().map(|(_, costs)| CostmapView {
            costs,
            footprint: inputs.footprint.latest().unwrap_or(&no_footprint),
            is_circular: false,
            // The check of Nav2 by topics counts unknown cells as obstacles.
            tracks_unknown: true,
            inflation: None,
        });
        let (node, start_ns) = (io.node(), io.now_ns());
        let max_ns = goal.max_smoothing_duration.ns();
        let smoothed = smoother.smooth(SmoothRequest {
            path: &path,
            costmap: view,
            is_out_of_time: &mut || node.now_ns() - start_ns > max_ns,
        })?;
        let path_from_costmap = costmap_from_path.inverse();
        let header = goal.path.header.clone();
        result.path.poses = smoothed
            .iter()
            .map(|it| PoseStamped { header: header.clone(), pose: pose(path_from_costmap * *it) })
            .collect();
        inputs.smoothed.publish(result.path.clone());
        if goal.check_for_collisions {
            check_collisions(view, inputs.footprint.latest().is_some(), &smoothed, &self.params)?;
        }
        Ok(())
    }
}

/// Tests the smoothed path for collisions; a costmap or footprint that was not received counts as one.
fn check_collisions(
    costmap: Option<CostmapView<'_>>,
    has_footprint: bool,
    path: &[Pose2],
    params: &SmootherServerParams,
) -> Result<(), SmoothError> {
    let collision = |text: String| Err(SmoothError::new(SmoothErrorKind::Collision, text));
    let Some(costmap) = costmap else {
        return collision(format!(
            "the path cannot be checked for collisions: no costmap was received on `{}` (`costmap_topic`)",
            params.costmap_topic
        ));
    };
    if !has_footprint {
        return collision(format!(
            "the path cannot be checked for collisions: no footprint was received on `{}` (`footprint_topic`)",
            params.footprint_topic
        ));
    }
    let Some(index) = first_collision(&costmap, path) else { return Ok(()) };
    let Pose2 { x_m, y_m, yaw_rad } = path[index];
    let why = match costmap.costs.cost_at(x_m, y_m) {
        None => "outside of the costmap".to_owned(),
        Some(centre) => {
            let outline = costmap.footprint.cost(costmap.costs, path[index]);
            format!("cost {centre} at its centre, {outline} along the footprint")
        }
    };
    collision(format!(
        "Smoothed path leads to a collision at x: {x_m:.2}, y: {y_m:.2}, theta: {yaw_rad:.2} (pose {index}: {why})"
    ))
}

impl LifecycleCallbacks for SmootherServer {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        for failure in &self.failures {
            io.node().log(Level::Fatal, format!("Failed to create smoother: {failure}"));
        }
        if !self.failures.is_empty() {
            return StepOutcome::Failure;
        }
        let node = io.node();
        let inputs = || {
            Ok::<_, GraphError>(Inputs {
                costmap: CostmapSubscriber::new(node, &self.params.costmap_topic)?,
                footprint: FootprintSubscriber::new(node, &self.params.footprint_topic)?,
                smoothed: node.publisher("plan_smoothed", Qos::reliable(1))?,
            })
        };
        match inputs() {
            Ok(inputs) => self.inputs = Some(inputs),
            Err(error) => {
                node.log(Level::Error, error);
                return StepOutcome::Failure;
            }
        }
        self.smoothers.iter_mut().for_each(SmootherSlot::configure);
        let ids: Vec<&str> = self.smoothers.iter().map(|slot| slot.id.as_str()).collect();
        let text = format!("Smoother Server has {} smoothers available.", ids.join(" "));
        node.log(Level::Info, text);
        StepOutcome::Success
    }

    fn on_activate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.server.activate();
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.server.deactivate();
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.server.deactivate();
        self.inputs = None;
        self.smoothers.iter_mut().for_each(|slot| slot.smoother = None);
        StepOutcome::Success
    }
}
