//! JSON form of values that JSON does not have: XML as text, infinities as `null` (by `serde_json`).

use periplus_xml::{Element, write_element};
use serde::Serializer;

pub(crate) fn elements<S: Serializer>(elements: &[Element], out: S) -> Result<S::Ok, S::Error> {
    out.collect_seq(elements.iter().map(text))
}

pub(crate) fn element<S: Serializer>(element: &Element, out: S) -> Result<S::Ok, S::Error> {
    out.serialize_str(&text(element))
}

pub(crate) fn optional_element<S: Serializer>(
    element: &Option<Element>,
    out: S,
) -> Result<S::Ok, S::Error> {
    match element {
        Some(element) => out.serialize_some(&text(element)),
        None => out.serialize_none(),
    }
}

fn text(element: &Element) -> String {
    let mut text = write_element(element);
    text.truncate(text.trim_end().len());
    text
}
