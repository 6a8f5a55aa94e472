//! Built-in models that worlds may include without a file.

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_xml::{Document, parse};

/// Light of most worlds: from above, slightly inclined.
const SUN: &str = r#"<sdf version="1.6">
  <light type="directional" name="sun">
    <cast_shadows>true</cast_shadows>
    <pose>0 0 10 0 0 0</pose>
    <diffuse>0.8 0.8 0.8 1</diffuse>
    <specular>0.2 0.2 0.2 1</specular>
    <attenuation>
      <range>1000</range>
      <constant>0.9</constant>
      <linear>0.01</linear>
      <quadratic>0.001</quadratic>
    </attenuation>
    <direction>-0.5 0.1 -0.9</direction>
  </light>
</sdf>
"#;

/// Floor of most worlds.
const GROUND_PLANE: &str = r#"<sdf version="1.6">
  <model name="ground_plane">
    <static>true</static>
    <link name="link">
      <collision name="collision">
        <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
        <surface><friction><ode><mu>100</mu><mu2>50</mu2></ode></friction></surface>
      </collision>
      <visual name="visual">
        <cast_shadows>false</cast_shadows>
        <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
        <material><script>
          <uri>file://media/materials/scripts/gazebo.material</uri>
          <name>Gazebo/Grey</name>
        </script></material>
      </visual>
    </link>
  </model>
</sdf>
"#;

/// Built-in model named by a URI: `model://sun`, or `.../models/Ground Plane` of Fuel.
pub(crate) fn find(uri: &str, sources: &mut SourceMap) -> Option<Document> {
    let by_scheme = uri.strip_prefix("model://");
    let by_fuel = || {
        let rest = uri.strip_prefix("https://").or_else(|| uri.strip_prefix("http://"))?;
        let (_, name) = rest.split_once("/models/")?;
        rest.starts_with("fuel.").then(|| name.split('/').next().unwrap_or(name))
    };
    let name = by_scheme.or_else(by_fuel)?.trim_end_matches('/').to_lowercase().replace(' ', "_");
    let text = match name.as_str() {
        "sun" => SUN,
        "ground_plane" => GROUND_PLANE,
        _ => return None,
    };
    let file = sources.add(format!("built-in model {name}"), text);
    parse(file, sources, &mut Diagnostics::new())
}
