//! Strict parsing of the hosts in `Host` and `Origin`: text that only a lenient parser takes for
//! this machine must not admit a client.
//!
//! Source: RFC 3986, section 3.2.2; RFC 6454, section 7.1.

use std::net::{IpAddr, Ipv6Addr};

/// True if `host[:port]` names this machine and nothing else.
pub(crate) fn is_this_machine(authority: &str) -> bool {
    let Some(host) = host_of(authority) else { return false };
    match host {
        Host::Ip(address) => address.is_loopback(),
        Host::Name(name) => name.eq_ignore_ascii_case("localhost"),
    }
}

/// True if an origin is a page of this machine, or of a local program: these send `file://`, while
/// a local file in a browser sends `null`, as any sandboxed page does.
pub(crate) fn is_own_origin(origin: &str) -> bool {
    let authority = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
    origin == "file://" || authority.is_some_and(is_this_machine)
}

enum Host<'a> {
    Ip(IpAddr),
    Name(&'a str),
}

/// Host of `host[:port]`; none if the text has any other form.
fn host_of(authority: &str) -> Option<Host<'_>> {
    if let Some(rest) = authority.strip_prefix('[') {
        let (address, port) = rest.split_once(']')?;
        let is_port = port.is_empty() || port.strip_prefix(':').is_some_and(is_number);
        let address = address.parse::<Ipv6Addr>().ok().filter(|_| is_port)?;
        return Some(Host::Ip(address.into()));
    }
    let host = match authority.split_once(':') {
        Some((host, port)) if is_number(port) => host,
        Some(_) => return None,
        None => authority,
    };
    Some(host.parse().map_or(Host::Name(host), Host::Ip))
}

fn is_number(port: &str) -> bool {
    port.bytes().all(|byte| byte.is_ascii_digit()) && port.parse::<u16>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_of_this_machine_are() {
        let own = ["localhost", "LOCALHOST:80", "127.0.0.1", "127.9.9.9:65535", "[::1]", "[::1]:1"];
        assert!(own.into_iter().all(is_this_machine));
        let foreign = [
            "",
            ":80",
            "[::1].evil.example",
            "[::1]evil",
            "[::1]:",
            "[::1]:80:80",
            "[::1",
            "[127.0.0.1]",
            "[localhost]",
            "::1",
            "localhost.evil.example",
            "localhost:80.evil.example",
            "localhost:80@evil.example",
            "127.0.0.1:80/evil",
            "127.0.0.1 evil",
            "127.0.0.1:+80",
            "127.0.0.1:65536",
            "user@127.0.0.1",
            "0x7f.1",
            "128.0.0.1",
        ];
        for host in foreign {
            assert!(!is_this_machine(host), "{host}");
            assert!(!is_own_origin(&format!("http://{host}")), "{host}");
        }
    }
}
