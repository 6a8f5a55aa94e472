//! The section `nodes`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_faults::read_section;
use periplus_params::ParamValues;
use periplus_yaml::{YamlNode, YamlValue};

use super::{check_pose, find_table};
use crate::tables::{
    NODES, ScenarioCostmapParams, ScenarioLocalizationParams, ScenarioNavigationParams,
    ScenarioSlamParams,
};

/// Nodes beside the robot.
#[derive(Clone, Debug, Default)]
pub struct ScenarioNodes {
    /// SLAM.
    pub slam: Option<ScenarioSlamParams>,
    /// Localization on a map.
    pub localization: Option<ScenarioLocalizationParams>,
    /// Costmaps.
    pub costmaps: Option<ScenarioCostmapParams>,
    /// Navigation.
    pub navigation: Option<ScenarioNavigationParams>,
}

impl ScenarioNodes {
    /// Reads a list of words, or a mapping of words and parameters.
    pub(super) fn read(node: &YamlNode, diagnostics: &mut Diagnostics) -> Self {
        let mut nodes = Self::default();
        let empty = YamlNode { value: YamlValue::Map(Vec::new()), ..node.clone() };
        match &node.value {
            YamlValue::List(items) => {
                for item in items {
                    nodes.add(item, &YamlNode { span: item.span, ..empty.clone() }, diagnostics);
                }
            }
            YamlValue::Map(entries) => {
                for (key, value) in entries {
                    match value.truth() {
                        Some(false) => {}
                        Some(true) => nodes.add(key, &empty, diagnostics),
                        None => nodes.add(key, value, diagnostics),
                    }
                }
            }
            YamlValue::Scalar { .. } => {
                let message = format!("`nodes` is {}; it must be a list or a mapping", node.kind());
                let help = "write `nodes: [slam, navigation]`";
                diagnostics.push(Diagnostic::error("bad-nodes", message).at(node.span).help(help));
            }
        }
        nodes
    }

    fn add(&mut self, key: &YamlNode, value: &YamlNode, diagnostics: &mut Diagnostics) {
        let word = key.text().unwrap_or_default();
        let Some(table) = find_table(&NODES, word, key.span, "node", diagnostics) else { return };
        let values: ParamValues = read_section(table, value, diagnostics);
        match table.name {
            "slam" => self.slam = Some(ScenarioSlamParams::from_values(&values)),
            "localization" => {
                let params = ScenarioLocalizationParams::from_values(&values);
                if !params.initial_pose.is_empty() {
                    let span = value.get("initial_pose").map_or(value.span, |it| it.span);
                    check_pose(&params.initial_pose, "initial_pose", span, diagnostics);
                }
                self.localization = Some(params);
            }
            "costmaps" => self.costmaps = Some(ScenarioCostmapParams::from_values(&values)),
            _ => self.navigation = Some(ScenarioNavigationParams::from_values(&values)),
        }
    }
}
