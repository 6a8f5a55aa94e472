//! Colours of maps and costmaps in `RViz`.
//!
//! Source: `rviz_default_plugins/displays/map/palette_builder.cpp`. Values are unsigned: -1 is 255.

/// Red, green, blue, opacity.
pub type Rgba = [u8; 4];

/// A colour for each value.
pub type Palette = [Rgba; 256];

/// Colour scheme of the map display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// White for free, black for occupied, bright colours for invalid values.
    Map,
    /// Blue to red by cost; cyan for inscribed, magenta for lethal, transparent for free.
    Costmap,
    /// The value as grey.
    Raw,
}

impl Scheme {
    /// Returns a scheme by its name in `.rviz` files.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "map" => Some(Self::Map),
            "costmap" => Some(Self::Costmap),
            "raw" => Some(Self::Raw),
            _ => None,
        }
    }

    /// Returns a colour for each value.
    #[must_use]
    pub fn palette(self) -> Palette {
        std::array::from_fn(|value| self.colour(u8::try_from(value).unwrap_or(u8::MAX)))
    }

    /// Returns a colour for each value of the binary display: one below the threshold, another from
    /// it on.
    #[must_use]
    pub fn binary(self, threshold: u8) -> Palette {
        let (below, from) = match self {
            Self::Map => ([255, 255, 255, 255], [0, 0, 0, 255]),
            Self::Costmap => ([0, 0, 255, 255], [255, 0, 0, 255]),
            Self::Raw => ([0, 0, 0, 255], [255, 255, 255, 255]),
        };
        std::array::from_fn(|value| match value {
            255 if self != Self::Raw => UNKNOWN,
            value if value < usize::from(threshold) => below,
            value if value <= 100 || self == Self::Raw => from,
            value => self.colour(u8::try_from(value).unwrap_or(u8::MAX)),
        })
    }

    fn colour(self, value: u8) -> Rgba {
        // Percentages in integers, rounded down.
        let part = |of: u8| u8::try_from(255 * u16::from(value) / u16::from(of)).unwrap_or(255);
        match (self, value) {
            (Self::Raw, grey) => [grey, grey, grey, 255],
            (Self::Map, 0..=100) => {
                let grey = 255 - part(100);
                [grey, grey, grey, 255]
            }
            (Self::Costmap, 0) => [0, 0, 0, 0],
            (Self::Costmap, 1..=98) => [part(100), 0, 255 - part(100), 255],
            (Self::Costmap, 99) => [0, 255, 255, 255],
            (Self::Costmap, 100) => [255, 0, 255, 255],
            (_, 101..=127) => [0, 255, 0, 255],
            (_, 128..=254) => {
                let yellow = 255 * (u16::from(value) - 128) / (254 - 128);
                [255, u8::try_from(yellow).unwrap_or(255), 0, 255]
            }
            (_, 255) => UNKNOWN,
        }
    }
}

/// Renders a grid in the colours of a palette: RGB pixels from the upper left corner, over white
/// where a colour is transparent, with `pixels` pixels along each side of a cell. `values` are
/// those of messages, row by row from the lowest row.
#[must_use]
pub fn paint(palette: &Palette, width: usize, values: &[i8], pixels: usize) -> Vec<u8> {
    let mut samples = Vec::with_capacity(values.len() * pixels * pixels * 3);
    for row in values.rchunks(width.max(1)) {
        let mut line = Vec::with_capacity(width * pixels * 3);
        for value in row {
            let [red, green, blue, opacity] = palette[usize::from(*value as u8)];
            let colour = if opacity == 0 { [255; 3] } else { [red, green, blue] };
            (0..pixels).for_each(|_| line.extend_from_slice(&colour));
        }
        (0..pixels).for_each(|_| samples.extend_from_slice(&line));
    }
    samples
}

/// Colour of -1.
const UNKNOWN: Rgba = [0x70, 0x89, 0x86, 255];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_that_everybody_knows() {
        let map = Scheme::Map.palette();
        assert_eq!((map[0], map[100], map[255]), ([255; 4], [0, 0, 0, 255], UNKNOWN));
        assert_eq!((map[1][0], map[50][0]), (253, 128));
        let costs = Scheme::Costmap.palette();
        assert_eq!(
            (costs[0], costs[99], costs[254]),
            ([0; 4], [0, 255, 255, 255], [255, 255, 0, 255])
        );
        assert_eq!(Scheme::Map.binary(50)[49], [255; 4]);
        assert_eq!(Scheme::Map.binary(50)[50], [0, 0, 0, 255]);
    }

    #[test]
    fn a_picture_begins_above_and_is_white_where_it_is_clear() {
        let pixels = paint(&Scheme::Costmap.palette(), 2, &[0, 99, 100, -1], 1);
        assert_eq!(pixels[..6], [255, 0, 255, 0x70, 0x89, 0x86]);
        assert_eq!(pixels[6..], [255, 255, 255, 0, 255, 255]);
        let large = paint(&Scheme::Raw.palette(), 1, &[7], 2);
        assert_eq!(large, [7; 12]);
    }
}
