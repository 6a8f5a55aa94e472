//! Properties: values, scopes, laziness.

use expect_test::expect;

use crate::example::{check, check_lenient, check_messages};

#[test]
fn a_property_is_a_name_for_a_value() {
    check(
        r#"<xacro:property name="a" value="2"/><x v="${a}" w="${a*a}"/>"#,
        expect![[r#"<x v="2" w="4"></x>"#]],
    );
}

#[test]
fn a_property_may_be_redefined() {
    check(
        r#"<xacro:property name="a" value="1"/><x v="${a}"/><xacro:property name="a" value="2"/><x v="${a}"/>"#,
        expect![[r#"<x v="1"></x><x v="2"></x>"#]],
    );
}

#[test]
fn a_property_may_refer_to_one_that_comes_later() {
    check(
        r#"<xacro:property name="b" value="${a + 1}"/><xacro:property name="a" value="1"/><x v="${b}"/>"#,
        expect![[r#"<x v="2"></x>"#]],
    );
}

#[test]
fn a_property_is_evaluated_once_when_it_is_first_asked_for() {
    check(
        r#"<xacro:property name="a" value="1"/><xacro:property name="b" value="${a}"/>
        <x v="${b}"/><xacro:property name="a" value="2"/><x v="${b}"/>"#,
        expect![[r#"<x v="1"></x><x v="1"></x>"#]],
    );
    check(
        r#"<xacro:property name="a" value="1"/><xacro:property name="b" value="${a}"/>
        <xacro:property name="a" value="2"/><x v="${b}"/>"#,
        expect![[r#"<x v="2"></x>"#]],
    );
}

#[test]
fn without_laziness_a_property_is_evaluated_where_it_stands() {
    check(
        r#"<xacro:property name="a" value="1"/><xacro:property name="b" value="${a}" lazy_eval="false"/>
        <xacro:property name="a" value="2"/><x v="${b}"/>"#,
        expect![[r#"<x v="1"></x>"#]],
    );
}

#[test]
fn without_laziness_a_property_may_use_its_own_value_so_far() {
    check(
        r#"<xacro:property name="a" value="1"/><xacro:property name="a" value="${a + 1}" lazy_eval="false"/>
        <xacro:property name="a" value="${a * 10}" lazy_eval="${False}"/><x v="${a}"/>"#,
        expect![[r#"<x v="20"></x>"#]],
    );
}

#[test]
fn texts_become_numbers_and_truths() {
    let shown = |value: &str| {
        format!(r#"<xacro:property name="a" value="{value}"/><x v="${{python.repr(a)}}"/>"#)
    };
    check(&shown("1"), expect![[r#"<x v="1"></x>"#]]);
    check(&shown("007"), expect![[r#"<x v="7"></x>"#]]);
    check(&shown("-1.50"), expect![[r#"<x v="-1.5"></x>"#]]);
    check(&shown("1e3"), expect![[r#"<x v="1000.0"></x>"#]]);
    check(&shown(" 1 "), expect![[r#"<x v="1"></x>"#]]);
    check(&shown("1_000"), expect![[r#"<x v="'1_000'"></x>"#]]);
    check(&shown("true"), expect![[r#"<x v="True"></x>"#]]);
    check(&shown("False"), expect![[r#"<x v="False"></x>"#]]);
    check(&shown("FALSE"), expect![[r#"<x v="'FALSE'"></x>"#]]);
    check(&shown("inf"), expect![[r#"<x v="inf"></x>"#]]);
    check(&shown("0x10"), expect![[r#"<x v="'0x10'"></x>"#]]);
    check(&shown("None"), expect![[r#"<x v="'None'"></x>"#]]);
    check(&shown("1 2"), expect![[r#"<x v="'1 2'"></x>"#]]);
    check(&shown(""), expect![[r#"<x v="''"></x>"#]]);
    check(&shown("'a b'"), expect![[r#"<x v="'a b'"></x>"#]]);
}

#[test]
fn numbers_in_quotes() {
    let shown = |value: &str, lazy: &str| {
        format!(
            r#"<xacro:property name="a" value="{value}" lazy_eval="{lazy}"/><x v="${{python.repr(a)}}"/>"#
        )
    };
    check(&shown("'1'", "true"), expect![[r#"<x v="1"></x>"#]]);
    check(&shown("'1'", "false"), expect![[r#"<x v="'1'"></x>"#]]);
    check(&shown("''1''", "true"), expect![[r#"<x v="'1'"></x>"#]]);
    check(&shown("'${1}'", "true"), expect![[r#"<x v="1"></x>"#]]);
    check(&shown("${'1'}", "true"), expect![[r#"<x v="1"></x>"#]]);
    check(&shown("${str(1)}", "false"), expect![[r#"<x v="1"></x>"#]]);
}

#[test]
fn the_type_of_an_expression_stays() {
    check(
        r#"<xacro:property name="l" value="${[1, 'b']}"/><xacro:property name="d" value="${dict(a=2)}"/>
        <xacro:property name="t" value="${1 == 1}"/><xacro:property name="s" value="${1}${2}"/>
        <x l="${l[1]}" d="${d['a']}" t="${not t}" s="${s + 1}"/>"#,
        expect![[r#"<x d="2" l="b" s="13" t="False"></x>"#]],
    );
}

#[test]
fn properties_in_properties() {
    check(
        r#"<xacro:property name="a" value="${b}/${c}"/><xacro:property name="b" value="x${c}"/>
        <xacro:property name="c" value="y"/><x v="${a}"/>"#,
        expect![[r#"<x v="xy/y"></x>"#]],
    );
}

#[test]
fn a_default_counts_where_nothing_is_defined() {
    check(
        r#"<xacro:property name="a" default="1"/><x v="${a}"/>
        <xacro:property name="b" value="2"/><xacro:property name="b" default="3"/><x v="${b}"/>"#,
        expect![[r#"<x v="1"></x><x v="2"></x>"#]],
    );
}

#[test]
fn a_default_in_a_macro_gives_way_to_the_callers() {
    check(
        r#"<xacro:macro name="m"><xacro:property name="a" default="in"/><x v="${a}"/></xacro:macro>
        <xacro:m/><xacro:property name="a" value="out"/><xacro:m/>"#,
        expect![[r#"<x v="in"></x><x v="out"></x>"#]],
    );
}

#[test]
fn a_removed_property_is_gone() {
    check(
        r#"<xacro:property name="a" value="1"/><xacro:property name="a" remove="true"/>
        <xacro:property name="a" default="2"/><x v="${a}"/>"#,
        expect![[r#"<x v="2"></x>"#]],
    );
    check(
        r#"<xacro:property name="a" value="1"/><xacro:property name="a" remove="${1 == 2}" value="3"/><x v="${a}"/>"#,
        expect![[r#"<x v="3"></x>"#]],
    );
}

#[test]
fn removing_in_a_macro_removes_outside() {
    check(
        r#"<xacro:property name="a" value="1"/>
        <xacro:macro name="m"><xacro:property name="a" remove="true"/></xacro:macro><xacro:m/>
        <xacro:property name="a" default="2"/><x v="${a}"/>"#,
        expect![[r#"<x v="2"></x>"#]],
    );
}

#[test]
fn global_scope() {
    check(
        r#"<xacro:macro name="inner" params="v"><xacro:property name="g" value="${v}" scope="global"/></xacro:macro>
        <xacro:macro name="outer"><xacro:inner v="1"/></xacro:macro>
        <xacro:outer/><x v="${g}"/>"#,
        expect![[r#"<x v="1"></x>"#]],
    );
}

#[test]
fn parent_scope() {
    check(
        r#"<xacro:property name="p" value="0"/>
        <xacro:macro name="inner"><xacro:property name="p" value="1" scope="parent"/></xacro:macro>
        <xacro:macro name="outer"><xacro:inner/><x v="${p}"/></xacro:macro>
        <xacro:outer/><y v="${p}"/>"#,
        expect![[r#"<x v="1"></x><y v="0"></y>"#]],
    );
}

#[test]
fn values_for_other_scopes_are_evaluated_here() {
    check(
        r#"<xacro:property name="l" value="outer"/>
        <xacro:macro name="m" params="l"><xacro:property name="g" value="${l}" scope="global"/>
          <xacro:property name="p" value="${l}" scope="parent" lazy_eval="true"/></xacro:macro>
        <xacro:m l="inner"/><x g="${g}" p="${p}"/>"#,
        expect![[r#"<x g="inner" p="inner"></x>"#]],
    );
    check(
        r#"<xacro:property name="a" value="1"/><xacro:property name="g" value="${a}" scope="global"/>
        <xacro:property name="a" value="2"/><x v="${g}"/>"#,
        expect![[r#"<x v="1"></x>"#]],
    );
}

#[test]
fn local_scope_may_be_said() {
    check(
        r#"<xacro:property name="a" value="1" scope="local"/><x v="${a}"/>"#,
        expect![[r#"<x v="1"></x>"#]],
    );
}

#[test]
fn the_name_of_a_property_may_be_an_expression() {
    check(
        r#"<xacro:property name="n" value="a"/><xacro:property name="${n}b" value="1"/><x v="${ab}"/>"#,
        expect![[r#"<x v="1"></x>"#]],
    );
}

#[test]
fn a_property_in_a_condition_lives_outside_too() {
    check(
        r#"<xacro:if value="1"><xacro:property name="a" value="1"/></xacro:if><x v="${a}"/>"#,
        expect![[r#"<x v="1"></x>"#]],
    );
}

#[test]
fn a_property_in_an_element_lives_outside_too() {
    check(
        r#"<b><xacro:property name="a" value="1"/></b><x v="${a}"/>"#,
        expect![[r#"<b></b><x v="1"></x>"#]],
    );
}

// Python refuses names with letters outside of ASCII nowhere.
#[test]
fn names_are_those_of_python() {
    check(
        r#"<xacro:property name="größe_2" value="1"/><x v="${größe_2}"/>"#,
        expect![[r#"<x v="1"></x>"#]],
    );
}

#[test]
fn names_that_cannot_be() {
    check_messages(
        r#"<xacro:property name="wheel-radius" value="1"/>"#,
        expect![[r#"
            error[property-name]: `wheel-radius` cannot be the name of a property
             --> main.xacro:1:70
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="wheel-radius" value="1"/></r>
              |                                                                      ^^^^^^^^^^^^
              |
              = help: a name is letters, digits and `_`, starts with a letter, and is not a Python keyword
            help: this would do
              |
            1 - <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="wheel-radius" value="1"/></r>
            1 + <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="wheel_radius" value="1"/></r>
              |
        "#]],
    );
    check_messages(
        r#"<xacro:property name="lambda" value="1"/>"#,
        expect![[r#"
        error[property-name]: `lambda` cannot be the name of a property
         --> main.xacro:1:70
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="lambda" value="1"/></r>
          |                                                                      ^^^^^^
          |
          = help: a name is letters, digits and `_`, starts with a letter, and is not a Python keyword
    "#]],
    );
    check_messages(
        r#"<xacro:property name="__a" value="1"/>"#,
        expect![[r#"
        error[property-name]: `__a` cannot be the name of a property
         --> main.xacro:1:70
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="__a" value="1"/></r>
          |                                                                      ^^^
          |
          = help: a name is letters, digits and `_`, starts with a letter, and is not a Python keyword
    "#]],
    );
}

#[test]
fn hiding_a_built_in_name_works_with_a_warning() {
    check(
        r#"<xacro:property name="pi" value="3"/><x v="${pi}" w="${math.pi}"/>"#,
        expect![[r#"<x v="3" w="3.141592653589793"></x>"#]],
    );
    check_messages(
        r#"<xacro:property name="pi" value="3"/>"#,
        expect![[r#"
        warning[redefines-built-in]: the property `pi` hides xacro's own `pi`
         --> main.xacro:1:70
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="pi" value="3"/></r>
          |                                                                      ^^
          |
          = help: choose another name
    "#]],
    );
}

#[test]
fn a_property_of_a_circle() {
    check_messages(
        "\n<xacro:property name=\"a\" value=\"${b}\"/>\n<xacro:property name=\"b\" value=\"${a}\"/>\n<x v=\"${a}\"/>\n",
        expect![[r#"
            error[circular-property]: `a` is defined by itself
             --> main.xacro:2:33
              |
            2 | <xacro:property name="a" value="${b}"/>
              |                                 ^^^^
            3 | <xacro:property name="b" value="${a}"/>
              |                                 ---- through `b`
              |
              = help: give one of them a value, or set lazy_eval="false" to use the value so far
        "#]],
    );
    check_messages(
        "\n<xacro:property name=\"a\" value=\"${a + 1}\"/>\n<x v=\"${a}\"/>\n",
        expect![[r#"
            error[circular-property]: `a` is defined by itself
             --> main.xacro:2:33
              |
            2 | <xacro:property name="a" value="${a + 1}"/>
              |                                 ^^^^^^^^
              |
              = help: give one of them a value, or set lazy_eval="false" to use the value so far
        "#]],
    );
}

#[test]
fn a_circle_that_nobody_asks_for() {
    check(r#"<xacro:property name="a" value="${a + 1}"/><x/>"#, expect!["<x></x>"]);
}

#[test]
fn too_many_attributes() {
    check_messages(
        r#"<xacro:property name="a" value="1" default="2"/>"#,
        expect![[r#"
            error[property-attributes]: `a` has more than one of value, default and remove
             --> main.xacro:1:48
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="a" value="1" default="2"/></r>
              |                                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
              = help: keep one of them
        "#]],
    );
    check_messages(
        r#"<xacro:property name="a" vlaue="1"/>"#,
        expect![[r#"
        warning[unknown-attribute]: `xacro:property` has no attribute `vlaue`
         --> main.xacro:1:73
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="a" vlaue="1"/></r>
          |                                                                         ^^^^^ not read
          |
        help: did you mean `value`?
          |
        1 - <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="a" vlaue="1"/></r>
        1 + <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="a" value="1"/></r>
          |
    "#]],
    );
}

// The reference crashes on scope="parent" outside of macros, and takes any other word for local.
#[test]
fn scopes_that_are_not() {
    check_messages(
        r#"<xacro:property name="a" value="1" scope="parent"/>"#,
        expect![[r#"
        warning[no-parent-scope]: `a` is not defined: outside of macros there is no parent scope
         --> main.xacro:1:90
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="a" value="1" scope="parent"/></r>
          |                                                                                          ^^^^^^
          |
          = help: remove the attribute `scope`
    "#]],
    );
    check_messages(
        r#"<xacro:property name="a" value="1" scope="globl"/>"#,
        expect![[r#"
        error[property-scope]: `globl` is not a scope
         --> main.xacro:1:90
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="a" value="1" scope="globl"/></r>
          |                                                                                          ^^^^^
          |
          = help: write `parent` or `global`, or leave it out
    "#]],
    );
}

#[test]
fn content_of_a_property_with_a_value_is_not_read() {
    check_messages(
        r#"<xacro:property name="a" value="1"><b/></xacro:property>"#,
        expect![[r#"
        warning[unread-content]: the content of `xacro:property` is not read
         --> main.xacro:1:83
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="a" value="1"><b/></xacro:property></r>
          |                                                -----------------------------------^^^^
          |                                                |
          |                                                the element
          |
          = help: remove it, or move it outside
    "#]],
    );
}

// The reference stops at two dollar signs without a bracket.
#[test]
fn dollar_signs_in_values() {
    check_lenient(
        r#"<xacro:property name="a" value="$$5"/><x v="${a}"/>"#,
        expect![[r#"<x v="$$5"></x>"#]],
    );
}
