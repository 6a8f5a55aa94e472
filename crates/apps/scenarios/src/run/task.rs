//! Work between the steps of a scenario.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};

use periplus_faults::FaultInjector;
use periplus_geometry::Pose2;
use periplus_graph::{Node, NodeSettings, Publisher, Qos};
use periplus_grid::{GridInfo, OccupancyGrid};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::nav_msgs::OccupancyGrid as MapMessage;
use periplus_session::nodes::{
    GoalDriver, Localization, Navigation, PlanningMap, initial_pose_message,
};
use periplus_session::{ProgressLine, RunEnd, SessionTask, SimulationSession};
use periplus_sim::{RunProgress, Simulation, Tick};
use serde_json::Value;

use super::ScenarioRunOptions;
use super::estimates::{EstimateFrames, EstimateRecord, Estimates};
use super::events::{EventRunner, EventTargets};
use super::observer::{Observer, TopicRecord};
use super::setup::{TRUE_MAP, planning_map};
use super::truth::{Truth, TruthRecord, grid_of};
use crate::error::ScenarioError;
use crate::file::{EventAction, EventTrigger, Scenario, planar_pose};
use crate::report::{GoalEnd, RunOutcome};

/// Record of a run, for the assertions.
#[derive(Clone, Debug, Default)]
pub(crate) struct RunRecord {
    pub(crate) truth: TruthRecord,
    pub(crate) estimates: EstimateRecord,
    pub(crate) topics: BTreeMap<String, TopicRecord>,
    pub(crate) log: Vec<String>,
    pub(crate) digest: Option<u64>,
    pub(crate) goals: Vec<GoalEnd>,
    pub(crate) goal_event_count: usize,
    pub(crate) problems: Vec<String>,
    pub(crate) faults: Vec<Value>,
    /// Map of SLAM with its origin in the world.
    pub(crate) slam_map: Option<OccupancyGrid>,
    /// Grid of the true map.
    pub(crate) grid: Option<GridInfo>,
    pub(crate) end_s: f64,
}

/// Work between the steps of a scenario.
pub(super) struct ScenarioTask {
    goals: Option<GoalDriver>,
    navigation: Navigation,
    _localization: Option<Localization>,
    initial_pose: Option<(Publisher<PoseWithCovarianceStamped>, Pose2)>,
    _map: Option<Publisher<MapMessage>>,
    injector: FaultInjector,
    events: EventRunner,
    observer: Observer,
    truth: Truth,
    estimates: Estimates,
    problems: Vec<String>,
    goal_poses: Vec<Option<Pose2>>,
    goal_ends_s: Vec<f64>,
    world_from_map: Pose2,
    grid: GridInfo,
    node: Node,
}

impl ScenarioTask {
    pub(super) fn new(
        scenario: &Scenario,
        session: &mut SimulationSession,
        options: &ScenarioRunOptions,
        seed: u64,
    ) -> Result<Self, ScenarioError> {
        let node = session.graph().node(NodeSettings::new("periplus_scenario").keep_names())?;
        let grid = grid_of(scenario);
        let start = scenario.start();
        let initial = initial_pose(scenario, session);
        // A true map has the frame of the world; other maps begin where the initial pose puts them.
        let is_true = scenario.nodes.localization.as_ref().is_some_and(|it| it.map == TRUE_MAP);
        let world_from_map = if is_true { Pose2::IDENTITY } else { start * initial.inverse() };
        let navigation = session.take_navigation().pop().unwrap_or_default();
        let goals = (!navigation.is_empty())
            .then(|| GoalDriver::new(session.graph(), &navigation.global_frame(), Vec::new()))
            .transpose()?;
        let (map, localization, initial_pose) = localize(scenario, session, &node, grid)?;
        let observer = Observer::start(session.graph(), watched(scenario), options.has_digest);
        let mut injector = FaultInjector::new(seed);
        for fault in &scenario.faults {
            injector.add(session.simulation(), fault.clone())?;
        }
        let frames = frames(scenario, session, world_from_map);
        let is_navigating = scenario.nodes.navigation.is_some();
        Ok(Self {
            events: EventRunner::new(
                scenario,
                &node,
                world_from_map.inverse(),
                options.search.clone(),
            )?,
            estimates: Estimates::new(&node, frames, is_navigating)?,
            truth: Truth::new(session.simulation_mut(), grid),
            goals,
            navigation,
            _localization: localization,
            initial_pose: initial_pose.map(|publisher| (publisher, initial)),
            _map: map,
            injector,
            observer,
            problems: Vec::new(),
            goal_poses: Vec::new(),
            goal_ends_s: Vec::new(),
            world_from_map,
            grid,
            node,
        })
    }

    /// Inserts the models of all events that spawn, to read their files.
    ///
    /// # Errors
    /// Files that cannot be read.
    pub(super) fn spawn_all(&self, simulation: &mut Simulation) -> Result<(), String> {
        self.events.spawn_all(simulation)
    }

    /// End of the run.
    pub(super) fn outcome(&self, session: &SimulationSession, stop: &AtomicBool) -> RunOutcome {
        match session.end() {
            RunEnd::Diverged(diverged) | RunEnd::ModelRemoved(diverged) => {
                RunOutcome::Failed(diverged.to_string())
            }
            _ if stop.load(Ordering::Relaxed) => RunOutcome::Interrupted,
            _ if self.events.have_goals_ended(self.goals.as_ref()) => RunOutcome::Complete,
            _ => RunOutcome::Timeout,
        }
    }

    /// Ends the run and returns its record.
    pub(super) fn finish(mut self, session: &mut SimulationSession) -> RunRecord {
        let now_ns = session.simulation().time_ns();
        self.truth.sample(session.simulation_mut(), false);
        if let Some(goals) = &mut self.goals {
            goals.finish(now_ns);
        }
        self.note_goal_ends(session.simulation());
        let findings = self.injector.take_findings(true);
        self.problems.extend(findings.iter().map(|finding| finding.message.clone()));
        let goals = self.goal_ends();
        let slam_map = session.mapping().and_then(|mapping| {
            let mut map = mapping.node.with(|node| node.map())?;
            map.info.origin = self.world_from_map * map.info.origin;
            Some(map)
        });
        // The interceptor may hold messages of the graph, and the graph holds the interceptor.
        session.graph().set_interceptor(None);
        let (topics, log, digest) = self.observer.finish(session.graph());
        RunRecord {
            truth: self.truth.finish(),
            estimates: self.estimates.finish(),
            topics,
            log,
            digest,
            goals,
            goal_event_count: self.events.goal_event_count(),
            problems: self.problems,
            faults: self.injector.list().to_vec(),
            slam_map,
            grid: Some(self.grid),
            end_s: now_ns as f64 * 1e-9,
        }
    }

    /// Notes the true pose of the robot at the end of each goal.
    fn note_goal_ends(&mut self, simulation: &Simulation) {
        let count = self.goals.as_ref().map_or(0, |goals| goals.reports().len());
        while self.goal_poses.len() < count {
            self.goal_poses.push(simulation.robot_pose().map(Pose2::from));
            self.goal_ends_s.push(simulation.time_ns() as f64 * 1e-9);
        }
    }

    fn goal_ends(&self) -> Vec<GoalEnd> {
        let in_world = self.events.goals_in_world();
        let reports = self.goals.as_ref().map_or(&[][..], |goals| goals.reports());
        let ends = reports.iter().zip(in_world).enumerate();
        ends.map(|(index, (report, goal))| GoalEnd {
            goal,
            pose: self.goal_poses.get(index).copied().flatten(),
            outcome: report.outcome.to_string(),
            is_success: report.outcome == periplus_session::nodes::GoalOutcome::Reached,
            end_s: self.goal_ends_s.get(index).copied().unwrap_or_default(),
            time_s: report.time_s,
            recoveries: report.recoveries,
        })
        .collect()
    }
}

impl SessionTask for ScenarioTask {
    fn before_step(&mut self, simulation: &mut Simulation, _line: &ProgressLine) -> Tick {
        if let Some((publisher, pose)) = self.initial_pose.take() {
            publisher.publish(initial_pose_message(pose));
        }
        let mut has_changed = self.injector.update(simulation);
        has_changed |= self.events.update(&mut EventTargets {
            simulation,
            injector: &mut self.injector,
            goals: self.goals.as_mut(),
            observer: &self.observer,
            node: &self.node,
            problems: &mut self.problems,
        });
        if let Some(goals) = &mut self.goals {
            goals.spin_once(simulation.time_ns(), || self.navigation.obstacle());
        }
        self.note_goal_ends(simulation);
        let has_goal = self.goals.as_ref().is_some_and(|goals| !goals.is_done());
        self.truth.sample(simulation, has_changed);
        self.estimates.sample(simulation, has_goal);
        if self.events.have_goals_ended(self.goals.as_ref()) { Tick::End } else { Tick::Go }
    }

    fn after_step(&mut self, _progress: RunProgress) {}
}

/// Pose of the robot in the map at the start.
fn initial_pose(scenario: &Scenario, session: &SimulationSession) -> Pose2 {
    match &scenario.nodes.localization {
        Some(params) if !params.initial_pose.is_empty() => planar_pose(&params.initial_pose),
        // The frames of the map and of the world are equal.
        Some(_) => scenario.start(),
        // The frame of a map of SLAM is the odometry frame of the start.
        None => session.profile().map_or(Pose2::IDENTITY, |profile| profile.odom_from_start),
    }
}

type LocalizationParts = (
    Option<Publisher<MapMessage>>,
    Option<Localization>,
    Option<Publisher<PoseWithCovarianceStamped>>,
);

/// Starts localization, and publishes the true map if it is on that.
fn localize(
    scenario: &Scenario,
    session: &mut SimulationSession,
    node: &Node,
    grid: GridInfo,
) -> Result<LocalizationParts, ScenarioError> {
    let Some(params) = &scenario.nodes.localization else { return Ok((None, None, None)) };
    let is_true = params.map == TRUE_MAP;
    let map = is_true.then(|| -> Result<_, ScenarioError> {
        let map = session.simulation_mut().truth_map(grid);
        let map =
            map.ok_or_else(|| ScenarioError::Failed("there is no robot to localize".into()))?;
        let publisher = node.publisher("/map", Qos::latched(1))?;
        publisher.publish(periplus_maps::to_message(&map, "map", Time::of_ns(0)));
        Ok(publisher)
    });
    let map = map.transpose()?;
    let file = (!is_true).then(|| scenario.resolve(&params.map));
    let own = params.parameters.as_deref().map(|name| scenario.resolve(name));
    let files: Vec<_> = file.into_iter().chain(own).collect();
    let profile = session.profile().cloned();
    let localization = Localization::from_files(session.graph(), &files, profile.as_ref())?;
    let publisher = node.publisher("/initialpose", Qos::reliable(1))?;
    Ok((map, Some(localization), Some(publisher)))
}

/// Topics whose messages are recorded for assertions and events.
fn watched(scenario: &Scenario) -> BTreeSet<String> {
    let full = |name: &str| format!("/{}", name.trim_start_matches('/'));
    let of_assertions = scenario.assertions.iter().filter_map(|assertion| {
        let values = &assertion.values;
        values.table().find("topic").and_then(|_| values.text("topic")).map(|it| full(&it))
    });
    let of_events = scenario.events.iter().filter_map(|event| match &event.trigger {
        EventTrigger::On { topic, .. } => Some(topic.clone()),
        _ => None,
    });
    of_assertions.chain(of_events).collect()
}

fn frames(
    scenario: &Scenario,
    session: &SimulationSession,
    world_from_map: Pose2,
) -> EstimateFrames {
    let profile = session.profile();
    let is_mapped = planning_map(scenario) != PlanningMap::Absent;
    EstimateFrames {
        map: is_mapped.then(|| "map".to_owned()),
        odom: profile.map_or("odom", |profile| profile.odom()).to_owned(),
        base: profile.map_or("base_link", |profile| profile.base()).to_owned(),
        world_from_map,
    }
}

impl Scenario {
    /// Returns true if an event sends a goal.
    pub(crate) fn has_goals(&self) -> bool {
        self.events.iter().any(|event| matches!(event.action, EventAction::Goal(_)))
    }
}
