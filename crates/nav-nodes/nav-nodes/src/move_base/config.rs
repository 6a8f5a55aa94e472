//! Configuration of the node from the parameters of ROS 1.

use std::fmt;

use periplus_costmap::CostmapConfig;
use periplus_diagnostics::Diagnostics;
use periplus_graph::NodeNames;
use periplus_params::ParamValues;
use periplus_yaml::YamlNode;

use super::costmaps::costmap_config;
use super::global_planner::GlobalPlanner;
use super::local_planner::LocalPlanner;
use super::params::{MOVE_BASE, MoveBaseParams};
use super::recovery::{Recovery, recoveries};
use super::values::{PrivateParameters, reading};
use crate::common_parameters::is_common;

/// Parameters of the node itself that its costmaps inherit.
const INHERITED: [&str; 5] =
    ["footprint", "robot_radius", "obstacle_range", "raytrace_range", "footprint_padding"];

/// Class that a parameter names and that does not exist, as a sentence with the known ones.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnknownMoveBaseClass {
    /// Class of `base_global_planner`.
    GlobalPlanner(String),
    /// Class of `base_local_planner`.
    LocalPlanner(String),
    /// Type of one of `recovery_behaviors`.
    Recovery(String),
}

impl fmt::Display for UnknownMoveBaseClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::GlobalPlanner(text) | Self::LocalPlanner(text) | Self::Recovery(text)) = self;
        f.write_str(text)
    }
}

impl std::error::Error for UnknownMoveBaseClass {}

/// Configuration of the node.
pub struct MoveBaseConfig {
    /// Parameters of the node itself, of [`MOVE_BASE`].
    pub values: ParamValues,
    /// Global costmap.
    pub global_costmap: CostmapConfig,
    /// Local costmap.
    pub local_costmap: CostmapConfig,
    pub(super) global_planner: GlobalPlanner,
    pub(super) local_planner: LocalPlanner,
    pub(super) recoveries: Vec<Recovery>,
}

impl MoveBaseConfig {
    /// Reads the private parameters of a node, as a tree. `names` are the names of the node, by which the topics of
    /// the costmaps are resolved.
    ///
    /// # Errors
    /// When a class does not exist. Other errors are reported, and defaults apply.
    pub fn read(
        private: Option<&YamlNode>,
        names: &NodeNames,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, UnknownMoveBaseClass> {
        let all = PrivateParameters::of_tree(private);
        let (own, other): (Vec<_>, Vec<_>) = all
            .given()
            .filter(|one| !one.name.contains('.'))
            .partition(|one| MOVE_BASE.find(one.name).is_some());
        for one in other.iter().filter(|one| !is_common(one.name) && !INHERITED.contains(&one.name))
        {
            diagnostics.push(MOVE_BASE.unknown(one));
        }
        let values = reading(diagnostics, |found| MOVE_BASE.check(own, None, found));
        let params = MoveBaseParams::from_values(&values);
        let global_planner = GlobalPlanner::new(&params.base_global_planner, &all, diagnostics)
            .map_err(UnknownMoveBaseClass::GlobalPlanner)?;
        let period_s = 1.0 / params.controller_frequency_hz;
        let local_planner =
            LocalPlanner::new(&params.base_local_planner, period_s, &all, diagnostics)
                .map_err(UnknownMoveBaseClass::LocalPlanner)?;
        let recoveries =
            recoveries(&params, &all, diagnostics).map_err(UnknownMoveBaseClass::Recovery)?;
        Ok(Self {
            global_costmap: costmap_config("global_costmap", &all, names, diagnostics),
            local_costmap: costmap_config("local_costmap", &all, names, diagnostics),
            values,
            global_planner,
            local_planner,
            recoveries,
        })
    }
}
