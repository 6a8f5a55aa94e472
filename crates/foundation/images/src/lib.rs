//! Decoding and encoding of images.
//!
//! [`Raster`] has the samples of a file: PNG, JPEG, BMP or PNM (PGM, PPM, PBM), converted to eight or
//! sixteen bits per sample. [`Image`] has red, green, blue and alpha, and [`Grey`] only brightness.
//! [`write_png`], [`write_bmp`] and [`write_pgm`] encode; [`pack_png`] encodes without the whole image in
//! memory.
//!
//! Sizes are checked before memory is allocated, so no file makes a reader use more than 256 MiB for its
//! samples.
//!
//! ```
//! use periplus_images::{Layout, Raster, write_pgm};
//!
//! let bytes = write_pgm(3, 1, &[0, 205, 254], None);
//! assert_eq!(&bytes[..11], b"P5\n3 1\n255\n");
//! let raster = Raster::decode(&bytes)?;
//! assert_eq!((raster.layout, raster.sample(1)), (Layout::Grey, &[205][..]));
//! # Ok::<(), periplus_images::BadImage>(())
//! ```

mod bmp;
mod decode;
mod encode;
mod jpeg;
mod png_file;
mod pnm;
mod raster;

pub use decode::{Grey, Image};
pub use encode::{pack_png, pgm_head, write_bmp, write_pgm, write_png};
pub use raster::{BadImage, Layout, MAX_SAMPLE_BYTES, MAX_SIDE_PX, Raster};
