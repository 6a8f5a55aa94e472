//! Minimal HTTP server for the viewer page.

use std::fmt;

/// Maximum size of a request head \[bytes\]; browsers send less than 2 kB.
pub const LONGEST_HEAD: usize = 16 << 10;

/// Maximum number of headers of a request.
const MOST_HEADERS: usize = 100;

/// Head of a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Head {
    /// Method, such as `GET`.
    pub method: String,
    /// Target with query.
    pub target: String,
    /// Header names in lower case, with values.
    headers: Vec<(String, String)>,
}

/// Reason for which a request head is invalid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HeadError {
    /// The head is too long.
    TooLong,
    /// The head is not HTTP.
    Malformed(String),
}

impl fmt::Display for HeadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong => write!(f, "the head of the request is over {LONGEST_HEAD} bytes"),
            Self::Malformed(why) => write!(f, "the request is not HTTP: {why}"),
        }
    }
}

impl std::error::Error for HeadError {}

impl Head {
    /// Parses a head and returns its length; none if it is incomplete.
    ///
    /// # Errors
    /// When it is not a valid head.
    pub fn read(bytes: &[u8]) -> Result<Option<(Self, usize)>, HeadError> {
        let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
        let mut request = httparse::Request::new(&mut headers);
        let status =
            request.parse(bytes).map_err(|error| HeadError::Malformed(error.to_string()))?;
        let httparse::Status::Complete(length) = status else {
            let is_full = bytes.len() >= LONGEST_HEAD;
            return if is_full { Err(HeadError::TooLong) } else { Ok(None) };
        };
        if length > LONGEST_HEAD {
            return Err(HeadError::TooLong);
        }
        let headers = request.headers.iter().map(|header| {
            let value = String::from_utf8_lossy(header.value).trim().to_owned();
            (header.name.to_ascii_lowercase(), value)
        });
        let head = Self {
            method: request.method.unwrap_or_default().to_owned(),
            target: request.path.unwrap_or_default().to_owned(),
            headers: headers.collect(),
        };
        Ok(Some((head, length)))
    }

    /// Path without the query.
    #[must_use]
    pub fn path(&self) -> &str {
        self.target.split('?').next().unwrap_or_default()
    }

    /// Value of a header, by its name in lower case.
    #[must_use]
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(own, _)| own == name).map(|(_, value)| value.as_str())
    }

    /// All values of a header, by its name in lower case.
    pub fn headers(&self, name: &str) -> impl Iterator<Item = &str> {
        self.headers.iter().filter(move |(own, _)| own == name).map(|(_, value)| value.as_str())
    }

    /// True if a list header contains a word.
    #[must_use]
    pub fn lists(&self, name: &str, word: &str) -> bool {
        let values = self.headers.iter().filter(|(own, _)| own == name);
        let mut words = values.flat_map(|(_, value)| value.split(','));
        words.any(|one| one.split(';').next().unwrap_or_default().trim().eq_ignore_ascii_case(word))
    }

    /// Value of a query parameter, not decoded.
    #[must_use]
    pub fn query(&self, name: &str) -> Option<&str> {
        let (_, query) = self.target.split_once('?')?;
        query.split('&').find_map(|part| part.strip_prefix(name)?.strip_prefix('='))
    }

    /// True if the request asks for a WebSocket upgrade.
    #[must_use]
    pub fn is_upgrade(&self) -> bool {
        self.lists("upgrade", "websocket") && self.lists("connection", "upgrade")
    }
}

/// A response.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    pub(crate) status: &'static str,
    pub(crate) headers: Vec<(&'static str, String)>,
    pub(crate) body: Vec<u8>,
}

impl Answer {
    /// Plain-text response.
    pub(crate) fn words(status: &'static str, words: &str) -> Self {
        let kind = ("Content-Type", "text/plain; charset=utf-8".to_owned());
        Self { status, headers: vec![kind], body: format!("{words}\n").into_bytes() }
    }

    /// Encodes the response. The response to `HEAD` has no body but its length.
    pub(crate) fn bytes(&self, is_head: bool, stays: bool) -> Vec<u8> {
        let mut text = format!("HTTP/1.1 {}\r\n", self.status);
        for (name, value) in &self.headers {
            text.push_str(&format!("{name}: {value}\r\n"));
        }
        let connection = if stays { "keep-alive" } else { "close" };
        text.push_str(&format!("Content-Length: {}\r\n", self.body.len()));
        text.push_str(&format!("Connection: {connection}\r\n\r\n"));
        let mut bytes = text.into_bytes();
        if !is_head {
            bytes.extend(&self.body);
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_are_read_when_they_are_whole() {
        let text = b"GET /a?b=1&token=x HTTP/1.1\r\nHost: h\r\nConnection: keep-alive, Upgrade\r\nUpgrade: websocket\r\n\r\nrest";
        for end in 0..text.len() - 5 {
            assert_eq!(Head::read(&text[..end]), Ok(None), "{end}");
        }
        let (head, length) = Head::read(text).expect("a head").expect("whole");
        assert_eq!(&text[length..], b"rest");
        assert_eq!(
            (head.path(), head.query("token"), head.query("b")),
            ("/a", Some("x"), Some("1"))
        );
        assert!(head.is_upgrade());
        assert_eq!(head.header("host"), Some("h"));
    }

    #[test]
    fn what_is_no_head_is_refused() {
        assert!(matches!(Head::read(b"\x16\x03\x01\x02\r\n\r\n"), Err(HeadError::Malformed(_))));
        let mut long = b"GET / HTTP/1.1\r\nX: ".to_vec();
        long.resize(LONGEST_HEAD, b'x');
        assert_eq!(Head::read(&long), Err(HeadError::TooLong));
        let many = format!("GET / HTTP/1.1\r\n{}\r\n", "A: b\r\n".repeat(MOST_HEADERS + 1));
        assert!(matches!(Head::read(many.as_bytes()), Err(HeadError::Malformed(_))));
    }
}
