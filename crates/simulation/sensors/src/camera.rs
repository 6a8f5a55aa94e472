//! Cameras: pinhole projection, depth clipping and image noise.

mod depth;
mod noise;
mod pinhole;

pub use depth::clip_depths;
pub use noise::ImageNoise;
pub use pinhole::{CameraCalibration, MAX_PIXELS, Pinhole};
