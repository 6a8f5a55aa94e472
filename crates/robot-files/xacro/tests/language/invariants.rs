//! Properties of every document.

use periplus_xml::{Document, Element, canonical, write_document};
use proptest::prelude::*;

use crate::example::{example, whole};

/// Elements without xacro syntax.
fn plain_element() -> impl Strategy<Value = Element> {
    let name = "[a-z][a-z0-9_]{0,4}";
    let value = "[ -#%-~é]{0,8}";
    let attributes = prop::collection::btree_map(name, value, 0..3);
    let leaf = (name, attributes.clone(), value).prop_map(|(name, attributes, text)| {
        let element = Element::new(name).with_text(text);
        attributes
            .iter()
            .fold(element, |element, (name, value)| element.with_attribute(name, value))
    });
    leaf.prop_recursive(4, 24, 4, move |inner| {
        (name, attributes.clone(), prop::collection::vec(inner, 0..4)).prop_map(
            |(name, attributes, children)| {
                let mut element = Element::new(name);
                for (name, value) in &attributes {
                    element = element.with_attribute(name, value);
                }
                children.into_iter().fold(element, Element::with_child)
            },
        )
    })
}

fn text_of(root: Element) -> String {
    write_document(&Document { before: Vec::new(), root, after: Vec::new() })
}

fn expanded(text: &str) -> Element {
    whole(text).run().0.expect("it expands").document.root
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_document_without_xacro_stays_as_it_is(root in plain_element()) {
        let text = text_of(root);
        let mut sources = periplus_diagnostics::SourceMap::new();
        let file = sources.add("main", text.clone());
        let read = periplus_xml::parse(file, &sources, &mut periplus_diagnostics::Diagnostics::new()).unwrap();
        prop_assert_eq!(expanded(&text), read.root);
    }

    #[test]
    fn expanding_again_changes_nothing(
        root in plain_element(), count in 0_i32..4, radius in -9.0_f64..9.0,
    ) {
        let body = periplus_xml::write_element(&root);
        let text = format!(
            r#"<r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="radius" value="{radius}"/>
            <xacro:macro name="m" params="n *b"><a v="${{radius * n}}"><xacro:insert_block name="b"/></a>
            <xacro:if value="${{n}}"><xacro:m n="${{n - 1}}"><c/></xacro:m></xacro:if></xacro:macro>
            <xacro:m n="{count}">{body}</xacro:m></r>"#
        );
        let once = expanded(&text);
        let twice = expanded(&text_of(once.clone()));
        prop_assert_eq!(canonical(&once), canonical(&twice));
    }

    #[test]
    fn the_order_of_a_calls_arguments_does_not_matter(order in Just(vec![0, 1, 2, 3]).prop_shuffle()) {
        let arguments = [r#"a="${1 + 1}""#, r#"b="x y""#, r#"c="true""#, r#"d="'7'""#];
        let call = |order: &[usize]| {
            let given: Vec<&str> = order.iter().map(|&index| arguments[index]).collect();
            let text = format!(
                r#"<xacro:macro name="m" params="a b c d e:=${{1}}"><x v="${{a}} ${{b}} ${{c}} ${{d}} ${{e}}"/></xacro:macro><xacro:m {}/>"#,
                given.join(" ")
            );
            canonical(&example(&text).run().0.expect("it expands").document.root)
        };
        prop_assert_eq!(call(&order), call(&[0, 1, 2, 3]));
    }

    /// For any text the result is a document or errors, all with source locations.
    #[test]
    fn any_text_is_answered(text in "(\\$|\\{|\\}|\\(|\\)|'|eval |arg |find |a|[+.1 ]|é){0,20}") {
        let (result, diagnostics, _) = example(&format!(
            r#"<xacro:property name="a" value="{text}"/><x v="${{a}}">{text}</x>"#
        )).run();
        prop_assert_eq!(result.is_none(), diagnostics.has_errors());
        prop_assert!(diagnostics.iter().all(|found| found.span.is_some()));
    }
}
