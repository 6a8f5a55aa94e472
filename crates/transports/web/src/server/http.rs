//! Requests and responses: headers, queries, plain-text answers.

use std::borrow::Cow;

use http_body_util::Full;
use hyper::body::Bytes;
use hyper::header::{CONNECTION, CONTENT_TYPE, HeaderName, HeaderValue, UPGRADE};
use hyper::{HeaderMap, Response, StatusCode, Uri};

/// A response; its body is in memory.
pub(crate) type Answer = Response<Full<Bytes>>;

/// Response with this status, without headers and body.
pub(crate) fn empty(status: StatusCode) -> Answer {
    let mut answer = Answer::default();
    *answer.status_mut() = status;
    answer
}

/// Plain-text response.
pub(crate) fn plain_text(status: StatusCode, text: &str) -> Answer {
    let mut answer = Answer::new(Full::from(format!("{text}\n")));
    *answer.status_mut() = status;
    let kind = HeaderValue::from_static("text/plain; charset=utf-8");
    answer.headers_mut().insert(CONTENT_TYPE, kind);
    answer
}

/// All values of a header. Bytes that are not UTF-8 are replaced, so that no value is skipped.
pub(crate) fn values(headers: &HeaderMap, name: HeaderName) -> impl Iterator<Item = Cow<'_, str>> {
    headers.get_all(name).into_iter().map(|value| {
        let text = String::from_utf8_lossy(value.as_bytes());
        let trimmed = text.trim();
        if trimmed.len() == text.len() { text } else { Cow::Owned(trimmed.to_owned()) }
    })
}

/// First value of a header.
pub(crate) fn value(headers: &HeaderMap, name: HeaderName) -> Option<Cow<'_, str>> {
    values(headers, name).next()
}

/// True if a list header contains a word.
pub(crate) fn lists(headers: &HeaderMap, name: HeaderName, word: &str) -> bool {
    values(headers, name).any(|value| {
        let mut words = value.split(',').map(|one| one.split(';').next().unwrap_or_default());
        words.any(|one| one.trim().eq_ignore_ascii_case(word))
    })
}

/// Value of a query parameter, not decoded.
pub(crate) fn query<'a>(uri: &'a Uri, name: &str) -> Option<&'a str> {
    let mut parts = uri.query()?.split('&');
    parts.find_map(|part| part.strip_prefix(name)?.strip_prefix('='))
}

/// True if the request asks for a WebSocket upgrade.
pub(crate) fn is_upgrade(headers: &HeaderMap) -> bool {
    lists(headers, UPGRADE, "websocket") && lists(headers, CONNECTION, "upgrade")
}

#[cfg(test)]
mod tests {
    use hyper::Request;
    use hyper::header::ACCEPT_ENCODING;

    use super::*;

    #[test]
    fn headers_and_queries_are_found() {
        let request = Request::get("/a?b=1&token=x")
            .header("Connection", "keep-alive, Upgrade")
            .header("Upgrade", "WebSocket")
            .header("Accept-Encoding", "gzip")
            .header("Accept-Encoding", "deflate;q=0.5 , br;q=0.9")
            .body(())
            .expect("a request");
        let (uri, headers) = (request.uri(), request.headers());
        assert_eq!(
            (query(uri, "token"), query(uri, "b"), query(uri, "c")),
            (Some("x"), Some("1"), None)
        );
        assert!(is_upgrade(headers));
        assert!(lists(headers, ACCEPT_ENCODING, "br") && !lists(headers, ACCEPT_ENCODING, "b"));
        assert_eq!(values(headers, ACCEPT_ENCODING).count(), 2);
    }

    #[test]
    fn bytes_that_are_not_text_are_not_skipped() {
        let mut headers = HeaderMap::new();
        let odd = HeaderValue::from_bytes(b"localhost\xff").expect("a value");
        headers.insert("host", odd);
        assert_eq!(value(&headers, hyper::header::HOST).as_deref(), Some("localhost\u{fffd}"));
    }
}
