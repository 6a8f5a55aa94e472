//! Choice between full publication and update messages of a costmap.
//!
//! Source: `nav2_costmap_2d/src/costmap_2d_publisher.cpp`.

use periplus_grid::GridInfo;

use crate::CellWindow;

/// Message to publish.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CostmapMessage {
    /// No message: no cell has changed.
    Nothing,
    /// The whole grid.
    Full,
    /// The given part of the grid.
    Update(CellWindow),
}

/// State of the publication: last grid and changes since.
#[derive(Clone, Debug, Default)]
pub struct PublicationState {
    sent: Option<GridInfo>,
    changed: CellWindow,
}

impl PublicationState {
    /// Creates the state before the first publication.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds changed cells.
    pub fn changed(&mut self, window: CellWindow) {
        self.changed = self.changed.union(&window);
    }

    /// Returns the message to publish now and marks it as sent. The first message, and the first
    /// after the grid has moved or was resized, is the whole grid.
    pub fn next(&mut self, info: &GridInfo, always_full: bool) -> CostmapMessage {
        let changed = std::mem::take(&mut self.changed).intersection(&CellWindow::all(info));
        if always_full || self.sent != Some(*info) {
            self.sent = Some(*info);
            return CostmapMessage::Full;
        }
        if changed.is_empty() { CostmapMessage::Nothing } else { CostmapMessage::Update(changed) }
    }

    /// Makes the next message the whole grid.
    pub fn request_full(&mut self) {
        self.sent = None;
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;

    #[test]
    fn one_full_grid_and_then_what_has_changed() {
        let mut info = GridInfo::new(0.1, 10, 10, Pose2::IDENTITY).unwrap();
        let mut publication = PublicationState::new();
        assert_eq!(publication.next(&info, false), CostmapMessage::Full);
        assert_eq!(publication.next(&info, false), CostmapMessage::Nothing);
        publication.changed(CellWindow { x0: 2, y0: 2, xn: 4, yn: 4 });
        publication.changed(CellWindow { x0: 7, y0: 3, xn: 8, yn: 5 });
        let both = CellWindow { x0: 2, y0: 2, xn: 8, yn: 5 };
        assert_eq!(publication.next(&info, false), CostmapMessage::Update(both));
        assert_eq!(publication.next(&info, true), CostmapMessage::Full);
        info.origin.x_m = 0.1;
        publication.changed(both);
        assert_eq!(publication.next(&info, false), CostmapMessage::Full, "it has moved");
        assert_eq!(publication.next(&info, false), CostmapMessage::Nothing);
    }
}
