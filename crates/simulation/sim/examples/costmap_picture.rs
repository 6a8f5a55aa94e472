//! The costmaps of the tutorial's robot, drawn side by side: `costmap_picture OUT.png`. The local and the
//! global one with the cube and the sphere, then both after the cube has gone.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a small program for people")]
#![allow(clippy::disallowed_methods, reason = "it reads a file and writes one")]

#[path = "../tests/costmaps/tutorial.rs"]
mod tutorial;

use periplus_costmap::cost::occupancy_of;
use periplus_graph::LifecycleNode;
use periplus_maps::palette::{Scheme, paint};
use periplus_nav_nodes::costmap_2d::CostmapNode;
use periplus_sim::PhysicsMode;

use tutorial::Run;

/// Length of a side of a panel; costmaps are drawn as large as fits.
const SIDE_PX: usize = 320;

/// Between panels.
const GAP_PX: usize = 16;

/// A picture in red, green and blue.
struct Sheet {
    width: usize,
    samples: Vec<u8>,
}

impl Sheet {
    fn new(panels: usize) -> Self {
        let width = panels * SIDE_PX + (panels - 1) * GAP_PX;
        Self { width, samples: vec![230; width * SIDE_PX * 3] }
    }

    /// Draws a costmap into the middle of a panel.
    fn draw(&mut self, panel: usize, node: &LifecycleNode<CostmapNode>) {
        node.with(|node| {
            let Some(costmap) = node.costmap() else { return };
            let grid = costmap.costmap();
            let (width, height) = (grid.info().width, grid.info().height);
            let pixels = SIDE_PX / width.max(height);
            let values: Vec<i8> = grid.costs().iter().map(|cost| occupancy_of(*cost)).collect();
            let picture = paint(&Scheme::Costmap.palette(), width, &values, pixels);
            let left = panel * (SIDE_PX + GAP_PX) + (SIDE_PX - width * pixels) / 2;
            let top = (SIDE_PX - height * pixels) / 2;
            for (row, line) in picture.chunks_exact(width * pixels * 3).enumerate() {
                let start = ((top + row) * self.width + left) * 3;
                self.samples[start..start + line.len()].copy_from_slice(line);
            }
        });
    }
}

fn main() {
    let Some(out) = std::env::args().nth(1) else {
        println!("usage: costmap_picture OUT.png");
        std::process::exit(2);
    };
    let mut sheet = Sheet::new(4);
    let mut run = Run::new(PhysicsMode::Rigid);
    run.go_on(4000);
    for (panel, node) in run.costmaps.iter().enumerate() {
        sheet.draw(panel, node);
    }
    assert!(run.simulation.delete("cube"));
    run.let_infinite_ranges_clear();
    run.go_on(3000);
    for (panel, node) in run.costmaps.iter().enumerate() {
        sheet.draw(2 + panel, node);
    }
    let file = std::fs::File::create(out).unwrap();
    let mut encoder =
        png::Encoder::new(std::io::BufWriter::new(file), sheet.width as u32, SIDE_PX as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&sheet.samples).unwrap();
}
