//! Defaults of parameters, and forwarded values.

use expect_test::expect;

use crate::example::{check, check_lenient, check_messages};

const SHOW: &str = r#"<xacro:macro name="show" params="a"><a v="${a}"/></xacro:macro>"#;

#[test]
fn a_default_is_taken_when_the_call_leaves_it_out() {
    check(
        r#"<xacro:macro name="m" params="x y:=5 z=6"><a v="${x} ${y} ${z}"/></xacro:macro>
        <xacro:m x="1"/><xacro:m x="1" y="2" z="3"/>"#,
        expect![[r#"<a v="1 5 6"></a><a v="1 2 3"></a>"#]],
    );
}

#[test]
fn a_default_in_quotes_may_hold_blanks() {
    check(
        r#"<xacro:macro name="m" params="xyz:='0 0 1' rpy:=&quot;1 2&quot; b"><a v="${xyz}|${rpy}|${b}"/></xacro:macro>
        <xacro:m b="c"/>"#,
        expect![[r#"<a v="0 0 1|&quot;1 2&quot;|c"></a>"#]],
    );
}

#[test]
fn a_default_may_be_an_expression_of_the_callers_names() {
    check(
        r#"<xacro:property name="p" value="1"/>
        <xacro:macro name="m" params="x:=${p + 1} y:=${2*p}_z"><a x="${x}" y="${y}"/></xacro:macro>
        <xacro:m/>
        <xacro:macro name="outer"><xacro:property name="p" value="10"/><xacro:m/></xacro:macro>
        <xacro:outer/>"#,
        expect![[r#"<a x="2" y="2_z"></a><a x="11" y="20_z"></a>"#]],
    );
}

#[test]
fn an_empty_default_in_quotes() {
    check(
        r#"<xacro:macro name="m" params="x:=''"><a v="[${x}]"/></xacro:macro><xacro:m/>"#,
        expect![[r#"<a v="[]"></a>"#]],
    );
}

// The reference takes `x:=` for a parameter without a default.
#[test]
fn an_empty_default_without_quotes() {
    check_lenient(
        r#"<xacro:macro name="m" params="x:="><a v="[${x}]"/></xacro:macro><xacro:m/>"#,
        expect![[r#"<a v="[]"></a>"#]],
    );
}

#[test]
fn line_breaks_and_blanks_around_the_signs() {
    check(
        "<xacro:macro name='m' params='a := 1\n  b\t=2\n c:=3'><a v='${a} ${b} ${c}'/></xacro:macro><xacro:m/>",
        expect![[r#"<a v="1 2 3"></a>"#]],
    );
}

#[test]
fn a_default_from_an_argument() {
    check(
        r#"<xacro:arg name="x" default="7"/>
        <xacro:macro name="m" params="x:=$(arg x)"><a v="${x + 1}"/></xacro:macro><xacro:m/>"#,
        expect![[r#"<a v="8"></a>"#]],
    );
}

#[test]
fn a_forwarded_parameter_takes_the_callers_property() {
    check(
        r#"<xacro:macro name="m" params="x:=^"><a v="${x}"/></xacro:macro>
        <xacro:property name="x" value="1"/><xacro:m/><xacro:m x="2"/>"#,
        expect![[r#"<a v="1"></a><a v="2"></a>"#]],
    );
}

#[test]
fn a_forwarded_parameter_with_a_default() {
    check(
        r#"<xacro:macro name="m" params="x:=^|42"><a v="${x}"/></xacro:macro>
        <xacro:m/><xacro:property name="x" value="1"/><xacro:m/><xacro:m x="2"/>"#,
        expect![[r#"<a v="42"></a><a v="1"></a><a v="2"></a>"#]],
    );
}

#[test]
fn forwarding_through_two_macros() {
    check(
        r#"<xacro:macro name="inner" params="p:=^ q:=^|0"><a p="${p}" q="${q}"/></xacro:macro>
        <xacro:macro name="outer" params="p"><xacro:inner/></xacro:macro>
        <xacro:outer p="1"/>"#,
        expect![[r#"<a p="1" q="0"></a>"#]],
    );
}

#[test]
fn forwarding_to_an_empty_default() {
    check(
        r#"<xacro:macro name="m" params="x:=^|''"><a v="[${x}]"/></xacro:macro><xacro:m/>"#,
        expect![[r#"<a v="[]"></a>"#]],
    );
}

#[test]
fn forwarding_keeps_the_type() {
    check(
        r#"<xacro:macro name="m" params="x:=^"><a v="${x[1]}"/></xacro:macro>
        <xacro:property name="x" value="${[1, 2]}"/><xacro:m/>"#,
        expect![[r#"<a v="2"></a>"#]],
    );
}

#[test]
fn arguments_become_numbers_and_truths() {
    check(
        r#"<xacro:macro name="m" params="x"><a v="${type(x) == type('')} ${x}"/></xacro:macro>"#
            .replace("type(", "python.type(")
            .as_str(),
        expect![""],
    );
    check(
        &format!(
            r#"<xacro:macro name="m" params="x"><a v="${{python.repr(x)}}"/></xacro:macro>{}"#,
            r#"<xacro:m x="1"/><xacro:m x="1.50"/><xacro:m x="true"/><xacro:m x="'1'"/><xacro:m x="1_0"/><xacro:m x=""/>"#
        ),
        expect![[
            r#"<a v="1"></a><a v="1.5"></a><a v="True"></a><a v="'1'"></a><a v="'1_0'"></a><a v="''"></a>"#
        ]],
    );
}

#[test]
fn a_default_in_quotes_is_text_even_when_it_looks_like_a_number() {
    check(
        r#"<xacro:macro name="m" params="x:='007' y:=007"><a v="${python.repr(x)} ${python.repr(y)}"/></xacro:macro><xacro:m/>"#,
        expect![[r#"<a v="'007' 7"></a>"#]],
    );
}

#[test]
fn the_value_of_an_argument_is_not_evaluated_twice() {
    check(&format!("{SHOW}<xacro:show a=\"$${{b}}\"/>"), expect![[r#"<a v="${b}"></a>"#]]);
}

#[test]
fn a_value_may_hold_equals_signs_and_colons() {
    check(
        r#"<xacro:macro name="m" params="a:=package://x/y.stl b:=k=v"><a v="${a} ${b}"/></xacro:macro><xacro:m/>"#,
        expect![[r#"<a v="package://x/y.stl k=v"></a>"#]],
    );
}

#[test]
fn a_parameter_given_twice_in_the_definition() {
    check_messages(
        r#"<xacro:macro name="m" params="a b a"><a/></xacro:macro>"#,
        expect![[r#"
            warning[repeated-parameter]: the macro `m` has the parameter `a` twice
             --> main.xacro:1:78
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m" params="a b a"><a/></xacro:macro></r>
              |                                                                              ^^^^^
              |
              = help: remove one of them
        "#]],
    );
}

#[test]
fn parameters_that_are_missing() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"a b c:=1\"><a/></xacro:macro>\n<xacro:m c=\"2\"/>\n",
        expect![[r#"
            error[missing-parameter]: the call of `m` leaves out `a`, `b`
             --> main.xacro:3:1
              |
            2 | <xacro:macro name="m" params="a b c:=1"><a/></xacro:macro>
              | ---------------------------------------- the macro
            3 | <xacro:m c="2"/>
              | ^^^^^^^^^^^^^^^^
              |
              = help: add a="..." b="..."
        "#]],
    );
}

#[test]
fn a_parameter_the_macro_does_not_have() {
    check_messages(
        "\n<xacro:macro name=\"wheel\" params=\"prefix radius:=1\"><a/></xacro:macro>\n<xacro:wheel prefix=\"l\" raduis=\"2\"/>\n",
        expect![[r#"
            error[unknown-parameter]: the macro `wheel` has no parameter `raduis`
             --> main.xacro:3:25
              |
            2 | <xacro:macro name="wheel" params="prefix radius:=1"><a/></xacro:macro>
              | ---------------------------------------------------- the macro
            3 | <xacro:wheel prefix="l" raduis="2"/>
              |                         ^^^^^^^^^^
              |
            help: did you mean `radius`?
              |
            3 - <xacro:wheel prefix="l" raduis="2"/>
            3 + <xacro:wheel prefix="l" radius="2"/>
              |
        "#]],
    );
}

#[test]
fn nothing_to_forward() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"side:=^\"><a/></xacro:macro>\n<xacro:m/>\n",
        expect![[r#"
            error[missing-parameter]: the call of `m` leaves out `side`, and there is no property `side` to pass on
             --> main.xacro:3:1
              |
            2 | <xacro:macro name="m" params="side:=^"><a/></xacro:macro>
              | --------------------------------------- the macro
            3 | <xacro:m/>
              | ^^^^^^^^^^
              |
              = help: add side="...", or define the property before the call
        "#]],
    );
}

#[test]
fn a_default_that_fails_is_shown_in_the_macro() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"a:=1 b:=${missing + 1}\"><a/></xacro:macro>\n<xacro:m/>\n",
        expect![[r#"
            error[expression]: `missing` is not defined
             --> main.xacro:2:41
              |
            2 | <xacro:macro name="m" params="a:=1 b:=${missing + 1}"><a/></xacro:macro>
              |                                         ^^^^^^^
              |
              = note: in the macro `m`, called at main.xacro:3:1
              = note: in the expression `missing + 1`
              = help: define it with a property, or write 'missing' if it is meant as text
        "#]],
    );
}
