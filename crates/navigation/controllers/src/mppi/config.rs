//! Configuration from parameters.

use std::collections::BTreeMap;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_params::{Given, ParamType, ParamValue, ParamValues, Table};

use super::critics::CriticKind;
use super::limits::MppiModel;
use super::params::{self, AckermannParams, MppiParams};

/// Tolerance of the comparison of the controller's period with `model_dt` \[s\].
const PERIOD_TOLERANCE_S: f64 = 1e-6;

/// Group of the motion model before main.
const ACKERMANN_GROUP: &str = "AckermannConstraints";

/// Words and classes of the motion models: before main, and on main.
const MODELS: [(&str, &str, &str); 3] = [
    ("DiffDrive", "mppi::DiffDriveMotionModel", "diff_drive"),
    ("Omni", "mppi::OmniMotionModel", "omni"),
    ("Ackermann", "mppi::AckermannMotionModel", "ackermann"),
];

/// Surroundings of a controller that are not among its parameters.
#[derive(Clone, Copy, Debug)]
pub struct MppiSetup<'a> {
    /// Name of the controller, which is the group of its parameters, such as `FollowPath`.
    pub group: &'a str,
    /// Release of Nav2 whose behaviour is used.
    pub release: Nav2Release,
    /// Parameter `controller_frequency` of the server \[Hz\].
    pub controller_frequency_hz: f64,
    /// Seed of the noise.
    pub seed: u64,
    /// Tables of other components with parameters in the same group, such as a rotation shim.
    pub others: &'a [&'static Table],
}

/// Configuration of a controller.
#[derive(Clone, Debug, PartialEq)]
pub struct MppiConfig {
    /// Release of Nav2 whose behaviour is used.
    pub release: Nav2Release,
    /// Period of the controller server \[s\].
    pub period_s: f64,
    /// Seed of the noise.
    pub seed: u64,
    /// Parameters of [`params::MPPI`], with a group for each critic, `TrajectoryVisualizer`,
    /// `TrajectoryValidator` (main) and the motion model.
    pub values: ParamValues,
    /// Critics in the order of their evaluation.
    pub critics: Vec<CriticKind>,
    /// Motion model.
    pub model: MppiModel,
    /// Group of the motion model's parameters.
    pub model_group: String,
}

impl MppiConfig {
    /// Reads parameters of the controller server, whose names begin with the group of the controller, such as
    /// `FollowPath.vx_max`; others are ignored. Mistakes are reported with their positions. Returns none if
    /// Nav2 would not start with these parameters.
    pub fn read<'a>(
        setup: &MppiSetup<'_>,
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let mut reading = Reading { groups: BTreeMap::new(), setup: *setup, diagnostics };
        for one in given {
            reading.add(one);
        }
        reading.finish()
    }

    /// Converts the parameters of the controller.
    #[must_use]
    pub fn params(&self) -> MppiParams {
        MppiParams::from_values(&self.values)
    }

    /// Returns true if the sequence advances by a step in each cycle: the period equals `model_dt`.
    #[must_use]
    pub fn shifts(&self) -> bool {
        (self.period_s - self.params().model_dt_s).abs() < PERIOD_TOLERANCE_S
    }

    /// Returns the values of a critic.
    #[must_use]
    pub fn critic(&self, kind: CriticKind) -> ParamValues {
        let group = self.values.group(kind.name());
        group.cloned().unwrap_or_else(|| ParamValues::defaults(kind.table()))
    }
}

struct Reading<'a, 's, 'd> {
    /// By group within the controller; empty for its own parameters.
    groups: BTreeMap<&'a str, Vec<Given<'a>>>,
    setup: MppiSetup<'s>,
    diagnostics: &'d mut Diagnostics,
}

impl<'a> Reading<'a, '_, '_> {
    fn add(&mut self, given: Given<'a>) {
        let rest = given.name.strip_prefix(self.setup.group).and_then(|it| it.strip_prefix('.'));
        let Some(rest) = rest else { return };
        let (group, name) = rest.rsplit_once('.').unwrap_or(("", rest));
        let others = self.setup.others;
        let is_of_other = |name: &str| others.iter().any(|table| table.find(name).is_some());
        if params::MPPI.find(rest).is_none() && is_of_other(rest) {
            return;
        }
        let entries = self.groups.entry(group).or_default();
        // The last of several values applies, as in ROS 2.
        entries.retain(|earlier| earlier.name != name);
        entries.push(Given { name, ..given });
    }

    fn finish(mut self) -> Option<MppiConfig> {
        let release = self.setup.release;
        let mut values = self.values(&params::MPPI, "");
        let errors = self.diagnostics.errors();
        let critics = self.critics(&values);
        for kind in &critics {
            let mut group = self.values(kind.table(), kind.name());
            set_release_defaults(*kind, release, &mut group);
            values.add_group(kind.name(), group);
        }
        values.add_group(
            "TrajectoryVisualizer",
            self.values(&params::VISUALIZER, "TrajectoryVisualizer"),
        );
        let validator = self.values(&params::VALIDATOR, "TrajectoryValidator");
        if release == Nav2Release::Main {
            values.add_group("TrajectoryValidator", validator);
        }
        let (model, model_group) = self.model(&mut values)?;
        self.check_period(&values)?;
        self.report_rest(&critics);
        let config = MppiConfig {
            release,
            period_s: 1.0 / self.setup.controller_frequency_hz,
            seed: self.setup.seed,
            values,
            critics,
            model,
            model_group,
        };
        // An unknown critic ends the configuration of Nav2.
        (self.diagnostics.errors() == errors).then_some(config)
    }

    /// Reads a group by a table.
    fn values(&mut self, table: &'static Table, group: &str) -> ParamValues {
        let mut entries = self.groups.remove(group).unwrap_or_default();
        for entry in &mut entries {
            self.round_integer(table, entry);
        }
        table.check_given(entries, self.diagnostics)
    }

    /// Accepts an integer that is written with a fraction, with a warning.
    fn round_integer(&mut self, table: &'static Table, entry: &mut Given<'_>) {
        let Some(parameter) = table.find(entry.name) else { return };
        let text = entry.text.trim();
        if parameter.kind != ParamType::Integer || !text.contains(['.', 'e', 'E']) {
            return;
        }
        let Ok(number) = text.parse::<f64>() else { return };
        let whole = libm::round(number);
        self.diagnostics.push(
            Diagnostic::warning(
                "not-whole",
                format!("`{}` is written as {text}, and must be a whole number", entry.name),
            )
            .at(entry.origin)
            .note("Nav2 refuses to start with `parameter has invalid type`")
            .replace(entry.origin, format!("{whole}"), format!("write `{whole}`")),
        );
        entry.text = format!("{whole}").into();
    }

    fn critics(&mut self, values: &ParamValues) -> Vec<CriticKind> {
        let at = values.origin("critics");
        let mut critics = Vec::new();
        for name in values.texts("critics") {
            match CriticKind::of_name(&name) {
                Some(CriticKind::PathAlignLegacy) if self.setup.release != Nav2Release::Humble => {
                    self.diagnostics.push(
                        Diagnostic::error(
                            "unknown-critic",
                            "`PathAlignLegacyCritic` exists in Humble only",
                        )
                        .at(at)
                        .help("use `PathAlignCritic`"),
                    );
                }
                Some(kind) => critics.push(kind),
                None => self.diagnostics.push(
                    Diagnostic::error("unknown-critic", format!("MPPI has no critic `{name}`"))
                        .at(at)
                        .did_you_mean(at, &name, CriticKind::ALL.map(|(name, _)| name)),
                ),
            }
        }
        if critics.is_empty() {
            self.diagnostics.push(
                Diagnostic::warning(
                    "no-critics",
                    format!("`{}.critics` is empty", self.setup.group),
                )
                .at(at)
                .note("without critics all samples are equal, and the robot moves at random")
                .help(
                    "list the critics of the stock file: ConstraintCritic, CostCritic, GoalCritic, \
                         GoalAngleCritic, PathAlignCritic, PathFollowCritic, PathAngleCritic, \
                         PreferForwardCritic",
                ),
            );
        }
        critics
    }

    /// Reads the motion model: a word before main, the name of a group with a `plugin` on main. Both are
    /// accepted everywhere.
    fn model(&mut self, values: &mut ParamValues) -> Option<(MppiModel, String)> {
        let is_main = self.setup.release == Nav2Release::Main;
        let default = if is_main { "diff_drive" } else { "DiffDrive" };
        let written = values.text("motion_model").unwrap_or_else(|| default.to_owned());
        let at = values.origin("motion_model");
        let plugin = self.plugin_of(&written);
        let group = if plugin.is_none() && MODELS.iter().any(|(word, ..)| *word == written) {
            ACKERMANN_GROUP.to_owned()
        } else {
            written.clone()
        };
        let found = match &plugin {
            Some((class, _)) => MODELS.iter().find(|(_, known, _)| known == class),
            None => MODELS.iter().find(|(word, _, name)| *word == written || *name == written),
        };
        let Some((word, ..)) = found else {
            let known = MODELS.map(|(word, class, _)| if is_main { class } else { word });
            let (name, at) = plugin.unwrap_or((written, at));
            self.diagnostics.push(
                Diagnostic::error("unknown-model", format!("MPPI has no motion model `{name}`"))
                    .at(at)
                    .did_you_mean(at, &name, known)
                    .help(format!("use one of `{}`", known.join("`, `"))),
            );
            return None;
        };
        let group_values = self.values(&params::ACKERMANN, &group);
        let steering = AckermannParams::from_values(&group_values);
        let model = match *word {
            "Omni" => MppiModel::Omni,
            "Ackermann" => MppiModel::Ackermann {
                min_turning_radius_m: steering.min_turning_radius_m as f32,
                samples_curvatures: steering.samples_curvatures,
            },
            _ => MppiModel::DiffDrive,
        };
        if model != MppiModel::DiffDrive && model != MppiModel::Omni {
            values.add_group(group.clone(), group_values);
        }
        Some((model, group))
    }

    /// Class of a motion model in its group.
    fn plugin_of(&self, group: &str) -> Option<(String, Origin)> {
        let entries = self.groups.get(group)?;
        let plugin = entries.iter().find(|entry| entry.name == "plugin")?;
        Some((plugin.text.trim().to_owned(), plugin.origin))
    }

    /// Nav2 does not start if the controller runs slower than its model.
    fn check_period(&mut self, values: &ParamValues) -> Option<()> {
        let MppiSetup { controller_frequency_hz, group, .. } = self.setup;
        let period_s = 1.0 / controller_frequency_hz;
        let model_dt_s = MppiParams::from_values(values).model_dt_s;
        if period_s <= model_dt_s + PERIOD_TOLERANCE_S {
            return Some(());
        }
        self.diagnostics.push(
            Diagnostic::error(
                "slow-controller",
                format!(
                    "`controller_frequency` {controller_frequency_hz} Hz is a period of {period_s} s, \
                     longer than `{group}.model_dt` {model_dt_s} s"
                ),
            )
            .at(values.origin("model_dt"))
            .note("Nav2 does not start: \"Controller period more then model dt, set it equal to model dt\"")
            .help(format!("set `{group}.model_dt` to {period_s}")),
        );
        None
    }

    /// Reports groups that no component reads.
    fn report_rest(&mut self, critics: &[CriticKind]) {
        for (name, entries) in std::mem::take(&mut self.groups) {
            let is_model = name == ACKERMANN_GROUP || entries.iter().any(|it| it.name == "plugin");
            let (Some(entry), false) = (entries.first(), is_model) else { continue };
            let group = self.setup.group;
            let finding = if CriticKind::of_name(name).is_some_and(|kind| !critics.contains(&kind))
            {
                Diagnostic::hint(
                    "unused-group",
                    format!("`{name}` is not in `{group}.critics`; its parameters are unused"),
                )
                .help(format!("add `{name}` to `critics`, or remove its parameters"))
            } else {
                let known = CriticKind::ALL.map(|(name, _)| name).into_iter();
                Diagnostic::warning(
                    "unused-group",
                    format!("MPPI has no critic or component `{name}`; its parameters are unused"),
                )
                .did_you_mean(
                    entry.name_origin,
                    name,
                    known.chain(["TrajectoryVisualizer"]),
                )
            };
            self.diagnostics.push(finding.at(entry.name_origin));
        }
    }
}

/// Sets the defaults of Humble that differ.
fn set_release_defaults(kind: CriticKind, release: Nav2Release, values: &mut ParamValues) {
    let differing: &[(&str, f64)] = match (kind, release) {
        (CriticKind::Obstacles, Nav2Release::Humble) => &[("collision_cost", 10_000.0)],
        (CriticKind::PathAngle, Nav2Release::Humble) => {
            &[("cost_weight", 2.0), ("max_angle_to_furthest", 1.2)]
        }
        _ => &[],
    };
    for (name, default) in differing {
        if !values.is_given(name) {
            values.set(name, ParamValue::Number(*default));
        }
    }
}
