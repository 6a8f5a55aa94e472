//! `xacro.load_yaml`.

use expect_test::{Expect, expect};

use crate::example::{Example, example};

fn with_yaml(content: &str, yaml: &str) -> Example {
    example(content).file("config.yaml", yaml)
}

fn check(expression: &str, yaml: &str, expected: Expect) {
    let load = r#"<xacro:property name="y" value="${xacro.load_yaml('config.yaml')}"/>"#;
    with_yaml(&format!("{load}<x v=\"{expression}\"/>"), yaml).check(expected);
}

#[test]
fn keys_by_bracket_and_by_dot() {
    check(
        "${y['a']['b']} ${y.a.b} ${y.a['c'][1]} ${y.a.c[0] + 1}",
        "a: {b: text, c: [1, 2]}",
        expect![[r#"<x v="text text 2 2"></x>"#]],
    );
}

#[test]
fn lists_of_dicts() {
    check(
        "${y[0].name} ${y[1]['name']} ${len(y)}",
        "- name: l\n- name: r\n",
        expect![[r#"<x v="l r 2"></x>"#]],
    );
}

#[test]
fn types() {
    check(
        "${python.repr(y)}",
        "[1, 1.5, 1e3, 1.0e+3, true, no, null, 'x', 0x1f, 017, 1_000, 12:30:45]",
        expect![[
            r#"<x v="[1, 1.5, '1e3', 1000.0, True, False, None, 'x', 31, 15, 1000, 45045]"></x>"#
        ]],
    );
}

#[test]
fn units() {
    check(
        "${y.a} ${y.b} ${y.c} ${y.d} ${y.e} ${y.f} ${y.g}",
        "a: !degrees 180\nb: !radians pi/2\nc: !meters 2\nd: !millimeters 5\ne: !foot 1\nf: !inches 10\ng: !degrees 90/2\n",
        expect![[
            r#"<x v="3.141592653589793 1.5707963267948966 2.0 0.005 0.3048 0.254 0.7853981633974483"></x>"#
        ]],
    );
}

#[test]
fn anchors_and_merges() {
    check(
        "${y.l.mass} ${y.r.mass} ${y.r.name}",
        "base: &base {mass: 2, name: b}\nl: *base\nr: {<<: *base, mass: 3}\n",
        expect![[r#"<x v="2 3 b"></x>"#]],
    );
}

#[test]
fn texts_over_several_lines() {
    check(
        "${python.repr(y)}",
        "a: |\n  one\n  two\nb: >\n  three\n  four\n",
        expect![[r#"<x v="{'a': 'one\ntwo\n', 'b': 'three four\n'}"></x>"#]],
    );
}

#[test]
fn keys_that_are_no_names() {
    check(
        "${y['a b']} ${y[1]} ${y['key-2']}",
        "a b: 1\n1: two\nkey-2: 3\n",
        expect![[r#"<x v="1 two 3"></x>"#]],
    );
}

#[test]
fn iteration() {
    check(
        "${[v.n for v in y.items_]} ${' '.join(y.names)} ${list(y.d.keys())} ${'a' in y.d}",
        "items_: [{n: 1}, {n: 2}]\nnames: [p, q]\nd: {a: 1, b: 2}\n",
        expect![[r#"<x v="[1, 2] p q ['a', 'b'] True"></x>"#]],
    );
}

#[test]
fn values_are_not_evaluated() {
    check("${y.a}", "a: ${1+1}", expect![[r#"<x v="${1+1}"></x>"#]]);
}

#[test]
fn numbers_in_quotes_stay_text() {
    check("${python.repr(y.a)}", "a: '007'", expect![[r#"<x v="'007'"></x>"#]]);
}

#[test]
fn the_old_name_works_with_a_hint() {
    with_yaml(r#"<x v="${load_yaml('config.yaml')['a']}"/>"#, "a: 1")
        .check(expect![[r#"<x v="1"></x>"#]]);
    with_yaml(r#"<x v="${load_yaml('config.yaml')['a']}"/>"#, "a: 1").check_messages(expect![[r#"
        hint[deprecated-name]: `load_yaml` is deprecated
         --> main.xacro:1:54
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="${load_yaml('config.yaml')['a']}"/></r>
          |                                                      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
          |
          = help: write `xacro.load_yaml`
    "#]]);
}

#[test]
fn a_name_starts_at_the_file_that_asks() {
    example(r#"<xacro:include filename="sub/a.xacro"/>"#)
        .include(
            "sub/a.xacro",
            r#"<x v="${xacro.load_yaml('c.yaml')}" w="${xacro.abs_filename('c.yaml')}"/>"#,
        )
        .file("sub/c.yaml", "inner")
        .file("c.yaml", "outer")
        .check(expect![[r#"<x v="inner" w="/robot/sub/c.yaml"></x>"#]]);
}

#[test]
fn a_list_given_to_a_macro() {
    with_yaml(
        r#"<xacro:macro name="each" params="l"><xacro:if value="${l}"><x n="${l[0].name}"/><xacro:each l="${l[1:]}"/></xacro:if></xacro:macro>
        <xacro:each l="${xacro.load_yaml('config.yaml')}"/>"#,
        "- name: a\n- name: b\n",
    )
    .check(expect![[r#"<x n="a"></x><x n="b"></x>"#]]);
}

#[test]
fn dotify() {
    example(
        r#"<xacro:property name="d" value="${xacro.dotify(dict(a=dict(b=1)))}"/><x v="${d.a.b}"/>"#,
    )
    .check(expect![[r#"<x v="1"></x>"#]]);
}

#[test]
fn an_empty_file() {
    check("${y is None}", "", expect![[r#"<x v="True"></x>"#]]);
}

#[test]
fn a_key_that_is_missing() {
    with_yaml("<xacro:property name=\"y\" value=\"${xacro.load_yaml('config.yaml')}\"/>\n<x v=\"${y.wheel.raduis}\"/>", "wheel: {radius: 1}")
        .check_messages(expect![[r#"
            error[expression]: the dict has no key 'raduis'
             --> main.xacro:2:17
              |
            2 | <x v="${y.wheel.raduis}"/></r>
              |                 ^^^^^^
              |
              = note: in the expression `y.wheel.raduis`
              = help: did you mean 'radius'?
        "#]]);
}

#[test]
fn an_error_is_shown_in_the_yaml_file() {
    with_yaml("<x v=\"${xacro.load_yaml('config.yaml')}\"/>", "a: 1\nü: [1, 2\nb: 3\n")
        .check_messages(expect![[r#"
            error[yaml]: this is not YAML: illegal placement of ':' indicator
             --> config.yaml:3:2
              |
            3 | b: 3
              |  ^
              |
             ::: main.xacro:1:54
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="${xacro.load_yaml('config.yaml')}"/></r>
              |                                                      --------------------------------- loaded here
        "#]]);
    with_yaml("<x v=\"${xacro.load_yaml('config.yaml')}\"/>", "a: 1\r\nb: !parsec 3\r\n")
        .check_messages(expect![[r#"
            error[yaml]: `!parsec` is not a tag; units are !radians, !degrees, !meters, !millimeters, !foot and !inches
             --> config.yaml:2:4
              |
            2 | b: !parsec 3
              |    ^
              |
             ::: main.xacro:1:54
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="${xacro.load_yaml('config.yaml')}"/></r>
              |                                                      --------------------------------- loaded here
        "#]]);
    with_yaml("<x v=\"${xacro.load_yaml('config.yaml')}\"/>", "a: !degrees ninety\n")
        .check_messages(expect![[r#"
            error[yaml]: `ninety` is not a number: `ninety` is not defined
             --> config.yaml:1:4
              |
            1 | a: !degrees ninety
              |    ^
              |
             ::: main.xacro:1:54
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="${xacro.load_yaml('config.yaml')}"/></r>
              |                                                      --------------------------------- loaded here
        "#]]);
}

#[test]
fn a_file_that_is_missing() {
    example("<x v=\"${xacro.load_yaml('confg.yaml')}\"/>").file("config.yaml", "").check_messages(expect![[r#"
        error[missing-resource]: `confg.yaml` cannot be found: there is no such file
         --> main.xacro:1:54
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="${xacro.load_yaml('confg.yaml')}"/></r>
          |                                                      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
          |
          = note: tried
                    /robot/confg.yaml
          = help: did you mean `/robot/config.yaml`?
    "#]]);
}
