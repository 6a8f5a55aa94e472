//! Services: a request, then a byte for success and a response or the text of an error.

use std::fmt;
use std::io::{self, Read as _, Write as _};
use std::net::TcpStream;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use super::{Header, MAX_MESSAGE_BYTES, read_frame, read_header};
use crate::names::Ros1Type;
use crate::rpc;

/// Timeout of headers.
const PATIENCE: Duration = Duration::from_secs(5);

/// Response to a request, or the text of an error.
pub(crate) type Answer = Result<Vec<u8>, String>;

/// Answers requests.
type Serve = Box<dyn Fn(Vec<u8>, Box<dyn FnOnce(Answer) + Send>) + Send + Sync>;

/// A served service.
pub(crate) struct Serving {
    /// Name of the node.
    pub(crate) caller: String,
    pub(crate) service: String,
    pub(crate) of: Ros1Type,
    pub(crate) serve: Serve,
}

impl Serving {
    /// Answers the header of a client, and its requests until the connection ends.
    pub(crate) fn connect(&self, header: &Header, stream: &TcpStream) -> io::Result<()> {
        let mut writer = stream;
        let md5 = header.get("md5sum");
        if md5 != "*" && md5 != self.of.md5 {
            let why = format!(
                "the service [{}] has the type {} with the MD5 sum {}; {} asks for {md5}",
                self.service,
                self.of.name,
                self.of.md5,
                header.get("callerid")
            );
            return writer.write_all(&Header::new(&[("error", &why)]).write());
        }
        let (request, response) =
            (format!("{}Request", self.of.name), format!("{}Response", self.of.name));
        let answer = Header::new(&[
            ("callerid", &self.caller),
            ("md5sum", &self.of.md5),
            ("request_type", &request),
            ("response_type", &response),
            ("type", &self.of.name),
        ]);
        writer.write_all(&answer.write())?;
        if header.get("probe") == "1" {
            return Ok(());
        }
        stream.set_read_timeout(None)?;
        let mut reader = io::BufReader::new(stream);
        loop {
            let request = match read_frame(&mut reader, MAX_MESSAGE_BYTES) {
                Ok(request) => request,
                Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(()),
                Err(error) => return Err(error),
            };
            let (answered, answer): (_, Receiver<Answer>) = channel();
            let once = Box::new(move |answer| {
                // Fails only when the client has left.
                let _ = answered.send(answer);
            });
            (self.serve)(request, once);
            let answer =
                answer.recv().unwrap_or_else(|_| Err("the service ended without an answer".into()));
            let (is_done, body) = match answer {
                Ok(body) => (1, body),
                Err(why) => (0, why.into_bytes()),
            };
            let length = u32::try_from(body.len()).map_err(io::Error::other)?;
            let mut bytes = vec![is_done];
            bytes.extend_from_slice(&length.to_le_bytes());
            bytes.extend_from_slice(&body);
            writer.write_all(&bytes)?;
            if header.get("persistent") != "1" {
                return Ok(());
            }
        }
    }
}

/// Reason for which a service does not answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ServiceEnd {
    /// The connection failed.
    Lost(String),
    /// The server refuses the client or the request.
    Refused(String),
}

impl fmt::Display for ServiceEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lost(why) | Self::Refused(why) => f.write_str(why),
        }
    }
}

impl From<io::Error> for ServiceEnd {
    fn from(error: io::Error) -> Self {
        Self::Lost(error.to_string())
    }
}

/// Connection of a client to a service.
pub(crate) struct ServiceConnection {
    stream: TcpStream,
    /// Header of the server.
    pub(crate) header: Header,
}

impl ServiceConnection {
    /// Connects to a service; `md5` may be `*`. A probe only asks for the type.
    pub(crate) fn open(
        uri: &str,
        caller: &str,
        service: &str,
        md5: &str,
        is_probe: bool,
    ) -> Result<Self, ServiceEnd> {
        let (host, port) = rpc::host_and_port(uri)
            .ok_or_else(|| ServiceEnd::Refused(format!("`{uri}` is no address of a service")))?;
        let stream = rpc::connect(&host, port, PATIENCE)?;
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        let mut fields = vec![("callerid", caller), ("md5sum", md5), ("service", service)];
        fields.push(if is_probe { ("probe", "1") } else { ("persistent", "1") });
        (&stream).write_all(&Header::new(&fields).write())?;
        let header = read_header(&mut &stream)?;
        if header.has("error") {
            return Err(ServiceEnd::Refused(header.get("error").to_owned()));
        }
        Ok(Self { stream, header })
    }

    /// Sends a request and waits for the response, as long as it takes.
    pub(crate) fn call(&self, request: &[u8]) -> Result<Vec<u8>, ServiceEnd> {
        let length = u32::try_from(request.len()).map_err(|_| {
            ServiceEnd::Refused(format!("a request of {} bytes is too long", request.len()))
        })?;
        let mut bytes = length.to_le_bytes().to_vec();
        bytes.extend_from_slice(request);
        self.stream.set_read_timeout(None)?;
        (&self.stream).write_all(&bytes)?;
        let mut is_done = [0];
        (&self.stream).read_exact(&mut is_done)?;
        let body = read_frame(&mut &self.stream, MAX_MESSAGE_BYTES)?;
        match is_done {
            [0] => Err(ServiceEnd::Refused(String::from_utf8_lossy(&body).into_owned())),
            _ => Ok(body),
        }
    }

    /// A handle that ends the connection from another thread.
    pub(crate) fn stream(&self) -> io::Result<TcpStream> {
        self.stream.try_clone()
    }
}
