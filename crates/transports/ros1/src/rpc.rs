//! Calls to other programs: requests of XML-RPC with a timeout.

use std::fmt;
use std::io::{BufReader, Write as _};
use std::net::{TcpStream, ToSocketAddrs as _};
use std::time::Duration;

use crate::xmlrpc::{self, RpcCall, XmlRpcValue};

/// A call that brought no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RpcError {
    /// No program answers at the address.
    Unreachable(String),
    /// The response is no result.
    Malformed(String),
    /// The other side refuses the call.
    Refused(String),
}

impl fmt::Display for RpcError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreachable(why) | Self::Malformed(why) | Self::Refused(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for RpcError {}

/// Host and port of `http://host:port/` or `rosrpc://host:port`; none for other texts.
pub(crate) fn host_and_port(uri: &str) -> Option<(String, u16)> {
    let (scheme, rest) = uri.split_once("://")?;
    if !matches!(scheme, "http" | "rosrpc") {
        return None;
    }
    let authority = rest.split('/').next()?;
    let (host, port) = authority.rsplit_once(':')?;
    let host = host.trim_start_matches('[').trim_end_matches(']');
    (!host.is_empty()).then_some(())?;
    Some((host.to_owned(), port.parse().ok().filter(|port| *port > 0)?))
}

/// Host as a URI has it: an IPv6 address in brackets.
pub(crate) fn uri_host(host: &str) -> String {
    if host.contains(':') { format!("[{host}]") } else { host.to_owned() }
}

/// Connects to an address.
pub(crate) fn connect(host: &str, port: u16, timeout: Duration) -> std::io::Result<TcpStream> {
    let mut last = std::io::Error::new(std::io::ErrorKind::NotFound, "the host has no address");
    for address in (host, port).to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, timeout) {
            Ok(stream) => return Ok(stream),
            Err(error) => last = error,
        }
    }
    Err(last)
}

/// Calls a method and returns its result.
///
/// # Errors
/// When no program answers within the timeout, or the answer is a fault.
pub fn call(uri: &str, call: &RpcCall, timeout: Duration) -> Result<XmlRpcValue, RpcError> {
    let unreachable =
        |error: &dyn fmt::Display| RpcError::Unreachable(format!("{uri} does not answer: {error}"));
    let malformed = |error: &dyn fmt::Display| RpcError::Malformed(format!("{uri}: {error}"));
    let (host, port) = host_and_port(uri)
        .ok_or_else(|| malformed(&"not an address such as http://localhost:11311"))?;
    let stream = connect(&host, port, timeout).map_err(|error| unreachable(&error))?;
    let io = || -> std::io::Result<()> {
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(timeout))?;
        stream.set_write_timeout(Some(timeout))?;
        let body = xmlrpc::write_call(call);
        let head = format!(
            "POST /RPC2 HTTP/1.1\r\nHost: {host}:{port}\r\nUser-Agent: periplus\r\nContent-Type: text/xml\r\n\
             Connection: close\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        (&stream).write_all(head.as_bytes())?;
        (&stream).write_all(body.as_bytes())
    };
    io().map_err(|error| unreachable(&error))?;
    let mut reader = BufReader::new(&stream);
    let head = xmlrpc::read_head(&mut reader, false).map_err(|error| unreachable(&error))?;
    let head = head.ok_or_else(|| unreachable(&"it closed the connection"))?;
    if head.status != 200 {
        return Err(malformed(&format!("HTTP status {}", head.status)));
    }
    let body = xmlrpc::read_body(&mut reader, &head).map_err(|error| unreachable(&error))?;
    match xmlrpc::read_response(&body).map_err(|error| malformed(&error))? {
        Ok(value) => Ok(value),
        Err(fault) => Err(RpcError::Refused(fault.text)),
    }
}

/// Calls a method of ROS, whose results are `[code, text, value]`; returns the value if the code is 1.
///
/// # Errors
/// As [`call`], and when the code is not 1.
pub fn ask(
    uri: &str,
    method: &str,
    params: Vec<XmlRpcValue>,
    timeout: Duration,
) -> Result<XmlRpcValue, RpcError> {
    let request = RpcCall { method: method.to_owned(), params };
    let result = call(uri, &request, timeout)?;
    let XmlRpcValue::List(parts) = result else {
        return Err(RpcError::Malformed(format!("{uri}: {method} returned {}", result.kind())));
    };
    let mut parts = parts.into_iter();
    match (parts.next(), parts.next(), parts.next()) {
        (Some(XmlRpcValue::Int(1)), _, Some(value)) => Ok(value),
        (Some(XmlRpcValue::Int(_)), Some(XmlRpcValue::Text(text)), _) => {
            Err(RpcError::Refused(text))
        }
        _ => Err(RpcError::Malformed(format!("{uri}: the result of {method} has no code"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_split() {
        let here = |port| Some(("localhost".to_owned(), port));
        assert_eq!(host_and_port("http://localhost:11311/"), here(11311));
        assert_eq!(host_and_port("http://localhost:11311"), here(11311));
        assert_eq!(host_and_port("rosrpc://localhost:4000"), here(4000));
        assert_eq!(host_and_port("http://[::1]:80/"), Some(("::1".to_owned(), 80)));
        for wrong in ["localhost:11311", "http://localhost", "http://:1", "http://a:0", "ftp://a:1"]
        {
            assert_eq!(host_and_port(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_silent_address_is_an_error_with_its_name() {
        let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
        let uri = format!("http://{}", listener.local_addr().expect("an address"));
        let error = ask(&uri, "getPid", Vec::new(), Duration::from_millis(50)).unwrap_err();
        assert!(matches!(&error, RpcError::Unreachable(why) if why.contains(&uri)), "{error}");
    }
}
