//! `$(...)`.

use expect_test::expect;

use crate::example::{check, check_messages, example};

#[test]
fn an_argument_has_its_default() {
    check(
        r#"<xacro:arg name="a" default="1"/><x v="$(arg a)"/><xacro:arg name="a" default="2"/><x v="$(arg a)"/>"#,
        expect![[r#"<x v="1"></x><x v="1"></x>"#]],
    );
}

#[test]
fn an_argument_of_the_command_line_wins() {
    example(r#"<xacro:arg name="a" default="1"/><x v="$(arg a)" w="${xacro.arg('a')}"/>"#)
        .argument("a", "5")
        .check(expect![[r#"<x v="5" w="5"></x>"#]]);
}

#[test]
fn an_argument_needs_no_declaration() {
    example(r#"<x v="$(arg a)"/>"#).argument("a", "5").check(expect![[r#"<x v="5"></x>"#]]);
}

// The reference wants a default in every declaration.
#[test]
fn a_declaration_without_a_default() {
    example(r#"<xacro:arg name="a"/><x v="$(arg a)"/>"#)
        .argument("a", "5")
        .check_lenient(expect![[r#"<x v="5"></x>"#]]);
}

#[test]
fn the_default_of_an_argument_may_be_an_expression() {
    check(
        r#"<xacro:property name="p" value="2"/><xacro:arg name="a" default="${p*2}"/>
        <xacro:arg name="b" default="$(arg a)x"/><x v="$(arg a) $(arg b)"/>"#,
        expect![[r#"<x v="4 4x"></x>"#]],
    );
}

#[test]
fn an_argument_is_text_until_a_property_holds_it() {
    check(
        r#"<xacro:arg name="a" default="2"/><xacro:property name="p" value="$(arg a)"/>
        <x v="${p * 2}" w="${xacro.arg('a') * 2}"/>"#,
        expect![[r#"<x v="4" w="22"></x>"#]],
    );
}

#[test]
fn environment() {
    example(r#"<x v="$(env XT_A)" w="$(optenv XT_A b)" u="$(optenv XT_NONE a  b c)" t="[$(optenv XT_NONE)]"/>"#)
        .variable("XT_A", "one")
        .check(expect![[r#"<x t="[]" u="a b c" v="one" w="one"></x>"#]]);
}

#[test]
fn the_folder_of_a_package() {
    example(r#"<x v="$(find arm)/meshes/a.stl" w="${'$(find arm)'}"/>"#)
        .file("arm/package.xml", "<package><name>arm</name></package>")
        .check(expect![[r#"<x v="/robot/arm/meshes/a.stl" w="/robot/arm"></x>"#]]);
}

#[test]
fn an_argument_names_a_package() {
    example(r#"<xacro:arg name="pkg" default="arm"/><xacro:property name="p" value="arm"/><x v="$(find ${p})/a"/>"#)
        .file("arm/package.xml", "<package><name>arm</name></package>")
        .check(expect![[r#"<x v="/robot/arm/a"></x>"#]]);
}

#[test]
fn the_folder_of_the_file() {
    example(r#"<x v="$(cwd)"/>"#).check(expect![[r#"<x v="/robot"></x>"#]]);
}

// `$(dirname)` of the reference knows no file, and fails.
#[test]
fn the_folder_of_an_included_file() {
    example(r#"<x v="$(dirname)"/><xacro:include filename="sub/a.xacro"/>"#)
        .include("sub/a.xacro", r#"<x v="$(dirname)"/>"#)
        .check_lenient(expect![[r#"<x v="/robot"></x><x v="/robot/sub"></x>"#]]);
}

#[test]
fn eval_sees_arguments() {
    check(
        r#"<xacro:arg name="a" default="2"/><xacro:arg name="s" default="x"/><xacro:arg name="t" default="True"/>
        <x v="$(eval a * 2)" w="$(eval s + 'y')" u="$(eval not t)" z="$(eval a + 0.5)" p="$(eval pi)"/>"#,
        expect![[r#"<x p="3.141592653589793" u="False" v="4" w="xy" z="2.5"></x>"#]],
    );
}

#[test]
fn eval_gives_text() {
    check(
        r#"<xacro:arg name="a" default="2"/><xacro:if value="$(eval a == 2)"><y/></xacro:if>
        <xacro:property name="p" value="$(eval a * 2)"/><x v="${p + 1}"/>"#,
        expect![[r#"<y></y><x v="5"></x>"#]],
    );
}

#[test]
fn constants_of_eval_come_before_arguments() {
    check(
        r#"<xacro:arg name="e" default="5"/><x v="$(eval e)" w="$(arg e)"/>"#,
        expect![[r#"<x v="2.718281828459045" w="5"></x>"#]],
    );
}

// An argument `1e3` is text to the reference, too.
#[test]
fn types_of_arguments_in_eval() {
    check(
        r#"<xacro:arg name="a" default="1e3"/><xacro:arg name="b" default="1.5"/><xacro:arg name="c" default="TRUE"/>
        <x a="$(eval [a, b, c])"/>"#,
        expect![[r#"<x a="['1e3', 1.5, True]"></x>"#]],
    );
}

// The reference ends `$(eval ...)` at the first `)`.
#[test]
fn parentheses_in_eval() {
    example(r#"<xacro:arg name="a" default="2"/><x v="$(eval (1 + arg('a')) * 2)" w="$(eval int('3'))" u="$(eval env('XT_A') + optenv('XT_NONE', 'd'))" d="$(eval dirname())"/>"#)
        .variable("XT_A", "one")
        .check_lenient(expect![[r#"<x d="/robot" u="oned" v="6" w="3"></x>"#]]);
}

#[test]
fn properties_in_eval_are_put_in_as_text() {
    check(
        r#"<xacro:property name="p" value="2"/><x v="$(eval ${p} + 1)"/>"#,
        expect![[r#"<x v="3"></x>"#]],
    );
}

#[test]
fn an_argument_without_a_value() {
    check_messages(
        "\n<xacro:arg name=\"use_gazebo\" default=\"1\"/>\n<x v=\"a$(arg use_gazbo)\"/>\n",
        expect![[r#"
        error[undefined-argument]: the argument `use_gazbo` has no value
         --> main.xacro:3:10
          |
        3 | <x v="a$(arg use_gazbo)"/>
          |          ^^^^^^^^^^^^^
          |
          = help: give it on the command line as `use_gazbo:=VALUE`, or declare a default: <xacro:arg name="use_gazbo" default="..."/>
          = help: did you mean `use_gazebo`?
    "#]],
    );
    check_messages(
        "<xacro:arg name=\"a\"/>",
        expect![[r#"
        error[undefined-argument]: the argument `a` has no value
         --> main.xacro:1:65
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="a"/></r>
          |                                                                 ^
          |
          = help: give it on the command line as `a:=VALUE`, or declare a default: <xacro:arg name="a" default="..."/>
    "#]],
    );
}

#[test]
fn a_variable_without_a_value() {
    check_messages(
        "<x v=\"$(env XT_NONE)\"/>",
        expect![[r#"
        error[unset-variable]: the environment variable `XT_NONE` is not set
         --> main.xacro:1:56
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="$(env XT_NONE)"/></r>
          |                                                        ^^^^^^^^^^^
          |
          = help: set it, or write `$(optenv XT_NONE DEFAULT)`
    "#]],
    );
}

#[test]
fn a_package_that_is_nowhere() {
    check_messages(
        "<x v=\"$(find arm_description)/a\"/>",
        expect![[r#"
        error[missing-resource]: `package://arm_description` cannot be found: there is no package `arm_description`
         --> main.xacro:1:56
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="$(find arm_description)/a"/></r>
          |                                                        ^^^^^^^^^^^^^^^^^^^^
          |
          = note: tried
                    /robot/arm_description
                    /robot/models/arm_description
                    /robot/src/arm_description
                    /robot/**/arm_description
          = help: name the folder that contains `arm_description`: `--resource-path FOLDER`
    "#]],
    );
}

#[test]
fn commands_that_are_not() {
    check_messages(
        "<x v=\"$(fnid a)\"/>",
        expect![[r#"
        error[extension]: `$(fnid)` is not a substitution
         --> main.xacro:1:56
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="$(fnid a)"/></r>
          |                                                        ^^^^^^
          |
          = help: did you mean `$(find ...)`?
    "#]],
    );
    check_messages(
        "<x v=\"$(anon a)\"/>",
        expect![[r#"
        error[extension]: `$(anon)` is not a substitution
         --> main.xacro:1:56
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="$(anon a)"/></r>
          |                                                        ^^^^^^
          |
          = help: there are find, arg, env, optenv, dirname, cwd, eval; write `$$(` for a plain `$(`
    "#]],
    );
    check_messages(
        "<x v=\"$(arg a b)\"/>",
        expect![[r#"
        error[extension]: `$(arg ...)` does not take 2 words
         --> main.xacro:1:56
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><x v="$(arg a b)"/></r>
          |                                                        ^^^^^^^
          |
          = help: they are $(find PKG), $(arg NAME), $(env NAME), $(optenv NAME DEFAULT), $(dirname), $(cwd), $(eval EXPRESSION)
    "#]],
    );
}

#[test]
fn eval_that_fails() {
    check_messages(
        "\n<x v=\"$(eval 1 + nothing)\"/>\n",
        expect![[r#"
            error[expression]: `nothing` is not defined
             --> main.xacro:2:18
              |
            2 | <x v="$(eval 1 + nothing)"/>
              |                  ^^^^^^^
              |
              = note: in the expression `1 + nothing`
              = help: `$(eval ...)` sees arguments only: declare it with <xacro:arg>, or put a property in as ${nothing}
        "#]],
    );
}
