//! Who may come in.

use std::fmt;

use crate::server::authority::{is_own_origin, is_this_machine};
use crate::server::http::Head;
use crate::server::token;

/// Who may open a WebSocket.
///
/// Any page in a browser can ask for one, at any address that the browser's machine reaches, and the
/// browser tells from which page (`Origin`). So a page from elsewhere is refused, also one whose name
/// was made to lead to this machine (`Host`). Who has the token comes in from anywhere; where the
/// server is reached from other machines, nobody comes in without.
#[derive(Clone, Debug)]
pub struct Door {
    /// Whether only this machine reaches the server.
    pub is_loopback: bool,
    /// What opens it to all others; without one only this machine comes in.
    pub token: Option<String>,
}

/// Why somebody may not come in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refused {
    /// The token is another.
    WrongToken,
    /// There is none, and one is needed.
    NoToken,
    /// The page is from elsewhere.
    ForeignOrigin(String),
    /// The server is called by a name that is not this machine's.
    ForeignHost(String),
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongToken => f.write_str("the token in `?token=` is not that of this server"),
            Self::NoToken => f.write_str(
                "this server is reached from other machines, so it wants a token: take the address \
                 that it printed when it began, with `?token=` in it",
            ),
            Self::ForeignOrigin(origin) => write!(
                f,
                "the page `{origin}` is not from this machine; add `?token=` with the server's token \
                 to the address, or open the page of the server itself"
            ),
            Self::ForeignHost(host) => write!(
                f,
                "`{host}` is not a name of this machine alone; use 127.0.0.1 or localhost, or add \
                 `?token=` with the server's token"
            ),
        }
    }
}

impl Door {
    /// Whether who asks like this comes in.
    ///
    /// # Errors
    /// Why not.
    pub fn admit(&self, head: &Head) -> Result<(), Refused> {
        if let Some(given) = head.query("token") {
            let given = token::decoded(given);
            return match &self.token {
                Some(own) if token::same(own.as_bytes(), &given) => Ok(()),
                _ => Err(Refused::WrongToken),
            };
        }
        if !self.is_loopback {
            return Err(Refused::NoToken);
        }
        // Of several, each has to be this machine's: which one counts is not for a client to choose.
        if let Some(host) = head.headers("host").find(|host| !is_this_machine(host)) {
            return Err(Refused::ForeignHost(host.to_owned()));
        }
        match head.headers("origin").find(|origin| !is_own_origin(origin)) {
            Some(origin) => Err(Refused::ForeignOrigin(origin.to_owned())),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn admit(door: &Door, path: &str, headers: &str) -> Result<(), Refused> {
        let text = format!("GET {path} HTTP/1.1\r\n{headers}\r\n");
        door.admit(&Head::read(text.as_bytes()).expect("a head").expect("whole").0)
    }

    #[test]
    fn this_machine_comes_in_and_foreign_pages_do_not() {
        let door = Door { is_loopback: true, token: Some("secret".into()) };
        let own = "Host: 127.0.0.1:8765\r\n";
        let come = |origin: &str| admit(&door, "/", &format!("{own}Origin: {origin}\r\n"));
        assert_eq!(admit(&door, "/", own), Ok(()));
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
            assert_eq!(come(origin), Err(Refused::ForeignOrigin(origin.into())), "{origin}");
        }
    }

    #[test]
    fn a_name_that_was_made_to_lead_here_does_not() {
        let door = Door { is_loopback: true, token: None };
        let rebound = "Host: evil.example.org:8765\r\nOrigin: http://evil.example.org:8765\r\n";
        let host = "evil.example.org:8765".to_owned();
        assert_eq!(admit(&door, "/", rebound), Err(Refused::ForeignHost(host)));
        let host = "[::1].evil.example:8765".to_owned();
        let rebound = format!("Host: {host}\r\n");
        assert_eq!(admit(&door, "/", &rebound), Err(Refused::ForeignHost(host)));
        let twice = "Host: localhost\r\nHost: evil.example\r\n";
        let host = "evil.example".to_owned();
        assert_eq!(admit(&door, "/", twice), Err(Refused::ForeignHost(host)));
    }

    #[test]
    fn the_token_opens_and_a_wrong_one_does_not() {
        let door = Door { is_loopback: false, token: Some("secret".into()) };
        let foreign = "Host: robot:8765\r\nOrigin: https://example.org\r\n";
        assert_eq!(admit(&door, "/", foreign), Err(Refused::NoToken));
        assert_eq!(admit(&door, "/?token=", foreign), Err(Refused::WrongToken));
        assert_eq!(admit(&door, "/?token=Secret", foreign), Err(Refused::WrongToken));
        assert_eq!(admit(&door, "/x?a=b&token=secret", foreign), Ok(()));
        let odd = Door { is_loopback: false, token: Some("a b+c/ü%&".into()) };
        assert_eq!(admit(&odd, "/?token=a%20b%2bc%2F%C3%BC%25%26", foreign), Ok(()));
        assert_eq!(admit(&odd, "/?token=a+b+c", foreign), Err(Refused::WrongToken));
        let none = Door { is_loopback: true, token: None };
        assert_eq!(admit(&none, "/?token=", "Host: localhost\r\n"), Err(Refused::WrongToken));
    }
}
