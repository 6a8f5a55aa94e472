//! Messages: position, chain of includes and macros, and remedy.

use expect_test::expect;

use crate::example::{check_messages, example};

#[test]
fn a_name_nobody_defined() {
    check_messages(
        "\n<xacro:property name=\"wheel_radius\" value=\"0.1\"/>\n<a v=\"2 ${2 * wheel_raduis} 3\"/>\n",
        expect![[r#"
            error[expression]: `wheel_raduis` is not defined; did you mean `wheel_radius`?
             --> main.xacro:3:15
              |
            3 | <a v="2 ${2 * wheel_raduis} 3"/>
              |               ^^^^^^^^^^^^
              |
              = note: in the expression `2 * wheel_raduis`
        "#]],
    );
    check_messages(
        "\n<a>\n  text\n  ${nobody}\n</a>\n",
        expect![[r#"
        error[expression]: `nobody` is not defined
         --> main.xacro:4:5
          |
        4 |   ${nobody}
          |     ^^^^^^
          |
          = note: in the expression `nobody`
          = help: define it with a property, or write 'nobody' if it is meant as text
    "#]],
    );
}

#[test]
fn a_macro_nobody_defined() {
    check_messages(
        "\n<xacro:macro name=\"left_wheel\"/>\n<xacro:left_weel/>\n<xacro:arm x=\"1\"/>\n<xacro:proprety name=\"a\"/>\n<xacro:call macro=\"nobody\"/>\n",
        expect![[r#"
            error[unknown-macro]: there is no macro `left_weel`
             --> main.xacro:3:1
              |
            3 | <xacro:left_weel/>
              | ^^^^^^^^^^^^^^^^^^
              |
              = help: define it before the call, or include the file that does
            help: did you mean `xacro:left_wheel`?
              |
            3 | <xacro:left_wheel/>
              |              +
            error[unknown-macro]: there is no macro `arm`
             --> main.xacro:4:1
              |
            4 | <xacro:arm x="1"/>
              | ^^^^^^^^^^^^^^^^^^
              |
              = help: define it before the call, or include the file that does
            help: did you mean `xacro:arg`?
              |
            4 - <xacro:arm x="1"/>
            4 + <xacro:arg x="1"/>
              |
            error[unknown-macro]: there is no macro `proprety`
             --> main.xacro:5:1
              |
            5 | <xacro:proprety name="a"/>
              | ^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
              = help: define it before the call, or include the file that does
            help: did you mean `xacro:property`?
              |
            5 - <xacro:proprety name="a"/>
            5 + <xacro:property name="a"/>
              |
            error[unknown-macro]: there is no macro `nobody`
             --> main.xacro:6:1
              |
            6 | <xacro:call macro="nobody"/>
              | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
              = help: define it before the call, or include the file that does
        "#]],
    );
}

#[test]
fn an_error_in_a_property_is_shown_there() {
    check_messages(
        "\n<xacro:property name=\"length\" value=\"${width / 0}\"/>\n<xacro:property name=\"width\" value=\"1\"/>\n<a v=\"${length}\"/>\n",
        expect![[r#"
            error[expression]: division by zero
             --> main.xacro:2:40
              |
            2 | <xacro:property name="length" value="${width / 0}"/>
              |                                        ^^^^^^^^^
              |
              = note: in the expression `width / 0`
        "#]],
    );
}

#[test]
fn an_error_in_a_macro_names_the_calls() {
    check_messages(
        "\n<xacro:macro name=\"wheel\" params=\"r\">\n  <a v=\"${1 / r}\"/>\n</xacro:macro>\n<xacro:wheel r=\"0\"/>\n<xacro:wheel r=\"1\"/>\n<xacro:wheel r=\"0.0\"/>\n",
        expect![[r#"
            error[expression]: division by zero
             --> main.xacro:3:11
              |
            3 |   <a v="${1 / r}"/>
              |           ^^^^^
              |
              = note: in the macro `wheel`, called at main.xacro:5:1
              = note: in the expression `1 / r`
            error[expression]: division by zero
             --> main.xacro:3:11
              |
            3 |   <a v="${1 / r}"/>
              |           ^^^^^
              |
              = note: in the macro `wheel`, called at main.xacro:7:1
              = note: in the expression `1 / r`
        "#]],
    );
}

#[test]
fn an_error_in_a_macro_in_a_macro_in_a_file() {
    example("\n<xacro:include filename=\"parts/arm.xacro\"/>\n<xacro:arm side=\"left\"/>\n")
        .include("parts/arm.xacro", "\n<xacro:include filename=\"joint.xacro\"/>\n<xacro:macro name=\"arm\" params=\"side\">\n  <xacro:joint name=\"${side}\"/>\n</xacro:macro>\n")
        .include("parts/joint.xacro", "\n<xacro:macro name=\"joint\" params=\"name\">\n  <joint name=\"${name}\" limit=\"${limt}\"/>\n</xacro:macro>\n")
        .check_messages(expect![[r#"
            error[expression]: `limt` is not defined; did you mean `list`?
             --> parts/joint.xacro:3:34
              |
            3 |   <joint name="${name}" limit="${limt}"/>
              |                                  ^^^^
              |
              = note: in the macro `joint`, called at parts/arm.xacro:4:3
              = note: in the macro `arm`, called at main.xacro:3:1
              = note: in the expression `limt`
        "#]]);
}

#[test]
fn a_file_included_in_a_macro_that_is_missing() {
    check_messages(
        "\n<xacro:macro name=\"sensor\" params=\"model\">\n  <xacro:include filename=\"sensors/${model}.xacro\"/>\n</xacro:macro>\n<xacro:sensor model=\"lidar\"/>\n",
        expect![[r#"
            error[missing-resource]: `sensors/lidar.xacro` cannot be found: there is no such file
             --> main.xacro:3:28
              |
            3 |   <xacro:include filename="sensors/${model}.xacro"/>
              |                            ^^^^^^^^^^^^^^^^^^^^^^
              |
              = note: in the macro `sensor`, called at main.xacro:5:1
              = note: tried
                        /robot/sensors/lidar.xacro
        "#]],
    );
}

#[test]
fn a_file_that_is_no_xml() {
    example("\n<xacro:include filename=\"b.xacro\"/>\n")
        .file("b.xacro", "<robot>\n  <a>\n</robot>\n")
        .check_messages(expect![[r#"
            error[malformed-xml]: `</robot>` closes an element that is not open here
             --> b.xacro:3:1
              |
            2 |   <a>
              |   --- this element is still open
            3 | </robot>
              | ^^^^^^^^ `</a>` was expected
              |
              = note: included at main.xacro:2:1
              = help: write `</a>` before it, or remove it
        "#]]);
}

#[test]
fn what_a_call_got_wrong_in_a_macro() {
    check_messages(
        "\n<xacro:macro name=\"inner\" params=\"a *b\"><x/></xacro:macro>\n<xacro:macro name=\"outer\">\n  <xacro:inner/>\n  <xacro:inner a=\"1\" c=\"2\"/>\n</xacro:macro>\n<xacro:outer/>\n",
        expect![[r#"
            error[missing-block]: the call of `inner` has no element for `*b`
             --> main.xacro:4:3
              |
            2 | <xacro:macro name="inner" params="a *b"><x/></xacro:macro>
              | ---------------------------------------- the macro
            3 | <xacro:macro name="outer">
            4 |   <xacro:inner/>
              |   ^^^^^^^^^^^^^^
              |
              = note: in the macro `outer`, called at main.xacro:7:1
              = help: put the element between the start and the end of the call
            error[unknown-parameter]: the macro `inner` has no parameter `c`
             --> main.xacro:5:22
              |
            2 | <xacro:macro name="inner" params="a *b"><x/></xacro:macro>
              | ---------------------------------------- the macro
            ...
            5 |   <xacro:inner a="1" c="2"/>
              |                      ^^^^^
              |
              = note: in the macro `outer`, called at main.xacro:7:1
            error[missing-block]: the call of `inner` has no element for `*b`
             --> main.xacro:5:3
              |
            2 | <xacro:macro name="inner" params="a *b"><x/></xacro:macro>
              | ---------------------------------------- the macro
            ...
            5 |   <xacro:inner a="1" c="2"/>
              |   ^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
              = note: in the macro `outer`, called at main.xacro:7:1
              = help: put the element between the start and the end of the call
        "#]],
    );
}

#[test]
fn an_error_in_a_block_is_shown_where_the_block_stands() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"*b\">\n  <xacro:insert_block name=\"b\"/>\n</xacro:macro>\n<xacro:m>\n  <a v=\"${none}\"/>\n</xacro:m>\n",
        expect![[r#"
            error[expression]: `none` is not defined
             --> main.xacro:6:11
              |
            6 |   <a v="${none}"/>
              |           ^^^^
              |
              = note: in the expression `none`
              = help: write `None`
        "#]],
    );
}

#[test]
fn an_error_in_a_property_of_elements_names_where_it_was_defined() {
    check_messages(
        "\n<xacro:property name=\"b\">\n  <a v=\"${none}\"/>\n</xacro:property>\n<c>\n  <xacro:insert_block name=\"b\"/>\n</c>\n",
        expect![[r#"
            error[expression]: `none` is not defined
             --> main.xacro:3:11
              |
            3 |   <a v="${none}"/>
              |           ^^^^
              |
              = note: in the expression `none`
              = help: write `None`
        "#]],
    );
}

#[test]
fn a_condition_in_a_macro() {
    check_messages(
        "\n<xacro:macro name=\"m\" params=\"fixed\">\n  <xacro:if value=\"${fixed}\"><a/></xacro:if>\n</xacro:macro>\n<xacro:m fixed=\"yes\"/>\n",
        expect![[r#"
            error[condition]: `yes` is neither true nor false
             --> main.xacro:3:20
              |
            3 |   <xacro:if value="${fixed}"><a/></xacro:if>
              |                    ^^^^^^^^
              |
              = note: in the macro `m`, called at main.xacro:5:1
              = help: write true, false, 1 or 0, or compare: ${x == 'a'}
        "#]],
    );
}

#[test]
fn an_argument_put_into_an_expression() {
    check_messages(
        "\n<xacro:arg name=\"n\" default=\"two\"/>\n<a v=\"${$(arg n) * 2}\"/>\n",
        expect![[r#"
            error[expression]: `two` is not defined
             --> main.xacro:3:9
              |
            3 | <a v="${$(arg n) * 2}"/>
              |         ^^^^^^^^^^^^
              |
              = note: in the expression `two * 2`
              = help: define it with a property, or write 'two' if it is meant as text
        "#]],
    );
}

#[test]
fn messages_of_the_file_itself() {
    check_messages(
        "\n<a v=\"${xacro.warning('old', 1)}\"/>\n<a v=\"${xacro.error('bad')}\"/>\n<a v=\"${xacro.message('hello')}\"/>\n<a v=\"${xacro.fatal('stop', 2)}\"/>\n",
        expect![[r#"
            warning[message]: old 1
             --> main.xacro:2:7
              |
            2 | <a v="${xacro.warning('old', 1)}"/>
              |       ^^^^^^^^^^^^^^^^^^^^^^^^^^
            error[message]: bad
             --> main.xacro:3:7
              |
            3 | <a v="${xacro.error('bad')}"/>
              |       ^^^^^^^^^^^^^^^^^^^^^
            hint[message]: hello
             --> main.xacro:4:7
              |
            4 | <a v="${xacro.message('hello')}"/>
              |       ^^^^^^^^^^^^^^^^^^^^^^^^^
            error[expression]: stop 2
             --> main.xacro:5:9
              |
            5 | <a v="${xacro.fatal('stop', 2)}"/>
              |         ^^^^^^^^^^^^^^^^^^^^^^
              |
              = note: in the expression `xacro.fatal('stop', 2)`
        "#]],
    );
}

#[test]
fn an_attribute_of_a_directive_in_a_macro() {
    check_messages(
        "\n<xacro:macro name=\"m\">\n  <xacro:property name=\"a-b\" value=\"1\"/>\n  <xacro:insert_block nmae=\"x\"/>\n</xacro:macro>\n<xacro:m/>\n",
        expect![[r#"
            error[property-name]: `a-b` cannot be the name of a property
             --> main.xacro:3:25
              |
            3 |   <xacro:property name="a-b" value="1"/>
              |                         ^^^
              |
              = note: in the macro `m`, called at main.xacro:6:1
              = help: a name is letters, digits and `_`, starts with a letter, and is not a Python keyword
            help: this would do
              |
            3 -   <xacro:property name="a-b" value="1"/>
            3 +   <xacro:property name="a_b" value="1"/>
              |
            error[missing-attribute]: `xacro:insert_block` needs the attribute `name`
             --> main.xacro:4:3
              |
            4 |   <xacro:insert_block nmae="x"/>
              |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
              = note: in the macro `m`, called at main.xacro:6:1
              = help: add name="..."
        "#]],
    );
}

#[test]
fn a_macro_without_an_end() {
    check_messages(
        "\n<xacro:macro name=\"m\">\n  <xacro:m/>\n</xacro:macro>\n<xacro:m/>\n",
        expect![[r#"
            error[too-deep]: elements, macros and includes are nested more than 300 deep
             --> main.xacro:3:3
              |
            3 |   <xacro:m/>
              |   ^^^^^^^^^^
              |
              = note: in the macro `m`, called at main.xacro:3:3
              = note: in the macro `m`, called at main.xacro:3:3
              = note: in the macro `m`, called at main.xacro:3:3
              = note: in the macro `m`, called at main.xacro:3:3
              = note: in the macro `m`, called at main.xacro:3:3
              = note: in the macro `m`, called at main.xacro:3:3 (and further out)
              = help: does a macro call itself without an end? stop it with <xacro:if>
        "#]],
    );
}
