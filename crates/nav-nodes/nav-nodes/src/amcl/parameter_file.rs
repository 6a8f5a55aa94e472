//! Parameters from YAML files of ROS 2 (`amcl: ros__parameters:`) and ROS 1.

use periplus_diagnostics::{Diagnostics, Origin};
use periplus_localization::{AMCL, Settings};
use periplus_params::{Given, ParamValues};
use periplus_yaml::{YamlNode, YamlValue};

/// Maximum depth of nested namespaces.
const MAX_NAMESPACE_DEPTH: usize = 4;

/// Reads the parameters of a node from a file and from overrides `(name, value)`. For `amcl`, the
/// sections `amcl: ros__parameters:` and `/**:` apply; in files of ROS 1, `amcl:`, or the whole
/// file without such a section. Invalid values are reported and replaced by defaults.
#[must_use]
pub fn read_parameters(
    file: Option<&YamlNode>,
    node: &str,
    overrides: &[(String, String)],
    diagnostics: &mut Diagnostics,
) -> ParamValues {
    let mut sections = Vec::new();
    if let Some(file) = file {
        collect(file, node, 0, &mut sections);
    }
    if let Some(file) = file
        && sections.is_empty()
    {
        let is_of_others = |(_, value): &(YamlNode, YamlNode)| value.entries().is_some();
        let is_plain = !file.entries().unwrap_or_default().iter().all(is_of_others);
        sections.extend(file.get(node).or(is_plain.then_some(file)));
    }
    let mut flat = Vec::new();
    for section in sections {
        flatten(section, "", &mut flat);
    }
    flat.extend(overrides.iter().map(|(name, text)| FlatParameter {
        name: name.clone(),
        text: text.clone(),
        name_origin: Origin::default(),
        origin: Origin::default(),
    }));
    // The last value of a parameter applies; earlier ones are not reported.
    let parameter = |one: &FlatParameter| AMCL.find(&one.name).map(|it| it.name);
    let flat: Vec<&FlatParameter> = flat
        .iter()
        .enumerate()
        .filter(|(index, one)| {
            flat[index + 1..]
                .iter()
                .all(|later| parameter(later).is_none_or(|name| parameter(one) != Some(name)))
        })
        .map(|(_, one)| one)
        .collect();
    let given = flat.iter().map(|one| Given {
        name: &one.name,
        text: one.text.as_str().into(),
        name_origin: one.name_origin,
        origin: one.origin,
    });
    Settings::read(given, diagnostics).0
}

fn collect<'a>(at: &'a YamlNode, node: &str, depth: usize, found: &mut Vec<&'a YamlNode>) {
    for (key, value) in at.entries().filter(|_| depth < MAX_NAMESPACE_DEPTH).unwrap_or_default() {
        let Some(key) = key.text() else { continue };
        let name = key.trim_start_matches('/').rsplit('/').next().unwrap_or(key);
        match value.get("ros__parameters") {
            Some(parameters) if [node, "**", "*"].contains(&name) => found.push(parameters),
            Some(_) => {}
            None => collect(value, node, depth + 1, found),
        }
    }
}

struct FlatParameter {
    name: String,
    text: String,
    name_origin: Origin,
    origin: Origin,
}

/// Flattens a mapping to dotted names. No parameter is a list: lists are reported with their first
/// element.
fn flatten(at: &YamlNode, prefix: &str, flat: &mut Vec<FlatParameter>) {
    for (key, value) in at.entries().unwrap_or_default() {
        let Some(last) = key.text() else { continue };
        let name = if prefix.is_empty() { last.to_owned() } else { format!("{prefix}.{last}") };
        let text = match &value.value {
            YamlValue::Map(_) => {
                flatten(value, &name, flat);
                continue;
            }
            YamlValue::Scalar { text, .. } => text.clone(),
            YamlValue::List(list) => {
                list.first().and_then(YamlNode::text).unwrap_or_default().to_owned()
            }
        };
        flat.push(FlatParameter {
            name,
            text,
            name_origin: key.span.into(),
            origin: value.span.into(),
        });
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;

    use super::*;

    fn values(text: &str) -> (ParamValues, Vec<&'static str>) {
        let mut sources = SourceMap::new();
        let file = sources.add("params.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).ok().flatten();
        let mut diagnostics = Diagnostics::new();
        let values = tree.map(|tree| read_parameters(Some(&tree), "amcl", &[], &mut diagnostics));
        (values.unwrap_or_else(|| panic!("{text}")), diagnostics.iter().map(|it| it.code).collect())
    }

    #[test]
    fn files_of_ros2_and_ros1() {
        let ros2 = "
/**: {ros__parameters: {use_sim_time: true}}
planner: {ros__parameters: {tolerance: 0.5}}
amcl: {ros__parameters: {alpha1: 0.1, initial_pose: {x: 2.5}, set_initial_pose: true}}
";
        let (read, codes) = values(ros2);
        assert!(codes.is_empty(), "{codes:?}");
        assert_eq!((read.number("alpha1"), read.number("initial_pose.x")), (Some(0.1), Some(2.5)));
        assert_eq!(read.flag("use_sim_time"), Some(true));
        for ros1 in ["amcl: {odom_alpha1: 0.1}", "odom_alpha1: 0.1"] {
            let (read, codes) = values(ros1);
            assert_eq!((read.number("alpha1"), codes), (Some(0.1), vec!["ros1-name"]), "{ros1}");
        }
        let (read, codes) = values("planner: {ros__parameters: {tolerance: 0.5}}");
        assert!(codes.is_empty() && !read.is_given("alpha1"), "{codes:?}");
        assert_eq!(values("amcl: {ros__parameters: {alpha_1: 1}}").1, ["unknown-parameter"]);
    }
}
