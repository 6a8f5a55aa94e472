//! Files of the viewer page, included in the program.

use std::io::Read as _;

use http_body_util::Full;
use hyper::body::Bytes;
use hyper::header::{
    ACCEPT_ENCODING, CACHE_CONTROL, CONTENT_ENCODING, CONTENT_SECURITY_POLICY, CONTENT_TYPE, ETAG,
    HeaderValue, IF_NONE_MATCH, REFERRER_POLICY, VARY, X_CONTENT_TYPE_OPTIONS,
};
use hyper::{HeaderMap, StatusCode};
use sha2::{Digest as _, Sha256};

use crate::server::http::{Answer, empty, lists, plain_text, values};

/// Every file of `page/` by its path. A file that ends in `.br` is compressed, and is requested
/// without that suffix.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// Returns the number of files of the page in this program, and their size \[bytes\].
#[must_use]
pub fn embedded_page() -> (usize, usize) {
    (FILES.len(), FILES.iter().map(|(_, bytes)| bytes.len()).sum())
}

/// Page shown if the viewer was not built.
const UNBUILT: &str = "<!doctype html><meta charset=utf-8><title>Periplus</title>\
    <body style=\"font:16px/1.5 system-ui;max-width:40em;margin:4em auto;padding:0 1em\">\
    <h1>This Periplus has no page in it</h1>\
    <p>It was built from sources in which the page was not: run <code>cargo xtask viewer</code>, then \
    build again. Everything that the page shows is available without it: connect Lichtblick or Foxglove to \
    <code>ws://127.0.0.1:8765</code>.";

/// Content security policy: only content from this server, and images and workers created by the
/// page.
const POLICY: &str = "default-src 'self'; connect-src 'self' blob: data:; \
    img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; font-src 'self' data:; \
    script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; frame-ancestors 'self'";

/// Response to a request for a file.
pub(crate) fn answer(path: &str, headers: &HeaderMap) -> Answer {
    answer_from(FILES, path, headers)
}

fn answer_from(files: &[(&str, &'static [u8])], path: &str, headers: &HeaderMap) -> Answer {
    let path = path.trim_start_matches('/');
    let path = if path.is_empty() { "index.html" } else { path };
    let find = |name: &str| files.iter().find(|(own, _)| *own == name).map(|(_, bytes)| *bytes);
    let packed = find(&format!("{path}.br"));
    let Some(bytes) = packed.or_else(|| find(path)) else {
        if path == "index.html" {
            return page(Bytes::from_static(UNBUILT.as_bytes()), "index.html");
        }
        let why = "there is no such file; the page is at /";
        return plain_text(StatusCode::NOT_FOUND, why);
    };
    let tag = tag(bytes);
    let mut answer = if values(headers, IF_NONE_MATCH).any(|known| known.contains(&tag)) {
        empty(StatusCode::NOT_MODIFIED)
    } else if packed.is_none() {
        page(Bytes::from_static(bytes), path)
    } else if lists(headers, ACCEPT_ENCODING, "br") {
        let mut answer = page(Bytes::from_static(bytes), path);
        answer.headers_mut().insert(CONTENT_ENCODING, HeaderValue::from_static("br"));
        answer
    } else {
        page(unpack(bytes).into(), path)
    };
    let own = answer.headers_mut();
    if let Ok(tag) = HeaderValue::from_str(&format!("\"{tag}\"")) {
        own.insert(ETAG, tag);
    }
    own.insert(VARY, HeaderValue::from_static("Accept-Encoding"));
    // Files below `assets` have the hash of their content in their names.
    let keep = if path.starts_with("assets/") { "max-age=31536000, immutable" } else { "no-cache" };
    own.insert(CACHE_CONTROL, HeaderValue::from_static(keep));
    answer
}

fn page(body: Bytes, path: &str) -> Answer {
    let mut answer = Answer::new(Full::new(body));
    for (name, value) in [
        (CONTENT_TYPE, kind_of(path)),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (CONTENT_SECURITY_POLICY, POLICY),
        (REFERRER_POLICY, "no-referrer"),
    ] {
        answer.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    answer
}

/// For clients without Brotli: browsers accept it from this machine or over TLS only.
fn unpack(bytes: &[u8]) -> Vec<u8> {
    let mut unpacked = Vec::new();
    let _ = brotli_decompressor::Decompressor::new(bytes, 4096).read_to_end(&mut unpacked);
    unpacked
}

fn tag(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().take(12).map(|byte| format!("{byte:02x}")).collect()
}

fn kind_of(path: &str) -> &'static str {
    match path.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" | "map" => "application/json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "ico" => "image/x-icon",
        "wasm" => "application/wasm",
        "woff2" => "font/woff2",
        "webmanifest" => "application/manifest+json",
        "txt" | "md" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use std::pin::Pin;
    use std::task::{Context, Poll, Waker};

    use hyper::body::Body as _;

    use super::*;

    /// "periplus\n" in one uncompressed block.
    const PACKED: &[u8] =
        &[0x0b, 0x04, 0x80, b'p', b'e', b'r', b'i', b'p', b'l', b'u', b's', b'\n', 0x03];

    const SOME: &[(&str, &[u8])] =
        &[("index.html", b"<p>"), ("assets/a-1.js.br", PACKED), ("logo.svg", b"<svg/>")];

    fn request(path: &str, headers: &[(&'static str, &str)]) -> HeaderMap {
        let mut request = hyper::Request::get(path);
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        request.body(()).expect("a request").headers().clone()
    }

    fn ask(path: &str, headers: &[(&'static str, &str)]) -> Answer {
        answer_from(SOME, path, &request(path, headers))
    }

    fn header<'a>(answer: &'a Answer, name: &str) -> Option<&'a str> {
        answer.headers().get(name).map(|value| value.to_str().expect("text"))
    }

    /// Body of a response, which is in memory.
    fn body(answer: Answer) -> Bytes {
        let mut body = answer.into_body();
        let mut context = Context::from_waker(Waker::noop());
        match Pin::new(&mut body).poll_frame(&mut context) {
            Poll::Ready(Some(Ok(frame))) => frame.into_data().expect("data"),
            Poll::Ready(None) => Bytes::new(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn files_are_had_by_their_paths() {
        assert_eq!(body(ask("/", &[])), "<p>");
        assert_eq!(body(ask("/index.html", &[])), "<p>");
        assert_eq!(header(&ask("/logo.svg", &[]), "Content-Type"), Some("image/svg+xml"));
        for path in ["/x", "/../Cargo.toml", "/assets/../../Cargo.toml", "//etc/passwd", "/assets"]
        {
            assert_eq!(ask(path, &[]).status(), StatusCode::NOT_FOUND, "{path}");
        }
    }

    #[test]
    fn what_is_packed_is_unpacked_for_who_cannot() {
        let packed = ask("/assets/a-1.js", &[("Accept-Encoding", "gzip, br;q=0.9")]);
        assert_eq!(header(&packed, "Content-Encoding"), Some("br"));
        assert_eq!(body(packed), PACKED);
        let plain = ask("/assets/a-1.js", &[("Accept-Encoding", "gzip")]);
        assert_eq!(header(&plain, "Content-Encoding"), None);
        assert_eq!(body(plain), "periplus\n");
    }

    #[test]
    fn what_is_known_is_not_sent_again() {
        let first = ask("/logo.svg", &[]);
        let tag = header(&first, "ETag").expect("a tag");
        let again = ask("/logo.svg", &[("If-None-Match", tag)]);
        assert_eq!(again.status(), StatusCode::NOT_MODIFIED);
        assert!(body(again).is_empty());
    }

    #[test]
    fn all_that_is_in_the_program_can_be_had() {
        for (name, _) in FILES {
            let name = name.strip_suffix(".br").unwrap_or(name);
            let answer = answer(&format!("/{name}"), &HeaderMap::new());
            assert_eq!(answer.status(), StatusCode::OK, "{name}");
            assert!(!body(answer).is_empty(), "{name}");
        }
    }
}
