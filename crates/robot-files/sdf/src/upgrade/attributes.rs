//! 1.0 to 1.2: attributes become children.

use periplus_xml::{Attribute, Element, Text, XmlNode};

use super::{child_mut, take_attribute};

/// Attributes that become children of the same name. Names of elements have the same meaning everywhere.
const TO_CHILDREN: &[(&str, &[&str])] = &[
    ("state", &["time"]),
    ("physics", &["update_rate"]),
    ("solver", &["type", "dt", "iters", "precon_iters", "sor"]),
    ("constraints", &["cfm", "erp", "contact_max_correcting_vel", "contact_surface_layer"]),
    ("fog", &["rgba", "type", "start", "end", "density"]),
    ("skin", &["filename", "scale"]),
    ("animation", &["filename", "scale", "interpolate_x"]),
    ("script", &["loop", "delay_start", "auto_start"]),
    ("waypoint", &["time", "pose"]),
    ("light", &["cast_shadows"]),
    ("spot", &["inner_angle", "outer_angle", "falloff"]),
    ("attenuation", &["range", "linear", "constant", "quadratic"]),
    ("model", &["static"]),
    ("grasp_check", &["detach_steps", "attach_steps", "min_contact_count"]),
    ("link", &["gravity", "self_collide", "kinematic"]),
    ("inertial", &["mass", "density"]),
    ("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
    ("sensor", &["always_on", "update_rate", "visualize"]),
    ("horizontal", &["samples", "resolution", "min_angle", "max_angle"]),
    ("vertical", &["samples", "resolution", "min_angle", "max_angle"]),
    ("range", &["min", "max", "resolution"]),
    ("image", &["width", "height", "format", "filename", "scale", "threshold", "granularity"]),
    ("clip", &["near", "far"]),
    ("save", &["path"]),
    ("depth_camera", &["output"]),
    ("collision", &["laser_retro"]),
    ("bounce", &["restitution_coefficient", "threshold"]),
    (
        "ode",
        &[
            "mu",
            "mu2",
            "fdir1",
            "slip1",
            "slip2",
            "soft_cfm",
            "soft_erp",
            "kp",
            "kd",
            "max_vel",
            "min_depth",
        ],
    ),
    ("box", &["size"]),
    ("sphere", &["radius"]),
    ("cylinder", &["radius", "length"]),
    ("mesh", &["filename", "scale"]),
    ("heightmap", &["filename", "size", "origin"]),
    ("plane", &["normal"]),
    ("visual", &["cast_shadows", "laser_retro", "transparency"]),
    ("material", &["script"]),
    ("axis", &["xyz"]),
    ("axis2", &["xyz"]),
    ("dynamics", &["damping", "friction"]),
    ("limit", &["lower", "upper", "effort", "velocity", "cfm", "erp"]),
    ("suspension", &["cfm", "erp"]),
];

/// Attributes that become the text of their element.
const TO_TEXT: &[(&str, &str)] = &[
    ("origin", "pose"),
    ("gravity", "xyz"),
    ("ambient", "rgba"),
    ("background", "rgba"),
    ("diffuse", "rgba"),
    ("specular", "rgba"),
    ("emissive", "rgba"),
    ("shadows", "enabled"),
    ("grid", "enabled"),
    ("direction", "xyz"),
    ("horizontal_fov", "angle"),
    ("parent", "link"),
    ("child", "link"),
];

/// Elements, and children of elements, that were renamed.
const RENAMED: &[(&str, &str, &str)] = &[
    ("fog", "rgba", "color"),
    ("heightmap", "origin", "pos"),
    ("heightmap", "filename", "uri"),
    ("mesh", "filename", "uri"),
    ("image", "filename", "uri"),
    ("link", "damping", "velocity_decay"),
];

pub(super) fn to_children(element: &mut Element) {
    let wanted = TO_CHILDREN.iter().find(|(name, _)| element.name == *name);
    for name in wanted.map_or(&[][..], |(_, attributes)| attributes) {
        if let Some(attribute) = take_attribute(element, name)
            && element.child(name).is_none()
        {
            let mut child = Element::new(*name);
            set_text(&mut child, attribute);
            element.push(child);
        }
    }
    if let Some((_, attribute)) = TO_TEXT.iter().find(|(name, _)| element.name == *name)
        && let Some(attribute) = take_attribute(element, attribute)
    {
        set_text(element, attribute);
    }
    if element.name == "origin" {
        element.name = "pose".into();
    }
    for (parent, from, to) in RENAMED {
        if element.name == *parent
            && element.child(to).is_none()
            && let Some(child) = child_mut(element, from)
        {
            child.name = (*to).into();
        }
    }
    // 1.2 to 1.3: the name of a material became a child of its script.
    if element.name == "material"
        && let Some(script) = child_mut(element, "script")
        && script.elements().next().is_none()
    {
        let mut name = Element { name: "name".into(), ..script.clone() };
        name.attributes.clear();
        script.children = vec![XmlNode::Element(name)];
    }
}

fn set_text(element: &mut Element, attribute: Attribute) {
    if element.origin.0.is_none() {
        element.origin = attribute.origin;
    }
    let text = Text { text: attribute.value, origin: attribute.value_origin };
    element.children.insert(0, XmlNode::Text(text));
}
