//! Maps from scans at known places.

use periplus_base::Pose2;
use periplus_grid::{Grid, Lattice, Line, OccupancyGrid, occupancy};
use periplus_matching::PackedPlaces;

use crate::key::Key;

/// What a beam that passes a cell, and one that ends in it, say of it: log odds in hundredths, for
/// chances of 0.4 and 0.75; sums end at +-4, so that a cell that changed is learnt anew.
const MISS: i16 = -41;
const HIT: i16 = 110;
const LIMIT: i16 = 400;
/// Cells beyond a map's edge \[cells\].
const MARGIN: f64 = 4.0;
/// Neither seen nor passed.
const UNSEEN: i16 = i16::MIN;

/// Scans at their places at one moment. It can be drawn somewhere else while the map grows on; the
/// scans themselves are shared.
#[derive(Clone, Debug, Default)]
pub struct Sketch {
    scans: Vec<Drawn>,
    resolution_m: f64,
}

#[derive(Clone, Debug)]
struct Drawn {
    key: Key,
    map_from_key: Pose2,
}

impl Drawn {
    /// Ends of beams, in the frame of the key.
    fn ends(&self) -> &PackedPlaces {
        self.key.ends.as_deref().unwrap_or(self.key.cloud.places())
    }
}

impl Sketch {
    pub(crate) fn new(keys: &[Key], poses: &[Pose2], resolution_m: f64) -> Self {
        let drawn = |(key, &map_from_key): (&Key, &Pose2)| Drawn { key: key.clone(), map_from_key };
        Self { scans: keys.iter().zip(poses).map(drawn).collect(), resolution_m }
    }

    /// The map; none when it would be too large to hold.
    #[must_use]
    pub fn draw(&self) -> Option<OccupancyGrid> {
        draw(&self.scans, self.resolution_m)
    }
}

/// Draws scans at their places: cells that beams passed are free, those where they ended occupied.
/// Within a scan a cell where a beam ends is not passed by others. None when the map would be too
/// large to hold.
fn draw(scans: &[Drawn], resolution_m: f64) -> Option<OccupancyGrid> {
    let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
    let mut include = |x: f64, y: f64| {
        low = [low[0].min(x), low[1].min(y)];
        high = [high[0].max(x), high[1].max(y)];
    };
    for scan in scans {
        let pose = scan.map_from_key;
        include(pose.x_m, pose.y_m);
        for end in scan.ends().iter() {
            let (x, y) = pose.transform_point(end[0].into(), end[1].into());
            include(x, y);
        }
    }
    if scans.is_empty() {
        (low, high) = ([0.0; 2], [0.0; 2]);
    }
    // Corners at whole cells, so that the same place has the same cell in every run.
    let corner = low.map(|low| ((low / resolution_m).floor() - MARGIN) * resolution_m);
    let cells = |axis: usize| {
        ((high[axis] - corner[axis]) / resolution_m + MARGIN).ceil().max(1.0) as usize
    };
    let origin = Pose2::new(corner[0], corner[1], 0.0);
    let lattice = Lattice::new(resolution_m, cells(0), cells(1), origin).ok()?;
    let finder = lattice.finder();
    let mut odds: Grid<i16> = Grid::new(lattice, UNSEEN);
    let mut stamp: Grid<u32> = Grid::new(lattice, 0);
    for (number, scan) in scans.iter().enumerate() {
        let (pose, [x, y]) = (scan.map_from_key, scan.key.cloud.places().middle());
        let (x, y) = pose.transform_point(x.into(), y.into());
        let Some(start) = finder.cell_of(x, y) else { continue };
        let (s, c) = libm::sincos(pose.yaw_rad);
        let ends: Vec<_> = scan
            .ends()
            .iter()
            .filter_map(|end| {
                let (x, y) = (f64::from(end[0]), f64::from(end[1]));
                finder.cell_of(c * x - s * y + pose.x_m, s * x + c * y + pose.y_m)
            })
            .collect();
        // 2 n + 1: an end of scan n; 2 n: passed by it.
        let ended = 2 * number as u32 + 3;
        for &end in &ends {
            let index = lattice.index(end);
            if stamp.cells[index] != ended {
                stamp.cells[index] = ended;
                vote(&mut odds.cells[index], HIT);
            }
        }
        for &end in &ends {
            for cell in Line::between(start, end) {
                let index = lattice.index(cell);
                if stamp.cells[index] < ended - 1 {
                    stamp.cells[index] = ended - 1;
                    vote(&mut odds.cells[index], MISS);
                }
            }
        }
    }
    Some(odds.map(|&value| match value {
        UNSEEN => occupancy::UNKNOWN,
        value => {
            let chance = 1.0 / (1.0 + libm::exp(-f64::from(value) / 100.0));
            (100.0 * chance + 0.5) as i8
        }
    }))
}

fn vote(cell: &mut i16, by: i16) {
    let before = if *cell == UNSEEN { 0 } else { *cell };
    *cell = (before + by).clamp(-LIMIT, LIMIT);
}
