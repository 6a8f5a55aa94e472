//! `xacro:include`.

use expect_test::expect;

use crate::example::{check_messages, example, whole};

#[test]
fn the_content_of_a_file_comes_in() {
    example(r#"<a/><xacro:include filename="b.xacro"/><c/>"#)
        .include("b.xacro", "<b/>text<b2/>")
        .check(expect!["<a></a><b></b>text<b2></b2><c></c>"]);
}

#[test]
fn macros_and_properties_come_in() {
    example(r#"<xacro:property name="p" value="1"/><xacro:include filename="b.xacro"/><xacro:m v="${q}"/>"#)
        .include("b.xacro", r#"<xacro:property name="q" value="${p + 1}"/><xacro:macro name="m" params="v"><m v="${v}"/></xacro:macro>"#)
        .check(expect![[r#"<m v="2"></m>"#]]);
}

#[test]
fn names_start_at_the_including_file() {
    example(r#"<xacro:include filename="sub/b.xacro"/>"#)
        .include(
            "sub/b.xacro",
            r#"<xacro:include filename="c.xacro"/><xacro:include filename="../d.xacro"/>"#,
        )
        .include("sub/c.xacro", "<c/>")
        .include("d.xacro", "<d/>")
        .check(expect!["<c></c><d></d>"]);
}

#[test]
fn an_include_in_a_macro_starts_where_the_call_stands() {
    example(r#"<xacro:include filename="sub/m.xacro"/><xacro:m/>"#)
        .include(
            "sub/m.xacro",
            r#"<xacro:macro name="m"><xacro:include filename="x.xacro"/></xacro:macro>"#,
        )
        .include("x.xacro", "<outer/>")
        .include("sub/x.xacro", "<inner/>")
        .check(expect!["<outer></outer>"]);
}

#[test]
fn properties_of_an_include_in_a_macro_end_with_it() {
    example(r#"<xacro:property name="p" value="0"/><xacro:macro name="m"><xacro:include filename="b.xacro"/><x v="${p}"/></xacro:macro><xacro:m/><y v="${p}"/>"#)
        .include("b.xacro", r#"<xacro:property name="p" value="1"/>"#)
        .check(expect![[r#"<x v="1"></x><y v="0"></y>"#]]);
}

#[test]
fn a_file_named_by_an_expression() {
    example(
        r#"<xacro:property name="n" value="b"/><xacro:include filename="$(find arm)/${n}.xacro"/>"#,
    )
    .file("arm/package.xml", "<package><name>arm</name></package>")
    .include("arm/b.xacro", "<b/>")
    .check(expect!["<b></b>"]);
}

#[test]
fn a_pattern_brings_in_all_files_that_match() {
    example(r#"<xacro:include filename="parts/p?[0-9]*.xacro"/>"#)
        .include("parts/pa2.xacro", "<a2/>")
        .include("parts/pa10.xacro", "<a10/>")
        .include("parts/pa.xacro", "<no/>")
        .include("parts/.pa1.xacro", "<hidden/>")
        .check(expect!["<a10></a10><a2></a2>"]);
}

#[test]
fn a_pattern_for_folders() {
    example(r#"<xacro:include filename="*/x.xacro"/>"#)
        .include("b/x.xacro", "<b/>")
        .include("a/x.xacro", "<a/>")
        .check(expect!["<a></a><b></b>"]);
}

#[test]
fn a_pattern_that_matches_nothing() {
    example(r#"<xacro:include filename="parts/*.xacro"/><a/>"#).check(expect!["<a></a>"]);
    check_messages(
        r#"<xacro:include filename="parts/*.xacro"/><a/>"#,
        expect![[r#"
        warning[no-match]: no file matches `parts/*.xacro`
         --> main.xacro:1:73
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="parts/*.xacro"/><a/></r>
          |                                                                         ^^^^^^^^^^^^^
          |
          = note: looked for /robot/parts/*.xacro
    "#]],
    );
}

#[test]
fn an_optional_file_may_be_missing() {
    example(r#"<xacro:include filename="none.xacro" optional="true"/><xacro:include filename="b.xacro" optional="true"/>"#)
        .include("b.xacro", "<b/>")
        .check(expect!["<b></b>"]);
}

#[test]
fn a_namespace_holds_properties_and_macros() {
    example(r#"<xacro:include filename="b.xacro" ns="b"/><x v="${b.p}" w="${b.p2 + 1}"/><xacro:b.m v="2"/>"#)
        .include("b.xacro", r#"<xacro:property name="p" value="1"/><xacro:property name="p2" value="${p * 10}"/>
            <xacro:macro name="m" params="v"><m v="${v}" p="${p}"/></xacro:macro>"#)
        .check(expect![[r#"<x v="1" w="11"></x><m p="1" v="2"></m>"#]]);
}

#[test]
fn two_namespaces_of_one_file() {
    example(
        r#"<xacro:property name="side" value="l"/><xacro:include filename="b.xacro" ns="left"/>
        <xacro:property name="side" value="r"/><xacro:include filename="b.xacro" ns="right"/>
        <x l="${left.name}" r="${right.name}"/>"#,
    )
    .include("b.xacro", r#"<xacro:property name="name" value="${side}_arm" lazy_eval="false"/>"#)
    .check(expect![[r#"<x l="l_arm" r="r_arm"></x>"#]]);
}

#[test]
fn namespaces_in_namespaces() {
    example(r#"<xacro:include filename="b.xacro" ns="b"/><x v="${b.c.p}"/><xacro:b.c.m/>"#)
        .include("b.xacro", r#"<xacro:include filename="c.xacro" ns="c"/>"#)
        .include("c.xacro", r#"<xacro:property name="p" value="1"/><xacro:macro name="m"><m p="${p}"/></xacro:macro>"#)
        .check(expect![[r#"<x v="1"></x><m p="1"></m>"#]]);
}

#[test]
fn a_namespace_named_by_an_expression() {
    example(r#"<xacro:include filename="b.xacro" ns="${'n'}1"/><x v="${n1.p}"/>"#)
        .include("b.xacro", r#"<xacro:property name="p" value="1"/>"#)
        .check(expect![[r#"<x v="1"></x>"#]]);
}

#[test]
fn a_macro_of_a_namespace_sees_properties_of_the_file_around() {
    example(r#"<xacro:property name="o" value="outer"/><xacro:include filename="b.xacro" ns="b"/>
        <xacro:macro name="caller"><xacro:property name="o" value="caller"/><xacro:b.m/></xacro:macro><xacro:caller/>"#)
        .include("b.xacro", r#"<xacro:macro name="m"><m o="${o}"/></xacro:macro>"#)
        .check(expect![[r#"<m o="outer"></m>"#]]);
}

#[test]
fn parent_scope_from_a_macro_of_a_namespace() {
    example(r#"<xacro:include filename="b.xacro" ns="b"/><xacro:b.m/><x v="${p}"/>"#)
        .include("b.xacro", r#"<xacro:macro name="m"><xacro:property name="p" value="1" scope="parent"/></xacro:macro>"#)
        .check(expect![[r#"<x v="1"></x>"#]]);
}

#[test]
fn parent_scope_in_a_namespace() {
    example(r#"<xacro:include filename="b.xacro" ns="b"/><x v="${p}"/>"#)
        .include("b.xacro", r#"<xacro:property name="p" value="1" scope="parent"/>"#)
        .check(expect![[r#"<x v="1"></x>"#]]);
}

#[test]
fn a_namespace_as_an_argument() {
    example(r#"<xacro:include filename="b.xacro" ns="b"/><xacro:macro name="m" params="n"><x v="${n.p}"/></xacro:macro><xacro:m n="${b}"/>"#)
        .include("b.xacro", r#"<xacro:property name="p" value="1"/>"#)
        .check(expect![[r#"<x v="1"></x>"#]]);
}

// Macros of the file around are not known in a namespace of the reference.
#[test]
fn a_namespace_sees_macros_of_the_file_around() {
    example(
        r#"<xacro:macro name="m"><m/></xacro:macro><xacro:include filename="b.xacro" ns="b"/>"#,
    )
    .include("b.xacro", "<xacro:m/>")
    .check_lenient(expect!["<m></m>"]);
}

#[test]
fn declarations_of_an_included_file_come_along() {
    example(r#"<a><xacro:include filename="b.xacro"/></a>"#)
        .file("b.xacro", r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro" xmlns:s="http://s"><s:b/></robot>"#)
        .check(expect![[r#"<a xmlns:s="http://s"><s:b></s:b></a>"#]]);
}

#[test]
fn declarations_that_disagree() {
    whole(r#"<r xmlns:xacro="http://www.ros.org/wiki/xacro" xmlns:s="http://one"><xacro:include filename="b.xacro"/></r>"#)
        .file("b.xacro", r#"<robot xmlns:s="http://two"><s:b/></robot>"#)
        .check_messages(expect![[r#"
            warning[namespace-conflict]: `xmlns:s` is declared as something else already
             --> b.xacro:1:8
              |
            1 | <robot xmlns:s="http://two"><s:b/></robot>
              |        ^^^^^^^^^^^^^^^^^^^^
              |
             ::: main.xacro:1:48
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro" xmlns:s="http://one"><xacro:include filename="b.xacro"/></r>
              |                                                -------------------- this declaration holds
              |
              = note: included at main.xacro:1:69
              = help: use another prefix in one of the files
        "#]]);
}

#[test]
fn a_file_may_be_included_twice() {
    example(r#"<xacro:include filename="b.xacro"/><xacro:include filename="b.xacro"/>"#)
        .include("b.xacro", "<b/>")
        .check(expect!["<b></b><b></b>"]);
}

#[test]
fn the_files_that_were_read_are_told_once_each() {
    let (expanded, ..) = example(
        r#"<xacro:include filename="b.xacro"/><xacro:include filename="b.xacro"/><x v="${xacro.load_yaml('c.yaml')}"/>"#,
    )
    .include("b.xacro", "<b/>")
    .file("c.yaml", "1")
    .run();
    let shown: Vec<_> =
        expanded.unwrap().includes.iter().map(|path| path.display().to_string()).collect();
    assert_eq!(shown, ["/robot/b.xacro", "/robot/c.yaml"]);
}

#[test]
fn a_file_that_is_missing() {
    check_messages(
        "\n<xacro:include filename=\"wheel.xacro\"/>\n",
        expect![[r#"
            error[missing-resource]: `wheel.xacro` cannot be found: there is no such file
             --> main.xacro:2:26
              |
            2 | <xacro:include filename="wheel.xacro"/>
              |                          ^^^^^^^^^^^
              |
              = note: tried
                        /robot/wheel.xacro
        "#]],
    );
    example("\n<xacro:include filename=\"parts/weel.xacro\"/>\n")
        .include("parts/wheel.xacro", "")
        .check_messages(expect![[r#"
            error[missing-resource]: `parts/weel.xacro` cannot be found: there is no such file
             --> main.xacro:2:26
              |
            2 | <xacro:include filename="parts/weel.xacro"/>
              |                          ^^^^^^^^^^^^^^^^
              |
              = note: tried
                        /robot/parts/weel.xacro
              = help: did you mean `/robot/parts/wheel.xacro`?
        "#]]);
}

#[test]
fn content_of_an_include_is_not_read() {
    example(r#"<xacro:include filename="b.xacro"><a/></xacro:include>"#)
        .include("b.xacro", "<b/>")
        .check_messages(expect![[r#"
            warning[unread-content]: the content of `xacro:include` is not read
             --> main.xacro:1:82
              |
            1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="b.xacro"><a/></xacro:include></r>
              |                                                ----------------------------------^^^^
              |                                                |
              |                                                the element
              |
              = help: remove it, or move it outside
        "#]]);
}
