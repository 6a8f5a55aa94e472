//! Who may come in.

use std::fmt;
use std::net::IpAddr;

use crate::http::Head;
use crate::token;

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
            return match &self.token {
                Some(own) if token::same(own, given) => Ok(()),
                _ => Err(Refused::WrongToken),
            };
        }
        if !self.is_loopback {
            return Err(Refused::NoToken);
        }
        if let Some(host) = head.header("host")
            && !is_this_machine(host_of(host))
        {
            return Err(Refused::ForeignHost(host.to_owned()));
        }
        match head.header("origin") {
            Some(origin) if !is_own_origin(origin) => {
                Err(Refused::ForeignOrigin(origin.to_owned()))
            }
            _ => Ok(()),
        }
    }
}

/// Whether a page comes from this machine, or from a program on it that shows pages: these say
/// `file://`, while a file in a browser says `null`, as any page in a sandbox does.
fn is_own_origin(origin: &str) -> bool {
    let rest = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
    origin == "file://" || rest.is_some_and(|host| is_this_machine(host_of(host)))
}

/// A host without its port and brackets.
fn host_of(host: &str) -> &str {
    if let Some(rest) = host.strip_prefix('[') {
        return rest.split(']').next().unwrap_or_default();
    }
    host.rsplit_once(':').map_or(host, |(host, _)| host)
}

fn is_this_machine(host: &str) -> bool {
    let is_name = host.eq_ignore_ascii_case("localhost");
    is_name || host.parse::<IpAddr>().is_ok_and(|address| address.is_loopback())
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
    }

    #[test]
    fn the_token_opens_and_a_wrong_one_does_not() {
        let door = Door { is_loopback: false, token: Some("secret".into()) };
        let foreign = "Host: robot:8765\r\nOrigin: https://example.org\r\n";
        assert_eq!(admit(&door, "/", foreign), Err(Refused::NoToken));
        assert_eq!(admit(&door, "/?token=", foreign), Err(Refused::WrongToken));
        assert_eq!(admit(&door, "/?token=Secret", foreign), Err(Refused::WrongToken));
        assert_eq!(admit(&door, "/x?a=b&token=secret", foreign), Ok(()));
        let none = Door { is_loopback: true, token: None };
        assert_eq!(admit(&none, "/?token=", "Host: localhost\r\n"), Err(Refused::WrongToken));
    }
}
