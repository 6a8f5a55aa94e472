//! `param`.

use std::path::Path;

use expect_test::expect;
use periplus_graph::{Node, NodeSettings, parameter_from_yaml};
use periplus_ros2cli::param::{self, ParamListOptions};

use crate::bench::Bench;

/// A node that accepts any parameters, with some set.
fn lidar(bench: &Bench) -> Node {
    let value = |text| parameter_from_yaml(text).unwrap();
    let settings = NodeSettings::new("lidar")
        .any_parameters()
        .parameter("range.max", value("10.0"))
        .parameter("beams", value("360"))
        .parameter("frames", value("[a, b]"));
    bench.graph.node(settings).unwrap()
}

#[test]
fn parameters_are_seen() {
    let bench = Bench { all: true, ..Bench::new() };
    let _lidar = lidar(&bench);
    bench.check(
        |session| param::list(session, &ParamListOptions::default()),
        expect![[r#"
        /lidar:
          beams
          frames
          range.max
          use_sim_time
    "#]],
    );
    let of_lidar = ParamListOptions {
        node: Some("/lidar".into()),
        show_types: true,
        ..ParamListOptions::default()
    };
    let typed = bench.run(|session| param::list(session, &of_lidar));
    assert!(
        typed.starts_with("  beams (type: integer)\n  frames (type: string array)\n"),
        "{typed}"
    );
    bench.check(
        |session| param::get(session, "/lidar", "beams", false),
        expect![[r#"
        Integer value is: 360
    "#]],
    );
    bench.check(
        |session| param::get(session, "/lidar", "range.max", true),
        expect![[r#"
        10.0
    "#]],
    );
    bench.check(
        |session| param::get(session, "lidar", "frames", false),
        expect![[r#"
        String values are: ['a', 'b']
    "#]],
    );
    bench.check(
        |session| param::get(session, "/lidar", "beam", false),
        expect![[r#"
        ! Parameter not set: /lidar has no `beam`; did you mean `beams`?
    "#]],
    );
    bench.check(
        |session| param::get(session, "/lidr", "beams", false),
        expect![[r#"
        ! Node not found: '/lidr'; did you mean `/lidar`?
    "#]],
    );
    bench.check(
        |session| param::dump(session, "/lidar"),
        expect![[r#"
        /lidar:
          ros__parameters:
            beams: 360
            frames: [a, b]
            range:
              max: 10.0
            use_sim_time: true
    "#]],
    );
    bench.check(
        |session| param::describe(session, "/lidar", &["beams".into()]),
        expect![[r#"
        Parameter name: beams
          Type: integer
          Constraints:
    "#]],
    );
    let json = bench.json();
    json.check(
        |session| param::get(session, "/lidar", "frames", false),
        expect![[r#"
        {"name":"frames","node":"/lidar","type":"string array","value":["a","b"]}
    "#]],
    );
    json.check(|session| param::dump(session, "/lidar"), expect![[r#"
        {"node":"/lidar","parameters":{"beams":360,"frames":["a","b"],"range.max":10.0,"use_sim_time":true}}
    "#]]);
}

#[test]
fn parameters_are_set() {
    let bench = Bench { all: true, ..Bench::new() };
    let _lidar = lidar(&bench);
    bench.check(
        |session| param::set(session, "/lidar", "beams", "180"),
        expect![[r#"
        Set parameter successful
    "#]],
    );
    bench.check(
        |session| param::get(session, "/lidar", "beams", true),
        expect![[r#"
        180
    "#]],
    );
    bench.check(
        |session| param::set(session, "/lidar", "beams", "many"),
        expect![[r#"
        Set parameter successful
    "#]],
    );
    bench.check(
        |session| param::set(session, "/lidar", "beams", "{a: 1}"),
        expect![[r#"
        ! the value `{a: 1}` is a mapping; a parameter is one value or a list
    "#]],
    );
    let file = "/**:\n  ros__parameters:\n    beams: 90\n/lidar:\n  ros__parameters:\n    range: {max: 5.5}\n";
    let load = |file: &str| {
        bench.run(|session| param::load(session, "/lidar", Path::new("p.yaml"), file, true))
    };
    expect![[r#"
        Set parameter beams successful
        Set parameter range.max successful
    "#]]
    .assert_eq(&load(file));
    expect![[r#"
        ! Param file does not contain parameters for /lidar: it has to have them under `/lidar:`, then `ros__parameters:`
    "#]].assert_eq(&load("/other:\n  ros__parameters:\n    a: 1\n"));
    bench.check(
        |session| param::dump(session, "/lidar"),
        expect![[r#"
        /lidar:
          ros__parameters:
            beams: 90
            frames: [a, b]
            range:
              max: 5.5
            use_sim_time: true
    "#]],
    );
}

#[test]
fn a_list_of_lists_is_set_as_text() {
    let bench = Bench { all: true, ..Bench::new() };
    let _lidar = lidar(&bench);
    let text = "[[0.3, 0.3], [0.3, -0.3], [-0.3, 0.0]]";
    bench.check(
        |session| param::set(session, "/lidar", "footprint", text),
        expect![[r#"
        Set parameter successful
    "#]],
    );
    let got = bench.run(|session| param::get(session, "/lidar", "footprint", true));
    assert_eq!(got, format!("{text}\n"));
    for text in ["[1, 2", "[1, 2.5]"] {
        let wrong = bench.run(|session| param::set(session, "/lidar", "footprint", text));
        assert!(wrong.starts_with(&format!("! the value `{text}`")), "{wrong}");
    }
}
