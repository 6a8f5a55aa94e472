//! `<camera>`.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose;
use periplus_scene::{Camera, CameraKind, Distortion, NoiseSpec, SensorKind};
use periplus_xml::Element;

use super::noise;
use crate::fields::Fields;
use crate::pose::Reference;

/// Cameras of a sensor; a multi-camera has several.
pub(crate) fn read_cameras(
    type_name: &str,
    elements: &[&Element],
    sensor: &mut Fields<'_, '_>,
) -> (SensorKind, Vec<(usize, Reference)>) {
    let kind = kind(type_name);
    let mut references = Vec::new();
    let mut cameras = Vec::new();
    for (index, element) in elements.iter().enumerate() {
        let (camera, reference) = read_camera(Fields::new(element, sensor.diagnostics), kind);
        references.extend(reference.map(|reference| (index, reference)));
        cameras.push(camera);
    }
    if kind != CameraKind::Multi
        && let [first, second, ..] = elements
    {
        sensor.diagnostics.push(
            Diagnostic::warning(
                "repeated-element",
                format!("a sensor of type `{type_name}` has one camera; this one may not be seen"),
            )
            .at(second.origin)
            .related(first.origin, "the first one is used")
            .help("use `type=\"multicamera\"` for several"),
        );
    }
    if cameras.is_empty() {
        sensor.diagnostics.push(
            Diagnostic::warning("missing-element", "a camera needs its `<camera>`")
                .at(sensor.origin())
                .note("defaults are used: 320 x 240 pixels, 60 degrees"),
        );
        cameras.push(default_camera(kind));
    }
    let mut first = cameras.remove(0);
    first.others = cameras;
    (SensorKind::Camera(Box::new(first)), references)
}

fn kind(type_name: &str) -> CameraKind {
    match type_name {
        "depth" | "depth_camera" => CameraKind::Depth,
        "rgbd" | "rgbd_camera" => CameraKind::Rgbd,
        "thermal" | "thermal_camera" => CameraKind::Thermal,
        "segmentation" | "segmentation_camera" => CameraKind::Segmentation,
        "boundingbox" | "boundingbox_camera" => CameraKind::BoundingBox,
        "wideanglecamera" | "wide_angle_camera" => CameraKind::WideAngle,
        "multicamera" => CameraKind::Multi,
        _ => CameraKind::Colour,
    }
}

fn default_camera(kind: CameraKind) -> Camera {
    Camera {
        name: None,
        kind,
        sensor_from_camera: Pose::IDENTITY,
        horizontal_fov_rad: 1.047,
        width: 320,
        height: 240,
        format: "R8G8B8".into(),
        near_m: 0.1,
        far_m: 100.0,
        depth_clip_m: None,
        noise: NoiseSpec::default(),
        distortion: None,
        camera_info_topic: None,
        optical_frame_id: None,
        triggered: false,
        visibility_mask: u32::MAX,
        label_type: None,
        others: Vec::new(),
        extra: Vec::new(),
    }
}

fn read_camera(mut fields: Fields<'_, '_>, kind: CameraKind) -> (Camera, Option<Reference>) {
    let mut camera = default_camera(kind);
    camera.name = fields.attribute("name").map(|it| it.value.to_string());
    let (pose, reference) = fields.pose();
    camera.sensor_from_camera = pose;
    camera.horizontal_fov_rad = fields.length("horizontal_fov", 1.047);
    if let Some(mut image) = fields.open("image") {
        camera.width = pixels(&mut image, "width", 320);
        camera.height = pixels(&mut image, "height", 240);
        camera.format = image.text("format").unwrap_or_else(|| "R8G8B8".into());
        image.verbatim(&["anti_aliasing"]);
        let rest = image.finish();
        fields.close("image", rest);
    }
    if let Some(mut clip) = fields.open("clip") {
        camera.near_m = clip.magnitude("near", 0.1);
        camera.far_m = clip.limit("far", 100.0);
        if camera.far_m <= camera.near_m {
            let finding = Diagnostic::error("out-of-range", "`<far>` must be above `<near>`");
            clip.diagnostics.push(finding.at(clip.origin()).note("this camera renders nothing"));
        }
        let rest = clip.finish();
        fields.close("clip", rest);
    }
    depth(&mut fields, &mut camera);
    camera.noise = noise::child(&mut fields);
    camera.distortion = distortion(&mut fields);
    camera.camera_info_topic = fields.text("camera_info_topic");
    camera.optical_frame_id = fields.text("optical_frame_id");
    camera.triggered = fields.boolean("triggered", false);
    camera.visibility_mask = fields.count("visibility_mask", u32::MAX);
    camera.label_type = match kind {
        CameraKind::BoundingBox => fields.text("box_type"),
        CameraKind::Segmentation => fields.text("segmentation_type"),
        _ => None,
    };
    fields.verbatim(&[
        "save",
        "lens",
        "box_type",
        "segmentation_type",
        "trigger_topic",
        "frame",
        "bayer",
    ]);
    camera.extra = fields.finish();
    (camera, reference)
}

fn pixels(image: &mut Fields<'_, '_>, name: &'static str, default: u32) -> u32 {
    let count = image.count(name, default);
    if count > 0 {
        return count;
    }
    let origin = image.element.child(name).map(Element::text_origin).unwrap_or_default();
    image.diagnostics.push(
        Diagnostic::error("out-of-range", format!("the {name} of an image must be above 0"))
            .at(origin)
            .note(format!("{default} is assumed")),
    );
    default
}

fn depth(fields: &mut Fields<'_, '_>, camera: &mut Camera) {
    let Some(mut depth) = fields.open("depth_camera") else { return };
    if let Some(mut clip) = depth.open("clip") {
        camera.depth_clip_m = Some([clip.magnitude("near", 0.1), clip.limit("far", 10.0)]);
        let rest = clip.finish();
        depth.close("clip", rest);
    }
    depth.verbatim(&["output"]);
    let rest = depth.finish();
    fields.close("depth_camera", rest);
}

fn distortion(fields: &mut Fields<'_, '_>) -> Option<Distortion> {
    let mut child = fields.open("distortion")?;
    let distortion = Distortion {
        k1: child.number("k1", 0.0),
        k2: child.number("k2", 0.0),
        k3: child.number("k3", 0.0),
        p1: child.number("p1", 0.0),
        p2: child.number("p2", 0.0),
        center: child.pair("center", [0.5, 0.5]),
    };
    let rest = child.finish();
    fields.close("distortion", rest);
    Some(distortion)
}
