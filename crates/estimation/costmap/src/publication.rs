//! What to send to those who follow a costmap: all of it, or what has changed.
//!
//! Source: `nav2_costmap_2d/src/costmap_2d_publisher.cpp`.

use periplus_grid::GridInfo;

use crate::Window;

/// What has to be sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outgoing {
    /// Nothing has changed.
    Nothing,
    /// The whole grid.
    Full,
    /// This part of it.
    Update(Window),
}

/// What has been sent and what has changed since.
#[derive(Clone, Debug, Default)]
pub struct Publication {
    sent: Option<GridInfo>,
    changed: Window,
}

impl Publication {
    /// Nothing has been sent.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Cells have changed.
    pub fn changed(&mut self, window: Window) {
        self.changed = self.changed.union(&window);
    }

    /// What to send now; it counts as sent. The first time, and when the grid has moved or has other
    /// cells, it is all of it.
    pub fn next(&mut self, info: &GridInfo, always_full: bool) -> Outgoing {
        let changed = std::mem::take(&mut self.changed).intersection(&Window::all(info));
        if always_full || self.sent != Some(*info) {
            self.sent = Some(*info);
            return Outgoing::Full;
        }
        if changed.is_empty() { Outgoing::Nothing } else { Outgoing::Update(changed) }
    }

    /// The next one is full.
    pub fn start_over(&mut self) {
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
        let mut publication = Publication::new();
        assert_eq!(publication.next(&info, false), Outgoing::Full);
        assert_eq!(publication.next(&info, false), Outgoing::Nothing);
        publication.changed(Window { x0: 2, y0: 2, xn: 4, yn: 4 });
        publication.changed(Window { x0: 7, y0: 3, xn: 8, yn: 5 });
        let both = Window { x0: 2, y0: 2, xn: 8, yn: 5 };
        assert_eq!(publication.next(&info, false), Outgoing::Update(both));
        assert_eq!(publication.next(&info, true), Outgoing::Full);
        info.origin.x_m = 0.1;
        publication.changed(both);
        assert_eq!(publication.next(&info, false), Outgoing::Full, "it has moved");
        assert_eq!(publication.next(&info, false), Outgoing::Nothing);
    }
}
