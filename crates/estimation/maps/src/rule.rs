//! Interpretation of pixels.

use periplus_grid::occupancy::{FREE, OCCUPIED, UNKNOWN};
use periplus_images::Layout;

use crate::distro::{Distro, Mode};

/// Rule that converts a pixel to an occupancy value.
/// Sources: `map_server/src/image_loader.cpp` (ROS 1), `nav2_map_server/src/map_io.cpp` (Humble;
/// Jazzy and later).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Distribution.
    pub distro: Distro,
    /// Interpretation of the brightness.
    pub mode: Mode,
    /// True if white is occupied and black is free.
    pub negate: bool,
    /// Minimum darkness of occupied cells, 0 to 1.
    pub occupied_thresh: f64,
    /// Maximum darkness of free cells, 0 to 1.
    pub free_thresh: f64,
}

impl Rule {
    /// Converts a pixel with eight bits per sample.
    ///
    /// - Jazzy: grey is the luma of Rec. 601 in integers; thresholds are inclusive, and free has
    ///   priority; pixels that are not opaque are unknown.
    /// - Humble: grey is the mean; thresholds are exclusive; in mode trinary, opacity counts as a
    ///   fourth colour.
    /// - Noetic: as Humble, with 99 steps from 1 between the thresholds. The last sample counts as
    ///   opacity even if it is blue.
    #[must_use]
    pub fn occupancy(&self, layout: Layout, pixel: &[u8]) -> i8 {
        match self.distro {
            Distro::Jazzy => self.jazzy(layout, pixel),
            Distro::Humble => self.humble(layout, pixel),
            Distro::Noetic => self.noetic(layout, pixel),
        }
    }

    /// Returns the brightness of a pixel, 0 to 255: the luma since Jazzy, before that the rounded
    /// mean of its colours.
    #[must_use]
    pub fn grey(&self, layout: Layout, pixel: &[u8]) -> u8 {
        if self.distro == Distro::Jazzy {
            return luma(layout, pixel);
        }
        let sum: u16 = colours(layout, pixel).iter().map(|&it| u16::from(it)).sum();
        u8::try_from((2 * sum + 3) / 6).unwrap_or(u8::MAX)
    }

    fn jazzy(&self, layout: Layout, pixel: &[u8]) -> i8 {
        let grey = luma(layout, pixel);
        if self.mode == Mode::Raw {
            return if grey <= 100 { grey.cast_signed() } else { UNKNOWN };
        }
        if layout.has_alpha() && pixel.last() != Some(&255) {
            return UNKNOWN;
        }
        // In single precision, as in the reference.
        let bright = f32::from(grey) / 255.0;
        let dark = if self.negate { bright } else { 1.0 - bright };
        let (free, occupied) = (self.free_thresh as f32, self.occupied_thresh as f32);
        if dark <= free {
            FREE
        } else if dark >= occupied {
            OCCUPIED
        } else if self.mode == Mode::Scale {
            let range = (self.occupied_thresh - self.free_thresh) as f32;
            ((dark - free) / range * 100.0).round() as i8
        } else {
            UNKNOWN
        }
    }

    fn humble(&self, layout: Layout, pixel: &[u8]) -> i8 {
        let colours = colours(layout, pixel);
        let opacity = if layout.has_alpha() { pixel.last().copied().unwrap_or(255) } else { 255 };
        let mut sum: u32 = colours.iter().map(|&it| u32::from(it)).sum();
        let mut count = 3_u32;
        if self.mode == Mode::Trinary && layout.has_alpha() {
            sum += u32::from(opacity);
            count += 1;
        }
        let bright = f64::from(sum) / f64::from(count) / 255.0;
        let dark = if self.negate { bright } else { 1.0 - bright };
        match self.mode {
            Mode::Raw => {
                let value = (bright * 255.0).round();
                if value <= 100.0 { value as i8 } else { UNKNOWN }
            }
            Mode::Scale if opacity != 255 => UNKNOWN,
            _ if dark > self.occupied_thresh => OCCUPIED,
            _ if dark < self.free_thresh => FREE,
            Mode::Scale => {
                let range = self.occupied_thresh - self.free_thresh;
                ((dark - self.free_thresh) / range * 100.0).round_ties_even() as i8
            }
            Mode::Trinary => UNKNOWN,
        }
    }

    fn noetic(&self, layout: Layout, pixel: &[u8]) -> i8 {
        // Grey with opacity is read as colours there.
        let wide: [u8; 4];
        let samples: &[u8] = match (layout, pixel) {
            (Layout::GreyAlpha, &[grey, alpha]) => {
                wide = [grey, grey, grey, alpha];
                &wide
            }
            _ => pixel,
        };
        let averages_all = self.mode == Mode::Trinary || !layout.has_alpha();
        let averaged = if averages_all { samples } else { &samples[..samples.len() - 1] };
        let sum: u32 = averaged.iter().map(|&it| u32::from(it)).sum();
        let mut mean = f64::from(sum) / averaged.len() as f64;
        if self.negate {
            mean = 255.0 - mean;
        }
        if self.mode == Mode::Raw {
            return (mean as u8).cast_signed();
        }
        let is_clear = samples.len() > 1 && samples.last() == Some(&0);
        let dark = (255.0 - mean) / 255.0;
        if dark > self.occupied_thresh {
            OCCUPIED
        } else if dark < self.free_thresh {
            FREE
        } else if self.mode == Mode::Trinary || is_clear {
            UNKNOWN
        } else {
            let ratio = (dark - self.free_thresh) / (self.occupied_thresh - self.free_thresh);
            (1.0 + 98.0 * ratio) as i8
        }
    }
}

fn colours(layout: Layout, pixel: &[u8]) -> [u8; 3] {
    match (layout, pixel) {
        (Layout::Rgb | Layout::Rgba, &[red, green, blue, ..]) => [red, green, blue],
        (_, &[grey, ..]) => [grey; 3],
        _ => [0; 3],
    }
}

/// Returns the luma of Rec. 601 in integers, rounded down, as `GraphicsMagick` does.
pub(crate) fn luma(layout: Layout, pixel: &[u8]) -> u8 {
    let [red, green, blue] = colours(layout, pixel).map(u32::from);
    u8::try_from((306 * red + 601 * green + 117 * blue) / 1024).unwrap_or(u8::MAX)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rule(distro: Distro, mode: Mode) -> Rule {
        Rule { distro, mode, negate: false, occupied_thresh: 0.65, free_thresh: 0.2 }
    }

    fn grey(rule: Rule, grey: u8) -> i8 {
        rule.occupancy(Layout::Grey, &[grey])
    }

    #[test]
    fn thresholds_belong_to_their_side_since_jazzy_only() {
        // 204 is a darkness of one fifth.
        assert_eq!(grey(rule(Distro::Jazzy, Mode::Trinary), 204), FREE);
        let exact = Rule { negate: true, ..rule(Distro::Humble, Mode::Trinary) };
        assert_eq!(exact.occupancy(Layout::Grey, &[51]), UNKNOWN);
        assert_eq!(grey(rule(Distro::Noetic, Mode::Trinary), 204), UNKNOWN);
    }

    #[test]
    fn percents_between() {
        // 146 is a darkness of 0.4275: slightly more than half.
        assert_eq!(grey(rule(Distro::Jazzy, Mode::Scale), 146), 51);
        assert_eq!(grey(rule(Distro::Humble, Mode::Scale), 146), 51);
        assert_eq!(grey(rule(Distro::Noetic, Mode::Scale), 146), 50);
        assert_eq!(grey(rule(Distro::Noetic, Mode::Scale), 203), 1);
    }

    #[test]
    fn raw_values() {
        let raw = |distro, value| grey(rule(distro, Mode::Raw), value);
        assert_eq!([0, 100, 101, 255].map(|it| raw(Distro::Jazzy, it)), [0, 100, -1, -1]);
        assert_eq!([0, 100, 101, 255].map(|it| raw(Distro::Humble, it)), [0, 100, -1, -1]);
        assert_eq!([0, 100, 101, 255].map(|it| raw(Distro::Noetic, it)), [0, 100, 101, -1]);
        let negated = Rule { negate: true, ..rule(Distro::Noetic, Mode::Raw) };
        assert_eq!(grey(negated, 255), 0);
        assert_eq!(grey(Rule { distro: Distro::Jazzy, ..negated }, 42), 42);
    }

    #[test]
    fn what_is_not_opaque() {
        let black =
            |distro, mode, alpha| rule(distro, mode).occupancy(Layout::Rgba, &[0, 0, 0, alpha]);
        assert_eq!(black(Distro::Jazzy, Mode::Trinary, 254), UNKNOWN);
        assert_eq!(black(Distro::Humble, Mode::Scale, 254), UNKNOWN);
        // A quarter of the mean is opacity.
        assert_eq!(black(Distro::Humble, Mode::Trinary, 0), OCCUPIED);
        assert_eq!(
            rule(Distro::Humble, Mode::Trinary).occupancy(Layout::Rgba, &[60, 60, 60, 255]),
            UNKNOWN
        );
        assert_eq!(
            rule(Distro::Noetic, Mode::Scale).occupancy(Layout::GreyAlpha, &[146, 0]),
            UNKNOWN
        );
    }

    proptest! {
        #[test]
        fn darker_is_never_freer(a in any::<u8>(), b in any::<u8>(), distro in 0..3_usize) {
            let distro = [Distro::Noetic, Distro::Humble, Distro::Jazzy][distro];
            let scale = rule(distro, Mode::Scale);
            prop_assert!(a <= b || grey(scale, a) <= grey(scale, b));
            // Grey is grey in every pixel layout.
            let trinary = rule(distro, Mode::Trinary);
            prop_assert_eq!(grey(trinary, a), trinary.occupancy(Layout::Rgb, &[a, a, a]));
        }
    }
}
