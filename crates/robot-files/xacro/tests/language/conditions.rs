//! `xacro:if` and `xacro:unless`.

use expect_test::expect;

use crate::example::{check, check_lenient, check_messages};

/// Returns true if `<xacro:if value="...">` expands its content.
fn truth(value: &str, expected: expect_test::Expect) {
    check(
        &format!(
            r#"<xacro:if value="{value}">yes</xacro:if><xacro:unless value="{value}">no</xacro:unless>"#
        ),
        expected,
    );
}

#[test]
fn words_and_numbers() {
    truth("true", expect!["yes"]);
    truth("True", expect!["yes"]);
    truth("false", expect!["no"]);
    truth("False", expect!["no"]);
    truth("1", expect!["yes"]);
    truth("0", expect!["no"]);
    truth("-2", expect!["yes"]);
    truth(" 1 ", expect!["yes"]);
}

#[test]
fn values_of_expressions() {
    truth("${1 == 1}", expect!["yes"]);
    truth("${0.0}", expect!["no"]);
    truth("${0.5}", expect!["yes"]);
    truth("${[]}", expect!["no"]);
    truth("${[0]}", expect!["yes"]);
    truth("${None}", expect!["no"]);
    truth("${dict()}", expect!["no"]);
    truth("${'true'}", expect!["yes"]);
    truth("${'0'}", expect!["no"]);
    truth("${not 1}", expect!["no"]);
    truth("${1}${0}", expect!["yes"]);
}

#[test]
fn properties_and_arguments() {
    check(
        r#"<xacro:property name="p" value="false"/><xacro:arg name="a" default="true"/>
        <xacro:if value="${p}"><x/></xacro:if><xacro:if value="$(arg a)"><y/></xacro:if>
        <xacro:unless value="${p}"><z/></xacro:unless>"#,
        expect!["<y></y><z></z>"],
    );
}

#[test]
fn conditions_in_conditions() {
    check(
        r#"<xacro:if value="1"><a/><xacro:if value="0"><b/></xacro:if><xacro:if value="1"><c/></xacro:if></xacro:if>"#,
        expect!["<a></a><c></c>"],
    );
}

#[test]
fn what_a_condition_leaves_out_is_not_looked_at() {
    check(
        r#"<xacro:if value="0"><a v="${nothing / 0}"/><xacro:nobody/><xacro:include filename="nowhere"/></xacro:if>"#,
        expect![""],
    );
}

// The reference puts empty lines behind the condition.
#[test]
fn text_in_a_condition() {
    check_lenient(r#"<a>x<xacro:if value="1">${1+1}</xacro:if>y</a>"#, expect!["<a>x2y</a>"]);
}

#[test]
fn elements_called_if_are_none_of_ours() {
    check(
        r#"<if value="0"><a/></if><unless value="1"><a/></unless>"#,
        expect![[r#"<if value="0"><a></a></if><unless value="1"><a></a></unless>"#]],
    );
}

#[test]
fn what_is_neither_true_nor_false() {
    check_messages(
        r#"<xacro:if value="maybe"><a/></xacro:if>"#,
        expect![[r#"
        error[condition]: `maybe` is neither true nor false
         --> main.xacro:1:65
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:if value="maybe"><a/></xacro:if></r>
          |                                                                 ^^^^^
          |
          = help: write true, false, 1 or 0, or compare: ${x == 'a'}
    "#]],
    );
    check_messages(
        "<xacro:property name=\"p\" value=\"on\"/>\n<xacro:if value=\"${p}\"><a/></xacro:if>",
        expect![[r#"
            error[condition]: `on` is neither true nor false
             --> main.xacro:2:18
              |
            2 | <xacro:if value="${p}"><a/></xacro:if></r>
              |                  ^^^^
              |
              = help: write true, false, 1 or 0, or compare: ${x == 'a'}
        "#]],
    );
    check_messages(
        r#"<xacro:if value=""><a/></xacro:if>"#,
        expect![[r#"
        error[condition]: `` is neither true nor false
         --> main.xacro:1:65
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:if value=""><a/></xacro:if></r>
          |                                                                 ^
          |
          = help: write true, false, 1 or 0, or compare: ${x == 'a'}
    "#]],
    );
    check_messages(
        r#"<xacro:if value="1.0"><a/></xacro:if>"#,
        expect![[r#"
        error[condition]: `1.0` is neither true nor false
         --> main.xacro:1:65
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:if value="1.0"><a/></xacro:if></r>
          |                                                                 ^^^
          |
          = help: write true, false, 1 or 0, or compare: ${x == 'a'}
    "#]],
    );
}

#[test]
fn a_condition_without_a_value() {
    check_messages(
        r#"<xacro:if><a/></xacro:if>"#,
        expect![[r#"
        error[missing-attribute]: `xacro:if` needs the attribute `value`
         --> main.xacro:1:48
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:if><a/></xacro:if></r>
          |                                                ^^^^^^^^^^
          |
          = help: add value="..."
    "#]],
    );
    check_messages(
        r#"<xacro:if test="1"><a/></xacro:if>"#,
        expect![[r#"
        error[missing-attribute]: `xacro:if` needs the attribute `value`
         --> main.xacro:1:48
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:if test="1"><a/></xacro:if></r>
          |                                                ^^^^^^^^^^^^^^^^^^^
          |
          = help: add value="..."
    "#]],
    );
}
