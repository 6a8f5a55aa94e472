//! Costmaps in simulations and on ROS 2: `periplus sim --costmap`, `periplus costmap` and `periplus
//! doctor costmap`.

pub(crate) mod doctor;
pub(crate) mod serve;

use std::path::PathBuf;

use clap::Args;
use periplus_costmap::Nav2Release;
use periplus_session::nodes::{CostmapRequest, CostmapSource, FloorPoint};

/// Costmap options of `periplus sim`.
#[derive(Debug, Args)]
pub(crate) struct CostmapOptions {
    /// Run the costmaps of a Nav2 parameter file beside the robot: `local_costmap` and
    /// `global_costmap`, if the file has them
    #[arg(long, value_name = "nav2_params.yaml")]
    costmap: Option<PathBuf>,
    /// At the end explain why the cell at this position is marked or free, for each costmap, in its
    /// frame [m]
    #[arg(long, value_name = "X,Y", value_parser = floor_point, allow_hyphen_values = true, requires = "costmap")]
    costmap_cell: Vec<FloorPoint>,
    /// At the end write each costmap to a folder as images in RViz's colours: costmap, map and raw
    #[arg(long, value_name = "FOLDER", requires = "costmap")]
    costmap_picture: Option<PathBuf>,
    /// Release of Nav2 whose behaviour is reproduced where releases differ
    #[arg(long, value_name = "humble|jazzy|main", requires = "costmap")]
    costmap_compat: Option<Nav2Release>,
}

fn floor_point(word: &str) -> Result<FloorPoint, String> {
    let (x, y) = word.split_once(',').ok_or("give two numbers, such as `1.5,-0.2`")?;
    let number = |word: &str| {
        let number: Option<f64> = word.trim().parse().ok().filter(|it: &f64| it.is_finite());
        number.ok_or_else(|| format!("`{word}` is not a number"))
    };
    Ok(FloorPoint { x_m: number(x)?, y_m: number(y)? })
}

impl CostmapOptions {
    /// Requested costmaps.
    pub(crate) fn request(&self) -> Option<CostmapRequest> {
        Some(CostmapRequest {
            source: CostmapSource::File(self.costmap.clone()?, self.costmap_compat),
            cells: self.costmap_cell.clone(),
            images: self.costmap_picture.clone(),
        })
    }
}
