//! `xacro:element`, `xacro:attribute`, and namespaces.

use expect_test::expect;

use crate::example::{check, check_lenient, check_messages, whole};

#[test]
fn an_element_named_by_a_value() {
    check(
        r#"<xacro:property name="n" value="joint"/><xacro:element xacro:name="${n}_x" name="j"><a/></xacro:element>"#,
        expect![[r#"<joint_x name="j"><a></a></joint_x>"#]],
    );
}

#[test]
fn an_element_may_turn_out_to_be_xacros_own() {
    check(
        r#"<xacro:macro name="m" params="v"><a v="${v}"/></xacro:macro>
        <xacro:element xacro:name="xacro:${'m'}" v="1"/>
        <xacro:element xacro:name="xacro:if" value="1"><b/></xacro:element>"#,
        expect![[r#"<a v="1"></a><b></b>"#]],
    );
}

#[test]
fn an_attribute_of_the_element_around() {
    check(
        r#"<a x="1"><xacro:attribute name="y" value="${1+1}m"/><xacro:attribute name="x" value="3"/><b/></a>"#,
        expect![[r#"<a x="3" y="2m"><b></b></a>"#]],
    );
}

#[test]
fn an_attribute_named_by_a_value() {
    check(r#"<a><xacro:attribute name="${'k'}2" value="v"/></a>"#, expect![[r#"<a k2="v"></a>"#]]);
}

#[test]
fn an_attribute_in_a_named_element() {
    check(
        r#"<xacro:element xacro:name="a"><xacro:attribute name="k" value="v"/></xacro:element>"#,
        expect![[r#"<a k="v"></a>"#]],
    );
}

// The reference fails on values that are not text.
#[test]
fn an_attribute_that_is_a_number() {
    check_lenient(
        r#"<a><xacro:attribute name="y" value="${1+1}"/></a>"#,
        expect![[r#"<a y="2"></a>"#]],
    );
}

// The reference sets the attribute on the condition, or the call, and loses it.
#[test]
fn an_attribute_in_a_condition() {
    check_lenient(
        r#"<a><xacro:if value="1"><xacro:attribute name="x" value="1"/></xacro:if></a>"#,
        expect![[r#"<a x="1"></a>"#]],
    );
}

// Likewise.
#[test]
fn an_attribute_from_a_macro() {
    check_lenient(
        r#"<xacro:macro name="m"><xacro:attribute name="x" value="1"/><b/></xacro:macro><a><xacro:m/></a>"#,
        expect![[r#"<a x="1"><b></b></a>"#]],
    );
}

#[test]
fn attributes_of_xacro_are_taken_off() {
    check(r#"<a xacro:note="x" b="1"/>"#, expect![[r#"<a b="1"></a>"#]]);
}

#[test]
fn a_target_namespace_becomes_the_default() {
    whole(r#"<r xmlns:xacro="http://www.ros.org/wiki/xacro" xacro:targetNamespace="http://x"><a/></r>"#)
        .check(expect![[r#"<r xmlns="http://x"><a></a></r>"#]]);
}

#[test]
fn other_namespaces_stay() {
    whole(r#"<r xmlns:xacro="http://www.ros.org/wiki/xacro" xmlns:s="http://s"><s:a s:b="${1}"/></r>"#)
        .check(expect![[r#"<r xmlns:s="http://s"><s:a s:b="1"></s:a></r>"#]]);
}

#[test]
fn the_name_of_the_root_is_evaluated_nowhere_its_attributes_are() {
    whole(r#"<r xmlns:xacro="http://www.ros.org/wiki/xacro" name="${'a'}b"/>"#)
        .check(expect![[r#"<r name="ab"></r>"#]]);
}

#[test]
fn instructions_and_sections_stay() {
    whole("<?xml version='1.0'?><!-- head --><r><?keep me?><![CDATA[a < b]]></r><!-- foot -->")
        .check(expect!["a &lt; b"]);
}

// The reference writes them, and no parser reads the result.
#[test]
fn names_that_xml_cannot_hold() {
    check_messages(
        r#"<xacro:element xacro:name="2${1}"/>"#,
        expect![[r#"
        error[xml-name]: `21` cannot be a name in XML
         --> main.xacro:1:75
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:element xacro:name="2${1}"/></r>
          |                                                                           ^^^^^
          |
          = help: a name starts with a letter and continues with letters, digits, `_`, `-`, `.`
    "#]],
    );
    check_messages(
        r#"<a><xacro:attribute name="a b" value="v"/></a>"#,
        expect![[r#"
        error[xml-name]: `a b` cannot be a name in XML
         --> main.xacro:1:74
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><a><xacro:attribute name="a b" value="v"/></a></r>
          |                                                                          ^^^
          |
          = help: a name starts with a letter and continues with letters, digits, `_`, `-`, `.`
    "#]],
    );
    check_messages(
        r#"<xacro:element xacro:name="${''}"/>"#,
        expect![[r#"
        error[xml-name]: `` cannot be a name in XML
         --> main.xacro:1:75
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:element xacro:name="${''}"/></r>
          |                                                                           ^^^^^
          |
          = help: a name starts with a letter and continues with letters, digits, `_`, `-`, `.`
    "#]],
    );
}

#[test]
fn attributes_that_are_missing() {
    check_messages(
        r#"<xacro:element name="a"/>"#,
        expect![[r#"
        error[missing-attribute]: `xacro:element` needs the attribute `xacro:name`
         --> main.xacro:1:48
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:element name="a"/></r>
          |                                                ^^^^^^^^^^^^^^^^^^^^^^^^^
          |
          = help: add xacro:name="..."
    "#]],
    );
    check_messages(
        r#"<a><xacro:attribute value="a"/></a>"#,
        expect![[r#"
        error[missing-attribute]: `xacro:attribute` needs the attribute `name`
         --> main.xacro:1:51
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><a><xacro:attribute value="a"/></a></r>
          |                                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
          |
          = help: add name="..."
    "#]],
    );
}
