//! Behaviors and their parameters.

use periplus_controllers::{GivenParameters, PluginSetup};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_motion::behaviors::DriveLimits;
use periplus_motion::tables::{BEHAVIOR, BEHAVIOR_SERVER, BehaviorParams, BehaviorServerParams};
use periplus_params::{Given, ParamChoice, ParamValue, ParamValues};

use super::plugin::RegisteredBehavior;
use crate::costmap_2d::split;
use crate::navigation_plugins::{NavigationPlugins, not_created};
use crate::parameter_groups::ParameterGroups;

/// Motion of a behavior.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BehaviorKind {
    /// Rotation in place.
    Spin,
    /// Straight drive backward.
    BackUp,
    /// Straight drive forward or backward.
    DriveOnHeading,
    /// Teleoperation that avoids collisions.
    AssistedTeleop,
    /// None, for a time.
    Wait,
}

/// Class name in Nav2, name in the default list, kind.
const KINDS: [(&str, &str, BehaviorKind); 5] = [
    ("Spin", "spin", BehaviorKind::Spin),
    ("BackUp", "backup", BehaviorKind::BackUp),
    ("DriveOnHeading", "drive_on_heading", BehaviorKind::DriveOnHeading),
    ("AssistedTeleop", "assisted_teleop", BehaviorKind::AssistedTeleop),
    ("Wait", "wait", BehaviorKind::Wait),
];

impl BehaviorKind {
    /// Kind of a class, such as `nav2_behaviors::Spin`, or `nav2_behaviors/Spin` in Humble.
    #[must_use]
    pub fn of_plugin(plugin: &str) -> Option<Self> {
        let plugin = plugin.trim();
        let class = plugin
            .strip_prefix("nav2_behaviors::")
            .or_else(|| plugin.strip_prefix("nav2_behaviors/"))?;
        KINDS.iter().find(|(known, ..)| *known == class).map(|(.., kind)| *kind)
    }

    /// Kind of a name in the default list of behaviors.
    fn of_default_name(name: &str) -> Option<Self> {
        KINDS.iter().find(|(_, known, _)| *known == name).map(|(.., kind)| *kind)
    }
}

/// Configuration of one behavior.
#[derive(Clone, Debug, PartialEq)]
pub struct BehaviorConfig {
    /// Name, which is that of its action.
    pub name: String,
    /// Motion.
    pub kind: BehaviorKind,
    /// Parameters, from [`BEHAVIOR`].
    pub values: ParamValues,
}

impl BehaviorConfig {
    /// Limits of a straight drive, with the defaults of a release.
    #[must_use]
    pub fn drive_limits(&self, release: Nav2Release) -> DriveLimits {
        let params = BehaviorParams::from_values(&self.values);
        let usual = match release {
            Nav2Release::Humble => [0.0, 0.0, 0.0],
            _ => [2.5, -2.5, 0.1],
        };
        DriveLimits::new(
            release,
            params.acceleration_limit_m_s2.unwrap_or(usual[0]),
            params.deceleration_limit_m_s2.unwrap_or(usual[1]),
            params.minimum_speed_m_s.unwrap_or(usual[2]),
        )
    }
}

/// Configuration of a behavior server.
#[derive(Clone, Debug, PartialEq)]
pub struct BehaviorServerConfig {
    /// Parameters of the node, from [`BEHAVIOR_SERVER`].
    pub node: ParamValues,
    /// Behaviors, in the order of their list.
    pub behaviors: Vec<BehaviorConfig>,
}

/// Release whose behaviour is used.
fn node_release(node: &ParamValues) -> Nav2Release {
    BehaviorServerParams::from_values(node).node.compat
}

impl BehaviorServerConfig {
    /// Reads parameters given as names with dots, such as `spin.plugin`, and texts. Errors are reported
    /// with their positions, and the rest is built; `compat` overrides the parameter of that name.
    pub fn read<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        compat: Option<Nav2Release>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        Self::read_with(given, compat, &NavigationPlugins::new(), diagnostics).0
    }

    /// Reads parameters as [`Self::read`] does, and creates the behaviors of registered classes.
    pub fn read_with<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        compat: Option<Nav2Release>,
        plugins: &NavigationPlugins,
        diagnostics: &mut Diagnostics,
    ) -> (Self, Vec<RegisteredBehavior>) {
        let given: Vec<Given<'a>> = given.into_iter().collect();
        let mut registered = Vec::new();
        let mut groups = ParameterGroups::new(given.iter().cloned(), diagnostics);
        let mut node = groups.node_values(&BEHAVIOR_SERVER);
        if let Some(compat) = compat {
            node.set("compat", ParamValue::Text(compat.word().to_owned()));
        }
        let origin = node.origin("behavior_plugins");
        let mut behaviors: Vec<BehaviorConfig> = Vec::new();
        for name in node.texts("behavior_plugins") {
            if behaviors.iter().any(|known| known.name == name) {
                continue;
            }
            let own = GivenParameters::of_group(&given, &name);
            if let Some((class, (action, create))) =
                own.text("plugin").and_then(|class| Some((class, plugins.behaviors.find(class)?)))
            {
                let release = node_release(&node);
                let setup = PluginSetup { release, given: own.clone(), ..PluginSetup::new(&name) };
                let setup = setup.at(origin);
                groups.discard(&name);
                let created = create(&setup, groups.diagnostics);
                if created.is_none() {
                    groups.diagnostics.push(not_created(&setup, class));
                }
                let action = *action;
                registered.extend(created.map(|plugin| RegisteredBehavior {
                    name,
                    action,
                    plugin,
                }));
                continue;
            }
            let values = groups.group_values(&BEHAVIOR, &name, origin);
            let plugin = BehaviorParams::from_values(&values).plugin;
            let kind = if plugin.is_empty() {
                BehaviorKind::of_default_name(&name)
            } else {
                BehaviorKind::of_plugin(&plugin)
            };
            match kind {
                Some(kind) => behaviors.push(BehaviorConfig { name, kind, values }),
                None => {
                    let known = KINDS.map(|(class, ..)| format!("nav2_behaviors::{class}"));
                    let finding = if plugin.is_empty() {
                        Diagnostic::error("no-plugin", format!("`{name}.plugin` is not set"))
                            .at(origin)
                    } else {
                        let text = format!("`{name}.plugin`: there is no behavior `{plugin}`");
                        let at = values.origin("plugin");
                        Diagnostic::error("unknown-plugin", text).at(at).did_you_mean(
                            at,
                            &plugin,
                            known.iter().map(String::as_str),
                        )
                    };
                    let finding = plugins.behaviors.advise(&plugin, finding);
                    let note = "the behavior is left out, the others are served";
                    groups.diagnostics.push(finding.note(note));
                }
            }
        }
        groups.finish();
        (Self { node, behaviors }, registered)
    }

    /// Parameters of the node.
    #[must_use]
    pub fn params(&self) -> BehaviorServerParams {
        BehaviorServerParams::from_values(&self.node)
    }

    /// All parameters, with names such as `spin.plugin`.
    #[must_use]
    pub fn values(&self) -> ParamValues {
        let mut values = self.node.clone();
        for behavior in &self.behaviors {
            values.add_group(&behavior.name, behavior.values.clone());
        }
        values
    }

    /// Copies values of [`Self::values`] that were changed.
    pub(super) fn adopt(&mut self, all: &ParamValues) {
        self.node = split(all, "", &self.node);
        for behavior in &mut self.behaviors {
            behavior.values = split(all, &behavior.name, &behavior.values);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaviors_are_read_with_their_plugins() {
        let check = |given: &[(&str, &str)], expected: &[(&str, BehaviorKind)], found: &[&str]| {
            let mut diagnostics = Diagnostics::new();
            let given = given.iter().map(|(name, text)| Given::new(name, *text));
            let config = BehaviorServerConfig::read(given, None, &mut diagnostics);
            let read: Vec<_> =
                config.behaviors.iter().map(|it| (it.name.as_str(), it.kind)).collect();
            assert_eq!(read, expected);
            let codes: Vec<&str> = diagnostics.iter().map(|finding| finding.code).collect();
            assert_eq!(codes, found);
        };
        use BehaviorKind::{AssistedTeleop, BackUp, DriveOnHeading, Spin, Wait};
        let usual = [
            ("spin", Spin),
            ("backup", BackUp),
            ("drive_on_heading", DriveOnHeading),
            ("wait", Wait),
        ];
        check(&[], &usual, &[]);
        let named = [
            ("behavior_plugins", "[turn, teleop]"),
            ("turn.plugin", "nav2_behaviors/Spin"),
            ("teleop.plugin", "nav2_behaviors::AssistedTeleop"),
        ];
        check(&named, &[("turn", Spin), ("teleop", AssistedTeleop)], &[]);
        let wrong = [
            ("behavior_plugins", "[a, b, wait]"),
            ("a.plugin", "nav2_behaviors::Spinn"),
            ("c.plugin", "nav2_behaviors::Wait"),
        ];
        let codes = ["unknown-plugin", "no-plugin", "unused-group"];
        check(&wrong, &[("wait", Wait)], &codes);
    }

    #[test]
    fn limits_of_drives_differ_by_release() {
        let config = BehaviorServerConfig::read([], None, &mut Diagnostics::new());
        let speed = |release| {
            let drive = periplus_motion::behaviors::StraightDrive::backward([1.0, 0.0, 0.0], 1.0);
            let limits = config.behaviors[1].drive_limits(release);
            drive.unwrap().velocity_m_s(0.0, 0.0, 10.0, &limits)
        };
        assert_eq!(speed(Nav2Release::Humble), Some(-1.0));
        assert_eq!(speed(Nav2Release::Jazzy), Some(-1.0));
        assert_eq!(speed(Nav2Release::Main), Some(-0.25));
    }
}
