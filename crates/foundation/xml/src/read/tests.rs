use expect_test::{Expect, expect};
use periplus_diagnostics::{RenderStyle, Severity, render};
use proptest::prelude::*;

use super::*;
use crate::{canonical, write_document};

fn read(text: &str) -> (Option<Document>, String) {
    let mut sources = SourceMap::new();
    let file = sources.add("file.xml", text);
    let mut diagnostics = Diagnostics::new();
    let document = parse(file, &sources, &mut diagnostics);
    let said = diagnostics.iter().map(|d| render(d, &sources, RenderStyle::Plain)).collect();
    (document, said)
}

fn check(text: &str, expected: Expect) {
    let (document, said) = read(text);
    let tree = document.map(|document| canonical(&document.root)).unwrap_or_default();
    expected.assert_eq(&format!("{tree}{said}"));
}

#[test]
fn elements_attributes_and_text() {
    check(
        "<?xml version='1.0'?><!--c--><a y='1' x=\"2&lt;\">t<b/>u<![CDATA[<v>]]></a>",
        expect![[r#"<a x="2&lt;" y="1">t<b></b>u&lt;v&gt;</a>"#]],
    );
}

/// Regression test, found by fuzzing: the reader leaves byte order marks out of its positions, so that every position was
/// three bytes too early, and the text of a faulty tag began inside of a mark.
#[test]
fn positions_count_byte_order_marks() {
    let text = "\u{feff}\n<a b>";
    let (_, said) = read(text);
    assert!(said.contains("file.xml:2:1"), "{said}");
    for marks in 0..4 {
        let text = format!("{}<a><b c='1'/></a>", "\u{feff}".repeat(marks));
        let (document, said) = read(&text);
        assert!(said.is_empty(), "{said}");
        let root = document.unwrap().root;
        let part = root.elements().next().unwrap();
        let span = part.origin.0.unwrap();
        assert_eq!(&text[span.start as usize..span.end as usize], "<b c='1'/>");
    }
}

#[test]
fn what_tinyxml_forgives_is_forgiven() {
    check(
        "<a><!-- -- --><gz:b c:d='R&D'/>x & y &nbsp;</a>",
        expect![[r#"
            <a><gz:b c:d="R&amp;D"></gz:b>x &amp; y &amp;nbsp;</a>warning[unknown-entity]: `&nbsp;` is not an entity
             --> file.xml:1:38
              |
            1 | <a><!-- -- --><gz:b c:d='R&D'/>x & y &nbsp;</a>
              |                                      ^^^^^^ kept as written
              |
              = help: write `&amp;` for an ampersand
        "#]],
    );
}

#[test]
fn a_wrong_end_names_both_places() {
    check(
        "<robot>\n<link>\n</robot>",
        expect![[r#"
            error[malformed-xml]: `</robot>` closes an element that is not open here
             --> file.xml:3:1
              |
            2 | <link>
              | ------ this element is still open
            3 | </robot>
              | ^^^^^^^^ `</link>` was expected
              |
              = help: write `</link>` before it, or remove it
        "#]],
    );
}

#[test]
fn a_file_that_ends_early_names_the_open_element() {
    check(
        "<robot>\n<link>",
        expect![[r#"
        error[malformed-xml]: the file ends, but `link` is still open
         --> file.xml:2:1
          |
        2 | <link>
          | ^^^^^^
          |
          = help: write `</link>` where it ends
    "#]],
    );
}

#[test]
fn the_end_of_a_comment_on_a_tag() {
    check(
        "<launch>\n  <remap from='/a' to='/b'/-->\n</launch>",
        expect![[r#"
        error[malformed-xml]: a tag does not end in `-->`, a comment does
         --> file.xml:2:27
          |
        2 |   <remap from='/a' to='/b'/-->
          |                           ^^^^
          |
        help: end the tag with `/>`, or put `<!--` before it
          |
        2 -   <remap from='/a' to='/b'/-->
        2 +   <remap from='/a' to='/b'/>
          |
    "#]],
    );
}

#[test]
fn an_attribute_given_twice() {
    check(
        "<a x='1' x='2'/>",
        expect![[r#"
            <a x="1"></a>error[malformed-xml]: the attribute `x` is given twice
             --> file.xml:1:10
              |
            1 | <a x='1' x='2'/>
              |    ----- ^^^^^
              |    |
              |    first given here
              |
              = help: keep one of them; the first is used
        "#]],
    );
}

#[test]
fn declared_entities_expand() {
    check(
        "<!DOCTYPE a [<!ENTITY r '0.1'><!ENTITY d '&r; &r;'>]><a r='&d;'>&r;</a>",
        expect![[r#"<a r="0.1 0.1">0.1</a>"#]],
    );
}

#[test]
fn an_entity_bomb_is_defused() {
    let mut text = String::from("<!DOCTYPE a [<!ENTITY e0 'ha'>");
    for level in 1..=12 {
        text += &format!("<!ENTITY e{level} '{}'>", format!("&e{};", level - 1).repeat(10));
    }
    check(
        &(text + "]>\n<a>&e12;</a>"),
        expect![[r#"
        error[entity-bomb]: `&e12;` expands to too much text, or to itself
         --> file.xml:2:4
          |
        2 | <a>&e12;</a>
          |    ^^^^^
          |
          = help: entities may bring in at most 1 MiB, 16 levels deep
    "#]],
    );
}

#[test]
fn files_are_not_read_by_entities() {
    check(
        "<!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><a>&x;</a>",
        expect![[r#"
        error[external-entity]: `&x;` refers to another file, which is not read
         --> file.xml:1:58
          |
        1 | <!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><a>&x;</a>
          |                                                          ^^^
          |
          = help: use <include> or <xacro:include>
    "#]],
    );
}

#[test]
fn ten_thousand_levels_are_too_deep() {
    let (document, said) = read(&"<a>".repeat(10_000));
    assert!(document.is_none());
    assert!(said.contains("nested deeper than 200 levels"), "{said}");
}

#[test]
fn spans_of_names_values_and_text() {
    let mut sources = SourceMap::new();
    let file = sources.add("a", "<a>\n <b k='v w'> text </b></a>");
    let document = parse(file, &sources, &mut Diagnostics::new()).unwrap();
    let b = document.root.child("b").unwrap();
    let text = |origin: Origin| sources.text(origin.0.unwrap());
    assert_eq!(text(b.origin), "<b k='v w'>");
    assert_eq!(text(b.name_origin()), "b");
    assert_eq!(text(b.attribute("k").unwrap().origin), "k='v w'");
    assert_eq!(text(b.attribute("k").unwrap().value_origin), "v w");
    assert_eq!(text(b.text_origin()), "text");
}

fn elements() -> impl Strategy<Value = Element> {
    let name = "[a-z]{1,5}";
    let leaf = (name, prop::collection::vec(("[a-z]{1,3}", "[ -~é]{0,8}"), 0..3), "[!-~é]{0,6}")
        .prop_map(|(name, mut attributes, text)| {
            attributes.sort();
            attributes.dedup_by(|a, b| a.0 == b.0);
            let mut element = Element::new(name);
            for (name, value) in attributes {
                element = element.with_attribute(&name, value);
            }
            if text.is_empty() { element } else { element.with_text(text) }
        });
    leaf.prop_recursive(4, 30, 4, |inner| {
        ("[a-z]{1,5}", prop::collection::vec(inner, 0..4)).prop_map(|(name, children)| {
            children.into_iter().fold(Element::new(name), Element::with_child)
        })
    })
}

proptest! {
    #[test]
    fn what_is_written_reads_back(root in elements()) {
        let document = Document { before: vec![], root, after: vec![] };
        let (read, said) = read(&write_document(&document));
        prop_assert_eq!(said, "");
        prop_assert_eq!(canonical(&read.unwrap().root), canonical(&document.root));
    }

    #[test]
    fn nothing_panics(text in "[<>/a-b='\"& ;!\\[\\]\\-?é#x0]{0,60}") {
        let _ = read(&text);
    }
}

/// An element of that many attributes and twice as many entities, ampersands and CDATA sections.
fn crowded(attributes: usize) -> String {
    let names = (0..attributes).map(|index| format!(" n{index}='&1'"));
    let last = attributes - 1;
    let text = "&amp;<![CDATA[b]]>&&nbsp;".repeat(attributes * 2);
    format!("<a{} n{last}='2'>{text}</a>", names.collect::<String>())
}

#[test]
fn many_attributes_and_entities_are_read_once() {
    let mut sources = SourceMap::new();
    let file = sources.add("a.xml", crowded(30_000));
    let mut diagnostics = Diagnostics::new();
    let document = parse(file, &sources, &mut diagnostics).expect("a document");
    assert_eq!(document.root.attributes.len(), 30_000);
    assert_eq!(document.root.children.len(), 1);
    assert_eq!(document.root.text().len(), 60_000 * "&b&&nbsp;".len());
    let codes = |code| diagnostics.iter().filter(|one| one.code == code).count();
    assert_eq!(codes("malformed-xml"), 1);
    // Findings that repeat are counted, and some are kept.
    assert_eq!(diagnostics.count(Severity::Warning), 60_000);
    assert!(codes("unknown-entity") <= periplus_diagnostics::MAX_FINDINGS);
}

#[test]
#[allow(clippy::disallowed_methods, reason = "this test measures time")]
fn many_attributes_and_entities_cost_linear_time() {
    let time = |attributes| {
        let text = crowded(attributes);
        let turn = |_| {
            let start = std::time::Instant::now();
            assert!(read_quietly(&text).is_some());
            start.elapsed()
        };
        (0..2).map(turn).min().unwrap_or_default()
    };
    let (few, many) = (time(2_000), time(40_000));
    // 20 times as many: not 400 times as long.
    assert!(many < few * 120 || many.as_millis() < 500, "{few:?} for 2,000, {many:?} for 40,000");
}

fn read_quietly(text: &str) -> Option<Document> {
    let mut sources = SourceMap::new();
    let file = sources.add("a.xml", text);
    parse(file, &sources, &mut Diagnostics::new())
}
