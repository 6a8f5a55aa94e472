//! Admission of WebSocket clients.

use std::fmt;

use hyper::header::{HOST, ORIGIN};
use hyper::{HeaderMap, Uri};

use crate::server::authority::{is_own_origin, is_this_machine};
use crate::server::{http, token};

/// Admission rule for WebSocket clients.
///
/// Any page in a browser can open a WebSocket to any address that the browser's machine reaches,
/// and the browser sends the page's `Origin`. A foreign page is therefore rejected, also if its
/// host name resolves to this machine (`Host`). A client with the token is always admitted; if
/// other machines can reach the server, the token is required.
#[derive(Clone, Debug)]
pub struct Authorization {
    /// True if only this machine can reach the server.
    pub is_loopback: bool,
    /// Token that admits any client; without one only this machine is admitted.
    pub token: Option<String>,
}

/// Reason for a rejection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AdmissionError {
    /// The token is wrong.
    WrongToken,
    /// The token is missing.
    NoToken,
    /// The page is from another host.
    ForeignOrigin(String),
    /// The `Host` header is not a name of this machine.
    ForeignHost(String),
}

impl fmt::Display for AdmissionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongToken => f.write_str("the token in `?token=` is not the token of this server"),
            Self::NoToken => f.write_str(
                "this server is reachable from other machines and requires a token: use the address \
                 that it printed at start, with `?token=` in it",
            ),
            Self::ForeignOrigin(origin) => write!(
                f,
                "the page `{origin}` is not from this machine; add `?token=` with the server's token \
                 to the address, or open the server's own page"
            ),
            Self::ForeignHost(host) => write!(
                f,
                "`{host}` is not a name of this machine alone; use 127.0.0.1 or localhost, or add \
                 `?token=` with the server's token"
            ),
        }
    }
}

impl Authorization {
    /// Checks if a request is admitted, by its target and headers.
    ///
    /// # Errors
    /// The reason of the rejection.
    pub fn admit(&self, target: &Uri, headers: &HeaderMap) -> Result<(), AdmissionError> {
        if let Some(given) = http::query(target, "token") {
            let given = token::decoded(given);
            return match &self.token {
                Some(own) if token::same(own.as_bytes(), &given) => Ok(()),
                _ => Err(AdmissionError::WrongToken),
            };
        }
        if !self.is_loopback {
            return Err(AdmissionError::NoToken);
        }
        // If there are several, each must name this machine: the client must not choose which one
        // counts. A target with a host counts as well (RFC 9112, section 3.2.2).
        let in_target = target.authority().map(|authority| authority.as_str().into());
        let mut hosts = http::values(headers, HOST).chain(in_target);
        if let Some(host) = hosts.find(|host| !is_this_machine(host)) {
            return Err(AdmissionError::ForeignHost(host.into_owned()));
        }
        match http::values(headers, ORIGIN).find(|origin| !is_own_origin(origin)) {
            Some(origin) => Err(AdmissionError::ForeignOrigin(origin.into_owned())),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn admit(
        authorization: &Authorization,
        target: &str,
        headers: &str,
    ) -> Result<(), AdmissionError> {
        let mut request = hyper::Request::get(target);
        for (name, value) in headers.lines().filter_map(|line| line.split_once(": ")) {
            request = request.header(name, value);
        }
        let request = request.body(()).expect("a request");
        authorization.admit(request.uri(), request.headers())
    }

    #[test]
    fn this_machine_comes_in_and_foreign_pages_do_not() {
        let authorization = Authorization { is_loopback: true, token: Some("secret".into()) };
        let own = "Host: 127.0.0.1:8765\r\n";
        let come = |origin: &str| admit(&authorization, "/", &format!("{own}Origin: {origin}\r\n"));
        assert_eq!(admit(&authorization, "/", own), Ok(()));
        for origin in
            ["http://localhost:5173", "http://127.0.0.1:8765", "http://[::1]:80", "file://"]
        {
            assert_eq!(come(origin), Ok(()), "{origin}");
        }
        let foreign = [
            "null",
            "https://example.org",
            "http://localhost.example.org",
            "http://127.0.0.1.example.org",
            "http://128.0.0.1",
            "ftp://localhost",
            "http://[::1].evil.example",
            "http://localhost:80@evil.example",
            "http://localhost/",
            "",
        ];
        for origin in foreign {
            assert_eq!(come(origin), Err(AdmissionError::ForeignOrigin(origin.into())), "{origin}");
        }
    }

    #[test]
    fn a_name_that_was_made_to_lead_here_does_not() {
        let authorization = Authorization { is_loopback: true, token: None };
        let rebound = "Host: evil.example.org:8765\r\nOrigin: http://evil.example.org:8765\r\n";
        let host = "evil.example.org:8765".to_owned();
        assert_eq!(admit(&authorization, "/", rebound), Err(AdmissionError::ForeignHost(host)));
        let host = "[::1].evil.example:8765".to_owned();
        let rebound = format!("Host: {host}\r\n");
        assert_eq!(admit(&authorization, "/", &rebound), Err(AdmissionError::ForeignHost(host)));
        let twice = "Host: localhost\r\nHost: evil.example\r\n";
        let host = "evil.example".to_owned();
        assert_eq!(admit(&authorization, "/", twice), Err(AdmissionError::ForeignHost(host)));
        let host = "evil.example".to_owned();
        let in_target = admit(&authorization, "http://evil.example/", "Host: localhost\r\n");
        assert_eq!(in_target, Err(AdmissionError::ForeignHost(host)));
    }

    #[test]
    fn the_token_opens_and_a_wrong_one_does_not() {
        let authorization = Authorization { is_loopback: false, token: Some("secret".into()) };
        let foreign = "Host: robot:8765\r\nOrigin: https://example.org\r\n";
        assert_eq!(admit(&authorization, "/", foreign), Err(AdmissionError::NoToken));
        assert_eq!(admit(&authorization, "/?token=", foreign), Err(AdmissionError::WrongToken));
        assert_eq!(
            admit(&authorization, "/?token=Secret", foreign),
            Err(AdmissionError::WrongToken)
        );
        assert_eq!(admit(&authorization, "/x?a=b&token=secret", foreign), Ok(()));
        let odd = Authorization { is_loopback: false, token: Some("a b+c/ü%&".into()) };
        assert_eq!(admit(&odd, "/?token=a%20b%2bc%2F%C3%BC%25%26", foreign), Ok(()));
        assert_eq!(admit(&odd, "/?token=a+b+c", foreign), Err(AdmissionError::WrongToken));
        let none = Authorization { is_loopback: true, token: None };
        assert_eq!(
            admit(&none, "/?token=", "Host: localhost\r\n"),
            Err(AdmissionError::WrongToken)
        );
    }
}
