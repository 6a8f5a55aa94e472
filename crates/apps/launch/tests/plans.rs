//! Launch files and their plans.
#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use std::path::{Path, PathBuf};

use expect_test::{Expect, expect};
use periplus_diagnostics::{RenderStyle, SourceMap, render};
use periplus_launch::{Interpreter, Outside, OutsideError, Printed, Request, plan};
use periplus_resources::{MemoryHost, Resolver};

/// A machine whose programs echo their arguments.
struct Echo;

impl Outside for Echo {
    fn run(&mut self, words: &[String]) -> Result<Printed, OutsideError> {
        Ok(Printed { output: words.join("|"), is_success: true, ..Printed::default() })
    }

    fn scratch(&mut self, name: &str, _text: &str) -> Result<PathBuf, OutsideError> {
        Ok(Path::new("/scratch").join(name))
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, OutsideError> {
        Err(OutsideError::Unavailable("Python is not available".into()))
    }
}

/// Plan of the first file, or its findings.
fn check(files: &[(&str, &str)], arguments: &[(&str, &str)], expected: Expect) {
    let mut host = MemoryHost::new()
        .with_variable("HOME", "/home/me")
        .with_file("/ws/src/bot/package.xml", "<package format='3'><name>bot</name></package>");
    for (path, text) in files {
        host = host.with_file(path, *text);
    }
    let resolver = Resolver::new(&host, &["/ws/src".into()]);
    let mut sources = SourceMap::new();
    let arguments = arguments.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
    let request = Request {
        file: files[0].0.into(),
        arguments,
        host: &host,
        resolver: &resolver,
        outside: &mut Echo,
    };
    let (plan, found) = plan(request, &mut sources);
    let mut told = String::new();
    if !found.has_errors() {
        told = serde_json::to_string_pretty(&plan).unwrap() + "\n";
    }
    for finding in found.iter() {
        told += &render(finding, &sources, RenderStyle::Plain);
        told.push('\n');
    }
    expected.assert_eq(&told);
}

#[test]
fn xml_of_ros_2() {
    check(
        &[(
            "/ws/src/bot/launch/bot.launch.xml",
            r#"<launch>
  <arg name="sim" default="true" description="in simulation"/>
  <let name="share" value="$(find-pkg-share bot)"/>
  <set_parameter name="use_sim_time" value="$(var sim)"/>
  <group>
    <push-ros-namespace namespace="a"/>
    <node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp" args="--x 'a b'" ros_args="--log-level debug">
      <param name="robot_description" value="$(command 'xacro $(var share)/bot.xacro')" type="str"/>
      <param name="rate"><param name="publish" value="30.5"/></param>
      <param from="$(var share)/p.yaml"/>
      <remap from="/tf" to="tf"/>
    </node>
  </group>
  <node unless="$(var sim)" pkg="driver" exec="driver"/>
  <timer period="2.5"><log message="up"/></timer>
</launch>"#,
        )],
        &[],
        expect![[r#"
            {
              "arguments": [
                {
                  "name": "sim",
                  "description": "in simulation",
                  "default": "true",
                  "value": "true"
                }
              ],
              "steps": [
                {
                  "id": 0,
                  "kind": "node",
                  "package": "robot_state_publisher",
                  "executable": "robot_state_publisher",
                  "name": "rsp",
                  "namespace": "/a",
                  "parameters": [
                    {
                      "values": {
                        "use_sim_time": true
                      }
                    },
                    {
                      "values": {
                        "robot_description": "xacro|/ws/src/bot/bot.xacro"
                      }
                    },
                    {
                      "values": {
                        "rate.publish": 30.5
                      }
                    },
                    {
                      "file": "/ws/src/bot/p.yaml"
                    }
                  ],
                  "remaps": [
                    [
                      "/tf",
                      "tf"
                    ]
                  ],
                  "arguments": [
                    "--x",
                    "a b"
                  ],
                  "ros_arguments": [
                    "--log-level",
                    "debug"
                  ],
                  "written": "/ws/src/bot/launch/bot.launch.xml:7"
                },
                {
                  "id": 1,
                  "after": [
                    {
                      "seconds": 2.5
                    }
                  ],
                  "kind": "log",
                  "level": "info",
                  "text": "up",
                  "written": "/ws/src/bot/launch/bot.launch.xml:15"
                }
              ]
            }
        "#]],
    );
}

#[test]
fn yaml_of_ros_2() {
    check(
        &[
            (
                "/ws/src/bot/launch/bot.launch.yaml",
                r#"launch:
- arg: {name: n, default: "1"}
- group:
    - push_ros_namespace: {namespace: r$(var n)}
    - include:
        file: "$(dirname)/inner.launch.xml"
        arg: [{name: speed, value: "0.5"}]
- node:
    pkg: nav2_amcl
    exec: amcl
    if: $(eval '$(var n) + 1 == 2 and "$(var speed none)" == "none"')
    param: [{name: lasers, value: [1, 2]}]
"#,
            ),
            (
                "/ws/src/bot/launch/inner.launch.xml",
                r#"<launch><arg name="speed"/><executable cmd="echo $(var speed) $(env HOME)"/></launch>"#,
            ),
        ],
        &[],
        expect![[r#"
            {
              "arguments": [
                {
                  "name": "n",
                  "default": "1",
                  "value": "1"
                },
                {
                  "name": "speed",
                  "value": "0.5"
                }
              ],
              "steps": [
                {
                  "id": 0,
                  "kind": "process",
                  "command": [
                    "echo",
                    "0.5",
                    "/home/me"
                  ],
                  "written": "/ws/src/bot/launch/inner.launch.xml:1"
                },
                {
                  "id": 1,
                  "kind": "node",
                  "package": "nav2_amcl",
                  "executable": "amcl",
                  "parameters": [
                    {
                      "values": {
                        "lasers": [
                          1,
                          2
                        ]
                      }
                    }
                  ],
                  "written": "/ws/src/bot/launch/bot.launch.yaml:9"
                }
              ]
            }
        "#]],
    );
}

#[test]
fn xml_of_ros_1() {
    check(
        &[
            (
                "/ws/src/bot/launch/bot.launch",
                r#"<launch>
  <arg name="x" default="2" doc="how many"/>
  <arg name="scan" default="$(eval optenv('LASER', 'front') + '/scan')"/>
  <param name="robot_description" command="$(find xacro)/xacro $(find bot)/bot.xacro"/>
  <rosparam>{a: {b: 1, c: [1.5, 2]}}</rosparam>
  <group ns="g" if="$(eval x == 2)">
    <remap from="scan" to="$(arg scan)"/>
    <node pkg="gmapping" type="slam_gmapping" name="slam" output="screen" respawn="true" respawn_delay="3">
      <param name="xmin" value="-1"/>
      <rosparam command="load" file="$(find bot)/p.yaml"/>
    </node>
  </group>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/></include>
  <include file="inner.launch"><arg name="k" value="$(arg x)"/></include>
</launch>"#,
            ),
            ("/ws/src/bot/p.yaml", "odom_frame: odom\ndelta: 0.05\n"),
            (
                "/ws/src/bot/launch/inner.launch",
                r#"<launch><arg name="k"/><param name="k" value="$(arg k)"/></launch>"#,
            ),
        ],
        &[],
        expect![[r#"
            {
              "arguments": [
                {
                  "name": "x",
                  "description": "how many",
                  "default": "2",
                  "value": "2"
                },
                {
                  "name": "scan",
                  "default": "front/scan",
                  "value": "front/scan"
                }
              ],
              "parameters": {
                "/a/b": 1,
                "/a/c": [
                  1.5,
                  2
                ],
                "/k": 2,
                "/robot_description": "package://xacro/xacro|/ws/src/bot/bot.xacro"
              },
              "steps": [
                {
                  "id": 0,
                  "kind": "node",
                  "package": "gmapping",
                  "executable": "slam_gmapping",
                  "name": "slam",
                  "namespace": "/g",
                  "parameters": [
                    {
                      "values": {
                        "delta": 0.05,
                        "odom_frame": "odom",
                        "xmin": -1
                      }
                    }
                  ],
                  "remaps": [
                    [
                      "scan",
                      "front/scan"
                    ]
                  ],
                  "output": "screen",
                  "respawn_after_s": 3.0,
                  "written": "/ws/src/bot/launch/bot.launch:8"
                },
                {
                  "id": 1,
                  "kind": "include",
                  "file": "package://gazebo_ros/launch/empty_world.launch",
                  "arguments": {
                    "gui": "false"
                  },
                  "written": "/ws/src/bot/launch/bot.launch:13"
                }
              ]
            }
            hint[launch-package]: the package `xacro` is not on this machine
             |
             = note: its files are written as `package://xacro/...` in the plan
             = help: if it is on this machine, give its folder: `--resource-path FOLDER`

            hint[launch-package]: the package `gazebo_ros` is not on this machine
             |
             = note: its files are written as `package://gazebo_ros/...` in the plan
             = help: if it is on this machine, give its folder: `--resource-path FOLDER`

        "#]],
    );
}

#[test]
fn errors_teach() {
    let in_xml = |inside: &str| format!("<launch>\n  {inside}\n</launch>");
    let broken = [
        r#"<node pkg="a" type="b" name="c" exec="d"/>"#,
        r#"<node pkg="a" exec="b" nmae="c"/>"#,
        r#"<arg name="map"/>"#,
        r#"<log message="$(var maap)"/>"#,
        r#"<group if="perhaps"><let name="a" value="b"/></group>"#,
        r#"<include file="$(dirname)/a.launch.xml"/>"#,
        r#"<executable cmd="$(eval '1 +')"/>"#,
        r#"<param name="a" value="$(var b)"/>"#,
    ];
    let mut told = String::new();
    for inside in broken {
        let text = in_xml(inside);
        let host = MemoryHost::new().with_file("/a.launch.xml", text);
        let resolver = Resolver::new(&host, &[]);
        let mut sources = SourceMap::new();
        let request = Request {
            file: "/a.launch.xml".into(),
            arguments: vec![],
            host: &host,
            resolver: &resolver,
            outside: &mut Echo,
        };
        let (_, found) = plan(request, &mut sources);
        assert!(found.has_errors(), "{inside}");
        for finding in found.iter() {
            told += &render(finding, &sources, RenderStyle::Plain);
            told.push('\n');
        }
    }
    expect![[r#"
        error[launch-attribute]: `node` has no `type`
         --> /a.launch.xml:2:17
          |
        2 |   <node pkg="a" type="b" name="c" exec="d"/>
          |                 ^^^^^^^^
          |
          = help: `type` is ROS 1; in ROS 2 use `exec`

        error[launch-attribute]: `node` has no `nmae`
         --> /a.launch.xml:2:26
          |
        2 |   <node pkg="a" exec="b" nmae="c"/>
          |                          ^^^^^^^^
          |
          = help: did you mean `name`?

        error[launch-argument]: /a.launch.xml requires the argument `map`
         --> /a.launch.xml:2:4
          |
        2 |   <arg name="map"/>
          |    ^^^
          |
          = help: add `map:=VALUE`

        error[launch-configuration]: the launch configuration `maap` is not set
         --> /a.launch.xml:2:4
          |
        2 |   <log message="$(var maap)"/>
          |    ^^^
          |
          = help: declare the argument `maap` before its use, or pass `maap:=VALUE`

        error[launch-condition]: a condition must be `true`, `1`, `false` or `0`, not `perhaps`
         --> /a.launch.xml:2:4
          |
        2 |   <group if="perhaps"><let name="a" value="b"/></group>
          |    ^^^^^

        error[launch-include]: includes are nested more than 50 levels deep
         --> //a.launch.xml:2:4
          |
        2 |   <include file="$(dirname)/a.launch.xml"/>
          |    ^^^^^^^
          |
          = help: a file that includes itself needs a condition that ends the recursion

        error[launch-expression]: cannot evaluate `1 +`: the expression ends where a value is needed
         --> /a.launch.xml:2:4
          |
        2 |   <executable cmd="$(eval '1 +')"/>
          |    ^^^^^^^^^^

        error[launch-action]: unknown action `param`
         --> /a.launch.xml:2:4
          |
        2 |   <param name="a" value="$(var b)"/>
          |    ^^^^^
          |
          = help: `param` outside a node is ROS 1: in ROS 2 put it into a node, or use `set_parameter`

    "#]].assert_eq(&told);
}

#[test]
fn the_slip_of_the_tutorial_is_mended_and_told() {
    check(
        &[(
            "/ws/src/bot/launch/teleop.launch",
            r#"<?xml version="1.0"?>
<launch>
  <!-- drives -->
  <node pkg="teleop_twist_keyboard" type="teleop_twist_keyboard.py" name="teleop" output="screen">
    <remap from="/cmd_vel" to="/bot/cmd_vel"/-->
  </node>
</launch>"#,
        )],
        &[("speed", "1")],
        expect![[r#"
            {
              "arguments": [],
              "steps": [
                {
                  "id": 0,
                  "kind": "node",
                  "package": "teleop_twist_keyboard",
                  "executable": "teleop_twist_keyboard.py",
                  "name": "teleop",
                  "remaps": [
                    [
                      "/cmd_vel",
                      "/bot/cmd_vel"
                    ]
                  ],
                  "output": "screen",
                  "written": "/ws/src/bot/launch/teleop.launch:4"
                }
              ]
            }
            warning[launch-xml]: `/-->` is not the end of a comment
             --> /ws/src/bot/launch/teleop.launch:5:47
              |
            5 |     <remap from="/cmd_vel" to="/bot/cmd_vel"  />
              |                                               ^^
              |
              = help: it is read as `/>`

            warning[launch-argument]: /ws/src/bot/launch/teleop.launch has no argument `speed`
             |
             = help: `--show-args` lists its arguments

        "#]],
    );
}
