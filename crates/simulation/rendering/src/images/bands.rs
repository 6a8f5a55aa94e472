//! Pictures cut into bands of rows, so that threads can share the work.

use std::ops::Range;

use super::{Picture, Scratch, Wanted};
use crate::lens::Lens;

/// Rays are traced in patches of four by two; and rays and hits of a band stay close at hand.
const ROWS: u32 = 2;

/// A few rows of every image.
pub(super) struct Band<'a> {
    pub(super) rows: Range<u32>,
    pub(super) rgb: &'a mut [u8],
    pub(super) depth_m: &'a mut [f32],
    pub(super) classes: &'a mut [u8],
    pub(super) instances: &'a mut [u16],
}

impl Picture {
    /// Makes room, and cuts it into bands.
    pub(super) fn bands(&mut self, lens: &Lens, wanted: Wanted) -> Vec<Band<'_>> {
        (self.width, self.height) = (lens.width(), lens.height());
        let pixels = self.width as usize * self.height as usize;
        let room = |wanted: bool| if wanted { pixels } else { 0 };
        self.rgb.resize(3 * room(wanted.colour), 0);
        self.depth_m.resize(room(wanted.depth), 0.0);
        self.classes.resize(room(wanted.labels), 0);
        self.instances.resize(room(wanted.labels), 0);
        let band = (ROWS * self.width) as usize;
        let mut rgb = self.rgb.chunks_mut(3 * band);
        let mut depth_m = self.depth_m.chunks_mut(band);
        let mut classes = self.classes.chunks_mut(band);
        let mut instances = self.instances.chunks_mut(band);
        let starts = (0..self.height).step_by(ROWS as usize);
        let bands = starts.map(|first| Band {
            rows: first..(first + ROWS).min(self.height),
            rgb: rgb.next().unwrap_or_default(),
            depth_m: depth_m.next().unwrap_or_default(),
            classes: classes.next().unwrap_or_default(),
            instances: instances.next().unwrap_or_default(),
        });
        bands.collect()
    }
}

/// Does the bands with several threads, each its share in turn: neighbours take alike long.
pub(super) fn share<'a>(
    bands: Vec<Band<'_>>,
    threads: usize,
    work: impl Fn(&mut Band<'_>, &mut Scratch<'a>) + Sync,
) {
    let threads = threads.clamp(1, bands.len().max(1));
    let mut shares: Vec<Vec<Band<'_>>> = (0..threads).map(|_| Vec::new()).collect();
    for (number, band) in bands.into_iter().enumerate() {
        shares[number % threads].push(band);
    }
    let run = |share: Vec<Band<'_>>| {
        let mut scratch = Scratch::default();
        for mut band in share {
            work(&mut band, &mut scratch);
        }
    };
    let Some(own) = shares.pop() else { return };
    std::thread::scope(|scope| {
        for share in shares {
            scope.spawn(|| run(share));
        }
        run(own);
    });
}
