//! MPPI as a plugin of a controller server.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_params::Given;

use super::config::MppiSetup;
use super::controller::{Mppi, create};
use crate::{Controller, FeasiblePathParams, ParameterGroup, PathRules, PluginSetup};

/// Seed of the noise of a controller.
const NOISE_SEED: u64 = 0;

/// Groups of parameters that are not those of a critic.
const FURTHER_GROUPS: [&str; 2] = ["TrajectoryVisualizer", "TrajectoryValidator"];

/// Creates the controller from the parameters of its group.
pub(crate) fn create_plugin(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let entries = setup.given.entries();
    let names: Vec<String> =
        entries.iter().map(|entry| format!("{}.{}", setup.name, entry.name)).collect();
    let given = entries.iter().zip(&names).map(|(entry, name)| Given { name, ..entry.clone() });
    let mppi = MppiSetup {
        group: setup.name,
        release: setup.release,
        controller_frequency_hz: 1.0 / setup.control_period_s,
        seed: NOISE_SEED,
        others: &setup.neighbours,
    };
    create(&mppi, given, diagnostics).map(|controller| Box::new(controller) as Box<dyn Controller>)
}

impl Mppi {
    /// Parameters with those of the critics, the motion model and the tools.
    pub(super) fn groups(&self) -> Vec<ParameterGroup<'_>> {
        let config = self.config();
        let mut groups = vec![ParameterGroup::own(&config.values)];
        let critics = config.critics.iter().map(|kind| kind.name());
        let inner = critics.chain(FURTHER_GROUPS).chain([config.model_group.as_str()]);
        groups.extend(inner.filter_map(|name| {
            let values = config.values.group(name).filter(|_| !name.is_empty())?;
            Some(ParameterGroup::own(values).within(name))
        }));
        groups
    }

    /// Rules of the path handler that MPPI had before main.
    pub(super) fn own_path_rules(&self) -> Option<PathRules> {
        let config = self.config();
        if config.release == Nav2Release::Main {
            return None;
        }
        let number = |name| config.values.number(name);
        let usual = FeasiblePathParams::default();
        let params = FeasiblePathParams {
            prune_distance_m: number("prune_distance").unwrap_or(usual.prune_distance_m),
            // By default half of the longer side of the costmap.
            max_robot_pose_search_dist_m: number("max_robot_pose_search_dist")
                .filter(|_| config.values.is_given("max_robot_pose_search_dist")),
            enforce_path_inversion: config.values.flag("enforce_path_inversion") == Some(true),
            inversion_xy_tolerance_m: number("inversion_xy_tolerance")
                .unwrap_or(usual.inversion_xy_tolerance_m),
            inversion_yaw_tolerance_rad: number("inversion_yaw_tolerance")
                .unwrap_or(usual.inversion_yaw_tolerance_rad),
            ..usual
        };
        Some(PathRules::Feasible { params, keeps_two_poses: false })
    }
}
