//! HTTP/1.0 and 1.1 as far as XML-RPC needs it: a head, and a body of a stated length.

use std::fmt;
use std::io::{self, BufRead, Read as _};

/// Maximum size of the lines before a body.
const MAX_HEAD_BYTES: usize = 64 << 10;

/// Maximum size of a body: a robot description with large numbers of links takes some megabytes.
pub(crate) const MAX_BODY_BYTES: usize = 64 << 20;

/// Size by which the memory for a body grows, whatever length its head states.
const STEP_BYTES: usize = 1 << 20;

/// Lines before the body of a request or response.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Head {
    /// First word of a request, such as `POST`; empty in a response.
    pub(crate) method: String,
    /// Status of a response; 0 in a request.
    pub(crate) status: u16,
    /// Length of the body; none if it is not stated.
    pub(crate) body_bytes: Option<usize>,
    /// True if the connection stays open afterwards.
    pub(crate) keeps_open: bool,
    /// True if the peer waits for `100 Continue` before it sends the body.
    pub(crate) expects_continue: bool,
}

/// Reason for which a request or response is not read.
#[derive(Debug)]
pub(crate) enum HttpError {
    /// The connection failed or its timeout passed.
    Io(io::Error),
    /// The bytes are not HTTP, or are too many.
    Malformed(String),
}

impl fmt::Display for HttpError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => error.fmt(f),
            Self::Malformed(why) => write!(f, "malformed HTTP: {why}"),
        }
    }
}

impl From<io::Error> for HttpError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

fn malformed(why: impl fmt::Display) -> HttpError {
    HttpError::Malformed(why.to_string())
}

/// Reads the head of a request, or of a response. None if the connection was closed before it.
pub(crate) fn read_head(
    reader: &mut impl BufRead,
    is_request: bool,
) -> Result<Option<Head>, HttpError> {
    let mut lines = Vec::new();
    loop {
        let left = MAX_HEAD_BYTES.saturating_sub(lines.len()) as u64;
        let before = lines.len();
        reader.by_ref().take(left).read_until(b'\n', &mut lines)?;
        match &lines[before..] {
            [] if lines.is_empty() => return Ok(None),
            [] => return Err(malformed("the head is incomplete or longer than 64 KiB")),
            // A blank line before a request is allowed.
            b"\n" | b"\r\n" if before == 0 => lines.clear(),
            b"\n" | b"\r\n" => break,
            _ => {}
        }
    }
    let mut headers = [httparse::EMPTY_HEADER; 64];
    let mut head = Head::default();
    let version;
    let headers = if is_request {
        let mut request = httparse::Request::new(&mut headers);
        request.parse(&lines).map_err(malformed)?;
        head.method = request.method.unwrap_or_default().to_owned();
        version = request.version;
        request.headers
    } else {
        let mut response = httparse::Response::new(&mut headers);
        response.parse(&lines).map_err(malformed)?;
        head.status = response.code.unwrap_or_default();
        version = response.version;
        response.headers
    };
    head.keeps_open = version == Some(1);
    for header in headers.iter() {
        let value = String::from_utf8_lossy(header.value);
        let value = value.trim();
        match header.name.to_ascii_lowercase().as_str() {
            "content-length" => {
                let length: usize = value.parse().map_err(|_| malformed("Content-Length"))?;
                if length > MAX_BODY_BYTES {
                    return Err(malformed(format!(
                        "a body of {length} bytes; at most {MAX_BODY_BYTES} are read"
                    )));
                }
                head.body_bytes = Some(length);
            }
            "transfer-encoding" => {
                return Err(malformed("Transfer-Encoding is not used by XML-RPC"));
            }
            "connection" => match value.to_ascii_lowercase().as_str() {
                "close" => head.keeps_open = false,
                "keep-alive" => head.keeps_open = true,
                _ => {}
            },
            "expect" => head.expects_continue = value.eq_ignore_ascii_case("100-continue"),
            _ => {}
        }
    }
    Ok(Some(head))
}

/// Reads the body; one without a stated length ends with the connection.
pub(crate) fn read_body(reader: &mut impl BufRead, head: &Head) -> Result<Vec<u8>, HttpError> {
    let mut body = Vec::new();
    let wanted = head.body_bytes.unwrap_or(MAX_BODY_BYTES);
    while body.len() < wanted {
        let step = STEP_BYTES.min(wanted - body.len());
        let before = body.len();
        reader.by_ref().take(step as u64).read_to_end(&mut body)?;
        if body.len() < before + step {
            break;
        }
    }
    if head.body_bytes.is_some_and(|length| body.len() < length) {
        return Err(malformed("the body is shorter than its Content-Length"));
    }
    Ok(body)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_is_read_with_its_body() {
        let text = "POST /RPC2 HTTP/1.1\r\nHost: here\r\nContent-length: 3\r\n\r\nabcPOST";
        let mut reader = text.as_bytes();
        let head = read_head(&mut reader, true).expect("HTTP").expect("a head");
        assert_eq!(
            (head.method.as_str(), head.body_bytes, head.keeps_open),
            ("POST", Some(3), true)
        );
        assert_eq!(read_body(&mut reader, &head).expect("a body"), b"abc");
        assert_eq!(reader, b"POST");
    }

    #[test]
    fn lengths_are_bounded_and_checked() {
        let head = |text: &str| read_head(&mut text.as_bytes(), false);
        assert!(head("").expect("nothing").is_none());
        let error = head("HTTP/1.0 200 OK\r\nContent-Length: 99999999999\r\n\r\n").unwrap_err();
        assert!(error.to_string().contains("99999999999"), "{error}");
        let error = head(&format!("HTTP/1.0 200 OK\r\nA: {}", "x".repeat(70_000))).unwrap_err();
        assert!(error.to_string().contains("64 KiB"), "{error}");
        let short = Head { body_bytes: Some(10), ..Head::default() };
        assert!(read_body(&mut b"abc".as_slice(), &short).is_err());
    }
}
