//! Comments that are kept, removed or evaluated.

use expect_test::expect;

use crate::example::example;

#[test]
fn comments_stay_as_they_are() {
    example("<!-- a ${1+1} --><a/><!-- b -->")
        .check_with_comments(expect!["<comment>a ${1+1}</comment><a></a><comment>b</comment>"]);
}

#[test]
fn a_comment_before_something_of_xacro_goes_with_it() {
    example("<a/>\n<!-- about p -->\n<xacro:property name='p' value='1'/>\n<!-- about b --><b/>")
        .check_with_comments(expect!["<a></a><comment>about b</comment><b></b>"]);
    example("<!-- one -->\n<!-- two -->\n<xacro:macro name='m'><x/></xacro:macro>\n<!-- call -->\n<xacro:m/>")
        .check_with_comments(expect!["<x></x>"]);
    example("<!-- if --><xacro:if value='1'><x/></xacro:if><!-- arg --><xacro:arg name='a' default='1'/>")
        .check_with_comments(expect!["<x></x>"]);
}

#[test]
fn a_comment_behind_an_empty_line_stays() {
    example("<!-- heading -->\n\n<xacro:property name='p' value='1'/>\n<b/>")
        .check_with_comments(expect!["<comment>heading</comment><b></b>"]);
    example("<!-- heading -->\n\n<!-- about p -->\n<xacro:property name='p' value='1'/>\n<xacro:property name='q' value='1'/>\n<b/>")
        .check_with_comments(expect!["<comment>heading</comment><b></b>"]);
}

#[test]
fn a_comment_that_a_macro_wrote_stays() {
    example("<a/><xacro:macro name='m'><x/><!-- end of m --></xacro:macro><xacro:m/>\n<xacro:property name='p' value='1'/>\n<b/>")
        .check_with_comments(expect!["<a></a><x></x><comment>end of m</comment><b></b>"]);
    example("<a/><xacro:if value='1'><!-- end of if --></xacro:if>\n<xacro:property name='p' value='1'/>\n<b/>")
        .check_with_comments(expect!["<a></a><comment>end of if</comment><b></b>"]);
}

#[test]
fn a_comment_before_a_named_element_stays() {
    example("<!-- c --><xacro:element xacro:name='a'/>")
        .check_with_comments(expect!["<comment>c</comment><a></a>"]);
}

#[test]
fn a_comment_before_a_block_stays() {
    example("<xacro:property name='b'><xacro:property name='p' value='1'/><x/></xacro:property><a><!-- c --><xacro:insert_block name='b'/></a>")
        .check_with_comments(expect!["<a><comment>c</comment><x></x></a>"]);
}

#[test]
fn a_comment_in_a_macro_is_repeated() {
    example("<xacro:macro name='m'><!-- in m --><x/></xacro:macro><xacro:m/><xacro:m/>")
        .check_with_comments(expect![
            "<comment>in m</comment><x></x><comment>in m</comment><x></x>"
        ]);
}

#[test]
fn comments_are_evaluated_where_asked_for() {
    example("<xacro:property name='p' value='7'/><!-- xacro:eval-comments --><!-- p ${p} --><!-- q ${p+1} -->")
        .check_with_comments(expect!["<comment>p 7</comment><comment>q 8</comment>"]);
    example(
        "<!-- xacro:eval-comments:on --><!-- ${1} --><!-- xacro:eval-comments:off --><!-- ${2} -->",
    )
    .check_with_comments(expect!["<comment>1</comment><comment>${2}</comment>"]);
}

#[test]
fn evaluating_comments_ends_at_an_element_or_text() {
    example("<!-- xacro:eval-comments --><!-- ${1} --><a/><!-- ${2} -->")
        .check_with_comments(expect!["<comment>1</comment><a></a><comment>${2}</comment>"]);
    example("<!-- xacro:eval-comments -->\n <!-- ${1} -->text<!-- ${2} -->")
        .check_with_comments(expect!["<comment>1</comment>text<comment>${2}</comment>"]);
    example("<!-- xacro:eval-comments --><a><!-- ${1} --></a>")
        .check_with_comments(expect!["<a><comment>${1}</comment></a>"]);
}
