//! Errors that are strings in public signatures, and error codes compared as strings.

use super::{Check, Finding};
use crate::tidy::rust::Kind;
use crate::tidy::source::Rust;

/// Objections to `Result<_, String>` in the signatures of public functions and public traits.
pub(crate) fn check_signatures(rust: &Rust) -> Vec<Finding> {
    if rust.file.is_tool() {
        return Vec::new();
    }
    let mut findings = Vec::new();
    for at in (0..rust.tokens.len()).filter(|&at| !rust.is_test[at] && rust.is_ident(at, "pub")) {
        let qualifiers = ["const", "async", "unsafe", "extern"];
        let is_qualifier = |at: &usize| {
            let is_abi = matches!(rust.tokens.get(*at), Some(token) if matches!(token.kind, Kind::Text { .. }));
            is_abi || qualifiers.iter().any(|word| rust.is_ident(*at, word))
        };
        let item_at = at + 1 + (at + 1..).take_while(is_qualifier).count();
        if rust.is_ident(item_at, "fn") {
            findings.extend(signature(rust, item_at));
        } else if rust.is_ident(item_at, "trait") {
            let open = (item_at..rust.tokens.len()).find(|&at| rust.is_punct(at, b'{'));
            let body = open.map_or(0..0, |open| open..rust.closers[open].min(rust.tokens.len()));
            let functions = body.filter(|&at| rust.is_ident(at, "fn"));
            findings.extend(functions.filter_map(|at| signature(rust, at)));
        }
    }
    findings
}

/// Objection to the signature of a function whose `fn` is at an index.
fn signature(rust: &Rust, fn_at: usize) -> Option<Finding> {
    let ends = |at: &usize| rust.is_punct(*at, b'{') || rust.is_punct(*at, b';');
    let end = (fn_at..rust.tokens.len()).find(ends).unwrap_or(rust.tokens.len());
    let result = (fn_at..end).find(|&at| {
        let open = at + 1;
        if !rust.is_ident(at, "Result") || !rust.is_punct(open, b'<') {
            return false;
        }
        let close = rust.generics_end(open).saturating_sub(1);
        rust.is_ident(close.saturating_sub(1), "String")
            && rust.is_punct(close.saturating_sub(2), b',')
    })?;
    let close = rust.generics_end(result + 1);
    let name = rust.text(fn_at + 1);
    let range = rust.tokens[fn_at + 1].range.clone();
    let text: String = (result..close).map(|at| rust.text(at)).collect();
    let advice = "an enum of errors with `Display`, so that callers can match on it".to_owned();
    let text = format!("{name} -> {text}");
    Some(Finding { check: Check::Results, entry: String::new(), range, text, advice })
}

/// Names of constants that are texts.
pub(crate) fn text_constants<'a>(rust: &'a Rust) -> impl Iterator<Item = &'a str> {
    (0..rust.tokens.len())
        .filter(|&at| rust.is_ident(at, "const") && rust.is_punct(at + 2, b':'))
        .filter(|&at| (at + 3..at + 6).any(|at| rust.is_ident(at, "str")))
        .map(|at| rust.text(at + 1))
}

/// Objections to comparisons of error codes with texts: `it.code == "x"`, `match it.code { "x" => .. }`,
/// and with constants. A finding has the name of the constant as its entry: only texts count, see
/// [`text_constants`].
pub(crate) fn check_codes(rust: &Rust) -> Vec<Finding> {
    let kind = |at: usize| rust.tokens.get(at).map(|token| token.kind);
    let is_literal = |at: usize| matches!(kind(at), Some(Kind::Text { .. }));
    let is_constant = |at: usize| {
        let name = rust.text(at);
        let is_upper =
            |byte: u8| byte.is_ascii_uppercase() || byte.is_ascii_digit() || byte == b'_';
        kind(at) == Some(Kind::Ident) && name.len() > 1 && name.bytes().all(is_upper)
    };
    let mut findings = Vec::new();
    for at in (0..rust.tokens.len()).filter(|&at| !rust.is_test[at] && rust.is_ident(at, "code")) {
        if at == 0 || !rust.is_punct(at - 1, b'.') {
            continue;
        }
        let is_call = rust.is_punct(at + 1, b'(') && rust.is_punct(at + 2, b')');
        let next = if is_call { at + 3 } else { at + 1 };
        let is_comparison = (rust.is_punct(next, b'=') || rust.is_punct(next, b'!'))
            && rust.is_punct(next + 1, b'=');
        let (entry, text) = if is_comparison && is_literal(next + 2) {
            (String::new(), format!("code compared with \"{}\"", rust.text(next + 2)))
        } else if is_comparison && is_constant(next + 2) {
            let name = rust.text(next + 2);
            (name.to_owned(), format!("code compared with {name}"))
        } else if rust.is_punct(next, b'{') && is_literal(next + 1) {
            (String::new(), "match on a code".to_owned())
        } else {
            continue;
        };
        findings.push(Finding {
            check: Check::Codes,
            entry,
            range: rust.tokens[at].range.clone(),
            text,
            advice: "an enum, or a method such as `is_missing_parameter()`".to_owned(),
        });
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tidy::source::made_up;

    fn texts(findings: Vec<Finding>) -> Vec<String> {
        findings.into_iter().map(|finding| finding.text).collect()
    }

    #[test]
    fn strings_as_errors_in_public_signatures() {
        let text = "pub fn a() -> Result<u8, String> {} pub(crate) fn b() -> Result<u8, String> {}\
                    pub async fn c(f: &dyn Fn(u8) -> Result<Vec<(u8, u8)>, String>) {}\
                    pub fn d() -> Result<String, Error> { e::<Result<u8, String>>() }\
                    pub trait T { fn f() -> Result<(), String>; fn g() -> Result<String>; }\
                    impl T { fn f() -> Result<(), String> {} pub fn h() -> io::Result<String> {} }";
        let file = made_up("crates/a/src/lib.rs", text);
        assert_eq!(
            texts(check_signatures(&Rust::new(&file))),
            [
                "a -> Result<u8,String>",
                "c -> Result<Vec<(u8,u8)>,String>",
                "f -> Result<(),String>",
            ]
        );
    }

    #[test]
    fn constants_that_are_texts() {
        let text = "pub const A: &str = \"a\"; const B: &'static str = \"b\"; const C: i32 = 1;";
        let file = made_up("crates/a/src/lib.rs", text);
        assert_eq!(text_constants(&Rust::new(&file)).collect::<Vec<_>>(), ["A", "B"]);
    }

    #[test]
    fn codes_compared_as_strings() {
        let text = "a.code == \"b\"; a.code() != CODE; a.code == b.code; a.code == 0; if code == \"b\" {}\
                    match a.code { \"b\" => 1, _ => 2 }; if a.code == Code::B {} #[test] fn t() { a.code == \"b\"; }";
        let file = made_up("crates/a/src/lib.rs", text);
        assert_eq!(
            texts(check_codes(&Rust::new(&file))),
            ["code compared with \"b\"", "code compared with CODE", "match on a code",]
        );
    }
}
