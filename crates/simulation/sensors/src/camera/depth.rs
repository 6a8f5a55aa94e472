//! Depth clipping.

/// Clips depths by REP 117: `-inf` at or below the minimum, `inf` at or above the maximum.
pub fn clip_depths(depths_m: &mut [f32], min_m: f64, max_m: f64) {
    #[expect(clippy::cast_possible_truncation, reason = "images have single precision")]
    let (min_m, max_m) = (min_m as f32, max_m as f32);
    for depth_m in depths_m {
        *depth_m = if *depth_m <= min_m {
            f32::NEG_INFINITY
        } else if *depth_m < max_m {
            *depth_m
        } else {
            f32::INFINITY
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_are_clipped_by_rep_117() {
        let mut depths_m = [0.4, 0.41, 9.99, 10.0, f32::INFINITY];
        clip_depths(&mut depths_m, 0.4, 10.0);
        let (far, near) = (f32::INFINITY, f32::NEG_INFINITY);
        assert_eq!(depths_m, [near, 0.41, 9.99, far, far]);
    }
}
