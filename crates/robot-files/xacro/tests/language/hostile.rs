//! Hostile files: each must fail within bounded time, with a located error, on a small stack.
#![allow(clippy::disallowed_methods, reason = "the time it takes is what is tested")]

use std::time::{Duration, Instant};

use expect_test::{Expect, expect};

use crate::example::{Example, example, whole};

/// Longest time a hostile file may take, in a debug build on a machine with ten times its load.
const SOON: Duration = Duration::from_secs(60);

/// Stack of the thread that expands [bytes]; the main thread of a program has eight times as much.
const STACK: usize = 1 << 20;

/// Codes of all errors, each with the first line of its message. Every error has a location.
fn check(build: impl FnOnce() -> Example + Send + 'static, expected: Expect) {
    expected.assert_eq(&answer(build).join("\n"));
}

fn answer(build: impl FnOnce() -> Example + Send + 'static) -> Vec<String> {
    let run = move || {
        let example = build();
        let start = Instant::now();
        let (expanded, diagnostics, _) = example.run();
        let taken = start.elapsed();
        assert_eq!(expanded.is_none(), diagnostics.has_errors());
        assert!(taken < SOON, "took {taken:?}");
        let mut lines: Vec<String> = Vec::new();
        for found in diagnostics.iter() {
            assert!(found.span.is_some(), "`{}` has no place", found.message);
            let line: String = found.message.chars().take(100).collect();
            lines.push(format!("{}: {line}", found.code));
        }
        lines.dedup();
        lines
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(run).unwrap();
    thread.join().expect("no panic")
}

#[test]
fn a_macro_that_calls_itself() {
    check(
        || example(r#"<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>"#),
        expect!["too-deep: elements, macros and includes are nested more than 300 deep"],
    );
}

#[test]
fn macros_that_call_each_other() {
    check(
        || {
            example(
                r#"<xacro:macro name="a"><x><xacro:b/></x></xacro:macro><xacro:macro name="b"><xacro:if value="1"><xacro:a/></xacro:if></xacro:macro><xacro:a/>"#,
            )
        },
        expect!["too-deep: elements, macros and includes are nested more than 300 deep"],
    );
}

#[test]
fn a_macro_that_defines_itself_anew() {
    check(
        || {
            example(
                r#"<xacro:macro name="m"><xacro:macro name="n"><xacro:m/></xacro:macro><xacro:n/></xacro:macro><xacro:m/>"#,
            )
        },
        expect!["too-deep: elements, macros and includes are nested more than 300 deep"],
    );
}

#[test]
fn a_macro_that_doubles_with_every_call() {
    let double = |n: usize, body: &str| {
        format!(r#"<xacro:macro name="m{}">{body}</xacro:macro>"#, n + 1)
            .replace('@', &n.to_string())
    };
    check(
        move || {
            let macros: String = (0..60).map(|n| double(n, "<xacro:m@/><xacro:m@/>")).collect();
            example(&format!(r#"<xacro:macro name="m0"/>{macros}<xacro:m60/>"#))
        },
        expect!["too-large: the file expands to more than 1000000 parts"],
    );
    check(
        move || {
            let macros: String =
                (0..60).map(|n| double(n, "<a><xacro:m@/></a><xacro:m@/>")).collect();
            example(&format!(
                r#"<xacro:macro name="m0"><b c="d"/></xacro:macro>{macros}<xacro:m60/>"#
            ))
        },
        expect!["too-large: the file expands to more than 1000000 parts"],
    );
}

#[test]
fn a_block_that_doubles_with_every_call() {
    check(
        || {
            let macros: String = (0..60)
                .map(|n| format!(r#"<xacro:macro name="m{}" params="*b"><xacro:m{n}><c><xacro:insert_block name="b"/><xacro:insert_block name="b"/></c></xacro:m{n}></xacro:macro>"#, n + 1))
                .collect();
            example(&format!(
                r#"<xacro:macro name="m0" params="*b"><xacro:insert_block name="b"/></xacro:macro>{macros}<xacro:m60><x/></xacro:m60>"#
            ))
        },
        expect!["too-large: the file expands to more than 1000000 parts"],
    );
}

#[test]
fn a_macro_that_copies_a_large_definition_with_every_call() {
    check(
        || {
            let large = "<a/>".repeat(20_000);
            let calls = "<xacro:m/>".repeat(1_000);
            example(&format!(
                r#"<xacro:macro name="m"><xacro:macro name="n">{large}</xacro:macro></xacro:macro>{calls}"#
            ))
        },
        expect!["too-large: the file expands to more than 1000000 parts"],
    );
    check(
        || {
            let large = "<a/>".repeat(20_000);
            let calls = "<xacro:m/>".repeat(1_000);
            example(&format!(
                r#"<xacro:macro name="m"><xacro:property name="n">{large}</xacro:property></xacro:macro>{calls}"#
            ))
        },
        expect!["too-large: the file expands to more than 1000000 parts"],
    );
}

#[test]
fn a_property_that_doubles() {
    check(
        || {
            let doubling: String = (0..60)
                .map(|n| {
                    format!(r#"<xacro:property name="p{}" value="${{p{n}}}${{p{n}}}"/>"#, n + 1)
                })
                .collect();
            example(&format!(
                r#"<xacro:property name="p0" value="ha"/>{doubling}<a v="${{p60}}"/>"#
            ))
        },
        expect!["too-long: this text becomes longer than 16 MiB, or all texts than 128 MiB"],
    );
    check(
        || {
            let doubling: String = (0..60)
                .map(|n| format!(r#"<xacro:property name="p{}" value="${{p{n} + p{n}}}"/>"#, n + 1))
                .collect();
            example(&format!(
                r#"<xacro:property name="p0" value="ha"/>{doubling}<a v="${{p60}}"/>"#
            ))
        },
        expect!["expression: evaluating this takes too much memory"],
    );
    check(
        || {
            let doubling: String = (0..60)
                .map(|n| {
                    format!(r#"<xacro:property name="p{}" value="${{[p{n}, p{n}]}}"/>"#, n + 1)
                })
                .collect();
            example(&format!(
                r#"<xacro:property name="p0" value="ha"/>{doubling}<a v="${{p60}}"/>"#
            ))
        },
        expect!["expression: evaluating this takes too many steps"],
    );
}

#[test]
fn a_long_text_in_many_places() {
    check(
        || {
            let uses = r#"<a v="x${p}"/>"#.repeat(5_000);
            example(&format!(r#"<xacro:property name="p" value="{}"/>{uses}"#, "x".repeat(1 << 20)))
        },
        expect!["too-long: this text becomes longer than 16 MiB, or all texts than 128 MiB"],
    );
    check(
        || {
            let uses = r#"<a v="${p}"/>"#.repeat(5_000);
            example(&format!(r#"<xacro:property name="p" value="{}"/>{uses}"#, "x".repeat(1 << 20)))
        },
        expect!["too-long: this text becomes longer than 16 MiB, or all texts than 128 MiB"],
    );
    // Text without expressions is shared, not copied.
    check(
        || {
            let uses = r#"<xacro:insert_block name="p"/>"#.repeat(5_000);
            example(&format!(
                r#"<xacro:property name="p"><a v="{}"/></xacro:property>{uses}"#,
                "x".repeat(1 << 20)
            ))
        },
        expect![""],
    );
}

#[test]
fn ten_thousand_properties_in_a_row() {
    check(
        || {
            let chain: String = (0..10_000)
                .map(|n| format!(r#"<xacro:property name="p{}" value="${{p{n}}}"/>"#, n + 1))
                .collect();
            example(&format!(r#"<xacro:property name="p0" value="1"/>{chain}<a v="${{p10000}}"/>"#))
        },
        expect!["too-deep: properties and texts refer to each other more than 100 deep"],
    );
}

#[test]
fn sixty_properties_in_a_row_work() {
    check(
        || {
            let chain: String = (0..60)
                .map(|n| {
                    format!(r#"<xacro:property name="p{}" value="${{((((p{n}))))+1}}"/>"#, n + 1)
                })
                .collect();
            example(&format!(r#"<xacro:property name="p0" value="1"/>{chain}<a v="${{p60}}"/>"#))
        },
        expect![""],
    );
}

#[test]
fn elements_nested_ten_thousand_deep() {
    check(
        || example(&format!("{}{}", "<a>".repeat(10_000), "</a>".repeat(10_000))),
        expect!["too-deep: elements are nested deeper than 200 levels"],
    );
    check(
        || {
            let open = r#"<xacro:if value="1">"#.repeat(10_000);
            example(&format!("{open}{}", "</xacro:if>".repeat(10_000)))
        },
        expect!["too-deep: elements are nested deeper than 200 levels"],
    );
}

#[test]
fn the_deepest_legal_nesting_fits_on_the_stack() {
    // Elements in conditions in blocks, and macros on top of them.
    check(
        || {
            let open = r#"<xacro:if value="1"><a v="${[[[1]]]}">"#.repeat(95);
            example(&format!("{open}{}", "</a></xacro:if>".repeat(95)))
        },
        expect![""],
    );
    check(
        || {
            example(
                r#"<xacro:macro name="m" params="n **b"><xacro:if value="${n}"><a><xacro:m n="${n-1}"><c><xacro:insert_block name="b"/></c></xacro:m></a></xacro:if></xacro:macro><xacro:m n="70"><c/></xacro:m>"#,
            )
        },
        expect![""],
    );
    check(
        || {
            example(
                r#"<xacro:macro name="m" params="n"><xacro:if value="${n}"><xacro:m n="${n-1}"/></xacro:if></xacro:macro><xacro:m n="140"/>"#,
            )
        },
        expect![""],
    );
    let deep_value = |depth: usize| format!("{}1{}", "[".repeat(depth), "]".repeat(depth));
    check(
        move || {
            let chain: String = (0..95)
                .map(|n| {
                    format!(
                        r#"<xacro:property name="p{}" value="${{{}[0] + [p{n}]}}"/>"#,
                        n + 1,
                        deep_value(2)
                    )
                })
                .collect();
            let open = r#"<xacro:if value="1">"#.repeat(190);
            let close = "</xacro:if>".repeat(190);
            example(&format!(
                r#"<xacro:property name="p0" value="1"/>{chain}{open}<a v="${{len(p60)}}"/>{close}"#
            ))
        },
        expect![""],
    );
}

#[test]
fn much_of_everything() {
    check(|| example(&format!(r#"<a v="{}"/>"#, "${1}".repeat(200_000))), expect![""]);
    check(
        || {
            let params: String = (0..10_000).map(|n| format!("p{n} ")).collect();
            let values: String = (0..10_000).map(|n| format!(r#" p{n}="{n}""#)).collect();
            example(&format!(
                r#"<xacro:macro name="m" params="{params}"><a v="${{p9999}}"/></xacro:macro><xacro:m{values}/>"#
            ))
        },
        expect![""],
    );
    check(
        || {
            let children = "<b/>".repeat(100_000);
            example(&format!(
                r#"<xacro:macro name="m" params="*b"><a/></xacro:macro><xacro:m>{children}</xacro:m>"#
            ))
        },
        expect!["unused-block: the macro `m` does not take this `b`"],
    );
    check(
        || {
            let children = "<b/>".repeat(10_000);
            let params: String = (0..10_000).map(|n| format!("*p{n} ")).collect();
            example(&format!(
                r#"<xacro:macro name="m" params="{params}"><xacro:insert_block name="p77"/></xacro:macro><xacro:m>{children}</xacro:m>"#
            ))
        },
        expect![""],
    );
    check(
        || {
            let comments = "<!-- c -->".repeat(50_000);
            example(&format!(r#"{comments}<xacro:property name="p" value="1"/>"#))
        },
        expect![""],
    );
}

#[test]
fn many_brackets() {
    check(
        || example(&format!(r#"<a v="{}"/>"#, "${{}".repeat(250_000))),
        expect!["expression: the expression ends where a value is needed"],
    );
    check(
        || example(&format!(r#"<a v="$(find {}"/>"#, "${{}".repeat(250_000))),
        expect!["unclosed-expression: `$(` is not closed"],
    );
    check(
        || example(&format!(r#"<a v="{}"/>"#, "$(eval (".repeat(100_000))),
        expect!["unclosed-expression: `$(` is not closed"],
    );
    check(
        || example(&format!(r#"<a v="{}"/>"#, "$(find ".repeat(100_000))),
        expect!["unclosed-expression: `$(` is not closed"],
    );
    check(
        || example(&format!(r#"<a v="{}x{}"/>"#, "$(find ".repeat(10_000), ")".repeat(10_000))),
        expect!["unclosed-expression: `$(` is not closed"],
    );
    check(
        || example(&format!(r#"<a v="{}x{}"/>"#, "${".repeat(10_000), "}".repeat(10_000))),
        expect!["too-deep: properties and texts refer to each other more than 100 deep"],
    );
    check(
        || example(&format!(r#"<a v="${{{}1{}}}"/>"#, "(".repeat(100_000), ")".repeat(100_000))),
        expect!["expression: the expression nests more than 80 levels deep"],
    );
    check(|| example(&format!(r#"<a v="{}{{x}}"/>"#, "$".repeat(1_000_000))), expect![""]);
}

#[test]
fn expressions_that_want_too_much() {
    check(
        || example(r#"<a v="${10**10**10}"/>"#),
        expect!["expression: the integer gets too large"],
    );
    check(
        || example(r#"<a v="${'a'*10**9}"/>"#),
        expect!["expression: evaluating this takes too much memory"],
    );
    check(
        || example(r#"<a v="${[0]*10**9}"/>"#),
        expect!["expression: evaluating this takes too much memory"],
    );
    check(
        || example(r#"<a v="${[i for i in range(10**9)]}"/><b v="${sum(range(10**9))}"/>"#),
        expect![[r#"
            deprecated-name: `range` is deprecated
            expression: evaluating this takes too many steps"#]],
    );
    check(
        || example(r#"<a v="${(lambda f: f(f))(lambda f: f(f))}"/>"#),
        expect!["expression: this nests more than 220 levels deep"],
    );
}

#[test]
fn many_errors_end_the_reading() {
    let said = answer(|| example(&r#"<a v="${1/0}"/>"#.repeat(10_000)));
    assert_eq!(said, ["expression: division by zero"]);
    let said = answer(|| {
        example(&format!(
            r#"<xacro:macro name="m" params="n"><a v="${{none{}}}"/></xacro:macro>{}"#,
            "${n}",
            (0..1000).map(|n| format!(r#"<xacro:m n="{n}"/>"#)).collect::<String>()
        ))
    });
    assert!(said.len() <= 30, "{}", said.len());
}

#[test]
fn files_that_include_each_other() {
    check(
        || example(r#"<xacro:include filename="main.xacro"/>"#),
        expect!["include-cycle: `main.xacro` includes itself without end"],
    );
    check(
        || {
            example(r#"<xacro:include filename="a.xacro"/>"#)
                .include("a.xacro", r#"<xacro:include filename="b.xacro"/>"#)
                .include("b.xacro", r#"<xacro:include filename="a.xacro"/>"#)
        },
        expect!["include-cycle: `a.xacro` includes itself without end"],
    );
    // Doubling includes, and a pattern that matches the including file.
    check(
        || {
            let twice = |n| format!(r#"<xacro:include filename="f{n}.xacro"/>"#).repeat(2);
            let last = example(&twice(0)).include("f35.xacro", "");
            (0..35).fold(last, |example, n| example.include(&format!("f{n}.xacro"), &twice(n + 1)))
        },
        expect!["too-large: the file expands to more than 1000000 parts"],
    );
    check(
        || example(r#"<xacro:include filename="*"/>"#),
        expect!["include-cycle: `main.xacro` includes itself without end"],
    );
}

#[test]
fn yaml_that_means_harm() {
    let load = r#"<a v="${xacro.load_yaml('y.yaml')}"/>"#;
    let deep = |open: &str| open.repeat(100_000);
    let (squares, braces, dashes, quests) = (deep("["), deep("{a: "), deep("- "), deep("? "));
    check(
        move || example(load).file("y.yaml", squares),
        expect!["yaml: this is not YAML: recursion limit exceeded"],
    );
    check(
        move || example(load).file("y.yaml", braces),
        expect!["yaml: this is not YAML: recursion limit exceeded"],
    );
    check(
        move || example(load).file("y.yaml", dashes),
        expect!["yaml: the file is nested too deeply or too large"],
    );
    check(
        move || example(load).file("y.yaml", quests),
        expect!["yaml: the file is nested too deeply or too large"],
    );
    check(
        move || {
            let mut text = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
            for level in 1..12 {
                text +=
                    &format!("a{level}: &a{level} [{}]\n", format!("*a{}, ", level - 1).repeat(10));
            }
            example(load).file("y.yaml", text)
        },
        expect!["yaml: the file is nested too deeply or too large"],
    );
    check(
        move || example(load).file("y.yaml", "a: &a [*a]"),
        expect!["yaml: an alias names an anchor that is still open"],
    );
    check(
        move || example(load).file("y.yaml", "<<: &a {<<: *a}"),
        expect!["yaml: an alias names an anchor that is still open"],
    );
    check(
        || {
            example(r#"<a v="${len([xacro.load_yaml('y.yaml') for i in range(100000)])}"/>"#)
                .file("y.yaml", "a: 1\n".repeat(100))
        },
        expect!["deprecated-name: `range` is deprecated"],
    );
}

#[test]
fn files_that_are_no_text() {
    check(
        || {
            example(r#"<xacro:include filename="b.xacro"/>"#)
                .file("b.xacro", vec![b'<', b'a', 0xff, 0xfe, b'>'])
        },
        expect![
            "unreadable-file: `b.xacro` cannot be read: line 1 holds bytes that are not UTF-8; save the file as UTF-8, or name its"
        ],
    );
    check(
        || {
            example(r#"<a v="${xacro.load_yaml('b.yaml')}"/>"#)
                .file("b.yaml", vec![0xff, 0x80, 0x80])
        },
        expect![
            "unreadable-file: `b.yaml` cannot be read: line 1 holds bytes that are not UTF-8; save the file as UTF-8, or name its "
        ],
    );
    check(
        || example(r#"<xacro:include filename="."/>"#),
        expect!["unreadable-file: `.` cannot be read: this is not a regular file"],
    );
}

/// A file outside of the project is neither read nor mentioned.
fn check_secret(content: &'static str, expected: Expect) {
    let build = move || {
        let mut example = example(content).include("sub/part.xacro", "");
        example.secret("/etc/passwd", "SECRET: <secret/>");
        example.secret("/home/ada/key.yaml", "SECRET: {");
        example
    };
    let messages = build().messages();
    assert!(!messages.contains("SECRET"), "{messages}");
    check(build, expected);
}

#[test]
fn files_outside_of_the_project() {
    check_secret(
        r#"<xacro:include filename="/etc/passwd"/>"#,
        expect!["resource-outside: `/etc/passwd` may not be used: it leaves the resource paths"],
    );
    check_secret(
        r#"<xacro:include filename="../../../etc/passwd"/>"#,
        expect![
            "resource-outside: `/robot/../../../etc/passwd` may not be used: it leaves the resource paths"
        ],
    );
    check_secret(
        r#"<xacro:include filename="sub/../../etc/passwd"/>"#,
        expect![
            "resource-outside: `/robot/sub/../../etc/passwd` may not be used: it leaves the resource paths"
        ],
    );
    check_secret(
        r#"<xacro:include filename="/etc/pass*"/>"#,
        expect!["resource-outside: `/etc` may not be used: it leaves the resource paths"],
    );
    check_secret(
        r#"<xacro:include filename="/*/*/key.yaml"/>"#,
        expect!["resource-outside: `/` may not be used: it leaves the resource paths"],
    );
    check_secret(
        r#"<xacro:include filename="/etc/passwd" optional="true"/>"#,
        expect!["resource-outside: `/etc/passwd` may not be used: it leaves the resource paths"],
    );
    check_secret(
        r#"<a v="${xacro.load_yaml('/etc/passwd')}"/>"#,
        expect!["resource-outside: `/etc/passwd` may not be used: it leaves the resource paths"],
    );
    check_secret(
        r#"<a v="${xacro.load_yaml('../home/ada/key.yaml')}"/>"#,
        expect![
            "resource-outside: `/robot/../home/ada/key.yaml` may not be used: it leaves the resource paths"
        ],
    );
    check_secret(
        r#"<a v="$(find ../etc)/passwd"/>"#,
        expect!["bad-uri: `package://../etc` names nothing: `..` is not a valid package name"],
    );
}

#[test]
fn the_root_alone() {
    check(
        || whole("<xacro:macro xmlns:xacro='http://www.ros.org/wiki/xacro' name='m'/>"),
        expect![""],
    );
    check(
        || whole("<xacro:if value='0'><a v='${1/0}'/></xacro:if>"),
        expect!["expression: division by zero"],
    );
}
