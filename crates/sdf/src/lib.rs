//! SDF 1.0 to 1.12, read into a scene and written from one
