//! Construction of layers from a configuration.

use periplus_params::ParamValues;

use super::{CostmapConfig, LayerConfig, LayerKind, SourceConfig, footprint_of, grid_info_of};
use crate::filters::{BinaryFilter, KeepoutFilter, SpeedFilter};
use crate::layers::{
    ContainerLayer, DenoiseLayer, InflationLayer, MapMeaning, ObstacleLayer, RangeLayer,
    StaticLayer, VoxelLayer,
};
use crate::tables::CostmapParams;
use crate::{ChangeError, Layer, LayeredCostmap, Nav2Release, ObservationSource, TransformSource};

impl CostmapConfig {
    /// Creates the costmap.
    #[must_use]
    pub fn build(&self) -> LayeredCostmap {
        let mut costmap = LayeredCostmap::new(self.frame(), self.info());
        for layer in &self.layers {
            costmap.add_layer(self.build_layer(layer));
        }
        for filter in &self.filters {
            costmap.add_filter(self.build_layer(filter));
        }
        costmap.set_footprint(self.footprint.clone());
        costmap
    }

    /// Creates one layer of the configuration, for a costmap that also has layers of other programs.
    #[must_use]
    pub fn build_layer(&self, config: &LayerConfig) -> Box<dyn Layer> {
        let tracks_unknown = self.params().track_unknown_space;
        let name = config.name.clone();
        let values = config.values.clone();
        let sources = || {
            let source = |one: &SourceConfig| {
                ObservationSource::new(&one.name, one.values.clone()).with_compat(self.compat)
            };
            config.sources.iter().map(source).collect()
        };
        match config.kind {
            LayerKind::Static => {
                let meaning = MapMeaning::read(&self.node, self.compat);
                Box::new(StaticLayer::new(name, values, meaning, self.compat))
            }
            LayerKind::Obstacle => {
                Box::new(ObstacleLayer::new(name, values, tracks_unknown, sources()))
            }
            LayerKind::Voxel => Box::new(VoxelLayer::new(name, values, tracks_unknown, sources())),
            LayerKind::Range => Box::new(RangeLayer::new(name, values)),
            LayerKind::InflationSettings => {
                Box::new(InflationLayer::new(name, values, self.compat))
            }
            LayerKind::Denoise => Box::new(DenoiseLayer::new(name, values)),
            LayerKind::Container => {
                let children =
                    config.children.iter().map(|child| self.build_layer(child)).collect();
                Box::new(ContainerLayer::new(name, values, children))
            }
            LayerKind::Keepout => Box::new(KeepoutFilter::new(name, values)),
            LayerKind::Speed => Box::new(SpeedFilter::new(name, values)),
            LayerKind::Binary => Box::new(BinaryFilter::new(name, values)),
        }
    }

    /// Applies changed node parameters to a running costmap. Types and ranges are already checked.
    /// `robot_base_frame` may only become a frame that has a transform in `frames`.
    /// # Errors
    /// The reason for which a parameter cannot change; no change is made then.
    pub fn change(
        &mut self,
        costmap: &mut LayeredCostmap,
        values: ParamValues,
        frames: &dyn TransformSource,
    ) -> Result<(), ChangeError> {
        refuse(&self.node, &values, self.compat)?;
        refuse_lost_robot(&self.node, &values, frames)?;
        let is_other =
            |names: &[&str]| names.iter().any(|name| values.get(name) != self.node.get(name));
        let has_outline = is_other(&["footprint", "robot_radius", "footprint_padding"]);
        let has_size = is_other(&["resolution", "width", "height", "origin_x", "origin_y"]);
        if has_outline {
            let footprint = footprint_of(&CostmapParams::from_values(&values))
                .map_err(ChangeError::Footprint)?;
            self.footprint =
                footprint.padded(CostmapParams::from_values(&values).footprint_padding_m);
            costmap.set_footprint(self.footprint.clone());
        }
        if has_size && !costmap.is_size_locked() {
            costmap.resize(grid_info_of(&CostmapParams::from_values(&values)), false);
        }
        self.node = values;
        Ok(())
    }
}

/// A base frame without a transform would stop all updates.
fn refuse_lost_robot(
    before: &ParamValues,
    after: &ParamValues,
    frames: &dyn TransformSource,
) -> Result<(), ChangeError> {
    let CostmapParams { robot_base_frame: base, global_frame: global, .. } =
        CostmapParams::from_values(after);
    let kept = CostmapParams::from_values(before).robot_base_frame;
    if kept == base || frames.latest(&global, &base).is_some() {
        return Ok(());
    }
    Err(ChangeError::NoRobotTransform { base, global, kept })
}

/// Parameters that cannot change while the costmap runs.
const FIXED_PARAMETERS: [&str; 8] = [
    "plugins",
    "filters",
    "global_frame",
    "rolling_window",
    "track_unknown_space",
    "compat",
    "trinary_costmap",
    "use_maximum",
];

/// Rejects changes that are not possible while the costmap runs.
fn refuse(
    before: &ParamValues,
    after: &ParamValues,
    compat: Nav2Release,
) -> Result<(), ChangeError> {
    for name in FIXED_PARAMETERS {
        if before.get(name) != after.get(name) {
            return Err(ChangeError::Fixed(name));
        }
    }
    // At startup any value is allowed; 0 or less means never.
    let publish_hz = CostmapParams::from_values(after).publish_frequency_hz;
    if compat.refuses_to_stop_publishing()
        && CostmapParams::from_values(before).publish_frequency_hz != publish_hz
        && publish_hz <= 0.0
    {
        return Err(ChangeError::PublishFrequency);
    }
    Ok(())
}
