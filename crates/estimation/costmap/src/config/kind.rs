//! Which plugin is which layer.

use periplus_params::Table;

use crate::tables;

/// What a layer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerKind {
    /// A map.
    Static,
    /// What sensors see, on the ground.
    Obstacle,
    /// What sensors see, in columns of voxels.
    Voxel,
    /// Sonars.
    Range,
    /// Costs around obstacles.
    Inflation,
    /// Takes out small obstacles.
    Denoise,
    /// Layers with a grid of their own.
    Container,
    /// Where not to go.
    Keepout,
    /// Where to go slowly.
    Speed,
    /// Where something is to be switched.
    Binary,
}

const PLUGINS: [(&str, LayerKind); 11] = [
    ("nav2_costmap_2d::StaticLayer", LayerKind::Static),
    ("nav2_costmap_2d::ObstacleLayer", LayerKind::Obstacle),
    ("nav2_costmap_2d::VoxelLayer", LayerKind::Voxel),
    ("nav2_costmap_2d::RangeSensorLayer", LayerKind::Range),
    ("nav2_costmap_2d::InflationLayer", LayerKind::Inflation),
    ("nav2_costmap_2d::LegacyInflationLayer", LayerKind::Inflation),
    ("nav2_costmap_2d::DenoiseLayer", LayerKind::Denoise),
    ("nav2_costmap_2d::PluginContainerLayer", LayerKind::Container),
    ("nav2_costmap_2d::KeepoutFilter", LayerKind::Keepout),
    ("nav2_costmap_2d::SpeedFilter", LayerKind::Speed),
    ("nav2_costmap_2d::BinaryFilter", LayerKind::Binary),
];

/// As they were called in ROS 1.
const ROS1: [(&str, &str); 6] = [
    ("costmap_2d::StaticLayer", "nav2_costmap_2d::StaticLayer"),
    ("costmap_2d::ObstacleLayer", "nav2_costmap_2d::ObstacleLayer"),
    ("costmap_2d::VoxelLayer", "nav2_costmap_2d::VoxelLayer"),
    ("costmap_2d::InflationLayer", "nav2_costmap_2d::InflationLayer"),
    ("range_sensor_layer::RangeSensorLayer", "nav2_costmap_2d::RangeSensorLayer"),
    ("costmap_2d::NonPersistentVoxelLayer", "nav2_costmap_2d::VoxelLayer"),
];

impl LayerKind {
    /// The layer that a plugin is. With it, Nav2's name of a plugin that is called otherwise.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn of_plugin(plugin: &str) -> Result<(Self, Option<&'static str>), String> {
        let plugin = plugin.trim();
        let find = |name: &str| PLUGINS.iter().find(|(plugin, _)| *plugin == name);
        if let Some((_, kind)) = find(plugin) {
            return Ok((*kind, None));
        }
        // With slashes they were written before Nav2 had namespaces there.
        let spelled = plugin.replace('/', "::");
        let modern = ROS1.iter().find(|(old, _)| *old == spelled).map(|(_, modern)| *modern);
        let modern = modern.or_else(|| find(&spelled).map(|(name, _)| *name));
        match modern.and_then(find) {
            Some((name, kind)) => Ok((*kind, Some(name))),
            None => Err(format!("`{plugin}` is no layer that is known here")),
        }
    }

    /// The names of all plugins.
    pub fn plugins() -> impl Iterator<Item = &'static str> {
        PLUGINS.iter().map(|(plugin, _)| *plugin)
    }

    /// Its parameters.
    #[must_use]
    pub fn table(self) -> &'static Table {
        match self {
            Self::Static => &tables::STATIC,
            Self::Obstacle => &tables::OBSTACLE,
            Self::Voxel => &tables::VOXEL,
            Self::Range => &tables::RANGE,
            Self::Inflation => &tables::INFLATION,
            Self::Denoise => &tables::DENOISE,
            Self::Container => &tables::CONTAINER,
            Self::Keepout => &tables::KEEPOUT,
            Self::Speed => &tables::SPEED,
            Self::Binary => &tables::BINARY,
        }
    }

    /// Whether it looks through sources.
    #[must_use]
    pub fn has_sources(self) -> bool {
        matches!(self, Self::Obstacle | Self::Voxel)
    }

    /// Whether it follows a mask.
    #[must_use]
    pub fn is_filter(self) -> bool {
        matches!(self, Self::Keepout | Self::Speed | Self::Binary)
    }
}
