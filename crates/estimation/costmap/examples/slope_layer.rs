//! A custom layer: costs that rise towards the north of the costmap, which makes planners prefer
//! the south. Run it with `cargo run -p periplus-costmap --example slope_layer`.
#![allow(clippy::print_stdout, reason = "an example")]

use periplus_costmap::{
    CellWindow, Costmap, CostmapSettings, Layer, LayeredCostmap, NoTransforms, UpdateBounds,
    UpdateContext,
};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;

struct SlopeLayer {
    is_new: bool,
}

impl Layer for SlopeLayer {
    fn name(&self) -> &str {
        "slope_layer"
    }

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        // The whole grid changes once, and no cell afterwards.
        if std::mem::take(&mut self.is_new) {
            bounds.include(&UpdateBounds::of(&moment.info));
        }
    }

    fn costs(&mut self, moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        let rows = moment.info.height.max(1);
        for (row, span) in (window.y0..).zip(window.spans(moment.info.width)) {
            let cost = (100 * row / rows) as u8;
            for cell in &mut master.costs_mut()[span] {
                *cell = cost.max(*cell);
            }
        }
    }
}

fn main() {
    let info = GridInfo { resolution_m: 1.0, width: 8, height: 4, origin: Pose2::IDENTITY };
    let mut costmap = LayeredCostmap::new(CostmapSettings::default(), info);
    costmap.add_layer(Box::new(SlopeLayer { is_new: true }));
    costmap.update(0, Pose2::new(1.0, 1.0, 0.0), &NoTransforms);
    for row in costmap.costmap().costs().chunks(8).rev() {
        println!("{row:3?}");
    }
}
