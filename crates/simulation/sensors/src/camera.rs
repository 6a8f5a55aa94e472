//! Cameras: where pixels look, depths, and noise of images.

mod depth;
mod noise;
mod pinhole;

pub use depth::clip_depths;
pub use noise::ImageNoise;
pub use pinhole::{Calibration, MOST_PIXELS, Pinhole};
