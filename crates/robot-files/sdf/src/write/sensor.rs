//! `<sensor>`.

use periplus_geometry::Pose;
use periplus_scene::{
    Camera, CameraKind, ImuSpec, LidarSpec, NoiseKind, NoiseSpec, ScanAxis, Sensor, SensorKind,
};
use periplus_xml::Element;

use super::out::{Out, numbers};
use super::radar::write_radar;
use super::write_plugin;

pub(super) fn write_sensor(sensor: &Sensor) -> Element {
    let mut out = Out::named("sensor", &sensor.name);
    out.attribute("type", &sensor.type_name);
    if matches!(sensor.kind, SensorKind::Radar(_)) && sensor.type_name == "custom" {
        out.attribute("gz:type", "radar");
    }
    out.pose(sensor.parent_from_sensor);
    out.number("update_rate", sensor.update_rate_hz, 0.0);
    out.flag("always_on", sensor.always_on, false);
    out.flag("visualize", sensor.visualize, false);
    out.flag("enable_metrics", sensor.enable_metrics, false);
    out.optional("topic", &sensor.topic);
    out.optional("gz_frame_id", &sensor.frame_id);
    write_kind(sensor, &mut out);
    for plugin in &sensor.plugins {
        out.push(write_plugin(plugin));
    }
    out.finish(&sensor.extra)
}

fn write_kind(sensor: &Sensor, out: &mut Out) {
    let old = matches!(&*sensor.type_name, "ray" | "gpu_ray" | "gps");
    let rest = &sensor.kind_extra;
    let three = |inner: &mut Out, noises: &[NoiseSpec; 3]| {
        for (axis, noise) in ["x", "y", "z"].iter().zip(noises) {
            inside(axis, noise, inner);
        }
    };
    match &sensor.kind {
        SensorKind::Lidar(lidar) => {
            out.push(write_lidar(lidar, if old { "ray" } else { "lidar" }));
        }
        SensorKind::Radar(radar) => {
            let is_custom = sensor.type_name == "custom";
            out.push(write_radar(radar, if is_custom { "gz:radar" } else { "radar" }));
        }
        SensorKind::Camera(camera) => {
            out.push(write_camera(camera));
            camera.others.iter().for_each(|other| out.push(write_camera(other)));
        }
        SensorKind::Imu(imu) => out.push_filled(write_imu(imu)),
        SensorKind::NavSat {
            position_horizontal,
            position_vertical,
            velocity_horizontal,
            velocity_vertical,
        } => {
            let mut inner = Out::new(if old { "gps" } else { "navsat" });
            let mut pair = |name: &str, horizontal: &NoiseSpec, vertical: &NoiseSpec| {
                let mut group = Out::new(name);
                inside("horizontal", horizontal, &mut group);
                inside("vertical", vertical, &mut group);
                inner.push_filled(group.finish(&[]));
            };
            pair("position_sensing", position_horizontal, position_vertical);
            pair("velocity_sensing", velocity_horizontal, velocity_vertical);
            out.push_filled(inner.finish(rest));
        }
        SensorKind::Magnetometer(noises) => {
            let mut inner = Out::new("magnetometer");
            three(&mut inner, noises);
            out.push_filled(inner.finish(rest));
        }
        SensorKind::Altimeter { vertical_position, vertical_velocity } => {
            let mut inner = Out::new("altimeter");
            inside("vertical_position", vertical_position, &mut inner);
            inside("vertical_velocity", vertical_velocity, &mut inner);
            out.push_filled(inner.finish(rest));
        }
        SensorKind::AirPressure { reference_altitude_m, pressure } => {
            let mut inner = Out::new("air_pressure");
            inner.number("reference_altitude", *reference_altitude_m, 0.0);
            inside("pressure", pressure, &mut inner);
            out.push_filled(inner.finish(rest));
        }
        SensorKind::Contact { collisions, topic } => {
            let mut inner = Out::new("contact");
            collisions.iter().for_each(|name| inner.text("collision", name));
            inner.optional("topic", topic);
            out.push_filled(inner.finish(rest));
        }
        SensorKind::ForceTorque { frame, measure_direction, force, torque } => {
            let mut inner = Out::new("force_torque");
            inner.text("frame", frame);
            inner.text("measure_direction", measure_direction);
            for (name, noises) in [("force", force), ("torque", torque)] {
                let mut group = Out::new(name);
                three(&mut group, noises);
                inner.push_filled(group.finish(&[]));
            }
            out.push(inner.finish(rest));
        }
        SensorKind::Sonar { geometry, min_m, max_m, radius_m } => {
            let mut inner = Out::new("sonar");
            inner.text("geometry", geometry);
            inner.always("min", *min_m);
            inner.always("max", *max_m);
            inner.always("radius", *radius_m);
            out.push(inner.finish(rest));
        }
        SensorKind::LogicalCamera { near_m, far_m, aspect_ratio, horizontal_fov_rad } => {
            let mut inner = Out::new("logical_camera");
            inner.always("near", *near_m);
            inner.always("far", *far_m);
            inner.always("aspect_ratio", *aspect_ratio);
            inner.always("horizontal_fov", *horizontal_fov_rad);
            out.push(inner.finish(rest));
        }
        SensorKind::Other => {}
    }
}

/// `<name><noise type="..."/></name>`, if there is noise.
fn inside(name: &str, noise: &NoiseSpec, out: &mut Out) {
    if *noise != NoiseSpec::default() {
        let mut inner = Out::new(name);
        inner.push(write_noise(noise, false));
        out.push(inner.finish(&[]));
    }
}

/// Cameras and lidars have the noise type as a child, all others as an attribute.
fn write_noise(noise: &NoiseSpec, kind_as_child: bool) -> Element {
    let mut out = Out::new("noise");
    let kind = match noise.kind {
        NoiseKind::None => "none",
        NoiseKind::Gaussian => "gaussian",
        NoiseKind::GaussianQuantized => "gaussian_quantized",
    };
    if kind_as_child {
        out.text("type", kind);
    } else {
        out.attribute("type", kind);
    }
    out.number("mean", noise.mean, 0.0);
    out.number("stddev", noise.stddev, 0.0);
    out.number("bias_mean", noise.bias_mean, 0.0);
    out.number("bias_stddev", noise.bias_stddev, 0.0);
    out.number("dynamic_bias_stddev", noise.dynamic_bias_stddev, 0.0);
    out.number("dynamic_bias_correlation_time", noise.dynamic_bias_correlation_time_s, 0.0);
    out.number("precision", noise.precision, 0.0);
    out.finish(&[])
}

fn write_lidar(lidar: &LidarSpec, name: &str) -> Element {
    let mut out = Out::new(name);
    let mut scan = Out::new("scan");
    scan.push(write_axis("horizontal", &lidar.horizontal));
    scan.push(write_axis("vertical", &lidar.vertical));
    out.push(scan.finish(&[]));
    let mut range = Out::new("range");
    range.always("min", lidar.range_min_m);
    range.always("max", lidar.range_max_m);
    range.number("resolution", lidar.range_resolution_m, 0.0);
    out.push(range.finish(&[]));
    if lidar.noise != NoiseSpec::default() {
        out.push(write_noise(&lidar.noise, true));
    }
    out.count("visibility_mask", lidar.visibility_mask, u32::MAX);
    out.finish(&lidar.extra)
}

fn write_axis(name: &str, axis: &ScanAxis) -> Element {
    let mut out = Out::new(name);
    out.text("samples", axis.samples.to_string());
    out.always("resolution", axis.resolution);
    out.always("min_angle", axis.min_angle_rad);
    out.always("max_angle", axis.max_angle_rad);
    out.finish(&[])
}

fn write_imu(imu: &ImuSpec) -> Element {
    let mut out = Out::new("imu");
    let groups = [
        ("angular_velocity", &imu.angular_velocity),
        ("linear_acceleration", &imu.linear_acceleration),
    ];
    for (name, noises) in groups {
        let mut group = Out::new(name);
        for (axis, noise) in ["x", "y", "z"].iter().zip(noises) {
            inside(axis, noise, &mut group);
        }
        out.push_filled(group.finish(&[]));
    }
    if imu.localization.is_some() {
        let mut frame = Out::new("orientation_reference_frame");
        frame.optional("localization", &imu.localization);
        out.push(frame.finish(&[]));
    }
    out.flag("enable_orientation", imu.enable_orientation, true);
    out.finish(&imu.extra)
}

fn write_camera(camera: &Camera) -> Element {
    let mut out = Out::new("camera");
    if let Some(name) = &camera.name {
        out.attribute("name", name);
    }
    if camera.sensor_from_camera != Pose::IDENTITY {
        out.pose(camera.sensor_from_camera);
    }
    out.always("horizontal_fov", camera.horizontal_fov_rad);
    let mut image = Out::new("image");
    image.text("width", camera.width.to_string());
    image.text("height", camera.height.to_string());
    image.text("format", &camera.format);
    out.push(image.finish(&[]));
    let mut clip = Out::new("clip");
    clip.always("near", camera.near_m);
    clip.always("far", camera.far_m);
    out.push(clip.finish(&[]));
    if let Some([near_m, far_m]) = camera.depth_clip_m {
        let mut clip = Out::new("clip");
        clip.always("near", near_m);
        clip.always("far", far_m);
        out.push(Element::new("depth_camera").with_child(clip.finish(&[])));
    }
    if camera.noise != NoiseSpec::default() {
        out.push(write_noise(&camera.noise, true));
    }
    if let Some(lens) = &camera.distortion {
        let mut element = Out::new("distortion");
        let named =
            [("k1", lens.k1), ("k2", lens.k2), ("k3", lens.k3), ("p1", lens.p1), ("p2", lens.p2)];
        for (name, value) in named {
            element.always(name, value);
        }
        element.text("center", numbers(&lens.center));
        out.push(element.finish(&[]));
    }
    out.optional("camera_info_topic", &camera.camera_info_topic);
    out.optional("optical_frame_id", &camera.optical_frame_id);
    out.flag("triggered", camera.triggered, false);
    out.count("visibility_mask", camera.visibility_mask, u32::MAX);
    match camera.kind {
        CameraKind::BoundingBox => out.optional("box_type", &camera.label_type),
        CameraKind::Segmentation => out.optional("segmentation_type", &camera.label_type),
        _ => {}
    }
    out.finish(&camera.extra)
}
