//! Errors that are strings in public signatures, and error codes compared as strings.

use super::{Check, Finding};
use crate::tidy::rust::Kind;
use crate::tidy::source::Rust;

/// Objections to `Result<_, String>` in public aliases and in the signatures of public functions and traits.
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
        if rust.is_ident(item_at, "fn") || rust.is_ident(item_at, "type") {
            findings.extend(string_error(rust, item_at));
        } else if rust.is_ident(item_at, "trait") {
            let open = (item_at..rust.tokens.len()).find(|&at| rust.is_punct(at, b'{'));
            let body = open.map_or(0..0, |open| open..rust.closers[open].min(rust.tokens.len()));
            let functions = body.filter(|&at| rust.is_ident(at, "fn"));
            findings.extend(functions.filter_map(|at| string_error(rust, at)));
        }
    }
    findings
}

/// Objection to the signature of a function or to an alias, whose `fn` or `type` is at an index.
fn string_error(rust: &Rust, item_at: usize) -> Option<Finding> {
    let mut end = item_at;
    while end < rust.tokens.len() && !rust.is_punct(end, b'{') && !rust.is_punct(end, b';') {
        // The `;` of an array's type is not an end.
        end = rust.closers[end] + 1;
    }
    let end = end.min(rust.tokens.len());
    let result = (item_at..end).find(|&at| {
        let open = at + 1;
        if !rust.is_ident(at, "Result") || !rust.is_punct(open, b'<') {
            return false;
        }
        let close = rust.generics_end(open).saturating_sub(1);
        rust.is_ident(close.saturating_sub(1), "String")
            && rust.is_punct(close.saturating_sub(2), b',')
    })?;
    let close = rust.generics_end(result + 1);
    let name = rust.text(item_at + 1);
    let range = rust.tokens[item_at + 1].range.clone();
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
/// and with constants; and to searches in the text of an error: `error.message.contains("x")`. A finding has the name of the constant as its entry: only texts count, see
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
    let objection = |at: usize, entry: String, text: String| Finding {
        check: Check::Codes,
        entry,
        range: rust.tokens[at].range.clone(),
        text,
        advice: "an enum, or a method such as `is_missing_parameter()`".to_owned(),
    };
    for at in (1..rust.tokens.len()).filter(|&at| !rust.is_test[at] && rust.is_punct(at - 1, b'.'))
    {
        let searches = ["contains", "starts_with", "ends_with"];
        let is_search = searches.iter().any(|name| rust.is_ident(at, name))
            && rust.is_punct(at + 1, b'(')
            && is_literal(at + 2);
        if is_search && is_error_text(rust, at - 1) {
            let text = format!("error searched for \"{}\"", rust.text(at + 2));
            findings.push(objection(at, String::new(), text));
        }
        if !rust.is_ident(at, "code") {
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
        findings.push(objection(at, entry, text));
    }
    findings
}

/// True where the `.` at an index follows the text of an error: `message`, `reason()`,
/// `error.to_string()`.
fn is_error_text(rust: &Rust, dot: usize) -> bool {
    let is_named = |at: Option<usize>, names: &[&str]| {
        at.is_some_and(|at| names.iter().any(|name| rust.is_ident(at, name)))
    };
    let texts = ["code", "message", "reason"];
    let before = |count: usize| dot.checked_sub(count);
    let is_call =
        before(2).is_some_and(|at| rust.is_punct(at, b'(') && rust.is_punct(at + 1, b')'));
    if !is_call {
        return is_named(before(1), &texts);
    }
    is_named(before(3), &texts)
        || (is_named(before(3), &["to_string"])
            && is_named(before(5), &["error", "why", "err", "fault"]))
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
                    pub fn i(x: [f64; 3]) -> Result<(), String> {} pub type J = Result<u8, String>;\
                    pub fn d() -> Result<String, Error> { e::<Result<u8, String>>() }\
                    pub trait T { fn f() -> Result<(), String>; fn g() -> Result<String>; }\
                    impl T { fn f() -> Result<(), String> {} pub fn h() -> io::Result<String> {} }";
        let file = made_up("crates/a/src/lib.rs", text);
        assert_eq!(
            texts(check_signatures(&Rust::new(&file))),
            [
                "a -> Result<u8,String>",
                "c -> Result<Vec<(u8,u8)>,String>",
                "i -> Result<(),String>",
                "J -> Result<u8,String>",
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
                    match a.code { \"b\" => 1, _ => 2 }; if a.code == Code::B {} #[test] fn t() { a.code == \"b\"; }\
                    a.message.contains(\"c\"); error.to_string().ends_with(\"d\"); a.starts_with(\"e\");\
                    path.to_string().contains(\"f\");";
        let file = made_up("crates/a/src/lib.rs", text);
        assert_eq!(
            texts(check_codes(&Rust::new(&file))),
            [
                "code compared with \"b\"",
                "code compared with CODE",
                "match on a code",
                "error searched for \"c\"",
                "error searched for \"d\""
            ]
        );
    }
}
