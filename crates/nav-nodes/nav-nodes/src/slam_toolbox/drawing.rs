//! Rasterization of maps: at once in lockstep, on a separate thread when live.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use periplus_grid::OccupancyGrid;

use crate::slam_toolbox::engine::Drawing;

/// Draws maps.
pub(crate) struct Drawer {
    is_beside: bool,
    drawn: Option<Receiver<Option<OccupancyGrid>>>,
}

impl Drawer {
    pub(crate) fn new(is_beside: bool) -> Self {
        Self { is_beside, drawn: None }
    }

    /// True while a map is being rasterized.
    pub(crate) fn is_busy(&self) -> bool {
        self.drawn.is_some()
    }

    /// Begins to draw.
    pub(crate) fn begin(&mut self, drawing: Drawing) {
        let (give, take) = channel();
        self.drawn = Some(take);
        let draw = move || {
            let map = match drawing {
                Drawing::MapSnapshot(snapshot) => snapshot.draw(),
                Drawing::Map(map) => map,
            };
            // The receiver may be gone.
            let _ = give.send(map);
        };
        // WebAssembly has no threads.
        if self.is_beside && !cfg!(target_family = "wasm") {
            let thread = std::thread::Builder::new().name("map".to_owned());
            // Without a thread the map is not drawn this time.
            let _ = thread.spawn(draw);
        } else {
            draw();
        }
    }

    /// The map, when it is drawn; none inside when it would be too large.
    pub(crate) fn take(&mut self) -> Option<Option<OccupancyGrid>> {
        match self.drawn.as_ref()?.try_recv() {
            Ok(map) => {
                self.drawn = None;
                Some(map)
            }
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                self.drawn = None;
                None
            }
        }
    }

    /// Drops the map that is being rasterized.
    pub(crate) fn forget(&mut self) {
        self.drawn = None;
    }
}
