//! Checks for settings without effect and for contradictions.
//!
//! No finding stops the loading. Settings that Gazebo would ignore silently are warnings, impossible names
//! and values are errors, and working but notable settings are hints.

mod geometry;
mod parameters;
mod references;
mod ros;
mod ros_version;
mod systems;
mod topics;
mod unknown;

use periplus_diagnostics::Diagnostics;
use periplus_scene::Scene;

use crate::{InterpretedPlugin, PluginSite, Role, interpret, sites};

/// Maximum number of drives whose wheels are checked; each searches its joints and links by name.
const MAX_DRIVES: usize = 1_000;

/// Reports findings about the plugins of a scene, and about sensors that need a plugin.
pub fn lint(scene: &Scene, diagnostics: &mut Diagnostics) {
    let sites = sites(scene);
    unknown::check(&sites, diagnostics);
    let mut understood: Vec<(PluginSite<'_>, InterpretedPlugin)> = Vec::new();
    let mut names = references::Cache::default();
    let mut drives = 0;
    for site in sites {
        if let Some(plugin) = interpret(site.plugin, &site.context, diagnostics) {
            parameters::check(&site, plugin.known, diagnostics);
            ros::check(&site, &plugin, diagnostics);
            references::check(&site, &plugin, &mut names, diagnostics);
            if plugin.known.role == Role::Drive && drives < MAX_DRIVES {
                drives += 1;
                geometry::check(&site, &plugin, diagnostics);
            }
            understood.push((site, plugin));
        }
    }
    topics::check(&understood, diagnostics);
    ros_version::check(&understood, diagnostics);
    for world in &scene.worlds {
        systems::check(world, &understood, diagnostics);
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use periplus_diagnostics::Diagnostics;
    use periplus_params::Default;
    use proptest::prelude::*;

    use super::lint;
    use crate::fixture::scene;
    use crate::{PluginContext, interpret, known, topics};

    /// All parameters of a plugin, each with the text returned by `value`.
    fn written(
        known: &crate::PluginSpec,
        value: impl Fn(&periplus_params::Parameter) -> String,
    ) -> String {
        let mut text = format!("<plugin name='p' filename='{}'>", known.filename());
        for parameter in known.table.parameters {
            let name = parameter.name;
            let _ = write!(text, "<{name}>{}</{name}>", value(parameter));
        }
        text + "</plugin>"
    }

    #[test]
    fn every_plugin_reads_its_own_defaults() {
        for known in known() {
            let text = written(known, |parameter| match parameter.default {
                Default::Value(default) => default.to_owned(),
                Default::Required | Default::None => match parameter.kind {
                    periplus_params::ParamType::Bool => "true".into(),
                    periplus_params::ParamType::Choice(words) => words[0].into(),
                    _ => "1".into(),
                },
            });
            let plugin = crate::fixture::plugin(&text);
            let mut diagnostics = Diagnostics::new();
            let context = PluginContext { ros: Some(known.family), ..PluginContext::NOWHERE };
            let Some(read) = interpret(&plugin, &context, &mut diagnostics) else {
                panic!("{} is not recognised", known.id);
            };
            assert_eq!((read.known.id, read.known.family), (known.id, known.family));
            assert!(diagnostics.is_empty(), "{}: {diagnostics:?}", known.id);
            for topic in topics(&read, &context) {
                assert!(topic.name.starts_with('/') && !topic.name.contains('{'), "{topic:?}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]
        #[test]
        fn no_value_makes_a_lint_panic(value in "[^<>&]{0,12}", which in 0..1_000_usize) {
            let known: Vec<_> = known().collect();
            let plugin = written(known[which % known.len()], |_| value.clone());
            let text = format!("<world name='w'><model name='m'><link name='l'/>{plugin}</model></world>");
            lint(&scene(&text), &mut Diagnostics::new());
        }
    }

    /// With quadratic searches this takes minutes.
    #[test]
    fn a_slip_in_every_line_costs_little() {
        let mut text = String::from("<model name='m'>");
        for index in 0..5_000 {
            let _ = write!(
                text,
                "<link name='l{index}'/><joint name='j{index}'><child>l{index}</child></joint>
                 <plugin name='p{index}' filename='libgazebo_ros_diff_drive.so'>
                   <ros/><left_joint>j{index}x</left_joint><right_joint>j{index}</right_joint>
                 </plugin><plugin name='u{index}' filename='libunknown{index}.so'/>"
            );
        }
        text.push_str("</model>");
        let mut diagnostics = Diagnostics::new();
        lint(&scene(&text), &mut diagnostics);
        assert_eq!(diagnostics.errors(), 5_000);
    }
}
