//! Estimator nodes beside a robot: EKF, costmaps, localization, mapping.

mod costmap_file;
mod costmaps;
mod localization;
mod mapping;
mod namespace;
mod navigation;
mod open_rmf;
pub(crate) mod profile;
mod robot_pose;
mod selection;

use std::io::{self, Write};
use std::path::PathBuf;

use periplus_graph::Graph;
use periplus_nav_nodes::ekf_node::EkfNode;
use periplus_nav_nodes::slam_toolbox::Pace;
use periplus_sim::Simulation;

pub use costmap_file::{CostmapFile, read as read_costmaps, read_text as read_costmap_text};
pub use costmaps::{CostmapRequest, CostmapSource, Costmaps, FloorPoint};
pub use localization::{Localization, ParameterFile, amcl_parameters};
pub use mapping::{MappingNode, MappingRequest, MappingSource, slam_parameters};
pub use namespace::RobotNamespace;
pub use navigation::{
    Findings, GoalDriver, GoalOutcome, GoalReport, Navigation, NavigationDefaults,
    NavigationRequest, PathController, PlanningMap, RobotBase, pose_text,
};
pub use open_rmf::OpenRmfFleet;
pub(crate) use open_rmf::OpenRmfMember;
pub use profile::RobotProfile;
pub use robot_pose::{RobotPose, initial_pose_message};
pub use selection::EstimatorSelection;

use crate::error::RunError;
use crate::terminal;

/// Estimator nodes that run beside a robot.
#[derive(Clone, Debug, Default)]
pub struct EstimatorRequest {
    /// True to run both costmaps on the detected topics of the robot, unless `costmaps` sets
    /// others. The robot needs scans.
    pub has_stack: bool,
    /// True to detect topics and frames of the robot, and to run an EKF if nothing publishes the
    /// odometry transform.
    pub detects_robot: bool,
    /// True to run the nodes once beside each robot, in its namespace, all with one map server. Needs `detects_robot`.
    pub is_fleet: bool,
    /// Costmaps.
    pub costmaps: Option<CostmapRequest>,
    /// YAML of a map, parameter file of `map_server` and `amcl`, or both.
    pub localization: Vec<PathBuf>,
    /// Mapping.
    pub mapping: Option<MappingRequest>,
    /// Navigation; needs `detects_robot`.
    pub navigation: Option<NavigationRequest>,
}

/// Running estimator nodes of a robot.
#[derive(Default)]
pub struct Estimators {
    /// Namespace of the nodes.
    pub namespace: RobotNamespace,
    /// Mapping.
    pub mapping: Option<MappingNode>,
    /// Localization.
    pub localization: Option<Localization>,
    /// Costmaps; empty if there are none.
    pub costmaps: Costmaps,
    /// Servers of navigation; empty if there are none.
    pub navigation: Navigation,
    _filter: Option<EkfNode>,
}

impl EstimatorRequest {
    /// Detects topics and frames of the robots if the nodes need them, and prints them.
    ///
    /// # Errors
    /// When the world cannot run, or a robot has no scans for the stack.
    pub(crate) fn detect(
        &self,
        simulation: &mut Simulation,
        is_quiet: bool,
    ) -> Result<Vec<RobotProfile>, RunError> {
        if !self.detects_robot {
            return Ok(Vec::new());
        }
        let profiles = if self.is_fleet {
            RobotProfile::detect_fleet(simulation)?
        } else {
            vec![RobotProfile::detect(simulation)?]
        };
        if self.has_stack && profiles.iter().any(|profile| profile.scan.is_none()) {
            return Err(RunError::Robot(
                "no sensor of this robot publishes laser scans, which mapping, localization and \
                 costmaps need; give the robot a lidar",
            ));
        }
        if let ([profile], false) = (profiles.as_slice(), is_quiet) {
            if profile.needs_filter() {
                profile.print_filter();
            }
            if self.has_stack {
                profile.print();
            }
        }
        Ok(profiles)
    }

    /// Starts the nodes: those of each robot of a fleet, otherwise one set.
    ///
    /// # Errors
    /// When one of them cannot start.
    pub(crate) fn start(
        mut self,
        simulation: &Simulation,
        profiles: &mut [RobotProfile],
        pace: Pace,
    ) -> Result<Vec<Estimators>, RunError> {
        let graph = simulation.graph();
        if let Some(mapping) = &mut self.mapping {
            mapping.source.read_once()?;
        }
        if !self.is_fleet {
            let profile = profiles.first();
            let is_localized = !self.localization.is_empty();
            let localization =
                is_localized.then(|| Localization::from_files(graph, &self.localization, profile));
            let localization = localization.transpose()?;
            return Ok(vec![self.start_one(graph, profile, localization, pace, Findings::All)?]);
        }
        let mut localizations = Vec::new();
        if !self.localization.is_empty() {
            for profile in &mut *profiles {
                profile.namespace = profile.namespace.clone().sharing_map();
            }
            localizations = Localization::of_fleet(graph, &self.localization, profiles)?;
        }
        let mut localizations = localizations.into_iter();
        let robots = profiles.iter().enumerate().map(|(index, profile)| {
            let own = self.clone().of_robot(&profile.namespace);
            let findings = if index == 0 { Findings::All } else { Findings::Errors };
            own.start_one(graph, Some(profile), localizations.next(), pace, findings)
        });
        robots.collect()
    }

    /// The request of one robot: its results are in folders of its name.
    fn of_robot(mut self, namespace: &RobotNamespace) -> Self {
        let mapped = self.mapping.as_mut().and_then(|mapping| mapping.out.as_mut());
        let drawn = self.costmaps.as_mut().and_then(|costmaps| costmaps.images.as_mut());
        for folder in [mapped, drawn].into_iter().flatten() {
            folder.push(namespace.name());
        }
        self
    }

    fn start_one(
        self,
        graph: &Graph,
        profile: Option<&RobotProfile>,
        localization: Option<Localization>,
        pace: Pace,
        findings: Findings,
    ) -> Result<Estimators, RunError> {
        let namespace = profile.map(|profile| profile.namespace.clone()).unwrap_or_default();
        let filter = profile.filter(|profile| profile.needs_filter());
        let filter = filter.map(|profile| profile.filter(graph)).transpose();
        let filter = filter.map_err(|error| RunError::node("the odometry filter", error))?;
        let usual = profile.filter(|_| self.has_stack).map(|profile| CostmapRequest {
            source: CostmapSource::Text("the default costmaps", profile.costmap_parameters()),
            cells: Vec::new(),
            images: None,
        });
        let costmaps = self.costmaps.or(usual);
        let costmaps = costmaps.map(|request| Costmaps::within(graph, &namespace, request));
        let costmaps = costmaps.transpose()?.unwrap_or_default();
        costmaps.start();
        let mapping = self.mapping.map(|it| MappingNode::in_simulation(graph, it, pace, profile));
        let mapping = mapping.transpose()?;
        let navigation = self
            .navigation
            .zip(profile)
            .map(|(request, profile)| Navigation::start(graph, &request, profile, findings));
        let navigation = navigation.transpose()?.unwrap_or_default();
        Ok(Estimators { namespace, mapping, localization, costmaps, navigation, _filter: filter })
    }
}

impl Estimators {
    /// Writes the reports at the end of a run.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_reports(&self, out: &mut dyn Write) -> io::Result<()> {
        if !self.namespace.is_root() {
            writeln!(out, "{}:", self.namespace.name())?;
        }
        self.costmaps.write_report(out)?;
        if let Some(localization) = &self.localization {
            localization.write_report(out)?;
        }
        if let Some(mapping) = &self.mapping {
            mapping.write_report(out)?;
        }
        Ok(())
    }

    /// Writes the map, if it is requested, and prints its folder.
    ///
    /// # Errors
    /// When there is no map, or a file cannot be written.
    pub fn write_map(&self, is_quiet: bool) -> Result<(), RunError> {
        let folder = self.mapping.as_ref().map_or(Ok(None), MappingNode::write_results)?;
        if let Some(folder) = folder.filter(|_| !is_quiet) {
            terminal::say(&format!("map: {}", folder.display()));
        }
        Ok(())
    }
}
