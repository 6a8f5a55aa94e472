//! Files of the viewer page, included in the program.

use std::io::Read as _;

use sha2::{Digest as _, Sha256};

use crate::server::http::{Answer, Head};

/// Every file of `page/` by its path. A file that ends in `.br` is compressed, and is requested
/// without that suffix.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/page.rs"));

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
pub(crate) fn answer(head: &Head) -> Answer {
    answer_from(FILES, head)
}

fn answer_from(files: &[(&str, &[u8])], head: &Head) -> Answer {
    let path = head.path().trim_start_matches('/');
    let path = if path.is_empty() { "index.html" } else { path };
    let find = |name: &str| files.iter().find(|(own, _)| *own == name).map(|(_, bytes)| *bytes);
    let packed = find(&format!("{path}.br"));
    let Some(bytes) = packed.or_else(|| find(path)) else {
        if path == "index.html" {
            return page(UNBUILT.as_bytes().to_vec(), "index.html");
        }
        return Answer::words("404 Not Found", "there is no such file; the page is at /");
    };
    let tag = tag(bytes);
    let is_known = head.header("if-none-match").is_some_and(|known| known.contains(&tag));
    let mut answer = if is_known {
        Answer { status: "304 Not Modified", headers: Vec::new(), body: Vec::new() }
    } else if packed.is_none() {
        page(bytes.to_vec(), path)
    } else if head.lists("accept-encoding", "br") {
        let mut answer = page(bytes.to_vec(), path);
        answer.headers.push(("Content-Encoding", "br".to_owned()));
        answer
    } else {
        page(unpack(bytes), path)
    };
    answer.headers.push(("ETag", format!("\"{tag}\"")));
    answer.headers.push(("Vary", "Accept-Encoding".to_owned()));
    // Files below `assets` have the hash of their content in their names.
    let keep = if path.starts_with("assets/") { "max-age=31536000, immutable" } else { "no-cache" };
    answer.headers.push(("Cache-Control", keep.to_owned()));
    answer
}

fn page(body: Vec<u8>, path: &str) -> Answer {
    let headers = vec![
        ("Content-Type", kind_of(path).to_owned()),
        ("X-Content-Type-Options", "nosniff".to_owned()),
        ("Content-Security-Policy", POLICY.to_owned()),
        ("Referrer-Policy", "no-referrer".to_owned()),
    ];
    Answer { status: "200 OK", headers, body }
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
    use super::*;

    /// "periplus\n" in one uncompressed block.
    const PACKED: &[u8] =
        &[0x0b, 0x04, 0x80, b'p', b'e', b'r', b'i', b'p', b'l', b'u', b's', b'\n', 0x03];

    const SOME: &[(&str, &[u8])] =
        &[("index.html", b"<p>"), ("assets/a-1.js.br", PACKED), ("logo.svg", b"<svg/>")];

    fn ask(path: &str, headers: &str) -> Answer {
        let text = format!("GET {path} HTTP/1.1\r\n{headers}\r\n");
        answer_from(SOME, &Head::read(text.as_bytes()).expect("a head").expect("whole").0)
    }

    fn header<'a>(answer: &'a Answer, name: &str) -> Option<&'a str> {
        answer.headers.iter().find(|(own, _)| *own == name).map(|(_, value)| value.as_str())
    }

    #[test]
    fn files_are_had_by_their_paths() {
        assert_eq!(ask("/", "").body, b"<p>");
        assert_eq!(ask("/index.html?token=x", "").body, b"<p>");
        assert_eq!(header(&ask("/logo.svg", ""), "Content-Type"), Some("image/svg+xml"));
        for path in ["/x", "/../Cargo.toml", "/assets/../../Cargo.toml", "//etc/passwd", "/assets"]
        {
            assert_eq!(ask(path, "").status, "404 Not Found", "{path}");
        }
    }

    #[test]
    fn what_is_packed_is_unpacked_for_who_cannot() {
        let packed = ask("/assets/a-1.js", "Accept-Encoding: gzip, br;q=0.9\r\n");
        assert_eq!(
            (packed.body.as_slice(), header(&packed, "Content-Encoding")),
            (PACKED, Some("br"))
        );
        let plain = ask("/assets/a-1.js", "Accept-Encoding: gzip\r\n");
        assert_eq!(
            (plain.body.as_slice(), header(&plain, "Content-Encoding")),
            (&b"periplus\n"[..], None)
        );
    }

    #[test]
    fn what_is_known_is_not_sent_again() {
        let first = ask("/logo.svg", "");
        let tag = header(&first, "ETag").expect("a tag");
        let again = ask("/logo.svg", &format!("If-None-Match: {tag}\r\n"));
        assert_eq!((again.status, again.body.len()), ("304 Not Modified", 0));
    }

    #[test]
    fn all_that_is_in_the_program_can_be_had() {
        for (name, _) in FILES {
            let name = name.strip_suffix(".br").unwrap_or(name);
            let text = format!("GET /{name} HTTP/1.1\r\n\r\n");
            let head = Head::read(text.as_bytes()).expect("a head").expect("whole").0;
            let answer = answer(&head);
            assert_eq!(answer.status, "200 OK", "{name}");
            assert!(!answer.body.is_empty(), "{name}");
        }
    }
}
