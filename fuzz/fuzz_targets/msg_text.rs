//! Any text as a message, a service, an action and a schema of ROS 1 or 2: findings with positions, or
//! types that have a hash, code, a schema that reads back, and values.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_msgs::{DynamicMessage, Format, TypeRegistry, YamlStyle};
use periplus_rosidl::{InterfaceDialect, Registry, TypeName, rust};

/// Packages needed by services, actions and ROS 1; all packages would only make it slow.
static BASE: LazyLock<Registry> = LazyLock::new(|| {
    let mut base = Registry::new();
    for name in [
        "builtin_interfaces/Time",
        "builtin_interfaces/Duration",
        "service_msgs/ServiceEventInfo",
        "std_msgs/Header",
        "unique_identifier_msgs/UUID",
    ] {
        let name = TypeName::read(name).expect("a name");
        let one = TypeRegistry::builtin().registry().interface(&name);
        base.add(one.expect("a type of ours").clone());
    }
    base
});

fuzz_target!(|text: &str| {
    for (name, dialect) in [
        ("fuzz_msgs/msg/Fuzz", InterfaceDialect::Ros2),
        ("fuzz_msgs/srv/Fuzz", InterfaceDialect::Ros2),
        ("fuzz_msgs/action/Fuzz", InterfaceDialect::Ros2),
        ("fuzz_msgs/msg/Fuzz", InterfaceDialect::Ros1),
    ] {
        let name = TypeName::read(name).expect("a name");
        let mut sources = SourceMap::new();
        let mut diagnostics = Diagnostics::new();
        let mut registry = BASE.clone();
        let file = sources.add("fuzz", text);
        registry.add_schema(&name, file, &sources, dialect, &mut diagnostics);
        let types = TypeRegistry::new(registry, &mut diagnostics);
        for one in diagnostics.iter().take(20) {
            assert!(!render(one, &sources, RenderStyle::Plain).is_empty());
        }
        let Some(interface) = types.registry().interface(&name) else {
            assert!(diagnostics.has_errors());
            continue;
        };
        let _ = rust::package(types.registry(), "fuzz_msgs");
        for part in &interface.parts {
            let part = part.name.to_string();
            assert!(types.hash(&part).is_some());
            let layout = types.layout(&part).expect("a type of the registry");
            let blank = DynamicMessage::blank(layout);
            let mut bytes = Vec::new();
            if blank.encode(Format::CDR, &mut bytes).is_ok() {
                DynamicMessage::decode(layout, Format::CDR, &bytes).expect("what was written");
            }
            assert!(blank.to_yaml(&YamlStyle::default()).ends_with('\n'));
        }
    }
});
