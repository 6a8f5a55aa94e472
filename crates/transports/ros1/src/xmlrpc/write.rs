//! Writer of requests and responses.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::{RpcCall, RpcFault, XmlRpcValue};

const FRONT: &str = "<?xml version=\"1.0\"?>\n";

/// Text of a request.
#[must_use]
pub fn write_call(call: &RpcCall) -> String {
    let mut out = format!("{FRONT}<methodCall><methodName>");
    escape(&mut out, &call.method);
    out.push_str("</methodName><params>");
    for param in &call.params {
        out.push_str("<param>");
        value(&mut out, param);
        out.push_str("</param>");
    }
    out.push_str("</params></methodCall>\n");
    out
}

/// Text of a response.
#[must_use]
pub fn write_response(result: &XmlRpcValue) -> String {
    let mut out = format!("{FRONT}<methodResponse><params><param>");
    value(&mut out, result);
    out.push_str("</param></params></methodResponse>\n");
    out
}

/// Text of a response that is a fault.
#[must_use]
pub fn write_fault(fault: &RpcFault) -> String {
    let members = [
        ("faultCode".to_owned(), XmlRpcValue::Int(fault.code)),
        ("faultString".to_owned(), XmlRpcValue::Text(fault.text.clone())),
    ];
    let mut out = format!("{FRONT}<methodResponse><fault>");
    value(&mut out, &XmlRpcValue::Struct(members.into()));
    out.push_str("</fault></methodResponse>\n");
    out
}

fn value(out: &mut String, one: &XmlRpcValue) {
    out.push_str("<value>");
    match one {
        XmlRpcValue::Int(int) => _ = write!(out, "<i4>{int}</i4>"),
        XmlRpcValue::Bool(is_true) => _ = write!(out, "<boolean>{}</boolean>", u8::from(*is_true)),
        XmlRpcValue::Text(text) => {
            out.push_str("<string>");
            escape(out, text);
            out.push_str("</string>");
        }
        // Without an exponent, which XML-RPC does not have.
        XmlRpcValue::Double(number) => _ = write!(out, "<double>{number}</double>"),
        XmlRpcValue::Time(time) => {
            out.push_str("<dateTime.iso8601>");
            escape(out, time);
            out.push_str("</dateTime.iso8601>");
        }
        XmlRpcValue::Binary(bytes) => {
            out.push_str("<base64>");
            out.push_str(&STANDARD.encode(bytes));
            out.push_str("</base64>");
        }
        XmlRpcValue::List(list) => {
            out.push_str("<array><data>");
            list.iter().for_each(|one| value(out, one));
            out.push_str("</data></array>");
        }
        XmlRpcValue::Struct(members) => {
            out.push_str("<struct>");
            for (name, member) in members {
                out.push_str("<member><name>");
                escape(out, name);
                out.push_str("</name>");
                value(out, member);
                out.push_str("</member>");
            }
            out.push_str("</struct>");
        }
    }
    out.push_str("</value>");
}

/// True if XML has no such character, not even as a number.
pub(super) fn is_forbidden(character: char) -> bool {
    matches!(character, '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
        && !matches!(character, '\t' | '\n' | '\r')
}

/// Appends characters. Those that XML forbids are left out: no reader would accept them.
fn escape(out: &mut String, text: &str) {
    for character in text.chars().filter(|character| !is_forbidden(*character)) {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '\r' => out.push_str("&#13;"),
            _ => out.push(character),
        }
    }
}
