//! Text with expressions in it.

use expect_test::expect;

use crate::example::{check, check_lenient, check_messages};

#[test]
fn expressions_in_text_and_attributes() {
    check(r#"<a v="x${1+1}y${2*3}z">t${1}u</a>"#, expect![[r#"<a v="x2y6z">t1u</a>"#]]);
}

#[test]
fn numbers_are_written_as_python_writes_them() {
    check(
        r#"<a i="${2*3}" f="${1/3}" w="${4/2}" e="${1e20}" s="${1e-7}" n="${-0.0}" b="${1==1}" z="${None}"/>"#,
        expect![[
            r#"<a b="True" e="1e+20" f="0.3333333333333333" i="6" n="-0.0" s="1e-07" w="2.0" z="None"></a>"#
        ]],
    );
}

#[test]
fn lists_are_written_as_python_writes_them() {
    check(
        r#"<a l="${[1, 2.5, 'x']}" t="${(1,)}" d="${dict(a=1)}"/>"#,
        expect![[r#"<a d="{'a': 1}" l="[1, 2.5, 'x']" t="(1,)"></a>"#]],
    );
}

#[test]
fn two_dollar_signs_stand_for_one() {
    check(
        r#"<a v="$${x}" w="$$(arg x)" u="$$$${x}" s="a$$${1}b"/>"#,
        expect![[r#"<a s="a$${1}b" u="$$${x}" v="${x}" w="$(arg x)"></a>"#]],
    );
}

#[test]
fn a_lone_dollar_sign() {
    check(
        r#"<a v="$5" w="5$" u="a$b $ c" x="$ {y}"/>"#,
        expect![[r#"<a u="a$b $ c" v="$5" w="5$" x="$ {y}"></a>"#]],
    );
}

// The reference stops with "invalid expression".
#[test]
fn two_lone_dollar_signs() {
    check_lenient(r#"<a v="$$5" w="$$"/>"#, expect![[r#"<a v="$$5" w="$$"></a>"#]]);
}

#[test]
fn braces_alone_mean_nothing() {
    check(r#"<a v="{x} (y) }"/>"#, expect![[r#"<a v="{x} (y) }"></a>"#]]);
}

// The reference ends an expression at the first `}`, regardless of nesting.
#[test]
fn braces_in_strings_and_dicts() {
    check_lenient(r#"<a v="${'}'}" w="${{'a': 1}['a']}"/>"#, expect![[r#"<a v="}" w="1"></a>"#]]);
}

#[test]
fn quotes_and_entities() {
    check(
        r#"<a v="${&quot;x&quot; + 'y'}" w="${1 &lt; 2}" u="&amp;&lt;"/>"#,
        expect![[r#"<a u="&amp;&lt;" v="xy" w="True"></a>"#]],
    );
}

#[test]
fn blanks_in_expressions() {
    check("<a v='${ 1 +\n 1 }'>${ 2\t}</a>", expect![[r#"<a v="2">2</a>"#]]);
}

#[test]
fn extensions_in_expressions() {
    check(
        r#"<xacro:arg name="n" default="2"/><a v="${$(arg n) * 2}" w="${'$(arg n)' + 'x'}"/>"#,
        expect![[r#"<a v="4" w="2x"></a>"#]],
    );
}

#[test]
fn text_over_several_lines_stays_as_it_is() {
    check(
        "<a>\n  1 ${2}\n  3\n</a>",
        expect![[r#"
        <a>1 2
          3</a>"#]],
    );
}

#[test]
fn accents_and_other_scripts() {
    check(r#"<a v="é${'日本'}ü">ñ${'😀'}</a>"#, expect![[r#"<a v="é日本ü">ñ😀</a>"#]]);
}

#[test]
fn an_expression_that_nothing_closes() {
    check_messages(
        "\n<a v=\"1 ${x + 1\"/>\n",
        expect![[r#"
        error[unclosed-expression]: `${` is not closed
         --> main.xacro:2:9
          |
        2 | <a v="1 ${x + 1"/>
          |         ^^^^^^^
          |
          = help: write `}` where it ends, or `$$` for a dollar sign
    "#]],
    );
    check_messages(
        "\n<a>text $(find x</a>\n",
        expect![[r#"
        error[unclosed-expression]: `$(` is not closed
         --> main.xacro:2:9
          |
        2 | <a>text $(find x</a>
          |         ^^^^^^^^
          |
          = help: write `)` where it ends, or `$$` for a dollar sign
    "#]],
    );
}

// The reference leaves `$()` as it is.
#[test]
fn an_empty_expression() {
    check_messages(
        "<a v=\"${}\"/>",
        expect![[r#"
        error[expression]: the expression is empty
         --> main.xacro:1:56
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><a v="${}"/></r>
          |                                                        ^
    "#]],
    );
    check_messages(
        "<a v=\"$()\"/>",
        expect![[r#"
        error[extension]: `$()` is not a substitution
         --> main.xacro:1:56
          |
        1 | <r xmlns:xacro="http://www.ros.org/wiki/xacro"><a v="$()"/></r>
          |                                                        ^
          |
          = help: there are find, arg, env, optenv, dirname, cwd, eval; write `$$(` for a plain `$(`
    "#]],
    );
}

#[test]
fn an_expression_that_is_no_python() {
    check_messages(
        "\n<a v=\"1 ${1 +* 2} 3\"/>\n",
        expect![[r#"
        error[expression]: expected a value, found `*`
         --> main.xacro:2:14
          |
        2 | <a v="1 ${1 +* 2} 3"/>
          |              ^
          |
          = note: in the expression `1 +* 2`
    "#]],
    );
}
