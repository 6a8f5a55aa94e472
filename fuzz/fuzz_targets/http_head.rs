//! Any bytes as requests: each is refused or read, and a client that is admitted without a token is on this
//! machine.
#![no_main]

use std::convert::Infallible;

use http_body_util::Empty;
use hyper::body::{Bytes, Incoming};
use hyper::header::ORIGIN;
use hyper::service::service_fn;
use hyper::{Request, Response};
use hyper_util::rt::TokioIo;
use libfuzzer_sys::fuzz_target;
use periplus_web::server::{Authorization, bounded_http};

fn check(request: &Request<Incoming>) {
    let (target, headers) = (request.uri(), request.headers());
    let token = "0123456789abcdef";
    let shut = Authorization { is_loopback: false, token: Some(token.to_owned()) };
    if !target.query().is_some_and(|query| query.contains("token=")) {
        assert!(shut.admit(target, headers).is_err());
    }
    let own = Authorization { is_loopback: true, token: None };
    if own.admit(target, headers).is_ok() {
        for origin in headers.get_all(ORIGIN) {
            let origin = String::from_utf8_lossy(origin.as_bytes()).to_ascii_lowercase();
            let is_own =
                ["localhost", "127.", "[", "file://"].iter().any(|own| origin.contains(own));
            assert!(is_own, "{origin}");
        }
    }
}

fuzz_target!(|bytes: &[u8]| {
    let runtime = tokio::runtime::Builder::new_current_thread().build().expect("a runtime");
    let stream = TokioIo::new(tokio::io::join(bytes, tokio::io::sink()));
    let service = service_fn(|request| {
        check(&request);
        std::future::ready(Ok::<_, Infallible>(Response::new(Empty::<Bytes>::new())))
    });
    let _ = runtime.block_on(bounded_http().serve_connection(stream, service));
});
