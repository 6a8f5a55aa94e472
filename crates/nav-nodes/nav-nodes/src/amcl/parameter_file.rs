//! Parameters from YAML files of ROS 2 (`amcl: ros__parameters:`) and ROS 1.

use periplus_diagnostics::Diagnostics;
use periplus_localization::{AMCL, Settings};
use periplus_params::{Given, ParamValues};
use periplus_yaml::YamlNode;

use crate::node_parameters::{NodeParameters, collect};

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
    let mut written = NodeParameters::of_sections(sections);
    for (name, text) in overrides {
        written.push(name, text);
    }
    let given: Vec<Given<'_>> = written.given().collect();
    // The last value of a parameter applies, also one by its name of ROS 1; earlier ones are not reported.
    let parameter = |one: &Given<'_>| AMCL.find(one.name).map(|it| it.name);
    let is_last = |(index, one): &(usize, &Given<'_>)| {
        let mut later = given[index + 1..].iter();
        later.all(|later| parameter(later).is_none_or(|name| parameter(one) != Some(name)))
    };
    let last = given.iter().enumerate().filter(is_last).map(|(_, one)| one.clone());
    Settings::read(last, diagnostics).0
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
