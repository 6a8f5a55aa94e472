//! Messages to a client.

use periplus_graph::Sample;

/// A message to a client. The bytes of a sample are shared, not copied.
#[derive(Clone, Debug)]
pub struct WebSocketFrame {
    kind: FrameKind,
    head: Vec<u8>,
    body: Option<Sample>,
}

/// WebSocket form of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameKind {
    /// A text message.
    Text,
    /// A binary message.
    Binary,
    /// Bytes with WebSocket framing.
    Raw,
}

impl WebSocketFrame {
    /// Creates a text message (JSON).
    #[must_use]
    pub fn text(text: String) -> Self {
        Self { kind: FrameKind::Text, head: text.into_bytes(), body: None }
    }

    /// Creates a binary message.
    #[must_use]
    pub fn binary(bytes: Vec<u8>) -> Self {
        Self { kind: FrameKind::Binary, head: bytes, body: None }
    }

    /// Creates a frame from bytes with WebSocket framing, such as pongs.
    #[must_use]
    pub fn raw(bytes: Vec<u8>) -> Self {
        Self { kind: FrameKind::Raw, head: bytes, body: None }
    }

    /// Creates a binary message that ends with the bytes of a sample. None when the sample cannot
    /// be encoded.
    #[must_use]
    pub(crate) fn sample(head: Vec<u8>, sample: Sample) -> Option<Self> {
        sample.cdr().ok()?;
        Some(Self { kind: FrameKind::Binary, head, body: Some(sample) })
    }

    /// Form of the frame.
    #[must_use]
    pub fn kind(&self) -> FrameKind {
        self.kind
    }

    /// Bytes of the frame, in two parts.
    #[must_use]
    pub fn parts(&self) -> [&[u8]; 2] {
        let body = self.body.as_ref().and_then(|sample| sample.cdr().ok());
        [&self.head, body.unwrap_or_default()]
    }

    /// Length \[bytes\].
    #[must_use]
    pub fn len(&self) -> usize {
        self.parts().iter().map(|part| part.len()).sum()
    }

    /// True if the frame is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
