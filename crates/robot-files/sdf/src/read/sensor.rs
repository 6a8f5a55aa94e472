//! `<sensor>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{NoiseSpec, Sensor, SensorKind};
use periplus_xml::Element;

use super::plugin::plugins;
use super::radar::{CUSTOM_TYPE_ATTRIBUTES, RADAR_ELEMENTS, read_radar};
use super::{camera, lidar, noise};
use crate::fields::Fields;
use crate::pose::{PosedElement, Reference};
use crate::verbatim::keep;

/// Sensor types, and the elements that hold their settings.
const TYPES: [(&str, &[&str]); 36] = [
    ("air_pressure", &["air_pressure"]),
    ("air_speed", &["air_speed"]),
    ("altimeter", &["altimeter"]),
    ("boundingbox", &["camera"]),
    ("boundingbox_camera", &["camera"]),
    ("camera", &["camera"]),
    ("contact", &["contact"]),
    ("custom", &[]),
    ("depth", &["camera"]),
    ("depth_camera", &["camera"]),
    ("dvl", &["dvl"]),
    ("force_torque", &["force_torque"]),
    ("gps", &["gps", "navsat"]),
    ("gpu_lidar", &["lidar", "ray"]),
    ("gpu_ray", &["ray", "lidar"]),
    ("imu", &["imu"]),
    ("lidar", &["lidar", "ray"]),
    ("logical_camera", &["logical_camera"]),
    ("magnetometer", &["magnetometer"]),
    ("multicamera", &["camera"]),
    ("navsat", &["navsat", "gps"]),
    ("radar", &RADAR_ELEMENTS),
    ("ray", &["ray", "lidar"]),
    ("rfid", &["rfid"]),
    ("rfidtag", &["rfidtag"]),
    ("rgbd", &["camera"]),
    ("rgbd_camera", &["camera"]),
    ("segmentation", &["camera"]),
    ("segmentation_camera", &["camera"]),
    ("sonar", &["sonar"]),
    ("thermal", &["camera"]),
    ("thermal_camera", &["camera"]),
    ("wideanglecamera", &["camera"]),
    ("wide_angle_camera", &["camera"]),
    ("wireless_receiver", &["transceiver"]),
    ("wireless_transmitter", &["transceiver"]),
];

/// Sensor, with the frames that its pose and those of its cameras are relative to.
#[derive(Clone, Debug, PartialEq)]
pub struct PosedSensor {
    /// The sensor; poses are as written.
    pub value: Sensor,
    /// Frame that the sensor's pose is relative to; `None` for the default.
    pub relative_to: Option<Reference>,
    /// Frames that the poses of cameras are relative to: 0 is the camera itself, 1 the first of its
    /// [`periplus_scene::Camera::others`], and so on.
    pub cameras_relative_to: Vec<(usize, Reference)>,
}

/// Reads a `<sensor>` of any type and version; SDF's defaults.
pub fn read_sensor(element: &Element, diagnostics: &mut Diagnostics) -> PosedSensor {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let type_name = fields.required_attribute("type").map(|it| it.value.to_string());
    let type_name = type_name.unwrap_or_default();
    let (parent_from_sensor, relative_to) = fields.pose();
    let mut sensor = Sensor {
        name: name.unwrap_or_else(|| type_name.clone()),
        parent_from_sensor,
        kind: SensorKind::Other,
        update_rate_hz: fields.rate("update_rate", 0.0),
        always_on: fields.boolean("always_on", false),
        visualize: fields.boolean("visualize", false),
        enable_metrics: fields.boolean("enable_metrics", false),
        topic: fields.text("topic"),
        frame_id: frame_id(&mut fields),
        plugins: plugins(&mut fields),
        kind_extra: Vec::new(),
        extra: Vec::new(),
        origin: element.origin,
        type_name,
    };
    let known = TYPES.iter().find(|(name, _)| *name == sensor.type_name);
    if known.is_none() && !sensor.type_name.is_empty() {
        let origin = element.attribute("type").map(|it| it.value_origin).unwrap_or_default();
        fields.diagnostics.push(
            Diagnostic::warning(
                "unknown-type",
                format!("`{}` is not a type of sensor that is known here", sensor.type_name),
            )
            .at(origin)
            .note("it is kept, but publishes no data")
            .did_you_mean(
                origin,
                &sensor.type_name,
                TYPES.iter().map(|(name, _)| *name),
            ),
        );
    }
    let mut cameras_relative_to = Vec::new();
    let mut settings = known.map_or(&[][..], |(_, elements)| elements);
    let custom_type = CUSTOM_TYPE_ATTRIBUTES.iter().find_map(|name| fields.attribute(name));
    let is_radar = sensor.type_name == "radar"
        || sensor.type_name == "custom" && custom_type.is_some_and(|it| it.value == "radar");
    if is_radar {
        settings = &RADAR_ELEMENTS;
    }
    read_kind(&mut sensor, settings, &mut fields, &mut cameras_relative_to);
    fields.verbatim(&[
        "frame",
        "air_pressure",
        "air_speed",
        "altimeter",
        "camera",
        "contact",
        "dvl",
        "force_torque",
        "gps",
        "imu",
        "lidar",
        "logical_camera",
        "magnetometer",
        "navsat",
        "radar",
        "ray",
        "rfid",
        "rfidtag",
        "sonar",
        "transceiver",
    ]);
    sensor.extra.extend(fields.finish());
    PosedSensor { value: sensor, relative_to, cameras_relative_to }
}

/// `gz_frame_id` and its earlier names.
fn frame_id(fields: &mut Fields<'_, '_>) -> Option<String> {
    let newest = fields.text("gz_frame_id");
    let older = fields.text("ignition_frame_id");
    let oldest = fields.text("frame_id");
    newest.or(older).or(oldest)
}

fn read_kind(
    sensor: &mut Sensor,
    settings: &'static [&'static str],
    fields: &mut Fields<'_, '_>,
    cameras_relative_to: &mut Vec<(usize, Reference)>,
) {
    // Without settings the defaults apply: an empty element is read instead.
    let placeholder = Element { origin: fields.origin(), ..Element::new("settings") };
    let present = settings.iter().find(|name| fields.element.child(name).is_some());
    if let ["camera"] = settings {
        let elements = fields.children("camera");
        let (kind, references) = camera::read_cameras(&sensor.type_name, &elements, fields);
        sensor.kind = kind;
        *cameras_relative_to = references;
        return;
    }
    let element = match present {
        Some(name) => fields.child(name).unwrap_or(&placeholder),
        None => &placeholder,
    };
    let mut inner = Fields::new(element, fields.diagnostics);
    if *settings == RADAR_ELEMENTS {
        sensor.kind = SensorKind::Radar(Box::new(read_radar(inner)));
        return;
    }
    let kind = match &*sensor.type_name {
        "ray" | "gpu_ray" | "lidar" | "gpu_lidar" => {
            if present.is_none() {
                inner.diagnostics.push(
                    Diagnostic::error("missing-element", "a lidar needs its settings")
                        .at(sensor.origin)
                        .help("add `<lidar><scan>...</scan><range>...</range></lidar>`"),
                );
                // No rays of zero range are cast.
                return;
            }
            sensor.kind = SensorKind::Lidar(Box::new(lidar::read_lidar(inner)));
            return;
        }
        "imu" => {
            sensor.kind = SensorKind::Imu(Box::new(super::imu::read_imu(inner)));
            return;
        }
        "gps" | "navsat" => {
            let [position_horizontal, position_vertical] =
                noise::group(&mut inner, "position_sensing", ["horizontal", "vertical"]);
            let [velocity_horizontal, velocity_vertical] =
                noise::group(&mut inner, "velocity_sensing", ["horizontal", "vertical"]);
            SensorKind::NavSat {
                position_horizontal,
                position_vertical,
                velocity_horizontal,
                velocity_vertical,
            }
        }
        "magnetometer" => SensorKind::Magnetometer(axes(&mut inner)),
        "altimeter" => SensorKind::Altimeter {
            vertical_position: noise::inside(&mut inner, "vertical_position"),
            vertical_velocity: noise::inside(&mut inner, "vertical_velocity"),
        },
        "air_pressure" => SensorKind::AirPressure {
            reference_altitude_m: inner.number("reference_altitude", 0.0),
            pressure: noise::inside(&mut inner, "pressure"),
        },
        "contact" => contact(&mut inner),
        "force_torque" => SensorKind::ForceTorque {
            frame: inner.text("frame").unwrap_or_else(|| "child".into()),
            measure_direction: inner
                .text("measure_direction")
                .unwrap_or_else(|| "child_to_parent".into()),
            force: Box::new(noise::group(&mut inner, "force", ["x", "y", "z"])),
            torque: Box::new(noise::group(&mut inner, "torque", ["x", "y", "z"])),
        },
        "sonar" => SensorKind::Sonar {
            geometry: inner.text("geometry").unwrap_or_else(|| "cone".into()),
            min_m: inner.magnitude("min", 0.0),
            max_m: inner.magnitude("max", 1.0),
            radius_m: inner.magnitude("radius", 0.5),
        },
        "logical_camera" => SensorKind::LogicalCamera {
            near_m: inner.magnitude("near", 0.0),
            far_m: inner.magnitude("far", 1.0),
            aspect_ratio: inner.magnitude("aspect_ratio", 1.0),
            horizontal_fov_rad: inner.magnitude("horizontal_fov", 1.0),
        },
        _ => {
            if present.is_some() {
                sensor.extra.push(keep(element));
            }
            return;
        }
    };
    sensor.kind_extra = inner.finish();
    sensor.kind = kind;
}

fn axes(inner: &mut Fields<'_, '_>) -> [NoiseSpec; 3] {
    ["x", "y", "z"].map(|axis| noise::inside(inner, axis))
}

fn contact(inner: &mut Fields<'_, '_>) -> SensorKind {
    let elements = inner.children("collision");
    // SDF 1.0 has the name as an attribute.
    let collisions = elements
        .iter()
        .map(|element| {
            element.value("name").map_or_else(|| element.text().into_owned(), Into::into)
        })
        .filter(|name: &String| !name.is_empty() && name != "__default__")
        .collect();
    let topic = inner.text("topic").filter(|topic| topic != "__default_topic__");
    SensorKind::Contact { collisions, topic }
}

impl From<PosedSensor> for PosedElement<Sensor> {
    fn from(sensor: PosedSensor) -> Self {
        Self { value: sensor.value, relative_to: sensor.relative_to }
    }
}
