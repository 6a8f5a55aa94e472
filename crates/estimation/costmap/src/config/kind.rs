//! Plugin names of the layers.

use periplus_params::Table;

use crate::{UnknownPlugin, tables};

/// Type of a layer or filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerKind {
    /// Static layer: a map.
    Static,
    /// Obstacle layer: obstacles seen by sensors, in the plane.
    Obstacle,
    /// Voxel layer: obstacles seen by sensors, in columns of voxels.
    Voxel,
    /// Range sensor layer: sonar and infrared sensors.
    Range,
    /// Inflation layer: costs around obstacles.
    InflationSettings,
    /// Denoise layer: removes small obstacles.
    Denoise,
    /// Plugin container layer: layers with a separate grid.
    Container,
    /// Keepout filter: forbidden zones.
    Keepout,
    /// Speed filter: zones with speed limits.
    Speed,
    /// Binary filter: zones that switch a state.
    Binary,
}

const PLUGINS: [(&str, LayerKind); 11] = [
    ("nav2_costmap_2d::StaticLayer", LayerKind::Static),
    ("nav2_costmap_2d::ObstacleLayer", LayerKind::Obstacle),
    ("nav2_costmap_2d::VoxelLayer", LayerKind::Voxel),
    ("nav2_costmap_2d::RangeSensorLayer", LayerKind::Range),
    ("nav2_costmap_2d::InflationLayer", LayerKind::InflationSettings),
    ("nav2_costmap_2d::LegacyInflationLayer", LayerKind::InflationSettings),
    ("nav2_costmap_2d::DenoiseLayer", LayerKind::Denoise),
    ("nav2_costmap_2d::PluginContainerLayer", LayerKind::Container),
    ("nav2_costmap_2d::KeepoutFilter", LayerKind::Keepout),
    ("nav2_costmap_2d::SpeedFilter", LayerKind::Speed),
    ("nav2_costmap_2d::BinaryFilter", LayerKind::Binary),
];

/// Names in ROS 1, with those of Nav2.
const ROS1_PLUGINS: [(&str, &str); 6] = [
    ("costmap_2d::StaticLayer", "nav2_costmap_2d::StaticLayer"),
    ("costmap_2d::ObstacleLayer", "nav2_costmap_2d::ObstacleLayer"),
    ("costmap_2d::VoxelLayer", "nav2_costmap_2d::VoxelLayer"),
    ("costmap_2d::InflationLayer", "nav2_costmap_2d::InflationLayer"),
    ("range_sensor_layer::RangeSensorLayer", "nav2_costmap_2d::RangeSensorLayer"),
    ("costmap_2d::NonPersistentVoxelLayer", "nav2_costmap_2d::VoxelLayer"),
];

impl LayerKind {
    /// Returns the layer type of a plugin, and the current name of a plugin that is given by an old
    /// one.
    /// # Errors
    /// When the plugin is unknown.
    pub fn of_plugin(plugin: &str) -> Result<(Self, Option<&'static str>), UnknownPlugin> {
        let plugin = plugin.trim();
        let find = |name: &str| PLUGINS.iter().find(|(plugin, _)| *plugin == name);
        if let Some((_, kind)) = find(plugin) {
            return Ok((*kind, None));
        }
        // Older files have slashes instead of namespaces.
        let spelled = plugin.replace('/', "::");
        let modern =
            ROS1_PLUGINS.iter().find(|(old, _)| *old == spelled).map(|(_, modern)| *modern);
        let modern = modern.or_else(|| find(&spelled).map(|(name, _)| *name));
        match modern.and_then(find) {
            Some((name, kind)) => Ok((*kind, Some(name))),
            None => Err(UnknownPlugin(plugin.to_owned())),
        }
    }

    /// Iterates over the names of all plugins.
    pub fn plugins() -> impl Iterator<Item = &'static str> {
        PLUGINS.iter().map(|(plugin, _)| *plugin)
    }

    /// Returns the table of its parameters.
    #[must_use]
    pub fn table(self) -> &'static Table {
        match self {
            Self::Static => &tables::STATIC,
            Self::Obstacle => &tables::OBSTACLE,
            Self::Voxel => &tables::VOXEL,
            Self::Range => &tables::RANGE,
            Self::InflationSettings => &tables::INFLATION,
            Self::Denoise => &tables::DENOISE,
            Self::Container => &tables::CONTAINER,
            Self::Keepout => &tables::KEEPOUT,
            Self::Speed => &tables::SPEED,
            Self::Binary => &tables::BINARY,
        }
    }

    /// Returns true if the layer has observation sources.
    #[must_use]
    pub fn has_sources(self) -> bool {
        matches!(self, Self::Obstacle | Self::Voxel)
    }

    /// Returns true for costmap filters.
    #[must_use]
    pub fn is_filter(self) -> bool {
        matches!(self, Self::Keepout | Self::Speed | Self::Binary)
    }
}
