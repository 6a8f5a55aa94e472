//! Little-endian bytes of a limited number, in steps of four.

use crate::error::MeshError;

/// Bytes under construction.
pub(super) struct PackedBytes {
    bytes: Vec<u8>,
    max_bytes: usize,
}

impl PackedBytes {
    pub(super) fn new(max_bytes: usize) -> Self {
        PackedBytes { bytes: Vec::new(), max_bytes }
    }

    pub(super) fn finish(self) -> Vec<u8> {
        self.bytes
    }

    pub(super) fn raw(&mut self, bytes: &[u8]) -> Result<(), MeshError> {
        if self.bytes.len() + bytes.len() > self.max_bytes {
            let limit_mib = self.max_bytes >> 20;
            return Err(MeshError::new(
                format!("the mesh has more than {limit_mib} MiB of triangles and images"),
                "decimate it, or reduce the size of its textures",
            ));
        }
        self.bytes.extend(bytes);
        Ok(())
    }

    pub(super) fn u32(&mut self, number: u32) -> Result<(), MeshError> {
        self.raw(&number.to_le_bytes())
    }

    pub(super) fn f32(&mut self, number: f32) -> Result<(), MeshError> {
        self.raw(&number.to_le_bytes())
    }

    /// A number of things, which are more than the limit on bytes before they exceed 32 bits.
    pub(super) fn count(&mut self, count: usize) -> Result<(), MeshError> {
        self.u32(u32::try_from(count).unwrap_or(u32::MAX))
    }

    /// Bytes with their length, filled up to a multiple of four.
    pub(super) fn block(&mut self, bytes: &[u8]) -> Result<(), MeshError> {
        self.count(bytes.len())?;
        self.raw(bytes)?;
        self.align()
    }

    /// Fills up to a multiple of four, so that a viewer reads numbers in place.
    pub(super) fn align(&mut self) -> Result<(), MeshError> {
        let fill = self.bytes.len().next_multiple_of(4) - self.bytes.len();
        self.raw(&[0; 4][..fill])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_filled_up_to_four_bytes() {
        let mut out = PackedBytes::new(12);
        out.block(b"abcde").unwrap();
        assert_eq!(out.finish(), b"\x05\0\0\0abcde\0\0\0");
    }

    #[test]
    fn more_bytes_than_the_limit_are_an_error() {
        let mut out = PackedBytes::new(4);
        out.u32(1).unwrap();
        assert!(out.raw(b"x").unwrap_err().help.contains("decimate"));
    }
}
