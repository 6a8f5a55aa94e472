//! One message on its way to a client.

use periplus_graph::Sample;

/// One message on its way to a client. The bytes of a sample are those that everybody shares.
#[derive(Clone, Debug)]
pub struct Frame {
    kind: Kind,
    head: Vec<u8>,
    body: Option<Sample>,
}

/// How a frame goes onto a socket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// As text.
    Text,
    /// As bytes.
    Binary,
    /// As it is: whoever made it has put it into frames.
    Raw,
}

impl Frame {
    /// A message in JSON.
    #[must_use]
    pub fn text(text: String) -> Self {
        Self { kind: Kind::Text, head: text.into_bytes(), body: None }
    }

    /// A message in bytes.
    #[must_use]
    pub fn binary(bytes: Vec<u8>) -> Self {
        Self { kind: Kind::Binary, head: bytes, body: None }
    }

    /// Bytes that are framed already: what a WebSocket says by itself.
    #[must_use]
    pub fn raw(bytes: Vec<u8>) -> Self {
        Self { kind: Kind::Raw, head: bytes, body: None }
    }

    /// A message that ends with the bytes of a sample. None when it cannot be encoded.
    #[must_use]
    pub(crate) fn sample(head: Vec<u8>, sample: Sample) -> Option<Self> {
        sample.cdr().ok()?;
        Some(Self { kind: Kind::Binary, head, body: Some(sample) })
    }

    /// How it goes onto a socket.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Its bytes, in two parts.
    #[must_use]
    pub fn parts(&self) -> [&[u8]; 2] {
        let body = self.body.as_ref().and_then(|sample| sample.cdr().ok());
        [&self.head, body.unwrap_or_default()]
    }

    /// How many bytes it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.parts().iter().map(|part| part.len()).sum()
    }

    /// Whether it has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
