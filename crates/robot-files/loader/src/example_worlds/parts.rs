//! Pieces of SDF for the example worlds.

/// A colour as SDF writes it.
pub(super) type Rgb = [f64; 3];

pub(super) const RED: Rgb = [0.8, 0.15, 0.1];
pub(super) const GREEN: Rgb = [0.15, 0.6, 0.2];
pub(super) const BLUE: Rgb = [0.15, 0.3, 0.8];
pub(super) const YELLOW: Rgb = [0.9, 0.75, 0.1];
pub(super) const WHITE: Rgb = [0.9, 0.9, 0.9];
pub(super) const GREY: Rgb = [0.5, 0.5, 0.5];
pub(super) const DARK: Rgb = [0.2, 0.2, 0.2];

/// A system of Gazebo: its library without `gz-sim-` and `-system`, and its class.
pub(super) type System = (&'static str, &'static str);

pub(super) const PHYSICS: System = ("physics", "Physics");
pub(super) const COMMANDS: System = ("user-commands", "UserCommands");
pub(super) const BROADCASTER: System = ("scene-broadcaster", "SceneBroadcaster");
pub(super) const CONTACT: System = ("contact", "Contact");
pub(super) const IMU: System = ("imu", "Imu");
pub(super) const NAVSAT: System = ("navsat", "NavSat");
pub(super) const AIR_PRESSURE: System = ("air-pressure", "AirPressure");
pub(super) const ALTIMETER: System = ("altimeter", "Altimeter");
pub(super) const MAGNETOMETER: System = ("magnetometer", "Magnetometer");
pub(super) const FORCE_TORQUE: System = ("forcetorque", "ForceTorque");
pub(super) const RENDERING: System = ("sensors", "Sensors");

/// World with the usual systems and `more`, light, a floor and `content`.
pub(super) fn world(name: &str, more: &[System], content: &str) -> String {
    let systems: String = [PHYSICS, COMMANDS, BROADCASTER]
        .iter()
        .chain(more)
        .map(|(library, class)| {
            let engine = match *library {
                "sensors" => "<render_engine>ogre2</render_engine>",
                _ => "",
            };
            format!(
                "    <plugin filename=\"gz-sim-{library}-system\" \
                 name=\"gz::sim::systems::{class}\">{engine}</plugin>\n"
            )
        })
        .collect();
    let floor = "<geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>";
    format!(
        "<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n  <world name=\"{name}\">\n\
         <physics name=\"1ms\" type=\"ignored\"><max_step_size>0.001</max_step_size>\
         <real_time_factor>1</real_time_factor></physics>\n{systems}\
         <light name=\"sun\" type=\"directional\"><pose>0 0 10 0 0 0</pose>\
         <cast_shadows>true</cast_shadows><diffuse>0.8 0.8 0.8 1</diffuse>\
         <specular>0.2 0.2 0.2 1</specular><direction>-0.5 0.1 -0.9</direction></light>\n\
         <model name=\"ground_plane\"><static>true</static><link name=\"link\">\
         <collision name=\"collision\">{floor}</collision><visual name=\"visual\">{floor}{}\
         </visual></link></model>\n{content}  </world>\n</sdf>\n",
        material([0.7, 0.7, 0.7])
    )
}

pub(super) fn material([r, g, b]: Rgb) -> String {
    format!("<material><ambient>{r} {g} {b} 1</ambient><diffuse>{r} {g} {b} 1</diffuse></material>")
}

/// Simple shape: its moments of inertia per kilogram about its own axes [m²], and its SDF.
pub(super) struct Solid {
    geometry: String,
    moments_per_kg: [f64; 3],
}

pub(super) fn cuboid([x, y, z]: [f64; 3]) -> Solid {
    Solid {
        geometry: format!("<box><size>{x} {y} {z}</size></box>"),
        moments_per_kg: [y * y + z * z, x * x + z * z, x * x + y * y].map(|sum| sum / 12.0),
    }
}

pub(super) fn ball(radius_m: f64) -> Solid {
    Solid {
        geometry: format!("<sphere><radius>{radius_m}</radius></sphere>"),
        moments_per_kg: [0.4 * radius_m * radius_m; 3],
    }
}

pub(super) fn cylinder(radius_m: f64, length_m: f64) -> Solid {
    let across = (3.0 * radius_m * radius_m + length_m * length_m) / 12.0;
    Solid {
        geometry: format!(
            "<cylinder><radius>{radius_m}</radius><length>{length_m}</length></cylinder>"
        ),
        moments_per_kg: [across, across, radius_m * radius_m / 2.0],
    }
}

/// Capsule; its inertia is that of a cylinder of the whole length.
pub(super) fn capsule(radius_m: f64, length_m: f64) -> Solid {
    Solid {
        geometry: format!(
            "<capsule><radius>{radius_m}</radius><length>{length_m}</length></capsule>"
        ),
        ..cylinder(radius_m, length_m + 2.0 * radius_m)
    }
}

pub(super) fn ellipsoid([x, y, z]: [f64; 3]) -> Solid {
    Solid {
        geometry: format!("<ellipsoid><radii>{x} {y} {z}</radii></ellipsoid>"),
        moments_per_kg: [y * y + z * z, x * x + z * z, x * x + y * y].map(|sum| sum / 5.0),
    }
}

impl Solid {
    /// Inertial, collision and visual of a link, all at the centre of the shape.
    pub(super) fn on_link(&self, mass_kg: f64, pose: &str, colour: Rgb, surface: &str) -> String {
        let [ixx, iyy, izz] = self.moments_per_kg.map(|moment| moment * mass_kg);
        let geometry = &self.geometry;
        let pose = if pose.is_empty() { String::new() } else { format!("<pose>{pose}</pose>") };
        format!(
            "<inertial>{pose}<mass>{mass_kg}</mass><inertia><ixx>{ixx}</ixx><iyy>{iyy}</iyy>\
             <izz>{izz}</izz></inertia></inertial><collision name=\"collision\">{pose}<geometry>\
             {geometry}</geometry>{surface}</collision><visual name=\"visual\">{pose}<geometry>\
             {geometry}</geometry>{}</visual>",
            material(colour)
        )
    }

    /// Model with only this shape.
    pub(super) fn model(&self, name: &str, pose: &str, mass_kg: f64, colour: Rgb) -> String {
        format!(
            "<model name=\"{name}\"><pose>{pose}</pose><link name=\"{name}_link\">{}</link></model>\n",
            self.on_link(mass_kg, "", colour, "")
        )
    }

    /// Static model with only this shape.
    pub(super) fn fixed(&self, name: &str, pose: &str, colour: Rgb, sensors: &str) -> String {
        format!(
            "<model name=\"{name}\"><static>true</static><pose>{pose}</pose><link name=\"link\">\
             {}{sensors}</link></model>\n",
            self.on_link(1.0, "", colour, "")
        )
    }
}

/// Camera of a type, with 320 by 240 pixels.
pub(super) fn camera(name: &str, kind: &str, topic: &str, rate_hz: u32, more: &str) -> String {
    let format = if kind == "depth_camera" { "R_FLOAT32" } else { "R8G8B8" };
    let trigger = match more {
        "" => String::new(),
        topic => format!("<triggered>true</triggered><trigger_topic>{topic}</trigger_topic>"),
    };
    format!(
        "<sensor name=\"{name}\" type=\"{kind}\"><topic>{topic}</topic>\
         <update_rate>{rate_hz}</update_rate><always_on>true</always_on><visualize>true</visualize>\
         <camera>{trigger}<horizontal_fov>1.05</horizontal_fov><image><width>320</width>\
         <height>240</height><format>{format}</format></image><clip><near>0.1</near>\
         <far>100</far></clip></camera></sensor>"
    )
}

/// 360° lidar with 16 rows.
pub(super) fn lidar(name: &str, topic: &str) -> String {
    format!(
        "<sensor name=\"{name}\" type=\"gpu_lidar\"><topic>{topic}</topic>\
         <update_rate>10</update_rate><always_on>true</always_on><visualize>true</visualize>\
         <lidar><scan><horizontal><samples>640</samples><min_angle>-3.1241</min_angle>\
         <max_angle>3.1241</max_angle></horizontal><vertical><samples>16</samples>\
         <min_angle>-0.2618</min_angle><max_angle>0.2618</max_angle></vertical></scan><range>\
         <min>0.3</min><max>20</max><resolution>0.01</resolution></range></lidar></sensor>"
    )
}

/// Sensor without settings.
pub(super) fn plain_sensor(name: &str, kind: &str, rate_hz: u32) -> String {
    format!(
        "<sensor name=\"{name}\" type=\"{kind}\"><topic>{name}</topic>\
         <update_rate>{rate_hz}</update_rate><always_on>true</always_on></sensor>"
    )
}

/// Models in front of a sensor at the origin.
pub(super) fn scenery() -> String {
    [
        cuboid([1.0, 1.0, 1.0]).model("box", "3 0.8 0.5 0 0 0.4", 1.0, RED),
        ball(0.5).model("ball", "4 -1.2 0.5 0 0 0", 1.0, GREEN),
        cylinder(0.3, 1.2).model("pillar", "2.5 -0.4 0.6 0 0 0", 2.0, YELLOW),
        cuboid([0.2, 6.0, 2.0]).fixed("wall", "6 0 1 0 0 0", GREY, ""),
    ]
    .concat()
}
