//! Defining and calling macros.

use expect_test::expect;

use crate::example::{check, check_lenient, check_messages};

#[test]
fn a_macro_is_replaced_by_its_body() {
    check(
        r#"<xacro:macro name="m"><a/>x<b/></xacro:macro><xacro:m/><xacro:m/>"#,
        expect!["<a></a>x<b></b><a></a>x<b></b>"],
    );
}

#[test]
fn a_macro_of_nothing() {
    check(r#"<xacro:macro name="m"/><a/><xacro:m/><b/>"#, expect!["<a></a><b></b>"]);
}

#[test]
fn parameters_are_values_in_the_body() {
    check(
        r#"<xacro:macro name="m" params="x y"><a s="${x+y}" t="${x}${y}"/></xacro:macro>
        <xacro:m y="2" x="1"/>"#,
        expect![[r#"<a s="3" t="12"></a>"#]],
    );
}

#[test]
fn arguments_are_evaluated_where_the_call_stands() {
    check(
        r#"<xacro:property name="x" value="outer"/>
        <xacro:macro name="m" params="x y"><a x="${x}" y="${y}"/></xacro:macro>
        <xacro:m x="inner" y="${x}"/>"#,
        expect![[r#"<a x="inner" y="outer"></a>"#]],
    );
}

#[test]
fn the_body_sees_what_the_caller_sees() {
    check(
        r#"<xacro:macro name="inner"><a v="${v}"/></xacro:macro>
        <xacro:macro name="outer" params="v"><xacro:inner/></xacro:macro>
        <xacro:outer v="1"/><xacro:outer v="2"/>"#,
        expect![[r#"<a v="1"></a><a v="2"></a>"#]],
    );
}

#[test]
fn a_property_of_the_body_ends_with_it() {
    check(
        r#"<xacro:property name="x" value="1"/>
        <xacro:macro name="m"><xacro:property name="x" value="2"/><a x="${x}"/></xacro:macro>
        <xacro:m/><b x="${x}"/>"#,
        expect![[r#"<a x="2"></a><b x="1"></b>"#]],
    );
}

#[test]
fn a_later_definition_replaces_an_earlier() {
    check(
        r#"<xacro:macro name="m" params="x"><a x="${x}"/></xacro:macro><xacro:m x="1"/>
        <xacro:macro name="m" params="y"><b y="${y}"/></xacro:macro><xacro:m y="2"/>"#,
        expect![[r#"<a x="1"></a><b y="2"></b>"#]],
    );
}

#[test]
fn a_macro_defined_in_a_macro_ends_with_it() {
    check(
        r#"<xacro:macro name="m"><a/></xacro:macro>
        <xacro:macro name="outer"><xacro:macro name="m"><b/></xacro:macro><xacro:m/></xacro:macro>
        <xacro:outer/><xacro:m/>"#,
        expect!["<b></b><a></a>"],
    );
}

#[test]
fn a_macro_defined_in_a_macro_sees_its_parameters() {
    check(
        r#"<xacro:macro name="outer" params="p">
          <xacro:macro name="inner" params="q"><a name="${p}_${q}"/></xacro:macro>
          <xacro:inner q="x"/><xacro:inner q="y"/>
        </xacro:macro><xacro:outer p="l"/><xacro:outer p="r"/>"#,
        expect![[r#"<a name="l_x"></a><a name="l_y"></a><a name="r_x"></a><a name="r_y"></a>"#]],
    );
}

#[test]
fn recursion_ends_at_a_condition() {
    check(
        r#"<xacro:macro name="count" params="n"><xacro:if value="${n &gt; 0}"><a n="${n}"/>
          <xacro:count n="${n - 1}"/></xacro:if></xacro:macro><xacro:count n="3"/>"#,
        expect![[r#"<a n="3"></a><a n="2"></a><a n="1"></a>"#]],
    );
}

#[test]
fn recursion_over_a_list() {
    check(
        r#"<xacro:macro name="each" params="items"><xacro:if value="${items}"><a i="${items[0]}"/>
          <xacro:each items="${items[1:]}"/></xacro:if></xacro:macro>
        <xacro:each items="${['x', 'y', 3]}"/>"#,
        expect![[r#"<a i="x"></a><a i="y"></a><a i="3"></a>"#]],
    );
}

#[test]
fn factorial() {
    check(
        r#"<xacro:macro name="fac" params="x f"><xacro:if value="${x &gt; 1}">
            <xacro:fac x="${x-1}" f="${f*x}"/></xacro:if>
            <xacro:unless value="${x &gt; 1}"><r v="${f}"/></xacro:unless></xacro:macro>
        <xacro:fac x="7" f="1"/>"#,
        expect![[r#"<r v="5040"></r>"#]],
    );
}

#[test]
fn a_call_whose_macro_is_a_value() {
    check(
        r#"<xacro:macro name="a" params="v"><a v="${v}"/></xacro:macro>
        <xacro:macro name="b" params="v"><b v="${v}"/></xacro:macro>
        <xacro:property name="which" value="b"/>
        <xacro:call macro="a" v="1"/><xacro:call macro="${which}" v="2"/>"#,
        expect![[r#"<a v="1"></a><b v="2"></b>"#]],
    );
}

#[test]
fn a_call_by_value_with_blocks() {
    check(
        r#"<xacro:macro name="m" params="*block"><a><xacro:insert_block name="block"/></a></xacro:macro>
        <xacro:call macro="${'m'}"><b/></xacro:call>"#,
        expect!["<a><b></b></a>"],
    );
}

#[test]
fn names_may_hold_underscores_digits_and_hyphens() {
    check(r#"<xacro:macro name="_m-2x"><a/></xacro:macro><xacro:_m-2x/>"#, expect!["<a></a>"]);
}

#[test]
fn a_macro_may_be_called_like_something_of_urdf() {
    check(
        r#"<xacro:macro name="link" params="name"><link name="${name}_link"/></xacro:macro>
        <xacro:link name="x"/><link name="y"/>"#,
        expect![[r#"<link name="x_link"></link><link name="y"></link>"#]],
    );
}

#[test]
fn the_prefix_in_a_macros_name_is_taken_off() {
    check(r#"<xacro:macro name="xacro:m"><a/></xacro:macro><xacro:m/>"#, expect!["<a></a>"]);
    check_messages(
        r#"<xacro:macro name="xacro:m"><a/></xacro:macro><xacro:m/>"#,
        expect![[r#"
        warning[macro-name]: a macro is named without `xacro:`
         --> main.xacro:1:67
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="xacro:m"><a/></xacro:macro><xacro:m/></r>
          |                                                                   ^^^^^^^
          |
        help: write the name alone
          |
        1 - <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="xacro:m"><a/></xacro:macro><xacro:m/></r>
        1 + <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m"><a/></xacro:macro><xacro:m/></r>
          |
    "#]],
    );
}

#[test]
fn the_name_of_a_macro_is_no_expression() {
    check_messages(
        r#"<xacro:macro name="${'m'}"><a/></xacro:macro><xacro:m/>"#,
        expect![[r#"
            error[unknown-macro]: there is no macro `m`
             --> main.xacro:1:93
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="${'m'}"><a/></xacro:macro><xacro:m/></r>
              |                                                                                             ^^^^^^^^^^
              |
              = help: define it before the call, or include the file that does
        "#]],
    );
}

#[test]
fn names_that_xacro_needs_itself() {
    check_messages(
        r#"<xacro:macro name="call"/>"#,
        expect![[r#"
        error[macro-name]: `call` cannot be the name of a macro
         --> main.xacro:1:67
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="call"/></r>
          |                                                                   ^^^^
          |
          = help: `call` and names with a `.` have a special meaning in xacro
    "#]],
    );
    check_messages(
        r#"<xacro:macro name="a.b"/>"#,
        expect![[r#"
        error[macro-name]: `a.b` cannot be the name of a macro
         --> main.xacro:1:67
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="a.b"/></r>
          |                                                                   ^^^
          |
          = help: `call` and names with a `.` have a special meaning in xacro
    "#]],
    );
}

#[test]
fn a_macro_sees_macros_defined_after_it() {
    check(
        r#"<xacro:macro name="a"><xacro:b/></xacro:macro>
        <xacro:macro name="b"><x/></xacro:macro><xacro:a/>"#,
        expect!["<x></x>"],
    );
}

#[test]
fn a_macro_in_a_condition_is_defined_outside_too() {
    check(
        r#"<xacro:if value="1"><xacro:macro name="m"><a/></xacro:macro></xacro:if>
        <xacro:if value="0"><xacro:macro name="m"><b/></xacro:macro></xacro:if><xacro:m/>"#,
        expect!["<a></a>"],
    );
}

#[test]
fn namespaces_of_a_macro_are_declared_around_the_call() {
    check(
        r#"<xacro:macro name="m" xmlns:c="http://c"><c:a/></xacro:macro><b><xacro:m/></b>"#,
        expect![[r#"<b xmlns:c="http://c"><c:a></c:a></b>"#]],
    );
}

#[test]
fn an_argument_may_hold_a_list_or_a_dict() {
    check(
        r#"<xacro:macro name="m" params="p"><a n="${len(p)}" x="${p['x']}"/></xacro:macro>
        <xacro:m p="${dict(x=1, y=2)}"/>"#,
        expect![[r#"<a n="2" x="1"></a>"#]],
    );
}

// The reference ends an expression at the first `}`.
#[test]
fn a_dict_in_braces_needs_no_dict_function() {
    check_lenient(
        r#"<xacro:macro name="m" params="p"><a x="${p['x']}"/></xacro:macro><xacro:m p="${{'x': 1}}"/>"#,
        expect![[r#"<a x="1"></a>"#]],
    );
}
