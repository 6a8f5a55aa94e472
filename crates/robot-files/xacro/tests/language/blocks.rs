//! Elements as arguments of macros, and as properties.

use expect_test::expect;

use crate::example::{check, check_lenient, check_messages};

#[test]
fn a_block_is_an_element() {
    check(
        r#"<xacro:macro name="m" params="*origin"><a><xacro:insert_block name="origin"/></a></xacro:macro>
        <xacro:m><origin xyz="1 2 3"/></xacro:m>"#,
        expect![[r#"<a><origin xyz="1 2 3"></origin></a>"#]],
    );
}

#[test]
fn a_content_block_is_what_stands_in_the_element() {
    check(
        r#"<xacro:macro name="m" params="**c"><a><xacro:insert_block name="c"/></a></xacro:macro>
        <xacro:m><any>t<b/><c/></any></xacro:m>"#,
        expect!["<a>t<b></b><c></c></a>"],
    );
}

#[test]
fn an_empty_content_block() {
    check(
        r#"<xacro:macro name="m" params="**c"><a><xacro:insert_block name="c"/></a></xacro:macro>
        <xacro:m><any/></xacro:m>"#,
        expect!["<a></a>"],
    );
}

#[test]
fn blocks_are_taken_in_their_order() {
    check(
        r#"<xacro:macro name="m" params="x *first **second *third">
          <xacro:insert_block name="third"/><xacro:insert_block name="second"/><xacro:insert_block name="first"/></xacro:macro>
        <xacro:m x="1"><a/><b><b1/><b2/></b><c/></xacro:m>"#,
        expect!["<c></c><b1></b1><b2></b2><a></a>"],
    );
}

#[test]
fn a_block_may_be_inserted_several_times() {
    check(
        r#"<xacro:macro name="m" params="*b"><x><xacro:insert_block name="b"/></x><y><xacro:insert_block name="b"/></y></xacro:macro>
        <xacro:m><b v="${1+1}"/></xacro:m>"#,
        expect![[r#"<x><b v="2"></b></x><y><b v="2"></b></y>"#]],
    );
}

#[test]
fn a_block_sees_the_callers_names() {
    check(
        r#"<xacro:property name="v" value="outer"/>
        <xacro:macro name="m" params="v *b"><a v="${v}"/><xacro:insert_block name="b"/></xacro:macro>
        <xacro:m v="inner"><b v="${v}"/></xacro:m>"#,
        expect![[r#"<a v="inner"></a><b v="outer"></b>"#]],
    );
}

#[test]
fn macros_are_called_in_a_block_before_it_is_handed_over() {
    check(
        r#"<xacro:macro name="two"><a/><b/></xacro:macro>
        <xacro:macro name="m" params="*x *y"><x><xacro:insert_block name="x"/></x><y><xacro:insert_block name="y"/></y></xacro:macro>
        <xacro:m><xacro:two/></xacro:m>"#,
        expect!["<x><a></a></x><y><b></b></y>"],
    );
}

#[test]
fn conditions_in_a_call_choose_blocks() {
    check(
        r#"<xacro:macro name="m" params="*x"><xacro:insert_block name="x"/></xacro:macro>
        <xacro:m><xacro:if value="0"><a/></xacro:if><xacro:unless value="0"><b/></xacro:unless></xacro:m>"#,
        expect!["<b></b>"],
    );
}

#[test]
fn a_block_handed_on_to_another_macro() {
    check(
        r#"<xacro:macro name="inner" params="*i"><i><xacro:insert_block name="i"/></i></xacro:macro>
        <xacro:macro name="outer" params="*o"><xacro:inner><xacro:insert_block name="o"/></xacro:inner></xacro:macro>
        <xacro:outer><b/></xacro:outer>"#,
        expect!["<i><b></b></i>"],
    );
}

#[test]
fn blocks_of_one_name_in_nested_calls() {
    check(
        r#"<xacro:macro name="inner" params="*b"><i><xacro:insert_block name="b"/></i></xacro:macro>
        <xacro:macro name="outer" params="*b"><o><xacro:inner><x><xacro:insert_block name="b"/></x></xacro:inner></o></xacro:macro>
        <xacro:outer><b/></xacro:outer>"#,
        expect!["<o><i><x><b></b></x></i></o>"],
    );
}

#[test]
fn a_call_in_the_block_of_a_call() {
    check(
        r#"<xacro:macro name="m" params="n *b"><m n="${n}"><xacro:insert_block name="b"/></m></xacro:macro>
        <xacro:m n="1"><xacro:m n="2"><c/></xacro:m></xacro:m>"#,
        expect![[r#"<m n="1"><m n="2"><c></c></m></m>"#]],
    );
}

#[test]
fn a_macro_called_in_a_macro_sees_its_blocks() {
    check(
        r#"<xacro:macro name="inner"><xacro:insert_block name="b"/></xacro:macro>
        <xacro:macro name="outer" params="*b"><xacro:inner/></xacro:macro>
        <xacro:outer><b/></xacro:outer>"#,
        expect!["<b></b>"],
    );
}

#[test]
fn comments_and_blanks_between_blocks() {
    check(
        r#"<xacro:macro name="m" params="*x *y"><xacro:insert_block name="y"/><xacro:insert_block name="x"/></xacro:macro>
        <xacro:m> <!-- one --> <a/> <!-- two -->
          <b/> </xacro:m>"#,
        expect!["<b></b><a></a>"],
    );
}

#[test]
fn elements_as_a_property() {
    check(
        r#"<xacro:property name="inertia"><mass value="${m}"/><x/></xacro:property><xacro:property name="m" value="2"/>
        <a><xacro:insert_block name="inertia"/></a>"#,
        expect![[r#"<a><mass value="2"></mass><x></x></a>"#]],
    );
}

#[test]
fn elements_as_a_property_see_names_where_they_are_inserted() {
    check(
        r#"<xacro:property name="b"><x v="${v}"/></xacro:property>
        <xacro:macro name="m" params="v"><xacro:insert_block name="b"/></xacro:macro>
        <xacro:m v="1"/><xacro:m v="2"/>"#,
        expect![[r#"<x v="1"></x><x v="2"></x>"#]],
    );
}

#[test]
fn elements_as_a_property_of_another_scope() {
    check(
        r#"<xacro:macro name="m"><xacro:property name="b" scope="parent"><p/></xacro:property>
          <xacro:property name="g" scope="global"><g/></xacro:property></xacro:macro>
        <xacro:m/><xacro:insert_block name="b"/><xacro:insert_block name="g"/>"#,
        expect!["<p></p><g></g>"],
    );
}

#[test]
fn a_property_may_be_a_value_and_elements() {
    check(
        r#"<xacro:property name="b" value="1"/><xacro:property name="b"><x/></xacro:property>
        <a v="${b}"><xacro:insert_block name="b"/></a>"#,
        expect![[r#"<a v="1"><x></x></a>"#]],
    );
}

#[test]
fn content_comes_before_a_block_of_the_same_name() {
    check(
        r#"<xacro:property name="b"><content/></xacro:property>
        <xacro:macro name="m" params="*b"><xacro:insert_block name="b"/></xacro:macro>
        <xacro:m><block/></xacro:m>"#,
        expect!["<content></content>"],
    );
}

#[test]
fn macros_and_properties_in_a_property() {
    check(
        r#"<xacro:macro name="m"><m/></xacro:macro>
        <xacro:property name="b"><xacro:property name="v" value="1"/><x v="${v}"/><xacro:m/></xacro:property>
        <a><xacro:insert_block name="b"/></a><y v="${v}"/>"#,
        expect![[r#"<a><x v="1"></x><m></m></a><y v="1"></y>"#]],
    );
}

#[test]
fn an_escape_in_a_block_is_undone_once_for_each_insertion() {
    check(
        r#"<xacro:macro name="m" params="*b"><xacro:insert_block name="b"/></xacro:macro>
        <xacro:m><b v="$$$${x}"/></xacro:m>"#,
        expect![[r#"<b v="$${x}"></b>"#]],
    );
}

// The reference uses the name of a block as written.
#[test]
fn the_name_of_a_block_may_be_an_expression() {
    check_lenient(
        r#"<xacro:property name="b2"><x/></xacro:property><xacro:insert_block name="b${1+1}"/>"#,
        expect!["<x></x>"],
    );
}

#[test]
fn a_block_that_is_missing() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"*a *b\"><x/></xacro:macro>\n<xacro:m><a/></xacro:m>\n",
        expect![[r#"
            error[missing-block]: the call of `m` has no element for `*b`
             --> main.xacro:3:1
              |
            2 | <xacro:macro name="m" params="*a *b"><x/></xacro:macro>
              | ------------------------------------- the macro
            3 | <xacro:m><a/></xacro:m>
              | ^^^^^^^^^
              |
              = help: put the element between the start and the end of the call
        "#]],
    );
}

#[test]
fn a_block_too_many() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"*a\"><x/></xacro:macro>\n<xacro:m>\n  <a/>\n  <b/>\n</xacro:m>\n",
        expect![[r#"
            error[unused-block]: the macro `m` does not take this `b`
             --> main.xacro:5:3
              |
            2 | <xacro:macro name="m" params="*a"><x/></xacro:macro>
              | ---------------------------------- the macro
            ...
            5 |   <b/>
              |   ^^^^
              |
              = help: remove it, or add a parameter `*name` to the macro
        "#]],
    );
}

#[test]
fn a_block_that_nobody_gave() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"*origin\"><xacro:insert_block name=\"orign\"/></xacro:macro>\n<xacro:m><a/></xacro:m>\n",
        expect![[r#"
            error[unknown-block]: there is no block `orign`
             --> main.xacro:2:66
              |
            2 | <xacro:macro name="m" params="*origin"><xacro:insert_block name="orign"/></xacro:macro>
              |                                                                  ^^^^^
              |
              = note: in the macro `m`, called at main.xacro:3:1
              = help: a block is a macro's parameter `*name` or `**name`, or a property with elements in it
            help: did you mean `origin`?
              |
            2 | <xacro:macro name="m" params="*origin"><xacro:insert_block name="origin"/></xacro:macro>
              |                                                                      +
        "#]],
    );
}

#[test]
fn text_in_a_call_is_not_read() {
    check_messages(
        "<xacro:macro name=\"m\"><x/></xacro:macro>\n<xacro:m>text</xacro:m>\n",
        expect![[r#"
            warning[unread-content]: the macro `m` takes elements, this text is not read
             --> main.xacro:2:10
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m"><x/></xacro:macro>
              |                                                ---------------------- the macro
            2 | <xacro:m>text</xacro:m>
              |          ^^^^
              |
              = help: pass text as a parameter, or put it into an element
        "#]],
    );
}
