//! Bands of image rows, rendered in parallel.

use std::ops::Range;

use super::{ImageOutputs, RenderedImages, Scratch};
use crate::lens::Lens;

/// Number of rows per band: rays are traced in tiles of four by two, and the rays and hits of a band
/// stay in the cache.
const BAND_ROWS: u32 = 2;

/// Some rows of every image.
pub(super) struct Band<'a> {
    pub(super) rows: Range<u32>,
    pub(super) rgb: &'a mut [u8],
    pub(super) depth_m: &'a mut [f32],
    pub(super) classes: &'a mut [u8],
    pub(super) instances: &'a mut [u16],
}

impl RenderedImages {
    /// Resizes the images and splits them into bands.
    pub(super) fn bands(&mut self, lens: &Lens, outputs: ImageOutputs) -> Vec<Band<'_>> {
        (self.width, self.height) = (lens.width(), lens.height());
        let pixels = self.width as usize * self.height as usize;
        let room = |outputs: bool| if outputs { pixels } else { 0 };
        self.rgb.resize(3 * room(outputs.colour), 0);
        self.depth_m.resize(room(outputs.depth), 0.0);
        self.classes.resize(room(outputs.labels), 0);
        self.instances.resize(room(outputs.labels), 0);
        let band = (BAND_ROWS * self.width) as usize;
        let mut rgb = self.rgb.chunks_mut(3 * band);
        let mut depth_m = self.depth_m.chunks_mut(band);
        let mut classes = self.classes.chunks_mut(band);
        let mut instances = self.instances.chunks_mut(band);
        let starts = (0..self.height).step_by(BAND_ROWS as usize);
        let bands = starts.map(|first| Band {
            rows: first..(first + BAND_ROWS).min(self.height),
            rgb: rgb.next().unwrap_or_default(),
            depth_m: depth_m.next().unwrap_or_default(),
            classes: classes.next().unwrap_or_default(),
            instances: instances.next().unwrap_or_default(),
        });
        bands.collect()
    }
}

/// Renders bands with several threads, interleaved: neighbouring bands take similar time.
pub(super) fn render_bands<'a>(
    bands: Vec<Band<'_>>,
    threads: usize,
    work: impl Fn(&mut Band<'_>, &mut Scratch<'a>) + Sync,
) {
    let threads = threads.clamp(1, bands.len().max(1));
    let mut lists: Vec<Vec<Band<'_>>> = (0..threads).map(|_| Vec::new()).collect();
    for (number, band) in bands.into_iter().enumerate() {
        lists[number % threads].push(band);
    }
    let run = |list: Vec<Band<'_>>| {
        let mut scratch = Scratch::default();
        for mut band in list {
            work(&mut band, &mut scratch);
        }
    };
    let Some(own) = lists.pop() else { return };
    std::thread::scope(|scope| {
        for list in lists {
            scope.spawn(|| run(list));
        }
        run(own);
    });
}
