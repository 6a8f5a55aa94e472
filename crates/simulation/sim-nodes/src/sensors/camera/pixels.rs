//! Conversion to image messages. Bytes in the right order are copied as a whole.

use periplus_geometry::Stream;
use periplus_msgs::sensor_msgs::Image;
use periplus_msgs::std_msgs::Header;
use periplus_rendering::RenderedImages;

/// Encoding of colour images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Rgb8,
    Bgr8,
    Mono8,
    Rgb16,
    Mono16,
}

impl Encoding {
    /// Returns the encoding of an SDF format; formats without a ROS name become `rgb8`.
    pub(super) fn of(format: &str) -> Self {
        match format {
            "L8" | "L_INT8" => Self::Mono8,
            "L16" | "L_INT16" | "L_UINT16" => Self::Mono16,
            "B8G8R8" | "BGR_INT8" => Self::Bgr8,
            "R16G16B16" | "RGB_INT16" | "RGB_UINT16" => Self::Rgb16,
            _ => Self::Rgb8,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Rgb8 => "rgb8",
            Self::Bgr8 => "bgr8",
            Self::Mono8 => "mono8",
            Self::Rgb16 => "rgb16",
            Self::Mono16 => "mono16",
        }
    }
}

pub(super) fn colour_image(header: Header, picture: &RenderedImages, encoding: Encoding) -> Image {
    let rgb = &picture.rgb;
    let pixels = rgb.chunks_exact(3);
    // A byte b of 255 is b · 257 of 65535.
    let wide = |byte: u8| [byte, byte];
    let data = match encoding {
        Encoding::Rgb8 => rgb.clone(),
        Encoding::Bgr8 => pixels.flat_map(|p| [p[2], p[1], p[0]]).collect(),
        Encoding::Mono8 => pixels.map(brightness).collect(),
        Encoding::Rgb16 => rgb.iter().copied().flat_map(wide).collect(),
        Encoding::Mono16 => pixels.map(brightness).flat_map(wide).collect(),
    };
    image(header, picture, encoding.name(), data)
}

/// Rec. 601, in 256ths.
fn brightness(pixel: &[u8]) -> u8 {
    let [r, g, b] = [pixel[0], pixel[1], pixel[2]].map(u32::from);
    u8::try_from((77 * r + 150 * g + 29 * b) >> 8).unwrap_or(u8::MAX)
}

/// Depths in metres, `32FC1`.
pub(super) fn depth_image(header: Header, picture: &RenderedImages) -> Image {
    let data = if cfg!(target_endian = "little") {
        bytemuck::cast_slice(&picture.depth_m).to_vec()
    } else {
        picture.depth_m.iter().flat_map(|depth_m| depth_m.to_le_bytes()).collect()
    };
    image(header, picture, "32FC1", data)
}

/// Depths in millimetres, `16UC1`; 0 without a hit (OpenNI).
pub(super) fn millimetre_image(header: Header, picture: &RenderedImages) -> Image {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held to u16")]
    let millimetres = |depth_m: &f32| {
        if depth_m.is_finite() { (depth_m * 1000.0).clamp(0.0, 65535.0) as u16 } else { 0 }
    };
    let data = picture.depth_m.iter().map(millimetres).flat_map(u16::to_le_bytes).collect();
    image(header, picture, "16UC1", data)
}

/// Labels of gz's segmentation cameras: the instance in the first two bytes, the class in the third;
/// or one colour per label.
pub(super) fn label_image(header: Header, picture: &RenderedImages, coloured: bool) -> Image {
    let mut data = Vec::with_capacity(picture.classes.len() * 3);
    let mut last = ((0, 0), [0; 3]);
    for (&class, &instance) in picture.classes.iter().zip(&picture.instances) {
        if !coloured {
            let [low, high] = instance.to_le_bytes();
            data.extend_from_slice(&[low, high, class]);
            continue;
        }
        if last.0 != (class, instance) {
            last = ((class, instance), colour_of(class, instance));
        }
        data.extend_from_slice(&last.1);
    }
    image(header, picture, "rgb8", data)
}

fn colour_of(class: u8, instance: u16) -> [u8; 3] {
    if class == 0 {
        return [0; 3];
    }
    let key = u64::from(class) << 16 | u64::from(instance);
    let bytes = Stream::keyed(0, "label", key).bits().to_le_bytes();
    // Brighter than the background.
    [bytes[0] | 32, bytes[1] | 32, bytes[2] | 32]
}

fn image(header: Header, picture: &RenderedImages, encoding: &str, data: Vec<u8>) -> Image {
    let rows = (picture.height as usize).max(1);
    Image {
        header,
        height: picture.height,
        width: picture.width,
        encoding: encoding.into(),
        is_bigendian: 0,
        step: u32::try_from(data.len() / rows).unwrap_or(u32::MAX),
        data,
    }
}
