//! Recordings on the disk.
