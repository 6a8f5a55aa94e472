//! Kinds of launch files that once failed.
#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use periplus_diagnostics::{RenderStyle, SourceMap, render};
use periplus_launch::{LaunchPlan, Nothing, Request, Trigger, What, plan};
use periplus_resources::{MemoryHost, Resolver};

/// Plan of the first file, and its findings as text.
fn planned(files: &[(&str, &str)], arguments: &[(&str, &str)]) -> (LaunchPlan, String) {
    let host = files.iter().fold(
        MemoryHost::new()
            .with_file("/ws/src/bot/package.xml", "<package><name>bot</name></package>"),
        |host, (path, text)| host.with_file(path, *text),
    );
    let resolver = Resolver::new(&host, &[]);
    let mut sources = SourceMap::new();
    let arguments = arguments.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
    let file = files[0].0.into();
    let request =
        Request { file, arguments, host: &host, resolver: &resolver, outside: &mut Nothing };
    let (plan, found) = plan(request, &mut sources);
    let words = found.iter().map(|one| render(one, &sources, RenderStyle::Plain)).collect();
    (plan, words)
}

const XML: &str = "/ws/src/bot/launch/a.launch.xml";
const ROS1: &str = "/ws/src/bot/launch/a.launch";

#[test]
fn actions_of_ros_gz_include_the_files_of_their_packages() {
    let text = r#"<launch>
      <gz_server world_sdf_file="w.sdf" create_own_container="True"/>
      <gz_spawn_model world="w" file="bot.sdf" entity_name="bot" z="0.5"/>
      <ros_gz_bridge bridge_name="bridge" config_file="b.yaml"/>
    </launch>"#;
    let (plan, _) = planned(&[(XML, text)], &[]);
    let of = |step: usize| match &plan.steps[step].what {
        What::Include { file, arguments } => (file.as_str(), arguments.len()),
        other => panic!("{other:?}"),
    };
    assert_eq!(of(0), ("package://ros_gz_sim/launch/gz_server.launch.py", 2));
    assert_eq!(of(1), ("package://ros_gz_sim/launch/gz_spawn_model.launch.py", 4));
    assert_eq!(of(2), ("package://ros_gz_bridge/launch/ros_gz_bridge.launch.py", 2));
}

#[test]
fn events_are_decided_after_everything_that_happens_at_once() {
    let text = r#"<launch>
      <let name="who" value="early"/>
      <timer period="1.0"><log message="$(var who)"/></timer>
      <let name="who" value="late"/>
      <log message="now"/>
    </launch>"#;
    let (plan, _) = planned(&[(XML, text)], &[]);
    let said = plan.steps.iter().map(|step| match &step.what {
        What::Log { text, .. } => (text.as_str(), step.after.as_slice()),
        other => panic!("{other:?}"),
    });
    let said: Vec<_> = said.collect();
    assert_eq!(said, [("now", &[][..]), ("late", &[Trigger::Seconds(1.0)][..])]);
}

#[test]
fn steps_carry_the_environment_with_its_places() {
    let text = r#"<launch>
      <group>
        <set_env name="GZ_SIM_RESOURCE_PATH" value="/models"/>
        <log message="in"/>
      </group>
      <log message="out"/>
    </launch>"#;
    let (plan, _) = planned(&[(XML, text)], &[]);
    let variable = &plan.steps[0].environment["GZ_SIM_RESOURCE_PATH"];
    assert_eq!(variable.value.as_deref(), Some("/models"));
    assert_eq!(variable.written.as_deref(), Some("/ws/src/bot/launch/a.launch.xml:3"));
    assert!(plan.steps[1].environment.is_empty(), "a scoped group undoes its own");
}

#[test]
fn a_file_that_only_a_build_makes_is_that_of_its_package() {
    let text = r#"<launch><include file="$(find-pkg-share bot)/launch/sim.launch.py"/></launch>"#;
    let template = ("/ws/src/bot/launch/sim.launch.py.in", "@VERSION@");
    let (plan, words) = planned(&[(XML, text), template], &[]);
    let file = match &plan.steps[0].what {
        What::Include { file, .. } => file,
        other => panic!("{other:?} {words}"),
    };
    assert_eq!(file, "package://bot/launch/sim.launch.py");
}

#[test]
fn groups_in_groups_end() {
    let text = format!(
        "<launch>{}<log message='x'/>{}</launch>",
        "<group>".repeat(180),
        "</group>".repeat(180)
    );
    let (_, words) = planned(&[(XML, &text)], &[]);
    assert!(words.contains("actions are nested more than"), "{words}");
}

#[test]
fn inline_rosparam_of_several_keys_keeps_its_indentation_and_place() {
    let text = "<launch>\n  <rosparam>\n    odom_frame: odom\n    base_frame: base_link\n  </rosparam>\n</launch>";
    let (plan, words) = planned(&[(ROS1, text)], &[]);
    assert_eq!(plan.parameters["/odom_frame"], "odom", "{words}");
    assert_eq!(plan.parameters["/base_frame"], "base_link");
    let broken = text.replace("odom_frame: odom", "odom_frame: [odom");
    let (_, words) = planned(&[(ROS1, &broken)], &[]);
    assert!(words.contains("/ws/src/bot/launch/a.launch:"), "{words}");
}

#[test]
fn arguments_of_the_command_line_hold_without_being_declared() {
    let text = r#"<launch><param name="bag" value="$(arg bag)"/></launch>"#;
    let (plan, words) = planned(&[(ROS1, text)], &[("bag", "a.bag")]);
    assert_eq!(plan.parameters["/bag"], "a.bag", "{words}");
    let (_, words) = planned(&[(ROS1, text)], &[]);
    assert!(words.contains("`bag:=VALUE`"), "{words}");
}

/// A missing file leaves a gap in the plan that is reported with its position; planning continues.
#[test]
fn absent_files_are_gaps_of_a_plan() {
    let ros1 = "<launch>
  <rosparam command='load' file='/ws/src/bot/config/no.yaml'/>
  <param name='text' textfile='/ws/src/bot/config/no.txt'/>
  <include file='/ws/src/bot/launch/no.launch'><arg name='a' value='1'/></include>
  <node pkg='p' type='t' name='last'/>
</launch>";
    let (plan, found) = planned(&[("/ws/src/bot/launch/a.launch", ros1)], &[]);
    let json = serde_json::to_string(&plan).unwrap();
    assert!(json.contains("last") && json.contains("no.launch"), "{json}");
    assert!(plan.parameters.is_empty(), "{json}");
    for (line, file) in [(2, "no.yaml"), (3, "no.txt"), (4, "no.launch")] {
        let place = format!("a.launch:{line}:");
        assert!(found.contains(&place) && found.contains(file), "{place}: {found}");
    }
    assert_eq!(found.matches("warning[launch-missing-file]").count(), 3, "{found}");
    assert!(!found.contains("error["), "{found}");

    let ros2 = "<launch>
  <include file='/ws/src/bot/launch/no.launch.xml'><arg name='a' value='1'/></include>
  <node pkg='p' exec='last'><param from='/ws/src/bot/no.yaml' allow_substs='true'/></node>
</launch>";
    let (plan, found) = planned(&[("/ws/src/bot/launch/a.launch.xml", ros2)], &[]);
    let json = serde_json::to_string(&plan).unwrap();
    assert!(json.contains("last") && json.contains("no.launch.xml"), "{json}");
    assert_eq!(found.matches("warning[launch-missing-file]").count(), 2, "{found}");
}
