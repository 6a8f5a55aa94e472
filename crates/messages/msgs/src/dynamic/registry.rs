//! Registry of types.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, OnceLock};

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_rosidl::{InterfaceDialect, Registry, TypeName, parse};

use super::layout::{self, Layout};

/// Types by name, with their layouts.
#[derive(Debug, Default)]
pub struct TypeRegistry {
    registry: Registry,
    types: BTreeMap<String, (Arc<Layout>, OnceLock<Option<String>>)>,
}

impl TypeRegistry {
    /// Creates the layouts of the types. Unusable types (see [`Registry::check`]) are left out, and the
    /// findings give the reasons.
    #[must_use]
    pub fn new(mut registry: Registry, diagnostics: &mut Diagnostics) -> Self {
        registry.check(diagnostics);
        let layouts = layout::all(&registry).into_iter();
        let types = layouts.map(|(name, layout)| (name, (layout, OnceLock::new()))).collect();
        Self { registry, types }
    }

    /// Types that a schema defines: the text of a type and of all types that it needs, as bags and connections have it.
    /// Faults show as unknown types.
    #[must_use]
    pub fn of_schema(type_name: &str, text: &str, dialect: InterfaceDialect) -> Self {
        let mut registry = Registry::new();
        let mut findings = Diagnostics::new();
        if let Some(name) = TypeName::read(type_name) {
            let mut sources = SourceMap::new();
            let file = sources.add(format!("schema of {type_name}"), text);
            registry.add_schema(&name, file, &sources, dialect, &mut findings);
        }
        Self::new(registry, &mut findings)
    }

    /// Types of this crate.
    #[must_use]
    pub fn builtin() -> &'static Self {
        static BUILTIN: LazyLock<TypeRegistry> = LazyLock::new(|| {
            let mut diagnostics = Diagnostics::new();
            let types = TypeRegistry::new(builtin_texts(&mut diagnostics), &mut diagnostics);
            debug_assert!(diagnostics.is_empty(), "{diagnostics:?}");
            types
        });
        &BUILTIN
    }

    /// Types of this crate as in ROS 1 Noetic; others as in ROS 2.
    #[must_use]
    pub fn ros1() -> &'static Self {
        static ROS1: LazyLock<TypeRegistry> = LazyLock::new(|| {
            let mut diagnostics = Diagnostics::new();
            let mut registry = TypeRegistry::builtin_texts();
            for (name, text) in ROS1_TEXTS {
                let Some(name) = TypeName::read(name) else { continue };
                let mut sources = SourceMap::new();
                let file = sources.add(name.to_string(), text);
                let text = parse(&name, file, &sources, InterfaceDialect::Ros1, &mut diagnostics);
                text.into_iter().for_each(|interface| registry.add(interface));
            }
            let types = TypeRegistry::new(registry, &mut diagnostics);
            debug_assert!(diagnostics.is_empty(), "{diagnostics:?}");
            types
        });
        &ROS1
    }

    /// Interface texts of this crate, for adding further ones.
    #[must_use]
    pub fn builtin_texts() -> Registry {
        Self::builtin().registry.clone()
    }

    /// Type by its full name.
    #[must_use]
    pub fn layout(&self, type_name: &str) -> Option<&Arc<Layout>> {
        self.types.get(type_name).map(|(layout, _)| layout)
    }

    /// Schema text of a type, for MCAP's `ros2msg`.
    #[must_use]
    pub fn schema_text(&self, type_name: &str) -> Option<&str> {
        let (_, text) = self.types.get(type_name)?;
        let make = || self.registry.schema_text(&TypeName::read(type_name)?);
        text.get_or_init(make).as_deref()
    }

    /// Type hash of a type.
    #[must_use]
    pub fn hash(&self, type_name: &str) -> Option<String> {
        self.registry.hash(&TypeName::read(type_name)?)
    }

    /// Interface definitions.
    #[must_use]
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// Full names of all types, sorted.
    pub fn type_names(&self) -> impl Iterator<Item = &str> {
        self.types.keys().map(String::as_str)
    }
}

/// Types of ROS 1 Noetic with different fields, names or constants, or without equivalent in ROS 2.
const ROS1_TEXTS: [(&str, &str); 8] = [
    ("rosgraph_msgs/Log", include_str!("../../interfaces_ros1/rosgraph_msgs/Log.msg")),
    (
        "sensor_msgs/BatteryState",
        include_str!("../../interfaces_ros1/sensor_msgs/BatteryState.msg"),
    ),
    ("sensor_msgs/CameraInfo", include_str!("../../interfaces_ros1/sensor_msgs/CameraInfo.msg")),
    (
        "sensor_msgs/NavSatStatus",
        include_str!("../../interfaces_ros1/sensor_msgs/NavSatStatus.msg"),
    ),
    ("sensor_msgs/Range", include_str!("../../interfaces_ros1/sensor_msgs/Range.msg")),
    (
        "shape_msgs/SolidPrimitive",
        include_str!("../../interfaces_ros1/shape_msgs/SolidPrimitive.msg"),
    ),
    (
        "visualization_msgs/ImageMarker",
        include_str!("../../interfaces_ros1/visualization_msgs/ImageMarker.msg"),
    ),
    (
        "visualization_msgs/Marker",
        include_str!("../../interfaces_ros1/visualization_msgs/Marker.msg"),
    ),
];

fn builtin_texts(diagnostics: &mut Diagnostics) -> Registry {
    let mut registry = Registry::new();
    let mut sources = SourceMap::new();
    for (path, text) in crate::generated::SOURCES {
        let stem = path.rsplit_once('.').map_or(*path, |(stem, _)| stem);
        let Some(name) = TypeName::read(stem) else { continue };
        let file = sources.add(*path, *text);
        if let Some(interface) = parse(&name, file, &sources, InterfaceDialect::Ros2, diagnostics) {
            registry.add(interface);
        }
    }
    registry
}
