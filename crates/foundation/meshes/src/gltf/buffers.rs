//! Buffers: the BIN chunk, `data:` URIs and separate files.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use ::gltf::json::{Index, Root, buffer};

use crate::SideFiles;
use crate::error::MeshError;
use crate::limits::Budget;

/// Buffers of the file, each loaded on first use.
pub(super) struct Buffers<'a> {
    root: &'a Root,
    binary: Option<Rc<[u8]>>,
    side_files: &'a mut SideFiles<'a>,
    fetched: BTreeMap<usize, Rc<[u8]>>,
    /// Separate files that have been read.
    sides: BTreeSet<String>,
}

/// Bytes of a buffer in a view.
#[derive(Clone)]
pub(super) struct View {
    buffer: Rc<[u8]>,
    start: usize,
    len: usize,
    /// Distance between elements, if the view sets one [bytes].
    pub(super) stride: Option<usize>,
}

impl View {
    pub(super) fn bytes(&self) -> &[u8] {
        self.buffer.get(self.start..self.start + self.len).unwrap_or(&[])
    }
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        root: &'a Root,
        binary: Option<&[u8]>,
        side_files: &'a mut SideFiles<'_>,
    ) -> Self {
        let binary = binary.map(Rc::from);
        Buffers { root, binary, side_files, fetched: BTreeMap::new(), sides: BTreeSet::new() }
    }

    /// Bytes of a buffer view.
    pub(super) fn view(
        &mut self,
        index: Index<buffer::View>,
        budget: &mut Budget,
    ) -> Result<View, MeshError> {
        let view = self.root.buffer_views.get(index.value());
        let view = view.ok_or_else(|| missing("buffer view", index.value()))?;
        let buffer = self.buffer(view.buffer.value(), budget)?;
        let start = view.byte_offset.map_or(Some(0), |offset| usize::try_from(offset.0).ok());
        let len = usize::try_from(view.byte_length.0).ok();
        let range = start
            .zip(len)
            .filter(|&(start, len)| start.checked_add(len).is_some_and(|end| end <= buffer.len()));
        let Some((start, len)) = range else {
            return Err(MeshError::new(
                format!(
                    "buffer view {} reaches beyond the {} bytes of buffer {}",
                    index.value(),
                    buffer.len(),
                    view.buffer.value()
                ),
                "the file or its .bin is cut short: export or fetch it again",
            ));
        };
        let stride = view.byte_stride.map(|stride| stride.0).filter(|&stride| stride > 0);
        Ok(View { buffer, start, len, stride })
    }

    fn buffer(&mut self, index: usize, budget: &mut Budget) -> Result<Rc<[u8]>, MeshError> {
        if let Some(bytes) = self.fetched.get(&index) {
            return Ok(Rc::clone(bytes));
        }
        let buffer = self.root.buffers.get(index).ok_or_else(|| missing("buffer", index))?;
        let bytes: Rc<[u8]> = match (&buffer.uri, &self.binary) {
            (Some(uri), _) if uri.starts_with("data:") => data_uri(uri)?.bytes.into(),
            (Some(uri), _) => {
                let path = percent_decode(uri);
                let bytes = (self.side_files)(&path).ok_or_else(|| {
                    MeshError::new(
                        format!("buffer file `{}` not found", short(&path)),
                        "put it beside the glTF file, or export a single .glb",
                    )
                })?;
                // Several buffers may refer to one large file, which is charged once.
                if self.sides.insert(path) {
                    budget.grant(bytes.len());
                }
                budget.bytes(bytes.len())?;
                bytes.into()
            }
            (None, Some(binary)) if index == 0 => Rc::clone(binary),
            (None, _) => {
                return Err(MeshError::new(
                    format!("buffer {index} has no data"),
                    "export the file again with its buffers",
                ));
            }
        };
        self.fetched.insert(index, Rc::clone(&bytes));
        Ok(bytes)
    }
}

/// Content of a `data:` URI (RFC 2397).
pub(super) struct Data {
    pub(super) media_type: String,
    pub(super) bytes: Vec<u8>,
}

pub(super) fn data_uri(uri: &str) -> Result<Data, MeshError> {
    let bad = || {
        let message = format!("`{}...` is not a readable data URI", short(uri));
        MeshError::new(message, "export the file again, best as .glb")
    };
    let (head, body) =
        uri.strip_prefix("data:").and_then(|rest| rest.split_once(',')).ok_or_else(bad)?;
    let (media_type, bytes) = match head.strip_suffix(";base64") {
        Some(media_type) => (media_type, periplus_geometry::decode_base64(body).ok_or_else(bad)?),
        None => (head, percent_decode_bytes(body)),
    };
    Ok(Data { media_type: media_type.to_owned(), bytes })
}

pub(super) fn percent_decode(text: &str) -> String {
    String::from_utf8_lossy(&percent_decode_bytes(text)).into_owned()
}

fn percent_decode_bytes(text: &str) -> Vec<u8> {
    let (mut bytes, mut rest) = (Vec::with_capacity(text.len()), text.as_bytes());
    while let Some((&first, after)) = rest.split_first() {
        let hex = after.get(..2).filter(|_| first == b'%');
        let hex = hex.and_then(|hex| u8::from_str_radix(std::str::from_utf8(hex).ok()?, 16).ok());
        bytes.push(hex.unwrap_or(first));
        rest = if hex.is_some() { &after[2..] } else { after };
    }
    bytes
}

pub(super) fn missing(what: &str, index: usize) -> MeshError {
    MeshError::new(
        format!("{what} {index} is referred to but does not exist"),
        "the file is damaged: export it again",
    )
}

fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris_decode() {
        let data = data_uri("data:application/octet-stream;base64,AAECAw==").unwrap();
        assert_eq!(
            (data.media_type.as_str(), data.bytes),
            ("application/octet-stream", vec![0, 1, 2, 3])
        );
        assert_eq!(data_uri("data:,a%20b%zz").unwrap().bytes, b"a b%zz");
        assert!(data_uri("data:;base64,A*").is_err());
    }
}
