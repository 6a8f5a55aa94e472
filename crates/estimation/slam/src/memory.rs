//! Memory that is reported.

/// Returns the size of a type where pointers have 64 bits \[bytes\], so that reports are the same on every platform.
/// On such platforms the compiler checks `bytes`.
pub(crate) const fn on_64_bits<T>(bytes: usize) -> usize {
    assert!(size_of::<usize>() != 8 || size_of::<T>() == bytes, "the size of the type has changed");
    bytes
}
