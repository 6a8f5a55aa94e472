//! The whole of a large map.

use std::path::Path;
use std::process::Command;

use periplus_costmap::inflation::{CostTable, InflationBuffers, InflationSettings, inflate};
use periplus_costmap::{CellWindow, Costmap, Nav2Release};
use periplus_geometry::{Pose2, Stream};
use periplus_grid::GridInfo;

use super::{Row, fastest, number, seconds, wavefront};

const SIDE: usize = 4000;
const RESOLUTION_M: f64 = 0.05;
const RADIUS_M: f64 = 0.55;
const TURNS: usize = 7;
const WAVEFRONT_TURNS: usize = 3;

pub(super) fn run(python: &Path, script: &Path, work: &Path) -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (name, cells) in [("a building", building()), ("1 % noise", noise())] {
        let name = format!("inflate 4000 x 4000, {name}");
        let table = CostTable::new(RESOLUTION_M, RADIUS_M, 0.2, 3.0, Nav2Release::Main);
        let mut row = |who: &str, seconds: f64| {
            rows.push(Row { work: name.clone(), who: who.to_owned(), seconds });
        };
        let info = GridInfo {
            resolution_m: RESOLUTION_M,
            width: SIDE,
            height: SIDE,
            origin: Pose2::IDENTITY,
        };
        let mut ours = Costmap::new(info, 0);
        let mut scratch = InflationBuffers::default();
        let taken = fastest(TURNS, || {
            ours.costs_mut().copy_from_slice(&cells);
            let all = CellWindow::all(&info);
            seconds(|| inflate(&mut ours, &all, &table, InflationSettings::default(), &mut scratch))
        });
        row("Periplus", taken);
        let mut theirs = cells.clone();
        let taken = fastest(WAVEFRONT_TURNS, || {
            theirs.copy_from_slice(&cells);
            seconds(|| wavefront::inflate(&mut theirs, SIDE, table.costs()))
        });
        row("wavefront, bins", taken);
        let differing = theirs.iter().zip(ours.costs()).filter(|(a, b)| a != b).count();
        if differing * 100 > cells.len() {
            return Err(format!("wavefront: {differing} cells differ from ours"));
        }
        let file = work.join("cells.bin");
        std::fs::write(&file, &cells).map_err(|error| format!("{}: {error}", file.display()))?;
        match opencv(python, script, &file) {
            Some([transform, whole]) => {
                row("OpenCV, distanceTransform alone", transform);
                row("OpenCV and NumPy, to costs", whole);
            }
            None => eprintln!(
                "SKIPPED: OpenCV; `pip install opencv-python-headless numpy` and name that python in PERIPLUS_PYTHON"
            ),
        }
    }
    Ok(rows)
}

fn opencv(python: &Path, script: &Path, cells: &Path) -> Option<[f64; 2]> {
    let output = Command::new(python).arg(script).arg(cells).arg(SIDE.to_string()).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().last()?;
    Some([number(line, "transform")?, number(line, "whole")?])
}

/// Rooms of 4 to 12 m with walls 0.15 m thick, doors, and furniture.
fn building() -> Vec<u8> {
    let mut random = Stream::keyed(7, "building", 0);
    let mut cells = vec![0; SIDE * SIDE];
    let mut wall = |x0: usize, y0: usize, width: usize, height: usize| {
        for y in y0..(y0 + height).min(SIDE) {
            cells[y * SIDE + x0.min(SIDE)..y * SIDE + (x0 + width).min(SIDE)].fill(254);
        }
    };
    let mut between =
        |low: u32, high: u32| (low + (random.unit() * f64::from(high - low)) as u32) as usize;
    let mut y = 0;
    while y < SIDE {
        let depth = between(80, 240);
        let mut x = 0;
        while x < SIDE {
            let length = between(80, 240);
            let door = between(10, 60);
            wall(x, y, door, 3);
            wall(x + door + 20, y, length.saturating_sub(door + 20), 3);
            wall(x, y, 3, depth.saturating_sub(door + 20));
            for _ in 0..4 {
                wall(x + between(8, 70), y + between(8, 70), between(4, 20), between(4, 20));
            }
            x += length;
        }
        y += depth;
    }
    cells
}

fn noise() -> Vec<u8> {
    let mut random = Stream::keyed(7, "noise", 0);
    (0..SIDE * SIDE).map(|_| if random.unit() < 0.01 { 254 } else { 0 }).collect()
}
