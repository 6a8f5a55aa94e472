//! Advice about parameters that bound each other.
//!
//! Source of the cases: issues of `ros-navigation/navigation2` (#4970, #5579, #6160).

use periplus_costmap::{CostmapView, Nav2Release};
use periplus_diagnostics::{Diagnostic, Diagnostics};

use super::config::MppiConfig;
use super::critics::CriticKind;
use super::limits::MppiModel;
use super::params::{
    CostParams, ObstaclesParams, PathAngleParams, PathFollowParams, ValidatorParams,
};

/// Spacing of path points that is assumed where the costmap is not known yet \[m\].
const USUAL_SPACING_M: f64 = 0.05;

/// Reports parameters that bound each other, at the start.
pub(crate) fn advise(config: &MppiConfig, group: &str, diagnostics: &mut Diagnostics) {
    let mut advice = Advisor { config, group, diagnostics };
    advice.signs();
    advice.step();
    advice.speed_range();
    advice.reachable_speed();
    advice.horizon();
    advice.steering();
    advice.direction();
    advice.lookahead();
}

/// Reports contradictions between the parameters of a controller and a costmap. Nav2 does not start with some
/// of them; this controller does.
pub fn check_costmap(
    config: &MppiConfig,
    group: &str,
    costmap: &CostmapView<'_>,
    diagnostics: &mut Diagnostics,
) {
    let mut advice = Advisor { config, group, diagnostics };
    advice.footprint(costmap);
    advice.costmap_size(costmap);
}

/// Advice about a configuration: parameters that bound each other, with the reason.
#[must_use]
pub fn advice(config: &MppiConfig, group: &str) -> Diagnostics {
    let mut diagnostics = Diagnostics::new();
    advise(config, group, &mut diagnostics);
    diagnostics
}

struct Advisor<'a, 'd> {
    config: &'a MppiConfig,
    group: &'a str,
    diagnostics: &'d mut Diagnostics,
}

impl Advisor<'_, '_> {
    fn push(&mut self, at: &str, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic.at(self.config.values.origin(at)));
    }

    fn has(&self, kind: CriticKind) -> bool {
        self.config.critics.contains(&kind)
    }

    fn signs(&mut self) {
        for name in ["ax_min", "ay_min"] {
            if self.config.values.number(name).is_some_and(|value| value > 0.0) {
                let group = self.group;
                let finding = Diagnostic::warning(
                    "positive-deceleration",
                    format!("`{group}.{name}` is positive"),
                )
                .note("a deceleration is negative; it is used with the other sign")
                .help(format!("write `{name}` with a minus sign"));
                self.push(name, finding);
            }
        }
    }

    fn step(&mut self) {
        let model_dt_s = self.config.params().model_dt_s;
        if self.config.shifts() {
            return;
        }
        let (group, period_s) = (self.group, self.config.period_s);
        let finding = Diagnostic::warning(
            "unequal-step",
            format!("`{group}.model_dt` is {model_dt_s} s, and the controller runs every {period_s} s"),
        )
        .note("the control sequence does not advance between cycles, so that each starts from an old one")
        .help(format!("set `{group}.model_dt` to {period_s}, or `controller_frequency` to {}", 1.0 / model_dt_s));
        self.push("model_dt", finding);
    }

    fn speed_range(&mut self) {
        let params = self.config.params();
        if params.vx_max_m_s <= params.vx_min_m_s || params.vx_max_m_s <= 0.0 {
            let finding = Diagnostic::error(
                "no-speeds",
                format!(
                    "`{}.vx_max` {} m/s leaves no velocities above `vx_min` {} m/s",
                    self.group, params.vx_max_m_s, params.vx_min_m_s
                ),
            )
            .help("set `vx_max` to the highest speed of the robot");
            self.push("vx_max", finding);
        }
    }

    /// The speed of the samples is bounded by the noise and by the aim of `PathFollowCritic`.
    fn reachable_speed(&mut self) {
        let params = self.config.params();
        if !self.has(CriticKind::PathFollow) {
            return;
        }
        let group = self.group;
        // A sample reaches about three standard deviations, averaged over a few independent steps; below a
        // quarter of the range the robot accelerates slowly.
        if params.vx_std_m_s < 0.2 * params.vx_max_m_s {
            let finding = Diagnostic::hint(
                "narrow-noise",
                format!(
                    "`{group}.vx_std` {} m/s is small for `vx_max` {} m/s",
                    params.vx_std_m_s, params.vx_max_m_s
                ),
            )
            .note(
                "samples reach only a little beyond the speed of the last cycle, so that the robot accelerates \
                 slowly or stays below `vx_max`",
            )
            .help(format!("try `vx_std: {:.2}`", 0.4 * params.vx_max_m_s));
            self.push("vx_std", finding);
        }
        let follow = PathFollowParams::from_values(&self.config.critic(CriticKind::PathFollow));
        let extra_m = follow.offset_points as f64 * USUAL_SPACING_M;
        let horizon_s = params.time_steps as f64 * params.model_dt_s;
        let driven_m = params.vx_max_m_s * horizon_s;
        if extra_m < 0.05 * driven_m {
            let points = libm::ceil(0.1 * driven_m / USUAL_SPACING_M);
            let finding = Diagnostic::hint(
                "near-aim",
                format!(
                    "`PathFollowCritic.offset_from_furthest` {} is {extra_m:.2} m of a path with points every {USUAL_SPACING_M} m, \
                     little beside the {driven_m:.2} m of `vx_max` in {horizon_s:.2} s",
                    follow.offset_points
                ),
            )
            .note("the critic pulls towards that point only, so the speed stays near the one that samples reach already")
            .help(format!("try `{group}.PathFollowCritic.offset_from_furthest: {points:.0}`"));
            self.push("PathFollowCritic.offset_from_furthest", finding);
        }
    }

    /// The samples must cover the time to stop.
    fn horizon(&mut self) {
        if self.config.release == Nav2Release::Humble {
            return;
        }
        let params = self.config.params();
        let horizon_s = params.time_steps as f64 * params.model_dt_s;
        let stop_s = params.vx_max_m_s / params.ax_min_m_s2.abs();
        if stop_s > horizon_s {
            let finding = Diagnostic::warning(
                "short-horizon",
                format!(
                    "stopping from {} m/s with {} m/s² takes {stop_s:.2} s, longer than the {horizon_s:.2} s of a sample",
                    params.vx_max_m_s, params.ax_min_m_s2
                ),
            )
            .note("obstacles and the goal come into view too late to stop")
            .help(format!("raise `{}.time_steps` to {:.0}", self.group, libm::ceil(1.2 * stop_s / params.model_dt_s)));
            self.push("time_steps", finding);
        }
    }

    /// Curves that steered wheels can drive, and turn rates.
    fn steering(&mut self) {
        let MppiModel::Ackermann { min_turning_radius_m, .. } = self.config.model else { return };
        let params = self.config.params();
        let needed_rad_s = params.vx_max_m_s / f64::from(min_turning_radius_m);
        if params.wz_max_rad_s < 0.5 * needed_rad_s {
            let finding = Diagnostic::hint(
                "slow-turns",
                format!(
                    "`{}.wz_max` {} rad/s is below the {needed_rad_s:.2} rad/s of the narrowest curve at `vx_max`",
                    self.group, params.wz_max_rad_s
                ),
            )
            .note("curves are wider than the robot can drive, unless it slows down");
            self.push("wz_max", finding);
        }
    }

    fn direction(&mut self) {
        let params = self.config.params();
        if !self.has(CriticKind::PathAngle) || params.vx_min_m_s < 0.0 {
            return;
        }
        let angle = PathAngleParams::from_values(&self.config.critic(CriticKind::PathAngle));
        if angle.mode == 1 {
            let finding = Diagnostic::warning(
                "no-reversing",
                format!(
                    "`PathAngleCritic.mode` is 1, and `{}.vx_min` forbids reversing",
                    self.group
                ),
            )
            .note("mode 0 is used");
            self.push("PathAngleCritic.mode", finding);
        }
    }

    fn lookahead(&mut self) {
        let Some(values) = self.config.values.group("TrajectoryValidator") else { return };
        let validator = ValidatorParams::from_values(values);
        let params = self.config.params();
        let horizon_s = params.time_steps as f64 * params.model_dt_s;
        if validator.collision_lookahead_s > horizon_s + 1e-9 {
            let finding = Diagnostic::hint(
                "long-lookahead",
                format!(
                    "`TrajectoryValidator.collision_lookahead_time` {} s is longer than the {horizon_s:.2} s of a trajectory",
                    validator.collision_lookahead_s
                ),
            );
            self.push("TrajectoryValidator.collision_lookahead_time", finding);
        }
    }

    /// A test of the outline needs an outline and an inflation beyond it.
    fn footprint(&mut self, costmap: &CostmapView<'_>) {
        let cost = CostParams::from_values(&self.config.critic(CriticKind::Cost));
        let obstacles = ObstaclesParams::from_values(&self.config.critic(CriticKind::Obstacles));
        let group = self.group;
        for (kind, considers) in [
            (CriticKind::Cost, cost.considers_footprint),
            (CriticKind::Obstacles, obstacles.considers_footprint),
        ] {
            if !self.has(kind) {
                continue;
            }
            let name = format!("{}.consider_footprint", kind.name());
            if considers && costmap.is_circular {
                let finding = Diagnostic::warning(
                    "no-footprint",
                    format!("`{group}.{name}` is true, and the local costmap has a `robot_radius`"),
                )
                .note("Nav2 does not start with this; here a polygon with 16 corners is tested")
                .help("set it to false, which gives the same result faster, or set `footprint`");
                self.push(&name, finding);
            } else if !considers && !costmap.is_circular {
                let finding = Diagnostic::hint(
                    "ignored-footprint",
                    format!("`{group}.{name}` is false, and the local costmap has a `footprint`"),
                )
                .note("only the inscribed circle is kept free of obstacles; corners of the robot may touch them")
                .help("set it to true for a robot that is not round");
                self.push(&name, finding);
            }
            let circumscribed_m = costmap.footprint.circumscribed_radius_m;
            let is_covered = costmap.inflation.is_some_and(|law| law.radius_m >= circumscribed_m);
            if considers && !costmap.is_circular && !is_covered {
                let finding = Diagnostic::warning(
                    "small-inflation",
                    format!(
                        "the inflation radius {} is below the {circumscribed_m:.2} m from the robot's centre to its corners",
                        costmap.inflation.map_or("(no inflation layer)".to_owned(), |law| format!("{} m", law.radius_m))
                    ),
                )
                .note("the outline is tested at every point that is not free, which is slow, and obstacles beside the robot cost nothing")
                .help(format!("set `inflation_radius` of the local costmap to at least {circumscribed_m:.2}"));
                self.push(&name, finding);
            }
        }
    }

    /// Samples must stay within the costmap.
    fn costmap_size(&mut self, costmap: &CostmapView<'_>) {
        let params = self.config.params();
        let driven_m = params.vx_max_m_s * params.time_steps as f64 * params.model_dt_s;
        let (width_m, height_m) = costmap.costs.info().size_m();
        let half_m = width_m.min(height_m) / 2.0;
        if driven_m > half_m && half_m > 0.0 {
            let finding = Diagnostic::warning(
                "small-costmap",
                format!(
                    "samples drive {driven_m:.2} m, and the local costmap ends {half_m:.2} m from the robot"
                ),
            )
            .note("beyond it samples count as collisions or cost as much as an obstacle, which bounds the speed")
            .help(format!(
                "set `width` and `height` of the local costmap to {:.0}, or lower `{}.time_steps`",
                libm::ceil(2.0 * driven_m + 0.5),
                self.group
            ));
            self.push("time_steps", finding);
        }
    }
}
