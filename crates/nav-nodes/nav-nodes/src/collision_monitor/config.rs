//! Zones and sources with their parameters.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_motion::tables::{
    COLLISION_DETECTOR, COLLISION_MONITOR, EXCLUSION_ZONE, MONITOR_SOURCE, MONITOR_ZONE,
    MonitorCommonParams, MonitorSourceParams, MonitorZoneParams, VELOCITY_PART,
};
use periplus_params::{Given, ParamChoice, ParamValue, ParamValues, Params as _, Table};

use crate::costmap_2d::split;
use crate::parameter_groups::ParameterGroups;

/// Configuration of a zone.
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorZoneConfig {
    /// Name.
    pub name: String,
    /// Parameters, from [`MONITOR_ZONE`].
    pub values: ParamValues,
    /// Names and parameters of the parts of a velocity polygon, from [`VELOCITY_PART`].
    pub parts: Vec<(String, ParamValues)>,
}

/// Configuration of a source.
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorSourceConfig {
    /// Name.
    pub name: String,
    /// Parameters, from [`MONITOR_SOURCE`].
    pub values: ParamValues,
    /// Names and parameters of its exclusion zones, from [`EXCLUSION_ZONE`].
    pub exclusions: Vec<(String, ParamValues)>,
}

/// Configuration of a collision monitor or detector.
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorConfig {
    /// Parameters of the node, from [`COLLISION_MONITOR`] or [`COLLISION_DETECTOR`].
    pub node: ParamValues,
    /// Zones, in order.
    pub zones: Vec<MonitorZoneConfig>,
    /// Sources.
    pub sources: Vec<MonitorSourceConfig>,
}

impl MonitorConfig {
    /// Reads the parameters of a collision monitor, given as names with dots, such as
    /// `PolygonStop.action_type`, and texts. `compat` overrides the parameter of that name.
    pub fn read_monitor<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        compat: Option<Nav2Release>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        Self::read(&COLLISION_MONITOR, given, compat, diagnostics)
    }

    /// Reads the parameters of a collision detector.
    pub fn read_detector<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        compat: Option<Nav2Release>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        Self::read(&COLLISION_DETECTOR, given, compat, diagnostics)
    }

    fn read<'a>(
        table: &'static Table,
        given: impl IntoIterator<Item = Given<'a>>,
        compat: Option<Nav2Release>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let mut groups = ParameterGroups::new(given, diagnostics);
        let mut node = groups.node_values(table);
        if let Some(compat) = compat {
            node.set("compat", ParamValue::Text(compat.word().to_owned()));
        }
        let at = node.origin("polygons");
        let zone = |name: String| {
            let values = groups.group_values(&MONITOR_ZONE, &name, at);
            let origin = values.origin("velocity_polygons");
            let parts = values.texts("velocity_polygons");
            let part = |part: String| {
                let group = format!("{name}.{part}");
                let values = groups.group_values(&VELOCITY_PART, &group, origin);
                (part, values)
            };
            let parts = parts.into_iter().map(part).collect();
            MonitorZoneConfig { name, values, parts }
        };
        let zones = node.texts("polygons").into_iter().map(zone).collect();
        let at = node.origin("observation_sources");
        let source = |name: String| {
            let values = groups.group_values(&MONITOR_SOURCE, &name, at);
            let origin = values.origin("exclusion_zones");
            let exclusion = |name: String| {
                let values = groups.group_values(&EXCLUSION_ZONE, &name, origin);
                (name, values)
            };
            let exclusions = values.texts("exclusion_zones").into_iter().map(exclusion).collect();
            MonitorSourceConfig { name, values, exclusions }
        };
        let sources = node.texts("observation_sources").into_iter().map(source).collect();
        groups.finish();
        Self { node, zones, sources }
    }

    /// Parameters that monitor and detector share.
    #[must_use]
    pub fn common(&self) -> MonitorCommonParams {
        MonitorCommonParams::from_values(&self.node)
    }

    /// All parameters, with names such as `PolygonStop.action_type`.
    #[must_use]
    pub fn values(&self) -> ParamValues {
        let mut values = self.node.clone();
        for zone in &self.zones {
            values.add_group(&zone.name, zone.values.clone());
            for (part, part_values) in &zone.parts {
                values.add_group(format!("{}.{part}", zone.name), part_values.clone());
            }
        }
        for source in &self.sources {
            values.add_group(&source.name, source.values.clone());
            for (name, zone_values) in &source.exclusions {
                values.add_group(name, zone_values.clone());
            }
        }
        values
    }

    /// Copies values of [`Self::values`] that were changed.
    pub(super) fn adopt(&mut self, all: &ParamValues) {
        self.node = split(all, "", &self.node);
        for zone in &mut self.zones {
            zone.values = split(all, &zone.name, &zone.values);
            for (part, values) in &mut zone.parts {
                *values = split(all, &format!("{}.{part}", zone.name), values);
            }
        }
        for source in &mut self.sources {
            source.values = split(all, &source.name, &source.values);
            for (name, values) in &mut source.exclusions {
                *values = split(all, name, values);
            }
        }
    }
}

impl MonitorZoneConfig {
    /// Parameters of the zone.
    #[must_use]
    pub fn params(&self) -> MonitorZoneParams {
        MonitorZoneParams::from_values(&self.values)
    }
}

impl MonitorSourceConfig {
    /// Parameters of the source.
    #[must_use]
    pub fn params(&self) -> MonitorSourceParams {
        MonitorSourceParams::from_values(&self.values)
    }
}
