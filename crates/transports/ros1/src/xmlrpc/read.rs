//! Reader of requests and responses.

use std::collections::BTreeMap;
use std::fmt;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_xml::{Element, XmlNode};

use super::write::is_forbidden;
use super::{RpcCall, RpcFault, XmlRpcValue};

/// A text that is no request, or no response, of XML-RPC.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MalformedXmlRpc(pub String);

impl fmt::Display for MalformedXmlRpc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "malformed XML-RPC: {}", self.0)
    }
}

impl std::error::Error for MalformedXmlRpc {}

/// Reads a request.
///
/// # Errors
/// When the text is not one.
pub fn read_call(body: &[u8]) -> Result<RpcCall, MalformedXmlRpc> {
    let root = parse(body)?;
    if root.name != "methodCall" {
        return Err(unexpected(&root, "methodCall"));
    }
    let method = characters(child(&root, "methodName")?).trim().to_owned();
    let params = match root.child("params") {
        Some(params) => values(params)?,
        None => Vec::new(),
    };
    Ok(RpcCall { method, params })
}

/// Reads a response.
///
/// # Errors
/// When the text is not one.
pub fn read_response(body: &[u8]) -> Result<Result<XmlRpcValue, RpcFault>, MalformedXmlRpc> {
    let root = parse(body)?;
    if root.name != "methodResponse" {
        return Err(unexpected(&root, "methodResponse"));
    }
    if let Some(fault) = root.child("fault") {
        let XmlRpcValue::Struct(members) = value(child(fault, "value")?)? else {
            return Err(MalformedXmlRpc("the fault has no members".into()));
        };
        let code = members.get("faultCode").and_then(XmlRpcValue::int).unwrap_or_default();
        let text =
            members.get("faultString").and_then(XmlRpcValue::text).unwrap_or_default().to_owned();
        return Ok(Err(RpcFault { code, text }));
    }
    let value = values(child(&root, "params")?)?.into_iter().next();
    value.map(Ok).ok_or_else(|| MalformedXmlRpc("the response has no value".into()))
}

fn parse(body: &[u8]) -> Result<Element, MalformedXmlRpc> {
    let text = periplus_xml::decode(body).map_err(|error| MalformedXmlRpc(error.to_string()))?;
    let mut sources = SourceMap::new();
    let file = sources.add("message", text);
    let mut findings = Diagnostics::new();
    let document = periplus_xml::parse(file, &sources, &mut findings);
    document.map(|document| document.root).ok_or_else(|| {
        let first = findings.iter().next().map(|finding| finding.message.clone());
        MalformedXmlRpc(first.unwrap_or_else(|| "no XML".into()))
    })
}

fn child<'a>(element: &'a Element, name: &str) -> Result<&'a Element, MalformedXmlRpc> {
    let missing = || MalformedXmlRpc(format!("<{}> has no <{name}>", element.name));
    element.elements().find(|one| one.name == name).ok_or_else(missing)
}

fn unexpected(element: &Element, wanted: &str) -> MalformedXmlRpc {
    MalformedXmlRpc(format!("<{}> in place of <{wanted}>", element.name))
}

/// Values of `<params>`.
fn values(params: &Element) -> Result<Vec<XmlRpcValue>, MalformedXmlRpc> {
    params.named("param").map(|param| value(child(param, "value")?)).collect()
}

fn value(element: &Element) -> Result<XmlRpcValue, MalformedXmlRpc> {
    let Some(typed) = element.elements().next() else {
        return Ok(XmlRpcValue::Text(characters(element)));
    };
    let text = characters(typed);
    let wrong = || MalformedXmlRpc(format!("`{}` is no {}", shortened(&text), typed.name));
    Ok(match typed.name.as_str() {
        "i4" | "int" => XmlRpcValue::Int(text.trim().parse().map_err(|_| wrong())?),
        "boolean" => match text.trim() {
            "0" => XmlRpcValue::Bool(false),
            "1" => XmlRpcValue::Bool(true),
            _ => return Err(wrong()),
        },
        "string" => XmlRpcValue::Text(text),
        "double" => XmlRpcValue::Double(text.trim().parse().map_err(|_| wrong())?),
        "dateTime.iso8601" => XmlRpcValue::Time(text.trim().to_owned()),
        "base64" => {
            let digits: Vec<u8> = text.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect();
            XmlRpcValue::Binary(STANDARD.decode(digits).map_err(|_| wrong())?)
        }
        "array" => {
            let data = child(typed, "data")?;
            XmlRpcValue::List(data.named("value").map(value).collect::<Result<_, _>>()?)
        }
        "struct" => {
            let mut members = BTreeMap::new();
            for member in typed.named("member") {
                let name = characters(child(member, "name")?);
                members.insert(name, value(child(member, "value")?)?);
            }
            XmlRpcValue::Struct(members)
        }
        // Python's writer has it for `None`, which ROS 1 does not use.
        "nil" => return Err(MalformedXmlRpc("ROS 1 has no value <nil>".into())),
        other => return Err(MalformedXmlRpc(format!("the type <{other}> is unknown"))),
    })
}

/// All characters of an element, with the white space around them. Those that XML forbids are left out, as in what is
/// written.
fn characters(element: &Element) -> String {
    let texts = element.children.iter().filter_map(|node| match node {
        XmlNode::Text(text) => Some(text.text.as_str()),
        _ => None,
    });
    texts.flat_map(str::chars).filter(|character| !is_forbidden(*character)).collect()
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((at, _)) => format!("{}...", &text[..at]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{write_call, write_fault, write_response};
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(written: &str, expected: XmlRpcValue) {
        let body = format!(
            "<?xml version='1.0'?><methodResponse><params><param><value>{written}</value></param>\
             </params></methodResponse>"
        );
        assert_eq!(read_response(body.as_bytes()), Ok(Ok(expected)));
    }

    #[test]
    fn every_type_is_read() {
        check("<i4>-7</i4>", XmlRpcValue::Int(-7));
        check("<int> 7 </int>", XmlRpcValue::Int(7));
        check("<boolean>1</boolean>", XmlRpcValue::Bool(true));
        check("plain &lt; text", XmlRpcValue::from("plain < text"));
        check("<string> kept </string>", XmlRpcValue::from(" kept "));
        check("<string></string>", XmlRpcValue::from(""));
        check("", XmlRpcValue::from(""));
        check("<double>-1.5</double>", XmlRpcValue::Double(-1.5));
        check("<base64>AQID\n</base64>", XmlRpcValue::Binary(vec![1, 2, 3]));
        check(
            "<array><data><value><i4>1</i4></value><value>b</value></data></array>",
            XmlRpcValue::List(vec![XmlRpcValue::Int(1), XmlRpcValue::from("b")]),
        );
        check(
            "<struct><member><name>a</name><value><i4>1</i4></value></member></struct>",
            XmlRpcValue::Struct([("a".to_owned(), XmlRpcValue::Int(1))].into()),
        );
    }

    #[test]
    fn what_is_wrong_is_named() {
        let error = |body: &str| read_call(body.as_bytes()).unwrap_err().0;
        assert_eq!(error("<methodResponse/>"), "<methodResponse> in place of <methodCall>");
        assert_eq!(error("<methodCall/>"), "<methodCall> has no <methodName>");
        let call = |value: &str| {
            format!(
                "<methodCall><methodName>m</methodName><params><param><value>{value}</value>\
                 </param></params></methodCall>"
            )
        };
        assert_eq!(error(&call("<int>x</int>")), "`x` is no int");
        assert_eq!(error(&call("<colour>1</colour>")), "the type <colour> is unknown");
        let deep = "<value><array><data>".repeat(300);
        assert!(error(&call(&deep)).contains("deeper"));
    }

    /// Regression test, found by fuzzing: a control character kept the space before it, which was trimmed when the name
    /// was written without the one and read again.
    #[test]
    fn characters_that_xml_forbids_are_left_out_before_trimming() {
        let body = "<methodCall><methodName>get \u{1} \u{c}</methodName></methodCall>";
        let call = read_call(body.as_bytes()).unwrap();
        assert_eq!(call.method, "get");
        assert_eq!(read_call(write_call(&call).as_bytes()), Ok(call));
        check("<dateTime.iso8601>2026 \u{1}</dateTime.iso8601>", XmlRpcValue::Time("2026".into()));
    }

    #[test]
    fn a_fault_is_an_error() {
        let fault = RpcFault { code: -1, text: "no <such> method".into() };
        assert_eq!(read_response(write_fault(&fault).as_bytes()), Ok(Err(fault)));
    }

    fn any_value() -> impl Strategy<Value = XmlRpcValue> {
        let leaf = prop_oneof![
            any::<i32>().prop_map(XmlRpcValue::Int),
            any::<bool>().prop_map(XmlRpcValue::Bool),
            "[ -~\n\u{e4}]{0,20}".prop_map(XmlRpcValue::Text),
            (-1e12..1e12).prop_map(XmlRpcValue::Double),
            proptest::collection::vec(any::<u8>(), 0..20).prop_map(XmlRpcValue::Binary),
        ];
        leaf.prop_recursive(4, 40, 6, |inner| {
            prop_oneof![
                proptest::collection::vec(inner.clone(), 0..6).prop_map(XmlRpcValue::List),
                proptest::collection::btree_map("[a-z]{1,6}", inner, 0..6)
                    .prop_map(XmlRpcValue::Struct),
            ]
        })
    }

    proptest! {
        #[test]
        fn what_is_written_is_read_again(params in proptest::collection::vec(any_value(), 0..4)) {
            let call = RpcCall { method: "setParam".into(), params };
            prop_assert_eq!(read_call(write_call(&call).as_bytes()), Ok(call.clone()));
            for value in call.params {
                let body = write_response(&value);
                prop_assert_eq!(read_response(body.as_bytes()), Ok(Ok(value)));
            }
        }

        #[test]
        fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            let _ = read_call(&bytes);
            let _ = read_response(&bytes);
        }
    }
}
