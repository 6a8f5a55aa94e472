//! Pictures from bytes and to bytes.
//!
//! [`Raster`] holds what a file holds: PNG, JPEG, BMP or PNM (PGM, PPM, PBM), brought to eight or
//! sixteen bits a sample. [`Image`] is the same in red, green, blue and alpha, and [`Grey`] its
//! brightness alone. [`write_png`], [`write_bmp`] and [`write_pgm`] are the ways back; [`pack_png`] is one
//! that does not need the whole picture at once.
//!
//! Sizes are checked before memory is asked for, so no file makes a reader take more than 256 MiB
//! for its samples.
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
pub use raster::{BadImage, LONGEST_SIDE, Layout, MOST_BYTES, Raster};
