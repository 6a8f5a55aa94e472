//! Velocity noise.

use periplus_geometry::{DVec3, Stream};

/// Adds normal noise of a standard deviation to each axis.
pub(crate) fn noisy(value: DVec3, deviation: f64, stream: &mut Stream) -> DVec3 {
    if deviation == 0.0 {
        return value;
    }
    let [x, y, z] = std::array::from_fn(|_| stream.normal());
    value + DVec3::new(x, y, z) * deviation
}
